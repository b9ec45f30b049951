// SPDX-License-Identifier: GPL-2.0-only

// Meshes and regions together with what LAMMPS has beside them: insertion, rigid bodies, threads, pressure,
// and what the wall tells of itself.

#include "packing.h"
#include "triangles.h"

#include "force.h"
#include "lammps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace eepa_test;

namespace {

constexpr int CONTACTS = 6, TORQUE_X = 17;
const std::string coefficients = " 1e4 2e4 5e3 -0.1 0.5 restitution 0.5";

std::string wall(const std::string &id, const std::string &shape)
{
  return "\nfix " + id + " all wall/gran/eepa linear coeff" + coefficients + " wall " + shape +
      "\n";
}

std::string pair()
{
  return "pair_style gran/eepa linear\npair_coeff * *" + coefficients +
      "\nneighbor 0.3 bin\ntimestep 2e-4\n";
}

/* ---------------------------------------------------------------------- insertion */

struct Vessel {
  const char *name, *shape, *insertion;
};

/// Of particles under gravity.
double kinetic_and_potential(const Simulation &simulation)
{
  double sum = 0.0;
  for (const Particle &p : simulation.particles())
    sum += p.kinetic_energy() + 10.0 * p.mass * p.x.z();
  return sum;
}

/// The same, and all of the ledger, less the work of the walls.
double energy(const Simulation &simulation)
{
  const auto e = simulation.compute_vector("e");
  return kinetic_and_potential(simulation) + std::accumulate(e.begin(), e.begin() + 8, 0.0) - e[8] +
      e[9] + e[10];
}

class Filling : public testing::TestWithParam<Vessel> {};

// All arrive, none is lost, all come to rest on the wall, which bears their weight; the ledger books what
// the fall has brought.
TEST_P(Filling, EndsInAHeapThatTheWallBears)
{
  const ScratchFile file(".stl");
  // a hopper with a flat bottom: prism of 24 facets, its upper end open
  auto hopper = prism(24, 3.0, 3.0, false);
  for (const Corners &t : prism(24, 3.0, 3.0, true))
    if (t[0].z() == -3.0 && t[1].z() == -3.0 && t[2].z() == -3.0) hopper.push_back(t);
  write_stl(file.name(), hopper);
  Simulation simulation;
  simulation("atom_modify sort 0 0.0");
  simulation.open_box(8.0);
  const std::string shape = with(GetParam().shape, "FILE", file.name());
  simulation("region pot cylinder z 0 0 3 -3 7 open 2\nregion slab cylinder z 0 0 2.2 1 4\n" +
             pair() + wall("pot", shape) +
             "fix move all nve/sphere\nfix g all gravity 10 vector 0 0 -1\ncompute e all "
             "gran/eepa/energy\ncompute c all gran/eepa/contacts\nthermo_modify lost error\n" +
             GetParam().insertion);
  while (simulation.particles().size() < 60 && simulation.thermo("step") < 20000)
    simulation.run(200);
  ASSERT_EQ(simulation.particles().size(), 60u);
  // the last ones still fall
  const double before = energy(simulation);
  simulation.run(20000);
  const double lost = before - kinetic_and_potential(simulation);
  EXPECT_LT(std::fabs(energy(simulation) - before), 2e-3 * lost) << lost;
  const auto particles = simulation.particles();
  ASSERT_EQ(particles.size(), 60u);
  double weight = 0.0, kinetic = 0.0;
  for (const Particle &p : particles) {
    weight += 10.0 * p.mass;
    kinetic += p.kinetic_energy();
    EXPECT_LT(p.x.head<2>().norm(), 2.9) << p.id;
    EXPECT_GT(p.x.z(), -3.0) << p.id;
  }
  EXPECT_LT(kinetic, 1e-3 * weight);
  EXPECT_NEAR(simulation.wall_force("pot").z(), -weight, 0.01 * weight);
  EXPECT_GT(simulation.fix("pot", CONTACTS), 10.0);
  EXPECT_EQ(simulation.compute_vector("c")[8], simulation.fix("pot", CONTACTS));
}
const Vessel vessels[] = {
    {"pour_mesh", "mesh FILE",
     "fix in all pour 60 1 4767 region slab diam one 0.8 dens 1 1 vol 0.3 200"},
    {"pour_region", "region pot",
     "fix in all pour 60 1 4767 region slab diam one 0.8 dens 1 1 vol 0.3 200"},
    {"deposit_mesh", "mesh FILE",
     "fix in all deposit 60 1 120 4767 region slab attempt 500 near 0.9 vz -3 -2 units box"},
    {"deposit_region", "region pot",
     "fix in all deposit 60 1 120 4767 region slab attempt 500 near 0.9 vz -3 -2 units box"},
};
INSTANTIATE_TEST_SUITE_P(Vessels, Filling, testing::ValuesIn(vessels), [](const auto &info) {
  return std::string(info.param.name);
});

/* ---------------------------------------------------------------------- rigid bodies and threads */

// Clumps of three that tumble in a box of triangles: as between planes.
TEST(ClumpsOnAMesh, MoveAsBetweenPlanes)
{
  const ScratchFile file(".stl");
  write_stl(file.name(), box(2.25, 5, true));
  Simulation planes, mesh;
  for (auto *simulation : {&planes, &mesh}) {
    simulation->open_box(6.0);
    std::vector<Sphere> spheres;
    for (int body = 0; body < 4; body++) {
      const Vec3 centre(body % 2 ? 1.0 : -1.0, body < 2 ? -1.0 : 1.0, 0.2 * body - 1.4);
      for (int k = -1; k <= 1; k++) {
        Sphere sphere;
        sphere.x = centre + 0.4 * k * Vec3(1, 0.3 * body, 0.2);
        sphere.v = Vec3(0.5 * body - 1, 1 - 0.3 * body, -1);
        sphere.radius = 0.35;
        spheres.push_back(sphere);
      }
    }
    simulation->create(spheres);
    (*simulation)("pair_style zero 1.0\npair_coeff * *\nneighbor 0.3 bin\ntimestep 1e-4\n"
                  "group one id 1:3\ngroup two id 4:6\ngroup three id 7:9\ngroup four id 10:12\n"
                  "fix move all rigid group 4 one two three four\nthermo_style custom step\n"
                  "fix g all gravity 10 vector 0.3 0.2 -1");
  }
  planes(wall("w", "zplane -2.25 2.25") + wall("wx", "xplane -2.25 2.25") +
         wall("wy", "yplane -2.25 2.25"));
  mesh(wall("w", "mesh " + file.name()));
  double contacts = 0.0;
  for (int look = 0; look < 10; look++) {
    planes.run(500);
    mesh.run(500);
    EXPECT_LT(difference(planes.particles(), mesh.particles()), 1e-10) << look;
    EXPECT_EQ(planes.fix("w", CONTACTS) + planes.fix("wx", CONTACTS) + planes.fix("wy", CONTACTS),
              mesh.fix("w", CONTACTS));
    contacts += mesh.fix("w", CONTACTS);
  }
  EXPECT_GT(contacts, 20.0);
}

// Threads sum the forces of a particle in another order.
TEST(ThreadsWithAMesh, MoveParticlesAsOneDoes)
{
  const ScratchFile file(".stl");
  write_stl(file.name(), box(1.99, 5, true));
  Simulation one, two;
  two("package omp 2\nsuffix omp");
  for (auto *simulation : {&one, &two}) {
    Packing packing;
    packing.side = 4;
    packing.spacing = 1.0;
    packing.polydisperse = true;
    simulation->open_box(6.0);
    simulation->create(packing.spheres());
    (*simulation)(pair() + wall("w", "mesh " + file.name() + " rotate 0 0 0 0 0 1 2") +
                  "fix move all nve/sphere\nfix g all gravity 10 vector 0.3 0.2 -1");
    simulation->run(200);
  }
  EXPECT_STREQ(one.lammps()->force->pair_style, "gran/eepa");
  EXPECT_STREQ(two.lammps()->force->pair_style, "gran/eepa/omp");
  EXPECT_LT(difference(one.particles(), two.particles()), 1e-9);
  EXPECT_GT(one.fix("w", CONTACTS), 5.0);
}

/* ---------------------------------------------------------------------- pressure and energy */

// A sphere between two plates of triangles that squeeze it: stress is force times distance over volume,
// and energy that of two springs.
TEST(PressureOfAMesh, IsForceTimesDistanceOverVolume)
{
  const ScratchFile file(".stl");
  write_stl(file.name(), box(0.49, 3, true));
  Simulation simulation;
  simulation.open_box(4.0);
  simulation.create({{Vec3(0, 0, 0)}});
  simulation(
      "pair_style zero 1.0\npair_coeff * *\ntimestep 1e-4\nfix w all wall/gran/eepa linear coeff "
      "1e4 1e4 0 0 0 wall mesh " +
      file.name() +
      "\nfix_modify w virial yes energy yes\ncompute p all pressure NULL virial\n"
      "thermo_style custom step pe f_w c_p");
  simulation.run(0);
  const double overlap = 0.01, force = 1e4 * overlap;
  const auto p = simulation.compute_vector("p");
  // on each axis two forces at a distance of R - overlap from the centre, which push inwards
  for (int k = 0; k < 3; k++) EXPECT_NEAR(p[k], 2.0 * force * 0.49 / 512.0, 1e-6) << k;
  for (int k = 3; k < 6; k++) EXPECT_NEAR(p[k], 0.0, 1e-9) << k;
  const double energy = 6.0 * 0.5 * 1e4 * overlap * overlap;
  // a file has single precision
  EXPECT_NEAR(simulation.thermo("pe"), energy, 1e-4);
}

/* ---------------------------------------------------------------------- torque and faces */

// The moment on a mesh is what the particles lose of their angular momentum.
TEST(ParallelTorqueOnAMesh, IsThatOfTheParticles)
{
  const ScratchFile file(".stl");
  write_stl(file.name(), box(2.2, 4, true));
  Packing packing;
  packing.side = 4;
  packing.spacing = 1.08;
  packing.speed = 1.0;
  Simulation simulation;
  simulation.open_box(4.0);
  simulation.create(packing.spheres());
  simulation(
      "pair_style zero 1.0\npair_coeff * *\nneighbor 0.3 bin\nfix move all nve/sphere\ntimestep "
      "2e-4" +
      wall("w", "mesh " + file.name() + " about 0.7 -0.4 0.2 rotate 0.1 0 0 0 0.2 1 3"));
  double touched = 0.0;
  for (int look = 0; look < 5; look++) {
    simulation.run(100);
    Vec3 moment = Vec3::Zero();
    const Vec3 about(0.7, -0.4, 0.2);
    for (const Particle &p : simulation.particles()) moment += (p.x - about).cross(p.f) + p.torque;
    for (int k = 0; k < 3; k++)
      EXPECT_NEAR(simulation.fix("w", TORQUE_X + k), -moment[k], 1e-10 * (1.0 + moment.norm()));
    touched += simulation.fix("w", CONTACTS);
  }
  EXPECT_GT(touched, 20.0);
}

// Spheres that are held on a mesh that slides under them: its triangles have the forces between them.
TEST(ParallelFaces, SumUpToTheForce)
{
  const ScratchFile file(".stl");
  constexpr int cells = 4;
  write_stl(file.name(), box(2.2, cells));
  const double area = 0.5 * 4.4 * 4.4 / (cells * cells), overlap = 0.01, mu = 0.5, velocity = 0.8;
  std::vector<Sphere> spheres;
  for (int k = 0; k < 8; k++)
    spheres.push_back({Vec3(0.9 * (k % 4) - 1.2, k < 4 ? -0.75 : 0.65, -2.2 + 0.5 - overlap)});
  Simulation simulation;
  simulation.open_box(4.0);
  simulation.create(spheres);
  simulation(
      "pair_style zero 1.0\npair_coeff * *\nneighbor 0.3 bin\ntimestep 1e-4\n"
      "fix w all wall/gran/eepa linear coeff 1e4 1e4 0 0 0.5 wall mesh " +
      file.name() + " velocity " + exact(velocity) +
      " 0 0 faces 1\ncompute sum all reduce sum f_w[1] f_w[2] f_w[3] f_w[4] f_w[5] inputs local\n"
      "thermo_style custom step c_sum[1] c_sum[2] c_sum[3] c_sum[4] c_sum[5]");
  const double force = 8.0 * 1e4 * overlap;
  simulation.run(800);
  const double slid_before = simulation.compute_vector("sum")[4];
  simulation.run(100);
  const auto sum = simulation.compute_vector("sum");
  constexpr int triangles = 12 * cells * cells;
  EXPECT_EQ(sum[0], 0.5 * triangles * (triangles + 1));
  EXPECT_NEAR(sum[1], triangles * area, 1e-5);
  EXPECT_NEAR(sum[2] * area, force, 1e-4 * force);
  EXPECT_NEAR(simulation.wall_force("w").z(), -force, 1e-9 * force);
  EXPECT_NEAR(sum[3] * area, mu * force, 1e-4 * force);
  EXPECT_NEAR(std::fabs(simulation.wall_force("w").x()), mu * force, 1e-9 * force);
  // normal force times path of these 100 steps
  EXPECT_NEAR((sum[4] - slid_before) * area, force * velocity * 100 * 1e-4,
              1e-3 * force * velocity * 0.01);
}

}    // namespace
