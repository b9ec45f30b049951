// SPDX-License-Identifier: GPL-2.0-only

// Meshes in boxes of all kinds, and a prism that becomes a cylinder.

#include "packing.h"
#include "triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

using namespace eepa_test;

namespace {

constexpr int CONTACTS = 6;
const std::string wall =
    "fix w all wall/gran/eepa linear coeff 1e4 2e4 5e3 -0.1 0.5 restitution 0.6 "
    "rolling sds 1e3 0.1 0.1 wall mesh ";

void open(Simulation &simulation, const std::string &region, const std::string &boundary)
{
  simulation("units si\natom_style sphere\natom_modify map array\nboundary " + boundary +
             "\nregion box " + region +
             "\ncreate_box 1 box\ncomm_modify vel yes\nneighbor 0.1 bin\nthermo 1000000");
}

void run_in(Simulation &simulation, const std::vector<Sphere> &spheres, const std::string &file)
{
  simulation.create(spheres);
  simulation("pair_style zero 1.0\npair_coeff * *\nfix move all nve/sphere\ntimestep 1e-4\n" +
             wall + file);
}

struct Box {
  const char *name, *region, *boundary;
};
class BoxesAroundAMesh : public testing::TestWithParam<Box> {};

TEST_P(BoxesAroundAMesh, ChangeNothing)
{
  const ScratchFile file(".stl");
  write_stl(file.name(), box(2.0, 5, true));
  Packing packing;
  packing.side = 3;
  packing.spacing = 1.1;
  packing.speed = 4.0;
  Simulation plain, other;
  open(plain, "block -5 5 -5 5 -5 5", "f f f");
  open(other, GetParam().region, GetParam().boundary);
  double contacts = 0.0;
  for (auto *simulation : {&plain, &other}) run_in(*simulation, packing.spheres(), file.name());
  for (int look = 0; look < 10; look++) {
    plain.run(500);
    other.run(500);
    EXPECT_LT(difference(plain.particles(), other.particles()), 1e-11) << look;
    EXPECT_EQ(plain.fix("w", CONTACTS), other.fix("w", CONTACTS)) << look;
    contacts += plain.fix("w", CONTACTS);
  }
  EXPECT_GT(contacts, 15.0);
}
const Box boxes[] = {
    {"periodic", "block -2.6 2.6 -2.6 2.6 -2.6 2.6", "p p p"},
    {"shrunk", "block -5 5 -5 5 -5 5", "s s s"},
    {"tilted", "prism -5 5 -5 5 -5 5 2 -1 1.5", "f f f"},
    {"tilted_periodic", "prism -3 3 -3 3 -3 3 1 -0.5 0.7", "p p p"},
};
INSTANTIATE_TEST_SUITE_P(Boxes, BoxesAroundAMesh, testing::ValuesIn(boxes), [](const auto &info) {
  return std::string(info.param.name);
});

// Particles that leave a periodic box come back from the other side, and meet the mesh there.
TEST(MeshInAPeriodicBox, IsMetFromTheOtherSide)
{
  const ScratchFile file(".stl");
  write_stl(file.name(), box(0.8, 3));
  const auto spheres = [](double shift) {
    return std::vector<Sphere>{{Vec3(2.5 - shift, 0.1, 0.2), Vec3(5, 0.3, -0.2), Vec3(1, 2, 3)}};
  };
  Simulation periodic, open_one;
  open(periodic, "block -3 3 -3 3 -3 3", "p p p");
  open(open_one, "block -9 9 -9 9 -9 9", "f f f");
  run_in(periodic, spheres(0.0), file.name());
  run_in(open_one, spheres(6.0), file.name());
  periodic.run(8000);
  open_one.run(8000);
  const Particle a = periodic.particle(1), b = open_one.particle(1);
  EXPECT_LT(b.v.x(), -1.0);
  EXPECT_LT((a.v - b.v).norm(), 1e-11);
  EXPECT_LT((a.omega - b.omega).norm(), 1e-11);
  EXPECT_NEAR(std::remainder(a.x.x() - b.x.x(), 6.0), 0.0, 1e-11);
}

// A sphere swings in the lower half of a tube: facets throw it off its path the less the more there are.
TEST(Prism, BecomesACylinder)
{
  const double radius = 3.0, time_step = 1e-4;
  const auto path_in = [&](const std::string &tube) {
    Simulation simulation;
    simulation.open_box(6.0);
    simulation.create(
        {{Vec3(-(radius - 0.5) * std::cos(0.4), -(radius - 0.5) * std::sin(0.4), 0)}});
    simulation("pair_style zero 1.0\npair_coeff * *\nfix move all nve/sphere\nneighbor 0.3 bin\n"
               "fix g all gravity 10 vector -1 0 0\ntimestep " +
               exact(time_step) +
               "\nfix w all wall/gran/eepa linear coeff 1e5 1e5 0 0 0.8 restitution 0.1 wall " +
               tube);
    std::vector<Vec3> path;
    for (int k = 0; k < 20; k++) {
      simulation.run(500);
      path.push_back(simulation.particle(1).x);
    }
    return path;
  };
  const std::vector<Vec3> exact_path = path_in("zcylinder 3");
  std::vector<double> off;
  for (const int facets : {256, 128, 64, 32}) {
    const ScratchFile file(".stl");
    const double step = 2.0 * pi / facets;
    write_stl(file.name(), prism(facets, radius * std::sqrt(step / std::sin(step)), 4.0, false));
    const auto path = path_in("mesh " + file.name() + " smooth 15");
    double most = 0.0;
    for (std::size_t k = 0; k < path.size(); k++)
      most = std::max(most, (path[k] - exact_path[k]).norm());
    off.push_back(most);
    std::printf("%d facets: off by %.3g\n", facets, most);
  }
  for (std::size_t k = 1; k < off.size(); k++) EXPECT_GT(off[k], 1.8 * off[k - 1]);
  EXPECT_LT(off[0], 2e-3);
}

}    // namespace
