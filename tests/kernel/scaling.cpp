// SPDX-License-Identifier: GPL-2.0-only
// Scaling (contract, section 2): k1, k2, k_adh, kt x d/d_ref (k: 2 - n for an exponent n), B and f0
// x (d/d_ref)^2; d = R_i + R_j, at a wall 2 R_i. Consequence: all lengths and times x s at kept
// density and velocity give forces x s^2, torques and energies x s^3, for s = 2 to the last bit.

#include "support.h"

namespace scaling_test {
using namespace eepa_test;

Bodies larger(const Bodies &b, double s)
{
  Bodies c = b;
  c.R_i *= s;
  c.R_j *= s;
  c.m_i *= s * s * s;
  c.m_j *= s * s * s;
  c.overlap *= s;
  c.w_i /= s;
  c.w_j /= s;
  return c;
}

Material any_scaled(Random &random, double exponent)
{
  while (true) {
    Material m = any_material(random);
    if (!m.law.scaled) continue;
    const bool general = m.law.law == Law::linear && m.law.exponent != 1.0;
    if (exponent == 1.0 && !general) return m;
    if (exponent != 1.0 && general) {
      m.law.exponent = exponent;
      return m;
    }
  }
}

/// Paths of a small and a large contact side by side; the largest deviation from similarity.
double worst_deviation(double s, double exponent, unsigned seed)
{
  Random random(seed);
  double worst = 0.0;
  for (int k = 0; k < 200; k++) {
    const Material m = any_scaled(random, exponent);
    Bodies b = any_bodies(random);
    History small, large;
    const double dt = 1e-6;
    for (int step = 0; step < 30; step++) {
      any_motion(random, b);
      b.overlap = 0.05 * std::min(b.R_i, b.R_j) * random.uniform(0.001, 1.0);
      const Outcome x = evaluate(m, b, dt, small);
      const Outcome y = evaluate(m, larger(b, s), s * dt, large);
      EXPECT_EQ(x.branch, y.branch);
      EXPECT_EQ(x.sliding, y.sliding);
      const double f = s * s, t = f * s;
      // next to delta_p force and energy are small differences of values at delta_max
      const double peak = s == 2.0
          ? 0.0
          : NormalPath(m, s * b.size()).at(large.max_overlap).force * m.p.k2 / m.p.k1;
      const double force = y.force.norm() + y.friction_bound + std::fabs(peak);
      const double moment = force * s * b.R_i, whole = force * large.max_overlap;
      // a spring reset behind its dashpot is the small difference of two forces
      const Coefficients c = resolve(m.p, m.law);
      const double stretch = s == 2.0 ? 0.0 : force * c.inverse_kt,
                   roll = s == 2.0 ? 0.0 : force * c.inverse_kr;
      worst =
          std::max({worst, deviation(f * x.hysteretic_force, y.hysteretic_force, force),
                    deviation(f * x.friction_bound, y.friction_bound, force),
                    deviation(Vec3(f * x.force), y.force, force),
                    deviation(Vec3(t * x.torque_i), y.torque_i, moment),
                    deviation(Vec3(t * x.torque_j), y.torque_j, moment),
                    deviation(t * x.energy.normal, y.energy.normal, whole),
                    deviation(t * x.energy.tangential, y.energy.tangential, stretch * force),
                    deviation(t * x.energy.rolling, y.energy.rolling, roll * force),
                    deviation(t * x.lost.total(), y.lost.total(), whole),
                    deviation(s * small.max_overlap, large.max_overlap),
                    deviation(Vec3(s * small.tangential_spring), large.tangential_spring, stretch),
                    deviation(Vec3(s * small.rolling_spring), large.rolling_spring, roll)});
      if (s != 2.0) {
        // one step is compared, not the growth of rounding
        large.max_overlap = s * small.max_overlap;
        large.tangential_spring = s * small.tangential_spring;
        large.rolling_spring = s * small.rolling_spring;
      }
    }
  }
  return worst;
}

TEST(Scaling, TwiceTheSizeIsSimilarToTheLastBit)
{
  EXPECT_EQ(worst_deviation(2.0, 1.0, 61), 0.0);
}

TEST(Scaling, TwiceTheSizeIsSimilarToTheLastBitForAnExponent)
{
  for (double n : {1.1, 1.5, 2.0}) EXPECT_EQ(worst_deviation(2.0, n, 62), 0.0) << n;
}

TEST(Scaling, AnyOtherSizeIsSimilarToRounding)
{
  for (double n : {1.0, 1.5, 2.0}) EXPECT_LT(worst_deviation(1.7, n, 63), 1e-12) << n;
}

// The powers of s in the table of parameters are those of the laws: a contact of the size s d_ref is that
// of parameters which were multiplied by their powers.
TEST(Scaling, MultipliesEveryParameterByItsPower)
{
  Random random(64);
  double worst = 0.0;
  for (int k = 0; k < 300; k++) {
    Material m = any_material(random);
    Bodies b = any_bodies(random);
    const double s = random.decades(-1.0, 1.0);
    scale_with_diameter(m, b.size() / s);
    Material plain = m;
    plain.law.scaled = false;
    for_each_number([&](const Number &number) {
      plain.p.*number.member *= std::pow(s, number.dimension.power(m.law.exponent));
    });
    any_motion(random, b);
    for (double share : {0.001, 0.05, 0.04, 0.01}) {
      History history;
      history.max_overlap = 0.06 * share * std::min(b.R_i, b.R_j);
      History again = history;
      b.overlap = share * std::min(b.R_i, b.R_j);
      const Outcome x = evaluate(m, b, 1e-6, history);
      const Outcome y = evaluate(plain, b, 1e-6, again);
      const double force = x.force.norm() + x.friction_bound;
      worst = std::max({worst, deviation(x.force, y.force, force),
                        deviation(x.torque_i, y.torque_i, force * b.R_i),
                        deviation(x.friction_bound, y.friction_bound, force)});
    }
  }
  EXPECT_LT(worst, 1e-11);
}

TEST(Scaling, CoefficientsOfALargerContact)
{
  for (double n : {1.0, 1.5, 2.0}) {
    const double reference = 2e-3, d = 6e-3, s = d / reference, overlap = 1e-5;
    Material m = material(Law::linear, 1e3, 3e3, 2e3, -0.002, n);
    scale_with_diameter(m, reference);
    NormalPath path(m, d);
    const double k = std::pow(s, 2.0 - n), f0 = -0.002 * s * s, power = std::pow(overlap, n);
    EXPECT_NEAR(path.to(overlap).force, f0 + 1e3 * k * power, 1e-14);
    const double p = power * (1.0 - 1.0 / 3.0);
    EXPECT_NEAR(path.at(0.9 * overlap).force, f0 + 3e3 * k * (std::pow(0.9 * overlap, n) - p),
                1e-14);
    EXPECT_NEAR(path.at(0.1 * overlap).force, f0 - 2e3 * k * std::pow(0.1 * overlap, n), 1e-14);
  }
}

TEST(Scaling, OffWithoutAReferenceDiameter)
{
  const Material m = material(Law::linear, 1e3, 3e3, 2e3, -0.002);
  NormalPath small(m, 1e-4), large(m, 1e2);
  for (double x : {1e-5, 8e-6, 1e-6}) EXPECT_EQ(small.to(x).force, large.to(x).force);
  const Coefficients c = resolve(m.p, m.law);
  EXPECT_EQ(contact_scale(c, 7.0).size, 1.0);
  EXPECT_EQ(contact_scale(c, 7.0).inverse_size, 1.0);
}

TEST(Scaling, ReferenceDiameterItselfChangesNothing)
{
  Material m = material(Law::linear, 1e3, 3e3, 2e3, -0.002);
  NormalPath plain(m, 2e-3);
  scale_with_diameter(m, 2e-3);
  NormalPath scaled(m, 2e-3);
  for (double x : {1e-5, 8e-6, 1e-6}) EXPECT_DOUBLE_EQ(plain.to(x).force, scaled.to(x).force);
}

TEST(Scaling, ScaleOfForcesAndStiffnesses)
{
  Material m = material(Law::linear, 1e3, 3e3, 2e3);
  scale_with_diameter(m, 0.5);
  const Scale scale = contact_scale(resolve(m.p, m.law), 1.5);
  EXPECT_EQ(scale.stiffness(), 3.0);
  EXPECT_EQ(scale.force(), 9.0);
  EXPECT_DOUBLE_EQ(scale.inverse_size, 1.0 / 3.0);
}
}    // namespace scaling_test
