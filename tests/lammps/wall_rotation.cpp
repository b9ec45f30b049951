// SPDX-License-Identifier: GPL-2.0-only

// Walls that turn: against known motions of spheres, and as a change of the frame of reference.

#include "packing.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

using namespace eepa_test;

namespace {

constexpr int TORQUE_X = 17, ANGLE = 20, ANGULAR_VELOCITY = 21, DISPLACEMENT_X = 22;

const std::string elastic = "fix w all wall/gran/eepa linear coeff 1e5 1e5 0 0 ";

void open(Simulation &simulation, const std::vector<Sphere> &spheres, double time_step)
{
  simulation.open_box(20.0);
  simulation.create(spheres);
  simulation("pair_style zero 1.0\npair_coeff * *\nneighbor 0.3 bin\nfix integrate all nve/sphere\n"
             "timestep " +
             exact(time_step));
}

// A sphere that rolls on a turntable goes in circles, 2/7 of a turn for each turn of the table.
// Derivation: m v' = F, 2/5 m R^2 w' = -R u x F, and v - R w x u = Omega x r give v' = 2/7 Omega x v.
TEST(Turntable, ARollingSphereGoesInCircles)
{
  const double omega = 3.0, radius = 0.5, gravity = 10.0, x = 2.0;
  const double overlap = gravity / 1e5;
  // rolls without slipping at rest in space: the point below moves with omega x r
  const Vec3 v(0.4, 0.0, 0.0);
  const double arm = radius - overlap / 2;
  // v - arm w x u = Omega x r, so that arm u x w = Omega x r - v
  const Vec3 below = omega * Vec3(0, 0, 1).cross(Vec3(x, 0, 0)) - v;
  const Vec3 spin = below.cross(Vec3(0, 0, 1)) / arm;
  Simulation simulation;
  open(simulation, {{Vec3(x, 0, radius - overlap), v, spin}}, 1e-5);
  simulation(elastic + "2.0 wall zplane 0 NULL rotate 0 0 0 0 0 1 " + exact(omega) +
             "\nfix g all gravity 10 vector 0 0 -1");
  // lever arm R - delta/2 in place of R: 2/5 R^2 / (2/5 R^2 + arm^2)
  const double inertia = 0.4 * radius * radius;
  const double rate = omega * inertia / (inertia + arm * arm);
  EXPECT_NEAR(rate, 2.0 / 7.0 * omega, 1e-3);
  const Vec3 centre = Vec3(x, 0, 0) + Vec3(0, 0, 1).cross(v) / rate;
  for (int part = 0; part < 4; part++) {
    simulation.run(25000);
    const double angle = rate * simulation.thermo("step") * 1e-5;
    const Vec3 from = Vec3(x, 0, 0) - centre;
    const Vec3 expected =
        centre + Eigen::AngleAxisd(angle, Vec3(0, 0, 1)).toRotationMatrix() * from;
    const Particle p = simulation.particle(1);
    EXPECT_LT((p.x - expected).head<2>().norm(), 2e-4) << part;
    // a spring that starts at rest swings about the stretch that it needs
    EXPECT_NEAR(p.v.norm(), v.norm(), rate * v.norm() / std::sqrt(3.5 * 2.0 / 7.0 * 1e5) * 1.1);
  }
  EXPECT_NEAR(simulation.fix("w", ANGLE), omega * 1.0, 1e-10);
  EXPECT_EQ(simulation.fix("w", ANGULAR_VELOCITY), omega);
}

// A sphere pressed by two parallel planes that turn together, about an axis normal to them, goes around
// with them: in the frame of the planes nothing happens.
TEST(Turntable, HoldsASphereThatIsPinched)
{
  const double omega = 5.0, x = 1.5, time_step = 1e-5;
  Simulation simulation;
  open(simulation, {{Vec3(x, 0, 0.5), Vec3(0, omega * x, 0), Vec3(0, 0, omega)}}, time_step);
  simulation(
      "fix w all wall/gran/eepa linear coeff 1e5 1e5 0 0 5.0 kt 1e5 viscous 20 20 wall zplane 0.01 "
      "0.99 rotate 0 0 0 0 0 1 5");
  // both springs together hold it on its circle
  const double stretch = omega * omega * x / 2e5;
  for (int part = 0; part < 5; part++) {
    simulation.run(25000);    // 5 times 1.25 radians
    const double angle = omega * simulation.thermo("step") * time_step;
    const Particle p = simulation.particle(1);
    const Vec3 seen = Eigen::AngleAxisd(-angle, Vec3(0, 0, 1)).toRotationMatrix() * p.x;
    EXPECT_LT((seen - Vec3(x + stretch, 0, 0.5)).norm(), 0.02 * stretch) << part;
    EXPECT_NEAR(p.omega.z(), omega, 1e-9);
  }
}

// The moment on the wall is what the particles lose of their angular momentum, about any point.
TEST(Turntable, ItsMomentIsThatOfTheParticles)
{
  Simulation simulation;
  std::vector<Sphere> spheres;
  for (int k = 0; k < 6; k++)
    spheres.push_back({Vec3(1.1 * k - 3, 0.3 * k, 0.49), Vec3(0.2, -0.1, -0.3), Vec3(1, 2, 3)});
  open(simulation, spheres, 1e-4);
  const Vec3 about(0.7, -0.4, 0.2);
  simulation("fix w all wall/gran/eepa linear coeff 1e4 2e4 5e3 -1 0.5 restitution 0.6 rolling "
             "constant 0.2 wall zplane 0 NULL about 0.7 -0.4 0.2 rotate 1 2 0 0 0 1 4");
  simulation.run(200);
  Vec3 moment = Vec3::Zero();
  for (const Particle &p : simulation.particles()) moment += (p.x - about).cross(p.f) + p.torque;
  ASSERT_GT(moment.norm(), 0.1);
  for (int k = 0; k < 3; k++)
    EXPECT_NEAR(simulation.fix("w", TORQUE_X + k), -moment[k], 1e-12 * moment.norm());
}

// A time step that changes, or that a restart begins with, does not move the wall.
TEST(Rotation, IsIntegratedInTime)
{
  Simulation simulation;
  open(simulation, {{Vec3(0, 0, 5)}}, 1e-4);
  simulation(elastic + "0.5 wall zplane 0 NULL rotate 0 0 0 0 0 1 2");
  simulation.run(100);
  simulation("timestep 3e-4\nreset_timestep 5");
  simulation.run(0);
  EXPECT_NEAR(simulation.fix("w", ANGLE), 2 * 0.01, 1e-15);
  simulation.run(100);
  EXPECT_NEAR(simulation.fix("w", ANGLE), 2 * 0.04, 1e-15);
}

TEST(Rotation, FollowsAVariable)
{
  Simulation simulation;
  open(simulation, {{Vec3(0, 0, 5)}}, 1e-4);
  simulation("variable omega equal 0.01*step");
  simulation(elastic + "0.5 wall zplane 0 NULL rotate 0 0 0 0 0 1 v_omega");
  simulation.run(100);
  EXPECT_NEAR(simulation.fix("w", ANGULAR_VELOCITY), 1.0, 1e-12);
  EXPECT_NEAR(simulation.fix("w", ANGLE), 1e-4 * 0.01 * 100 * 101 / 2, 1e-14);
  EXPECT_TRUE(refuses(simulation, "variable omega delete\nrun 1 pre no",
                      "fix w wall/gran/eepa: rotate omega variable omega does not exist"));
}

// A plane that has turned by 90 degrees holds a sphere as a plane that was made so.
TEST(Rotation, TurnsTheNormal)
{
  Simulation simulation;
  open(simulation, {{Vec3(0.49, 3, 2)}}, 1e-4);
  simulation("unfix integrate");
  simulation(elastic + "0 wall zplane 0 NULL rotate 0 0 0 0 1 0 " + exact(pi / 2 / 0.01));
  simulation.run(100);
  simulation("fix_modify w still");
  simulation.run(1);
  const Particle p = simulation.particle(1);
  EXPECT_LT((p.f - Vec3(1e3, 0, 0)).norm(), 1e-8);
  // and a particle behind it is behind it
  simulation.create({{Vec3(-1, 3, 2)}});
  EXPECT_TRUE(refuses(simulation, "run 1", "atom 2 overlaps the wall by 1.5 at step"));
}

// A rotation in two parts, about two axes, with a drift in between.
TEST(Rotation, GoesOnFromWhereTheWallIs)
{
  Simulation simulation;
  open(simulation, {{Vec3(0, 0, 9)}}, 1e-3);
  simulation(elastic + "0.5 wall zcylinder 2 rotate 0 0 0 0 0 1 1");
  simulation.run(100);
  simulation("fix_modify w velocity 0 0 3");
  simulation.run(100);
  EXPECT_NEAR(simulation.fix("w", ANGLE), 0.1, 1e-14);
  EXPECT_EQ(simulation.fix("w", ANGULAR_VELOCITY), 0.0);
  simulation("fix_modify w rotate 1 0 0 0 0 2 -4 velocity 1 0 0");
  simulation.run(50);
  EXPECT_NEAR(simulation.fix("w", ANGLE), 0.1 - 0.2, 1e-14);
  EXPECT_NEAR(simulation.fix("w", DISPLACEMENT_X), 0.05, 1e-14);
  EXPECT_NEAR(simulation.fix("w", DISPLACEMENT_X + 2), 0.3, 1e-14);
}

// The work of a turning wall is what particles gain, lose and store.
TEST(Rotation, KeepsTheEnergyBalance)
{
  for (const double time_step : {1e-4, 5e-5}) {
    Simulation simulation;
    std::vector<Sphere> spheres;
    for (int k = 0; k < 20; k++)
      spheres.push_back({Vec3(1.05 * (k % 5) - 2.1, 1.05 * (k / 5) - 1.6, 0.52)});
    open(simulation, spheres, time_step);
    simulation(
        "pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -0.1 0.5 restitution 0.6 rolling "
        "sds 1e3 0.1 0.1 twisting marshall\nfix g all gravity 10 vector 0 0 -1");
    for (const char *wall :
         {"w1 all wall/gran/eepa linear coeff 1e4 2e4 5e3 -0.1 0.5 restitution 0.6 "
          "rolling sds 1e3 0.1 0.1 twisting marshall wall zplane 0 NULL rotate 0.2 0 "
          "0 0 0 1 6",
          "w2 all wall/gran/eepa linear coeff 1e4 2e4 5e3 -0.1 0.5 restitution 0.6 "
          "wall zcylinder 4 rotate 0 0 0 0 0 1 -6"})
      simulation(std::string("fix ") + wall);
    simulation("compute e all gran/eepa/energy");
    simulation.run(0);
    const auto sum = [&simulation] {
      const std::vector<double> e = simulation.compute_vector("e");
      double total = -e[8] + e[9] + e[10];
      for (int k = 0; k < 8; k++) total += e[k];
      for (const Particle &p : simulation.particles())
        total += p.kinetic_energy() + 10.0 * p.mass * p.x.z();
      return total;
    };
    const double before = sum();
    simulation.run(static_cast<int>(1.0 / time_step));
    const double work = simulation.compute_vector("e")[8];
    EXPECT_GT(work, 20.0);
    EXPECT_LT(std::fabs(sum() - before), 60.0 * time_step * work) << work;
    std::printf("time step %g: work %g, drift %g\n", time_step, work, sum() - before);
  }
}

}    // namespace
