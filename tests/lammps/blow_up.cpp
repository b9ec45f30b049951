// SPDX-License-Identifier: GPL-2.0-only

// A run with impossible overlaps ends with an error that names the particles, not with NaN.
// Restart files of other formats are refused by name.

#include "packing.h"
#include "wall_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <regex>

using namespace eepa_test;

namespace {

void expect_no_nan(const std::string &log)
{
  EXPECT_FALSE(std::regex_search(log, std::regex("\\b(nan|NaN|inf)\\b"))) << log;
}

class BlowUp : public testing::TestWithParam<const char *> {
 protected:
  const ScratchFile log{".log"};
};

// A hundred times the bound. The error names the step in which the particle would pass through.
TEST_P(BlowUp, OfAPackingNamesTwoAtoms)
{
  Simulation simulation(MPI_COMM_WORLD, log.name());
  Packing packing;
  packing.side = 5;
  packing.speed = 2.0;
  simulation.open_box(packing.half(), 1, "p p p");
  simulation.create(packing.spheres());
  simulation(std::string("pair_style gran/eepa ") + GetParam() +
             "\nfix integrate all nve/sphere\ntimestep 0.1\n"
             "compute ledger all gran/eepa/energy\n"
             "thermo_style custom step ke pe press c_ledger[4]\nthermo 1");
  EXPECT_TRUE(refuses(simulation, "run 200",
                      "pair_style gran/eepa: atoms [0-9]+ and [0-9]+ overlap by [0-9.e+-]+ at step "
                      "[0-9]+, more than a radius \\([0-9.]+ and [0-9.]+\\): the time step is too "
                      "large"));
  expect_no_nan(log.text());
  EXPECT_NE(log.text().find("WARNING: pair_style gran/eepa: timestep 0.1 is larger than"),
            std::string::npos);
}

TEST_P(BlowUp, AtAWallNamesTheAtom)
{
  Simulation simulation(MPI_COMM_WORLD, log.name());
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, -1)}, {Vec3(1.5, 0, 0.501), Vec3(0, 0, -8)}});
  // only the second one is in the fix's group
  simulation(
      "group falling id 2\npair_style zero 1.0\npair_coeff * *\nfix w falling wall/gran/eepa " +
      std::string(GetParam()).replace(std::string(GetParam()).find('\n'), 15, " coeff ") +
      " wall zplane 0 NULL\nfix integrate all nve/sphere\ntimestep 0.1\n"
      "thermo_style custom step ke f_w[3]\nthermo 1");
  EXPECT_TRUE(
      refuses(simulation, "run 50",
              "fix w wall/gran/eepa: atom 2 overlaps the wall by [0-9.]+ at step [0-9]+, more "
              "than its radius 0.5: the time step is too large"));
  expect_no_nan(log.text());
}
INSTANTIATE_TEST_SUITE_P(
    Laws, BlowUp,
    testing::Values(
        "linear\npair_coeff * * 1e4 2e4 5e3 -1 0.5 restitution 0.5",
        "plateau\npair_coeff * * 1e4 2e4 5e3 -1 0.5 viscous 5 5 rolling constant 0.1",
        "linear exponent 1.5\npair_coeff * * 1e5 2e5 5e4 0 0.5 kt 3e3 rolling sds 1e3 1 "
        "0.1"));

// A start with one particle inside another is an error in the set-up, with both IDs. For different
// sizes the smaller radius counts.
TEST(OverlapBeyondARadius, IsNamedBeforeAnyStep)
{
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create(
      {{Vec3(2, 2, 2)}, {Vec3(0, 0, 0)}, {Vec3(0.54, 0, 0), Vec3::Zero(), Vec3::Zero(), 0.2}});
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 0 0 0\ntimestep 1e-4\n"
             "fix integrate all nve/sphere\nrun 0 post no\nset atom 3 x 0.49");
  const std::string message = error_of(simulation, "run 10");
  EXPECT_TRUE(message.find("atoms 2 and 3 overlap by 0.21 at step 0") != std::string::npos ||
              message.find("atoms 3 and 2 overlap by 0.21 at step 0") != std::string::npos)
      << message;
}

// Two coincident centres: an overlap without a direction.
TEST(OverlapBeyondARadius, OfTwoAtomsAtOnePlaceIsNamed)
{
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(0, 0, 0)}});
  simulation("pair_style gran/eepa plateau\npair_coeff * * 1e4 2e4 0 0 0\ntimestep 1e-4\n"
             "fix integrate all nve/sphere");
  EXPECT_TRUE(refuses(simulation, "run 10", "atoms [12] and [12] overlap by 1 at step 0"));
}

class OtherFormat : public testing::Test {
 protected:
  const ScratchFile file{".restart"};
  static constexpr const char *wall =
      "fix wall all wall/gran/eepa linear coeff 1e4 4e4 5e3 -1 0.5 wall zplane 0 NULL velocity 0 0 "
      "0.0625";
  static constexpr const char *box = "comm_modify vel yes\nneighbor 0.1 bin\n";

  void write()
  {
    Simulation original;
    original.open_box(4.0);
    original.create({{Vec3(0, 0, 0.49)}, {Vec3(0.99, 0, 0.49)}});
    original(
        "pair_style gran/eepa plateau exponent 1 scale 0.625\npair_coeff 1 1 1e4 4e4 5e3 -1 0.5\n"
        "fix integrate all nve/sphere\ntimestep 0.0001220703125\n" +
        std::string(wall));
    original.run(16);
    original("write_restart " + file.name());
  }
  /// Replaces the number before the only occurrence of the given ones by `other`.
  void patch(double own, const std::vector<double> &after, double other)
  {
    std::string bytes = file.text();
    std::vector<double> all = {own};
    all.insert(all.end(), after.begin(), after.end());
    const std::string pattern(reinterpret_cast<const char *>(all.data()),
                              all.size() * sizeof(double));
    const auto at = bytes.find(pattern);
    ASSERT_NE(at, std::string::npos);
    ASSERT_EQ(bytes.find(pattern, at + 1), std::string::npos);
    bytes.replace(at, sizeof(double), reinterpret_cast<const char *>(&other), sizeof(double));
    std::ofstream(file.name(), std::ios::binary) << bytes;
  }
};

TEST_F(OtherFormat, OfTheWallIsRefusedByName)
{
  for (const int other : {2, 9}) {    // 2 did not say which surface
    write();
    // format, how many numbers, zplane, lo, at 0
    patch(LAMMPS_NS::wall_state::restart_format,
          {LAMMPS_NS::wall_state::N_STATE, 2.0, 1.0, 0.0, 0.0}, other);
    Simulation restarted;
    EXPECT_TRUE(refuses(restarted, "read_restart " + file.name() + "\n" + box + wall,
                        "fix wall wall/gran/eepa: the restart file has format " +
                            std::to_string(other) + ", this version reads 3 and 5"));
  }
}

TEST_F(OtherFormat, UnchangedIsRead)
{
  write();
  Simulation restarted;
  EXPECT_EQ(error_of(restarted,
                     "read_restart " + file.name() + "\n" + box + wall +
                         "\nfix integrate all nve/sphere\nrun 1"),
            "");
}

// A truncated file must not be taken for a complete one.
TEST_F(OtherFormat, CutOffIsRefused)
{
  write();
  const std::string bytes = file.text();
  std::ofstream(file.name(), std::ios::binary | std::ios::trunc)
      << bytes.substr(0, bytes.size() - 200);
  Simulation restarted;
  EXPECT_NE(error_of(restarted, "read_restart " + file.name()), "");
}

}    // namespace
