// SPDX-License-Identifier: GPL-2.0-only

// Contract section 2: with `scale`, lengths and times x 2 at the same density and velocities give a
// similar motion with equal stresses. All factors are powers of two, so that the arithmetic is the
// same and the motion agrees to the last bit.

#include "packing.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

struct Law {
  const char *name, *style, *coefficients;
};

class Scale : public testing::TestWithParam<Law> {};

/// A cohesive packing between six walls, under gravity, `s` times as large.
std::vector<Particle> run(double s, double *pressure)
{
  const auto &law = Scale::GetParam();
  Packing packing;
  packing.side = 5;
  packing.polydisperse = true;
  packing.types = 2;
  auto spheres = packing.spheres();
  for (auto &sphere : spheres) {
    sphere.x *= s;
    sphere.radius *= s;
    sphere.omega /= s;
  }
  const double wall = 0.5 * packing.side * packing.spacing;
  Simulation simulation;
  simulation.open_box(4.0 * s, 2);
  simulation.create(spheres);
  const std::string style = std::string(law.style) + " scale 0.75";
  simulation("neighbor " + exact(0.125 * s) + " bin\npair_style gran/eepa " + style +
             "\npair_coeff 1 1 " + law.coefficients + "\npair_coeff 2 2 " + law.coefficients +
             "\nfix integrate all nve/sphere\nfix gravity all gravity " + exact(10.0 / s) +
             " vector 0 0 -1\ntimestep " + exact(s * 0x1p-12) +
             "\ncompute stress all pressure NULL virial");
  for (const std::string plane : {"xplane", "yplane", "zplane"})
    simulation("fix " + plane + " all wall/gran/eepa " + style + " coeff " + law.coefficients +
               " wall " + plane + " " + exact(-wall * s) + " " + exact(wall * s) +
               (plane == "zplane" ? " velocity 0.03125 0 0" : ""));
  simulation.run(1000);
  simulation("run 200 pre no post no");
  *pressure = simulation.compute("stress");
  return simulation.particles();
}

TEST_P(Scale, ByTwoIsTheSameMotionToTheBit)
{
  double pressure[2];
  const auto small = run(1.0, pressure), large = run(2.0, pressure + 1);
  ASSERT_EQ(small.size(), 125u);
  ASSERT_EQ(large.size(), 125u);
  double moved = 0.0, forces = 0.0;
  int same = 0;
  for (std::size_t k = 0; k < small.size(); k++) {
    same += large[k].x == 2.0 * small[k].x && large[k].v == small[k].v &&
        large[k].omega == 0.5 * small[k].omega && large[k].f == 4.0 * small[k].f &&
        large[k].torque == 8.0 * small[k].torque;
    moved = std::max(moved, small[k].v.norm());
    forces = std::max(forces, small[k].f.norm());
  }
  EXPECT_EQ(same, 125);
  EXPECT_GT(moved, 0.01);
  EXPECT_GT(forces, 1.0);
  EXPECT_EQ(pressure[0], pressure[1]);    // a volume 8 times as large, energies 8 times
}

const Law laws[] = {
    {"linear", "linear", "8e3 2e4 5e3 -1 0.3 restitution 0.8"},
    {"linear_constant", "linear", "8e3 2e4 5e3 -1 0.3 restitution 0.8 rolling constant 0.01"},
    {"linear_sds", "linear limit_damping yes",
     "8e3 2e4 5e3 -1 0.3 viscous 2 1 rolling sds 1e3 1 0.1"},
    {"linear_twisting", "linear", "8e3 2e4 5e3 -1 0.3 restitution 0.8 twisting marshall"},
    {"plateau", "plateau", "8e3 2e4 5e3 -1 0.3 restitution 0.8"},
    {"plateau_constant", "plateau", "8e3 1.6e4 5e3 -1 0.3 viscous 2 1 rolling constant 0.01"},
    {"plateau_sds", "plateau", "8e3 2e4 5e3 -1 0.3 restitution 0.8 rolling sds 1e3 1 0.1"},
    {"luding", "luding", "8e3 2e4 5e3 -1 0.3 depth 0.005 restitution 0.8"},
    {"luding_sds", "luding",
     "8e3 2e4 5e3 -1 0.3 depth 0.005 viscous 2 1 rolling sds 1e3 1 0.1 "
     "bound contact"},
    {"exponent", "linear exponent 1.5", "4e4 8e4 2e4 -1 0.3 kt 3e3 restitution 0.8"},
    {"exponent_constant", "linear exponent 1.5",
     "4e4 8e4 2e4 -1 0.3 kt 3e3 restitution 0.8 rolling constant 0.01"},
    {"exponent_sds", "linear exponent 1.5",
     "4e4 8e4 2e4 -1 0.3 kt 3e3 viscous 2 1 rolling sds 1e3 1 0.1"},
    {"exponent_sds_twisting", "linear exponent 1.5",
     "4e4 8e4 2e4 -1 0.3 kt 3e3 viscous 2 1 rolling sds 1e3 1 0.1 twisting marshall"},
};
INSTANTIATE_TEST_SUITE_P(Laws, Scale, testing::ValuesIn(laws), [](const auto &info) {
  return std::string(info.param.name);
});

// s = d/d_ref = 3, not a power of two: one contact by the formula of contract section 2.
TEST(ScaleFormula, StiffnessGoesWithSAndPullOffWithItsSquare)
{
  Simulation simulation;
  simulation.open_box(4.0);
  simulation.create({{Vec3(0, 0, 0), Vec3::Zero(), Vec3::Zero(), 1.0},
                     {Vec3(1.49, 0, 0), Vec3::Zero(), Vec3::Zero(), 0.5}});
  simulation("pair_style gran/eepa linear scale 0.5\npair_coeff 1 1 1e4 2e4 5e3 -2 0.5\n"
             "fix integrate all nve/sphere\ntimestep 1e-4\nrun 0 post no");
  EXPECT_NEAR(simulation.particle(2).f.x(), 3.0 * 1e4 * 0.01 - 9.0 * 2.0, 1e-8);
  // exponent 1.5: k goes with s^(2-n)
  simulation("pair_style gran/eepa linear scale 0.5 exponent 1.5\n"
             "pair_coeff 1 1 1e4 2e4 5e3 -2 0.5 kt 1e3\nrun 0 post no");
  EXPECT_NEAR(simulation.particle(2).f.x(), std::sqrt(3.0) * 1e4 * std::pow(0.01, 1.5) - 18.0,
              1e-8);
}

}    // namespace
