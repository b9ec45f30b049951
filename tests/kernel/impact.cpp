// SPDX-License-Identifier: GPL-2.0-only
// Head-on impacts without dashpot, integrated finely, against the closed forms of IMPACT.md.

#include "support.h"

namespace impact_test {
using namespace eepa_test;

// The formulas are written as in IMPACT.md. With E = m* v^2/2, D = delta_max of the impact:
//   E = k1 D^(n+1)/(n+1) + f0 D

double largest_overlap(const Material &m, double energy)
{
  const double n = m.law.exponent;
  double lo = 0.0, hi = 1.0;
  for (int k = 0; k < 200; k++) {
    const double d = 0.5 * (lo + hi);
    // the sum falls before it rises; it is negative up to the root
    (m.p.k1 * std::pow(d, n + 1.0) / (n + 1.0) + m.p.f0 * d < energy ? lo : hi) = d;
  }
  return lo;
}

/// e0^2, the restitution squared of the same law with f0 = 0 (it does not depend on speed)
double bare_restitution_squared(const Material &m)
{
  const double k1 = m.p.k1, k2 = m.p.k2, k_adh = m.p.k_adh, n = m.law.exponent;
  if (m.law.law == Law::plateau) {
    const double kappa = std::min(k_adh / k2, 1.0);
    return 1.0 - k1 * k1 / (k2 * (k2 - k1)) - k1 / k2 * kappa * (2.0 - kappa);
  }
  if (n == 1.0) return k1 / k2 - k_adh / k1 * (k2 - k1) * (k2 - k1) / (k2 * (k2 + k_adh));
  const double q = 1.0 - k1 / k2, alpha = std::pow(k2 * q / (k2 + k_adh), 1.0 / n);
  return k2 / k1 * (1.0 - (n + 1.0) * q + n * q * alpha);
}

/// e^2; negative: the particles stick
double restitution_squared(const Material &m, double energy)
{
  const double n = m.law.exponent, d = largest_overlap(m, energy);
  double stretch = d;    // over which f0 acts on the way out
  if (m.law.law == Law::plateau)
    stretch -= m.p.k1 / m.p.k2 * (1.0 - std::min(m.p.k_adh / m.p.k2, 1.0)) * d;
  return (bare_restitution_squared(m) * m.p.k1 * std::pow(d, n + 1.0) / (n + 1.0) +
          m.p.f0 * stretch) /
      energy;
}

struct Rebound {
  bool sticks;
  double speed;
  double largest;
};

Rebound impact(const Material &m, double speed, double mass, int steps)
{
  NormalPath path(m);
  const double energy = 0.5 * mass * speed * speed;
  const double d = largest_overlap(m, energy);
  const double dt = d / speed / steps;
  double x = 0.0, v = speed, largest = 0.0;    // v > 0 approaches
  double force = path.at(1e-300).force;
  for (int k = 0; k < 40 * steps; k++) {
    v -= 0.5 * dt * force / mass;
    const double next = x + dt * v;
    if (next <= 0.0) {
      // the speed at delta = 0, interpolated with the force of the last step
      const double t = std::min(dt, x / -v);
      return {false, -v + 0.5 * t * force / mass, largest};
    }
    if (v < 0.0 && k > 20 * steps) break;
    x = next;
    largest = std::max(largest, x);
    force = path.to(x).force;
    v -= 0.5 * dt * force / mass;
  }
  return {true, 0.0, largest};
}

void compare(const Material &m, double speed, double accuracy, int steps = 4000)
{
  const double mass = 1e-6, energy = 0.5 * mass * speed * speed;
  const double expected = restitution_squared(m, energy);
  SCOPED_TRACE(testing::Message() << "k1 " << m.p.k1 << " k2 " << m.p.k2 << " k_adh " << m.p.k_adh
                                  << " f0 " << m.p.f0 << " n " << m.law.exponent << " speed "
                                  << speed << " e^2 " << expected);
  const Rebound got = impact(m, speed, mass, steps);
  EXPECT_NEAR(got.largest / largest_overlap(m, energy), 1.0, 1e-5);
  EXPECT_EQ(got.sticks, expected <= 0.0);
  if (expected > 0.0) { EXPECT_NEAR(got.speed / speed, std::sqrt(expected), accuracy); }
}

TEST(Impact, LinearWithoutPullOff)
{
  for (double k2 : {1.0, 1.5, 2.0, 10.0})
    for (double k_adh : {0.0, 0.3, 1.0, 5.0})
      compare(material(Law::linear, 1e3, k2 * 1e3, k_adh * 1e3), 0.1, 1e-4);
}

TEST(Impact, LinearSticksWhereTheFormulaIsNegative)
{
  const Material m = material(Law::linear, 1e3, 5e3, 2e4);
  EXPECT_LT(bare_restitution_squared(m), 0.0);
  EXPECT_TRUE(impact(m, 0.1, 1e-6, 1000).sticks);
}

TEST(Impact, LinearWithPullOffDependsOnSpeedAndSticksWhenSlow)
{
  const Material m = material(Law::linear, 1e3, 2e3, 5e2, -0.002);
  for (double speed : {0.01, 0.03, 0.07, 0.1, 0.3, 1.0}) compare(m, speed, 1e-4);
  // f0 alone dissipates nothing in an elastic contact: it has a potential
  const Material elastic = material(Law::linear, 1e3, 1e3, 0.0, -0.002);
  compare(elastic, 0.1, 1e-4);
  EXPECT_NEAR(restitution_squared(elastic, 5e-9), 1.0, 1e-12);
}

TEST(Impact, LinearWithAnExponent)
{
  for (double n : {1.2, 1.5, 2.0})
    for (double k_adh : {0.0, 0.5, 2.0})
      for (double f0 : {0.0, -0.001})
        compare(material(Law::linear, 1e3 * std::pow(1e-5, 1.0 - n), 2e3 * std::pow(1e-5, 1.0 - n),
                         k_adh * 1e3 * std::pow(1e-5, 1.0 - n), f0, n),
                0.3, 1e-4);
  // the general formula is the published one for n = 1
  Material m = material(Law::linear, 1e3, 3e3, 7e2);
  const double published = bare_restitution_squared(m);
  m.law.exponent = 1.0 + 1e-12;
  EXPECT_NEAR(bare_restitution_squared(m), published, 1e-9);
}

TEST(Impact, PlateauWithoutPullOff)
{
  for (double k2 : {2.0, 3.0, 10.0})
    for (double k_adh : {0.0, 0.3, 1.0, 1.9})
      compare(material(Law::plateau, 1e3, k2 * 1e3, k_adh * 1e3), 0.1, 1e-4);
  // k2 = 2 k1: e = (1 - k_adh/k2)/sqrt(2)
  const Material m = material(Law::plateau, 5e3, 1e4, 5e3);
  EXPECT_NEAR(std::sqrt(bare_restitution_squared(m)), 0.5 / std::sqrt(2.0), 1e-15);
}

TEST(Impact, PlateauWithPullOffKeepsTheWorkOfF0OverThePlateau)
{
  for (double k2 : {2.0, 4.0})
    for (double k_adh : {0.0, 0.5, 3.0})
      for (double speed : {0.03, 0.1, 0.3})
        // the step by f0 falls somewhere within a time step: first order, so finer
        compare(material(Law::plateau, 1e3, k2 * 1e3, k_adh * 1e3, -0.002), speed, 1e-4, 60000);
}
}    // namespace impact_test
