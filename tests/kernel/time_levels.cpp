// SPDX-License-Identifier: GPL-2.0-only
// Springs are wound by velocities of the middle of a step and positions of its end.

#include "support.h"

namespace time_levels_test {
using namespace eepa_test;

Material sticky()
{
  Material m = material(Law::linear, 1e3, 2e3, 0.0);
  m.p.mu = 1e9;
  m.p.kt_given = true;
  m.p.kt = 300.0;
  m.p.rolling = RollingModel::sds;
  m.p.kr = 200.0;
  m.p.mu_r = 1e9;
  return m;
}

/// A pair after a rigid rotation by `angle` about `axis`, with the velocities of the middle of that
/// step.
Bodies rotated_rigidly(Bodies b, const Vec3 &axis, double angle, double time_step)
{
  const Vec3 w = angle / time_step * axis;
  const double arm_i = b.arm_i(), arm_j = b.arm_j();
  const Vec3 middle = Eigen::AngleAxisd(0.5 * angle, axis) * b.u;
  b.u = Eigen::AngleAxisd(angle, axis) * b.u;
  b.u.normalize();
  b.w_i = b.w_j = w;
  // chords: what velocity Verlet moves the centres by
  const double chord = 2.0 * std::sin(0.5 * angle) / angle;
  b.v_i = chord * w.cross(arm_i * middle);
  b.v_j = -chord * w.cross(arm_j * middle);
  return b;
}

// The springs of a pair that turns as one body, about any axis, turn with the pair. With the normal
// of the step's end each step would wind them by dt/2 (spin.u) |du/dt|; without the turn about u
// they would lag behind by the angle about u.
TEST(TimeLevels, SpringsTurnWithAPairThatRotatesRigidly)
{
  Random random(81);
  const Material m = sticky();
  for (int k = 0; k < 20; k++) {
    Bodies b;
    b.u = random.direction();
    const Vec3 axis = random.direction();
    Vec3 spring = random.vector(1.0);
    spring = (spring - spring.dot(b.u) * b.u).normalized();
    double error[2];
    for (int fine = 0; fine < 2; fine++) {
      const int steps = fine ? 2000 : 1000;    // two radians in all
      const double angle = 2.0 / steps;
      Bodies now = b;
      History history;
      history.max_overlap = b.overlap;
      history.tangential_spring = 1e-6 * spring;
      history.rolling_spring = 2e-6 * spring;
      for (int step = 0; step < steps; step++) {
        now = rotated_rigidly(now, axis, angle, 1e-6);
        evaluate(m, now, 1e-6, history);
      }
      const Vec3 there = Eigen::AngleAxisd(2.0, axis) * spring;
      // of first order, from the projection of the spring into the present plane
      EXPECT_LT((history.rolling_spring / 2e-6 - there).norm(), fine ? 5e-4 : 1e-3);
      error[fine] = (history.tangential_spring / 1e-6 - there).norm();
      EXPECT_LT(error[fine], 5e-3);
    }
    EXPECT_LT(error[1], 0.7 * error[0] + 1e-7);
  }
}

// Two spheres that roll on each other without slip, while they spin about the line of centres: the
// surfaces do not slip in the middle of the step, and no spring is wound but to third order.
TEST(TimeLevels, RollingWithSpinWindsNoSpring)
{
  const Material m = sticky();
  Bodies b;
  for (const double spin : {0.0, 1.0, -3.0}) {
    double wound[2];
    for (int fine = 0; fine < 2; fine++) {
      const double angle = fine ? 5e-4 : 1e-3, dt = 1e-6, w = angle / dt;
      // i goes round j, which is at rest: from u = (cos, sin, 0), mid-step at angle/2
      const Vec3 middle(std::cos(0.5 * angle), std::sin(0.5 * angle), 0.0), z = Vec3::UnitZ();
      const double distance = b.R_i + b.R_j - b.overlap;
      Bodies now = b;
      now.u = Vec3(std::cos(angle), std::sin(angle), 0.0);
      now.v_i = w * distance * z.cross(middle);
      now.w_i = w * distance / now.arm_i() * z + spin * w * distance / now.arm_i() * middle;
      History history;
      history.max_overlap = b.overlap;
      evaluate(m, now, dt, history);
      wound[fine] = history.tangential_spring.norm();
      EXPECT_LT(wound[fine], 2.0 * angle * angle * angle * distance);
    }
    if (spin != 0.0) { EXPECT_LT(wound[1], 0.2 * wound[0]); }
  }
}

// A set-up call turns nothing.
TEST(TimeLevels, SetUpCallsSeeTheNormalOfNow)
{
  Bodies b;
  b.v_i = Vec3(0.0, 3.0, 0.0);
  b.w_i = Vec3(1e3, 0.0, 0.0);
  const Contact c = b.contact(0.0);
  EXPECT_EQ(c.turn, Vec3(Vec3::Zero()));
  EXPECT_EQ(c.twist, 0.0);
  History history;
  history.tangential_spring = Vec3(0.0, 1e-6, 2e-6);
  history.max_overlap = b.overlap;
  const History before = history;
  evaluate(sticky(), b, 0.0, history);
  EXPECT_EQ(history.tangential_spring, before.tangential_spring);
}

// A spring that turns by any angle keeps its length to rounding: rotation gives no energy.
TEST(TimeLevels, TurningKeepsTheLengthOfASpring)
{
  Random random(82);
  for (int k = 0; k < 1000; k++) {
    Contact c;
    c.normal = random.direction();
    c.turn.setZero();
    c.twist = random.uniform(-2e-3, 2e-3);
    Vec3 spring = random.vector(1.0);
    spring -= spring.dot(c.normal) * c.normal;
    const Vec3 turned = carry_over(spring, c);
    EXPECT_NEAR(turned.norm(), spring.norm(), 2e-15 * spring.norm());
    const double angle = std::atan2(c.normal.dot(spring.cross(turned)), spring.dot(turned));
    EXPECT_NEAR(angle, c.twist, 1e-7);
    // the displacement of the step turns by half of that
    Vec3 way = 1e-3 * random.vector(1.0);
    way -= way.dot(c.normal) * c.normal;
    const Vec3 wound = wind<double>(spring, way / 1e-6, 1e-6, c) - turned;
    const double half = std::atan2(c.normal.dot(way.cross(wound)), way.dot(wound));
    EXPECT_NEAR(half, 0.5 * c.twist, 1e-8);
  }
}
}    // namespace time_levels_test
