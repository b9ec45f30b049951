// SPDX-License-Identifier: GPL-2.0-only
// Twisting (Marshall 2009): with the contact radius a = sqrt(R* delta), w = (omega_i - omega_j).u
//   torque on i along u = -k_t a^2/2 theta - B_t a^2/2 w, bounded by 2/3 a times the friction bound

#include "support.h"

namespace twisting_test {
using namespace eepa_test;

Material twister(double mu = 0.5)
{
  Material m = material(Law::linear, 1e3, 2e3, 500.0, -0.001);
  m.p.twisting = TwistingModel::marshall;
  m.p.kt_given = true;
  m.p.kt = 300.0;
  m.p.damping = Damping::viscous;
  m.p.viscous_tangential = 2e-3;
  m.p.mu = mu;
  return m;
}

double contact_radius(const Bodies &b)
{
  return std::sqrt(effective_radius(b.R_i, b.R_j) * b.overlap);
}

TEST(Twisting, NoneGivesNoTorque)
{
  Material m = twister();
  m.p.twisting = TwistingModel::none;
  Bodies b;
  b.w_i = Vec3(50.0, 0.0, 0.0);
  History history;
  const Outcome out = evaluate(m, b, 1e-6, history);
  EXPECT_EQ(out.torque_i, Vec3(Vec3::Zero()));
  EXPECT_EQ(history.twisting_spring, 0.0);
  EXPECT_EQ(out.energy.twisting + out.lost.twisting, 0.0);
}

// at constant overlap every step is that of Marshall's model
TEST(Twisting, IsSpringAndDashpotOfTheContactRadius)
{
  const Material m = twister(1e6);
  Bodies b;
  b.w_i = Vec3(30.0, 2.0, 1.0);
  b.w_j = Vec3(-10.0, 1.0, 5.0);
  const double a = contact_radius(b), dt = 1e-6;
  History history;
  for (int k = 1; k <= 20; k++) {
    const Outcome out = evaluate(m, b, dt, history);
    const double expected = -0.5 * a * a * (300.0 * k * dt * 40.0 + 2e-3 * 40.0);
    EXPECT_NEAR(out.twisting_torque, expected, 1e-13 * std::fabs(expected));
    EXPECT_NEAR(out.energy.twisting, 0.25 * 300.0 * a * a * std::pow(k * dt * 40.0, 2), 1e-25);
    EXPECT_NEAR(out.torque_i.x(), expected, 1e-12 * std::fabs(expected));
    EXPECT_EQ(out.torque_i.x(), -out.torque_j.x());
  }
}

TEST(Twisting, TorqueIsBoundedByTwoThirdsOfFrictionTimesTheContactRadius)
{
  for (const Law law : {Law::linear, Law::plateau}) {
    for (const double sign : {1.0, -1.0}) {
      Material m = twister(0.4);
      m.law.law = law;
      m.p.damping = Damping::restitution;
      Bodies b;
      b.w_i = Vec3(sign * 1e3, 0.0, 0.0);
      History history;
      Outcome out;
      for (int k = 0; k < 3; k++) out = evaluate(m, b, 1e-3, history);
      const double limit = 2.0 / 3.0 * out.friction_bound * contact_radius(b);
      EXPECT_GT(limit, 0.0);
      EXPECT_NEAR(out.twisting_torque, -sign * limit, 1e-14 * limit);
      // the next step starts on the bound
      b.w_i.setZero();
      EXPECT_NEAR(evaluate(m, b, 1e-3, history).twisting_torque, -sign * limit, 1e-12 * limit);
      // turned back by twice the angle of the bound, the torque is the opposite one
      b.w_i = Vec3(-2.0 * sign * limit / (0.5 * 300.0 * std::pow(contact_radius(b), 2)), 0.0, 0.0);
      EXPECT_NEAR(evaluate(m, b, 1.0, history).twisting_torque, sign * limit, 1e-12 * limit);
    }
  }
}

// where the dashpot alone reaches the bound the spring is emptied, so that it does not drive later
TEST(Twisting, NoSpringIsWoundBehindADashpotAtTheBound)
{
  Material m = twister(0.01);
  m.p.viscous_tangential = 1.0;
  Bodies b;
  b.w_i = Vec3(1e3, 0.0, 0.0);
  History history;
  history.twisting_spring = 1e-6;
  const Outcome out = evaluate(m, b, 1e-6, history);
  EXPECT_NEAR(out.twisting_torque, -2.0 / 3.0 * out.friction_bound * contact_radius(b), 1e-20);
  EXPECT_EQ(history.twisting_spring, 0.0);
}

// a pair of types without twisting in a style with twisting
TEST(Twisting, TakesNoPartWithAShareOfZero)
{
  const Material m = twister();
  Coefficients c = resolve(m.p, m.law);
  EXPECT_DOUBLE_EQ(c.twisting_share, 2.0 / 3.0 * std::sqrt(2.0));
  Parameters without = m.p;
  without.twisting = TwistingModel::none;
  c = resolve(without, m.law);
  Bodies b;
  b.w_i = Vec3(30.0, 0.0, 0.0);
  History history;
  using Law = ContactLaw<LinearLaw<UnitExponent>, RollingNone, TwistingMarshall>;
  const Response r = Law::evaluate(c, b.contact(1e-6), 1e-6, history);
  EXPECT_EQ(r.twisting_torque, 0.0);
  EXPECT_EQ(history.twisting_spring, 0.0);
}

// omega^2 = k_t a^2/2 / I of a sphere on a wall; the energy of the spring is recovered
TEST(Twisting, SmallTwistsSwingAtTheFrequencyOfTheirSpring)
{
  Material m = twister(1e9);
  m.p.viscous_tangential = 0.0;
  Bodies b;
  b.R_j = b.m_j = infinity;
  const double inertia = 0.4 * b.m_i * b.R_i * b.R_i, a = contact_radius(b);
  const double period = 2.0 * std::acos(-1.0) * std::sqrt(inertia / (0.5 * 300.0 * a * a));
  const int steps = 2000;
  const double dt = period / steps;
  History history;
  double w = 1.0, torque = 0.0, largest = 0.0;
  for (int k = 1; k <= steps; k++) {
    w += 0.5 * dt * torque / inertia;
    b.w_i = Vec3(w, 0.0, 0.0);
    const Outcome out = evaluate(m, b, dt, history);
    torque = out.twisting_torque;
    w += 0.5 * dt * torque / inertia;
    largest = std::max(largest, std::fabs(0.5 * inertia * w * w + out.energy.twisting));
    if (k == steps / 4) { EXPECT_NEAR(w, 0.0, 2e-3); }
    if (k == steps / 2) { EXPECT_NEAR(w, -1.0, 1e-5); }
    EXPECT_NEAR(out.lost.twisting, 0.0, 1e-9 * inertia);
  }
  EXPECT_NEAR(w, 1.0, 1e-5);
  EXPECT_NEAR(largest, 0.5 * inertia, 1e-5 * inertia);
}

// pressing a twisted contact together gives its spring no energy
TEST(Twisting, EnergyDoesNotChangeWithTheOverlap)
{
  const Material m = twister(1e9);
  Bodies b;
  History history;
  history.twisting_spring = 1e-7;
  const double before = evaluate(m, b, 0.0, history).energy.twisting;
  EXPECT_GT(before, 0.0);
  b.overlap *= 3.0;
  const Outcome out = evaluate(m, b, 1e-6, history);
  EXPECT_EQ(out.energy.twisting, before);
  EXPECT_EQ(out.lost.twisting, 0.0);
}

// energy that the spring still stores when the contact opens
TEST(Twisting, OpeningLosesTheSpring)
{
  const Material m = twister();
  Bodies b;
  b.overlap = -1e-8;
  b.w_i = Vec3(100.0, 0.0, 0.0);
  History h;
  h.max_overlap = 1e-6;
  h.twisting_spring = 2e-7;
  using Law = ContactLaw<LinearLaw<UnitExponent>, RollingNone, TwistingMarshall>;
  EXPECT_DOUBLE_EQ(
      dissipation_of_opening<Law>(resolve(m.p, m.law), b.contact(1e-6), 1e-6, h).twisting,
      0.5 * 300.0 * 4e-14);
}

using Twister = ContactLaw<LinearLaw<UnitExponent>, RollingNone, TwistingMarshall>;

// the stiffness of a released spring scales with s
TEST(Twisting, OpeningOfAScaledContactLosesItsSpring)
{
  Material m = twister();
  scale_with_diameter(m, 3e-4);
  Bodies b;
  b.overlap = -1e-8;
  History h;
  h.max_overlap = 1e-6;
  h.twisting_spring = 2e-7;
  EXPECT_DOUBLE_EQ(
      dissipation_of_opening<Twister>(resolve(m.p, m.law), b.contact(1e-6), 1e-6, h).twisting,
      0.5 * 900.0 * 4e-14);
}

// one step that slides: the spring's trapezoid work less what it stores of it, either way round
TEST(Twisting, SlidingOfOneStepIsItsTrapezoidWorkLessTheStoredChange)
{
  for (const double sign : {1.0, -1.0}) {
    Material m = twister(0.05);
    m.p.viscous_tangential = 0.0;
    m.p.restitution = 1.0;
    Bodies b;
    b.w_i = Vec3(sign * 300.0, 0.0, 0.0);
    const double dt = 1e-5;
    const double arm = contact_radius(b) / std::sqrt(2.0);
    History h;
    h.max_overlap = b.overlap;
    h.twisting_spring = sign * 4e-6;
    const double x = h.twisting_spring, d = dt * arm * sign * 300.0;
    const Outcome out = evaluate(m, b, dt, h);
    const double y = h.twisting_spring;
    ASSERT_LT(std::fabs(y), std::fabs(x + d) - 1e-8);
    const double expected = 0.5 * 300.0 * ((x + y) * d - (y * y - x * x));
    EXPECT_GT(expected, 1e-13);
    EXPECT_NEAR(out.lost.twisting, expected, 1e-12 * expected);
    EXPECT_EQ(out.lost.total(),
              out.lost.hysteresis + out.lost.normal_dashpot + out.lost.tangential_dashpot +
                  out.lost.sliding + out.lost.twisting);
  }
}

// a dashpot that a spring holds back is not cut at the bound, and is booked whole
TEST(Twisting, DashpotHeldByASpringIsNotCutAtTheBound)
{
  Material m = twister(0.1);
  m.p.viscous_tangential = 0.02;
  Bodies b;
  const double dt = 1e-12;
  const double arm = contact_radius(b) / std::sqrt(2.0);
  History h;
  h.max_overlap = b.overlap;
  const double bound = 2.0 / 3.0 * std::sqrt(2.0) * evaluate(m, b, 0.0).friction_bound;
  const double speed = 1.7 * bound / 0.02;
  b.w_i = Vec3(speed / arm, 0.0, 0.0);
  h.twisting_spring = -1.5 * bound / 300.0;
  const Outcome out = evaluate(m, b, dt, h);
  ASSERT_NEAR(out.twisting_torque, -0.2 * bound * arm, 1e-6 * bound * arm);    // it sticks
  EXPECT_NEAR(out.lost.twisting, 0.02 * speed * speed * dt, 1e-6 * 0.02 * speed * speed * dt);
}

// with the normal of the middle of the step, the time of the velocities
TEST(Twisting, VelocityIsThatAlongTheNormalOfTheMiddleOfTheStep)
{
  Contact c{};
  c.normal = Vec3::UnitX();
  c.turn = Vec3(0.0, 0.25, 0.0);
  c.angular_velocity = Vec3(3.0, 8.0, 5.0);
  EXPECT_EQ(twisting_velocity(c), 1.0);
}

/// Error of the ledger until a sphere that spins about the normal of a wall has come to rest,
/// relative to its kinetic energy.
double missed_in_twist(const Material &m, double speed, int steps)
{
  Bodies b;
  b.R_j = b.m_j = infinity;
  const double inertia = 0.4 * b.m_i * b.R_i * b.R_i;
  const double a = contact_radius(b);
  const double period = 2.0 * std::acos(-1.0) * std::sqrt(inertia / (0.5 * 300.0 * a * a));
  const double dt = period / steps, start = 0.5 * inertia * speed * speed;
  History history;
  double w = speed, torque = 0.0, lost = 0.0, stored = 0.0;
  for (int k = 0; k < 4 * steps; k++) {
    w += 0.5 * dt * torque / inertia;
    b.w_i = Vec3(w, 0.0, 0.0);
    const Outcome out = evaluate(m, b, dt, history);
    EXPECT_GE(out.lost.twisting, -1e-12 * start);
    lost += out.lost.twisting;
    stored = out.energy.twisting;
    torque = out.twisting_torque;
    w += 0.5 * dt * torque / inertia;
  }
  EXPECT_LT(0.5 * inertia * w * w, 0.05 * start);
  return std::fabs(0.5 * inertia * w * w + stored + lost - start) / start;
}

// a dashpot and a spring, a slider and a spring, all three: at half the step the error is a quarter
TEST(Twisting, LedgerClosesThroughSlidingAndDamping)
{
  struct Case {
    double mu, viscous;
  };
  for (const Case &given : {Case{1e6, 0.1}, Case{0.003, 0.0}, Case{0.006, 0.05}}) {
    for (const double speed : {40.0, -40.0}) {
      Material m = twister(given.mu);
      m.p.viscous_tangential = given.viscous;
      const double coarse = missed_in_twist(m, speed, 100), fine = missed_in_twist(m, speed, 200);
      SCOPED_TRACE(testing::Message() << "mu " << given.mu << " B " << given.viscous << " w "
                                      << speed << ": " << coarse << " " << fine);
      EXPECT_LT(coarse, 5e-3);
      EXPECT_LT(fine, 0.35 * coarse + 1e-6);
    }
  }
}

// stiffness with s, forces with s^2, torques with s^3 in a similar contact
TEST(Twisting, ScalesWithTheContact)
{
  Material m = twister(0.3);
  scale_with_diameter(m, 9e-4);
  for (const double speed : {10.0, 1e4}) {    // sticking and sliding
    Bodies small, large;
    small.w_i = Vec3(speed, 0.0, 0.0);
    large.R_i = 2.0 * small.R_i;
    large.R_j = 2.0 * small.R_j;
    large.m_i = 8.0 * small.m_i;
    large.m_j = 8.0 * small.m_j;
    large.overlap = 2.0 * small.overlap;
    large.w_i = 0.5 * small.w_i;
    History a, b;
    for (int k = 0; k < 5; k++) {
      const Outcome one = evaluate(m, small, 1e-6, a), two = evaluate(m, large, 2e-6, b);
      EXPECT_EQ(two.twisting_torque, 8.0 * one.twisting_torque);
      EXPECT_EQ(two.energy.twisting, 8.0 * one.energy.twisting);
      EXPECT_EQ(b.twisting_spring, 2.0 * a.twisting_spring);
    }
  }
}

// the stiffness of twisting never sets the time step: 5/4 kt delta/R against 7/2 kt
TEST(Twisting, IsSofterThanSliding)
{
  const Material m = twister();
  Bodies b;
  b.R_j = b.m_j = infinity;
  for (const double depth : {0.01, 0.1, 1.0}) {
    b.overlap = depth * b.R_i;
    const double a = contact_radius(b);
    const double twisting = 0.5 * 300.0 * a * a / (0.4 * b.R_i * b.R_i);
    EXPECT_NEAR(twisting, 1.25 * 300.0 * depth, 1e-9);
    EXPECT_LT(twisting, 3.5 * 300.0);
    EXPECT_GE(largest_stiffness(resolve(m.p, m.law), b.size()), 3.5 * 300.0);
  }
}
}    // namespace twisting_test
