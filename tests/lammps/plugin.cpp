// SPDX-License-Identifier: GPL-2.0-only

// eepaplugin.so in a stock LAMMPS: it loads and runs, and a plugin that was compiled for another
// LAMMPS is refused. Each test starts a separate program, which does not have the plugins of this
// process.

#include "eepa_styles.h"
#include "simulation.h"

#include "lammps.h"
#include "lammpsplugin.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <set>

extern "C" void lammpsplugin_init(void *, void *, void *);

using namespace eepa_test;

namespace {

struct Outcome {
  int status;
  std::string output;
};

const char *variable(const char *name)
{
  const char *value = std::getenv(name);
  return value ? value : "";
}

class StockLammps : public testing::Test {
 protected:
  void SetUp() override
  {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "a stock LAMMPS can not load a plugin compiled with AddressSanitizer";
#endif
    if (!std::getenv("EEPA_STOCK_LMP")) GTEST_SKIP() << "started by hand: ctest says where lmp is";
    ASSERT_TRUE(std::ifstream(variable("EEPA_STOCK_LMP")).good()) << variable("EEPA_STOCK_LMP");
  }

  /// Runs an input in a process that knows nothing of the mpirun around this one.
  Outcome run(const std::string &program, const std::string &input, const std::string &environment)
  {
    const ScratchFile script(".in"), log(".log");
    std::ofstream(script.name()) << input;
    const std::string command = "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 " +
        environment + " '" + program + "' -nocite -log none -in " + script.name() + " > " +
        log.name() + " 2>&1 < /dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, log.text()};
  }

  std::string folder_of(const std::string &file)
  {
    return file.substr(0, file.rfind('/'));
  }
};

constexpr const char *impact =
    "units si\natom_style sphere\natom_modify map array\nboundary f f f\nregion box block -2 2 -2 "
    "2 -2 2\n"
    "create_box 1 box\ncomm_modify vel yes\ncreate_atoms 1 single -0.505 0 0\n"
    "create_atoms 1 single 0.505 0 0\nset group all diameter 1 density 1.9098593171027440\n"
    "set atom 1 vx 1\npair_style gran/eepa linear\npair_coeff 1 1 1e4 4e4 0 0 0\n"
    "fix wall all wall/gran/eepa linear coeff 1e4 4e4 0 0 0 wall zplane -1 NULL\n"
    "compute n all gran/eepa/contacts\ncompute dt all gran/eepa/dt\n"
    "fix integrate all nve/sphere\ntimestep 1e-5\n"
    "thermo_style custom step c_n[1] c_dt f_wall[6]\nrun 8000\n"
    "variable e equal vx[2]-vx[1]\nprint \"restitution ${e}\"\n";

// e = sqrt(k1/k2) = 0.5
void expect_impact(const Outcome &outcome)
{
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  const auto at = outcome.output.find("\nrestitution ");
  ASSERT_NE(at, std::string::npos) << outcome.output;
  EXPECT_NEAR(std::stod(outcome.output.substr(at + 13)), 0.5, 1e-3);
}

TEST_F(StockLammps, DoesNotKnowTheStyleWithoutThePlugin)
{
  const Outcome outcome = run(variable("EEPA_STOCK_LMP"), impact, "");
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.output.find("gran/eepa"), std::string::npos);
}

TEST_F(StockLammps, RunsWithThePluginLoaded)
{
  expect_impact(run(variable("EEPA_STOCK_LMP"),
                    std::string("plugin load ") + variable("EEPA_PLUGIN") + "\n" + impact, ""));
}

TEST_F(StockLammps, FindsThePluginOnItsPath)
{
  // the build folder has one plugin; those that must be refused are in other folders
  expect_impact(run(variable("EEPA_STOCK_LMP"), impact,
                    "LAMMPS_PLUGIN_PATH='" + folder_of(variable("EEPA_PLUGIN")) + "'"));
}

TEST_F(StockLammps, OfThisProjectNeedsNothing)
{
  expect_impact(run(variable("EEPA_LMP"), impact, ""));
}

TEST_F(StockLammps, RefusesAPluginForAnotherVersion)
{
  const Outcome outcome =
      run(variable("EEPA_STOCK_LMP"),
          std::string("plugin load ") + variable("EEPA_PLUGIN_OTHER_VERSION") + "\n" + impact, "");
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.output.find("ERROR: plugin eepaplugin.so was compiled for LAMMPS version "
                                "20200101 and can not be loaded into version " +
                                std::to_string(EEPA_LAMMPS_DATE)),
            std::string::npos)
      << outcome.output;
}

TEST_F(StockLammps, RefusesAPluginForOtherIntegerSizes)
{
  const Outcome outcome =
      run(variable("EEPA_STOCK_LMP"),
          std::string("plugin load ") + variable("EEPA_PLUGIN_OTHER_SIZES") + "\n" + impact, "");
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.output.find("ERROR: plugin eepaplugin.so was compiled for tagint, bigint and "
                                "imageint of 8, 8 and 8 bytes and can not be loaded into a LAMMPS "
                                "with 4, 8 and 4"),
            std::string::npos)
      << outcome.output;
}

// The plugin's entry passes every style of the one list to LAMMPS.
std::set<std::string> registered;
void remember(lammpsplugin_t *plugin, void *)
{
  EXPECT_NE(plugin->creator.v1, nullptr);
  registered.insert(std::string(plugin->style) + " " + plugin->name);
}

TEST(PluginEntry, RegistersEveryStyle)
{
  Simulation simulation;
  registered.clear();
  lammpsplugin_init(simulation.lammps(), nullptr, reinterpret_cast<void *>(&remember));
  EXPECT_EQ(registered.size(), LAMMPS_NS::eepa_styles().size());
  for (const char *style : {"pair gran/eepa", "fix wall/gran/eepa", "compute gran/eepa/contacts",
                            "compute gran/eepa/dt", "compute gran/eepa/energy",
                            "compute gran/eepa/energy/atom"})
    EXPECT_EQ(registered.count(style), 1u) << style;
}

}    // namespace
