// SPDX-License-Identifier: GPL-2.0-only
// Tangential law (contract, section 1): spring in the tangent plane, dashpot, Coulomb bound.
//   f_ts = -kt xi, f_td = -B_t v_t; |f_t| <= bound, and where it is exceeded the total is scaled
//   back onto it and xi reset so that the next step starts on the bound.

#include "support.h"

namespace friction_test {
using namespace eepa_test;

Material sticky(double mu = 0.5)
{
  Material m = material(Law::linear, 1e3, 2e3, 1e3, -0.002);
  m.p.mu = mu;
  return m;
}

// v_t = v_i - v_j - (v_n) u - (a_i omega_i + a_j omega_j) x u
TEST(Friction, SurfaceVelocityHasNoNormalPartAndVanishesInRolling)
{
  Random random(21);
  for (int k = 0; k < 100; k++) {
    Bodies b;
    b.u = random.direction();
    any_motion(random, b);
    const Contact c = b.contact();
    const Vec3 v = tangential_velocity(c, c.velocity.dot(c.normal));
    const double scale = c.velocity.norm() + c.spin.norm();
    EXPECT_NEAR(v.dot(b.u), 0.0, 1e-14 * scale);
    // both surfaces move with their centres and spins: points at -a_i u and +a_j u
    const Vec3 at_i = b.v_i + b.w_i.cross(-b.arm_i() * b.u);
    const Vec3 at_j = b.v_j + b.w_j.cross(b.arm_j() * b.u);
    const Vec3 relative = at_i - at_j;
    EXPECT_LT((v - (relative - relative.dot(b.u) * b.u)).norm(), 1e-13 * scale);
  }
  // a sphere that rolls on a wall without slip: v = omega x a u
  Bodies b;
  b.R_j = b.m_j = infinity;
  b.u = Vec3::UnitZ();
  b.w_i = Vec3(0.0, 10.0, 0.0);
  b.v_i = b.w_i.cross(b.arm_i() * b.u);
  const Contact c = b.contact();
  EXPECT_LT(tangential_velocity(c, 0.0).norm(), 1e-17);
}

// a_i + a_j = r: forces and torques conserve angular momentum
TEST(Friction, LeverArmsAddToTheDistance)
{
  Random random(22);
  for (int k = 0; k < 100; k++) {
    Bodies b = any_bodies(random);
    if (b.wall()) continue;
    b.overlap = random.uniform(0.0, 0.2) * b.size();
    EXPECT_NEAR(b.arm_i() + b.arm_j(), b.R_i + b.R_j - b.overlap, 1e-15 * b.size());
  }
  EXPECT_DOUBLE_EQ(lever_arm(3.0, 0.5), 2.75);
}

TEST(Friction, SpringIsWoundByTheSurfaceVelocity)
{
  Bodies b;
  b.overlap = 1e-5;
  b.v_i = Vec3(0.05, 0.01, -0.02);
  const double dt = 1e-6;
  Material m = sticky(10.0);
  History history;
  for (int k = 1; k <= 5; k++) {
    const Outcome out = evaluate(m, b, dt, history);
    EXPECT_FALSE(out.sliding);
    EXPECT_LT(deviation(history.tangential_spring, k * dt * Vec3(0.0, 0.01, -0.02)), 1e-14);
    EXPECT_LT(deviation(out.tangential_force, -2.0 / 7.0 * 1e3 * history.tangential_spring), 1e-14);
  }
  m.p.kt_given = true;
  m.p.kt = 50.0;
  const Outcome out = evaluate(m, b, dt, history);
  EXPECT_LT(deviation(out.tangential_force, -50.0 * history.tangential_spring), 1e-14);
}

// set-up calls: no time passes, the spring is not wound
TEST(Friction, NothingIsWoundInAStepOfLengthZero)
{
  Bodies b;
  b.v_i = Vec3(0.0, 1.0, 1.0);
  History history;
  history.tangential_spring = Vec3(0.0, 2e-7, 0.0);
  history.max_overlap = b.overlap;
  evaluate(sticky(), b, 0.0, history);
  EXPECT_EQ(history.tangential_spring, Vec3(0.0, 2e-7, 0.0));
}

TEST(Friction, SpringKeepsItsLengthWhenThePlaneTurns)
{
  Random random(23);
  for (int k = 0; k < 1000; k++) {
    const Vec3 u = random.direction();
    Vec3 spring = random.vector(random.decades(-12.0, 3.0));
    spring -= spring.dot(u) * u;
    const Vec3 turned = (u + 0.5 * random.direction()).normalized();
    const Vec3 rotated = rotate_into_plane(spring, turned);
    EXPECT_NEAR(rotated.norm(), spring.norm(), 1e-14 * spring.norm());
    EXPECT_NEAR(rotated.dot(turned), 0.0, 1e-14 * spring.norm());
    // no turn about the normal: the projection's direction is kept
    const Vec3 flat = spring - spring.dot(turned) * turned;
    EXPECT_LT(rotated.cross(flat).norm(), 1e-14 * spring.norm() * flat.norm());
    EXPECT_GT(rotated.dot(flat), 0.0);
  }
  EXPECT_EQ(rotate_into_plane(Vec3(0, 0, 1e-7), Vec3::UnitZ()), Vec3(Vec3::Zero()));
  EXPECT_EQ(rotate_into_plane(Vec3::Zero(), Vec3::UnitZ()), Vec3(Vec3::Zero()));
  const Vec3 unchanged(1e-7, -2e-7, 0.0);
  EXPECT_EQ(rotate_into_plane(unchanged, Vec3::UnitZ()), unchanged);
}

// where the plane turns little a series replaces the root, with the same accuracy
TEST(Friction, RotatedSpringsKeepTheirLengthToTheLastDigit)
{
  Random random(60);
  const int springs = 20000;
  double sum = 0.0;
  for (int k = 0; k < springs; k++) {
    const Vec3 normal = random.direction();
    const Vec3 across = normal.cross(random.direction()).normalized();
    // tilt is the square of it, next to where the root is taken
    const double along = random.uniform(0.9, 0.999) * std::sqrt(1e-5);
    const Vec3 spring = across + along * normal;
    sum += rotate_into_plane(spring, normal).norm() / spring.norm() - 1.0;
  }
  // the next term of the series is 0.3 tilt^4; 0.6 tilt^3 would be 5e-16
  EXPECT_LT(std::fabs(sum / springs), 5e-17);
}

// a spring below the smallest normal number counts as 0
TEST(Friction, ASpringWithoutADirectionIsNone)
{
  const Vec3 turned = Vec3(0.6, 0.0, 0.8);
  EXPECT_EQ(rotate_into_plane(Vec3(1e-160, 2e-160, 0.0), Vec3::UnitZ()), Vec3(Vec3::Zero()));
  EXPECT_EQ(rotate_into_plane(Vec3(1e-160, 2e-160, 0.0), turned), Vec3(Vec3::Zero()));
  EXPECT_GT(rotate_into_plane(Vec3(1e-150, 2e-150, 0.0), turned).norm(), 2e-150);
  // and so does the remainder of a spring along the normal
  EXPECT_EQ(rotate_into_plane(Vec3(1e-160, 0.0, 1e-7), Vec3::UnitZ()), Vec3(Vec3::Zero()));
}

// in one step a spring is rotated first, then wound in the new plane, then bounded
TEST(Friction, SpringIsRotatedBeforeItIsWound)
{
  Bodies b;
  b.u = Vec3(0.0, 1.0, 0.0);
  b.overlap = 1e-5;
  b.v_i = Vec3(0.0, 0.0, 0.02);
  History history;
  history.tangential_spring = Vec3(3e-7, 3e-7, 0.0);    // of a normal at 45 degrees
  evaluate(sticky(10.0), b, 1e-6, history);
  EXPECT_LT(deviation(history.tangential_spring, Vec3(3e-7 * std::sqrt(2.0), 0.0, 2e-8)), 1e-14);
}

// |f_t| = bound, along the trial force; spring and dashpot make up the same force again
TEST(Friction, SlidingForceLiesOnTheBoundAndTheNextStepStartsThere)
{
  Random random(24);
  int springs = 0;
  for (int k = 0; k < 2000; k++) {
    Material m = any_material(random);
    Bodies b = any_bodies(random);
    any_motion(random, b);
    b.overlap = random.uniform(0.001, 0.05) * std::min(b.R_i, b.R_j);
    History history;
    history.tangential_spring = random.vector(b.overlap);
    History fresh = history;
    const Outcome out = evaluate(m, b, 1e-6, history);
    ASSERT_LE(out.tangential_force.norm(), out.friction_bound * (1.0 + 1e-14));
    if (!out.sliding) continue;
    ASSERT_NEAR(out.tangential_force.norm(), out.friction_bound, 1e-14 * out.friction_bound);
    // along the trial force
    const Coefficients c = resolve(m.p, m.law);
    const Contact contact = b.contact(1e-6);
    const double kt = contact_scale(c, contact.size).stiffness() * c.kt;
    const Vec3 v = tangential_velocity(contact, contact.velocity.dot(contact.normal));
    const Vec3 trial_spring = wind<double>(fresh.tangential_spring, v, 1e-6, contact);
    const Vec3 dashpot = out.tangential_force + kt * history.tangential_spring;    // -B_t v
    History again = history;
    const Outcome next = evaluate(m, b, 0.0, again);
    if (out.friction_bound == 0.0) {
      ASSERT_EQ(history.tangential_spring.norm(), 0.0);
      ASSERT_EQ(next.tangential_force.norm(), 0.0);
      continue;
    }
    // except the dashpot of a call without time, which sees the present normal
    ASSERT_NEAR(next.tangential_force.norm(), out.friction_bound, 1e-4 * out.friction_bound);
    if (history.tangential_spring.norm() == 0.0) continue;    // the dashpot alone slides
    springs++;
    ASSERT_LT(deviation(next.tangential_force, out.tangential_force), 1e-4);
    const Vec3 trial = -kt * trial_spring + dashpot;
    ASSERT_LT((trial.normalized() - out.tangential_force.normalized()).norm(), 1e-9);
  }
  EXPECT_GT(springs, 100);
}

TEST(Friction, ForceExactlyOnTheBoundDoesNotSlide)
{
  Vec3 spring(0.25, 0.0, 0.0);
  SliderForce f = slider_force(2.0, 0.5, 0.0, 0.5, Vec3::Zero(), spring);
  EXPECT_FALSE(f.sliding);
  EXPECT_EQ(f.force, Vec3(-0.5, 0.0, 0.0));
  f = slider_force(2.0, 0.5, 0.0, 0.25, Vec3::Zero(), spring);
  EXPECT_TRUE(f.sliding);
  EXPECT_EQ(f.force, Vec3(-0.25, 0.0, 0.0));
  EXPECT_EQ(spring, Vec3(0.125, 0.0, 0.0));
}

// a dashpot within the bound leaves the rest to the spring; one beyond the bound leaves no spring
TEST(Friction, SpringAfterSlidingBesideTheDashpot)
{
  const Vec3 v(1.0, 0.0, 0.0);
  Vec3 spring(4.0, 0.0, 0.0);
  SliderForce f = slider_force(2.0, 0.5, 0.5, 3.0, v, spring);
  EXPECT_EQ(f.force, Vec3(-3.0, 0.0, 0.0));
  EXPECT_EQ(spring, Vec3(1.25, 0.0, 0.0));    // -2 * 1.25 - 0.5 = -3
  spring = Vec3(4.0, 0.0, 0.0);
  f = slider_force(2.0, 0.5, 5.0, 3.0, v, spring);
  EXPECT_EQ(f.force, Vec3(-3.0, 0.0, 0.0));
  EXPECT_EQ(spring, Vec3(Vec3::Zero()));
}

TEST(Friction, NoBoundNoForceNoSpring)
{
  Vec3 spring(1e-7, 0.0, 0.0);
  const SliderForce f = slider_force(2.0, 0.5, 0.1, 0.0, Vec3(0.0, 1.0, 0.0), spring);
  EXPECT_EQ(f.force, Vec3(Vec3::Zero()));
  EXPECT_EQ(spring, Vec3(Vec3::Zero()));
  EXPECT_TRUE(f.sliding);
}

TEST(Friction, WithoutTangentialStiffnessTheDashpotAloneIsBounded)
{
  Vec3 spring = Vec3::Zero();
  SliderForce f = slider_force(0.0, 0.0, 0.5, 1.0, Vec3(1.0, 0.0, 0.0), spring);
  EXPECT_EQ(f.force, Vec3(-0.5, 0.0, 0.0));
  f = slider_force(0.0, 0.0, 0.5, 1.0, Vec3(4.0, 0.0, 0.0), spring);
  EXPECT_EQ(f.force, Vec3(-1.0, 0.0, 0.0));
}

// the bound depends on f_hys, never on the dashpot
TEST(Friction, NormalVelocityDoesNotChangeTheBound)
{
  Material m = sticky();
  m.p.restitution = 0.1;
  Bodies b;
  const double still = evaluate(m, b).friction_bound;
  b.v_i = Vec3(-0.5, 0.0, 0.0);
  EXPECT_EQ(evaluate(m, b).friction_bound, still);
  // linear, loading: mu (k1 delta + k_adh delta); f0 drops out
  EXPECT_NEAR(still, 0.5 * (1e3 + 1e3) * b.overlap, 1e-16);
}

// plateau: mu (f_hys + k_adh delta_p) - f0, f0 outside of mu; clamped at 0 for mu > 1
TEST(Friction, BoundOfThePlateauLawAndItsClamp)
{
  Material m = material(Law::plateau, 1e3, 2e3, 1e3, -0.004);
  Bodies b;
  b.overlap = 1e-5;
  EXPECT_NEAR(evaluate(m, b).friction_bound, 0.5 * (0.01 - 0.004 + 0.005) + 0.004, 1e-16);
  m.p.mu = 3.0;
  m.p.k_adh = 0.0;
  m.p.f0 = -0.1;
  const Outcome out = evaluate(m, b);    // 3 (0.01 - 0.1) + 0.1 < 0
  EXPECT_EQ(out.friction_bound, 0.0);
  EXPECT_EQ(out.tangential_force.norm(), 0.0);
}

// `bound contact`: mu f_hys where it presses, f0 included, and nothing where it attracts
TEST(Friction, BoundOfTheContactForceAlone)
{
  for (Law law : {Law::plateau, Law::linear, Law::luding}) {
    Material m = material(law, 1e3, 2e3, 1e3, -0.004);
    m.p.depth = 0.02;
    m.p.bound = FrictionBound::contact;
    Bodies b;
    b.v_i = Vec3(0.0, 100.0, 0.0);
    History history;
    bool attracts = false, presses = false;
    for (double overlap : {2e-6, 3e-5, 2.6e-5, 1e-5, 1e-7}) {
      b.overlap = overlap;
      const Outcome out = evaluate(m, b, 1e-6, history);
      (out.hysteretic_force > 0.0 ? presses : attracts) = true;
      EXPECT_EQ(out.friction_bound, 0.5 * std::max(out.hysteretic_force, 0.0));
      EXPECT_NEAR(out.tangential_force.norm(), out.friction_bound, 1e-15);
    }
    EXPECT_TRUE(attracts && presses);
  }
}
}    // namespace friction_test
