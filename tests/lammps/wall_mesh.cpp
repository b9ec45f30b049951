// SPDX-License-Identifier: GPL-2.0-only

// wall mesh: surfaces of triangles against the same surfaces of planes, whatever their triangulation.

#include "packing.h"
#include "triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

using namespace eepa_test;

namespace {

constexpr int CONTACTS = 6;
const std::string law =
    " all wall/gran/eepa linear coeff 1e4 2e4 5e3 -0.1 0.5 restitution 0.7 rolling sds 1e3 0.1 0.1 "
    "twisting marshall wall ";

/// Particles that bounce, roll and slide, with gravity along no axis.
void open(Simulation &simulation, double half, double time_step = 1e-4)
{
  Packing packing;
  packing.side = 3;
  packing.spacing = 1.1;
  packing.speed = 3.0;
  packing.polydisperse = true;
  simulation.open_box(half);
  simulation.create(packing.spheres());
  // particles do not see each other: their collisions would amplify rounding
  simulation("pair_style zero 1.0\npair_coeff * *\n"
             "neighbor 0.3 bin\nfix integrate all nve/sphere\n"
             "fix g all gravity 10 vector 0.3 0.2 -1\ncompute e all gran/eepa/energy\ntimestep " +
             exact(time_step));
}

double energy(const Simulation &simulation)
{
  const std::vector<double> e = simulation.compute_vector("e");
  double total = -e[8] + e[9] + e[10];
  for (int k = 0; k < 8; k++) total += e[k];
  const Vec3 gravity = 10.0 * Vec3(0.3, 0.2, -1).normalized();
  for (const Particle &p : simulation.particles())
    total += p.kinetic_energy() - p.mass * gravity.dot(p.x);
  return total;
}

struct Cut {
  const char *name;
  int cells;    ///< along each side of a face of the box
  bool random;
};

class ParallelMeshBox : public testing::TestWithParam<Cut> {};

// 10^4 steps of bouncing, rolling and sliding in a box: 12 triangles to 20,000.
TEST_P(ParallelMeshBox, IsSixPlanes)
{
  const ScratchFile file(".stl");
  write_stl(file.name(), box(2.25, GetParam().cells, GetParam().random));
  Simulation planes, mesh;
  open(planes, 3.5);
  planes("fix w" + law + "zplane -2.25 2.25\nfix wx" + law + "xplane -2.25 2.25\nfix wy" + law +
         "yplane -2.25 2.25");
  open(mesh, 3.5);
  mesh("fix w" + law + "mesh " + file.name());
  planes.run(0);
  mesh.run(0);
  const double before = energy(mesh);
  double contacts = 0.0;
  for (int part = 0; part < 20; part++) {
    planes.run(500);
    mesh.run(500);
    EXPECT_LT(difference(planes.particles(), mesh.particles()), 1e-10) << part;
    const double other =
        planes.fix("w", CONTACTS) + planes.fix("wx", CONTACTS) + planes.fix("wy", CONTACTS);
    EXPECT_EQ(mesh.fix("w", CONTACTS), other) << part;
    contacts += other;
  }
  EXPECT_GT(contacts, 100.0);
  EXPECT_LT(std::fabs(energy(mesh) - before), 2e-3 * std::fabs(before));
}

INSTANTIATE_TEST_SUITE_P(Cuts, ParallelMeshBox,
                         testing::Values(Cut{"TwelveTriangles", 1, false}, Cut{"Regular", 7, false},
                                         Cut{"Random", 10, true}, Cut{"TwentyThousand", 41, true}),
                         [](const auto &info) {
                           return info.param.name;
                         });

}    // namespace
