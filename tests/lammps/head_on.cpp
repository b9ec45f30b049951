// SPDX-License-Identifier: GPL-2.0-only

// Head-on impacts against the closed forms of closed_forms.h.

#include "closed_forms.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

using namespace eepa_test;

namespace {

struct Case {
  const char *name;
  const char *law;    ///< plateau, luding, or linear with its exponent
  double k1, k2, k_adh, f0;
  double exponent;
  double speed;          ///< of approach
  double depth = 0.0;    ///< luding only
};

void PrintTo(const Case &c, std::ostream *out)
{
  *out << c.name;
}

std::string style_of(const Case &c)
{
  std::string style = c.law;
  if (c.exponent != 1.0) style += " exponent " + exact(c.exponent);
  return style + " dtcheck error";
}

std::string coefficients_of(const Case &c)
{
  return exact(c.k1) + " " + exact(c.k2) + " " + exact(c.k_adh) + " " + exact(c.f0) + " 0 kt 0" +
      (c.depth > 0.0 ? " depth " + exact(c.depth) : "");
}

/// \param reach  2 R_i R_j/(R_i + R_j), at a wall 2 R_i
HeadOn closed_form(const Case &c, double mass, double reach)
{
  const double energy = 0.5 * mass * c.speed * c.speed;
  if (c.depth > 0.0)
    return luding_impact(energy, c.k1, c.k2, c.k_adh, c.f0, c.k2 / (c.k2 - c.k1) * c.depth * reach);
  return std::string(c.law) == "plateau"
      ? plateau_impact(energy, c.k1, c.k2, c.k_adh, c.f0)
      : linear_impact(energy, c.k1, c.k2, c.k_adh, c.f0, c.exponent);
}

/// A step of 1/20,000 of a half period at the acting stiffness. The error of the scheme is of
/// second order in it; the error of the jumps of force at delta = 0 and at the plateau is of first
/// order, times pi.
double time_step(const Case &c, double mass, double max_overlap)
{
  const double stiffness = c.k2 * std::pow(max_overlap, c.exponent - 1.0);
  return pi * std::sqrt(mass / stiffness) / 20000.0;
}

class HeadOnImpact : public testing::TestWithParam<Case> {
 protected:
  /// Runs until the contact must be over; 5 half periods of the softest branch suffice.
  void pass(Simulation &simulation, double mass, const HeadOn &expected)
  {
    const Case &c = GetParam();
    const double dt = time_step(c, mass, expected.max_overlap);
    simulation("timestep " + exact(dt));
    const double softest = std::min(c.k1, c.k_adh > 0.0 ? c.k_adh : c.k1) *
        std::pow(expected.max_overlap, c.exponent - 1.0);
    const double longest = 5.0 * pi * std::sqrt(mass / softest);
    simulation.run(static_cast<int>(longest / dt));
  }
};

TEST_P(HeadOnImpact, OfTwoParticles)
{
  const Case &c = GetParam();
  const Sphere light{Vec3(-0.5 - 1e-9, 0, 0), Vec3(0.75 * c.speed, 0, 0)};
  const Sphere heavy{Vec3(0.75, 0, 0), Vec3(-0.25 * c.speed, 0, 0), Vec3::Zero(), 0.75};
  const double m1 = mass_of(light), m2 = mass_of(heavy);
  const double mass = m1 * m2 / (m1 + m2);
  const double reach = 2.0 * light.radius * heavy.radius / (light.radius + heavy.radius);
  const HeadOn expected = closed_form(c, mass, reach);

  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({light, heavy});
  simulation("pair_style gran/eepa " + style_of(c) + "\npair_coeff 1 1 " + coefficients_of(c) +
             "\nfix integrate all nve/sphere");
  simulation.watch_contacts();
  pass(simulation, mass, expected);

  const auto particles = simulation.particles();
  if (expected.sticks) {
    ASSERT_EQ(simulation.contacts().size(), 1u);
    // they move on together with the velocity of the centre of mass
    const double centre = (m1 * light.v.x() + m2 * heavy.v.x()) / (m1 + m2);
    EXPECT_NEAR((m1 * particles[0].v.x() + m2 * particles[1].v.x()) / (m1 + m2), centre, 1e-12);
  } else {
    EXPECT_TRUE(simulation.contacts().empty());
    EXPECT_NEAR((particles[1].v.x() - particles[0].v.x()) / c.speed, expected.restitution, 1e-3);
  }
}

TEST_P(HeadOnImpact, OnAWall)
{
  const Case &c = GetParam();
  const Sphere sphere{Vec3(-0.5 - 1e-9, 0, 0), Vec3(c.speed, 0, 0)};
  const double mass = mass_of(sphere);
  const HeadOn expected = closed_form(c, mass, 2.0 * sphere.radius);

  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({sphere});
  simulation("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\n"
             "fix wall all wall/gran/eepa " +
             style_of(c) + " coeff " + coefficients_of(c) + " wall xplane NULL 0.0");
  pass(simulation, mass, expected);

  const double v = simulation.particle(1).v.x();
  if (expected.sticks) {
    EXPECT_EQ(simulation.fix("wall", 6), 1.0);
  } else {
    EXPECT_EQ(simulation.fix("wall", 6), 0.0);
    EXPECT_NEAR(-v / c.speed, expected.restitution, 1e-3);
  }
}

const Case cases[] = {
    {"linear_elastic", "linear", 1e4, 1e4, 0, 0, 1.0, 1.0},
    {"linear_plastic", "linear", 1e4, 4e4, 0, 0, 1.0, 1.0},
    {"linear_adhesive", "linear", 1e4, 2e4, 5e3, 0, 1.0, 1.0},
    {"linear_f0", "linear", 1e4, 2e4, 5e3, -10, 1.0, 1.0},
    {"linear_elastic_f0", "linear", 1e4, 1e4, 0, -30, 1.0, 1.0},
    {"linear_sticks", "linear", 1e4, 3e4, 2e4, 0, 1.0, 1.0},
    {"linear_f0_sticks", "linear", 1e4, 2e4, 5e3, -60, 1.0, 0.5},
    {"exponent_plastic", "linear", 1e5, 3e5, 0, 0, 1.5, 1.0},
    {"exponent_adhesive", "linear", 1e5, 2e5, 5e4, -5, 1.5, 1.0},
    {"exponent_2", "linear", 1e6, 2e6, 2e5, 0, 2.0, 1.0},
    {"luding_plastic", "luding", 1e4, 4e4, 0, 0, 1.0, 1.0, 0.05},
    {"luding_adhesive", "luding", 1e4, 4e4, 5e3, 0, 1.0, 1.0, 0.03},
    {"luding_f0", "luding", 1e4, 4e4, 5e3, -10, 1.0, 1.0, 0.03},
    {"luding_slow_f0_sticks", "luding", 1e4, 4e4, 0, -30, 1.0, 0.05, 0.03},
    {"luding_sticks", "luding", 1e4, 4e4, 2e4, 0, 1.0, 1.0, 0.012},
    {"luding_beyond_the_limit", "luding", 1e4, 4e4, 5e3, -10, 1.0, 1.0, 0.003},
    {"luding_fast_with_adhesion", "luding", 1e4, 4e4, 2e4, 0, 1.0, 1.0, 0.001},
    {"plateau_plastic", "plateau", 1e4, 2e4, 0, 0, 1.0, 1.0},
    {"plateau_adhesive", "plateau", 1e4, 2e4, 5e3, 0, 1.0, 1.0},
    {"plateau_late_unloading", "plateau", 1e4, 4e4, 5e3, 0, 1.0, 1.0},
    {"plateau_f0", "plateau", 1e4, 2e4, 5e3, -10, 1.0, 1.0},
    {"plateau_without_plateau", "plateau", 1e4, 4e4, 6e4, 0, 1.0, 1.0},
    {"plateau_sticks", "plateau", 1e4, 2e4, 1.9e4, 0, 1.0, 1.0},
};
INSTANTIATE_TEST_SUITE_P(Laws, HeadOnImpact, testing::ValuesIn(cases), [](const auto &info) {
  return std::string(info.param.name);
});

// The published formula itself, as a check of closed_forms.h.
TEST(HeadOnFormula, LinearIsTheOneOfTheIssue)
{
  const double k1 = 1e4, k2 = 2e4, k_adh = 5e3;
  const double square = k1 / k2 - (k_adh / k1) * (k2 - k1) * (k2 - k1) / (k2 * (k2 + k_adh));
  EXPECT_NEAR(linear_impact(0.3, k1, k2, k_adh, 0.0).restitution, std::sqrt(square), 1e-14);
  EXPECT_TRUE(linear_impact(0.3, 1e4, 3e4, 2e4, 0.0).sticks);
}

// Restitution damping: B_n = sqrt(4 m* k1/(1 + (pi/ln e)^2)) gives e for the linear
// spring-dashpot whose contact ends at delta = 0, for any masses.
class Dashpot : public testing::TestWithParam<double> {};

TEST_P(Dashpot, GivesItsRestitutionBetweenParticles)
{
  const double e = GetParam();
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({{Vec3(-0.5 - 1e-9, 0, 0), Vec3(1, 0, 0)},
                     {Vec3(0.25, 0, 0), Vec3(0, 0, 0), Vec3::Zero(), 0.25}});
  simulation("pair_style gran/eepa linear\npair_coeff 1 1 1e4 1e4 0 0 0 restitution " + exact(e) +
             "\nfix integrate all nve/sphere\ntimestep 1e-6");
  simulation.run(60000);
  const auto particles = simulation.particles();
  // 1e-3: a step of 1e-6 in a half period of 1e-2, and a jump of B_n v at the end
  EXPECT_NEAR(particles[1].v.x() - particles[0].v.x(), e, 1e-3);
}

TEST_P(Dashpot, GivesItsRestitutionAtAWall)
{
  const double e = GetParam();
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, 0.5 + 1e-9), Vec3(0, 0, -1)}});
  simulation("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\ntimestep 1e-6\n"
             "fix wall all wall/gran/eepa linear coeff 1e4 1e4 0 0 0 restitution " +
             exact(e) + " wall zplane 0 NULL");
  simulation.run(60000);
  EXPECT_NEAR(simulation.particle(1).v.z(), e, 1e-3);
}

TEST_P(Dashpot, WithoutTensionGivesMore)
{
  const double e = GetParam();
  const double b = std::sqrt(4.0 * 1e4 / (1.0 + std::pow(pi / std::log(e), 2)));
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, 0.5 + 1e-9), Vec3(0, 0, -1)}});
  simulation("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\ntimestep 1e-6\n"
             "fix wall all wall/gran/eepa linear limit_damping yes coeff 1e4 1e4 0 0 0 "
             "restitution " +
             exact(e) + " wall zplane 0 NULL");
  simulation.run(100000);
  EXPECT_NEAR(simulation.particle(1).v.z(), restitution_without_tension(1.0, 1e4, b), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Restitutions, Dashpot, testing::Values(0.9, 0.5, 0.1));

}    // namespace
