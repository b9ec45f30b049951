// SPDX-License-Identifier: GPL-2.0-only
// Limits of the laws: the linear spring, vanishing overlap, no friction, huge and tiny numbers.

#include "support.h"

namespace normal_limits_test {
using namespace eepa_test;

// k2 = k1, k_adh = f0 = 0: the linear spring-dashpot
TEST(Limits, ElasticLinearIsTheSpringDashpot)
{
  Material m = material(Law::linear, 1e3, 1e3, 0.0);
  m.p.damping = Damping::viscous;
  m.p.viscous_normal = 0.02;
  m.p.viscous_tangential = 0.01;
  m.p.mu = 100.0;
  Bodies b;
  b.v_i = Vec3(-0.2, 0.1, 0.0);
  History history;
  for (double overlap : {1e-6, 2e-5, 5e-6}) {
    b.overlap = overlap;
    const Vec3 before = history.tangential_spring;
    const Outcome out = evaluate(m, b, 1e-6, history);
    EXPECT_NEAR(out.normal_force, 1e3 * overlap + 0.02 * 0.2, 1e-15);
    const Vec3 spring = before + Vec3(0.0, 1e-7, 0.0);
    EXPECT_LT(deviation(out.tangential_force, -2.0 / 7.0 * 1e3 * spring - Vec3(0, 0.001, 0)),
              1e-13);
  }
}

// n -> 1 of the general exponent is the unit one, and n = 1 is taken by the unit one
TEST(Limits, GeneralExponentNearOne)
{
  Material unit = material(Law::linear, 1e3, 3e3, 2e3, -0.01);
  unit.p.kt_given = true;
  unit.p.kt = 300.0;
  Material general = unit;
  general.law.exponent = 1.0 + 1e-12;
  NormalPath a(unit), b(general);
  for (double overlap : {1e-5, 2e-5, 1.5e-5, 5e-6, 6e-6, 3e-5}) {
    const NormalForce f = a.to(overlap), g = b.to(overlap);
    EXPECT_NEAR(f.force, g.force, 1e-11);
    EXPECT_EQ(f.branch, g.branch);
    EXPECT_NEAR(a.energy(overlap), b.energy(overlap), 1e-15);
  }
}

// both laws agree for k2 = 2 k1, k_adh = 0 above delta_p, where (k1/k2) = (1 - k1/k2)
TEST(Limits, PlateauAndLinearCoincideForK2TwiceK1)
{
  NormalPath a(material(Law::plateau, 500.0, 1000.0, 0.0, -0.01));
  NormalPath b(material(Law::linear, 500.0, 1000.0, 0.0, -0.01));
  for (double overlap : {1e-5, 2e-5, 1.5e-5, 1.1e-5, 3e-5, 2e-5})
    EXPECT_DOUBLE_EQ(a.to(overlap).force, b.to(overlap).force);
}

TEST(Limits, VanishingOverlapLeavesThePullOffForce)
{
  for (Law law : {Law::plateau, Law::linear}) {
    NormalPath path(material(law, 1e3, 2e3, 1e3, -0.02));
    EXPECT_NEAR(path.to(1e-300).force, -0.02, 1e-18);
  }
  NormalPath general(material(Law::linear, 1e3, 2e3, 1e3, -0.02, 2.0));
  EXPECT_NEAR(general.to(1e-300).force, -0.02, 1e-18);
}

TEST(Limits, FrictionlessContactHasNoTangentialForceOrSpring)
{
  Material m = material(Law::linear, 1e3, 2e3, 1e3, -0.02);
  m.p.mu = 0.0;
  m.p.restitution = 0.5;
  Bodies b;
  b.v_i = Vec3(0.0, 0.3, 0.1);
  History history;
  const Outcome out = evaluate(m, b, 1e-6, history);
  EXPECT_EQ(out.tangential_force, Vec3(Vec3::Zero()));
  EXPECT_EQ(history.tangential_spring, Vec3(Vec3::Zero()));
  EXPECT_EQ(out.friction_bound, 0.0);
}

// m* = m_i m_j/(m_i + m_j); the particle's own against an infinite partner
TEST(Limits, EffectiveMassAndRadius)
{
  EXPECT_DOUBLE_EQ(effective_mass(2.0, 6.0), 1.5);
  EXPECT_EQ(effective_mass(2.0, infinity), 2.0);
  EXPECT_EQ(effective_mass(infinity, 3.0), 3.0);
  EXPECT_EQ(effective_mass(infinity, infinity), 0.0);
  EXPECT_DOUBLE_EQ(effective_radius(2.0, 6.0), 1.5);
  EXPECT_EQ(effective_radius(2.0, infinity), 2.0);
  EXPECT_EQ(effective_mass(5.0, 7.0), effective_mass(7.0, 5.0));
}

// a wall is the limit of ever larger and heavier partners
TEST(Limits, WallIsAnInfinitePartner)
{
  Material m = material(Law::linear, 1e3, 2e3, 1e3, -0.02);
  m.p.restitution = 0.3;
  m.p.rolling = RollingModel::constant;
  m.p.mu_r = 0.1;
  Bodies wall;
  wall.R_j = wall.m_j = infinity;
  wall.v_i = Vec3(-0.1, 0.2, 0.05);
  wall.w_i = Vec3(3.0, -20.0, 40.0);
  Bodies huge = wall;
  huge.R_j = 1e9;
  huge.m_j = 1e20;
  const Outcome a = evaluate(m, wall), b = evaluate(m, huge);
  EXPECT_LT(deviation(a.force, b.force), 1e-12);
  EXPECT_LT(deviation(a.torque_i, b.torque_i), 1e-12);
}
}    // namespace normal_limits_test
