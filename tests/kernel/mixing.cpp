// SPDX-License-Identifier: GPL-2.0-only
// Mixing (contract, section 3): stiffnesses harmonically (springs in series), f0 and mu
// geometrically, e geometrically.

#include "support.h"

namespace mixing_test {
using namespace eepa_test;

Parameters full()
{
  Parameters p = material(Law::linear, 700.0, 1900.0, 330.0, -0.07).p;
  p.mu = 0.37;
  p.restitution = 0.61;
  p.rolling = RollingModel::sds;
  p.mu_r = 0.013;
  p.kr = 49.0;
  p.rolling_viscous = 0.0031;
  return p;
}

Parameters mixture(const Parameters &a, const Parameters &b)
{
  Parameters mixed;
  std::string why;
  EXPECT_TRUE(mix(a, b, mixed, why)) << why;
  EXPECT_EQ(why, "");
  return mixed;
}

void expect_same(const Parameters &a, const Parameters &b)
{
  EXPECT_DOUBLE_EQ(a.k1, b.k1);
  EXPECT_DOUBLE_EQ(a.k2, b.k2);
  EXPECT_DOUBLE_EQ(a.k_adh, b.k_adh);
  EXPECT_DOUBLE_EQ(a.f0, b.f0);
  EXPECT_DOUBLE_EQ(a.mu, b.mu);
  EXPECT_EQ(a.kt_given, b.kt_given);
  EXPECT_DOUBLE_EQ(tangential_stiffness(a), tangential_stiffness(b));
  EXPECT_EQ(a.damping, b.damping);
  EXPECT_DOUBLE_EQ(a.restitution, b.restitution);
  EXPECT_DOUBLE_EQ(a.viscous_normal, b.viscous_normal);
  EXPECT_DOUBLE_EQ(a.viscous_tangential, b.viscous_tangential);
  EXPECT_EQ(a.bound, b.bound);
  EXPECT_DOUBLE_EQ(a.depth, b.depth);
  EXPECT_EQ(a.rolling, b.rolling);
  EXPECT_EQ(a.twisting, b.twisting);
  EXPECT_DOUBLE_EQ(a.mu_r, b.mu_r);
  EXPECT_DOUBLE_EQ(a.kr, b.kr);
  EXPECT_DOUBLE_EQ(a.rolling_viscous, b.rolling_viscous);
}

TEST(Mixing, WithItselfIsIdentity)
{
  Parameters p = full();
  expect_same(mixture(p, p), p);
  p.kt_given = true;
  p.kt = 123.0;
  expect_same(mixture(p, p), p);
  p.damping = Damping::viscous;
  p.restitution = 1.0;
  p.viscous_normal = 0.07;
  p.viscous_tangential = 0.05;
  expect_same(mixture(p, p), p);
  p.rolling = RollingModel::none;
  p.mu_r = p.kr = p.rolling_viscous = 0.0;
  expect_same(mixture(p, p), p);
}

// Types that were given the same have the same coefficients as their mixture: they are evaluated
// together.
TEST(Mixing, WithItselfIsIdentityToTheBit)
{
  Random random(73);
  for (int k = 0; k < 2000; k++) {
    const Parameters p = any_material(random).p;
    ASSERT_EQ(pack(mixture(p, p)), pack(p)) << to_words(p);
  }
}

TEST(Mixing, OfOtherTypesKeepsEqualNumbersToTheBit)
{
  Parameters a = full(), b = full();
  b.k2 = 3333.3;
  b.mu = 0.1;
  Parameters m = mixture(a, b);
  EXPECT_NE(m.k2, a.k2);
  EXPECT_NE(m.mu, a.mu);
  m.k2 = a.k2;
  m.mu = a.mu;
  EXPECT_EQ(pack(m), pack(a));
}

// numbers of alternatives that the mixture does not have stay at their defaults
TEST(Mixing, LeavesUnreadNumbersAlone)
{
  Parameters a = full(), b = full();
  b.rolling = RollingModel::none;
  b.mu_r = b.kr = b.rolling_viscous = 0.0;
  const Parameters m = mixture(a, b), defaults;
  EXPECT_EQ(m.kr, defaults.kr);
  EXPECT_EQ(m.mu_r, defaults.mu_r);
  EXPECT_EQ(m.rolling_viscous, defaults.rolling_viscous);
  EXPECT_EQ(m.kt, defaults.kt);
  EXPECT_EQ(m.viscous_normal, defaults.viscous_normal);
}

TEST(Mixing, MeansOfTwo)
{
  Parameters a = full(), b = full();
  b.k1 = 2100.0;
  b.k2 = 5700.0;
  b.k_adh = 110.0;
  b.f0 = -0.28;
  b.mu = 0.37 * 4.0;
  b.restitution = 0.61 / 4.0;
  b.mu_r = 0.013 * 9.0;
  b.kr = 147.0;
  b.rolling_viscous = 0.0093;
  a.depth = 0.09;
  b.depth = 0.04;
  const Parameters m = mixture(a, b);
  EXPECT_DOUBLE_EQ(m.k1, 1050.0);    // 2 (1/700 + 1/2100)^-1
  EXPECT_DOUBLE_EQ(m.k2, 2850.0);
  EXPECT_DOUBLE_EQ(m.k_adh, 165.0);
  EXPECT_DOUBLE_EQ(m.f0, -0.14);
  EXPECT_DOUBLE_EQ(m.mu, 0.74);
  EXPECT_DOUBLE_EQ(m.depth, 0.06);
  EXPECT_DOUBLE_EQ(m.restitution, 0.305);
  EXPECT_DOUBLE_EQ(m.mu_r, 0.039);
  EXPECT_DOUBLE_EQ(m.kr, 73.5);
  EXPECT_DOUBLE_EQ(m.rolling_viscous, 0.00465);
  EXPECT_FALSE(m.kt_given);
  EXPECT_DOUBLE_EQ(tangential_stiffness(m), 2.0 / 7.0 * 1050.0);
  a.damping = b.damping = Damping::viscous;
  a.viscous_normal = 1.0;
  b.viscous_normal = 3.0;
  a.viscous_tangential = 2.0;
  b.viscous_tangential = 6.0;
  const Parameters v = mixture(a, b);
  EXPECT_DOUBLE_EQ(v.viscous_normal, 1.5);
  EXPECT_DOUBLE_EQ(v.viscous_tangential, 3.0);
}

TEST(Mixing, OneGivenTangentialStiffnessMeetsTheDefaultOfTheOther)
{
  Parameters a = full(), b = full();
  b.kt_given = true;
  b.kt = 600.0;    // and 2/7 700 = 200
  const Parameters m = mixture(a, b);
  EXPECT_TRUE(m.kt_given);
  EXPECT_DOUBLE_EQ(m.kt, 300.0);
  EXPECT_DOUBLE_EQ(mixture(b, a).kt, 300.0);
}

TEST(Mixing, TwistingNeedsBothTypes)
{
  Parameters a = full(), b = full();
  EXPECT_EQ(mixture(a, b).twisting, TwistingModel::none);
  a.twisting = TwistingModel::marshall;
  EXPECT_EQ(mixture(a, b).twisting, TwistingModel::none);
  EXPECT_EQ(mixture(b, a).twisting, TwistingModel::none);
  b.twisting = TwistingModel::marshall;
  EXPECT_EQ(mixture(a, b).twisting, TwistingModel::marshall);
}

TEST(Mixing, IsSymmetric)
{
  Random random(71);
  for (int k = 0; k < 500; k++) {
    Material a = any_material(random), b = any_material(random);
    b.p.damping = a.p.damping;
    b.p.rolling = a.p.rolling;
    b.p.bound = a.p.bound;
    const Parameters x = mixture(a.p, b.p), y = mixture(b.p, a.p);
    expect_same(x, y);
    if (HasFailure()) break;
  }
}

// conditions that hold for both types hold for the mixture, k2 >= k1 and k2 >= 2 k1, exactly in
// spite of rounding
TEST(Mixing, KeepsTheOrderOfStiffnesses)
{
  Random random(72);
  for (int k = 0; k < 20000; k++) {
    const double factor = random.chance(0.5) ? 1.0 : 2.0;
    Parameters a = full(), b = full();
    a.k1 = random.decades(-3.0, 9.0);
    b.k1 = random.decades(-3.0, 9.0);
    a.k2 = factor * a.k1 * (random.chance(0.5) ? 1.0 : 1.0 + random.uniform(0.0, 1e-15));
    b.k2 = factor * b.k1;
    const Parameters m = mixture(a, b);
    ASSERT_GE(m.k2, factor * m.k1);
    ASSERT_GE(m.k1, std::min(a.k1, b.k1) * (1.0 - 1e-15));
    ASSERT_LE(m.k1, std::max(a.k1, b.k1) * (1.0 + 1e-15));
  }
}

TEST(Mixing, ZeroOfOneIsZeroOfBoth)
{
  Parameters a = full(), b = full();
  b.k_adh = 0.0;
  b.f0 = 0.0;
  b.mu = 0.0;
  b.restitution = 0.0;
  const Parameters m = mixture(a, b);
  EXPECT_EQ(m.k_adh, 0.0);
  EXPECT_EQ(m.f0, 0.0);
  EXPECT_EQ(m.mu, 0.0);
  EXPECT_EQ(m.restitution, 0.0);
}

TEST(Mixing, OneWithoutRollingMixesToNone)
{
  Parameters a = full(), b = full();
  b.rolling = RollingModel::none;
  EXPECT_EQ(mixture(a, b).rolling, RollingModel::none);
  EXPECT_EQ(mixture(a, b).mu_r, 0.0);
  EXPECT_EQ(mixture(b, a).rolling, RollingModel::none);
}

TEST(Mixing, RefusesWhatItCanNot)
{
  Parameters a = full(), b = full(), mixed;
  mixed.k1 = 77.0;
  std::string why;
  b.damping = Damping::viscous;
  EXPECT_FALSE(mix(a, b, mixed, why));
  EXPECT_NE(why.find("restitution"), std::string::npos);
  EXPECT_NE(why.find("viscous"), std::string::npos);
  EXPECT_FALSE(mix(b, a, mixed, why));
  b = full();
  b.rolling = RollingModel::constant;
  why.clear();
  EXPECT_FALSE(mix(a, b, mixed, why));
  EXPECT_NE(why.find("rolling constant"), std::string::npos);
  EXPECT_NE(why.find("rolling sds"), std::string::npos);
  EXPECT_FALSE(mix(b, a, mixed, why));
  b = full();
  b.bound = FrictionBound::contact;
  EXPECT_FALSE(mix(b, a, mixed, why));
  EXPECT_EQ(why, "one has bound adhesive and the other bound contact");
  EXPECT_EQ(mixed.k1, 77.0);
}
}    // namespace mixing_test
