// SPDX-License-Identifier: GPL-2.0-only

// Moving walls: position, velocity, and direction in which they drag particles.

#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

constexpr double dt = 1e-5;
constexpr int POSITION = 4, VELOCITY = 5;

/// One sphere on the floor z = 0 under gravity 10, in equilibrium.
void open_floor(Simulation &simulation, const std::string &motion,
                const std::string &coefficients = "1e5 1e5 0 0 0.3 restitution 0.3")
{
  simulation.open_box(5.0);
  simulation.create({{Vec3(0, 0, 0.5 - 1e-4)}});
  simulation("pair_style zero 1.0\npair_coeff * *\ntimestep 1e-5\nfix integrate all nve/sphere\n"
             "fix gravity all gravity 10 vector 0 0 -1\n"
             "fix wall all wall/gran/eepa linear coeff " +
             coefficients + " wall zplane 0 NULL " + motion);
}

TEST(MovingWall, GoesAtItsVelocity)
{
  Simulation simulation;
  open_floor(simulation, "velocity 0.1 0.2 -0.3");
  simulation.run(0);
  EXPECT_EQ(simulation.fix("wall", POSITION), 0.0);
  EXPECT_EQ(simulation.fix("wall", VELOCITY), -0.3);
  simulation.run(1000);
  EXPECT_NEAR(simulation.fix("wall", POSITION), -0.3 * 1000 * dt, 1e-14);
  simulation.run(500);    // it continues from its position
  EXPECT_NEAR(simulation.fix("wall", POSITION), -0.3 * 1500 * dt, 1e-14);
}

TEST(MovingWall, StartsAtItsOwnTimeNotAtStepZero)
{
  Simulation simulation;
  open_floor(simulation, "");
  simulation.run(500);
  simulation("unfix wall\nfix wall all wall/gran/eepa linear coeff 1e5 1e5 0 0 0 wall zplane -0.1 "
             "NULL wiggle z 0.05 0.01");
  simulation.run(0);
  EXPECT_NEAR(simulation.fix("wall", POSITION), -0.1, 1e-14);
  simulation("unfix wall\nfix wall all wall/gran/eepa linear coeff 1e5 1e5 0 0 0 wall zplane -0.1 "
             "NULL velocity 0 0 1");
  simulation.run(0);
  EXPECT_NEAR(simulation.fix("wall", POSITION), -0.1, 1e-14);
}

TEST(MovingWall, FollowsAVariable)
{
  Simulation simulation;
  // v = 0.2 + 0.001 step: the sum over steps 1 .. n of v dt, which differs from the integral by at
  // most v dt
  simulation("variable speed equal 0.2+0.001*step");
  open_floor(simulation, "velocity 0 0 v_speed");
  simulation.run(400);
  const double sum = dt * (0.2 * 400 + 0.001 * 400 * 401 / 2.0);
  EXPECT_NEAR(simulation.fix("wall", POSITION), sum, 0.61 * dt);
  EXPECT_NEAR(simulation.fix("wall", VELOCITY), 0.6, 1.1e-3);
}

TEST(MovingWall, SetsAVariablesVelocityAlreadyInTheSetUp)
{
  Simulation simulation;
  simulation("variable speed equal 0.7");
  open_floor(simulation, "velocity 0 0 v_speed");
  simulation.run(0);
  EXPECT_EQ(simulation.fix("wall", VELOCITY), 0.7);
}

TEST(MovingWall, WigglesAsACosine)
{
  Simulation simulation;
  open_floor(simulation, "wiggle z 0.02 0.05");
  const double omega = 2.0 * pi / 0.05;
  for (int k = 1; k <= 7; k++) {
    simulation.run(777);
    const double t = 777 * k * dt;
    EXPECT_NEAR(simulation.fix("wall", POSITION), 0.02 - 0.02 * std::cos(omega * t), 1e-12);
    EXPECT_NEAR(simulation.fix("wall", VELOCITY), 0.02 * omega * std::sin(omega * t), 1e-10);
  }
}

TEST(MovingWall, MeetsThePositionOfTheEndOfTheStep)
{
  // a wall that moves up at 1 m/s under a held particle: f = k delta at every step
  Simulation simulation;
  simulation.open_box(5.0);
  simulation.create({{Vec3(0, 0, 0.5)}});
  simulation("pair_style zero 1.0\npair_coeff * *\ntimestep 1e-5\n"
             "fix wall all wall/gran/eepa linear coeff 1e5 1e5 0 0 0 wall zplane 0 NULL velocity 0 "
             "0 1");
  simulation.run(100);
  EXPECT_NEAR(simulation.fix("wall", 3), -1e5 * 100 * dt, 1e-8);
}

class Dragging : public testing::TestWithParam<const char *> {};

// The floor moves to +x under a sphere at rest: friction accelerates the sphere to +x at mu g and
// turns it about -y (R x f at the bottom), at (5/2) mu g/R.
TEST_P(Dragging, FrictionFollowsTheSurface)
{
  const double mu = 0.3, g = 10.0;
  Simulation simulation;
  open_floor(simulation, GetParam());
  simulation.run(2000);
  const Particle early = simulation.particle(1);
  simulation.run(2000);
  const Particle late = simulation.particle(1);
  const double arm = 0.5 - 0.5e-4;
  EXPECT_NEAR((late.v.x() - early.v.x()) / 0.02, mu * g, 1e-6);
  EXPECT_NEAR((late.omega.y() - early.omega.y()) / 0.02, -mu * g * arm / 0.1, 1e-5);
  EXPECT_NEAR(simulation.fix("wall", 1), -mu * g, 1e-6);
  EXPECT_NEAR(simulation.fix("wall", 3), -g, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Motions, Dragging,
                         testing::Values("velocity 2 0 0", "shear x 2", "wiggle x 0.2 0.18"));

TEST(Dragging, OfAShearedPlaneDoesNotMoveIt)
{
  Simulation simulation;
  open_floor(simulation, "shear y -2");
  simulation.run(1000);
  EXPECT_EQ(simulation.fix("wall", POSITION), 0.0);
  EXPECT_EQ(simulation.fix("wall", VELOCITY), 0.0);
  EXPECT_LT(simulation.particle(1).v.y(), -0.01);
  EXPECT_GT(-simulation.particle(1).omega.x(), 0.01);
}

// As LAMMPS's own walls: positive shear of a z cylinder in x or y turns it clockwise seen from
// +z, so that its surface at +x goes to -y.
TEST(TurningCylinder, DragsInItsSense)
{
  for (const double side : {1.0, -1.0}) {    // a particle inside and one outside
    Simulation simulation;
    simulation.open_box(5.0);
    simulation.create({{Vec3(2.0 - side * (0.5 - 0.01), 0, 0)}});
    simulation("pair_style zero 1.0\npair_coeff * *\ntimestep 1e-5\n"
               "fix wall all wall/gran/eepa linear coeff 1e4 1e4 0 0 0.2 wall zcylinder 2 shear x "
               "3");
    simulation.run(1000);
    const Particle p = simulation.particle(1);
    EXPECT_NEAR(p.f.y(), -0.2 * 1e4 * 0.01, 1e-6);
    EXPECT_NEAR(p.f.x(), -side * 1e4 * 0.01, 1e-6);
    // the contact point lies towards +x from an inner particle, towards -x from an outer one
    EXPECT_NEAR(p.torque.z(), -side * 0.495 * 0.2 * 1e4 * 0.01, 1e-6);
    EXPECT_EQ(simulation.fix("wall", VELOCITY), 0.0);
  }
}

TEST(TurningCylinder, ShearsAlongItsAxisToo)
{
  Simulation simulation;
  simulation.open_box(5.0);
  simulation.create({{Vec3(1.51, 0, 0)}});
  simulation("pair_style zero 1.0\npair_coeff * *\ntimestep 1e-5\n"
             "fix wall all wall/gran/eepa linear coeff 1e4 1e4 0 0 0.2 wall zcylinder 2 shear z 3");
  simulation.run(1000);
  EXPECT_NEAR(simulation.particle(1).f.z(), 0.2 * 1e4 * 0.01, 1e-6);
}

}    // namespace
