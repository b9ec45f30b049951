// SPDX-License-Identifier: GPL-2.0-only
// Restitution of `luding` over four decades of speed against the closed forms of LUDING.md (Singh,
// Magnanimo, Luding, arXiv 1503.03720).

#include "support.h"

#include <cstdio>

namespace impact_luding_test {
using namespace eepa_test;

const double mass = 1e-6, radius = 1e-3;

struct ClosedForm {
  double k1, k2, k_adh, f0, limit;

  explicit ClosedForm(const Material &m) :
      k1(m.p.k1), k2(m.p.k2), k_adh(m.p.k_adh), f0(m.p.f0),
      limit(k2 / (k2 - k1) * m.p.depth * 2.0 * radius)
  {
  }
  /// the speed that reaches delta* where f0 = 0
  double plastic_speed() const { return std::sqrt(k1 / mass) * limit; }

  /// work of the loading branch, without f0
  double loading_work(double d) const
  {
    const double elastic = std::max(d - limit, 0.0), plastic = std::min(d, limit);
    return 0.5 * k1 * plastic * plastic + k1 * limit * elastic + 0.5 * k2 * elastic * elastic;
  }
  double largest_overlap(double speed) const
  {
    const double energy = 0.5 * mass * speed * speed;
    double lo = 0.0, hi = radius;
    for (int k = 0; k < 200; k++) {
      const double d = 0.5 * (lo + hi);
      // the sum falls before it rises; it is negative up to the root
      (loading_work(d) + f0 * d < energy ? lo : hi) = d;
    }
    return lo;
  }
  /// e^2 by the energy that is lost, (10); negative: the partners stick
  double restitution_squared(double speed) const
  {
    const double m = std::min(largest_overlap(speed), limit), h = (k2 - k1) / limit,
                 kappa = k1 + h * m;
    const double loading = 0.5 * k1 * h * m * m * m / kappa;
    const double adhesive = 0.5 * k_adh * h * h * m * m * m * m / (kappa * (kappa + k_adh));
    return 1.0 - (loading + adhesive) / (0.5 * mass * speed * speed);
  }
  /// the same for f0 = 0 as published, (6) and (7)
  double published(double speed) const
  {
    const double ratio = speed / plastic_speed(), kappa = k1 + (k2 - k1) * std::min(ratio, 1.0);
    const double squared =
        k1 / kappa - k_adh * (kappa - k1) * (kappa - k1) / (k1 * kappa * (kappa + k_adh));
    return ratio <= 1.0 ? squared : 1.0 - (1.0 - squared) / (ratio * ratio);
  }
};

struct Rebound {
  bool sticks = false;
  double speed = 0.0, largest = 0.0;
};

/// Velocity Verlet; a step is `steps`-th part of the time over which the contact closes.
Rebound impact(const Material &m, double speed, double largest, int steps)
{
  NormalPath path(m, 1.0, radius);
  const double dt = std::min(largest / speed, std::sqrt(mass / m.p.k1)) / steps;
  Rebound result;
  double x = 0.0, v = speed;    // v > 0 approaches
  double force = path.at(1e-300).force;
  for (long k = 0; k < 1000L * steps; k++) {
    const double before = v;
    v -= 0.5 * dt * force / mass;
    const double next = x + dt * v;
    if (next <= 0.0) {
      // the speed at delta = 0, interpolated with the force of the last step
      const double t = std::min(dt, x / -v);
      result.speed = -v + 0.5 * t * force / mass;
      return result;
    }
    x = next;
    result.largest = std::max(result.largest, x);
    force = path.to(x).force;
    v -= 0.5 * dt * force / mass;
    // drawn back before it has left, it has no more energy than that
    if (before < 0.0 && v >= 0.0) {
      result.sticks = true;
      return result;
    }
  }
  ADD_FAILURE() << "neither parted nor drawn back";
  return result;
}

Material sphere(double k2, double k_adh, double f0)
{
  Material m = material(Law::luding, 1e3, k2, k_adh, f0);
  m.p.depth = 0.005;
  return m;
}

/// Sweeps speeds from 1e-3 to 10 of the plastic speed; 's' sticks, 'r' rebounds, each once a stretch.
std::string sweep(const Material &m, double accuracy)
{
  const ClosedForm exact(m);
  std::string regimes;
  for (int k = 0; k <= 60; k++) {
    const double speed = exact.plastic_speed() * std::pow(10.0, -3.0 + k / 15.0);
    const double expected = exact.restitution_squared(speed);
    SCOPED_TRACE(testing::Message()
                 << "k2 " << m.p.k2 << " k_adh " << m.p.k_adh << " f0 " << m.p.f0 << " v/v_p "
                 << speed / exact.plastic_speed() << " e^2 " << expected);
    if (m.p.f0 == 0.0) {
      EXPECT_NEAR(expected, exact.published(speed), 1e-12 * std::max(1.0, std::fabs(expected)));
    }
    const double largest = exact.largest_overlap(speed);
    const Rebound got = impact(m, speed, largest, 3000);
    EXPECT_NEAR(got.largest / largest, 1.0, 1e-5);
    EXPECT_EQ(got.sticks, expected <= 0.0);
    if (expected > 0.0) { EXPECT_NEAR(got.speed / speed, std::sqrt(expected), accuracy); }
    const char regime = got.sticks ? 's' : 'r';
    if (regimes.empty() || regimes.back() != regime) regimes += regime;
  }
  return regimes;
}

TEST(ImpactLuding, WithoutAdhesionTheyAlwaysPart)
{
  EXPECT_EQ(sweep(sphere(1.5e3, 0.0, 0.0), 1e-4), "r");
  EXPECT_EQ(sweep(sphere(5e3, 0.0, 0.0), 1e-4), "r");
  // least at the plastic speed, sqrt(k1/k2)
  const ClosedForm exact(sphere(5e3, 0.0, 0.0));
  EXPECT_NEAR(exact.published(exact.plastic_speed()), 0.2, 1e-12);
}

TEST(ImpactLuding, WithAdhesionTheyPartStickAndPart)
{
  EXPECT_EQ(sweep(sphere(5e3, 1e2, 0.0), 1e-4), "r");    // too weak to hold
  EXPECT_EQ(sweep(sphere(5e3, 1e3, 0.0), 1e-4), "rsr");
  EXPECT_EQ(sweep(sphere(5e3, 2e4, 0.0), 1e-4), "rsr");
}

TEST(ImpactLuding, WithAPullOffForceTheyStickWhenSlowToo)
{
  EXPECT_EQ(sweep(sphere(5e3, 0.0, -5e-4), 2e-4), "sr");
  EXPECT_EQ(sweep(sphere(5e3, 1e3, -5e-4), 2e-4), "srsr");
}

// (8) and (9): where the fast ones begin and cease to stick, to a millionth of the speed
TEST(ImpactLuding, SpeedsBetweenWhichTheyStick)
{
  for (double k_adh : {5e2, 1e3, 2e4}) {
    const Material m = sphere(5e3, k_adh, 0.0);
    const ClosedForm exact(m);
    const double plastic = exact.plastic_speed();
    const double first = plastic * exact.k1 * (exact.k1 + k_adh) / (k_adh * (exact.k2 - exact.k1));
    ASSERT_LT(first, plastic);
    const double last = plastic * std::sqrt(1.0 - exact.published(plastic));
    EXPECT_GT(exact.restitution_squared(first * (1.0 - 1e-6)), 0.0);
    EXPECT_LT(exact.restitution_squared(first * (1.0 + 1e-6)), 0.0);
    EXPECT_LT(exact.restitution_squared(last * (1.0 - 1e-6)), 0.0);
    EXPECT_GT(exact.restitution_squared(last * (1.0 + 1e-6)), 0.0);
    for (double speed : {0.99 * first, 1.01 * first, 0.999 * last, 1.001 * last})
      EXPECT_EQ(impact(m, speed, exact.largest_overlap(speed), 20000).sticks,
                exact.restitution_squared(speed) < 0.0)
          << "k_adh " << k_adh << " v/v_p " << speed / plastic;
  }
}
}    // namespace impact_luding_test
