// SPDX-License-Identifier: GPL-2.0-only

// The same on one rank and on all: suites whose names begin with Parallel run with 1, 2 and 4
// ranks. The reference is a run of one rank beside the others (MPI_COMM_SELF on each).

#include "packing.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

int rank_count()
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

/// A drifting packing: particles change ranks and pass the periodic boundaries while in contact.
Packing drifting_packing()
{
  Packing packing;
  packing.polydisperse = true;
  packing.types = 2;
  return packing;
}

void open(Simulation &simulation, const std::string &pair, const std::string &boundary = "p p p",
          const std::string &newton = "on", const std::string &processors = "* * *")
{
  const Packing packing = drifting_packing();
  auto spheres = packing.spheres();
  if (boundary == "p p p")
    for (auto &sphere : spheres) sphere.v += Vec3(20, -15, 10);
  simulation("processors " + processors);
  simulation.open_box(boundary == "p p p" ? packing.half() : packing.half() + 0.5, packing.types,
                      boundary, newton);
  simulation.create(spheres);
  simulation(pair + "\nfix integrate all nve/sphere\ntimestep 2e-4");
}

constexpr const char *linear = "pair_style gran/eepa linear\n"
                               "pair_coeff 1 1 1e4 2e4 5e3 -1 0.5 restitution 0.8\n"
                               "pair_coeff 2 2 2e4 3e4 9e3 -2 0.3 restitution 0.7";
constexpr const char *plateau =
    "pair_style gran/eepa plateau scale 0.8\n"
    "pair_coeff * * 1e4 2e4 5e3 -1 0.5 viscous 1 1 rolling constant 0.1";
constexpr const char *rolling =
    "pair_style gran/eepa linear exponent 1.5\n"
    "pair_coeff * * 1e5 2e5 5e4 -1 0.5 kt 3e3 restitution 0.8 rolling sds 1e3 1 0.1 "
    "twisting marshall";

struct Grid {
  const char *name, *pair, *newton;
  int split;    ///< dimension that is cut into all ranks, 3 for LAMMPS's own choice
};

class ParallelPacking : public testing::TestWithParam<Grid> {};

// 1e-10: forces are summed in another order, 1e-16, over 300 steps of colliding particles.
TEST_P(ParallelPacking, MovesAsOnOneRank)
{
  const Grid &grid = GetParam();
  std::string processors = "* * *";
  if (grid.split < 3) {
    processors = "1 1 1";
    processors.replace(2 * static_cast<std::size_t>(grid.split), 1, std::to_string(rank_count()));
  }
  Simulation alone(MPI_COMM_SELF), together;
  open(alone, grid.pair);
  open(together, grid.pair, "p p p", grid.newton, processors);
  const auto start = alone.particles();
  for (auto *simulation : {&alone, &together}) {
    (*simulation)("compute n all gran/eepa/contacts\ncompute stress all pressure NULL virial\n"
                  "compute dt all gran/eepa/dt\nthermo_style custom step pe c_stress\nthermo 300");
    simulation->watch_contacts();
    simulation->run(300);
  }
  const auto a = alone.particles(), b = together.particles();
  EXPECT_LT(difference(a, b), 1e-10);
  EXPECT_GT((a[0].x - start[0].x).norm(), 1.0);    // drifted through ranks and boundaries

  const auto n = alone.compute_vector("n"), m = together.compute_vector("n");
  EXPECT_GT(n[0], 400.0);
  for (int k = 0; k < 5; k++) EXPECT_EQ(n[k], m[k]) << k;
  for (int k = 5; k < 8; k++) EXPECT_NEAR(n[k], m[k], 1e-10) << k;
  EXPECT_NEAR(alone.thermo("pe"), together.thermo("pe"), 1e-9 * std::fabs(alone.thermo("pe")));
  EXPECT_NEAR(alone.compute("stress"), together.compute("stress"),
              1e-9 * std::fabs(alone.compute("stress")));
  EXPECT_EQ(alone.compute("dt"), together.compute("dt"));

  // until the next set-up ghosts have the velocities of half a step before the end, which would
  // affect the dashpots' part of single()
  alone.run(0);
  together.run(0);
  const auto c = alone.contacts(), d = together.contacts();
  ASSERT_EQ(c.size(), d.size());
  for (std::size_t k = 0; k < c.size(); k++) {
    EXPECT_NEAR(c[k].max_overlap(), d[k].max_overlap(), 1e-11);
    EXPECT_NEAR(c[k].p[12], d[k].p[12], 1e-9);    // energy of the tangential spring
  }
}
const Grid grids[] = {
    {"linear", linear, "on", 3},   {"linear_newton_off", linear, "off", 3},
    {"linear_x", linear, "on", 0}, {"linear_z_newton_off", linear, "off", 2},
    {"plateau", plateau, "on", 3}, {"plateau_y_newton_off", plateau, "off", 1},
    {"rolling", rolling, "on", 3}, {"rolling_newton_off", rolling, "off", 3},
};
INSTANTIATE_TEST_SUITE_P(Grids, ParallelPacking, testing::ValuesIn(grids), [](const auto &info) {
  return std::string(info.param.name);
});

TEST(ParallelBalance, InMidRunKeepsHistories)
{
  Simulation alone(MPI_COMM_SELF), together;
  open(alone, linear);
  open(together, linear);
  together("fix balance all balance 20 1.0 shift xyz 5 1.0");
  for (auto *simulation : {&alone, &together}) simulation->run(200);
  EXPECT_LT(difference(alone.particles(), together.particles()), 1e-10);
}

TEST(ParallelFreeze, MassesOfGhostsAreKnown)
{
  Simulation alone(MPI_COMM_SELF), together;
  for (auto *simulation : {&alone, &together}) {
    open(*simulation, linear, "f f f");
    (*simulation)("group still id 1:50\nfix freeze still freeze");
    simulation->run(200);
  }
  EXPECT_LT(difference(alone.particles(), together.particles()), 1e-10);
}

TEST(ParallelRigid, BodyMassesOfGhostsAreKnown)
{
  for (const char *newton : {"on", "off"}) {
    Simulation alone(MPI_COMM_SELF), together;
    for (auto *simulation : {&alone, &together}) {
      open(*simulation, linear, "p p p", newton);
      // every third pair of neighbours becomes a dumbbell, all over the box; a dumbbell's own
      // contact is left out
      (*simulation)(
          "variable third atom (floor((id-1)/2)%3)==0\ngroup body variable third\n"
          "group free subtract all body\n"
          "variable pair atom floor((id+1)/2)\nfix pairs all property/atom mol ghost yes\n"
          "set group all mol v_pair\nfix bodies body rigid/small molecule\nneigh_modify exclude "
          "molecule/intra body\n"
          "unfix integrate\nfix integrate free nve/sphere");
      simulation->run(200);
    }
    EXPECT_LT(difference(alone.particles(), together.particles()), 1e-9);
  }
}

constexpr const char *walls =
    "fix x all wall/gran/eepa linear coeff 1e4 2e4 5e3 -1 0.5 restitution 0.8 wall xplane -2.9 2.9 "
    "velocity 0 1 0\n"
    "fix y all wall/gran/eepa plateau coeff 1e4 2e4 5e3 -1 0.5 viscous 1 1 rolling constant 0.1 "
    "wall yplane -2.9 2.9 wiggle z 0.02 0.1\n"
    "fix z all wall/gran/eepa linear coeff 1e4 2e4 5e3 -1 0.5 rolling sds 1e3 1 0.1 wall zplane "
    "-2.9 2.9 shear x 1 contacts";

TEST(ParallelWalls, MoveParticlesAndAddUpForces)
{
  Simulation alone(MPI_COMM_SELF), together;
  for (auto *simulation : {&alone, &together}) {
    open(*simulation, linear, "f f f");
    (*simulation)(walls);
    simulation->run(300);
  }
  EXPECT_LT(difference(alone.particles(), together.particles()), 1e-10);
  for (const char *wall : {"x", "y", "z"}) {
    for (int k = 1; k <= 12; k++) {
      const double value = alone.fix(wall, k);
      EXPECT_NEAR(together.fix(wall, k), value, 1e-8 * std::max(1.0, std::fabs(value)))
          << wall << k;
    }
    EXPECT_GT(alone.fix(wall, 6), 30.0);
  }
  const auto a = alone.fix_row("z", 7), b = together.fix_row("z", 7);
  ASSERT_EQ(a.size(), 11u);
  ASSERT_EQ(b.size(), 11u);
  for (std::size_t k = 0; k < a.size(); k++) EXPECT_NEAR(a[k], b[k], 1e-9) << k;
}

// Particles that slide along walls through ranks and boundaries take their wall histories along,
// and keep them when they are sorted.
TEST(ParallelWalls, HistoryTravelsWithTheParticles)
{
  const Packing packing = drifting_packing();
  auto spheres = packing.spheres();
  for (auto &sphere : spheres) sphere.v += Vec3(20, -15, 0);
  Simulation alone(MPI_COMM_SELF), together;
  for (auto *simulation : {&alone, &together}) {
    if (simulation == &together) {
      (*simulation)("processors " + std::to_string(rank_count()) + " 1 1\natom_modify sort 20 1.0");
    } else {
      (*simulation)("atom_modify sort 0 0.0");
    }
    simulation->open_box(packing.half(), packing.types, "p p f");
    simulation->create(spheres);
    (*simulation)(std::string(linear) +
                  "\nfix integrate all nve/sphere\ntimestep 2e-4\n"
                  "fix z all wall/gran/eepa plateau coeff 1e4 2e4 5e3 -1 0.1 rolling sds 1e3 1 0.1 "
                  "wall zplane -2.9 2.9");
    simulation->run(300);
  }
  EXPECT_GT(alone.fix("z", 6), 30.0);
  EXPECT_LT(difference(alone.particles(), together.particles()), 1e-10);
}

/// A communicator of the ranks below `count`; the others get MPI_COMM_NULL.
MPI_Comm first_ranks(int count)
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm comm;
  MPI_Comm_split(MPI_COMM_WORLD, rank < count ? 0 : MPI_UNDEFINED, rank, &comm);
  return comm;
}

/// The state of every contact, those with the z walls included: the same bits on any number of
/// ranks. The order of two partners may change, but not their largest overlap and the energies of
/// the springs.
std::vector<std::vector<double>> histories(const Simulation &simulation)
{
  std::vector<std::vector<double>> all;
  for (const auto &contact : simulation.contacts())
    all.push_back({contact.overlap(), contact.max_overlap(), contact.branch(), contact.p[11],
                   contact.p[12], contact.p[13]});
  for (const auto &particle : simulation.particles())
    all.push_back(simulation.fix_row("z", particle.id));
  return all;
}

// Restart files written by one number of ranks and read by another; the reference runs without a
// break.
TEST(ParallelRestart, GoesOnWithAnotherNumberOfRanks)
{
  const int all = rank_count();
  for (const auto &[writers, readers] : {std::pair(1, all), std::pair(all, (all + 1) / 2)}) {
    const ScratchFile file(".restart");
    Simulation reference(MPI_COMM_SELF);
    open(reference, rolling, "f f f");
    reference(walls);
    reference.run(150);
    reference.run(150);

    const std::string again =
        "comm_modify vel yes\nneighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
        "thermo 1000000\nfix integrate all nve/sphere\ntimestep 2e-4\n";
    std::vector<std::vector<double>> written;
    MPI_Comm comm = first_ranks(writers);
    if (comm != MPI_COMM_NULL) {
      Simulation writer(comm);
      open(writer, rolling, "f f f");
      writer(walls);
      writer.watch_contacts();
      writer.run(150);
      writer("write_restart " + file.name());
      writer.run(0);
      written = histories(writer);
    }
    if (comm != MPI_COMM_NULL) MPI_Comm_free(&comm);
    MPI_Barrier(MPI_COMM_WORLD);
    comm = first_ranks(readers);
    if (comm != MPI_COMM_NULL) {
      Simulation reader(comm);
      reader("read_restart " + file.name() + "\n" + again + walls);
      reader.watch_contacts();
      reader.run(0);
      const auto read = histories(reader);
      EXPECT_GT(read.size(), 500u);
      if (!written.empty()) { EXPECT_EQ(read, written) << writers << " to " << readers; }
      reader.run(150);
      EXPECT_LT(difference(reference.particles(), reader.particles()), 1e-10)
          << writers << " to " << readers;
      for (int k = 1; k <= 12; k++)
        EXPECT_NEAR(reader.fix("x", k), reference.fix("x", k), 1e-7) << k;
    }
    if (comm != MPI_COMM_NULL) MPI_Comm_free(&comm);
    MPI_Barrier(MPI_COMM_WORLD);
  }
}

// All ranks throw alike, and the instance can go on.
TEST(ParallelErrors, AreThrownOnAllRanks)
{
  Simulation simulation;
  open(simulation, linear);
  EXPECT_TRUE(refuses(simulation, "pair_coeff 1 1 1e4 1e3 0 0 0", "k2 = 1000 is not allowed"));
  EXPECT_TRUE(refuses(simulation, "pair_style gran/eepa linear dtcheck error\ntimestep 1\nrun 0",
                      "timestep 1 is larger than"));
  EXPECT_EQ(error_of(simulation, "timestep 1e-4\nrun 1 post no"), "");
}

}    // namespace
