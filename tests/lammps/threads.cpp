// SPDX-License-Identifier: GPL-2.0-only

// pair_style gran/eepa/omp: the motion of gran/eepa to rounding with any number of threads, the
// same bits each time, and all other features of the serial style.

#include "packing.h"

#include "force.h"
#include "lammps.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

struct Law {
  const char *name, *style, *coefficients;
  const char *unlike;    ///< coefficients between the two types
};

class ParallelThreads : public testing::TestWithParam<Law> {
 protected:
  const Law &law = GetParam();

  static int ranks()
  {
    int count;
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    return count;
  }
  /// \param threads  0: gran/eepa itself
  void start(Simulation &simulation, int threads, const std::string &newton = "on",
             const std::string &after = "")
  {
    Packing packing;
    packing.polydisperse = true;
    packing.types = 2;
    packing.speed = 1.0;
    if (threads) simulation("package omp " + std::to_string(threads) + "\nsuffix omp");
    simulation.open_box(packing.half(), 2, "p p p", newton);
    simulation.create(packing.spheres());
    simulation(std::string("pair_style gran/eepa ") + law.style + "\npair_coeff * * " +
               law.coefficients + "\npair_coeff 1 2 " + law.unlike +
               "\nfix integrate all nve/sphere\ntimestep 2e-4\n" + after);
  }
  std::vector<Particle> motion(int threads, const std::string &newton)
  {
    Simulation simulation;
    start(simulation, threads, newton);
    simulation.run(200);
    // the serial style would pass every test here
    EXPECT_STREQ(simulation.lammps()->force->pair_style, threads ? "gran/eepa/omp" : "gran/eepa");
    return simulation.particles();
  }
};

TEST_P(ParallelThreads, GiveTheMotionOfOne)
{
  for (const char *newton : {"on", "off"}) {
    const auto serial = motion(0, newton);
    for (const int threads : {1, 2, 5}) {
      if (ranks() * threads > 8) continue;    // takes minutes on few cores
      const auto threaded = motion(threads, newton);
      EXPECT_LT(difference(serial, threaded), 1e-10) << threads << " threads, newton " << newton;
      EXPECT_EQ(difference(threaded, motion(threads, newton)), 0.0) << "another run";
    }
  }
}

// More threads than particles: one thread does all the work of such a rank.
TEST_P(ParallelThreads, MayOutnumberParticles)
{
  Simulation serial, threaded;
  threaded("package omp 8\nsuffix omp");
  for (auto *simulation : {&serial, &threaded}) {
    simulation->open_box(3.0);
    simulation->create({{Vec3(-0.49, 0, 0), Vec3(1, 1, 0)}, {Vec3(0.49, 0, 0)}});
    (*simulation)(std::string("pair_style gran/eepa ") + law.style + "\npair_coeff * * " +
                  law.coefficients + "\nfix integrate all nve/sphere\ntimestep 1e-4");
    simulation->run(50);
  }
  EXPECT_EQ(difference(serial.particles(), threaded.particles()), 0.0);
}

TEST_P(ParallelThreads, KeepTheLedgerAndTheTallies)
{
  const std::string computes = "compute ledger all gran/eepa/energy\n"
                               "compute contacts all gran/eepa/contacts\n"
                               "compute pressure all pressure NULL pair\nthermo 10\n"
                               "thermo_style custom step pe c_pressure c_ledger[1]";
  Simulation serial, threaded;
  start(serial, 0, "on", computes);
  start(threaded, 3, "on", computes);
  for (auto *simulation : {&serial, &threaded}) simulation->run(200);
  for (const char *compute : {"ledger", "contacts"}) {
    const auto a = serial.compute_vector(compute), b = threaded.compute_vector(compute);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); k++)
      EXPECT_NEAR(a[k], b[k], 1e-9 * (1.0 + std::fabs(a[k]))) << compute << " " << k;
  }
  EXPECT_GT(serial.compute_vector("ledger")[3], 1.0);
  EXPECT_NEAR(serial.thermo("pe"), threaded.thermo("pe"), 1e-9 * std::fabs(serial.thermo("pe")));
  EXPECT_NEAR(serial.compute("pressure"), threaded.compute("pressure"),
              1e-9 * std::fabs(serial.compute("pressure")));
}

TEST_P(ParallelThreads, ReadAndWriteTheSameRestarts)
{
  const ScratchFile file(".restart");
  Simulation written;
  start(written, 2);
  written.run(150);
  written("write_restart " + file.name());
  written.run(150);
  for (const int threads : {0, 3}) {
    // made only now: LAMMPS takes over the number of threads of the last instance in the process
    Simulation other;
    if (threads) other("package omp " + std::to_string(threads) + "\nsuffix omp");
    other("read_restart " + file.name() +
          "\ncomm_modify vel yes\nneighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
          "thermo 1000000\nfix integrate all nve/sphere\ntimestep 2e-4");
    other.run(150);
    EXPECT_LT(difference(written.particles(), other.particles()), 1e-10) << threads;
  }
}

const Law laws[] = {
    {"linear", "linear", "1e4 2e4 5e3 -1 0.5 restitution 0.8", "1e4 1e4 0 0 0.1 restitution 0.9"},
    {"twisting", "linear", "1e4 2e4 5e3 -1 0.5 restitution 0.8 twisting marshall",
     "1e4 1e4 0 0 0.1 restitution 0.9"},
    {"plateau", "plateau limit_damping yes", "1e4 2e4 5e3 -1 0.5 viscous 1 1 rolling constant 0.1",
     "5e3 1e4 5e3 -2 0.2 viscous 2 1 rolling constant 0.2"},
    {"luding", "luding", "1e4 2e4 5e3 -1 0.5 depth 0.02 restitution 0.8 bound contact",
     "5e3 1e4 5e3 -2 0.2 depth 0.01 restitution 0.6 bound contact"},
    {"exponent", "linear exponent 1.5",
     "1e5 2e5 5e4 -1 0.5 kt 3e3 restitution 0.8 rolling sds 1e3 1 0.1",
     "5e4 1e5 5e4 -1 0.2 kt 1e3 restitution 0.6 rolling sds 2e3 1 0.2"},
};
INSTANTIATE_TEST_SUITE_P(Laws, ParallelThreads, testing::ValuesIn(laws), [](const auto &info) {
  return std::string(info.param.name);
});

// An error that a thread raises ends the run like any error of LAMMPS.
TEST(Threads, NameTheParticlesOfARunThatBlowsUp)
{
  Simulation simulation;
  Packing packing;
  packing.side = 5;
  packing.speed = 2.0;
  simulation("package omp 3\nsuffix omp");
  simulation.open_box(packing.half(), 1, "p p p");
  simulation.create(packing.spheres());
  simulation("pair_style gran/eepa linear dtcheck off\npair_coeff * * 1e4 2e4 5e3 -1 0.3\n"
             "fix integrate all nve/sphere\ntimestep 0.1");
  EXPECT_TRUE(
      refuses(simulation, "run 200",
              "pair_style gran/eepa: atoms [0-9]+ and [0-9]+ overlap by [0-9.e+-]+ at step"));
}

}    // namespace
