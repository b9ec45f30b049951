// SPDX-License-Identifier: GPL-2.0-only

// Histories of a restart file that another pair style, or another script, reads: they are right, or
// refused by name before a step is run, and a refusal loses nothing.

#include "packing.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <limits>

using namespace eepa_test;

namespace {

constexpr const char *box =
    "comm_modify vel yes\nneighbor 0.1 bin\nthermo 1000000\nfix integrate all nve/sphere\n"
    "timestep 2e-4\n";
const std::string base = " 1e4 2e4 5e3 -1 0.3";
const std::string sds = base + " rolling sds 1e3 1 0.1";

/// Contacts by their IDs with what single() shows of their histories.
std::vector<std::vector<double>> histories(const Simulation &simulation)
{
  std::vector<std::vector<double>> all;
  for (const auto &contact : simulation.contacts())
    all.push_back({static_cast<double>(std::min(contact.i, contact.j)),
                   static_cast<double>(std::max(contact.i, contact.j)), contact.max_overlap(),
                   contact.tangential().norm()});
  return all;
}

/// A packing of two types in mid-unloading and its restart file.
class Written {
 public:
  /// \param with_contacts  compute pair/local crashes with LAMMPS's hybrid
  explicit Written(const std::string &style, bool with_contacts = true,
                   const std::string &newton = "on")
  {
    Packing packing;
    packing.types = 2;
    simulation.open_box(packing.half(), 2, "p p p", newton);
    simulation.create(packing.spheres());
    simulation(box + style);
    if (with_contacts) simulation.watch_contacts();
    simulation.run(200);
    simulation("write_restart " + file.name());
    simulation.run(0);
    particles = simulation.particles();
    if (!with_contacts) return;
    expected = histories(simulation);
    EXPECT_GT(expected.size(), 400u);
  }

  Simulation simulation;
  const ScratchFile file{".restart"};
  std::vector<Particle> particles;
  std::vector<std::vector<double>> expected;    // histories
};

std::string read(const ScratchFile &file)
{
  return "read_restart " + file.name() + "\n" + box;
}

// A script must name hybrid's sub-styles again to give pair_coeffs. LAMMPS then destroys the
// sub-styles and with them everything that they read from the restart file.
struct Scripts {
  const char *name;
  std::string written, other, same;
  int has, needs;
};

class ParallelLayout : public testing::TestWithParam<Scripts> {};

TEST_P(ParallelLayout, OfAnotherSizeIsRefusedAndLosesNothing)
{
  const Scripts &scripts = GetParam();
  const Written original(scripts.written, false);
  Simulation restarted;
  restarted(read(original.file));
  const std::string message = "pair_style gran/eepa: the restart file has " +
      std::to_string(scripts.has) + " values a contact and the pair_coeffs need " +
      std::to_string(scripts.needs);
  EXPECT_TRUE(refuses(restarted, scripts.other + "\nrun 0", message));
  EXPECT_TRUE(refuses(restarted, "run 0", message));
  restarted(scripts.same);
  restarted.run(0);
  EXPECT_LT(difference(original.particles, restarted.particles()), 1e-12);
}

const Scripts layouts[] = {
    {"hybrid", "pair_style hybrid gran/eepa linear\npair_coeff * * gran/eepa" + base,
     "pair_style hybrid gran/eepa linear\npair_coeff * * gran/eepa" + sds,
     "pair_style hybrid gran/eepa linear\npair_coeff * * gran/eepa" + base, 4, 7},
    {"overlay", "pair_style hybrid/overlay gran/eepa linear\npair_coeff * * gran/eepa" + sds,
     "pair_style hybrid/overlay gran/eepa linear\npair_coeff * * gran/eepa" + base,
     "pair_style hybrid/overlay gran/eepa linear\npair_coeff * * gran/eepa" + sds, 7, 4},
    {"none_between", "pair_style gran/eepa linear\npair_coeff * *" + base,
     "pair_style none\npair_style gran/eepa linear\npair_coeff * *" + sds,
     "pair_style none\npair_style gran/eepa linear\npair_coeff * *" + base, 4, 7},
    {"alone_to_hybrid", "pair_style gran/eepa linear\npair_coeff * *" + base,
     "pair_style hybrid gran/eepa linear\npair_coeff * * gran/eepa" + sds,
     "pair_style hybrid gran/eepa linear\npair_coeff * * gran/eepa" + base, 4, 7},
    {"two_substyles",
     "pair_style hybrid gran/eepa linear gran/eepa linear\npair_coeff 1 * gran/eepa 1" + sds +
         "\npair_coeff 2 2 gran/eepa 2" + base,
     "pair_style hybrid gran/eepa linear gran/eepa linear\npair_coeff 1 * gran/eepa 2" + sds +
         "\npair_coeff 2 2 gran/eepa 1" + base,
     "pair_style hybrid gran/eepa linear gran/eepa linear\npair_coeff 1 * gran/eepa 1" + sds +
         "\npair_coeff 2 2 gran/eepa 2" + base,
     7, 4},
};
INSTANTIATE_TEST_SUITE_P(Scripts, ParallelLayout, testing::ValuesIn(layouts),
                         [](const auto &scripts) {
                           return scripts.param.name;
                         });

TEST(RestartLaw, ThatIsAnotherOneIsSaid)
{
  const Written original("pair_style gran/eepa linear\npair_coeff * *" + base);
  const ScratchFile log(".log");
  {
    Simulation restarted(MPI_COMM_WORLD, log.name());
    restarted(read(original.file) + "pair_style gran/eepa plateau\nrun 0 post no");
  }
  EXPECT_NE(log.text().find(std::to_string(original.expected.size()) +
                            " contacts have histories of the law linear with exponent 1 and go on "
                            "with plateau and exponent 1"),
            std::string::npos);
  const ScratchFile hardening(".log");
  {
    Simulation restarted(MPI_COMM_WORLD, hardening.name());
    restarted(read(original.file) +
              "pair_style gran/eepa luding\n"
              "pair_coeff * * 1e4 2e4 5e3 -1 0.3 depth 0.01\nrun 0 post no");
  }
  EXPECT_NE(hardening.text().find("of the law linear with exponent 1 and go on with luding"),
            std::string::npos);
  const ScratchFile quiet(".log");
  {
    Simulation restarted(MPI_COMM_WORLD, quiet.name());
    restarted(read(original.file) + "run 0 post no\nrun 0 post no");
  }
  EXPECT_EQ(quiet.text().find("have histories of the law"), std::string::npos);
  EXPECT_EQ(quiet.text().find("is one of this pair style"), std::string::npos);
}

TEST(RestartLaw, ThatChangesBetweenRunsIsSaid)
{
  const ScratchFile log(".log");
  {
    Simulation simulation(MPI_COMM_WORLD, log.name());
    simulation.open_box(3.0);
    simulation.create({{Vec3(0, 0, 0)}, {Vec3(0.99, 0, 0)}});
    simulation(std::string(box) + "pair_style gran/eepa linear\npair_coeff * *" + base +
               " kt 1e3\nrun 1 post no\npair_style gran/eepa linear exponent 1.5\nrun 1 post no");
  }
  EXPECT_NE(log.text().find("1 contacts have histories of the law linear with exponent 1 and go "
                            "on with linear and exponent 1.5"),
            std::string::npos);
}

// Histories are found by the position of the sub-style; with another order those of one type go to
// the other, which has no such pairs.
TEST(RestartOrder, OfSubStylesThatIsAnotherOneIsSaid)
{
  const std::string style = "pair_style hybrid gran/eepa linear gran/eepa linear\n";
  const Written original(
      style + "pair_coeff 1 * gran/eepa 1" + base + "\npair_coeff 2 2 gran/eepa 2" + base, false);
  const ScratchFile log(".log");
  {
    Simulation restarted(MPI_COMM_WORLD, log.name());
    restarted(read(original.file) + style + "pair_coeff 1 * gran/eepa 2" + base +
              "\npair_coeff 2 2 gran/eepa 1" + base + "\nrun 0 post no");
  }
  EXPECT_NE(log.text().find("is one of this pair style, and all contacts start as new ones"),
            std::string::npos);
}

class ParallelDeletion : public testing::TestWithParam<const char *> {};

// LAMMPS moves atoms into the slots of deleted ones, but not the data that a restart file has for
// them.
TEST_P(ParallelDeletion, BetweenReadRestartAndTheFirstRunIsRefused)
{
  const Written original("pair_style gran/eepa linear\npair_coeff * *" + base, true, GetParam());
  const std::string remove = "group gone id 1:20\ndelete_atoms group gone compress no\n";
  Simulation at_once, after_setup;
  EXPECT_TRUE(refuses(at_once, read(original.file) + remove + "run 0",
                      "atoms were deleted, or given other IDs, after read_restart and before the "
                      "first run.*put run 0 before that command"));
  after_setup(read(original.file) + "run 0 post no\n" + remove);
  after_setup.watch_contacts();
  after_setup.run(0);
  std::vector<std::vector<double>> kept;
  for (const auto &contact : original.expected)
    if (contact[0] > 20.0) kept.push_back(contact);
  EXPECT_EQ(kept, histories(after_setup));
}
INSTANTIATE_TEST_SUITE_P(Newton, ParallelDeletion, testing::Values("on", "off"));

// Damage to the histories in a file is detected.
TEST(DamagedRestart, IsRefused)
{
  const Written original("pair_style gran/eepa linear scale 0.75\npair_coeff * *" + base);
  const std::string whole = original.file.text();
  const auto bytes_of = [](double number) {
    return std::string(reinterpret_cast<const char *>(&number), sizeof(number));
  };
  // numbers that occur in the file only once: a contact's largest overlap, a reference diameter
  const double max_overlap = original.expected.at(7).at(2);
  const struct {
    double value, damaged;
    const char *message;
  } faults[] = {
      {max_overlap, std::numeric_limits<double>::quiet_NaN(),
       "the restart file is damaged: histories of contacts have impossible numbers"},
      {max_overlap, -std::numeric_limits<double>::infinity(),
       "the restart file is damaged: histories of contacts have impossible numbers"},
      {0.75, -0.75, "the restart file is damaged: scale d_ref = -0.75 is not allowed"},
      {5e3, -5e3, "the restart file is damaged: pair_coeff 1 1: k_adh = -5000 is not allowed"},
  };
  for (const auto &fault : faults) {
    std::string bytes = whole;
    const auto at = bytes.find(bytes_of(fault.value));
    ASSERT_NE(at, std::string::npos) << fault.message;
    bytes.replace(at, sizeof(double), bytes_of(fault.damaged));
    const ScratchFile file(".restart");
    std::ofstream(file.name(), std::ios::binary) << bytes;
    Simulation restarted;
    EXPECT_TRUE(refuses(restarted, read(file) + "run 0", fault.message));
  }
}

TEST(DamagedRestart, WithAnImpossibleNumberOfPartnersIsRefused)
{
  const ScratchFile file(".restart");
  Simulation original;
  original.open_box(3.0);
  original.create({{Vec3(0, 0, 0)}, {Vec3(0.99, 0, 0)}});
  original(std::string(box) + "pair_style gran/eepa linear\npair_coeff * *" + base);
  original.run(3);
  original("write_restart " + file.name());
  const std::string whole = file.text();
  // size, partners, (ID, 4 values), ID, owner, values: 2 + 5 + 3 numbers, the first two are 10 1
  const double head[] = {10.0, 1.0};
  const std::string before(reinterpret_cast<const char *>(head), sizeof(head));
  for (const double damaged : {2.0, -1.0, 0.5, 1e300, 0.0}) {
    for (const int which : {0, 1}) {
      std::string bytes = whole;
      const auto at = bytes.find(before);
      ASSERT_NE(at, std::string::npos);
      bytes.replace(at + which * sizeof(double), sizeof(double),
                    reinterpret_cast<const char *>(&damaged), sizeof(double));
      const ScratchFile wrong(".restart");
      std::ofstream(wrong.name(), std::ios::binary) << bytes;
      Simulation restarted;
      EXPECT_TRUE(refuses(restarted, read(wrong) + "run 0", "the restart file is damaged"))
          << which << " " << damaged;
    }
  }
}

}    // namespace
