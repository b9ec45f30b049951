// SPDX-License-Identifier: GPL-2.0-only
// Coefficients resolved from parameters of which some are not given, and defaults of parameters.

#include "support.h"

namespace coefficients_test {
using namespace eepa_test;

Coefficients resolved(const Material &m)
{
  return resolve(m.p, m.law);
}

// by default no parameter gives a force, each tested alone
TEST(Parameters, AreNothingByDefault)
{
  const Parameters p;
  for (const double value : {p.k1, p.k2, p.k_adh, p.f0, p.mu, p.depth, p.kt, p.viscous_normal,
                             p.viscous_tangential, p.mu_r, p.kr, p.rolling_viscous})
    EXPECT_EQ(value, 0.0);
  EXPECT_EQ(p.restitution, 1.0);
  EXPECT_FALSE(p.kt_given);
  const LawSettings s;
  EXPECT_EQ(s.exponent, 1.0);
  EXPECT_EQ(s.reference_diameter, 1.0);
  EXPECT_FALSE(s.scaled);
  EXPECT_FALSE(s.limit_damping);
}

TEST(Coefficients, OfNoTangentialOrRollingSpringHaveNoInverse)
{
  Material m = material(Law::linear, 1e3, 2e3, 5e2);
  m.p.kt_given = true;
  m.p.rolling = RollingModel::sds;
  EXPECT_EQ(resolved(m).inverse_kt, 0.0);
  EXPECT_EQ(resolved(m).inverse_kr, 0.0);
  m.p.kt = 0.5;
  m.p.kr = 0.25;
  EXPECT_EQ(resolved(m).inverse_kt, 2.0);
  EXPECT_EQ(resolved(m).inverse_kr, 4.0);
}

TEST(Coefficients, OfAnElasticContactRememberNoAdhesion)
{
  for (const double n : {1.0, 1.5}) {
    const Coefficients c = resolved(material(Law::linear, 1e3, 1e3, 5e2, 0.0, n));
    EXPECT_EQ(c.adhesive_memory, 1.0);
    EXPECT_EQ(c.loading_loss, 0.0);
    EXPECT_EQ(c.adhesive_loss, 0.0);
  }
  EXPECT_EQ(resolved(material(Law::plateau, 1e3, 2e3, 5e2)).adhesive_memory, 1.0);
}

// given, but not of the model that was chosen
TEST(Coefficients, OfAnotherRollingModelAreLeftOut)
{
  Material m = material(Law::linear, 1e3, 2e3, 5e2);
  m.p.mu_r = 0.1;
  m.p.kr = 300.0;
  m.p.rolling_viscous = 0.2;
  Coefficients c = resolved(m);
  EXPECT_EQ(c.mu_r, 0.0);
  m.p.rolling = RollingModel::constant;
  c = resolved(m);
  EXPECT_EQ(c.mu_r, 0.1);
  EXPECT_EQ(c.kr, 0.0);
  EXPECT_EQ(c.inverse_kr, 0.0);
  EXPECT_EQ(c.rolling_viscous, 0.0);
}

// in units in which particles are larger than 1 as well
TEST(Coefficients, ScaleWithAnyReferenceDiameter)
{
  Material m = material(Law::linear, 1e3, 2e3, 5e2);
  for (const double reference : {0.125, 4.0}) {
    scale_with_diameter(m, reference);
    const Scale s = contact_scale(resolved(m), 8.0);
    EXPECT_EQ(s.stiffness(), 8.0 / reference);
    EXPECT_EQ(s.force(), 64.0 / reference / reference);
    EXPECT_EQ(s.inverse_size, reference / 8.0);
  }
}

TEST(Coefficients, PowersOfBothExponentsHaveTheirSlope)
{
  Material m = material(Law::linear, 1e3, 2e3, 5e2, 0.0, 1.5);
  const Coefficients c = resolved(m);
  const Scale one;
  const double h = 1e-6;
  EXPECT_NEAR(GeneralExponent::slope(0.3, c, one),
              (GeneralExponent::power(0.3 + h, c, one) - GeneralExponent::power(0.3 - h, c, one)) /
                  (2.0 * h),
              1e-9);
}

}    // namespace coefficients_test
