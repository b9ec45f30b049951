// SPDX-License-Identifier: GPL-2.0-only

// Who gets through a wall is an error that names him and the wall, and who does not is none.

#include "packing.h"
#include "triangles.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

constexpr int CONTACTS = 6;
const std::string soft = "fix w all wall/gran/eepa linear coeff 1e3 1e3 0 0 0.3 wall ";
const std::string stiff =
    "fix w all wall/gran/eepa linear coeff 1e5 1e5 0 0 0.3 restitution 0.5 wall ";

void open(Simulation &simulation, const std::vector<Sphere> &spheres, double time_step)
{
  simulation.open_box(9.0);
  simulation.create(spheres);
  simulation(
      "pair_style zero 1.0\npair_coeff * *\nneighbor 0.3 bin\nfix move all nve/sphere\ntimestep " +
      exact(time_step));
}

struct Intruder {
  const char *name, *wall;
  Vec3 x, v;
  double time_step;
  const char *message;
};

class Through : public testing::TestWithParam<Intruder> {
 protected:
  const ScratchFile box_{".stl"}, paddle_{".stl"};
  void SetUp() override
  {
    write_stl(box_.name(), box(3.0, 4));
    std::vector<Corners> paddle;
    add_rectangle(paddle, Vec3(0, 0, -2), Vec3(3, 0, 0), Vec3(0, 0, 4), 2, false, 1);
    write_stl(paddle_.name(), paddle);
  }
  std::string wall() const
  {
    return with(with(GetParam().wall, "BOX", box_.name()), "PADDLE", paddle_.name());
  }
};

TEST_P(Through, TheWallIsAnErrorThatNamesBoth)
{
  Simulation simulation;
  open(simulation, {{Vec3(-1, -1, 0)}, {GetParam().x, GetParam().v}}, GetParam().time_step);
  simulation("region ball sphere 0 0 0 3\n" + soft + wall());
  EXPECT_TRUE(refuses(simulation, "run 20000", GetParam().message));
}

// A soft wall, which a particle sinks into; a step longer than its radius; a blade that cuts it.
const Intruder intruders[] = {
    {"soft_mesh", "mesh BOX", Vec3(1, 0.3, 0), Vec3(60, 0, 0), 1e-4,
     "fix w wall/gran/eepa: the center of atom 2 is through the mesh .*stl at step [0-9]+, at 3"},
    {"fast_mesh", "mesh BOX", Vec3(1, 0.3, 0), Vec3(700, 0, 0), 1e-3,
     "fix w wall/gran/eepa: the center of atom 2 is through the mesh .*stl at step 3"},
    {"moving_mesh", "mesh BOX velocity -700 0 0", Vec3(1, 0.3, 0), Vec3(0, 0, 0), 1e-3,
     "fix w wall/gran/eepa: the center of atom 2 is through the mesh .*stl"},
    {"soft_region", "region ball", Vec3(1, 0.3, 0), Vec3(60, 0, 0), 1e-4,
     "fix w wall/gran/eepa: .*atom 2 .*region ball"},
    {"fast_region", "region ball", Vec3(1, 0.3, 0), Vec3(700, 0, 0), 1e-3,
     "fix w wall/gran/eepa: .*atom 2 .*region ball"},
    {"soft_cylinder", "zcylinder 3", Vec3(1, 0.3, 0), Vec3(60, 0, 0), 1e-4,
     "fix w wall/gran/eepa: .*atom 2 .*cylinder of radius 3"},
    {"fast_cylinder", "zcylinder 3", Vec3(1, 0.3, 0), Vec3(700, 0, 0), 1e-3,
     "fix w wall/gran/eepa: .*atom 2 .*cylinder of radius 3"},
    {"paddle", "mesh PADDLE rotate 0 0 0 0 0 1 200", Vec3(0, 2, 0), Vec3(0, 0, 0), 5e-3,
     "fix w wall/gran/eepa: the center of atom 2 is through the mesh .*stl"},
    {"soft_paddle", "mesh PADDLE rotate 0 0 0 0 0 1 60", Vec3(0, 2, 0), Vec3(0, 0, 0), 1e-4,
     "fix w wall/gran/eepa: the center of atom 2 is through the mesh .*stl"},
};
INSTANTIATE_TEST_SUITE_P(Intruders, Through, testing::ValuesIn(intruders), [](const auto &info) {
  return std::string(info.param.name);
});

// One so small that it jumps over the wall without a contact and without a new neighbour list.
TEST(SmallParticle, IsSeenBetweenNeighbourLists)
{
  const ScratchFile file(".stl");
  write_stl(file.name(), box(3.0, 4));
  Sphere small;
  small.x = Vec3(2.878, 0.3, 0.2);
  small.v = Vec3(480, 0, 0);
  small.radius = 0.02;
  Simulation simulation;
  open(simulation, {{Vec3(-1, -1, 0)}, small}, 1e-4);
  simulation(soft + "mesh " + file.name());
  simulation.run(2);
  EXPECT_EQ(simulation.fix("w", CONTACTS), 0.0);
  EXPECT_TRUE(refuses(
      simulation, "run 1 pre no",
      "fix w wall/gran/eepa: the center of atom 2 is through the mesh .* at step 3, at 3.022"));
}

// An error in the midst of a force call, when contacts wait to be evaluated side by side: the run after it knows
// nothing of them.
TEST(Stop, LeavesNothingToTheNextRun)
{
  std::vector<Sphere> spheres;
  for (int k = 0; k < 6; k++) spheres.push_back({Vec3(1.2 * k - 3.0, 0, 0.499)});
  spheres.push_back({Vec3(3, 3, 2), Vec3(0, 0, -900)});
  Simulation simulation;
  open(simulation, spheres, 1e-3);
  simulation(soft + "zplane 0 NULL");
  simulation.run(1);
  EXPECT_TRUE(refuses(simulation, "run 5", "fix w wall/gran/eepa: atom 7 overlaps"));
  simulation("group intruder id 7\ndelete_atoms group intruder");
  simulation.run(0);
  double force = 0.0;
  for (const Particle &p : simulation.particles()) force += 1e3 * (0.5 - p.x.z());
  EXPECT_EQ(simulation.fix("w", CONTACTS), 6.0);
  EXPECT_NEAR(simulation.wall_force("w").z(), -force, 1e-9 * force);
}

// Through the open ends of a tube, past its rims, and onto a plate from both sides.
TEST(NotThrough, AreThoseWhoGoAround)
{
  const ScratchFile tube(".stl");
  auto triangles = prism(24, 2.0, 1.5, false);
  add_rectangle(triangles, Vec3(-1, -1, 4), Vec3(2, 0, 0), Vec3(0, 2, 0), 2, false, 1);
  write_stl(tube.name(), triangles);
  Simulation simulation;
  // along the axis, along the wall inside and outside, over the rim, and onto the plate from above and below
  open(simulation,
       {{Vec3(0, 0, -3), Vec3(0, 0, 6)},
        {Vec3(1.45, 0, -3), Vec3(0.1, 0, 5)},
        {Vec3(2.55, 0, -3), Vec3(-0.1, 0, 4)},
        {Vec3(-3.5, 0, 1.8), Vec3(4, 0, -0.2)},
        {Vec3(0.2, 2.1, -3.5), Vec3(0, 0, 5)},
        {Vec3(0.3, 0.2, 6), Vec3(0, 0, -8)},
        {Vec3(-0.6, -0.6, 3), Vec3(0, 0, 7)}},
       1e-4);
  simulation(stiff + "mesh " + tube.name() + " contacts");
  bool touched[7] = {};
  for (int look = 0; look < 1000; look++) {
    simulation.run(10);
    for (int id = 1; id <= 7; id++) touched[id - 1] |= simulation.fix_row("w", id)[0] > 0.0;
  }
  EXPECT_FALSE(touched[0]);
  for (int id = 2; id <= 7; id++) EXPECT_TRUE(touched[id - 1]) << id;
  EXPECT_GT(simulation.particle(1).x.z(), 2.0);
}

// A particle that is led around the edge of a plate, from above it to below, all the time in contact.
TEST(NotThrough, IsOneThatIsLedAroundAnEdge)
{
  const ScratchFile plate(".stl");
  std::vector<Corners> triangles;
  add_rectangle(triangles, Vec3(-1, -1, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), 2, false, 1);
  write_stl(plate.name(), triangles);
  Simulation simulation;
  simulation.open_box(5.0);
  simulation.create({{Vec3(1, 0.1, 0.49)}});
  // half a turn about the edge takes 1000 steps
  simulation("pair_style zero 1.0\npair_coeff * *\ntimestep 1e-4\n"
             "fix move all move rotate 1 0.1 0 0 1 0 0.2\n" +
             stiff + "mesh " + plate.name());
  simulation.run(1);
  EXPECT_LT(simulation.wall_force("w").z(), -900.0);
  for (int part = 0; part < 99; part++) {
    simulation.run(10);
    EXPECT_EQ(simulation.fix("w", CONTACTS), 1.0) << part;
  }
  EXPECT_NEAR(simulation.particle(1).x.z(), -0.49, 1e-3);
  EXPECT_GT(simulation.wall_force("w").z(), 900.0);
}

// Particles that fall about in a drum with lifters for many turns.
TEST(NotThrough, AreThoseInADrum)
{
  const ScratchFile file(".stl");
  write_stl(file.name(), drum(36));
  Packing packing;
  packing.side = 4;
  packing.spacing = 1.0;
  std::vector<Sphere> spheres = packing.spheres();
  for (Sphere &sphere : spheres) sphere.x *= 0.9, sphere.radius = 0.4;
  Simulation simulation;
  open(simulation, spheres, 2e-4);
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e5 2e5 1e4 -1 0.5 restitution 0.5\n" +
             stiff + "mesh " + file.name() +
             " rotate 0 0 0 0 0 1 8\nfix g all gravity 10 vector 1 0 0");
  for (int part = 0; part < 4; part++) simulation.run(5000);
  for (const Particle &p : simulation.particles()) {
    EXPECT_LT(p.x.head<2>().norm(), 3.3) << p.id;
    EXPECT_LT(std::fabs(p.x.z()), 3.0) << p.id;
  }
  EXPECT_GT(simulation.fix("w", CONTACTS), 5.0);
}

}    // namespace
