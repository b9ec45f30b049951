// SPDX-License-Identifier: GPL-2.0-only
// `plateau`: the article's law (contract, section 1). With delta_p = (k1/k2) delta_max
//   f_hys = f0 + k1 delta            if k2 (delta - delta_p) >= k1 delta       loading
//           -k_adh delta_p           if k2 (delta - delta_p) <= -k_adh delta_p adhesive
//           f0 + k2 (delta-delta_p)  otherwise                                unloading

#include "support.h"

namespace normal_plateau_test {
using namespace eepa_test;

// dyadic numbers: the arithmetic is exact and so are the boundaries
const double k1 = 1024.0, k2 = 2048.0, k_adh = 512.0, f0 = -0.25;
const double top = 0.0078125, plastic = top / 2.0;

Material article(double pull_off = f0, double k2_ = k2, double k_adh_ = k_adh)
{
  return material(Law::plateau, k1, k2_, k_adh_, pull_off);
}

TEST(NormalPlateau, LoadsAlongK1AndRemembersTheLargestOverlap)
{
  NormalPath path(article());
  for (double overlap : {0.0009765625, 0.00390625, top}) {
    const NormalForce f = path.to(overlap);
    EXPECT_EQ(f.branch, Branch::loading);
    EXPECT_EQ(f.force, f0 + k1 * overlap);
    EXPECT_EQ(f.max_overlap, overlap);
  }
  EXPECT_EQ(path.plastic_overlap(), plastic);
}

TEST(NormalPlateau, UnloadsAndReloadsAlongK2)
{
  NormalPath path(article());
  path.to(top);
  for (double overlap : {0.75 * top, 0.5 * top, 0.4375 * top, 0.625 * top, 0.9375 * top}) {
    const NormalForce f = path.to(overlap);
    EXPECT_EQ(f.branch, Branch::unloading);
    EXPECT_EQ(f.force, f0 + k2 * (overlap - plastic));
    EXPECT_EQ(f.max_overlap, top);
  }
  EXPECT_EQ(path.to(top).branch, Branch::loading);
  EXPECT_EQ(path.to(1.25 * top).force, f0 + k1 * 1.25 * top);
  EXPECT_EQ(path.max_overlap, 1.25 * top);
}

TEST(NormalPlateau, PullsConstantlyOnThePlateauWithoutF0)
{
  NormalPath path(article());
  path.to(top);
  for (double overlap : {0.375 * top, 0.25 * top, 1e-9 * top}) {
    const NormalForce f = path.to(overlap);
    EXPECT_EQ(f.branch, Branch::adhesive);
    EXPECT_EQ(f.force, -k_adh * plastic);
    EXPECT_EQ(f.max_overlap, top);    // the plateau forgets nothing
  }
  // reloading follows the same line as unloading
  EXPECT_EQ(path.to(0.75 * top).force, f0 + k2 * (0.75 * top - plastic));
}

// k2 (delta - delta_p) = -k_adh delta_p at delta = delta_p (1 - k_adh/k2) belongs to the plateau
TEST(NormalPlateau, BoundaryOfThePlateauBelongsToIt)
{
  NormalPath path(article());
  path.to(top);
  const double edge = plastic * (1.0 - k_adh / k2);
  EXPECT_EQ(path.at(edge).branch, Branch::adhesive);
  EXPECT_EQ(path.at(std::nextafter(edge, 1.0)).branch, Branch::unloading);
}

TEST(NormalPlateau, StepsByExactlyF0WhereThePlateauBegins)
{
  NormalPath path(article());
  path.to(top);
  const double edge = plastic * (1.0 - k_adh / k2);
  const double above = path.at(std::nextafter(edge, 1.0)).force, below = path.at(edge).force;
  EXPECT_NEAR(above - below, f0, 1e-12);
  NormalPath without(article(0.0));
  without.to(top);
  EXPECT_NEAR(without.at(std::nextafter(edge, 1.0)).force, without.at(edge).force, 1e-12);
}

// k2 = 2 k1: the branches meet at delta_max
TEST(NormalPlateau, UnloadingMeetsLoadingAtTheLargestOverlapForK2TwiceK1)
{
  NormalPath path(article());
  path.to(top);
  EXPECT_NEAR(path.at(std::nextafter(top, 0.0)).force, path.at(top).force, 1e-12);
  EXPECT_EQ(path.at(std::nextafter(top, 0.0)).branch, Branch::unloading);
}

// k2 > 2 k1: the loading branch holds down to delta = k1 delta_max/(k2 - k1)
TEST(NormalPlateau, UnloadingStartsLateForK2AboveTwiceK1)
{
  const double stiff = 5.0 * k1;
  NormalPath path(article(f0, stiff));
  path.to(top);
  const double parting = k1 * top / (stiff - k1);    // top/4
  const double p = k1 / stiff * top;
  for (double x : {0.99, 0.5, 0.2501}) EXPECT_EQ(path.at(x * top).branch, Branch::loading) << x;
  EXPECT_EQ(path.at(0.2499 * top).branch, Branch::unloading);
  EXPECT_DOUBLE_EQ(path.at(0.5 * top).force, f0 + k1 * 0.5 * top);
  EXPECT_EQ(path.to(0.5 * top).max_overlap, top);
  EXPECT_NEAR(path.at(0.24 * top).force, f0 + stiff * (0.24 * top - p), 1e-12);
  EXPECT_NEAR(path.at(std::nextafter(parting, 0.0)).force,
              path.at(std::nextafter(parting, 1.0)).force, 1e-12);
}

// k_adh >= k2: the plateau would begin at delta <= 0, so the k2 line reaches the opening
TEST(NormalPlateau, NoPlateauForAdhesionStifferThanUnloading)
{
  NormalPath path(article(f0, k2, 2.0 * k2));
  path.to(top);
  EXPECT_EQ(path.at(1e-6 * top).branch, Branch::unloading);
  EXPECT_NEAR(path.at(1e-6 * top).force, f0 - k2 * (plastic - 1e-6 * top), 1e-12);
}

TEST(NormalPlateau, WithoutAdhesionThePlateauIsForceFree)
{
  NormalPath path(article(f0, k2, 0.0));
  path.to(top);
  EXPECT_EQ(path.at(plastic).branch, Branch::adhesive);
  EXPECT_EQ(path.at(0.5 * plastic).force, 0.0);
}

// |f_t| <= mu (f_hys + k_adh delta_p) - f0, f0 outside of mu
TEST(NormalPlateau, FrictionBoundOnEachBranch)
{
  NormalPath path(article());
  const double mu = 0.5;
  NormalForce f = path.to(top);
  EXPECT_DOUBLE_EQ(path.bound(f), mu * (f.force + k_adh * plastic) - f0);
  f = path.to(0.75 * top);
  EXPECT_DOUBLE_EQ(path.bound(f), mu * (f.force + k_adh * plastic) - f0);
  f = path.to(0.25 * top);
  EXPECT_DOUBLE_EQ(path.bound(f), -f0);    // on the plateau the bracket vanishes
}

// delta = delta_max is `loading` in spite of rounding
TEST(NormalPlateau, TheLargestOverlapLoadsWhateverRounding)
{
  Random random(11);
  for (int k = 0; k < 20000; k++) {
    const double stiffness = random.decades(-3.0, 9.0);
    // k2 = 2 k1 to within a few units of the last place is where rounding could decide
    const double excess = random.chance(0.5) ? random.uniform(0.0, 1.0)
                                             : random.uniform(0.0, 1e-15);
    NormalPath path(material(Law::plateau, stiffness, 2.0 * stiffness * (1.0 + excess), stiffness,
                             -stiffness * 1e-7));
    const double overlap = random.decades(-9.0, -2.0);
    ASSERT_EQ(path.to(overlap).branch, Branch::loading);
    ASSERT_EQ(path.to(overlap).branch, Branch::loading);
    ASSERT_EQ(path.to(overlap).max_overlap, overlap);
  }
}
}    // namespace normal_plateau_test
