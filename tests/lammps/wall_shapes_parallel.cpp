// SPDX-License-Identifier: GPL-2.0-only

// Meshes and regions on several ranks: drums and boxes of triangles with particles that change ranks while they
// are in contact, and restarts on other numbers of ranks. The reference is a run of one rank beside the
// others.

#include "packing.h"
#include "triangles.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

constexpr int CONTACTS = 6, VECTOR = 24;
constexpr std::size_t BRANCH = 9;    // in the table of contacts, from 0
const std::string law =
    " all wall/gran/eepa linear coeff 1e4 2e4 5e3 -0.1 0.5 restitution 0.7 rolling sds 1e3 0.1 0.1 "
    "twisting marshall wall ";

int rank_count()
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

/// What is in the drum or box, and how it is run.
struct Case {
  const char *name;
  std::string wall;    ///< what follows the name of the file, or commands that make region r
  std::vector<Corners> triangles;    ///< of the file; none for a region
  const char *newton;
  int split;    ///< dimension that is cut into all ranks, 3 for LAMMPS's own choice
  const char *more;
};

/// The commands of the wall; a file for it is written before.
std::string wall_of(const Case &one, const std::string &file)
{
  if (one.triangles.empty()) return one.wall + "\nfix w" + law + "region r contacts" + one.more;
  return "fix w" + law + "mesh " + file + " " + one.wall + " contacts" + one.more;
}

constexpr const char *settings =
    "comm_modify vel yes\nneighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
    "thermo 1000000\nfix integrate all nve/sphere\nfix g all gravity 10 vector 0.3 0.2 -1\n"
    "timestep 2e-4\n";

/// A packing that turns with the wall, so that it goes through the ranks along it.
void open(Simulation &simulation, const Case &one, int ranks)
{
  Packing packing;
  packing.side = 5;
  packing.polydisperse = true;
  packing.speed = 1.0;
  auto spheres = packing.spheres();
  std::vector<Sphere> inside;
  for (auto &sphere : spheres) {
    if (sphere.x.head<2>().norm() > 2.4) continue;
    sphere.v += Vec3(0, 0, 12).cross(sphere.x);
    inside.push_back(sphere);
  }
  std::string processors = "* * *";
  if (one.split < 3) {
    processors = "1 1 1";
    processors.replace(2 * static_cast<std::size_t>(one.split), 1, std::to_string(ranks));
  }
  simulation("processors " + processors);
  simulation.open_box(3.5, 1, "f f f", one.newton);
  simulation.create(inside);
  simulation(std::string("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -0.1 0.5 "
                         "restitution 0.7\n") +
             settings);
}

const std::vector<Case> &cases()
{
  static const std::vector<Case> all = {
      {"Drum", "rotate 0 0 0 0 0 1 12", prism(36, 2.75, 2.6, true), "on", 3, ""},
      {"DrumNewtonOff", "rotate 0 0 0 0 0 1 12 velocity 0.3 0 0", prism(36, 2.75, 2.6, true), "off",
       0, "\nfix balance all balance 40 1.0 shift xyz 5 1.0"},
      {"OctagonOffItsAxis", "rotate 0.3 0.2 0 0.1 0 1 12", prism(8, 3.0, 2.7, true), "on", 1, ""},
      {"Box", "wiggle x 0.05 0.13 rotate 0 0 0 0 0 1 12", box(2.6, 5, true), "on", 0,
       "\nfix balance all balance 40 1.0 shift xyz 5 1.0"},
      {"Lid", "rotation 1 0 0 90 load y -300 mass 50 damping 5 rotate 0 0 0 0 1 0 2",
       prism(40, 2.8, 2.6, true), "on", 3, ""},
      {"Roller", "load x -900 mass 50 damping 5 rotate 0.1 0 0 0 0 1 12", prism(36, 2.8, 2.6, true),
       "on", 3, ""},
      {"Region", "region r cylinder z 0 0 2.7 -2.6 2.6", {}, "on", 3, " rotate 0 0 0 0 0 1 12"},
      {"MovingRegion",
       "variable a equal 12*step*dt\nregion r block -2.6 2.6 -2.6 2.6 -2.6 2.6 rotate v_a 0 0 0 0 "
       "0 1",
       {},
       "off",
       0,
       "\nfix balance all balance 40 1.0 shift xyz 5 1.0"},
      {"BreathingRegion",
       "variable size equal 2.72+0.05*sin(70*step*dt)\nregion r cylinder z 0 0 v_size -2.6 2.6",
       {},
       "on",
       3,
       " rotate 0 0 0 0 0 1 12"},
  };
  return all;
}

class ParallelShapes : public testing::TestWithParam<Case> {};

TEST_P(ParallelShapes, MoveParticlesAsOnOneRank)
{
  const Case &one = GetParam();
  const ScratchFile file(".stl");
  write_stl(file.name(), one.triangles);
  Simulation alone(MPI_COMM_SELF), together;
  open(alone, one, 1);
  open(together, one, rank_count());
  const auto start = alone.particles();
  double contacts = 0.0;
  for (int part = 0; part < 4; part++) {
    for (Simulation *simulation : {&alone, &together}) {
      if (part == 0) (*simulation)(wall_of(one, file.name()));
      simulation->run(150);
    }
    EXPECT_LT(difference(alone.particles(), together.particles()), 1e-10) << part;
    for (int k = 1; k <= VECTOR; k++) {
      const double value = alone.fix("w", k);
      EXPECT_NEAR(together.fix("w", k), value, 1e-8 * std::max(1.0, std::fabs(value))) << k;
    }
    contacts += alone.fix("w", CONTACTS);
  }
  EXPECT_GT(contacts, 60.0);
  double way = 0.0;
  const auto end = alone.particles();
  for (std::size_t k = 0; k < end.size(); k++) way = std::max(way, (end[k].x - start[k].x).norm());
  EXPECT_GT(way, 1.5);
  int touching = 0;
  for (const Particle &p : end) {
    const auto a = alone.fix_row("w", p.id), b = together.fix_row("w", p.id);
    ASSERT_EQ(b.size(), 11u);
    touching += a[0] > 0.0;
    for (std::size_t k = 0; k < a.size(); k++)
      EXPECT_NEAR(a[k], b[k], 1e-8 * std::max(1.0, std::fabs(a[k]))) << p.id << " " << k;
  }
  EXPECT_GT(touching, 10);
}
INSTANTIATE_TEST_SUITE_P(Walls, ParallelShapes, testing::ValuesIn(cases()), [](const auto &info) {
  return std::string(info.param.name);
});

/// A communicator of the ranks below `count`; the others get MPI_COMM_NULL.
MPI_Comm first_ranks(int count)
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm comm;
  MPI_Comm_split(MPI_COMM_WORLD, rank < count ? 0 : MPI_UNDEFINED, rank, &comm);
  return comm;
}

std::vector<std::vector<double>> rows(const Simulation &simulation)
{
  std::vector<std::vector<double>> all;
  for (const auto &particle : simulation.particles())
    all.push_back(simulation.fix_row("w", particle.id));
  return all;
}

class ParallelShapeRestart : public testing::TestWithParam<Case> {};

// In the middle of contacts, of a rotation and of a loaded lid; written and read on other numbers of ranks.
TEST_P(ParallelShapeRestart, GoesOnWithAnotherNumberOfRanks)
{
  const Case &one = GetParam();
  const ScratchFile stl(".stl");
  write_stl(stl.name(), one.triangles);
  const std::string wall = wall_of(one, stl.name());
  const int all = rank_count();
  for (const auto &[writers, readers] : {std::pair(1, all), std::pair(all, (all + 1) / 2)}) {
    const ScratchFile file(".restart");
    Simulation reference(MPI_COMM_SELF);
    open(reference, one, 1);
    reference(wall);
    reference.run(250);
    reference.run(250);
    std::vector<std::vector<double>> written;
    MPI_Comm comm = first_ranks(writers);
    if (comm != MPI_COMM_NULL) {
      Simulation writer(comm);
      open(writer, one, writers);
      writer(wall);
      writer.run(250);
      writer("write_restart " + file.name());
      writer.run(0);
      written = rows(writer);
      MPI_Comm_free(&comm);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    comm = first_ranks(readers);
    if (comm != MPI_COMM_NULL) {
      Simulation reader(comm);
      reader("read_restart " + file.name() + "\n" + settings + wall);
      reader.run(0);
      const auto read = rows(reader);
      ASSERT_GT(read.size(), 50u);
      int touching = 0;
      for (std::size_t k = 0; k < written.size(); k++)
        for (std::size_t c = 0; c < written[k].size(); c++) {
          // fix balance changes the last bits of positions, and so branches at the largest overlap
          if (c == BRANCH) continue;
          touching += c == 0 && written[k][0] > 0.0;
          EXPECT_NEAR(read[k][c], written[k][c], 1e-10 * std::max(1.0, std::fabs(written[k][c])))
              << k << " " << c;
        }
      if (!written.empty()) { EXPECT_GT(touching, 10); }
      reader.run(250);
      EXPECT_LT(difference(reference.particles(), reader.particles()), 1e-10)
          << writers << " to " << readers;
      for (int k = 1; k <= VECTOR; k++) {
        const double value = reference.fix("w", k);
        EXPECT_NEAR(reader.fix("w", k), value, 1e-8 * std::max(1.0, std::fabs(value))) << k;
      }
      MPI_Comm_free(&comm);
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
}
INSTANTIATE_TEST_SUITE_P(Walls, ParallelShapeRestart, testing::ValuesIn(cases()),
                         [](const auto &info) {
                           return std::string(info.param.name);
                         });

}    // namespace
