// SPDX-License-Identifier: GPL-2.0-only

// fix wall/gran/eepa/kk against wall/gran/eepa: motion, outputs, restart files, exchange, what goes to the host. The tests
// of walls in the other files are run with it, too: the ctest entries lammps.kk.*.

#ifdef EEPA_KOKKOS

#include "kokkos_variant.h"
#include "packing.h"
#include "triangles.h"

#include "fix.h"
#include "lammps.h"
#include "modify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <typeinfo>

using namespace eepa_test;

namespace {

constexpr int N_VECTOR = 24, CONTACTS = 6;

struct Wall {
  const char *name, *law, *wall;
  bool on_device;
};

std::ostream &operator<<(std::ostream &out, const Wall &wall)
{
  return out << wall.name;
}

/// Particles that touch only walls, so that nothing depends on the order of sums but what the wall itself adds up.
std::vector<Sphere> gas(double speed)
{
  std::mt19937 generator(7);
  std::vector<Sphere> spheres;
  for (int k = 0; k < 200; k++) {
    Sphere sphere;
    sphere.x = 2.2 * uniform_vector(generator);
    sphere.v = speed * uniform_vector(generator);
    sphere.omega = speed * uniform_vector(generator);
    sphere.radius = 0.2 + 0.1 * uniform(generator);
    spheres.push_back(sphere);
  }
  return spheres;
}

/// The host's style would pass every test here. By the name of the class, whose header only Kokkos's compiler reads; the
/// style's name is without suffix.
bool is_for_kokkos(const Simulation &simulation, const char *id)
{
  const LAMMPS_NS::Fix &fix = *simulation.lammps()->modify->get_fix_by_id(id);
  return std::string(typeid(fix).name()).find("FixWallGranEepaKokkos") != std::string::npos;
}

class ParallelKokkosWall : public testing::TestWithParam<Wall> {
 protected:
  const ScratchFile mesh{".stl"};

  void SetUp() override { write_stl(mesh.name(), box(2.9, 11)); }

  /// A box with the wall in question and a floor of the same law.
  void open(Simulation &simulation, const std::string &after = "", double speed = 20.0)
  {
    simulation.open_box(5.0);
    simulation.create(gas(speed));
    add_walls(simulation, after);
  }
  void add_walls(Simulation &simulation, const std::string &after = "") const
  {
    simulation("pair_style zero 1.0\npair_coeff * *\ntimestep 1e-4\nfix integrate all nve/sphere\n"
               "region ball sphere 0 0 0 3.2");
    const std::string wall =
        std::string(GetParam().law) + " wall " + with(GetParam().wall, "MESH", mesh.name());
    simulation("fix wall all wall/gran/eepa " + wall + "\nfix side all wall/gran/eepa " +
               GetParam().law + " wall xplane -2.6 2.6\n" + after);
  }
  static double largest_of(const std::vector<double> &values)
  {
    double largest = 0.0;
    for (const double value : values) largest = std::max(largest, std::fabs(value));
    return largest;
  }
  static double energy_of(const Simulation &simulation)
  {
    return simulation.lammps()->modify->get_fix_by_id("wall")->compute_scalar();
  }
  static std::vector<double> vector_of(const Simulation &simulation)
  {
    std::vector<double> all;
    for (int k = 1; k <= N_VECTOR; k++) all.push_back(simulation.fix("wall", k));
    return all;
  }
  /// Groups of the vector that have one unit, so that each is compared with its largest number.
  static void expect_equal_outputs(const Simulation &a, const Simulation &b, double tolerance,
                                   const std::string &when)
  {
    const auto of_a = vector_of(a), of_b = vector_of(b);
    const int groups[][2] = {{0, 3}, {6, 12}, {16, 19}};    // forces and moments are sums
    for (int k = 0; k < N_VECTOR; k++) {
      double scale = std::fabs(of_a[k]);
      for (const auto &group : groups)
        if (k >= group[0] && k < group[1])
          scale = largest_of({of_a.begin() + group[0], of_a.begin() + group[1]});
      EXPECT_NEAR(of_a[k], of_b[k], tolerance * scale) << k + 1 << " " << when;
    }
  }
};

TEST_P(ParallelKokkosWall, MovesParticlesAsTheHost)
{
  const bool loaded = std::string(GetParam().wall).find("load") != std::string::npos;
  for (const char *neighbours :
       {"neigh_modify every 1 delay 0 check yes", "neigh_modify every 200 delay 0 check yes"}) {
    Variant host(false), device(true), classic(true, MPI_COMM_WORLD, KokkosComm::classic);
    for (Simulation *simulation : std::initializer_list<Simulation *>{&host, &device, &classic})
      open(*simulation, std::string(neighbours) + "\natom_modify sort 50 1.0");
    double touching = 0.0;
    for (const int steps : {0, 1, 99, 200, 200, 500}) {
      host.run(steps);
      touching += host.fix("wall", CONTACTS) + host.fix("side", CONTACTS);
      for (Variant *variant : {&device, &classic}) {
        variant->run(steps);
        const std::string when = std::to_string(steps) + " " + neighbours;
        // the order of a sum of forces changes the motion of a platen
        const double different = difference(host.particles(), variant->particles());
        if (loaded)
          EXPECT_LT(different, 1e-9) << when;
        else
          EXPECT_EQ(different, 0.0) << when;
        expect_equal_outputs(host, *variant, loaded ? 1e-8 : 1e-12, when);
      }
    }
    EXPECT_GT(touching, 10.0);
    EXPECT_TRUE(is_for_kokkos(device, "wall"));
    EXPECT_FALSE(is_for_kokkos(host, "wall"));
    const auto *fix = device.lammps()->modify->get_fix_by_id("wall");
    EXPECT_EQ(fix->kokkosable != 0, GetParam().on_device);
  }
}

TEST_P(ParallelKokkosWall, TalliesWhatTheHostTallies)
{
  Variant host(false), device(true);
  for (Simulation *simulation : std::initializer_list<Simulation *>{&host, &device}) {
    open(*simulation,
         "fix again all wall/gran/eepa " + std::string(GetParam().law) +
             " wall yplane -2.3 NULL contacts\n"
             "compute ledger all gran/eepa/energy\ncompute losses all gran/eepa/energy/atom\n"
             "compute lost all reduce sum c_losses[*]\n"
             "fix_modify wall virial yes\ncompute pressure all pressure NULL fix\n"
             "compute stresses all stress/atom NULL fix\n"
             "compute stress all reduce sum c_stresses[*]\n"
             "compute rows all reduce sum f_again[*]\ncompute dt all gran/eepa/dt\n"
             "thermo 10\nthermo_style custom step c_pressure c_ledger[1] c_stress[1] c_lost[1] "
             "c_rows[1] c_dt");
  }
  std::map<std::string, double> largest;
  // each set-up has contacts, some of which open in the step that follows
  for (const int steps : {157, 43, 0, 100, 200, 1, 1, 1, 100, 100}) {
    host.run(steps);
    device.run(steps);
    for (const char *compute : {"ledger", "lost", "stress", "rows"}) {
      const auto a = host.compute_vector(compute), b = device.compute_vector(compute);
      ASSERT_EQ(a.size(), b.size());
      largest[compute] = std::max(largest[compute], largest_of(a));
      for (std::size_t k = 0; k < a.size(); k++)
        EXPECT_NEAR(a[k], b[k], 1e-9 * largest[compute]) << compute << " " << k;
    }
    const double pressure = host.compute("pressure"), energy = energy_of(host);
    largest["pressure"] = std::max(largest["pressure"], std::fabs(pressure));
    largest["energy"] = std::max(largest["energy"], energy);
    EXPECT_NEAR(pressure, device.compute("pressure"), 1e-9 * largest["pressure"]);
    EXPECT_NEAR(energy, energy_of(device), 1e-9 * largest["energy"]);
    EXPECT_EQ(host.compute("dt"), device.compute("dt"));
    for (const int id : {1, 17, 40, 120, 200}) {
      const auto a = host.fix_row("again", id), b = device.fix_row("again", id);
      for (std::size_t k = 0; k < a.size(); k++)
        EXPECT_NEAR(a[k], b[k], 1e-9 * std::fabs(a[k])) << id << " " << k;
    }
  }
  for (const auto &[what, value] : largest) EXPECT_GT(value, 0.0) << what;
}

// A file of either style goes on with the other one.
TEST_P(ParallelKokkosWall, ExchangesRestartFilesWithTheHost)
{
  const ScratchFile between(".between"), within(".within");
  for (const bool from_device : {false, true}) {
    Variant written(from_device);
    open(written);
    written.run(150);
    written("write_restart " + between.name());
    written("restart 7 " + within.name() + " " + within.name());    // in the midst of a run
    written.run(10);
    written("restart 0");
    Variant goes_on(!from_device), again(!from_device), cut(from_device);
    const auto take_up = [this](Simulation &simulation, const ScratchFile &file) {
      simulation("read_restart " + file.name() +
                 "\ncomm_modify vel yes\nneighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
                 "thermo 1000000");
      add_walls(simulation);
    };
    take_up(goes_on, between);
    EXPECT_EQ(is_for_kokkos(goes_on, "wall"), !from_device);
    goes_on.run(10);
    written.run(200);
    goes_on.run(200);
    EXPECT_LT(difference(written.particles(), goes_on.particles()), 1e-9);
    expect_equal_outputs(written, goes_on, 1e-7, "between");

    take_up(again, within);
    take_up(cut, between);
    cut.run(4);
    cut.run(200);
    again.run(200);
    EXPECT_LT(difference(cut.particles(), again.particles()), 1e-9);
    expect_equal_outputs(cut, again, 1e-7, "within");
  }
}

constexpr const char *adhesive = "linear coeff 1e4 3e4 5e3 -5 0.5 restitution 0.8";
const Wall walls[] = {
    {"floor", adhesive, "zplane -2.6 NULL", true},
    {"planes_wiggle",
     "plateau coeff 1e4 3e4 5e3 -1 0.5 restitution 0.8 rolling sds 1e3 1 0.1 twisting marshall",
     "zplane -2.6 2.6 wiggle z 0.25 0.1", true},
    {"coming", "luding coeff 1e4 2e4 5e3 -1 0.5 depth 0.02 restitution 0.8 bound contact",
     "yplane NULL 4 velocity 3 -8 1", true},
    {"belt",
     "linear exponent 1.5 coeff 1e4 3e4 5e3 -0.1 0.5 kt 3e3 restitution 0.8 rolling constant 0.1",
     "zplane -2.6 NULL shear x 5", true},
    {"turntable", adhesive, "zplane -2.6 2.6 rotate 0.3 0 0 0 0 1 9", true},
    {"platen", adhesive, "zplane NULL 3 load -2000 mass 20 damping 10", true},
    {"cylinder", "linear coeff 1e4 3e4 5e3 -1 0.5 restitution 0.8 rolling sds 1e3 1 0.1",
     "zcylinder 3.2 shear x 5", true},
    {"drum", adhesive, "zcylinder 3.1 rotate 0 0 0 0 0 1 9 velocity 2 1 0", true},
    {"mesh", adhesive, "mesh MESH rotate 0 0 0 0.1 0 1 9", true},
    {"mesh_platen",
     "linear coeff 1e4 3e4 5e3 -1 0.5 restitution 0.8 rolling sds 1e3 1 0.1 twisting marshall",
     "mesh MESH offset 0 0 5.5 load z -2000 mass 20 damping 10", true},
    // on the host
    {"mesh_faces", adhesive, "mesh MESH faces 50", false},
    {"region", adhesive, "region ball", false},
};
INSTANTIATE_TEST_SUITE_P(Shapes, ParallelKokkosWall, testing::ValuesIn(walls),
                         [](const auto &info) {
                           return std::string(info.param.name);
                         });

/// A plane to which particles stick while they slide along it through processors, and turn.
void open_sliding(Simulation &simulation, const std::string &after = "",
                  const std::string &before_walls = "")
{
  simulation("processors * 1 1");
  simulation.open_box(3.0, 1, "p p f", "off");
  std::vector<Sphere> spheres;
  std::mt19937 generator(3);
  for (int k = 0; k < 100; k++) {
    Sphere sphere;
    sphere.radius = 0.2 + 0.02 * uniform(generator);
    sphere.x = Vec3(0.55 * (k % 10 - 4.5), 0.55 * (k / 10 - 4.5), -2.9 + sphere.radius - 0.01);
    sphere.v = Vec3(12.0, 3.0, 0.0) + 0.5 * uniform_vector(generator);
    sphere.omega = 5.0 * uniform_vector(generator);
    spheres.push_back(sphere);
  }
  simulation.create(spheres);
  simulation("pair_style zero 1.0\npair_coeff * *\ntimestep 1e-4\nfix integrate all nve/sphere\n" +
             before_walls +
             "\nfix floor all wall/gran/eepa linear coeff 1e4 2e4 1e4 -100 0.5 restitution 0.8 "
             "rolling sds 1e3 1 0.1 twisting marshall wall zplane -2.9 NULL\n"
             "fix roof all wall/gran/eepa linear coeff 1e4 2e4 1e4 -100 0.5 restitution 0.8 wall "
             "zplane NULL 2.9\nneighbor 0.3 bin\n" +
             after);
}

// Histories must have the same bits however they went through processors and were sorted.
TEST(ParallelKokkosWallExchange, KeepsTheBitsOfHistories)
{
  Variant host(false, MPI_COMM_SELF), alone(true, MPI_COMM_SELF, KokkosComm::classic),
      classic(true, MPI_COMM_WORLD, KokkosComm::classic),
      on_host(true, MPI_COMM_WORLD, KokkosComm::host), device(true);
  for (Variant *variant : {&host, &alone, &classic, &on_host, &device}) {
    open_sliding(*variant, "atom_modify sort 10 2.0");
    variant->run(0);
    EXPECT_EQ(variant->fix("floor", CONTACTS), 100.0);
    variant->run(2500);
    // all contacts have gone on, and particles were at new places
    EXPECT_EQ(variant->fix("floor", CONTACTS), 100.0);
  }
  for (Variant *variant : {&alone, &classic, &on_host, &device})
    EXPECT_EQ(difference(host.particles(), variant->particles()), 0.0);
}

// What a step costs on a GPU beside its own work: all that would go over the host.
TEST(ParallelKokkosWallExchange, LeavesParticlesAndHistoriesOnTheDevice)
{
  Variant simulation(true);
  const KokkosCounts kokkos;
  if (!kokkos.counted) GTEST_SKIP() << "KOKKOS_TOOLS_LIBS must name the library kokkos_counts";
  const char *beside =
      "suffix on\n"
      "pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -1 0.5 restitution 0.8\n"
      "atom_modify sort 1 1.0\nneigh_modify every 50 delay 0 check no";
  open_sliding(simulation, beside);
  simulation.run(100);
  kokkos.reset();
  simulation("run 1000 pre no post no");    // each row moves by more than its distance to the next
  const auto kernels = [&](const char *name) {
    return kokkos.counted(EEPA_KERNELS, name);
  };
  // two walls; the roof has no candidates
  EXPECT_EQ(kernels("gran/eepa:find_wall"), 1000u);
  EXPECT_EQ(kernels("gran/eepa:wall"), 1000u);
  EXPECT_EQ(kernels("eepa:collect_candidates"), 2u * 20u);
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const char *device = std::getenv("EEPA_KOKKOS_DEVICE");
  if (ranks > 1 && device && kernels("BuildExchangeListFunctor") == 0)
    GTEST_SKIP() << "LAMMPS exchanges on the host: this MPI does not take a GPU's memory";
  if (ranks > 1) {
    // no fix made LAMMPS exchange on the host
    EXPECT_EQ(kernels("BuildExchangeListFunctor"), 60u);
    EXPECT_GT(kernels("eepa:pack_partners"), 0u);
    EXPECT_GT(kernels("eepa:unpack_partners"), 0u);
  }
  EXPECT_GE(kernels("Sort::CopyPermute"), 20u * 18u);    // 9 arrays of particles, 3 of each owner
  EXPECT_EQ(kokkos.counted(EEPA_REGIONS, "gran/eepa: "), 0u);
  for (const char *histories :
       {"eepa:status", "eepa:quads", "eepa:partners:quads", "eepa:wall:quads", "eepa:wall:touches"})
    EXPECT_EQ(kokkos.counted(EEPA_COPIED_BYTES, histories), 0u) << histories;

  // the counts tell: a restart file brings histories to the host
  kokkos.reset();
  const ScratchFile file(".restart");
  simulation("write_restart " + file.name());
  EXPECT_EQ(kokkos.counted(EEPA_REGIONS, "gran/eepa: wall histories to the host"), 2u);

  // and walls of the host make LAMMPS sort there, so that the histories of pairs go over it
  Variant beside_host(true);
  open_sliding(beside_host, beside, "suffix off");
  beside_host.run(100);
  kokkos.reset();
  beside_host("run 1000 pre no post no");
  EXPECT_EQ(kernels("gran/eepa:wall"), 0u);
  EXPECT_EQ(kernels("Sort::CopyPermute"), 0u);
  EXPECT_GE(kokkos.counted(EEPA_REGIONS, "gran/eepa: partners to the device"), 10u);
}

// Particles come and go: LAMMPS works on the host then.
TEST(ParallelKokkosWallInsertion, IsThatOfTheHost)
{
  Variant host(false), device(true);
  for (Variant *variant : {&host, &device}) {
    open_sliding(*variant,
                 "region slab block -2.9 2.9 -2.9 2.9 0 2\n"
                 "fix deposit all deposit 50 1 13 4767 region slab attempt 200 vz -9 -3 units box\n"
                 "region corner block 0 1 0 1 -3 -2\n"
                 "fix sink all evaporate 50 1 corner 8\nfix weight all gravity 10 vector 0 0 -1");
    variant->run(1000);
  }
  const auto a = host.particles(), b = device.particles();
  EXPECT_NE(a.size(), 150u);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(difference(a, b), 0.0);
  EXPECT_GT(host.fix("floor", CONTACTS), 50.0);
}

// In a step in which the host has changed histories, LAMMPS sends particles from the device: it has counted them anew by then.
// The four on the floor are the last of this process; four others leave it when one is inserted.
TEST(ParallelKokkosWallInsertion, LeavesHistoriesToThoseThatFillGaps)
{
  std::vector<double> state[2];
  for (const bool on_device : {false, true}) {
    Variant simulation(on_device);
    simulation("atom_modify sort 0 0\nprocessors * 1 1");
    simulation.open_box(10.0);
    std::vector<Sphere> spheres;
    for (int k = 0; k < 4; k++) spheres.push_back({Vec3(-0.01, 1.5 * k - 3, 2), Vec3(0, 0, 0)});
    for (int k = 0; k < 4; k++) spheres.push_back({Vec3(-8, 1.5 * k - 3, -9.501), Vec3(0, 0, -1)});
    simulation.create(spheres);
    simulation(
        "group mover id 1:4\npair_style zero 1.0\npair_coeff * *\nneighbor 3.0 bin\n"
        "neigh_modify every 1 delay 0 check yes\ntimestep 1e-4\nfix integrate all nve/sphere\n"
        "fix floor all wall/gran/eepa linear coeff 1e4 4e4 5e3 0 0.5 restitution 0.3 wall "
        "zplane -10 NULL contacts");
    simulation.run(150);    // those on the floor rebound
    simulation("velocity mover set 200 NULL NULL\nregion slab block -5 -4 0 1 5 6\n"
               "fix deposit all deposit 1 1 100 4767 region slab attempt 200 vz -1 -1 units box");
    simulation.run(20);
    EXPECT_EQ(simulation.fix("floor", CONTACTS), 4.0);
    for (const auto &particle : simulation.particles()) state[on_device].push_back(particle.x.z());
    for (int id = 5; id <= 8; id++)
      for (const double value : simulation.fix_row("floor", id)) state[on_device].push_back(value);
  }
  ASSERT_EQ(state[0].size(), 9u + 4u * 11u);
  ASSERT_EQ(state[1].size(), state[0].size());
  for (std::size_t k = 0; k < state[0].size(); k++) EXPECT_EQ(state[0][k], state[1][k]) << k;
}

TEST(KokkosWall, StaysWhereTheRestartFileHasIt)
{
  double height[2];
  for (const bool on_device : {false, true}) {
    const ScratchFile file(".restart");
    const std::string commands =
        "pair_style zero 1.0\npair_coeff * *\ntimestep 1e-3\nfix integrate all nve/sphere\n"
        "fix weight all gravity 10 vector 0 0 -1\n"
        "fix floor all wall/gran/eepa linear coeff 1e4 2e4 5e3 0 0.5 wall zplane ";
    Variant writer(on_device), reader(on_device);
    writer.open_box(5.0);
    writer.create({{Vec3(0, 0, -3.4), Vec3(0, 0, 0)}});
    writer(commands + "-4 NULL");
    writer.run(50);
    writer("write_restart " + file.name());
    reader("read_restart " + file.name() + "\ncomm_modify vel yes\n" + commands + "-3.9 NULL");
    reader.run(200);
    height[on_device] = reader.particle(1).x.z();
  }
  EXPECT_EQ(height[0], height[1]);
}

// LAMMPS reserves room by the largest number of partners, which of no particles is not the least integer.
TEST(ParallelKokkosWallExchange, StartsWithoutParticles)
{
  for (const KokkosComm comm : {KokkosComm::device, KokkosComm::host, KokkosComm::classic})
    for (const bool some : {false, true}) {
      Variant simulation(true, MPI_COMM_WORLD, comm);
      simulation("processors * 1 1");
      simulation.open_box(5.0, 1, "f f f", "off");
      if (some) simulation.create({{Vec3(-3, 0, 0), Vec3(0, 0, 0)}});
      simulation(
          "pair_style gran/eepa linear largest 1.0\npair_coeff * * 1e4 2e4 5e3 -1 0.5 restitution "
          "0.5\ntimestep 1e-4\nfix integrate all nve/sphere");
      for (int k = 0; k < 4; k++) EXPECT_NO_THROW(simulation.run(0)) << k;
    }
}

TEST(KokkosWall, StopsAsTheHost)
{
  const char *const walls[][2] = {{"zplane -2 NULL", "overlaps the wall by"},
                                  {"zcylinder 3", "is through the cylinder of radius 3"}};
  for (const auto &wall : walls)
    for (const bool on_device : {false, true}) {
      Variant simulation(on_device);
      simulation.open_box(5.0);
      simulation.create({{Vec3(0.5, 0, 0), Vec3(0, 0, 0)}, {Vec3(1, 0, 0), Vec3(40, 0, -40)}});
      simulation(
          "pair_style zero 1.0\npair_coeff * *\ntimestep 1e-2\nfix integrate all nve/sphere\n"
          "fix wall all wall/gran/eepa linear dtcheck off coeff 10 20 5 0 0.5 wall " +
          std::string(wall[0]));
      const std::string message = error_of(simulation, "run 200");
      EXPECT_NE(message.find(wall[1]), std::string::npos) << message;
      EXPECT_NE(message.find("atom 2"), std::string::npos) << message;
    }
}

TEST(KokkosWall, SaysWhatItNeeds)
{
  Variant host(false);
  host.open_box(1.0);
  EXPECT_TRUE(refuses(host,
                      "fix wall all wall/gran/eepa/kk linear coeff 1e4 2e4 5e3 -1 0.5 wall zplane "
                      "-1 NULL",
                      "wall/gran/eepa/kk: KOKKOS is off; start LAMMPS with -k on"));
}

}    // namespace

#endif
