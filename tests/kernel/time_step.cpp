// SPDX-License-Identifier: GPL-2.0-only
// Time step (contract, section 2): dt < 0.2 sqrt(m_min/k_max), over all contacts after scaling.

#include "support.h"

namespace time_step_test {
using namespace eepa_test;

TEST(TimeStep, Bound)
{
  EXPECT_DOUBLE_EQ(largest_time_step(4.0, 1.0), 0.4);
  EXPECT_DOUBLE_EQ(largest_time_step(1e-6, 1e4), 2e-6);
}

double stiffness(const Material &m, double size)
{
  return largest_stiffness(resolve(m.p, m.law), size);
}

TEST(TimeStep, LargestStiffnessOfAnyBranchAndDirection)
{
  Material m = material(Law::linear, 1e3, 3e3, 2e3);
  EXPECT_DOUBLE_EQ(stiffness(m, 1e-3), 3e3);
  m.p.k_adh = 7e3;
  EXPECT_DOUBLE_EQ(stiffness(m, 1e-3), 7e3);
  m.p.kt_given = true;
  m.p.kt = 9e3;
  EXPECT_DOUBLE_EQ(stiffness(m, 1e-3), 3.5 * 9e3);    // it turns the spheres too
  m.p.rolling = RollingModel::sds;
  m.p.kr = 2e4;
  EXPECT_DOUBLE_EQ(stiffness(m, 1e-3), 2.5 * 2e4);
}

TEST(TimeStep, MassOfASphere)
{
  EXPECT_DOUBLE_EQ(sphere_mass(2.0, 3.0), 4.0 * std::acos(-1.0));
  EXPECT_DOUBLE_EQ(sphere_mass(0.5, 3.0), std::acos(-1.0) / 16.0);
}

TEST(TimeStep, StiffnessScalesWithSize)
{
  Material m = material(Law::plateau, 1e3, 3e3, 2e3);
  scale_with_diameter(m, 1e-3);
  EXPECT_DOUBLE_EQ(stiffness(m, 4e-3), 12e3);
  m.p.kt_given = true;
  m.p.kt = 9e3;
  EXPECT_DOUBLE_EQ(stiffness(m, 4e-3), 3.5 * 36e3);
}

// n != 1: the tangent n k delta^(n-1) at the documented overlap of 5% of the contact's size
TEST(TimeStep, TangentStiffnessOfAnExponent)
{
  for (double n : {1.2, 1.5, 2.0}) {
    Material m = material(Law::linear, 1e6, 3e6, 2e6, 0.0, n);
    m.p.kt = 1.0;
    const double d = 4e-3, tangent = n * 3e6 * std::pow(0.05 * d, n - 1.0);
    EXPECT_NEAR(stiffness(m, d) / tangent, 1.0, 1e-14);
    scale_with_diameter(m, 1e-3);
    EXPECT_NEAR(stiffness(m, d) / (std::pow(4.0, 2.0 - n) * tangent), 1.0, 1e-14);
  }
}

// the bound of similar particles is in proportion to their size
TEST(TimeStep, GoesWithSizeUnderScaling)
{
  Random random(81);
  for (int k = 0; k < 200; k++) {
    Material m = any_material(random);
    if (!m.law.scaled) continue;
    const double small = largest_time_step(1e-6, stiffness(m, 1e-3));
    EXPECT_EQ(largest_time_step(8e-6, stiffness(m, 2e-3)), 2.0 * small);
  }
}

// an undamped oscillation on the stiffest branch stays bounded at the largest step
TEST(TimeStep, VelocityVerletIsStableAtTheBound)
{
  const Material m = material(Law::linear, 1e3, 1e3, 0.0, -0.02);
  NormalPath path(m);
  const double mass = 1e-6, dt = largest_time_step(mass, stiffness(m, 1e-3));
  double x = 2.5e-5, v = 0.0, most = 0.0;    // about the rest overlap |f0|/k1 = 2e-5
  for (int k = 0; k < 100000; k++) {
    v += 0.5 * dt * path.to(x).force / mass;
    x -= dt * v;
    v += 0.5 * dt * path.to(x).force / mass;
    most = std::max(most, x);
  }
  EXPECT_LT(most, 2.52e-5);
}
}    // namespace time_step_test
