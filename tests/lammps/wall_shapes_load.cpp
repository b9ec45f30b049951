// SPDX-License-Identifier: GPL-2.0-only

// Meshes and regions that are pressed and turned: a pressed mesh is a pressed plane, and what lids, drums and
// moving regions do to particles is in the energy ledger.

#include "packing.h"
#include "triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

using namespace eepa_test;

namespace {

constexpr int POSITION = 4, VELOCITY = 5, CONTACTS = 6, LOAD_FORCE = 13, LOAD_KINETIC_ENERGY = 14,
              LOAD_WORK = 15, LOAD_DISSIPATED = 16, TORQUE_X = 17, TORQUE_Y = 18, TORQUE_Z = 19,
              ANGLE = 20;
const std::string law =
    " all wall/gran/eepa linear coeff 1e4 2e4 5e3 -0.1 0.5 restitution 0.7 rolling sds 1e3 0.1 0.1 "
    "wall ";

/// Particles on a floor between planes, that do not see each other; the lid is left to the test.
void open_cup(Simulation &simulation)
{
  Packing packing;
  packing.side = 4;
  packing.spacing = 1.05;
  packing.polydisperse = true;
  simulation.open_box(9.0);
  simulation.create(packing.spheres());
  simulation("pair_style zero 1.0\npair_coeff * *\nneighbor 0.3 bin\nfix move all nve/sphere\n"
             "fix g all gravity 10 vector 0.1 0.05 -1\ntimestep 1e-4\nfix floor" +
             law + "zplane -2.3 NULL\nfix x" + law + "xplane -2.3 2.3\nfix y" + law +
             "yplane -2.3 2.3");
}

class PressedMesh : public testing::TestWithParam<const char *> {};

// The underside of a box of triangles in place of a plane, whose force rises and falls, and which a limit
// stops for a while; one that turns meanwhile drags the particles along.
TEST_P(PressedMesh, IsAPressedPlane)
{
  const ScratchFile file(".stl");
  write_stl(file.name(), box(4.0, 9, true));
  const std::string load = "v_push mass 20 damping 4 limits ", turn = GetParam();
  Simulation plane, mesh;
  for (auto *simulation : {&plane, &mesh}) {
    open_cup(*simulation);
    (*simulation)("variable push equal -400*(1-cos(30*step*dt))-50");
  }
  plane("fix lid" + law + "zplane NULL 2.5 load " + load + "0.9 NULL" + turn);
  mesh("fix lid" + law + "mesh " + file.name() + " offset 0 0 6.5 load z " + load + "-1.6 NULL" +
       turn);
  double pressed = 0.0, fastest = 0.0, stopped = 0.0;
  for (int look = 0; look < 50; look++) {
    plane.run(200);
    mesh.run(200);
    EXPECT_LT(difference(plane.particles(), mesh.particles()), 1e-10) << look;
    EXPECT_NEAR(plane.fix("lid", POSITION) - 2.5, mesh.fix("lid", POSITION), 1e-10) << look;
    EXPECT_NEAR(plane.fix("lid", VELOCITY), mesh.fix("lid", VELOCITY), 1e-9) << look;
    EXPECT_EQ(plane.fix("lid", CONTACTS), mesh.fix("lid", CONTACTS)) << look;
    const double scale = std::max(1.0, plane.wall_force("lid").norm());
    EXPECT_LT((plane.wall_force("lid") - mesh.wall_force("lid")).norm(), 1e-9 * scale) << look;
    for (const int k : {TORQUE_X, TORQUE_Y, TORQUE_Z})
      EXPECT_NEAR(plane.fix("lid", k), mesh.fix("lid", k), 1e-9 * scale) << k << " at " << look;
    EXPECT_EQ(plane.fix("lid", ANGLE), mesh.fix("lid", ANGLE)) << look;
    for (const int k : {LOAD_FORCE, LOAD_KINETIC_ENERGY, LOAD_WORK, LOAD_DISSIPATED})
      EXPECT_NEAR(plane.fix("lid", k), mesh.fix("lid", k), 1e-8) << k << " at look " << look;
    pressed = std::max(pressed, plane.wall_force("lid").z());
    fastest = std::max(fastest, std::fabs(plane.fix("lid", VELOCITY)));
    stopped += mesh.fix("lid", POSITION) == -1.6;
  }
  EXPECT_GT(pressed, 100.0);
  EXPECT_GT(fastest, 0.5);
  EXPECT_GT(stopped, 2.0);
  const double angle = mesh.fix("lid", ANGLE);
  EXPECT_EQ(angle != 0.0, !turn.empty());
  std::printf("largest force %g, velocity %g, at the limit %g of 50, turned by %g\n", pressed,
              fastest, stopped, angle);
}
INSTANTIATE_TEST_SUITE_P(Lids, PressedMesh, testing::Values("", " rotate 0.3 -0.2 0 0 0 1 3"));

/// Kinetic and potential energy of particles and all of the ledger, less the work of the walls.
double energy(const Simulation &simulation)
{
  const auto e = simulation.compute_vector("ledger");
  double sum = std::accumulate(e.begin(), e.begin() + 8, 0.0) - e[8] + e[9] + e[10];
  for (const Particle &p : simulation.particles())
    sum += p.kinetic_energy() + 10.0 * p.mass * p.x.z();
  return sum;
}

struct Machine {
  const char *name, *walls;
  double least_work;
  const char *changes[2] = {nullptr, nullptr};    ///< of the drive, at a third and two thirds
};

class LedgerOfMachines : public testing::TestWithParam<Machine> {
 protected:
  const ScratchFile cup_{".stl"}, lid_{".stl"}, drum_{".stl"};

  void SetUp() override
  {
    write_stl(cup_.name(), prism(48, 3.3, 3.0, true));
    write_stl(lid_.name(), prism(48, 3.1, 0.5, true));
    write_stl(drum_.name(), drum(48));
  }

  /// \return the energy that is missing at the end, and the work of the walls
  std::pair<double, double> run(double time_step) const
  {
    std::string walls = with(GetParam().walls, "LAW", law.substr(1));
    for (const auto &[name, file] : {std::pair{"CUP", &cup_}, {"LID", &lid_}, {"DRUM", &drum_}})
      walls = with(walls, name, file->name());
    Packing packing;
    packing.side = 3;
    packing.spacing = 1.1;
    packing.speed = 0.0;
    Simulation simulation;
    simulation.open_box(9.0);
    simulation.create(packing.spheres());
    simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -0.1 0.5 restitution 0.7\n"
               "neighbor 0.3 bin\nfix move all nve/sphere\nfix g all gravity 10 vector 0 0 -1\n"
               "compute ledger all gran/eepa/energy\ntimestep " +
               exact(time_step) + "\n" + walls);
    simulation.run(0);
    const double before = energy(simulation);
    const int part = static_cast<int>(0.34 / time_step);
    simulation.run(part);
    for (const char *change : GetParam().changes) {
      if (change) simulation(change);
      simulation.run(part);
    }
    return {energy(simulation) - before, simulation.compute_vector("ledger")[8]};
  }
};

TEST_P(LedgerOfMachines, IsClosed)
{
  const auto [coarse, work] = run(1e-4);
  const auto [fine, same_work] = run(5e-5);
  std::printf("%s: work %.4g and %.4g, missing %.2e and %.2e of it\n", GetParam().name, work,
              same_work, coarse / work, fine / same_work);
  EXPECT_GT(std::fabs(work), GetParam().least_work);
  EXPECT_LT(std::fabs(coarse), 2e-4 * std::fabs(work));
  EXPECT_LT(std::fabs(fine), 1e-4 * std::fabs(same_work));
}

const Machine machines[] = {
    {"drum", "fix drum LAW mesh DRUM rotate 0 0 0 0 1 0 3", 10.0},
    {"lid",
     "fix cup LAW mesh CUP\nfix lid LAW mesh LID offset 0 0 2.3 load z -300 mass 10 damping 20 "
     "rotate 0 0 0 0 0 1 4",
     20.0},
    {"region",
     "region ball sphere 0 0 0 3.2\nfix ball LAW region ball wiggle z 0.4 0.5 rotate 0 0 0 1 0 0 2",
     5.0},
    {"stop_and_go",
     "fix drum LAW mesh DRUM rotate 0 0 0 0 1 0 4",
     5.0,
     {"fix_modify drum velocity 0.5 0 1", "fix_modify drum still"}},
};
INSTANTIATE_TEST_SUITE_P(Walls, LedgerOfMachines, testing::ValuesIn(machines),
                         [](const auto &info) {
                           return std::string(info.param.name);
                         });

}    // namespace
