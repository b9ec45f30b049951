// SPDX-License-Identifier: GPL-2.0-only

// pair_style gran/eepa/kk against gran/eepa: motion, tallies, restart files, errors. The tests of the other files are run
// with it, too: the ctest entries lammps.kk.*.

#ifdef EEPA_KOKKOS

#include "kokkos_variant.h"
#include "packing.h"

#include "compute.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

struct Law {
  const char *name, *style, *coefficients;
  const char *unlike;    ///< coefficients between the two types
};

class ParallelKokkos : public testing::TestWithParam<Law> {
 protected:
  const Law &law = GetParam();

  void start(Simulation &simulation, const std::string &newton, const std::string &after = "")
  {
    Packing packing;
    packing.polydisperse = true;
    packing.types = 2;
    packing.speed = 1.0;
    simulation.open_box(packing.half(), 2, "p p p", newton);
    simulation.create(packing.spheres());
    simulation(std::string("pair_style gran/eepa ") + law.style + "\npair_coeff * * " +
               law.coefficients + "\npair_coeff 1 2 " + law.unlike +
               "\nfix integrate all nve/sphere\ntimestep 2e-4\n" + after);
  }
};

TEST_P(ParallelKokkos, GivesTheMotionOfTheHost)
{
  for (const char *newton : {"on", "off"}) {
    Variant host(false), device(true), classic(true, MPI_COMM_WORLD, KokkosComm::classic),
        on_host(true, MPI_COMM_WORLD, KokkosComm::host);
    for (Simulation *simulation :
         std::initializer_list<Simulation *>{&host, &device, &classic, &on_host})
      start(*simulation, newton, "atom_modify sort 20 1.0");
    // rounding errors grow exponentially in a packing that is shaken
    const std::pair<int, double> stages[] = {{0, 1e-13}, {1, 1e-13}, {99, 1e-12}, {400, 1e-9}};
    for (const auto &[steps, tolerance] : stages) {
      host.run(steps);
      for (Variant *variant : {&device, &classic, &on_host}) {
        variant->run(steps);
        EXPECT_LT(difference(host.particles(), variant->particles()), tolerance)
            << steps << " newton " << newton << " variant " << (variant == &classic)
            << (variant == &on_host);
      }
    }
    // the host's style would pass every test here
    EXPECT_STREQ(device.lammps()->force->pair_style, "gran/eepa/kk");
    EXPECT_STREQ(host.lammps()->force->pair_style, "gran/eepa");
  }
}

TEST_P(ParallelKokkos, TalliesWhatTheHostTallies)
{
  for (const char *newton : {"on", "off"}) {
    Variant host(false), device(true);
    for (Simulation *simulation :
         {static_cast<Simulation *>(&host), static_cast<Simulation *>(&device)}) {
      start(*simulation, newton,
            "compute ledger all gran/eepa/energy\ncompute contacts all gran/eepa/contacts\n"
            "compute losses all gran/eepa/energy/atom\ncompute dt all gran/eepa/dt\n"
            "compute energies all pe/atom pair\ncompute stresses all stress/atom NULL pair\n"
            "compute energy all reduce sum c_energies\n"
            "compute stress all reduce sum c_stresses[1] c_stresses[2] c_stresses[3] c_stresses[4] "
            "c_stresses[5] "
            "c_stresses[6]\n"
            "compute lost all reduce sum c_losses[*]\n"
            "compute pressure all pressure NULL pair\nthermo 10\n"
            "thermo_style custom step pe c_pressure c_ledger[1] c_energy c_stress[1] c_lost[1] "
            "c_contacts[1] c_dt");
      simulation->watch_contacts();
      simulation->run(200);
    }
    for (const char *compute : {"ledger", "contacts", "stress", "lost"}) {
      const auto a = host.compute_vector(compute), b = device.compute_vector(compute);
      ASSERT_EQ(a.size(), b.size());
      double largest = 0.0;
      for (const double value : a) largest = std::max(largest, std::fabs(value));
      EXPECT_GT(largest, 0.0) << compute;
      for (std::size_t k = 0; k < a.size(); k++)
        EXPECT_NEAR(a[k], b[k], 1e-9 * largest) << compute << " " << k;
    }
    for (const char *compute : {"energy", "pressure", "dt"})
      EXPECT_NEAR(host.compute(compute), device.compute(compute),
                  1e-9 * std::fabs(host.compute(compute)))
          << compute;
    EXPECT_NEAR(host.thermo("pe"), device.thermo("pe"), 1e-9 * std::fabs(host.thermo("pe")));

    const auto a = host.contacts(), b = device.contacts();
    ASSERT_GT(a.size(), 300u);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); k++) {
      EXPECT_NEAR(a[k].max_overlap(), b[k].max_overlap(), 1e-9);
      EXPECT_EQ(a[k].branch(), b[k].branch());
      EXPECT_EQ(a[k].slip(), b[k].slip());
      EXPECT_NEAR(a[k].normal_force, b[k].normal_force, 1e-7);
    }
  }
}

// A file of either style goes on with the other one, as if the run had not been cut.
TEST_P(ParallelKokkos, ExchangesRestartFilesWithTheHost)
{
  const ScratchFile between(".between"), within(".within");
  for (const bool from_device : {false, true}) {
    Variant written(from_device);
    start(written, "off");
    written.run(150);
    written("write_restart " + between.name());
    // one more in the midst of a run, between two neighbour lists
    written("restart 7 " + within.name() + " " + within.name());
    written.run(10);
    written("restart 0");
    Variant goes_on(!from_device), again(!from_device);
    const auto take_up = [&](Simulation &simulation, const ScratchFile &file) {
      simulation("read_restart " + file.name() +
                 "\ncomm_modify vel yes\nneighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
                 "thermo 1000000\nfix integrate all nve/sphere\ntimestep 2e-4");
      EXPECT_STREQ(simulation.lammps()->force->pair_style,
                   from_device ? "gran/eepa" : "gran/eepa/kk");
    };
    take_up(goes_on, between);
    goes_on.run(10);
    written.run(200);
    goes_on.run(200);
    EXPECT_LT(difference(written.particles(), goes_on.particles()), 1e-9);

    // as if the run had been cut there
    Variant cut(from_device);
    take_up(again, within);
    EXPECT_EQ(again.lammps()->update->ntimestep, 154);
    cut("read_restart " + between.name() +
        "\ncomm_modify vel yes\nneighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
        "thermo 1000000\nfix integrate all nve/sphere\ntimestep 2e-4");
    cut.run(4);
    cut.run(200);
    again.run(200);
    EXPECT_LT(difference(cut.particles(), again.particles()), 1e-9);
  }
}

const Law laws[] = {
    {"linear", "linear", "1e4 2e4 5e3 -1 0.5 restitution 0.8", "1e4 1e4 0 0 0.1 restitution 0.9"},
    {"twisting", "linear scale 0.9", "1e4 2e4 5e3 -1 0.5 restitution 0.8 twisting marshall",
     "1e4 1e4 0 0 0.1 restitution 0.9"},
    {"plateau", "plateau limit_damping yes", "1e4 2e4 5e3 -1 0.5 viscous 1 1 rolling constant 0.1",
     "5e3 1e4 5e3 -2 0.2 viscous 2 1 rolling constant 0.2"},
    {"luding", "luding", "1e4 2e4 5e3 -1 0.5 depth 0.02 restitution 0.8 bound contact",
     "5e3 1e4 5e3 -2 0.2 depth 0.01 restitution 0.6 bound contact"},
    {"everything", "linear exponent 1.5",
     "1e5 2e5 5e4 -1 0.5 kt 3e3 restitution 0.8 rolling sds 1e3 1 0.1 twisting marshall",
     "5e4 1e5 5e4 -1 0.2 kt 1e3 restitution 0.6 rolling sds 2e3 1 0.2"},
};
INSTANTIATE_TEST_SUITE_P(Laws, ParallelKokkos, testing::ValuesIn(laws), [](const auto &info) {
  return std::string(info.param.name);
});

const std::string cohesive = "pair_style gran/eepa linear\n"
                             "pair_coeff * * 1e4 2e4 5e3 -1 0.5 restitution 0.8\n"
                             "fix integrate all nve/sphere\ntimestep 1e-4";

// One contact, whose sums have one order: the same bits.
TEST(Kokkos, GivesTwoSpheresTheBitsOfTheHost)
{
  Variant host(false, MPI_COMM_SELF), device(true, MPI_COMM_SELF);
  for (Simulation *simulation :
       {static_cast<Simulation *>(&host), static_cast<Simulation *>(&device)}) {
    simulation->open_box(3.0);
    simulation->create(
        {{Vec3(-0.49, 0, 0), Vec3(1, 1, 0)}, {Vec3(0.49, 0, 0), Vec3::Zero(), Vec3(3, 1, 2)}});
    (*simulation)(cohesive);
  }
  for (const int steps : {1, 99, 900}) {
    host.run(steps);
    device.run(steps);
    EXPECT_EQ(difference(host.particles(), device.particles()), 0.0);
  }
}

/// Chains of three that drift apart and turn, in a box without periodic faces.
std::vector<Sphere> chains()
{
  std::mt19937 generator(7);
  std::vector<Sphere> all;
  for (int chain = 0; chain < 27; chain++) {
    const Vec3 centre = 3.2 * Vec3(chain % 3 - 1, chain / 3 % 3 - 1, chain / 9 - 1);
    const Vec3 along = uniform_vector(generator).normalized();
    // rows along x go in opposite directions
    const double direction = (chain / 3) % 2 == 0 ? 1.0 : -1.0;
    const Vec3 motion = 0.8 * centre + direction * Vec3(4.5, 0, 0);
    const Vec3 turn = 4.0 * uniform_vector(generator);
    for (int k = -1; k <= 1; k++) {
      Sphere s;
      s.radius = 0.5 + 0.005 * k;
      s.x = centre + 0.98 * k * along;
      s.v = motion + turn.cross(0.98 * k * along) + 0.1 * uniform_vector(generator);
      s.omega = turn + 3.0 * uniform_vector(generator);
      all.push_back(s);
    }
  }
  return all;
}

// No particle has more than two contacts, so that the order of particles does not change a sum: histories must have the
// same bits however they went through processors and were sorted.
TEST(ParallelKokkosExchange, KeepsTheBitsOfHistories)
{
  const char *models[] = {"rolling sds 1e3 1 0.1 twisting marshall", "twisting marshall"};
  for (const char *model : models) {
    Variant alone(true, MPI_COMM_SELF, KokkosComm::classic),
        classic(true, MPI_COMM_WORLD, KokkosComm::classic),
        on_host(true, MPI_COMM_WORLD, KokkosComm::host), device(true), newton(true);
    for (Variant *variant : {&alone, &classic, &on_host, &device, &newton}) {
      // side by side, so that of four processors two have two neighbours that send them particles
      (*variant)("processors * 1 1");
      variant->open_box(7.0, 1, "f f f", variant == &newton ? "on" : "off");
      (*variant)(
          "neighbor 0.3 bin");    // new lists are rare, so that many change their processor at once
      variant->create(chains());
      (*variant)(std::string("pair_style gran/eepa linear\n"
                             "pair_coeff * * 1e4 2e4 1e4 -100 0.5 restitution 0.8 ") +
                 model +
                 "\ncompute contacts all gran/eepa/contacts\natom_modify sort 10 2.0\n"
                 "fix integrate all nve/sphere\ntimestep 2e-4");
      variant->run(0);
      EXPECT_EQ(variant->compute_vector("contacts")[0], 54.0);
      variant->run(600);
      // all contacts have gone on, and particles were at new places
      EXPECT_EQ(variant->compute_vector("contacts")[0], 54.0);
    }
    for (Variant *variant : {&classic, &on_host, &device, &newton})
      EXPECT_EQ(difference(alone.particles(), variant->particles()), 0.0) << model;
  }
}

// The time of a step with a new list, on a GPU: all that would go over the host.
TEST(ParallelKokkosExchange, LeavesParticlesAndHistoriesOnTheDevice)
{
  Variant simulation(true);
  const KokkosCounts kokkos;
  if (!kokkos.counted) GTEST_SKIP() << "KOKKOS_TOOLS_LIBS must name the library kokkos_counts";
  Packing packing;
  packing.speed = 1.0;
  packing.polydisperse = true;
  simulation.open_box(packing.half(), 1, "p p p", "off");
  std::vector<Sphere> spheres = packing.spheres();
  for (Sphere &sphere : spheres) sphere.v += Vec3(30.0, 20.0, 25.0);    // all cross some boundary
  simulation.create(spheres);
  simulation("pair_style gran/eepa linear\n"
             "pair_coeff * * 1e4 2e4 5e3 -1 0.5 restitution 0.8 rolling sds 1e3 1 0.1\n"
             "fix integrate all nve/sphere\ntimestep 2e-4\natom_modify sort 1 1.0\n"
             "neigh_modify every 5 delay 0 check no");
  simulation.run(100);
  kokkos.reset();
  simulation("run 100 pre no post no");
  const auto kernels = [&](const char *name) {
    return kokkos.counted(EEPA_KERNELS, name);
  };
  EXPECT_EQ(kernels("eepa:put_histories"), 20u);
  EXPECT_EQ(kernels("eepa:fill_partners"), 21u);    // and at the end of the run
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks > 1) {
    EXPECT_EQ(kernels("BuildExchangeListFunctor"), 60u);
    EXPECT_GT(kernels("eepa:pack_partners"), 0u);
    EXPECT_GT(kernels("eepa:unpack_partners"), 0u);
  }
  EXPECT_GE(kernels("BuildBorderListFunctor"), 20u * 6u);
  EXPECT_GE(kernels("Sort::CopyPermute"), 20u * 12u);    // 9 arrays of particles, 3 of histories
  EXPECT_EQ(kokkos.counted(EEPA_REGIONS, "gran/eepa: "), 0u);
  for (const char *histories : {"eepa:status", "eepa:quads", "eepa:partners:quads"})
    EXPECT_EQ(kokkos.counted(EEPA_COPIED_BYTES, histories), 0u) << histories;

  // the counts tell: a restart file brings histories to the host
  kokkos.reset();
  const ScratchFile file(".restart");
  simulation("write_restart " + file.name());
  EXPECT_EQ(kokkos.counted(EEPA_REGIONS, "gran/eepa: partners to the host"), 1u);
  EXPECT_GT(kokkos.counted(EEPA_COPIED_BYTES, "eepa:partners:quads"), 0u);
}

// A particle with more contacts than any of equal size can have.
TEST(ParallelKokkosSizes, KeepsTheHistoriesOfMany)
{
  std::vector<Sphere> spheres(1);
  spheres[0].radius = 1.0;
  for (int k = 0; k < 60; k++) {
    // a spiral on the large sphere
    const double z = 1.0 - (2.0 * k + 1.0) / 60.0, angle = 2.4 * k, r = std::sqrt(1.0 - z * z);
    Sphere small;
    small.radius = 0.1;
    small.x = 1.098 * Vec3(r * std::cos(angle), r * std::sin(angle), z);
    small.v = 0.2 * Vec3(-std::sin(angle), std::cos(angle), 0.1);
    spheres.push_back(small);
  }
  // the middle of the box is where processors meet: the large one goes to another, with all its contacts
  for (Sphere &sphere : spheres) {
    sphere.x -= Vec3::Constant(0.015);
    sphere.v += Vec3::Constant(1.0);
  }
  for (const char *newton : {"on", "off"}) {
    Variant host(false), device(true);
    for (Simulation *simulation :
         {static_cast<Simulation *>(&host), static_cast<Simulation *>(&device)}) {
      simulation->open_box(2.0, 1, "f f f", newton);
      simulation->create(spheres);
      // the force of pull-off holds them at this overlap
      (*simulation)("pair_style gran/eepa linear\n"
                    "pair_coeff * * 1e4 2e4 5e3 -20 0.5 restitution 0.8 rolling sds 1e3 1 0.1\n"
                    "fix integrate all nve/sphere\ntimestep 1e-4\n"
                    "compute contacts all gran/eepa/contacts");
      simulation->run(0);
      EXPECT_EQ(simulation->compute_vector("contacts")[0], 60.0);
      (*simulation)("neigh_modify every 3 delay 0 check no\natom_modify sort 3 0.5");
      EXPECT_LT(simulation->particle(1).x.maxCoeff(), 0.0);
      simulation->run(300);
      EXPECT_GT(simulation->particle(1).x.minCoeff(), 0.0);
      EXPECT_EQ(simulation->compute_vector("contacts")[0], 60.0);
    }
    EXPECT_LT(difference(host.particles(), device.particles()), 1e-9) << newton;
  }
}

// Frozen particles, a rigid body and a wall of the host beside contacts on the device.
TEST(ParallelKokkosCompany, HasTheMassesAndWallsOfTheHost)
{
  Packing packing;
  packing.side = 4;
  packing.speed = 1.0;
  Variant host(false), device(true);
  for (Simulation *simulation :
       {static_cast<Simulation *>(&host), static_cast<Simulation *>(&device)}) {
    simulation->open_box(packing.half() + 0.5);
    simulation->create(packing.spheres());
    (*simulation)(
        "group frozen id 1 2 3\ngroup body id 40 41 44\n"
        "group free subtract all frozen body\n"
        "pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -1 0.5 restitution 0.8\n"
        "fix hold frozen freeze\nfix body body rigid single\nfix integrate free nve/sphere\n"
        "fix floor all wall/gran/eepa linear coeff 1e4 2e4 5e3 -1 0.5 restitution 0.8 wall "
        "zplane " +
        exact(-packing.half() + 0.03) + " NULL" +
        "\nfix weight free gravity 10 vector 0 0 -1\ntimestep 1e-4");
    simulation->run(300);
  }
  EXPECT_GT(host.wall_force("floor").norm(), 1.0);
  EXPECT_LT((host.wall_force("floor") - device.wall_force("floor")).norm(),
            1e-8 * host.wall_force("floor").norm());
  EXPECT_LT(difference(host.particles(), device.particles()), 1e-9);
}

TEST(Kokkos, NamesTheParticlesOfARunThatBlowsUp)
{
  Variant simulation(true);
  Packing packing;
  packing.side = 5;
  packing.speed = 2.0;
  simulation.open_box(packing.half(), 1, "p p p");
  simulation.create(packing.spheres());
  simulation("pair_style gran/eepa linear dtcheck off\npair_coeff * * 1e4 2e4 5e3 -1 0.3\n"
             "fix integrate all nve/sphere\ntimestep 0.1");
  EXPECT_TRUE(
      refuses(simulation, "run 200",
              "pair_style gran/eepa: atoms [0-9]+ and [0-9]+ overlap by [0-9.e+-]+ at step"));
}

TEST(Kokkos, SaysWhatItNeeds)
{
  Variant host(false);
  host.open_box(1.0);
  EXPECT_TRUE(refuses(host, "pair_style gran/eepa/kk linear",
                      "gran/eepa/kk: KOKKOS is off; start LAMMPS with -k on"));

  Variant two_styles(true);
  two_styles.open_box(1.0, 2);
  two_styles.create({{Vec3(-0.49, 0, 0)}, {Vec3(0.49, 0, 0)}});
  two_styles("pair_style hybrid gran/eepa linear gran/eepa plateau\n"
             "pair_coeff 1 * gran/eepa 1 1e4 2e4 5e3 -1 0.3\n"
             "pair_coeff 2 2 gran/eepa 2 1e4 2e4 5e3 -1 0.3");
  EXPECT_TRUE(refuses(two_styles, "run 0",
                      "gran/eepa/kk: pair_style hybrid/kk gives types 2 2 to another sub-style"));

  Variant all_pairs(true);
  all_pairs.open_box(1.0);
  all_pairs.create({{Vec3(-0.49, 0, 0)}, {Vec3(0.49, 0, 0)}});
  all_pairs(cohesive + "\nneighbor 0.1 nsq");
  EXPECT_TRUE(
      refuses(all_pairs, "run 0", "gran/eepa/kk: the style of command neighbor must be bin"));

  Variant device(true);
  device("package kokkos neigh full newton off");
  device.open_box(1.0, 1, "f f f", "off");
  device.create({{Vec3(-0.49, 0, 0)}, {Vec3(0.49, 0, 0)}});
  device(cohesive);
  EXPECT_TRUE(
      refuses(device, "run 0", "gran/eepa/kk: neighbor lists of KOKKOS are full and must be half"));
}

}    // namespace

#endif
