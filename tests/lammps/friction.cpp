// SPDX-License-Identifier: GPL-2.0-only

// Oblique impacts, sliding and rolling of one sphere, against closed forms.

#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

constexpr double radius = 0.5, mass = 1.0;
constexpr double inertia = 0.4 * mass * radius * radius;

/// A sphere of mass 1 and radius 1/2 above the plane z = 0, without partners.
void open_plane(Simulation &simulation, const Sphere &sphere, const std::string &coefficients,
                double time_step, double half = 10.0)
{
  simulation.open_box(half);
  simulation.create({sphere});
  simulation("pair_style zero 1.0\npair_coeff * *\ntimestep " + exact(time_step) +
             "\nfix floor all wall/gran/eepa linear coeff " + coefficients + " wall zplane 0 NULL");
}

// Sliding throughout: the tangential impulse is mu times the normal one, J = 2 m v_n of an elastic
// contact. Its moment is mu times the integral of f_n (R - delta/2): with f_n = k delta and
// delta = D sin(omega t) it is mu J (R - pi D/8).
TEST(ObliqueImpact, SlidingThroughoutChangesVelocityAndSpinByMuTimesTheImpulse)
{
  const double k = 1e5, mu = 0.1, v_n = 1.0, v_t = 3.0;
  Simulation simulation;
  // slides at once and to the end: kt v_t = 2/7 k 3 > mu k v_n, and v_t only falls to 2.3
  open_plane(simulation, {Vec3(0, 0, radius + 1e-9), Vec3(0.6 * v_t, 0.8 * v_t, -v_n)},
             "1e5 1e5 0 0 0.1", 1e-6);
  simulation("fix integrate all nve/sphere");
  simulation.run(15000);    // the contact lasts pi sqrt(m/k) = 9.9e-3
  const Particle p = simulation.particle(1);
  const double impulse = 2.0 * mass * v_n;
  const double depth = v_n * std::sqrt(mass / k);
  EXPECT_NEAR(p.v.z(), v_n, 1e-6);
  // 1e-5: the winding of the spring in the first step and (omega dt)^2
  EXPECT_NEAR(p.v.x(), 0.6 * (v_t - mu * impulse / mass), 1e-5);
  EXPECT_NEAR(p.v.y(), 0.8 * (v_t - mu * impulse / mass), 1e-5);
  const double spin = mu * impulse * (radius - pi * depth / 8.0) / inertia;
  // moving to +x on a floor the sphere is spun about +y, as a wheel
  EXPECT_NEAR(p.omega.y(), 0.6 * spin, 1e-5 * spin);
  EXPECT_NEAR(p.omega.x(), -0.8 * spin, 1e-5 * spin);
  EXPECT_NEAR(p.omega.z(), 0.0, 1e-12);
}

// Without slip the tangential spring oscillates at omega_t^2 = kt (1/m + a^2/I) during half a
// period of the normal one: the final slip velocity is s cos(pi omega_t/omega_n).
TEST(ObliqueImpact, StickingThroughoutTurnsTheSlipVelocityByTheSpringsPhase)
{
  for (const double ratio : {0.1, 2.0 / 7.0}) {
    const double k = 1e7, v_n = 1.0, v_t = 0.5;
    Simulation simulation;
    open_plane(simulation, {Vec3(0, 0, radius + 1e-9), Vec3(v_t, 0, -v_n)},
               "1e7 1e7 0 0 1e6 kt " + exact(ratio * k), 1e-7);
    simulation("fix integrate all nve/sphere");
    simulation.run(15000);
    const Particle p = simulation.particle(1);
    const double phase = pi * std::sqrt(3.5 * ratio);
    // 3e-4: arm and overlap, D/R = 6e-4
    const double impulse = mass * (2.0 / 7.0) * v_t * (1.0 - std::cos(phase));
    EXPECT_NEAR(p.v.x(), v_t - impulse / mass, 3e-4 * v_t);
    EXPECT_NEAR(p.omega.y() * radius, impulse * radius * radius / inertia, 1e-3 * v_t);
  }
}

TEST(ObliqueImpact, OfTwoSpheresSharesTheImpulseByMass)
{
  // a small sphere of 1/8 of the mass: mu (1 + e) m* v_n changes both tangential momenta
  const Sphere large{Vec3(0, 0, 0), Vec3(0, 0, 0)};
  const Sphere small{Vec3(0.75 + 1e-9, 0, 0), Vec3(-1, 3, 0), Vec3::Zero(), 0.25};
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({large, small});
  simulation("pair_style gran/eepa linear\npair_coeff 1 1 1e5 1e5 0 0 0.1\n"
             "fix integrate all nve/sphere\ntimestep 1e-6");
  simulation.run(6000);
  const double m1 = mass_of(large), m2 = mass_of(small), reduced = m1 * m2 / (m1 + m2);
  const double impulse = 2.0 * reduced;
  const auto p = simulation.particles();
  // 2e-2: the line of centres turns while they slide, by 3 v_t pi/omega/(R1 + R2) at most
  EXPECT_NEAR(p[1].v.y(), 3.0 - 0.1 * impulse / m2, 2e-2);
  EXPECT_NEAR(p[0].v.y(), 0.1 * impulse / m1, 2e-2);
  EXPECT_NEAR(p[0].omega.z() * 0.4 * m1 * 0.25, 0.1 * impulse * 0.5, 1e-3);
  EXPECT_NEAR(p[1].omega.z() * 0.4 * m2 * 0.0625, 0.1 * impulse * 0.25, 1e-3);
  EXPECT_GT(p[1].omega.z(), 0.0);    // both gears turn the same way
}

class AngularMomentum : public testing::TestWithParam<const char *> {};

// The arms of a contact add up to the distance of the centres, and forces act at the positions for
// which momenta are taken: spin plus orbital angular momentum is kept to rounding.
TEST_P(AngularMomentum, IsKeptInAnObliqueCollision)
{
  Simulation simulation;
  simulation.open_box(5.0);
  simulation.create(
      {{Vec3(0.3, -0.2, 0.1), Vec3(1, 0.2, -0.4), Vec3(3, -2, 5)},
       {Vec3(1.2, 0.25, 0.4), Vec3(-1.5, 0.1, 0.3), Vec3(-1, 4, 2), 0.55, 2.0 * unit_density}});
  simulation(std::string("pair_style gran/eepa ") + GetParam() +
             "\nfix integrate all nve/sphere\ntimestep 2e-5\nrun 0 post no");
  Vec3 before = Vec3::Zero(), linear_before = Vec3::Zero();
  for (const auto &p : simulation.particles()) before += p.angular_momentum();
  for (const auto &p : simulation.particles()) linear_before += p.mass * p.v;
  double touched = 0.0;
  for (int k = 0; k < 10; k++) {
    simulation.run(300);
    Vec3 now = Vec3::Zero(), linear = Vec3::Zero();
    for (const auto &p : simulation.particles()) {
      now += p.angular_momentum();
      linear += p.mass * p.v;
      touched = std::max(touched, p.torque.norm());
    }
    EXPECT_LT((now - before).norm(), 1e-12 * before.norm());
    EXPECT_LT((linear - linear_before).norm(), 1e-12 * linear_before.norm());
  }
  EXPECT_GT(touched, 1e-3);    // contacts did change spins
}
INSTANTIATE_TEST_SUITE_P(
    Laws, AngularMomentum,
    testing::Values("linear\npair_coeff 1 1 1e4 2e4 5e3 -1 0.5 restitution 0.8",
                    "plateau scale 0.5\npair_coeff 1 1 1e4 2e4 5e3 -1 0.5 restitution 0.8",
                    "linear\npair_coeff 1 1 1e4 2e4 5e3 0 0.5 rolling constant 0.1",
                    "linear exponent 1.5\n"
                    "pair_coeff 1 1 1e5 2e5 5e4 0 0.5 kt 5e3 rolling sds 1e3 1 0.1"));

// A block: the sphere is kept from turning by fix nve. In equilibrium under gravity the normal
// force is m g, and once the spring is wound the deceleration mu g, exactly.
TEST(Sliding, BlockDeceleratesAtMuGAndStops)
{
  const double g = 10.0, mu = 0.3, k = 1e5;
  Simulation simulation;
  open_plane(simulation, {Vec3(0, 0, radius - mass * g / k), Vec3(1, 0, 0)},
             "1e5 1e5 0 0 0.3 restitution 0.3", 1e-5);
  simulation("fix gravity all gravity 10 vector 0 0 -1\nfix integrate all nve");
  simulation.run(2000);
  const double early = simulation.particle(1).v.x();
  simulation.run(10000);
  const double late = simulation.particle(1).v.x();
  EXPECT_NEAR((early - late) / 0.1, mu * g, 1e-9 * mu * g);
  EXPECT_NEAR(simulation.particle(1).f.x(), -mu * mass * g, 1e-9);
  simulation.run(70000);
  const Particle rest = simulation.particle(1);
  // v^2/(2 mu g); the spring that winds up first takes mu m g/kt = 1e-4 of it
  EXPECT_NEAR(rest.x.x(), 1.0 / (2.0 * mu * g), 2e-4);
  simulation.run(20000);
  const Particle later = simulation.particle(1);
  EXPECT_LT(later.v.norm(), 1e-9);
  EXPECT_NEAR(later.x.x(), rest.x.x(), 1e-9);
}

// A sphere that starts sliding rolls in the end; the angular momentum about the contact is kept,
// so that v = v0/(1 + I/(m a^2)), 5/7 v0 for a = R, whatever mu.
TEST(Sliding, SphereEndsUpRollingAtFiveSeventhsOfItsVelocity)
{
  const double g = 10.0, k = 1e5, delta = mass * g / k;
  for (const char *mu : {"0.2", "0.6"}) {
    Simulation simulation;
    open_plane(simulation, {Vec3(0, 0, radius - delta), Vec3(1, 0, 0)},
               std::string("1e5 1e5 0 0 ") + mu + " restitution 0.1", 1e-5);
    simulation("fix gravity all gravity 10 vector 0 0 -1\nfix integrate all nve/sphere");
    simulation.run(2000);
    EXPECT_NEAR((1.0 - simulation.particle(1).v.x()) / 0.02, std::stod(mu) * g, 0.02 * g);
    simulation.run(40000);
    const Particle p = simulation.particle(1);
    const double arm = radius - 0.5 * delta;
    // 1e-8: the spring's oscillation after damping with e = 0.1 for 0.3 s
    EXPECT_NEAR(p.v.x(), 1.0 / (1.0 + inertia / (mass * arm * arm)), 1e-8);
    EXPECT_NEAR(p.v.x(), 5.0 / 7.0, 2e-4);
    EXPECT_NEAR(p.omega.y() * arm, p.v.x(), 1e-8);
    EXPECT_LT(p.f.head<2>().norm(), 1e-6);    // free rolling: no friction left
  }
}

// B_t is B_n with kt instead of k1: sqrt(4 m* kt/(1 + (pi/ln e)^2)). In a set-up call no spring is
// wound, and with unlimited friction only the dashpot acts in the tangent plane.
TEST(TangentialDashpot, IsThatOfTheRestitutionWithTheTangentialStiffness)
{
  const double e = 0.4, kt = 3e3, v = 0.7;
  const double factor = std::sqrt(4.0 * kt / (1.0 + std::pow(pi / std::log(e), 2)));
  for (const std::string exponent : {"", " exponent 1.5"}) {
    Simulation pair, wall;
    const std::string coefficients = "1e5 1e5 0 0 1e9 kt 3e3 restitution 0.4";
    pair.open_box(3.0);
    pair.create({{Vec3(0, 0, 0)}, {Vec3(0, 0, 0.99), Vec3(v, 0, 0)}});
    pair("pair_style gran/eepa linear" + exponent + "\npair_coeff 1 1 " + coefficients +
         "\nfix integrate all nve/sphere\ntimestep 1e-5\nrun 0 post no");
    EXPECT_NEAR(pair.particle(2).f.x(), -std::sqrt(0.5) * factor * v, 1e-9);
    wall.open_box(3.0);
    wall.create({{Vec3(0, 0, 0.49), Vec3(v, 0, 0)}});
    wall("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\ntimestep 1e-5\n"
         "fix wall all wall/gran/eepa linear" +
         exponent + " coeff " + coefficients + " wall zplane 0 NULL\nrun 0 post no");
    EXPECT_NEAR(wall.particle(1).f.x(), -factor * v, 1e-9);
  }
}

// The dashpot does not count in the friction bound: a sphere dropped with a large normal dashpot
// has |f_t| <= mu f_hys even in the moment of impact, where f_hys = 0.
TEST(Sliding, BoundHoldsTheHystereticForceNotTheDashpot)
{
  Simulation simulation;
  open_plane(simulation, {Vec3(0, 0, radius - 1e-6), Vec3(5, 0, -1)},
             "1e5 1e5 0 0 0.5 viscous 100 100", 1e-6);
  simulation("fix integrate all nve\nrun 0 post no");
  const Particle p = simulation.particle(1);
  EXPECT_NEAR(p.f.z(), 1e5 * 1e-6 + 100.0, 1e-6);
  EXPECT_NEAR(-p.f.x(), 0.5 * 1e5 * 1e-6, 1e-9);
}

// Rolling without slip against a torque T: m dv/dt = -F, I d(omega)/dt = F a - T, v = omega a,
// hence dv/dt = -a T/(I + m a^2); T = mu_r m g R at a wall.
class RollingDecay : public testing::TestWithParam<const char *> {};

TEST_P(RollingDecay, DeceleratesByTheTorqueMuRNR)
{
  const double g = 10.0, k = 1e5, mu_r = 0.02, delta = mass * g / k, v0 = 1.0;
  const double arm = radius - 0.5 * delta;
  Simulation simulation;
  open_plane(simulation, {Vec3(0, 0, radius - delta), Vec3(v0, 0, 0), Vec3(0, v0 / arm, 0)},
             std::string("1e5 1e5 0 0 0.5 restitution 0.1 rolling ") + GetParam(), 1e-5);
  simulation("fix gravity all gravity 10 vector 0 0 -1\nfix integrate all nve/sphere");
  simulation.run(20000);
  const double early = simulation.particle(1).v.x();
  simulation.run(20000);
  const Particle p = simulation.particle(1);
  const double expected = arm * mu_r * mass * g * radius / (inertia + mass * arm * arm);
  EXPECT_NEAR((early - p.v.x()) / 0.2, expected, 1e-5 * expected);
  EXPECT_NEAR(p.omega.y() * arm, p.v.x(), 1e-4);    // it rolls: friction holds
}

TEST_P(RollingDecay, EndsAtRestWithoutDrift)
{
  const double g = 10.0, k = 1e5, delta = mass * g / k, v0 = 0.05;
  const double arm = radius - 0.5 * delta;
  Simulation simulation;
  open_plane(simulation, {Vec3(0, 0, radius - delta), Vec3(v0, 0, 0), Vec3(0, v0 / arm, 0)},
             std::string("1e5 1e5 0 0 0.5 restitution 0.1 rolling ") + GetParam(), 1e-5);
  simulation("fix gravity all gravity 10 vector 0 0 -1\nfix integrate all nve/sphere");
  simulation.run(120000);
  const Particle rest = simulation.particle(1);
  simulation.run(20000);
  const Particle later = simulation.particle(1);
  EXPECT_LT(later.v.norm(), 1e-7);
  EXPECT_LT(later.omega.norm(), 1e-7);
  EXPECT_LT((later.x - rest.x).norm(), 1e-8);
  EXPECT_GT(rest.x.x(), 1e-3);    // the sphere did roll before
}
INSTANTIATE_TEST_SUITE_P(Models, RollingDecay, testing::Values("constant 0.02", "sds 1e3 60 0.02"));

// A wheel with a rolling spring stays at rest on a slope below mu_r, and rolls away on a steeper
// one.
TEST(RollingSpring, HoldsOnASlopeBelowMuRAndNotAbove)
{
  for (const double slope : {0.01, 0.04}) {
    Simulation simulation;
    open_plane(simulation, {Vec3(0, 0, radius - 1e-4)},
               "1e5 1e5 0 0 0.5 restitution 0.1 rolling sds 1e3 60 0.02", 1e-5);
    simulation("fix gravity all gravity 10 vector " + exact(slope) +
               " 0 -1\nfix integrate all nve/sphere");
    simulation.run(100000);
    if (slope < 0.02)
      EXPECT_LT(simulation.particle(1).v.norm(), 1e-6);
    else
      EXPECT_GT(simulation.particle(1).v.x(), 0.01);
  }
}

}    // namespace
