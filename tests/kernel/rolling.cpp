// SPDX-License-Identifier: GPL-2.0-only
// Rolling resistance (contract, section 1), w the tangent-plane part of omega_i - omega_j:
//   constant  torque on i = -min(mu_r |f_hys| R*, c |w|) w/|w|, c = 2/5 R*^2 sqrt(m* k)
//   sds       v_r = R* w, g = -kr xi_r - gr v_r, |g| <= mu_r |f_hys|, torque on i = R* g

#include "support.h"

namespace rolling_test {
using namespace eepa_test;

Material roller(RollingModel model, double n = 1.0)
{
  Material m = material(Law::linear, n == 1.0 ? 1e3 : 3e5, n == 1.0 ? 2e3 : 6e5, 500.0, -0.001, n);
  m.p.rolling = model;
  m.p.mu_r = 0.05;
  m.p.kr = 200.0;
  m.p.rolling_viscous = 1e-4;
  return m;
}

TEST(Rolling, NoneGivesNoTorque)
{
  Bodies b;
  b.w_i = Vec3(1.0, 20.0, -30.0);
  const Outcome out = evaluate(roller(RollingModel::none), b);
  const Vec3 friction = b.u.cross(out.tangential_force);
  EXPECT_EQ(out.torque_i, Vec3(-b.arm_i() * friction));
  EXPECT_EQ(out.torque_j, Vec3(-b.arm_j() * friction));
}

TEST(Rolling, ConstantTorqueAgainstTheRelativeSpin)
{
  for (double n : {1.0, 1.5}) {
    Bodies b;
    b.w_i = Vec3(7.0, 3000.0, -4000.0);
    b.w_j = Vec3(0.0, -3000.0, 4000.0);
    const Outcome out = evaluate(roller(RollingModel::constant, n), b);
    const double R = b.R_i * b.R_j / (b.R_i + b.R_j);
    const double limit = 0.05 * std::fabs(out.hysteretic_force) * R;
    EXPECT_LT(deviation(out.rolling_torque, -limit * Vec3(0.0, 0.6, -0.8)), 1e-14);
    EXPECT_LT(deviation(out.torque_i + b.arm_i() * b.u.cross(out.tangential_force),
                        out.rolling_torque, b.arm_i() * out.tangential_force.norm()),
              1e-14);
    EXPECT_LT(deviation(out.torque_j + b.arm_j() * b.u.cross(out.tangential_force),
                        -out.rolling_torque, b.arm_j() * out.tangential_force.norm()),
              1e-14);
  }
}

// slow rolling: c |w|, with the loading branch's (tangent) stiffness, scaled
TEST(Rolling, ConstantTorqueIsSmoothedBySlowRolling)
{
  for (double n : {1.0, 1.5}) {
    Material m = roller(RollingModel::constant, n);
    scale_with_diameter(m, 3e-4);
    Bodies b;
    const double w = 1e-6;
    b.w_i = Vec3(0.0, 0.0, w);
    const double R = effective_radius(b.R_i, b.R_j);
    const double k = m.p.k1 * n * std::pow(b.overlap, n - 1.0) * std::pow(b.size() / 3e-4, 2.0 - n);
    const double c = 0.4 * R * R * std::sqrt(effective_mass(b.m_i, b.m_j) * k);
    const Outcome out = evaluate(m, b);
    EXPECT_LT(deviation(out.rolling_torque, Vec3(0.0, 0.0, -c * w)), 1e-13);
    // the two branches of the minimum meet
    const double limit = 0.05 * std::fabs(out.hysteretic_force) * R;
    b.w_i = Vec3(0.0, 0.0, limit / c * (1.0 + 1e-9));
    EXPECT_NEAR(evaluate(m, b).rolling_torque.norm() / limit, 1.0, 1e-8);
    b.w_i = Vec3(0.0, 0.0, limit / c * (1.0 - 1e-9));
    EXPECT_NEAR(evaluate(m, b).rolling_torque.norm() / limit, 1.0, 1e-8);
    b.w_i = Vec3(0.0, 0.0, 0.5 * limit / c);
    EXPECT_NEAR(evaluate(m, b).rolling_torque.norm() / limit, 0.5, 1e-12);
  }
}

// a particle at rest, or with little spin, comes to rest: the torque neither drives it nor chatters
TEST(Rolling, ConstantTorqueStopsAParticleWithoutOvershoot)
{
  Material m = roller(RollingModel::constant);
  Bodies b;
  b.R_j = b.m_j = infinity;
  const double inertia = 0.4 * b.m_i * b.R_i * b.R_i;
  const double dt = largest_time_step(b.m_i, 2e3);
  double w = 5.0, earlier = w;
  m.p.mu = 0.0;
  for (int k = 0; k < 3000; k++) {
    b.w_i = Vec3(0.0, w, 0.0);
    w += dt * evaluate(m, b).torque_i.y() / inertia;
    ASSERT_GE(w, 0.0);
    ASSERT_LE(w, earlier);
    earlier = w;
  }
  EXPECT_LT(w, 1e-10);
  b.w_i.setZero();
  EXPECT_EQ(evaluate(m, b).torque_i.norm(), 0.0);
}

TEST(Rolling, TwistingIsFree)
{
  for (RollingModel model : {RollingModel::constant, RollingModel::sds}) {
    Bodies b;
    b.u = Vec3::UnitZ();
    b.w_i = Vec3(0.0, 0.0, 300.0);
    b.w_j = Vec3(0.0, 0.0, -100.0);
    History history;
    const Outcome out = evaluate(roller(model), b, 1e-6, history);
    EXPECT_EQ(out.torque_i.norm(), 0.0);
    EXPECT_EQ(out.torque_j.norm(), 0.0);
    EXPECT_EQ(history.rolling_spring.norm(), 0.0);
  }
}

// torque . (omega_i - omega_j) <= 0
TEST(Rolling, ConstantAlwaysDissipates)
{
  Random random(31);
  for (int k = 0; k < 2000; k++) {
    Material m = any_material(random);
    m.p.rolling = RollingModel::constant;
    m.p.mu_r = 0.3;
    Bodies b = any_bodies(random);
    any_motion(random, b);
    b.overlap = 0.01 * std::min(b.R_i, b.R_j);
    const Outcome out = evaluate(m, b);
    ASSERT_LE(out.rolling_torque.dot(b.w_i - b.w_j), 0.0);
    ASSERT_LE(out.rolling_torque.norm(),
              (1.0 + 1e-14) * 0.3 * std::fabs(out.hysteretic_force) *
                  effective_radius(b.R_i, b.R_j));
    ASSERT_NEAR(out.rolling_torque.dot(b.u), 0.0, 1e-13 * out.rolling_torque.norm());
  }
}

TEST(Rolling, SdsSpringAndDashpot)
{
  Material m = roller(RollingModel::sds);
  m.p.mu_r = 100.0;
  scale_with_diameter(m, 3e-4);
  const double s = 9e-4 / 3e-4;
  Bodies b;
  b.u = Vec3::UnitZ();
  b.w_i = Vec3(0.0, 20.0, 50.0);
  b.w_j = Vec3(0.0, 5.0, -50.0);
  const double R = effective_radius(b.R_i, b.R_j), dt = 1e-6;
  const Vec3 v = R * Vec3(0.0, 15.0, 0.0);    // the twist along z is left out
  History history;
  for (int k = 1; k < 5; k++) {
    const Outcome out = evaluate(m, b, dt, history);
    EXPECT_LT(deviation(history.rolling_spring, k * dt * v), 1e-14);
    const Vec3 f = -200.0 * s * k * dt * v - 1e-4 * s * s * v;
    EXPECT_LT(deviation(out.rolling_torque, R * f), 1e-14);
    EXPECT_NEAR(out.energy.rolling, 0.5 * 200.0 * s * std::pow(k * dt * v.norm(), 2), 1e-20);
  }
}

TEST(Rolling, SdsSliderIsBoundedAndItsSpringReset)
{
  Material m = roller(RollingModel::sds);
  Bodies b;
  b.u = Vec3::UnitZ();
  b.w_i = Vec3(10.0, 20.0, 0.0);
  const double R = effective_radius(b.R_i, b.R_j);
  History history;
  Outcome out;
  for (int k = 0; k < 2000; k++) out = evaluate(m, b, 1e-5, history);
  const double limit = 0.05 * std::fabs(out.hysteretic_force);
  EXPECT_NEAR(out.rolling_torque.norm(), limit * R, 1e-14 * limit * R);
  EXPECT_LT(out.rolling_torque.dot(b.w_i), 0.0);
  // spring and dashpot together are at the bound
  const Vec3 v = R * b.w_i;
  const Vec3 f = -200.0 * history.rolling_spring - 1e-4 * v;
  EXPECT_NEAR(f.norm(), limit, 1e-12 * limit);
  // rolled back by the length of the spring, the contact has no rolling torque
  const double stretch = history.rolling_spring.norm();
  b.w_i = -b.w_i;
  const double dt = stretch / v.norm();
  m.p.rolling_viscous = 0.0;
  out = evaluate(m, b, dt, history);
  EXPECT_LT(out.rolling_torque.norm(), 1e-10 * limit * R);
}

// a sphere spun against a wall without friction oscillates on the spring and decays by the dashpot
TEST(Rolling, SdsOscillationDecays)
{
  Material m = roller(RollingModel::sds);
  m.p.mu = 0.0;
  m.p.mu_r = 10.0;
  m.p.rolling_viscous = 2e-3;
  Bodies b;
  b.R_j = b.m_j = infinity;
  const double inertia = 0.4 * b.m_i * b.R_i * b.R_i;
  // I w' = -R^2 (kr phi + gr w): half the damping rate is gr R^2/(2 I)
  const double rate = 0.5 * 2e-3 * b.R_i * b.R_i / inertia;
  const double omega = std::sqrt(200.0 * b.R_i * b.R_i / inertia - rate * rate);
  const double period = 2.0 * 3.14159265358979323846 / omega;
  const int steps = 20000;
  double w = 1.0;
  History history;
  for (int k = 0; k < steps; k++) {
    b.w_i = Vec3(0.0, w, 0.0);
    w += period / steps * evaluate(m, b, period / steps, history).torque_i.y() / inertia;
  }
  EXPECT_NEAR(w, std::exp(-rate * period), 1e-3);
}
}    // namespace rolling_test
