// SPDX-License-Identifier: GPL-2.0-only
// `linear`: the law as published (contract, section 1). With delta_p^n = (1 - k1/k2) delta_max^n
//   f_hys = f0 + k1 delta^n              if k2 (delta^n - delta_p^n) >= k1 delta^n      loading
//           f0 - k_adh delta^n           if k2 (delta^n - delta_p^n) <= -k_adh delta^n  adhesive
//           f0 + k2 (delta^n - delta_p^n)  otherwise                                  unloading

#include "support.h"

namespace normal_linear_test {
using namespace eepa_test;

const double k1 = 1024.0, k2 = 2048.0, k_adh = 2048.0, f0 = -0.25;
const double top = 0.0078125, plastic = top / 2.0;    // delta_p = (1 - k1/k2) top

Material published(double pull_off = f0, double k2_ = k2, double k_adh_ = k_adh, double n = 1.0)
{
  return material(Law::linear, k1, k2_, k_adh_, pull_off, n);
}

const double exponents[] = {1.0, 1.1, 1.5, 2.0};

TEST(NormalLinear, LoadsAlongK1)
{
  NormalPath path(published());
  for (double overlap : {0.0009765625, 0.00390625, top}) {
    const NormalForce f = path.to(overlap);
    EXPECT_EQ(f.branch, Branch::loading);
    EXPECT_EQ(f.force, f0 + k1 * overlap);
    EXPECT_EQ(f.max_overlap, overlap);
  }
  EXPECT_EQ(path.plastic_overlap(), plastic);
}

TEST(NormalLinear, UnloadsAndReloadsAlongK2)
{
  NormalPath path(published());
  path.to(top);
  for (double overlap : {0.75 * top, 0.5 * top, 0.375 * top, 0.625 * top}) {
    const NormalForce f = path.to(overlap);
    EXPECT_EQ(f.branch, Branch::unloading);
    EXPECT_EQ(f.force, f0 + k2 * (overlap - plastic));
    EXPECT_EQ(f.max_overlap, top);
  }
  EXPECT_EQ(path.to(top).branch, Branch::loading);
  EXPECT_EQ(path.to(1.25 * top).force, f0 + k1 * 1.25 * top);
}

// at the boundary delta = delta_p k2/(k2 + k_adh) both branches give the same force
TEST(NormalLinear, AdhesiveBranchBeginsAtItsBoundary)
{
  NormalPath path(published());
  path.to(top);
  const double edge = plastic * k2 / (k2 + k_adh);    // top/4
  EXPECT_EQ(path.at(edge).branch, Branch::adhesive);
  EXPECT_EQ(path.at(edge).force, f0 - k_adh * edge);
  EXPECT_EQ(path.at(edge).max_overlap, top);    // nothing lowered yet
  // rounding alone does not leave the branch, 1e-12 does
  EXPECT_EQ(path.at(std::nextafter(edge, 1.0)).branch, Branch::adhesive);
  EXPECT_EQ(path.at(edge * (1.0 + 1e-12)).branch, Branch::unloading);
  // the two lines part with (k2 + k_adh) of the overlap
  const double apart = 1e-12 * (k2 + k_adh) * edge;
  EXPECT_NEAR(path.at(edge * (1.0 + 1e-12)).force, path.at(edge).force, 1.01 * apart);
}

// at any constant overlap of the adhesive branch a contact stays on that branch
TEST(NormalLinear, AdhesiveBranchHoldsAtRest)
{
  Random random(57);
  for (int k = 0; k < 5000; k++) {
    const Material m = any_material(random);
    if (m.law.law != Law::linear) continue;
    NormalPath path(m);
    path.to(top);
    const double down = random.uniform(0.01, 0.9) * top;
    if (path.to(down).branch != Branch::adhesive) continue;
    for (int step = 0; step < 3; step++) ASSERT_EQ(path.to(down).branch, Branch::adhesive);
  }
}

// delta_p = (1 + k_adh/k2) delta on the adhesive branch; reloading leaves it along k2
TEST(NormalLinear, AdhesiveBranchLowersThePlasticOverlapAndReloadsAlongK2)
{
  NormalPath path(published());
  path.to(top);
  const double down = 0.125 * top;
  const NormalForce low = path.to(down);
  EXPECT_EQ(low.branch, Branch::adhesive);
  EXPECT_EQ(low.force, f0 - k_adh * down);
  EXPECT_DOUBLE_EQ(path.plastic_overlap(), (1.0 + k_adh / k2) * down);
  // k2 line through the present point, up to the loading line at its lowered delta_max
  const double meets = path.max_overlap;
  EXPECT_DOUBLE_EQ(meets, (1.0 + k_adh / k2) / (1.0 - k1 / k2) * down);
  const double mid = 0.5 * (down + meets);
  const NormalForce up = path.to(mid);
  EXPECT_EQ(up.branch, Branch::unloading);
  EXPECT_DOUBLE_EQ(up.force - low.force, k2 * (mid - down));
  // it is left unchanged on the way up
  EXPECT_EQ(up.max_overlap, meets);
  EXPECT_NEAR(path.at(std::nextafter(meets, 0.0)).force, f0 + k1 * meets, 1e-12);
  EXPECT_EQ(path.to(meets).branch, Branch::loading);
  EXPECT_LT(meets, top);
}

TEST(NormalLinear, RepeatedReloadsFromEverDeeperPoints)
{
  NormalPath path(published());
  path.to(top);
  for (double x : {0.24, 0.2, 0.1, 0.01}) {
    const NormalForce down = path.to(x * top);
    ASSERT_EQ(down.branch, Branch::adhesive);
    ASSERT_DOUBLE_EQ(down.force, f0 - k_adh * x * top);
    const NormalForce up = path.to(1.01 * x * top);
    ASSERT_EQ(up.branch, Branch::unloading);
    ASSERT_NEAR(up.force - down.force, k2 * 0.01 * x * top, 1e-12);
  }
}

TEST(NormalLinear, EqualStiffnessesAreElastic)
{
  for (double n : exponents) {
    NormalPath path(published(f0, k1, k_adh, n));
    path.to(top);
    for (double x : {0.9, 0.5, 0.01, 0.7}) {
      const NormalForce f = path.to(x * top);
      EXPECT_EQ(f.branch, Branch::loading) << "n " << n;
      EXPECT_NEAR(f.force, f0 + k1 * std::pow(x * top, n), 1e-12);
    }
    EXPECT_EQ(path.plastic_overlap(), 0.0);
    EXPECT_EQ(path.opening_loss(), 0.0);
  }
}

TEST(NormalLinear, WithoutAdhesionTheSpringIsForceFreeBelowThePlasticOverlap)
{
  NormalPath path(published(0.0, k2, 0.0));
  path.to(top);
  const NormalForce f = path.to(0.5 * plastic);
  EXPECT_EQ(f.branch, Branch::adhesive);
  EXPECT_EQ(f.force, 0.0);
  EXPECT_DOUBLE_EQ(path.plastic_overlap(), 0.5 * plastic);
  EXPECT_NEAR(path.to(0.55 * plastic).force, k2 * 0.05 * plastic, 1e-14);
}

// every equation for a general exponent, on a path with all branches
TEST(NormalLinear, GeneralExponentOnEveryBranch)
{
  for (double n : {1.1, 1.5, 2.0}) {
    SCOPED_TRACE(n);
    NormalPath path(published(f0, 3.0 * k1, k_adh, n));
    const double stiff = 3.0 * k1;
    auto power = [n](double x) {
      return std::pow(x, n);
    };
    NormalForce f = path.to(top);
    EXPECT_DOUBLE_EQ(f.force, f0 + k1 * power(top));
    const double p = power(top) * (1.0 - k1 / stiff);
    EXPECT_NEAR(power(path.plastic_overlap()), p, 1e-14);
    f = path.to(0.9 * top);
    EXPECT_EQ(f.branch, Branch::unloading);
    EXPECT_NEAR(f.force, f0 + stiff * (power(0.9 * top) - p), 1e-12);
    // the adhesive branch begins at delta^n = delta_p^n k2/(k2 + k_adh)
    const double edge = std::pow(p * stiff / (stiff + k_adh), 1.0 / n);
    EXPECT_EQ(path.at(edge * (1.0 + 1e-12)).branch, Branch::unloading);
    EXPECT_EQ(path.at(edge * (1.0 - 1e-12)).branch, Branch::adhesive);
    f = path.to(0.5 * edge);
    EXPECT_EQ(f.branch, Branch::adhesive);
    EXPECT_NEAR(f.force, f0 - k_adh * power(0.5 * edge), 1e-12);
    EXPECT_NEAR(power(path.plastic_overlap()) / ((1.0 + k_adh / stiff) * power(0.5 * edge)), 1.0,
                1e-13);
    const double before = f.force;
    f = path.to(0.6 * edge);
    EXPECT_EQ(f.branch, Branch::unloading);
    EXPECT_NEAR(f.force - before, stiff * (power(0.6 * edge) - power(0.5 * edge)), 1e-12);
  }
}

// |f_t| <= mu (f_hys + k_adh delta^n - f0), f0 inside of mu
TEST(NormalLinear, FrictionBoundOnEachBranch)
{
  for (double n : exponents) {
    NormalPath path(published(f0, k2, k_adh, n));
    const double mu = 0.5;
    for (double x : {1.0, 0.9, 0.8}) {
      const NormalForce f = path.to(x * top);
      EXPECT_NEAR(path.bound(f), mu * (f.force + k_adh * std::pow(x * top, n) - f0), 1e-12);
    }
    EXPECT_NEAR(path.bound(path.to(0.1 * top)), 0.0, 1e-12);    // on the adhesive branch
  }
}

// continuous everywhere in delta > 0: halving the step halves the largest jump
TEST(NormalLinear, ContinuousEverywhere)
{
  for (double n : exponents) {
    NormalPath path(published(f0, 3.0 * k1, 5.0 * k1, n));
    const int steps = 20000;
    const double steepest = n * 5.0 * k1 * std::pow(1.3 * top, n - 1.0);
    double last = path.to(1e-12).force;
    double x = 1e-12;
    for (double target : {1.0, 0.6, 0.8, 0.1, 0.2, 0.05, 1.3, 1e-6}) {
      const double from = x;
      for (int k = 1; k <= steps; k++) {
        const double next = from + (target * top - from) * k / steps;
        const double force = path.to(next).force;
        ASSERT_LE(std::fabs(force - last), 1.0001 * steepest * std::fabs(next - x) + 1e-15);
        last = force;
        x = next;
      }
    }
  }
}

TEST(NormalLinear, TheLargestOverlapLoadsWhateverRounding)
{
  Random random(12);
  for (int k = 0; k < 20000; k++) {
    const double stiffness = random.decades(-3.0, 9.0);
    const double n = random.chance(0.5) ? 1.0 : random.uniform(1.0, 2.0);
    NormalPath path(material(Law::linear, stiffness, stiffness * random.decades(0.0, 2.0),
                             stiffness, -stiffness * 1e-7, n));
    const double overlap = random.decades(-9.0, -2.0);
    ASSERT_EQ(path.to(overlap).branch, Branch::loading);
    ASSERT_EQ(path.to(overlap).branch, Branch::loading);
    ASSERT_EQ(path.to(overlap).max_overlap, overlap);
  }
}
}    // namespace normal_linear_test
