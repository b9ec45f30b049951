// SPDX-License-Identifier: GPL-2.0-only

// Assumptions of LAMMPS's own commands about a granular pair style.

#include "packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace eepa_test;

namespace {

using Matrix3 = Eigen::Matrix3d;

std::vector<double> voigt(const Matrix3 &m)
{
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
}

/// The tensor of tangential forces of compute fabric's page, from contacts and positions.
std::vector<double> tangential_fabric(const std::vector<Particle> &particles,
                                      const std::vector<PairContact> &contacts)
{
  Matrix3 orientation = Matrix3::Zero();
  std::vector<Vec3> normals;
  for (const auto &c : contacts) {
    normals.push_back((particles[c.i - 1].x - particles[c.j - 1].x).normalized());
    orientation += normals.back() * normals.back().transpose() / contacts.size();
  }
  const Matrix3 anisotropy =
      7.5 * (orientation - orientation.trace() / 3.0 * Matrix3::Identity());
  Matrix3 normal = Matrix3::Zero(), tangential = Matrix3::Zero();
  for (std::size_t k = 0; k < contacts.size(); k++) {
    const Matrix3 weighted = normals[k] * normals[k].transpose() / contacts.size() /
        (1.0 + normals[k].dot(anisotropy * normals[k]));
    normal += contacts[k].normal_force * weighted;
    tangential += contacts[k].tangential().norm() * weighted;
  }
  return voigt(5.0 / normal.trace() *
               (tangential - tangential.trace() / 3.0 * Matrix3::Identity()));
}

void expect_near(const std::vector<double> &a, const std::vector<double> &b, double tolerance)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); k++) EXPECT_NEAR(a[k], b[k], tolerance) << k;
}

// LAMMPS takes the fourth quantity of single() for the magnitude of the tangential force.
TEST(ParallelFabric, HasTheTangentialForces)
{
  Packing packing;
  packing.side = 4;
  Simulation simulation;
  simulation.open_box(2.0 * packing.half());
  simulation.create(packing.spheres());
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -1 0.3 restitution 0.8\n"
             "fix integrate all nve/sphere\ntimestep 2e-4\n"
             "compute fabric all fabric radius force/tangential");
  simulation.watch_contacts();
  simulation.run(60);
  const auto expected = tangential_fabric(simulation.particles(), simulation.contacts());
  expect_near(simulation.compute_vector("fabric"), expected, 1e-12);
  double largest = 0.0;
  for (const double value : expected) largest = std::max(largest, std::fabs(value));
  EXPECT_GT(largest, 1e-2);
}

// Prescribed motion without spin and without a dashpot, in which the two laws agree.
TEST(Fabric, IsThatOfHookeHistory)
{
  const auto fabric = [](const std::string &style) {
    Simulation simulation;
    simulation.open_box(2.0);
    Sphere a, b, c;
    b.x = Vec3(0.99, 0.0, 0.0);
    c.x = Vec3(0.3, 0.93, 0.1);
    simulation.create({a, b, c});
    simulation(style +
               "\ngroup a id 1\ngroup b id 2\ngroup c id 3\ntimestep 1e-5\n"
               "fix a a move linear 0 0 0\nfix b b move linear 0 1 0.5\n"
               "fix c c move linear -1 0 2\n"
               "compute fabric all fabric radius contact branch force/normal force/tangential");
    simulation.run(20);
    return simulation.compute_vector("fabric");
  };
  const auto ours = fabric("pair_style gran/eepa linear\n"
                           "pair_coeff * * 1e4 1e4 0 0 0.5 kt 3e4 restitution 1");
  const auto lammps = fabric("pair_style gran/hooke/history 1e4 3e4 0 0 0.5 0\npair_coeff * *");
  expect_near(ours, lammps, 1e-7);
  EXPECT_GT(std::fabs(lammps[18]), 1e-3);
}

// pair_write asks for the force at distances where no particles are.
TEST(PairWrite, IsRefusedBeforeAndAfterARun)
{
  for (const int steps : {0, 20}) {
    Simulation simulation;
    simulation.open_box(2.0);
    Sphere a, b;
    b.x = Vec3(0.99, 0.0, 0.0);
    simulation.create({a, b});
    simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -1 0.3\n"
               "fix integrate all nve/sphere\ntimestep 1e-5");
    if (steps) simulation.run(steps);
    EXPECT_TRUE(refuses(simulation, "pair_write 1 1 5 r 0.5 0.9 /dev/null t",
                        "force of a contact depends on its history.*0.5 was asked.*pair_write"));
  }
}

}    // namespace
