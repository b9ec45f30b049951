// SPDX-License-Identifier: GPL-2.0-only

// compute gran/eepa/energy/atom: dissipation of each particle, against the ledger of all.

#include "packing.h"

#include "atom.h"
#include "compute.h"
#include "lammps.h"
#include "modify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

using namespace eepa_test;

namespace {

constexpr int kinds = 6;
// of compute gran/eepa/energy: hysteresis, dashpots, sliding, rolling; twisting last
constexpr int of_ledger[kinds] = {3, 4, 5, 6, 7, 10};

/// Rows of the compute on this rank, by ID.
std::map<int, std::vector<double>> rows(const Simulation &simulation, const std::string &id)
{
  auto *compute = simulation.lammps()->modify->get_compute_by_id(id);
  compute->compute_peratom();
  const auto *atom = simulation.lammps()->atom;
  std::map<int, std::vector<double>> found;
  for (int i = 0; i < atom->nlocal; i++)
    found[static_cast<int>(atom->tag[i])] = {compute->array_atom[i],
                                             compute->array_atom[i] + kinds};
  return found;
}

std::vector<double> sums(const Simulation &simulation, const std::string &id)
{
  std::vector<double> mine(kinds, 0.0), all(kinds);
  for (const auto &row : rows(simulation, id))
    for (int k = 0; k < kinds; k++) mine[k] += row.second[k];
  MPI_Allreduce(mine.data(), all.data(), kinds, MPI_DOUBLE, MPI_SUM, simulation.comm());
  return all;
}

void expect_sums_of_ledger(const Simulation &simulation)
{
  const auto ledger = simulation.compute_vector("ledger");
  const auto found = sums(simulation, "atoms");
  for (int k = 0; k < kinds; k++) {
    EXPECT_NEAR(found[k], ledger[of_ledger[k]], 1e-12 * ledger[of_ledger[k]]) << k;
    EXPECT_GT(found[k], 0.0) << k;
  }
}

class ParallelAtomLosses : public testing::TestWithParam<const char *> {
 protected:
  Packing packing;

  /// A shaken packing between a floor and a moving top, periodic at the sides.
  void prepare(Simulation &simulation, const std::string &pair_style = "gran/eepa")
  {
    packing.side = 6;
    packing.speed = 2.0;
    simulation.open_box(packing.half(), 1, "p p f", GetParam());
    simulation("change_box all z final -" + exact(packing.half() + 1.0) + " " +
               exact(packing.half() + 1.0));
    simulation.create(packing.spheres());
    const std::string coefficients =
        " 1e4 2e4 5e3 -1 0.3 restitution 0.7 rolling sds 2e3 1 0.1 twisting marshall";
    simulation("pair_style " + pair_style + " linear\npair_coeff * *" + coefficients +
               "\nfix walls all wall/gran/eepa linear coeff" + coefficients + " wall zplane -" +
               exact(packing.half()) + " " + exact(packing.half()) +
               "\nfix integrate all nve/sphere\ntimestep 2e-4\n"
               "compute ledger all gran/eepa/energy\ncompute atoms all gran/eepa/energy/atom");
  }
};

TEST_P(ParallelAtomLosses, AddUpToTheLedger)
{
  Simulation simulation;
  prepare(simulation);
  simulation.run(400);
  expect_sums_of_ledger(simulation);
  simulation.run(100);    // a second run continues the sums
  expect_sums_of_ledger(simulation);
}

// Each particle's own sums, whichever ranks it was on.
TEST_P(ParallelAtomLosses, AreThoseOfOneRank)
{
  Simulation simulation, alone(MPI_COMM_SELF);
  prepare(simulation);
  prepare(alone);
  simulation.run(150);
  alone.run(150);
  const auto expected = rows(alone, "atoms");
  double largest = 0.0;
  for (const auto &row : expected)
    for (const double value : row.second) largest = std::max(largest, value);
  for (const auto &row : rows(simulation, "atoms"))
    for (int k = 0; k < kinds; k++)
      EXPECT_NEAR(row.second[k], expected.at(row.first)[k], 1e-9 * largest) << row.first;
}

#ifdef _OPENMP
TEST_P(ParallelAtomLosses, HaveTheSameBitsEachTimeWithThreads)
{
  std::map<int, std::vector<double>> found[2];
  for (auto &one : found) {
    Simulation simulation;
    simulation("package omp 3");
    prepare(simulation, "gran/eepa/omp");
    simulation.run(150);
    one = rows(simulation, "atoms");
    expect_sums_of_ledger(simulation);
  }
  EXPECT_EQ(found[0], found[1]);
}
#endif
INSTANTIATE_TEST_SUITE_P(Newton, ParallelAtomLosses, testing::Values("on", "off"));

// Half of a contact's loss goes to each partner, the whole loss at a wall to the particle, nothing
// to others.
TEST(AtomLosses, AreHalvedBetweenParticlesAndWholeAtAWall)
{
  Simulation simulation;
  simulation.open_box(5.0);
  Sphere left, right, falling, idle;
  left.x = Vec3(-0.51, 0.0, 0.0);
  left.v = Vec3(1.0, 0.0, 0.0);
  right.x = Vec3(0.51, 0.0, 0.0);
  right.density = 5.0 * unit_density;
  falling.x = Vec3(0.0, 3.0, -3.45);
  falling.v = Vec3(0.0, 0.0, -1.0);
  idle.x = Vec3(0.0, -3.0, 0.0);
  simulation.create({left, right, falling, idle});
  const std::string coefficients = " 1e4 4e4 0 0 0";
  simulation("pair_style gran/eepa linear\npair_coeff * *" + coefficients +
             "\nfix floor all wall/gran/eepa linear coeff" + coefficients +
             " wall zplane -4 NULL\nfix integrate all nve/sphere\ntimestep 1e-5\n"
             "group some id 1 3\ncompute atoms some gran/eepa/energy/atom\n"
             "compute all all gran/eepa/energy/atom");
  simulation.run(12000);
  const auto all = rows(simulation, "all"), some = rows(simulation, "atoms");
  // 1 - k1/k2 of the relative motion's kinetic energy, reduced mass 5/6
  EXPECT_NEAR(all.at(1)[0], 0.5 * 0.75 * 0.5 * 5.0 / 6.0, 1e-4);
  EXPECT_EQ(all.at(1)[0], all.at(2)[0]);
  EXPECT_NEAR(all.at(3)[0], 0.75 * 0.5, 1e-4);
  EXPECT_EQ(all.at(4)[0], 0.0);
  for (int k = 1; k < kinds; k++) EXPECT_EQ(all.at(1)[k], 0.0);
  EXPECT_EQ(some.at(1), all.at(1));
  EXPECT_EQ(some.at(3), all.at(3));
  EXPECT_EQ(some.at(2)[0], 0.0);    // not in the group
}

}    // namespace
