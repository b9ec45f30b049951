// SPDX-License-Identifier: GPL-2.0-only

// A wall visits only the particles near it and must lose no contact by that: for any motion of wall
// and particles the bits are those of a run that visits every particle in every step.

#include "simulation.h"
#include "triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace eepa_test;

namespace {

constexpr int POSITION = 4, CONTACTS = 6;
constexpr double skin = 0.1;    // of open_box()

// With the first setting neighbour lists bound how far particles move. With the next three they do not, so
// that the wall itself watches how far they move. With the last one it looks at all particles in every
// step, because it must expect that a fix changes their radii.
constexpr const char *bounded = "neigh_modify every 1 delay 0 check yes";
constexpr const char *others[] = {
    "neigh_modify every 200 delay 0 check yes", "neigh_modify every 1 delay 200 check yes",
    "neigh_modify every 1 delay 0 check yes once yes",
    ("neigh_modify every 1 delay 0 check yes\nvariable one equal 1\ngroup nobody empty\n"
     "fix nothing nobody adapt 1000000 atom diameter v_one")};
constexpr const char *looks_at_all = others[3];

/// The box of Simulation::open_box(), for particles of which a fix may change the radii.
void open_box(Simulation &simulation, double half, const std::string &boundary)
{
  const std::string side = exact(-half) + " " + exact(half) + " ";
  simulation("units si\natom_style sphere 1\natom_modify map array\nboundary " + boundary +
             "\nregion box block " + side + side + side +
             "\ncreate_box 1 box\ncomm_modify vel yes\n" + "neighbor 0.1 bin\n" + bounded +
             "\nthermo 1000000");
}

/// Runs without a set-up, in which the wall would visit all particles.
void go_on(Simulation &simulation, int steps)
{
  simulation("run " + std::to_string(steps) + " pre no post no");
}

/* ---------------------------------------------------------------------- a gas between walls */

struct Gas {
  const char *name, *walls;
  double speed;    ///< of the particles
  int steps;       ///< between two comparisons
};

/// Particles that touch only walls, so that nothing depends on their order.
std::vector<Sphere> gas(double speed)
{
  std::mt19937 generator(7);
  const auto random = [&generator] {
    return static_cast<double>(generator()) / 2147483647.5 - 1.0;
  };
  // compilers evaluate arguments in different orders
  const auto random_vector = [&random] {
    const double z = random(), y = random(), x = random();
    return Vec3(x, y, z);
  };
  std::vector<Sphere> spheres;
  for (int k = 0; k < 200; k++) {
    Sphere sphere;
    sphere.x = 2.2 * random_vector();
    sphere.v = speed * random_vector();
    sphere.omega = speed * random_vector();
    sphere.radius = 0.2 + 0.1 * random();
    spheres.push_back(sphere);
  }
  return spheres;
}

void open_gas(Simulation &simulation, const Gas &gas_of, const std::string &walls,
              const std::string &neighbours)
{
  simulation("atom_modify sort 0 0.0");    // the sum of forces on a platen depends on their order
  open_box(simulation, 5.0, "f f f");
  simulation.create(gas(gas_of.speed));
  const std::string law = "linear coeff 1e4 3e4 5e3 -0.1 0.5 restitution 0.8 "
                          "rolling sds 1e3 1 0.1 wall ";
  simulation(neighbours + "\npair_style zero 1.0\npair_coeff * *\ntimestep 1e-4\n" +
             "fix integrate all nve/sphere\nfix box all wall/gran/eepa " + law +
             "xplane -2.6 2.6\nfix ends all wall/gran/eepa " + law +
             "yplane -2.6 2.6\nfix wall all wall/gran/eepa " + law + walls + " contacts");
}

class GasBetweenWalls : public testing::TestWithParam<Gas> {
 protected:
  const ScratchFile mesh_{".stl"};
  void SetUp() override { write_stl(mesh_.name(), box(2.9, 11)); }

  std::string walls() const { return with(GetParam().walls, "MESH", mesh_.name()); }
};

TEST_P(GasBetweenWalls, IsThatOfAWallThatLooksAtAll)
{
  Simulation listed, all[4];
  open_gas(listed, GetParam(), walls(), bounded);
  listed.run(1);
  for (int k = 0; k < 4; k++) {
    open_gas(all[k], GetParam(), walls(), others[k]);
    all[k].run(1);
  }
  double touching = 0.0, most = 0.0;
  for (int look = 0; look < 40; look++) {
    go_on(listed, GetParam().steps);
    const auto a = listed.particles();
    touching += listed.fix("wall", CONTACTS) > 0.0;
    most = std::max(most, listed.fix("wall", CONTACTS));
    for (auto &reference : all) {
      go_on(reference, GetParam().steps);
      for (int k = 1; k <= 16; k++)
        ASSERT_EQ(listed.fix("wall", k), reference.fix("wall", k)) << k << " at look " << look;
      const auto b = reference.particles();
      for (std::size_t k = 0; k < a.size(); k++) {
        ASSERT_EQ(a[k].x, b[k].x) << k << " at look " << look;
        ASSERT_EQ(a[k].v, b[k].v) << k << " at look " << look;
        ASSERT_EQ(a[k].omega, b[k].omega) << k << " at look " << look;
      }
      for (const int id : {1, 17, 120, 200})
        ASSERT_EQ(listed.fix_row("wall", id), reference.fix_row("wall", id)) << id;
    }
  }
  EXPECT_GE(touching, 5.0);
  EXPECT_GE(most, 2.0);
}
const Gas gases[] = {
    {"still", "zplane -2.6 2.6", 20.0, 100},
    {"out_of_reach", "zplane -4 4", 20.0, 100},
    {"coming", "zplane NULL 4 velocity 0 0 -8", 3.0, 100},
    {"slow_particles", "zplane NULL 4 velocity 0 0 -8", 0.01, 100},
    {"wiggling", "zplane -2.9 2.9 wiggle z 0.25 0.1", 3.0, 57},
    {"falling", "zplane NULL 3.5 load -2000 mass 20 damping 10", 3.0, 53},
    {"cylinder", "zcylinder 3.6 velocity 9 2 0", 3.0, 50},
    {"cylinder_slow_particles", "zcylinder 3.6 velocity 9 2 0", 0.01, 50},
    {"cylinder_at_rest", "zcylinder 3.4 shear x 5", 10.0, 60},
    {"mesh", "mesh MESH", 20.0, 100},
    {"mesh_coming", "mesh MESH offset 0 0 6 velocity 0 0 -8", 3.0, 100},
    {"mesh_turning", "mesh MESH offset 0 0 5.6 rotate 0 0 5.6 0.3 0 1 5", 3.0, 60},
    {"mesh_slow_particles", "mesh MESH rotate 0 0 0 0.1 0 1 9", 0.01, 50},
    {"mesh_falling", "mesh MESH offset 0 0 6 load z -2000 mass 20 damping 10", 3.0, 53},
};
INSTANTIATE_TEST_SUITE_P(Motions, GasBetweenWalls, testing::ValuesIn(gases), [](const auto &info) {
  return std::string(info.param.name);
});

/* ---------------------------------------------------------------------- at the edge of reach */

/// Spheres of radius 0.5 below a wall at z = 0.5 + gap; only the test moves them.
class Approach : public testing::Test {
 protected:
  static constexpr double dt = 1e-4, k1 = 1e4;
  Simulation simulation;
  void open(double gap, const std::string &wall, const std::string &carry)
  {
    simulation.open_box(5.0);
    simulation.create({{Vec3(0, 0, 0)}});
    simulation(std::string(bounded) +
               "\npair_style zero 1.0\npair_coeff * *\ntimestep 1e-4\nfix carry all move " + carry +
               "\nfix wall all wall/gran/eepa linear coeff 1e4 4e4 5e3 0 0 wall zplane NULL " +
               exact(0.5 + gap) + " " + wall + " contacts");
  }
  double overlap() const
  {
    return simulation.particle(1).x.z() + 0.5 - simulation.fix("wall", POSITION);
  }
  double force() const { return simulation.fix("wall", 3); }
};

// Wall and particle move 0.049 towards each other: neither motion alone needs a new list.
TEST_F(Approach, OfBothWithinTheSkinIsSeen)
{
  open(0.097, "velocity 0 0 -49", "linear 0 0 49");
  simulation.run(10);
  EXPECT_NEAR(overlap(), 0.001, 1e-12);
  EXPECT_NEAR(force(), k1 * overlap(), 1e-9);
  EXPECT_LT(2.0 * 10.0 * 49.0 * dt, skin);
}

// The wall moves by more than the skin in each step.
TEST_F(Approach, OfAWallFasterThanTheSkinIsSeen)
{
  open(0.5, "velocity 0 0 -1500", "linear 0 0 0");
  simulation.run(3);
  EXPECT_EQ(force(), 0.0);
  simulation.run(1);
  EXPECT_NEAR(overlap(), 0.1, 1e-12);
  EXPECT_NEAR(force(), k1 * overlap(), 1e-8);
}

// The wall comes near while the particle is as far away as half the skin allows, and meets the
// particle at its nearest point: almost the whole skin closer, without a new neighbour list.
TEST_F(Approach, OfAParticleThatSwingsWithinTheSkinIsSeen)
{
  // z = 0.049 sin(2 pi t/0.02): lowest at step 150, where the wall has moved by half the skin,
  // highest at step 250
  open(0.13, "velocity 0 0 -3.4", "wiggle 0 0 0.049 0.02");
  simulation.run(230);
  EXPECT_EQ(force(), 0.0);
  go_on(simulation, 20);
  EXPECT_NEAR(overlap(), 0.004, 1e-12);
  EXPECT_NEAR(force(), k1 * overlap(), 1e-8);
}

// A wall leaves its particles in one step, by more than the margin. Their histories must be gone
// when it comes back.
TEST_F(Approach, AfterAWallHasJumpedAwayIsVirgin)
{
  simulation("variable speed equal -100*(step<=5)+4000*(step==6)-3970*(step==8)");
  open(0.0, "velocity 0 0 v_speed", "linear 0 0 0");
  simulation.run(5);    // to an overlap of 0.05, then 0.4 up, then 0.397 down
  EXPECT_NEAR(overlap(), 0.05, 1e-12);
  EXPECT_EQ(simulation.fix_row("wall", 1)[0], 1.0);
  simulation.run(2);
  EXPECT_EQ(force(), 0.0);
  EXPECT_EQ(simulation.fix_row("wall", 1)[0], 0.0);
  EXPECT_EQ(simulation.fix_row("wall", 1)[7], 0.0);
  simulation.run(3);
  EXPECT_GT(overlap(), 0.01);
  EXPECT_NEAR(force(), k1 * overlap(), 1e-8);
}

// A set-up call writes the table and leaves no history. A particle that is moved away after it is
// not visited again, but its row must become 0.
TEST_F(Approach, HasNoRowInTheTableAfterItIsTakenAway)
{
  open(-0.02, "", "linear 0 0 0");
  simulation.run(0);
  EXPECT_EQ(simulation.fix_row("wall", 1)[0], 1.0);
  EXPECT_NEAR(simulation.fix_row("wall", 1)[7], 0.02, 1e-12);
  simulation("displace_atoms all move 0 0 -2");
  simulation.run(0);
  for (const double value : simulation.fix_row("wall", 1)) EXPECT_EQ(value, 0.0);
}

// Neighbour lists that are made for a group do not bound the motion of other particles. LAMMPS does
// not even clear the forces on these, so the test moves them.
TEST(ParticleOutsideOfTheNeighbourGroup, IsSeen)
{
  Simulation simulation;
  simulation.open_box(5.0);
  simulation.create({{Vec3(3, 0, 0)}, {Vec3(0, 0, 0)}});
  simulation("group checked id 1\ngroup others id 2\natom_modify first checked\n"
             "neigh_modify include checked\npair_style zero 1.0\npair_coeff * *\ntimestep 1e-4\n"
             "fix carry others move linear 0 0 20\n"
             "fix wall all wall/gran/eepa linear coeff 1e4 4e4 0 0 0 wall zplane NULL 0.7");
  simulation.run(105);
  EXPECT_NEAR(simulation.fix("wall", 3), 1e4 * 0.01, 1e-8);
}

// fix adapt makes a particle grow until it touches, without a new neighbour list.
TEST(GrowingParticle, IsSeen)
{
  Simulation simulation;
  simulation("units si\natom_style sphere 1\natom_modify map array\nboundary f f f\n"
             "region box block -5 5 -5 5 -5 5\ncreate_box 1 box\ncomm_modify vel yes\n"
             "neighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\nthermo 1000000\n"
             "create_atoms 1 single 0 0 0\nset group all diameter 1 density 1\n"
             "pair_style zero 2.0\npair_coeff * *\ntimestep 1e-4\n"
             "variable d equal 1+0.001*step\nfix grow all adapt 1 atom diameter v_d\n"
             "fix wall all wall/gran/eepa linear coeff 1e4 4e4 0 0 0 wall zplane NULL 0.7");
  simulation.run(410);
  EXPECT_NEAR(simulation.fix("wall", 3), 1e4 * 0.005,
              6.0);    // by the diameter of this step or of the last one
}

/* ---------------------------------------------------------------------- insertion and ranks */

class ParallelCandidates : public testing::TestWithParam<const char *> {
 protected:
  /// Particles on a floor that move through ranks and boundaries, and more that fall in.
  static void open_sliding(Simulation &simulation, const std::string &neighbours)
  {
    int ranks;
    MPI_Comm_size(simulation.comm(), &ranks);
    simulation("processors " + std::to_string(ranks) + " 1 1");
    open_box(simulation, 3.0, "p p f");
    auto spheres = gas(3.0);
    for (auto &sphere : spheres) sphere.v += Vec3(30, -15, 0);
    simulation.create(spheres);
    const std::string law = "linear coeff 1e4 3e4 5e3 -0.1 0.5 restitution 0.8 wall zplane ";
    simulation(neighbours + "\npair_style zero 1.0\npair_coeff * *\ntimestep 1e-4\n" +
               "fix integrate all nve/sphere\nfix gravity all gravity 30 vector 0 0 -1\n"
               "fix floor all wall/gran/eepa " +
               law + "-2.6 NULL contacts\nfix top all wall/gran/eepa " + law +
               "NULL 2.8 velocity 0 0 -2");
  }
};

TEST_P(ParallelCandidates, AreNotLostOnTheWay)
{
  Simulation alone(MPI_COMM_SELF), together;
  open_sliding(alone, looks_at_all);
  open_sliding(together, GetParam());
  double touching = 0.0;
  alone.run(1);
  together.run(1);
  for (int look = 0; look < 20; look++) {
    go_on(alone, 100);
    go_on(together, 100);
    touching += alone.fix("floor", CONTACTS);
    EXPECT_EQ(alone.fix("floor", CONTACTS), together.fix("floor", CONTACTS));
    EXPECT_EQ(alone.fix("top", CONTACTS), together.fix("top", CONTACTS));
    const auto a = alone.particles(), b = together.particles();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); k++) {
      ASSERT_EQ(a[k].id, b[k].id);
      ASSERT_EQ(a[k].v, b[k].v) << a[k].id << " at look " << look;
    }
  }
  EXPECT_GT(touching, 80.0);
}

// Particles are inserted above the floor in mid-run and thrown onto it.
TEST_P(ParallelCandidates, AreFoundAmongThoseThatComeInMidRun)
{
  Simulation alone(MPI_COMM_SELF), together;
  open_sliding(alone, others[0]);    // fix adapt and fix deposit do not work together
  open_sliding(together, GetParam());
  for (auto *simulation : {&alone, &together}) {
    (*simulation)(
        "region slab block -2.9 2.9 -2.9 2.9 -1.9 -1.5\n"
        "fix deposit all deposit 150 1 7 4767 region slab attempt 200 vz -9 -3 units box");
    simulation->run(2000);
  }
  const auto a = alone.particles(), b = together.particles();
  ASSERT_EQ(a.size(), 350u);
  ASSERT_EQ(b.size(), 350u);
  int risen = 0;
  for (std::size_t k = 0; k < a.size(); k++) {
    ASSERT_EQ(a[k].id, b[k].id);
    EXPECT_EQ(a[k].x.z(), b[k].x.z()) << a[k].id;
    EXPECT_EQ(a[k].v, b[k].v) << a[k].id;
    risen += a[k].id > 200 && a[k].v.z() > 0.0;
  }
  EXPECT_GT(risen, 50);
}
INSTANTIATE_TEST_SUITE_P(Neighbours, ParallelCandidates, testing::Values(bounded, others[1]));

}    // namespace
