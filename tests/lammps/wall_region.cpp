// SPDX-License-Identifier: GPL-2.0-only

// wall region: against planes and cylinders of this package, against LAMMPS's own wall where the physics
// coincides, in motion, and where particles get through.

#include "packing.h"
#include "simulation.h"

#include "lammps.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

constexpr int CONTACTS = 6;
const std::string law =
    " all wall/gran/eepa linear coeff 1e4 2e4 5e3 -0.1 0.5 restitution 0.7 rolling sds 1e3 0.1 0.1 "
    "twisting marshall wall ";

/// Particles that bounce, roll and slide in a closed box of half a size, with gravity along no axis.
void open(Simulation &simulation, double size, double time_step = 1e-4)
{
  Packing packing;
  packing.side = 3;
  packing.spacing = 1.1;
  packing.speed = 5.0;
  packing.polydisperse = true;
  simulation.open_box(size + 1.0);
  simulation.create(packing.spheres());
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -0.1 0.5 restitution 0.7\n"
             "neighbor 0.3 bin\nfix integrate all nve/sphere\n"
             "fix g all gravity 10 vector 0.3 0.2 -1\ntimestep " +
             exact(time_step));
}

/// Runs both and compares forces and positions.
void expect_alike(Simulation &a, Simulation &b, int parts, int steps, double tolerance)
{
  double contacts = 0.0;
  for (int part = 0; part < parts; part++) {
    a.run(steps);
    b.run(steps);
    EXPECT_LT(difference(a.particles(), b.particles()), tolerance) << part;
    contacts += a.fix("w", CONTACTS);
  }
  EXPECT_GT(contacts, 5.0);
}

TEST(RegionWall, ABlockIsSixPlanes)
{
  Simulation planes, block;
  open(planes, 2.2);
  planes("fix w" + law + "zplane -2.2 2.2\nfix wx" + law + "xplane -2.2 2.2\nfix wy" + law +
         "yplane -2.2 2.2");
  open(block, 2.2);
  block("region b block -2.2 2.2 -2.2 2.2 -2.2 2.2\nfix w" + law + "region b");
  expect_alike(planes, block, 10, 500, 1e-9);
}

// From inside and from outside, where the normal turns.
TEST(RegionWall, ACylinderIsACylinder)
{
  for (const bool inside : {true, false}) {
    Simulation analytic, region;
    for (Simulation *simulation : {&analytic, &region}) {
      open(*simulation, 9.0);
      if (!inside) (*simulation)("displace_atoms all move 5 0 0");
      (*simulation)(inside ? "fix end" + law + "zplane -2.5 2.5"
                           : "fix end" + law + "zplane -2.5 2.5\nfix endx" + law +
                            "xplane NULL 7.5\nfix endy" + law + "yplane -3 3");
    }
    analytic("fix w" + law + "zcylinder 2.6");
    region(std::string("region c cylinder z 0 0 2.6 -9 9 side ") + (inside ? "in" : "out") +
           "\nfix w" + law + "region c");
    // normal rates are found by differences
    expect_alike(analytic, region, 40, 100, 1e-6);
  }
}

// The wall of LAMMPS, without friction, whose lever arms differ; cone, sphere, prism and unions.
TEST(RegionWall, HasTheNormalForceOfLammpssOwn)
{
  const struct {
    const char *name, *regions;
  } shapes[] = {{"cone", "region r cone z 0 0 1.5 3.2 -2.5 2.5"},
                {"sphere", "region r sphere 0 0 0 3.0"},
                {"ellipsoid", "region r ellipsoid 0 0 0 3 3.3 2.8"},
                {"prism", "region r prism -2.4 2.4 -2.4 2.4 -2.4 2.4 0.4 0 0.2"},
                {"union",
                 "region a block -2.3 2.3 -2.3 2.3 -2.3 2.3\nregion b sphere 0 0 1 2.9\n"
                 "region r union 2 a b"},
                {"intersect",
                 "region a block -2.3 2.3 -2.3 2.3 -2.3 2.3\nregion b sphere 0 0 0 3.2\n"
                 "region r intersect 2 a b"},
                {"open", "region r cylinder z 0 0 2.6 -2.5 2.5 open 2"}};
  for (const auto &shape : shapes) {
    Simulation ours, lammpss;
    for (Simulation *simulation : {&ours, &lammpss}) {
      open(*simulation, 3.3);
      (*simulation)(shape.regions);
    }
    ours("fix w all wall/gran/eepa linear coeff 1e4 1e4 0 0 0 viscous 2 0 wall region r");
    lammpss(
        "fix w all wall/gran/region granular hooke 1e4 2 tangential linear_nohistory 0 0 damping "
        "velocity region r");
    for (int part = 0; part < 5; part++) {
      ours.run(400);
      lammpss.run(400);
      EXPECT_LT(difference(ours.particles(), lammpss.particles()), 1e-9) << shape.name << part;
    }
  }
}

TEST(RegionWall, MustExistAndIsFoundAgain)
{
  Simulation simulation;
  open(simulation, 3.0);
  EXPECT_TRUE(refuses(simulation, "fix w" + law + "region nowhere",
                      "fix w wall/gran/eepa: wall region nowhere does not exist"));
  simulation("region r sphere 0 0 0 3\nfix w" + law + "region r");
  simulation.run(10);
  simulation("region r delete");
  EXPECT_TRUE(refuses(simulation, "run 10", "fix w wall/gran/eepa: wall region r does not exist"));
}

// A sphere on the floor of a block that moves, by the region's variable and by the wall's drive.
TEST(RegionWall, MovesByItsOwnKeywordsAndByTheDrive)
{
  Simulation own, driven;
  for (Simulation *simulation : {&own, &driven}) open(*simulation, 4.0);
  own("variable x equal 0.3*step*dt\nregion r block -2.2 2.2 -2.2 2.2 -2.2 2.2 move v_x NULL NULL\n"
      "fix w" +
      law + "region r");
  driven("region r block -2.2 2.2 -2.2 2.2 -2.2 2.2\nfix w" + law + "region r velocity 0.3 0 0");
  expect_alike(own, driven, 5, 400, 1e-8);
  EXPECT_NEAR(driven.fix("w", 22), 0.3 * 2000 * 1e-4, 1e-12);
}

TEST(RegionWall, TurnsByItsOwnKeywordsAndByTheDrive)
{
  Simulation own, driven;
  for (Simulation *simulation : {&own, &driven}) open(*simulation, 4.0);
  // an axis that is no unit vector
  own("variable a equal 2*step*dt\n"
      "region r block -1.8 1.8 -1.8 1.8 -1.8 1.8 rotate v_a 0.1 0 0 0 0 5\nfix w" +
      law + "region r");
  driven("region r block -1.8 1.8 -1.8 1.8 -1.8 1.8\nfix w" + law +
         "region r rotate 0.1 0 0 0 0 5 2");
  // the region's own velocity is that of the step, at its end
  expect_alike(own, driven, 30, 25, 1e-4);
  EXPECT_NEAR(driven.fix("w", 20), 2 * 750 * 1e-4, 1e-12);
}

// The parts of an intersection move, each in its own way: as two walls.
TEST(RegionWall, MayHavePartsThatMove)
{
  Simulation one, two;
  for (Simulation *simulation : {&one, &two}) {
    open(*simulation, 4.0);
    (*simulation)("variable x equal 0.02*sin(50*step*dt)\nvariable a equal 0.2*sin(50*step*dt)\n"
                  "region a block -2.0 2.0 -2.0 2.0 -2.0 2.0 move v_x NULL NULL\n"
                  "region b cylinder z 0 0 2.1 -9 9 rotate v_a 0 0 0 0 0 5");
  }
  two("fix w" + law + "region a\nfix v" + law + "region b");
  one("region r intersect 2 a b");
  if (one.lammps()->num_ver > 20250204) {
    EXPECT_TRUE(
        refuses(one, "fix w" + law + "region r", "region r has a part with keyword rotate"));
    return;
  }
  one("fix w" + law + "region r");
  double of_a = 0.0, of_b = 0.0;
  for (int part = 0; part < 10; part++) {
    one.run(150);
    two.run(150);
    EXPECT_LT(difference(one.particles(), two.particles()), 1e-9) << part;
    EXPECT_EQ(one.fix("w", CONTACTS), two.fix("w", CONTACTS) + two.fix("v", CONTACTS));
    of_a += two.fix("w", CONTACTS);
    of_b += two.fix("v", CONTACTS);
  }
  EXPECT_GT(of_a, 5.0);
  EXPECT_GT(of_b, 5.0);
}

// A variable of the time step begins anew with reset_timestep: the region jumps, and has no velocity there.
TEST(RegionWall, DoesNotTakeAJumpForAVelocity)
{
  Simulation simulation;
  simulation.open_box(9.0);
  simulation.create({{Vec3(0, 0, 0.49)}});
  simulation("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\ntimestep 1e-4\n"
             "variable x equal 3*step*dt\n"
             "region r block -9 9 -9 9 0 9 move v_x NULL NULL\n"
             "fix w all wall/gran/eepa linear coeff 1e4 1e4 0 0 0.5 viscous 5 5 wall region r");
  simulation.run(100);
  // the sphere is dragged along by friction, to the limit where the velocity is large
  EXPECT_GT(simulation.particle(1).f.x(), 0.0);
  simulation("reset_timestep 0\nrun 0 post no");
  EXPECT_GT(simulation.particle(1).f.x(), 0.0);
  simulation("reset_timestep 500\nrun 0 post no");
  EXPECT_LT(simulation.particle(1).f.x(), 0.4 * simulation.particle(1).f.z());
}

TEST(RegionWall, NamesWhoGetsThrough)
{
  for (const char *side : {"in", "out"}) {
    Simulation simulation;
    simulation.open_box(9.0);
    const double at = *side == 'i' ? 1.4 : 2.6, to = *side == 'i' ? 1.0 : -1.0;
    simulation.create({{Vec3(at, 0, 0), Vec3(to * 100.0, 0, 0)}});
    simulation(std::string("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\n"
                           "timestep 1e-4\nregion r sphere 0 0 0 2 side ") +
               side + "\nfix w" + law + "region r");
    EXPECT_TRUE(
        refuses(simulation, "run 300", "the center of atom 1 is through the region r at step"));
  }
  // too fast for any contact
  Simulation simulation;
  simulation.open_box(9.0);
  simulation.create({{Vec3(0, 0, 0), Vec3(7e4, 0, 0)}});
  simulation("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\ntimestep 1e-4\n"
             "region r sphere 0 0 0 3\nfix w" +
             law + "region r");
  EXPECT_TRUE(
      refuses(simulation, "run 3", "the center of atom 1 is through the region r at step 1"));
}

// A region that moves over a sphere at rest by its own keywords, or shrinks around it.
TEST(RegionWall, NamesWhoIsLeftBehind)
{
  const std::string soft =
      "fix w all wall/gran/eepa linear dtcheck off coeff 1e2 1e2 0 0 0 wall region r";
  for (const char *region :
       {"variable z equal 15*step*dt\nregion r block -8 8 -8 8 0 30 move NULL NULL v_z\n",
        "variable r equal 3-20*step*dt\nregion r sphere 0 0 0 v_r\n"}) {
    Simulation simulation;
    simulation.open_box(40.0);
    simulation.create({{Vec3(2, 0, 1)}});
    simulation(std::string("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\n"
                           "timestep 1e-4\n") +
               region + soft);
    EXPECT_TRUE(
        refuses(simulation, "run 3000", "the center of atom 1 is through the region r at step"))
        << region;
  }
}

}    // namespace
