// SPDX-License-Identifier: GPL-2.0-only

// Particles that grow, and particles that are still to be inserted: neighbour lists reach far
// enough for them, and the bound on the time step includes them.

#include "packing.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

constexpr double k1 = 1e4, distance = 1.8;

/// A periodic box [-6, 6]^3 of particles whose radii may change.
void open_growing_box(Simulation &simulation, const std::string &newton)
{
  simulation("units lj\nnewton " + newton +
             "\natom_style sphere 1\natom_modify map array\ncomm_modify vel yes\n"
             "region box block -6 6 -6 6 -6 6\ncreate_box 1 box\nthermo 1000000");
}

struct Skin {
  const char *name, *newton, *lines;
};

class ParallelGrowth : public testing::TestWithParam<Skin> {
 protected:
  /// Two pairs at rest, one across the periodic boundaries, whose particles grow from 1 to 2.
  static void open(Simulation &simulation, const std::string &keywords)
  {
    open_growing_box(simulation, GetParam().newton);
    simulation.create({{Vec3(-0.5 * distance, 0, 0)},
                       {Vec3(0.5 * distance, 0, 0)},
                       {Vec3(3, 3, 6.0 - 0.5 * distance)},
                       {Vec3(3, 3, -6.0 + 0.5 * distance)}});
    simulation(std::string("neigh_modify every 1 delay 0 check yes\n") + GetParam().lines +
               "\npair_style gran/eepa linear dtcheck off " + keywords +
               "\npair_coeff * * 1e4 2e4 0 0 0.5\ntimestep 1e-4\nvariable d equal ramp(1,2)\n"
               "fix grow all adapt 1 atom diameter v_d mass no");
  }
};

// The particles do not move, so that LAMMPS by itself would never make a new list.
TEST_P(ParallelGrowth, FindsContactsWhereverTheyForm)
{
  Simulation simulation;
  open(simulation, "largest 2");
  simulation("run 250 post no");
  for (const auto &p : simulation.particles()) {
    EXPECT_NEAR(p.radius, 1.0, 1e-12);
    EXPECT_NEAR(p.f.norm(), k1 * (2.0 - distance), 1e-8) << p.id;
  }
}

TEST_P(ParallelGrowth, BeyondTheListsIsNamed)
{
  if (std::string(GetParam().newton) == "off") return;    // one rank stops, which ends the test
  Simulation simulation(MPI_COMM_SELF);
  open(simulation, "largest 1.5");
  EXPECT_TRUE(refuses(simulation, "run 250 post no",
                      "atom [1-4] of type 1 has grown to a diameter of 1\\.[5-9].* at step "
                      "1[0-9]*.*made for at most 1.5: contacts would be missed; add `largest "
                      "d` to pair_style"));
}

const Skin skins[] = {{"thin", "on", "neighbor 0.05 bin"},
                      {"thick", "on", "neighbor 0.5 bin"},
                      {"every", "on", "neighbor 0.1 bin\nneigh_modify check no"},
                      {"newton_off", "off", "neighbor 0.1 bin"}};
INSTANTIATE_TEST_SUITE_P(Skins, ParallelGrowth, testing::ValuesIn(skins), [](const auto &skin) {
  return skin.param.name;
});

// A particle that grows while it moves: at 0.16 the pair, not in the first list, overlaps by 0.008,
// and has moved by 0.048, less than half the skin.
TEST(Growth, CountsTogetherWithMotion)
{
  Simulation simulation;
  open_growing_box(simulation, "on");
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(1.2, 0, 0), Vec3(-0.3, 0, 0)}});
  simulation("neighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
             "pair_style gran/eepa linear dtcheck off largest 1.2\npair_coeff * * 1e-9 2e-9 0 0 0\n"
             "fix move all nve/sphere\ntimestep 1e-3\nvariable d equal ramp(1,1.16)\n"
             "fix grow all adapt 1 atom diameter v_d mass no");
  simulation.watch_contacts();
  simulation("run 160 post no");
  ASSERT_EQ(simulation.contacts().size(), 1u);
  EXPECT_NEAR(simulation.contacts()[0].overlap(), 0.008, 1e-9);
}

TEST(Growth, ThatIsTooFastForTheSkinIsNamed)
{
  Simulation simulation(MPI_COMM_SELF);
  open_growing_box(simulation, "on");
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(1.8, 0, 0)}});
  simulation("neighbor 0.1 bin\npair_style gran/eepa linear dtcheck off largest 2\n"
             "pair_coeff * * 1e-9 2e-9 0 0 0\nfix move all nve/sphere\ntimestep 1e-3\n"
             "variable d equal 1.0+0.2*(step>50)\n"
             "fix grow all adapt 1 atom diameter v_d mass no");
  EXPECT_TRUE(refuses(simulation, "run 100 post no", "radii grew by up to 0.1 in [0-9]+ steps"));
}

/* ---------------------------------------------------------------------- time step */

constexpr const char *empty_box =
    "units si\natom_style sphere\ncomm_modify vel yes\nboundary p p f\n"
    "region box block 0 8 0 8 -5 20\ncreate_box 2 box\nneighbor 0.1 bin\n"
    "region slab block 0 8 0 8 10 19\n";
constexpr const char *law = "pair_style gran/eepa linear scale 1 dtcheck error\n"
                            "pair_coeff 1 1 1e4 2e4 0 0 0\npair_coeff 2 2 1e4 8e4 0 0 0\n";

TEST(ParallelTimeStep, OfParticlesThatAreStillToCome)
{
  Simulation simulation;
  simulation(std::string(empty_box) + law +
             "compute none all gran/eepa/dt\n"
             "compute one all gran/eepa/dt particles 1 0.5 1.5 2.0\n"
             "compute two all gran/eepa/dt particles 1 0.5 1.5 2.0 particles 2 0.8 0.8 1.0");
  simulation("fix move all nve/sphere");
  simulation.run(0);
  EXPECT_TRUE(std::isinf(simulation.compute("none")));
  // the lightest particle beside the largest: k2 (0.25 + 0.75)
  const double mass = pi / 6.0 * 2.0 * 0.125;
  EXPECT_NEAR(simulation.compute("one"), 0.2 * std::sqrt(mass / 2e4), 1e-15);
  // a particle of type 2: with its own type 8e4 0.8; with type 1, mixed, 3.2e4 (0.4 + 0.75)
  const double other = pi / 6.0 * 0.512;
  const double least = std::min({0.2 * std::sqrt(mass / 2e4), 0.2 * std::sqrt(other / 6.4e4),
                                 0.2 * std::sqrt(mass / (3.2e4 * (0.25 + 0.4))),
                                 0.2 * std::sqrt(other / (3.2e4 * (0.4 + 0.75)))});
  EXPECT_NEAR(simulation.compute("two"), least, 1e-15);
  // and a stiff wall below the particles
  simulation("fix w all wall/gran/eepa linear scale 1 coeff 1e6 1e6 0 0 0 wall zplane 0 NULL");
  simulation.run(0);
  EXPECT_NEAR(simulation.compute("one"), 0.2 * std::sqrt(mass / (1e6 * 0.5)), 1e-15);
}

TEST(TimeStep, ThatIsTooLargeForWhatIsPouredStopsTheRunThen)
{
  const double mass = pi / 6.0 * 0.125, bound = 0.2 * std::sqrt(mass / 1e4);
  const std::string pour = "fix move all nve/sphere\nfix pour all pour 20 1 4767 region slab diam "
                           "one 0.5 dens 1 1 vol 0.3 20\nfix g all gravity 10 vector 0 0 -1\n";
  for (const double factor : {0.99, 1.01}) {
    Simulation simulation;
    simulation(std::string(empty_box) + law + pour + "timestep " + exact(factor * bound));
    if (factor < 1.0)
      EXPECT_EQ(error_of(simulation, "run 10 post no"), "");
    else
      EXPECT_TRUE(refuses(simulation, "run 10 post no",
                          "pair_style gran/eepa: timestep .* is larger than .* = 0.2 "
                          "sqrt\\(m_min/k_max\\), which atom [0-9]+ of type 1 and diameter 0.5 "
                          "sets, inserted by step 1"));
    EXPECT_EQ(simulation.particles().size(), 20u);
  }
}

struct Mistake {
  const char *arguments, *regex;
};
class AnnouncementMistake : public testing::TestWithParam<Mistake> {};
TEST_P(AnnouncementMistake, IsNamed)
{
  Simulation simulation;
  simulation.open_box(3.0, 2);
  EXPECT_TRUE(refuses(simulation, std::string("compute c all gran/eepa/dt ") + GetParam().arguments,
                      std::string("compute gran/eepa/dt: ") + GetParam().regex));
}
const Mistake mistakes[] = {
    {"sizes 1", "keyword 'sizes' is unknown: it must be particles"},
    {"particles 1 1 1", "missing value: particles type d_min d_max density"},
    {"particles 3 1 1 1", "particles type = 3 is not allowed: it must be from 1 to 2"},
    {"particles 1.5 1 1 1", "particles type = 1.5 is not allowed"},
    {"particles 1 0 1 1", "particles d_min = 0 is not allowed: it must be > 0"},
    {"particles 1 1 0.5 1", "particles d_max = 0.5 is not allowed: it must be >= d_min = 1"},
    {"particles 1 1 1 -2", "particles density = -2 is not allowed: it must be > 0"},
    {"particles 1 1 1 nan", "particles density = nan is not a finite number"},
};
INSTANTIATE_TEST_SUITE_P(Arguments, AnnouncementMistake, testing::ValuesIn(mistakes));

}    // namespace
