// SPDX-License-Identifier: GPL-2.0-only

// Frictionless `linear` with k2 = k1, k_adh = f0 = 0 is the linear spring-dashpot: the same motion
// as LAMMPS's own pair_style gran/hooke on a packing. Without friction the arms do not matter.

#include "packing.h"

#include <gtest/gtest.h>

#include <cstdio>

using namespace eepa_test;

namespace {

struct Comparison {
  const char *name;
  bool polydisperse;
  const char *gran_hooke, *gran_eepa;
};

class GranHooke : public testing::TestWithParam<Comparison> {};

TEST_P(GranHooke, MovesAPackingAlike)
{
  Packing packing;
  packing.polydisperse = GetParam().polydisperse;
  std::vector<Particle> end[2];
  double work = 0.0;
  for (int which = 0; which < 2; which++) {
    Simulation simulation;
    simulation.open_box(packing.half(), 1, "p p p");
    simulation.create(packing.spheres());
    const auto start = simulation.particles();
    simulation(which ? GetParam().gran_eepa : GetParam().gran_hooke);
    simulation("fix integrate all nve/sphere\ntimestep 5e-4");
    simulation.run(500);
    end[which] = simulation.particles();
    for (std::size_t k = 0; k < start.size(); k++)
      work = std::max(work, (start[k].v - end[which][k].v).norm());
  }
  EXPECT_EQ(end[0].size(), 216u);
  EXPECT_GT(work, 1.0);    // contacts changed velocities by more than their initial values
  // 1e-9 as the contract asks: rounding, 1e-16, grown by 500 steps of colliding particles
  const double deviation = difference(end[0], end[1]);
  EXPECT_LT(deviation, 1e-9);
  std::printf("%s: %.1e\n", GetParam().name, deviation);
}

// meff gamma_n of gran/hooke is B_n: m* = 1/2 and gamma_n = 8 make 4. One B_n for all pairs agrees
// with it only where all masses are equal.
const Comparison comparisons[] = {
    {"undamped", false, "pair_style gran/hooke 1e4 0 0 0 0 0\npair_coeff * *",
     "pair_style gran/eepa linear\npair_coeff * * 1e4 1e4 0 0 0"},
    {"undamped_polydisperse", true, "pair_style gran/hooke 1e4 0 0 0 0 0\npair_coeff * *",
     "pair_style gran/eepa linear\npair_coeff * * 1e4 1e4 0 0 0"},
    {"viscous", false, "pair_style gran/hooke 1e4 0 8 0 0 0\npair_coeff * *",
     "pair_style gran/eepa linear\npair_coeff * * 1e4 1e4 0 0 0 viscous 4 0"},
    {"limit_damping", false, "pair_style gran/hooke 1e4 0 80 0 0 0 limit_damping\npair_coeff * *",
     "pair_style gran/eepa linear limit_damping yes\n"
     "pair_coeff * * 1e4 1e4 0 0 0 viscous 40 0"},
};
INSTANTIATE_TEST_SUITE_P(Dampings, GranHooke, testing::ValuesIn(comparisons), [](const auto &info) {
  return std::string(info.param.name);
});

}    // namespace
