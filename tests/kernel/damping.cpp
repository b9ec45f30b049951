// SPDX-License-Identifier: GPL-2.0-only
// Dashpots (contract, section 1): f_nd = -B_n v_n with
//   B_n = sqrt(4 m* k1/(1 + (pi/ln e)^2)), B_t the same with kt; e = 1 none, e = 0 critical.
// For n != 1 the tangent n k1 delta^(n-1) of the loading branch replaces k1.

#include "support.h"

namespace damping_test {
using namespace eepa_test;

const double pi = 3.14159265358979323846;

double formula(double e, double mass, double k)
{
  return std::sqrt(4.0 * mass * k / (1.0 + std::pow(pi / std::log(e), 2)));
}

TEST(Damping, RestitutionFactor)
{
  EXPECT_EQ(restitution_damping(1.0), 0.0);
  EXPECT_EQ(restitution_damping(0.0), 2.0);
  for (double e : {1e-300, 1e-6, 0.1, 0.5, 0.9, 0.999999})
    EXPECT_NEAR(restitution_damping(e), formula(e, 1.0, 1.0), 1e-15) << e;
  // continuous at both ends, and falling
  EXPECT_NEAR(restitution_damping(1.0 - 1e-12), 0.0, 1e-11);
  EXPECT_NEAR(restitution_damping(1e-300), 2.0, 1e-4);
  for (double e = 0.01; e < 0.99; e += 0.01)
    EXPECT_GT(restitution_damping(e), restitution_damping(e + 0.01));
}

TEST(Damping, NormalAndTangentialDashpotsOfARestitution)
{
  for (double n : {1.0, 1.5}) {
    for (bool scaled : {false, true}) {
      SCOPED_TRACE(testing::Message() << "n " << n << " scaled " << scaled);
      Material m = material(Law::linear, n == 1.0 ? 1e3 : 3e5, n == 1.0 ? 1e3 : 3e5, 0.0, 0.0, n);
      m.p.kt_given = true;
      m.p.kt = 444.0;
      m.p.restitution = 0.3;
      m.p.mu = 1e9;
      if (scaled) scale_with_diameter(m, 3e-4);
      Bodies b;
      const double s = scaled ? 3.0 : 1.0, mass = effective_mass(b.m_i, b.m_j);
      const double k = m.p.k1 * n * std::pow(b.overlap, n - 1.0) * std::pow(s, 2.0 - n);
      b.v_i = Vec3(-0.2, 0.0, 0.1);
      const Outcome out = evaluate(m, b);
      EXPECT_NEAR(out.normal_force - out.hysteretic_force, 0.2 * formula(0.3, mass, k), 1e-15);
      EXPECT_LT(deviation(out.tangential_force, Vec3(0, 0, -0.1 * formula(0.3, mass, 444.0 * s))),
                1e-13);
    }
  }
}

// given dashpots scale with d^2
TEST(Damping, ViscousCoefficientsAsGiven)
{
  for (double n : {1.0, 1.5}) {
    Material m = material(Law::linear, 1e3, 2e3, 0.0, 0.0, n);
    m.p.damping = Damping::viscous;
    m.p.viscous_normal = 0.03;
    m.p.viscous_tangential = 0.02;
    m.p.mu = 1e9;
    scale_with_diameter(m, 3e-4);
    Bodies b;
    b.v_i = Vec3(-0.2, 0.0, 0.1);
    const Outcome out = evaluate(m, b);
    EXPECT_NEAR(out.normal_force - out.hysteretic_force, 9.0 * 0.03 * 0.2, 1e-14);
    EXPECT_LT(deviation(out.tangential_force, Vec3(0.0, 0.0, -9.0 * 0.02 * 0.1)), 1e-13);
  }
}

// f_n >= min(f_hys, 0)
TEST(Damping, LimitDampingAddsNoTension)
{
  Material m = material(Law::linear, 1e3, 2e3, 1e3);
  m.p.restitution = 0.1;
  Bodies b;
  for (double overlap : {1e-5, 2e-6}) {
    b.overlap = overlap;
    for (double v : {-1.0, 1e-3, 1.0}) {
      History history;
      history.max_overlap = 1.01e-5;
      History copy = history;
      b.v_i = Vec3(v, 0.0, 0.0);
      m.law.limit_damping = false;
      const Outcome free = evaluate(m, b, 0.0, history);
      m.law.limit_damping = true;
      const Outcome limited = evaluate(m, b, 0.0, copy);
      EXPECT_EQ(limited.hysteretic_force, free.hysteretic_force);
      EXPECT_EQ(limited.normal_force,
                std::max(free.normal_force, std::min(free.hysteretic_force, 0.0)));
    }
  }
  b.overlap = 1e-5;
  b.v_i = Vec3(1.0, 0.0, 0.0);
  m.law.limit_damping = true;
  EXPECT_EQ(evaluate(m, b).normal_force, 0.0);    // pure tension is cut off
  m.law.limit_damping = false;
  EXPECT_LT(evaluate(m, b).normal_force, 0.0);
}

/// A head-on impact integrated by the classical Runge-Kutta method; the speed at which it opens.
double rebound(const Material &m, double speed, double mass, int steps_per_period)
{
  Bodies b;
  b.m_i = mass;
  b.m_j = b.R_j = infinity;
  double x = 0.0, v = -speed;    // v_n < 0 approaches; the overlap grows with -v_n
  const double dt = 2.0 * pi * std::sqrt(mass / m.p.k1) / steps_per_period;
  auto acceleration = [&](double overlap, double velocity) {
    b.overlap = std::max(overlap, 0.0);
    b.v_i = Vec3(velocity, 0.0, 0.0);
    return evaluate(m, b).normal_force / mass;
  };
  for (int k = 0; k < 4 * steps_per_period; k++) {
    const double a1 = acceleration(x, v), x1 = -v;
    const double a2 = acceleration(x + 0.5 * dt * x1, v + 0.5 * dt * a1), x2 = -(v + 0.5 * dt * a1);
    const double a3 = acceleration(x + 0.5 * dt * x2, v + 0.5 * dt * a2), x3 = -(v + 0.5 * dt * a2);
    const double a4 = acceleration(x + dt * x3, v + dt * a3), x4 = -(v + dt * a3);
    const double x_next = x + dt / 6.0 * (x1 + 2.0 * (x2 + x3) + x4);
    const double v_next = v + dt / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
    if (x_next <= 0.0) return v + (v_next - v) * x / (x - x_next);
    x = x_next;
    v = v_next;
  }
  return 0.0;
}

// the linear spring-dashpot has the restitution that its dashpot was computed from
TEST(Damping, HeadOnImpactGivesTheRestitution)
{
  for (double e : {0.05, 0.2, 0.5, 0.9, 1.0}) {
    Material m = material(Law::linear, 1e3, 1e3, 0.0);
    m.p.restitution = e;
    EXPECT_NEAR(rebound(m, 0.3, 1e-6, 2000) / 0.3, e, 2e-6);
  }
}

// critical damping: the particle never comes back
TEST(Damping, CriticalImpactDoesNotRebound)
{
  Material m = material(Law::linear, 1e3, 1e3, 0.0);
  m.p.restitution = 0.0;
  EXPECT_EQ(rebound(m, 0.3, 1e-6, 500), 0.0);
}

TEST(Damping, NothingToDampBetweenTwoInfiniteMasses)
{
  Material m = material(Law::linear, 1e3, 1e3, 0.0);
  m.p.restitution = 0.5;
  m.p.rolling = RollingModel::constant;
  m.p.mu_r = 0.1;
  Bodies b;
  b.m_i = b.m_j = infinity;
  b.v_i = Vec3(-1.0, 0.5, 0.0);
  b.w_i = Vec3(0.0, 5.0, 0.0);
  const Outcome out = evaluate(m, b);
  EXPECT_EQ(out.normal_force, out.hysteretic_force);
  EXPECT_TRUE(out.force.allFinite() && out.torque_i.allFinite());
}
}    // namespace damping_test
