// SPDX-License-Identifier: GPL-2.0-only

// Clumps poured from a molecule template, with LAMMPS's packages MOLECULE and RIGID and this
// package's contacts.

#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace eepa_test;

namespace {

constexpr int clumps = 24;
constexpr double arm = 0.8e-3, mass = 6e-6;

constexpr const char *row_of_three =
    "three spheres in a row\n\n3 atoms\n\n"
    "Coords\n\n1 -0.8e-3 0 0\n2 0 0 0\n3 0.8e-3 0 0\n\nTypes\n\n1 1\n2 1\n3 1\n\n"
    "Diameters\n\n1 2e-3\n2 2e-3\n3 2e-3\n\nMasses\n\n1 6e-6\n2 6e-6\n3 6e-6\n";

// At rest the floor carries their weight, clumps keep their shape, and neighbours touch.
TEST(ParallelClumps, PouredFromATemplateSettleOnAFloor)
{
  Simulation simulation;
  const ScratchFile molecule(".mol", simulation.comm());
  int rank;
  MPI_Comm_rank(simulation.comm(), &rank);
  if (rank == 0) std::ofstream(molecule.name()) << row_of_three;
  MPI_Barrier(simulation.comm());

  simulation("units si\natom_style hybrid sphere bond\natom_modify map array\ncomm_modify vel yes\n"
             "boundary p p f\nregion box block 0 0.012 0 0.012 0 0.04\ncreate_box 1 box\n"
             "neigh_modify exclude molecule/intra all\nneighbor 4e-4 bin\n"
             "molecule clump " +
             molecule.name() +
             "\n"
             "pair_style gran/eepa linear\n"
             "pair_coeff * * 500 1e3 100 -1e-5 0.5 restitution 0.4 rolling sds 100 0.01 0.1\n"
             "fix floor all wall/gran/eepa linear coeff 500 1e3 100 -1e-5 0.5 restitution 0.4 "
             "rolling sds 100 0.01 0.1 wall zplane 0 NULL\n"
             "fix gravity all gravity 9.81 vector 0 0 -1\n"
             "fix move all rigid/small molecule mol clump\n"
             "region pour block 0 0.012 0 0.012 0.02 0.036\n"
             "fix pour all pour " +
             std::to_string(clumps) +
             " 0 4767 region pour mol clump rigid move\n"
             "thermo_modify lost error\ntimestep 1e-5");
  simulation.watch_contacts();
  simulation.run(30000);

  const auto particles = simulation.particles();
  ASSERT_EQ(particles.size(), 3u * clumps);
  for (std::size_t k = 0; k < particles.size(); k += 3) {
    EXPECT_NEAR((particles[k].x - particles[k + 1].x).norm(), arm, 1e-12);
    EXPECT_NEAR((particles[k].x - particles[k + 2].x).norm(), 2.0 * arm, 1e-12);
  }
  const double weight = 3.0 * clumps * mass * 9.81;
  EXPECT_NEAR(simulation.wall_force("floor").z(), -weight, 1e-4 * weight);
  int between = 0;
  for (const auto &c : simulation.contacts()) {
    EXPECT_NE((c.i - 1) / 3, (c.j - 1) / 3) << "contact within a clump: " << c.i << " " << c.j;
    between++;
  }
  EXPECT_GT(between, clumps);
  const double settled = simulation.thermo("ke");
  EXPECT_LT(settled, 1e-9);
}

}    // namespace
