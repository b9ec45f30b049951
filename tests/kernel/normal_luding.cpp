// SPDX-License-Identifier: GPL-2.0-only
// `luding`: unloading stiffens from k1 to k2 while the remembered overlap m grows to delta*, where the
// limit branch begins. Formulas: LUDING.md.

#include "support.h"

namespace normal_luding_test {
using namespace eepa_test;

// delta* = k2/(k2 - k1) depth 2 R* = 2 top for R* = radius
const double k1 = 1024.0, k2 = 2048.0, k_adh = 2048.0, f0 = -0.25;
const double top = 0.0078125, depth = 0.0625, radius = 0.0625, limit = 2.0 * top;

Material published(double pull_off = f0, double k2_ = k2, double k_adh_ = k_adh)
{
  Material m = material(Law::luding, k1, k2_, k_adh_, pull_off);
  m.p.depth = depth;
  return m;
}

NormalPath path_of(const Material &m)
{
  return NormalPath(m, 1.0, radius);
}

double limit_of(double k2_)
{
  return k2_ / (k2_ - k1) * depth * 2.0 * radius;
}

/// kappa of a contact that remembers m
double stiffness(double m, double k2_ = k2)
{
  return k1 + (k2_ - k1) * std::min(m / limit_of(k2_), 1.0);
}

/// where the unloading line of m meets -k_adh delta
double onset(double m, double k2_ = k2, double k_adh_ = k_adh)
{
  const double kappa = stiffness(m, k2_);
  return (kappa - k1) * m / (kappa + k_adh_);
}

TEST(NormalLuding, LoadsAlongK1UpToTheLimit)
{
  ASSERT_EQ(limit_of(k2), limit);
  NormalPath path = path_of(published());
  for (double overlap : {0.125 * top, top, 1.5 * top, limit}) {
    const NormalForce f = path.to(overlap);
    EXPECT_EQ(f.branch, Branch::loading);
    EXPECT_EQ(f.force, f0 + k1 * overlap);
    EXPECT_EQ(f.max_overlap, overlap);
  }
}

// the unloading stiffness grows in proportion to the overlap; reloading follows the unloading line back
TEST(NormalLuding, UnloadingStiffensInProportionToTheRememberedOverlap)
{
  for (double k2_ : {1.25 * k1, 2.0 * k1, 20.0 * k1}) {
    const double end = limit_of(k2_);
    for (double part : {0.01, 0.25, 0.5, 0.99, 1.0}) {
      const double m = part * end, kappa = k1 + part * (k2_ - k1);
      SCOPED_TRACE(testing::Message() << "k2/k1 " << k2_ / k1 << " m/delta* " << part);
      NormalPath path = path_of(published(f0, k2_, 0.0));
      path.to(m);
      EXPECT_NEAR(path.plastic_overlap(), (1.0 - k1 / kappa) * m, 1e-14 * m);
      const double plastic = path.plastic_overlap();
      for (double x : {0.9, 0.5, 0.1, 0.7}) {
        const double overlap = plastic + x * (m - plastic);
        const NormalForce f = path.to(overlap);
        EXPECT_EQ(f.branch, Branch::unloading);
        EXPECT_NEAR(f.force, f0 + kappa * (overlap - plastic), 1e-13 * k2_ * m);
        EXPECT_EQ(f.max_overlap, m);
      }
      EXPECT_EQ(path.to(m).branch, Branch::loading);
      EXPECT_EQ(path.at(0.999 * m).branch, Branch::unloading);
    }
  }
}

TEST(NormalLuding, IsElasticBeyondTheLimit)
{
  NormalPath path = path_of(published());
  path.to(limit);
  for (double x : {1.5, 3.0, 1.25, 2.0, 1.0009765625}) {
    const double before = path.max_overlap;
    const NormalForce f = path.to(x * limit);
    EXPECT_EQ(f.branch, Branch::loading);
    EXPECT_NEAR(f.force, f0 + k1 * limit + k2 * (x - 1.0) * limit, 1e-12);
    EXPECT_EQ(f.max_overlap, limit);
    EXPECT_EQ(path.loss(before, f.max_overlap), 0.0);
  }
  // and below it the same k2 line continues
  const NormalForce f = path.to(0.75 * limit);
  EXPECT_EQ(f.branch, Branch::unloading);
  EXPECT_NEAR(f.force, f0 + k1 * limit - k2 * 0.25 * limit, 1e-12);
}

// from the limit on it is `linear` with k2 that has been pressed to delta*: on the unloading line, at
// the begin of the adhesive branch and in all it stores and has lost
TEST(NormalLuding, FromTheLimitOnIsTheLinearLaw)
{
  Material as_linear = published();
  as_linear.law.law = Law::linear;
  NormalPath path = path_of(published()), linear = path_of(as_linear);
  path.to(limit);
  linear.to(limit);
  EXPECT_DOUBLE_EQ(path.plastic_overlap(), linear.plastic_overlap());
  EXPECT_DOUBLE_EQ(path.loss(0.0, limit), linear.loss(0.0, limit));
  for (double x : {0.9, 0.5, 0.3, 0.2501}) {
    const NormalForce f = path.to(x * limit), g = linear.to(x * limit);
    EXPECT_EQ(f.branch, Branch::unloading);
    EXPECT_EQ(g.branch, Branch::unloading);
    EXPECT_NEAR(f.force, g.force, 1e-12);
    EXPECT_NEAR(path.bound(f), path.bound(g), 1e-12);
    EXPECT_NEAR(path.energy(x * limit), linear.energy(x * limit), 1e-14);
  }
  EXPECT_EQ(path.to(0.2499 * limit).branch, Branch::adhesive);
  EXPECT_EQ(linear.to(0.2499 * limit).branch, Branch::adhesive);
}

TEST(NormalLuding, AVanishingDepthLeavesAnElasticContactOfK2AndAGreatOneOfK1)
{
  for (double x : {0.5, 1.0, 2.0}) {
    Material m = published(0.0);
    m.p.depth = 1e-12;
    NormalPath hard = path_of(m);
    hard.to(4.0 * top);
    EXPECT_NEAR(hard.at(x * top).force, k2 * x * top, 1e-9);
    m.p.depth = 1e12;    // validate() would not let it
    NormalPath soft = path_of(m);
    soft.to(4.0 * top);
    EXPECT_NEAR(soft.at(x * top).force, k1 * x * top, 1e-9);
  }
}

TEST(NormalLuding, AdhesiveBranchBeginsAtItsBoundary)
{
  NormalPath path = path_of(published());
  path.to(top);
  const double edge = onset(top);    // (1536 - 1024)/(1536 + 2048) top
  EXPECT_DOUBLE_EQ(edge, top / 7.0);
  EXPECT_EQ(path.at(edge * (1.0 - 1e-12)).branch, Branch::adhesive);
  EXPECT_EQ(path.at(edge * (1.0 + 1e-12)).branch, Branch::unloading);
  // both lines have the same force there, and nothing is lowered yet
  EXPECT_NEAR(path.at(edge).force, f0 - k_adh * edge, 1e-13);
  EXPECT_NEAR(path.at(edge).max_overlap, top, 1e-12 * top);
}

// the adhesive branch lowers m so that the unloading line of m passes through the present point
TEST(NormalLuding, AdhesiveBranchLowersTheMemoryAndReloadsWithItsStiffness)
{
  for (double k2_ : {1.1 * k1, 2.0 * k1, 30.0 * k1})
    for (double k_adh_ : {0.0, 0.1 * k1, 2.0 * k1, 50.0 * k1}) {
      SCOPED_TRACE(testing::Message() << "k2/k1 " << k2_ / k1 << " k_adh/k1 " << k_adh_ / k1);
      NormalPath path = path_of(published(f0, k2_, k_adh_));
      const double m = 0.7 * limit_of(k2_), edge = onset(m, k2_, k_adh_);
      path.to(m);
      double last = m;
      for (double x : {0.9, 0.5, 0.1, 0.001}) {
        const double down = x * edge;
        const NormalForce low = path.to(down);
        EXPECT_EQ(low.branch, Branch::adhesive);
        EXPECT_EQ(low.force, f0 - k_adh_ * down);
        EXPECT_LT(low.max_overlap, last);
        EXPECT_GT(low.max_overlap, down);
        EXPECT_NEAR(onset(low.max_overlap, k2_, k_adh_), down, 1e-13 * down);
        // a little up its k2 line, and down again to the same overlap
        const double up = down + 0.01 * (low.max_overlap - down);
        const NormalForce high = path.to(up);
        EXPECT_EQ(high.branch, Branch::unloading);
        EXPECT_NEAR(high.force - low.force, stiffness(low.max_overlap, k2_) * (up - down),
                    1e-12 * (k2_ + k_adh_) * up);
        EXPECT_EQ(high.max_overlap, low.max_overlap);
        last = low.max_overlap;
      }
      // further up it meets the loading branch at m
      EXPECT_NEAR(path.at(std::nextafter(last, 0.0)).force, f0 + k1 * last, 1e-12);
      EXPECT_EQ(path.to(last).branch, Branch::loading);
    }
}

TEST(NormalLuding, AdhesiveBranchHoldsAtRest)
{
  Random random(58);
  int held = 0;
  for (int k = 0; k < 5000; k++) {
    const double k2_ = k1 * (1.0 + random.decades(-3.0, 3.0));
    NormalPath path = path_of(published(f0, k2_, k1 * random.decades(-3.0, 3.0)));
    path.to(random.uniform(0.01, 1.5) * limit_of(k2_));
    const double down = random.decades(-4.0, 0.0) * path.max_overlap;
    if (path.to(down).branch != Branch::adhesive) continue;
    const double remembered = path.max_overlap;
    for (int step = 0; step < 3; step++) {
      ASSERT_EQ(path.to(down).branch, Branch::adhesive);
      ASSERT_EQ(path.max_overlap, remembered);
    }
    held++;
  }
  EXPECT_GT(held, 1000);
}

// nor does rounding move a contact of any size off the boundary
TEST(NormalLuding, AdhesiveBranchHoldsAtRestInContactsOfAnySize)
{
  Random random(59);
  for (const double s : {0.0625, 1024.0}) {
    Material m = published();
    scale_with_diameter(m, 1.0);
    int held = 0;
    for (int k = 0; k < 500; k++) {
      NormalPath path(m, s, s * radius);
      path.to(s * random.uniform(0.1, 1.5) * limit);
      const double down = random.decades(-2.0, -0.5) * path.max_overlap;
      if (path.to(down).branch != Branch::adhesive) continue;
      for (int step = 0; step < 3; step++) ASSERT_EQ(path.to(down).branch, Branch::adhesive);
      held++;
    }
    EXPECT_GT(held, 100);
  }
}

TEST(NormalLuding, ContinuousEverywhere)
{
  for (double k2_ : {1.2 * k1, 3.0 * k1})
    for (double k_adh_ : {0.0, 5.0 * k1}) {
      NormalPath path = path_of(published(f0, k2_, k_adh_));
      const int steps = 20000;
      const double end = limit_of(k2_), steepest = std::max(k2_, k_adh_);
      double last = path.to(1e-12).force, x = 1e-12;
      for (double target : {0.6, 0.3, 0.5, 0.05, 0.1, 0.02, 0.8, 1.6, 0.4, 0.1, 1.2, 1e-6}) {
        const double from = x;
        for (int k = 1; k <= steps; k++) {
          const double next = from + (target * end - from) * k / steps;
          const double force = path.to(next).force;
          ASSERT_LE(std::fabs(force - last), 1.0001 * steepest * std::fabs(next - x) + 1e-15)
              << "at " << next / end << " of the limit";
          last = force;
          x = next;
        }
      }
    }
}

// |f_t| <= mu (f_hys + k_adh delta - f0) on every branch
TEST(NormalLuding, FrictionBoundOnEachBranch)
{
  NormalPath path = path_of(published());
  for (double x : {1.0, 2.5, 1.9, 1.5, 0.1}) {
    const NormalForce f = path.to(x * top);
    EXPECT_NEAR(path.bound(f), 0.5 * (f.force + k_adh * x * top - f0), 1e-12);
  }
  EXPECT_EQ(path.to(0.01 * top).branch, Branch::adhesive);
  EXPECT_NEAR(path.bound(path.at(0.01 * top)), 0.0, 1e-12);
}

// a wall's R* is the particle's radius: twice the limit of two equal spheres
TEST(NormalLuding, LimitOfPairsAndWalls)
{
  Material m = published();
  m.p.depth = 0.001;
  Bodies b;
  b.overlap = 0.3 * b.R_i;
  History history;
  evaluate(m, b, 0.0, history);
  EXPECT_DOUBLE_EQ(history.max_overlap, 2.0 * 0.001 * 2.0 * b.R_i * b.R_j / (b.R_i + b.R_j));
  b.R_j = b.m_j = infinity;
  history = History();
  evaluate(m, b, 0.0, history);
  EXPECT_DOUBLE_EQ(history.max_overlap, 2.0 * 0.001 * 2.0 * b.R_i);
}

// a history of another law, or of particles that have shrunk, may lie beyond the limit
TEST(NormalLuding, AMemoryBeyondTheLimitIsTheLimit)
{
  NormalPath path = path_of(published()), beyond = path_of(published());
  path.max_overlap = limit;
  beyond.max_overlap = 3.0 * limit;
  for (double x : {2.0, 1.0, 0.6, 0.1}) {
    const NormalForce f = path.at(x * limit), g = beyond.at(x * limit);
    EXPECT_EQ(f.force, g.force);
    EXPECT_EQ(f.branch, g.branch);
    EXPECT_EQ(f.max_overlap, g.max_overlap);
    EXPECT_EQ(path.energy(x * limit), beyond.energy(x * limit));
  }
  EXPECT_EQ(path.plastic_overlap(), beyond.plastic_overlap());
  EXPECT_EQ(path.opening_loss(), beyond.opening_loss());
  EXPECT_EQ(beyond.loss(3.0 * limit, limit), 0.0);
}

// k1 h m^3/(2 kappa) for loading, k_adh h^2 m^4/(2 kappa (kappa + k_adh)) for the adhesive branch
TEST(NormalLuding, LossesInClosedForm)
{
  for (double k2_ : {1.3 * k1, 8.0 * k1})
    for (double k_adh_ : {0.0, 0.5 * k1, 20.0 * k1}) {
      NormalPath path = path_of(published(f0, k2_, k_adh_));
      const double h = (k2_ - k1) / limit_of(k2_);
      for (double part : {0.1, 0.5, 1.0}) {
        const double m = part * limit_of(k2_), kappa = stiffness(m, k2_);
        path.max_overlap = m;
        const double loading = 0.5 * k1 * h * m * m * m / kappa;
        EXPECT_NEAR(path.loss(0.0, m), loading, 1e-14 * loading);
        EXPECT_NEAR(path.loss(0.5 * m, m), loading - path.loss(0.0, 0.5 * m), 1e-14 * loading);
        const double adhesive = 0.5 * k_adh_ * h * h * m * m * m * m / (kappa * (kappa + k_adh_));
        EXPECT_NEAR(path.opening_loss(), adhesive, 1e-14 * adhesive);
        NormalPath lower = path;
        lower.max_overlap = 0.3 * m;
        EXPECT_NEAR(path.loss(m, 0.3 * m), adhesive - lower.opening_loss(), 1e-14 * adhesive);
      }
    }
}
}    // namespace normal_luding_test
