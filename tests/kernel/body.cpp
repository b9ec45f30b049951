// SPDX-License-Identifier: GPL-2.0-only Bodies gathered by a driver are turned into the contact
// that the law sees (contract, sections 1 and 4), one pair at a time and in lanes.

#include "support.h"

namespace body_test {
using namespace eepa_test;

const double dt = 2e-3;

Body<double> first()
{
  return {Vec3(1.0, 2.0, 4.0), Vec3(0.5, -0.2, 0.1), Vec3(3.0, 1.0, -2.0), 2.0, 6.0};
}
Body<double> second()
{
  return {Vec3(-1.0, 1.0, 2.0), Vec3(-0.1, 0.3, 0.4), Vec3(-1.0, 2.0, 5.0), 1.5, 3.0};
}

// their centres lie 3 apart, along (2, 1, 2)/3
void expect_contact_of_pair(const Contact &c)
{
  const Vec3 u(2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0), v(0.6, -0.5, -0.3);
  const double a_i = 2.0 - 0.25, a_j = 1.5 - 0.25;
  EXPECT_DOUBLE_EQ(c.size, 3.5);
  EXPECT_DOUBLE_EQ(c.overlap, 0.5);
  EXPECT_LT(deviation(c.normal, u), 1e-15);
  EXPECT_DOUBLE_EQ(c.effective_mass, 2.0);
  EXPECT_LT(deviation(c.velocity, v), 1e-15);
  EXPECT_DOUBLE_EQ(c.arm_i, a_i);
  EXPECT_DOUBLE_EQ(c.arm_j, a_j);
  EXPECT_LT(deviation(c.spin, a_i * Vec3(3.0, 1.0, -2.0) + a_j * Vec3(-1.0, 2.0, 5.0)), 1e-15);
  EXPECT_LT(deviation(c.turn, 0.5 * dt / 3.0 * (v - v.dot(u) * u)), 1e-14);
  EXPECT_NEAR(c.twist, 0.5 * dt * Vec3(2.0, 3.0, 3.0).dot(u), 1e-17);
}

TEST(Body, TwoParticlesMakeAContact)
{
  const Contact c = contact_of(first(), second(), dt);
  expect_contact_of_pair(c);
  EXPECT_DOUBLE_EQ(c.effective_radius, 3.0 / 3.5);
  EXPECT_LT(deviation(c.angular_velocity, Vec3(4.0, -1.0, -7.0)), 1e-15);
}

struct ReadsLittle {
  static constexpr bool has_couple = false;
  static constexpr bool reads_effective_radius = false;
};

TEST(Body, WhatALawDoesNotReadChangesNothingElse)
{
  expect_contact_of_pair(contact_of<ReadsLittle>(first(), second(), dt));
}

template <class Rolling, class Twisting> bool reads_spin()
{
  using Law = ContactLaw<PlateauLaw, Rolling, Twisting>;
  const Contact c = contact_of<Law>(first(), second(), dt);
  return Law::has_couple && deviation(c.angular_velocity, Vec3(4.0, -1.0, -7.0)) < 1e-15;
}
template <class Normal, class Rolling, class Twisting> bool reads_radius()
{
  using Law = ContactLaw<Normal, Rolling, Twisting>;
  const Contact c = contact_of<Law>(first(), second(), dt);
  return Law::reads_effective_radius && c.effective_radius == 3.0 / 3.5;
}

// each of what reads them is enough
TEST(Body, HasTheSpinAndTheRadiusThatALawReads)
{
  EXPECT_TRUE((reads_spin<RollingConstant, TwistingNone>()));
  EXPECT_TRUE((reads_spin<RollingSds, TwistingNone>()));
  EXPECT_TRUE((reads_spin<RollingNone, TwistingMarshall>()));
  EXPECT_TRUE((reads_radius<PlateauLaw, RollingConstant, TwistingNone>()));
  EXPECT_TRUE((reads_radius<PlateauLaw, RollingNone, TwistingMarshall>()));
  EXPECT_TRUE((reads_radius<LudingLaw, RollingNone, TwistingNone>()));
  using Least = ContactLaw<PlateauLaw, RollingNone, TwistingNone>;
  EXPECT_FALSE(Least::has_couple);
  EXPECT_FALSE(Least::reads_effective_radius);
  EXPECT_FALSE((ContactLaw<LinearLaw<UnitExponent>, RollingNone>::reads_effective_radius));
}

TEST(Body, IsAtRestInASetUp)
{
  const Contact c = contact_of(first(), second(), 0.0);
  EXPECT_EQ(c.turn, Vec3(Vec3::Zero()));
  EXPECT_EQ(c.twist, 0.0);
}

// of which the infinite partner leaves the particle's own mass and radius
TEST(Body, AParticleAndAWallMakeAContact)
{
  const Vec3 u(0.0, 0.6, 0.8);
  const WallPoint<double> wall{u, 0.25, Vec3(0.2, 0.1, -0.3), Vec3(4.0, 3.0, -2.0)};
  const Contact c = contact_at_wall(first(), wall, dt);
  EXPECT_EQ(c.normal, u);
  EXPECT_EQ(c.overlap, 0.25);
  EXPECT_EQ(c.size, 4.0);
  EXPECT_EQ(c.effective_mass, 6.0);
  EXPECT_EQ(c.effective_radius, 2.0);
  EXPECT_LT(deviation(c.velocity, Vec3(0.3, -0.3, 0.4)), 1e-15);
  EXPECT_EQ(c.arm_i, 1.875);
  EXPECT_EQ(c.arm_j, 0.0);
  EXPECT_LT(deviation(c.spin, 1.875 * Vec3(3.0, 1.0, -2.0)), 1e-15);
  EXPECT_EQ(c.angular_velocity, Vec3(3.0, 1.0, -2.0));
  EXPECT_LT(deviation(c.turn, 1e-3 * Vec3(4.0, 3.0, -2.0)), 1e-15);
  EXPECT_NEAR(c.twist, 1e-3 * (0.6 - 1.6), 1e-17);
}

// the particle's motion relative to a wall that turns, and the mean of both about the normal
TEST(Body, AParticleAndATurningWallMakeAContact)
{
  const Vec3 u(0.0, 0.6, 0.8);
  const WallPoint<double> wall{u, 0.25, Vec3(0.2, 0.1, -0.3), Vec3(4.0, 3.0, -2.0),
                               Vec3(1.0, -2.0, 7.0)};
  const Contact c = contact_at_wall(first(), wall, dt);
  EXPECT_LT(deviation(c.velocity, Vec3(0.3, -0.3, 0.4)), 1e-15);
  EXPECT_EQ(c.angular_velocity, Vec3(2.0, 3.0, -9.0));
  EXPECT_LT(deviation(c.spin, 1.875 * Vec3(3.0, 1.0, -2.0)), 1e-15);
  EXPECT_NEAR(c.twist, 1e-3 * (0.6 * (1.0 - 2.0) + 0.8 * (-2.0 + 7.0)), 1e-17);
}

TEST(Body, TouchesAWallInTheMiddleOfTheOverlap)
{
  const Vec3 u(0.0, 0.6, 0.8);
  EXPECT_LT(deviation(middle_of_overlap(first(), u, 0.25),
                      Vec3(1.0, 2.0 - 1.875 * 0.6, 4.0 - 1.875 * 0.8)),
            1e-15);
}

/// A force in the middle of the overlap and a couple, as the particle feels them.
Wrench<double> wrench_at(const Contact &c, const Vec3 &force, const Vec3 &couple)
{
  return {force, couple - c.arm_i * c.normal.cross(force), Vec3::Zero()};
}

// what the wall does is its force by its velocity there and its couple by its angular velocity
TEST(Body, AMovingWallDoesWorkByForceAndCouple)
{
  const Vec3 u(0.0, 0.6, 0.8), force(3.0, -1.0, 2.0), couple(0.5, 0.25, -1.0);
  const WallPoint<double> wall{u, 0.25, Vec3(0.2, 0.1, -0.3), Vec3(4.0, 3.0, -2.0),
                               Vec3(1.0, -2.0, 7.0)};
  const Contact c = contact_at_wall(first(), wall, dt);
  EXPECT_NEAR(power_of_wall(wrench_at(c, force, Vec3::Zero()), c, wall), 0.6 - 0.1 - 0.6, 1e-14);
  EXPECT_NEAR(power_of_wall(wrench_at(c, force, couple), c, wall),
              0.6 - 0.1 - 0.6 + 0.5 - 0.5 - 7.0, 1e-14);
}

// the wall gains what the particle loses of angular momentum, orbital and spin, about any point
TEST(Body, AWallFeelsTheOppositeMoment)
{
  const Vec3 u(0.0, 0.6, 0.8), force(3.0, -1.0, 2.0), couple(0.5, 0.25, -1.0);
  const WallPoint<double> wall{u, 0.25, Vec3::Zero(), Vec3::Zero()};
  const Contact c = contact_at_wall(first(), wall, dt);
  const Vec3 at = middle_of_overlap(first(), u, 0.25);
  for (const Vec3 &about : {at, Vec3(Vec3::Zero()), Vec3(-2.0, 5.0, 1.0)}) {
    const Vec3 on_wall = (at - about).cross(-force) - couple;
    EXPECT_LT(deviation(moment_on_wall(wrench_at(c, force, couple), first().x, about), on_wall),
              1e-14);
  }
}

// a centre lies within the other particle only where the overlap exceeds a radius
TEST(Body, IsTooDeepBeyondTheSmallerRadius)
{
  EXPECT_FALSE(too_deep(0.9, 1.0));
  EXPECT_FALSE(too_deep(1.0, 1.0));
  EXPECT_TRUE(too_deep(1.1, 1.0));
}

#ifdef EEPA_HAS_LANES

Lanes in_lanes(const std::vector<double> &numbers)
{
  return Lanes([&](auto lane) {
    return numbers[lane];
  });
}

/// Checks, for bodies that get larger and faster from lane to lane, that each lane equals the pair
/// alone.
template <class Make> void expect_lanes_as_alone(Make &&make)
{
  const auto grown = [](Body<double> b, double factor) {
    b.x *= factor;
    b.v *= 2.0 * factor;
    b.omega *= 3.0 * factor;
    b.radius *= factor;
    b.mass *= 1.0 + factor;
    return b;
  };
  const auto wide = [&](const Body<double> &b) {
    Body<Lanes> all;
    const auto gather = [&](auto &&number) {
      std::vector<double> numbers;
      for (std::size_t l = 0; l < Lanes::size(); l++)
        numbers.push_back(number(grown(b, 1.0 + 0.1 * static_cast<double>(l))));
      return in_lanes(numbers);
    };
    for (int k = 0; k < 3; k++) {
      all.x[k] = gather([k](const Body<double> &one) {
        return one.x[k];
      });
      all.v[k] = gather([k](const Body<double> &one) {
        return one.v[k];
      });
      all.omega[k] = gather([k](const Body<double> &one) {
        return one.omega[k];
      });
    }
    all.radius = gather([](const Body<double> &one) {
      return one.radius;
    });
    all.mass = gather([](const Body<double> &one) {
      return one.mass;
    });
    return all;
  };
  const ContactOf<Lanes> lanes = make(wide(first()), wide(second()));
  for (std::size_t l = 0; l < Lanes::size(); l++) {
    const double factor = 1.0 + 0.1 * static_cast<double>(l);
    const Contact one = make(grown(first(), factor), grown(second(), factor));
    EXPECT_EQ(lanes.size[l], one.size);
    EXPECT_EQ(lanes.overlap[l], one.overlap);
    EXPECT_EQ(lanes.effective_mass[l], one.effective_mass);
    EXPECT_EQ(lanes.effective_radius[l], one.effective_radius);
    EXPECT_EQ(lanes.arm_i[l], one.arm_i);
    EXPECT_EQ(lanes.arm_j[l], one.arm_j);
    EXPECT_EQ(lanes.twist[l], one.twist);
    for (int k = 0; k < 3; k++) {
      EXPECT_EQ(lanes.normal[k][l], one.normal[k]);
      EXPECT_EQ(lanes.velocity[k][l], one.velocity[k]);
      EXPECT_EQ(lanes.spin[k][l], one.spin[k]);
      EXPECT_EQ(lanes.turn[k][l], one.turn[k]);
      EXPECT_EQ(lanes.angular_velocity[k][l], one.angular_velocity[k]);
    }
  }
}

TEST(Body, EveryLaneIsThePairAlone)
{
  expect_lanes_as_alone([](const auto &i, const auto &j) {
    return contact_of(i, j, dt);
  });
}

#endif

}    // namespace body_test
