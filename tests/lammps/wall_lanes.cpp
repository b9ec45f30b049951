// SPDX-License-Identifier: GPL-2.0-only

// Contacts with a wall that go on are evaluated side by side, except where their table is wanted: the same
// bits for every law.

#include "simulation.h"
#include "triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace eepa_test;

namespace {

constexpr int last_output = 24, CONTACTS = 6;

struct Law {
  const char *name, *style, *options;
};

class LanesAtWalls : public testing::TestWithParam<Law> {
 protected:
  /// 36 particles on a floor that shakes, in a tube, with a lid that turns above them.
  void open(Simulation &simulation, const std::string &table) const
  {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 6; i++)
      for (int j = 0; j < 6; j++) {
        Sphere sphere;
        sphere.x = Vec3(0.9 * (i - 2.5), 0.9 * (j - 2.5), -2.55 + 0.01 * ((3 * i + 5 * j) % 7));
        sphere.v = Vec3(0.3 * (j % 3) - 0.2, 0.2 * (i % 3) - 0.3, -0.1 * ((i + j) % 4));
        sphere.omega = Vec3(0.5 * (i % 4) - 1.0, 0.3 * (j % 5), 0.4 * ((i * j) % 3) - 0.5);
        sphere.radius = 0.4 + 0.01 * ((i + 2 * j) % 5);
        spheres.push_back(sphere);
      }
    simulation.open_box(4.0);
    simulation.create(spheres);
    const std::string wall = std::string(" all wall/gran/eepa ") + GetParam().style +
        " coeff 1e4 2e4 5e3 -0.1 0.5 restitution 0.7 " + GetParam().options + " wall ";
    simulation(
        "pair_style zero 1.0\npair_coeff * *\ntimestep 2e-4\nfix move all nve/sphere\n"
        "fix g all gravity 10 vector 0.2 0.1 -1\nfix floor" +
        wall + "zplane -3 NULL wiggle z 0.01 0.2 " + table + "\nfix tube" + wall +
        "zcylinder 3.75 shear z 0.3 " + table + "\nfix lid" + wall + "mesh " + mesh_.name() +
        " rotate 0 0 0 0 0 1 2 " + table +
        "\nfix_modify floor energy yes\nfix_modify tube energy yes\nfix_modify lid energy yes");
  }
  void SetUp() override { write_stl(mesh_.name(), box(3.0, 7)); }

 private:
  ScratchFile mesh_{".stl"};
};

TEST_P(LanesAtWalls, HaveTheBitsOfOneByOne)
{
  Simulation in_lanes, one_by_one;
  open(in_lanes, "");
  open(one_by_one, "contacts");
  double most = 0.0, largest_energy = 0.0;
  for (int look = 0; look < 10; look++) {
    in_lanes.run(50);
    one_by_one.run(50);
    const auto a = in_lanes.particles(), b = one_by_one.particles();
    for (std::size_t k = 0; k < a.size(); k++) {
      ASSERT_EQ(a[k].x, b[k].x) << k << " at look " << look;
      ASSERT_EQ(a[k].v, b[k].v) << k << " at look " << look;
      ASSERT_EQ(a[k].omega, b[k].omega) << k << " at look " << look;
    }
    const double energy = one_by_one.thermo("pe");
    largest_energy = std::max(largest_energy, energy);
    ASSERT_NEAR(in_lanes.thermo("pe"), energy, 1e-12 * energy) << look;
    for (const char *fix : {"floor", "tube", "lid"}) {
      // sums over particles are in another order
      for (int k = 1; k <= last_output; k++) {
        const double value = one_by_one.fix(fix, k);
        ASSERT_NEAR(in_lanes.fix(fix, k), value, 1e-12 * (1.0 + std::fabs(value)))
            << fix << " " << k;
      }
      most = std::max(most, in_lanes.fix(fix, CONTACTS));
    }
  }
  EXPECT_GE(most, 8.0);
  EXPECT_GT(largest_energy, 0.0);
}

const Law laws[] = {
    {"linear", "linear", ""},
    {"constant", "linear", "rolling constant 0.01"},
    {"sds_twisting", "linear", "rolling sds 1e3 0.1 0.1 twisting marshall"},
    {"scaled", "linear scale 0.5", "rolling constant 0.01"},
    {"hertz", "linear exponent 1.5", "kt 3e3"},
    {"plateau", "plateau", "rolling constant 0.01"},
    {"luding", "luding", "depth 0.05"},
};
INSTANTIATE_TEST_SUITE_P(Laws, LanesAtWalls, testing::ValuesIn(laws), [](const auto &info) {
  return std::string(info.param.name);
});

}    // namespace
