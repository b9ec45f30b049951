// SPDX-License-Identifier: GPL-2.0-only

// Contacts of walls with particles: mirror image, both planes, cylinder, group, force sums, table.

#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

/// A box with particles that touch only walls, not each other.
void open_walls_only(Simulation &simulation, const std::vector<Sphere> &spheres)
{
  simulation.open_box(5.0);
  simulation.create(spheres);
  simulation("pair_style zero 1.0\npair_coeff * *\ntimestep 1e-5");
}

class MirrorParticle : public testing::TestWithParam<const char *> {};

// A particle that hits its mirror image overlaps it by 2 delta where it overlaps a plane between
// the two by delta, at twice the velocity. With half of k and B and the same f0, both have the same
// force at every instant. d = 2 R in both, so that this also holds with `scale`.
TEST_P(MirrorParticle, MovesAsAParticleAtAWall)
{
  const std::string style = GetParam();
  // the limit of luding is half as deep at the plane: depth 2 R there, depth R between the two
  const bool luding = style.find("luding") == 0;
  Simulation wall, mirror;
  const Vec3 x(-0.6, 0, 0), v(1.3, 0, 0);
  open_walls_only(wall, {{x, v}});
  wall("fix integrate all nve/sphere\nfix wall all wall/gran/eepa " + style +
       " coeff 2e4 4e4 1e4 -2 0 viscous 4 0" + (luding ? " depth 0.0025" : "") +
       " wall xplane NULL 0");
  mirror.open_box(5.0);
  mirror.create({{x, v}, {-x, -v}});
  mirror("pair_style gran/eepa " + style + "\npair_coeff 1 1 1e4 2e4 5e3 -2 0 viscous 2 0" +
         (luding ? " depth 0.01" : "") + "\n" + "fix integrate all nve/sphere\ntimestep 1e-5");
  double deepest = 0.0;
  for (int k = 0; k < 60; k++) {
    wall.run(500);
    mirror.run(500);
    const Particle at_wall = wall.particle(1), at_mirror = mirror.particle(1);
    // rounding of two distances, 1e-16, times the stiffness over the force, and 30,000 steps
    EXPECT_NEAR(at_wall.x.x(), at_mirror.x.x(), 1e-11);
    EXPECT_NEAR(at_wall.v.x(), at_mirror.v.x(), 1e-9);
    deepest = std::max(deepest, 0.5 + at_wall.x.x());
  }
  EXPECT_GT(deepest, 3e-3);
}
INSTANTIATE_TEST_SUITE_P(Laws, MirrorParticle,
                         testing::Values("linear", "plateau", "linear scale 0.5",
                                         "plateau scale 0.25", "linear limit_damping yes", "luding",
                                         "luding scale 2"));

// A particle between two planes, moved from one to the other and back: each plane remembers its own
// largest overlap. Forces by the three branches of the linear law.
TEST(BothPlanes, HaveAHistoryEach)
{
  const double k1 = 1e4, k2 = 3e4, k_adh = 5e3;
  Simulation simulation;
  open_walls_only(simulation, {{Vec3(0, 0, 0)}});
  simulation("fix walls all wall/gran/eepa linear coeff 1e4 3e4 5e3 0 0 wall xplane -0.49 0.495");
  // overlaps at x: 0.01 - x with lo, 0.005 + x with hi
  auto carry = [&](double distance) {
    simulation("fix carry all move linear " + exact(distance / (1000 * 1e-5)) + " 0 0");
    simulation.run(1000);
    simulation("unfix carry");
  };
  auto force_on_particle = [&](int first) {
    return -simulation.fix("walls", first);
  };
  carry(0.008);
  EXPECT_NEAR(force_on_particle(7),
              k2 * (0.002 - (1.0 - k1 / k2) * 0.01) < -k_adh * 0.002
                  ? -k_adh * 0.002
                  : k2 * (0.002 - (1.0 - k1 / k2) * 0.01),
              1e-6);
  EXPECT_NEAR(force_on_particle(10), -k1 * 0.013, 1e-6);
  EXPECT_EQ(simulation.fix("walls", 6), 2.0);
  // back to the middle: hi unloads from 0.013, lo reloads on the k2 line that leaves its adhesive
  // branch at 0.002, delta_p = (1 + k_adh/k2) 0.002
  carry(-0.004);
  EXPECT_NEAR(force_on_particle(10), -k2 * (0.009 - (1.0 - k1 / k2) * 0.013), 1e-6);
  const double plastic = (1.0 + k_adh / k2) * 0.002;
  const double reloaded = std::min(k2 * (0.006 - plastic), k1 * 0.006);
  EXPECT_NEAR(force_on_particle(7), reloaded, 1e-6);
  EXPECT_NEAR(simulation.fix("walls", 1), simulation.fix("walls", 7) + simulation.fix("walls", 10),
              1e-12);
}

// A contact that opens loses its history: the next one starts on the loading line again. With the
// old delta_max = 0.02 plateau would attract with k_adh delta_p = 50 at an overlap of 0.004.
TEST(WallHistory, IsForgottenWhenTheContactOpens)
{
  Simulation simulation;
  open_walls_only(simulation, {{Vec3(0, 0, 0.5)}});
  simulation("fix wall all wall/gran/eepa plateau coeff 1e4 2e4 5e3 0 0.5 wall zplane 0 NULL");
  auto carry = [&](double distance) {
    simulation("fix carry all move linear 0 0 " + exact(distance / (1000 * 1e-5)));
    simulation.run(1000);
    simulation("unfix carry");
  };
  carry(-0.02);
  carry(0.016);
  EXPECT_NEAR(simulation.fix("wall", 3), 5e3 * 0.01, 1e-6);    // remembered
  carry(0.01);
  EXPECT_EQ(simulation.fix("wall", 6), 0.0);
  carry(-0.01);
  EXPECT_NEAR(simulation.fix("wall", 3), -1e4 * 0.004, 1e-6);    // virgin
}

// A particle that leaves the fix's group while in contact, and joins it again, has a new contact:
// its old contact may have opened meanwhile.
TEST(WallHistory, IsForgottenWhenTheParticleLeavesTheGroup)
{
  Simulation simulation;
  open_walls_only(simulation, {{Vec3(0, 0, 0.5)}});
  simulation("group felt id 1\n"
             "fix wall felt wall/gran/eepa plateau coeff 1e4 2e4 5e3 0 0.5 wall zplane 0 NULL");
  auto carry = [&](double distance) {
    simulation("fix carry all move linear 0 0 " + exact(distance / (1000 * 1e-5)));
    simulation.run(1000);
    simulation("unfix carry");
  };
  carry(-0.02);
  EXPECT_NEAR(simulation.fix("wall", 3), -1e4 * 0.02, 1e-6);
  simulation("group felt clear");
  carry(0.016);
  EXPECT_EQ(simulation.fix("wall", 6), 0.0);
  simulation("group felt id 1");
  carry(0.0);
  EXPECT_NEAR(simulation.fix("wall", 3), -1e4 * 0.004, 1e-6);    // virgin
}

// A set-up call neither winds the spring nor remembers an overlap: a particle that is moved out to
// half of its overlap before any step is still on the loading line.
TEST(WallHistory, IsNotChangedBySetUpCalls)
{
  Simulation simulation;
  open_walls_only(simulation, {{Vec3(0, 0, 0.48), Vec3(3, 0, 0), Vec3(0, 4, 0)}});
  simulation("fix wall all wall/gran/eepa linear coeff 1e4 4e4 5e3 0 0.5 wall zplane 0 NULL");
  for (int k = 0; k < 3; k++) {
    simulation("run 0 post no");
    EXPECT_EQ(simulation.particle(1).f.x(), 0.0);
    EXPECT_NEAR(simulation.particle(1).f.z(), 1e4 * 0.02, 1e-9);
  }
  simulation("displace_atoms all move 0 0 0.01\nrun 0 post no");
  EXPECT_NEAR(simulation.particle(1).f.z(), 1e4 * 0.01, 1e-9);
}

TEST(Cylinder, PushesInwardInsideAndOutwardOutside)
{
  // overlap 0.01 inside, 0.02 outside, at two angles
  const double inside = 2.0 - 0.5 + 0.01, outside = 2.0 + 0.5 - 0.02;
  Simulation simulation;
  open_walls_only(simulation, {{inside * Vec3(0.6, 0.8, 0)}, {outside * Vec3(-1, 0, 0)}});
  simulation("fix integrate all nve/sphere\n"
             "fix wall all wall/gran/eepa linear coeff 1e4 1e4 0 0 0 wall zcylinder 2\n"
             "run 0 post no");
  const auto p = simulation.particles();
  EXPECT_LT((p[0].f - 1e4 * 0.01 * Vec3(-0.6, -0.8, 0)).norm(), 1e-9);
  EXPECT_LT((p[1].f - 1e4 * 0.02 * Vec3(-1, 0, 0)).norm(), 1e-9);
  EXPECT_EQ(simulation.fix("wall", 6), 2.0);
  EXPECT_EQ(simulation.fix("wall", 4), 2.0);    // the position of a cylinder is its radius
  EXPECT_LT((simulation.wall_force("wall") + p[0].f + p[1].f).norm(), 1e-12);
}

TEST(Cylinder, TakesAParticleOnItsAxis)
{
  Simulation simulation;
  open_walls_only(simulation, {{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3::Zero(), 2.0}});
  simulation("fix integrate all nve/sphere\n"
             "fix wall all wall/gran/eepa linear coeff 1e4 1e4 0 0 0.5 wall zcylinder 1.99\n"
             "run 10 post no");
  const Particle p = simulation.particle(1);
  EXPECT_TRUE(p.x.allFinite());
  EXPECT_NEAR(p.f.head<2>().norm(), 1e4 * 0.01, 1.0);
}

TEST(WallForce, IsMinusTheForceOnTheParticles)
{
  std::vector<Sphere> spheres;
  for (int k = 0; k < 5; k++)
    spheres.push_back({Vec3(1.2 * k - 2.4, 0.1 * k, 0.49 - 0.002 * k), Vec3(0.3, -0.2, -0.1 * k)});
  spheres.push_back({Vec3(0, 3, 2.0)});    // this one touches nothing
  Simulation simulation;
  open_walls_only(simulation, spheres);
  simulation("fix integrate all nve/sphere\n"
             "fix wall all wall/gran/eepa linear coeff 1e4 2e4 5e3 -1 0.5 restitution 0.5 wall "
             "zplane 0 NULL");
  for (int k = 0; k < 4; k++) {
    simulation.run(100);
    Vec3 sum = Vec3::Zero();
    int touching = 0;
    for (const auto &p : simulation.particles()) {
      sum += p.f;
      if (p.x.z() < p.radius) touching++;
    }
    EXPECT_GT(sum.norm(), 1.0);
    EXPECT_LT((simulation.wall_force("wall") + sum).norm(), 1e-12 * sum.norm());
    EXPECT_EQ(simulation.fix("wall", 6), touching);
  }
}

TEST(Wall, ActsOnItsGroupOnly)
{
  Simulation simulation;
  open_walls_only(simulation, {{Vec3(-1, 0, 0.49)}, {Vec3(1, 0, 0.49)}});
  simulation("group second id 2\nfix integrate all nve/sphere\n"
             "fix wall second wall/gran/eepa linear coeff 1e4 2e4 0 0 0 wall zplane 0 NULL\n"
             "run 0 post no");
  EXPECT_EQ(simulation.particle(1).f.norm(), 0.0);
  EXPECT_NEAR(simulation.particle(2).f.z(), 100.0, 1e-9);
  EXPECT_EQ(simulation.fix("wall", 6), 1.0);
}

TEST(ContactTable, TellsOfEachParticlesContact)
{
  Simulation simulation;
  const double mu = 0.1;
  open_walls_only(simulation, {{Vec3(-1, 0.3, 0.49), Vec3(30, 0, 0)}, {Vec3(1, 0, 0.6)}});
  simulation(
      "fix integrate all nve\n"
      "fix wall all wall/gran/eepa linear coeff 1e4 2e4 0 0 0.1 wall zplane 0 NULL contacts");
  simulation.run(20);
  const Particle p = simulation.particle(1);
  const double overlap = 0.5 - p.x.z();
  const auto row = simulation.fix_row("wall", 1);
  ASSERT_EQ(row.size(), 11u);
  EXPECT_EQ(row[0], 1.0);
  for (int k = 0; k < 3; k++) EXPECT_EQ(row[1 + k], p.f[k]);
  EXPECT_NEAR(p.f.x(), -mu * p.f.z(), 1e-9);
  EXPECT_NEAR(row[4], p.x.x(), 1e-12);
  EXPECT_NEAR(row[5], p.x.y(), 1e-12);
  EXPECT_NEAR(row[6], 0.0, 1e-12);    // the contact point lies in the plane
  EXPECT_NEAR(row[7], overlap, 1e-12);
  EXPECT_NEAR(row[8], 0.01, 1e-4);    // the largest overlap, at the start
  EXPECT_GE(row[8], row[7]);
  EXPECT_EQ(row[9], 2.0);     // it unloads: repelled from the start
  EXPECT_EQ(row[10], 1.0);    // and slides
  for (const double value : simulation.fix_row("wall", 2)) EXPECT_EQ(value, 0.0);
}

// m* at a wall is the particle's own mass, f0 and k scale with d = 2 R.
TEST(WallScale, IsTheParticlesDiameter)
{
  Simulation simulation;
  open_walls_only(simulation, {{Vec3(0, 0, 0.99), Vec3(0, 0, 0), Vec3::Zero(), 1.0}});
  simulation("fix integrate all nve/sphere\n"
             "fix wall all wall/gran/eepa linear scale 0.5 coeff 1e4 2e4 0 -3 0 wall zplane 0 "
             "NULL\nrun 0 post no");
  // s = d/d_ref = 4: f = 4 k1 delta + 16 f0
  EXPECT_NEAR(simulation.particle(1).f.z(), 4.0 * 1e4 * 0.01 - 16.0 * 3.0, 1e-9);
}

}    // namespace
