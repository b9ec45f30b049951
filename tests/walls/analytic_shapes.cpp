// SPDX-License-Identifier: GPL-2.0-only

// Planes and cylinder: what spheres touch, how the normal turns, and what they promise of their motion.

#include <eepa_walls/candidates.h>
#include <eepa_walls/cylinder.h>
#include <eepa_walls/placement.h>
#include <eepa_walls/planes.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa;

namespace {

std::vector<SurfacePoint> contacts(const Shape &shape, const Vec3 &centre, double radius)
{
  std::vector<SurfacePiece> pieces;
  std::vector<SurfacePoint> found;
  if (shape.collect(centre, radius, pieces))
    shape.visit(centre, radius, pieces.data(), static_cast<int>(pieces.size()), found);
  return found;
}

TEST(Planes, AreTouchedOnTheirInnerSides)
{
  const Planes both(1, true, true, -1.0, 2.0);
  EXPECT_TRUE(contacts(both, Vec3(5, 0.5, 7), 1.5).empty());
  const auto low = contacts(both, Vec3(5, -0.75, 7), 0.5);
  ASSERT_EQ(low.size(), 1u);
  EXPECT_EQ(low[0].face, Planes::lower);
  EXPECT_EQ(low[0].normal, Vec3(0, 1, 0));
  EXPECT_EQ(low[0].distance, 0.25);
  EXPECT_EQ(low[0].curvature, 0.0);
  const auto narrow = contacts(both, Vec3(5, 0.75, 7), 2.0);
  ASSERT_EQ(narrow.size(), 2u);
  EXPECT_EQ(narrow[1].face, Planes::upper);
  EXPECT_EQ(narrow[1].normal, Vec3(0, -1, 0));
  EXPECT_EQ(narrow[1].distance, 1.25);
  const auto behind = contacts(both, Vec3(0, -3, 0), 0.5);
  ASSERT_EQ(behind.size(), 1u);
  EXPECT_EQ(behind[0].distance, -2.0);
  const Planes upper(1, false, true, 0.0, 2.0);
  EXPECT_TRUE(contacts(upper, Vec3(0, -3, 0), 0.5).empty());
  EXPECT_TRUE(upper.has_face(Planes::upper) && !upper.has_face(Planes::lower));
  EXPECT_FALSE(both.has_face(2) || both.has_face(-1));
}

// A particle is asked for the planes that it may touch, and for no others.
TEST(Planes, AreLookedAtWhileTheyMayBeTouched)
{
  const Planes both(0, true, true, 0.0, 3.0);
  Candidates candidates;
  candidates.add(0, Vec3(1.2, 0, 0), 1.0, 0.5, both,
                 false);    // 0.2 from the lower, 0.8 from the upper
  candidates.add(1, Vec3(1.8, 0, 0), 1.0, 1.0, both,
                 false);    // 0.8 from the lower, 0.2 from the upper
  candidates.add(2, Vec3(1.5, 0, 0), 1.0, 0.4, both, false);
  candidates.add(3, Vec3(-5, 0, 0), 1.0, 0.5, both, false);    // behind
  ASSERT_EQ(candidates.particles(), (std::vector<int>{0, 1, 3}));
  ASSERT_EQ(candidates.piece_count(0), 1);
  ASSERT_EQ(candidates.piece_count(1), 2);
  EXPECT_EQ(candidates.pieces(1)[0].number, Planes::upper);
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(candidates.near_pieces(0, Vec3(1.2 + side * 0.199, 0, 0)), 0);
    EXPECT_EQ(candidates.near_pieces(0, Vec3(1.2 + side * 0.201, 0, 0)), 1);
    EXPECT_EQ(candidates.near_pieces(1, Vec3(1.8, side * 0.201, 0)), 1);
    EXPECT_EQ(candidates.near_pieces(1, Vec3(1.8, 0, side * 0.801)), 2);
  }
  EXPECT_EQ(candidates.near_pieces(2, Vec3(-5, 0, 0)), 1);
}

TEST(Planes, StayInPlaceWhereTheyTurnAboutTheirNormal)
{
  const Planes plane(2, true, false, 0.0, 0.0);
  EXPECT_EQ(plane.extent(Vec3(3, 4, 5), Vec3(0, 0, -1)), 0.0);
  EXPECT_TRUE(std::isinf(plane.extent(Vec3(0, 0, 0), Vec3(0.6, 0, 0.8))));
  EXPECT_EQ(plane.approach(Vec3(3, 4, -0.5)), 0.5);
}

TEST(Cylinder, IsTouchedFromBothSides)
{
  const Cylinder cylinder(2.0);
  const auto inside = contacts(cylinder, Vec3(1.2, 0, 9), 1.0);
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_EQ(inside[0].face, Cylinder::inside);
  EXPECT_EQ(inside[0].normal, Vec3(-1, 0, 0));
  EXPECT_DOUBLE_EQ(inside[0].distance, 0.8);
  const auto outside = contacts(cylinder, Vec3(0, -2.7, 9), 1.0);
  ASSERT_EQ(outside.size(), 1u);
  EXPECT_EQ(outside[0].face, Cylinder::outside);
  EXPECT_EQ(outside[0].normal, Vec3(0, -1, 0));
  EXPECT_NEAR(outside[0].distance, 0.7, 1e-15);
  EXPECT_TRUE(contacts(cylinder, Vec3(0, 0.5, 0), 1.4).empty());
  EXPECT_EQ(cylinder.nearest(Cylinder::inside, Vec3::Zero()).distance, 2.0);
}

TEST(Cylinder, KnowsWhoPassesThroughIt)
{
  const Cylinder cylinder(2.0);
  EXPECT_TRUE(cylinder.is_between(Vec3(1, 0, 0), Vec3(0, 3, 1)));
  EXPECT_TRUE(cylinder.is_between(Vec3(0, 3, 1), Vec3(1, 0, 0)));
  EXPECT_TRUE(cylinder.is_between(Vec3(-3, 1, 0), Vec3(3, 1, 0)));    // in and out again
  EXPECT_FALSE(cylinder.is_between(Vec3(-3, 2.1, 0), Vec3(3, 2.1, 0)));
  EXPECT_FALSE(cylinder.is_between(Vec3(-9, 0, 0), Vec3(-3, 0, 0)));
  EXPECT_FALSE(cylinder.is_between(Vec3(-1.9, 0, 0), Vec3(1.9, 0, 0)));
  EXPECT_EQ(cylinder.extent(Vec3(3, 4, 5), Vec3(0, 0, 1)), 5.0);
  EXPECT_TRUE(std::isinf(cylinder.extent(Vec3::Zero(), Vec3(0, 1, 0))));
  EXPECT_DOUBLE_EQ(cylinder.approach(Vec3(0.3, 0.4, 9)), 0.5);
}

// du/dt against the normals at two positions
TEST(Cylinder, ItsNormalTurnsWithTheMotion)
{
  const Cylinder cylinder(2.0);
  const Vec3 v(0.3, -0.7, 0.4);
  const double h = 1e-5;
  for (const double from_axis : {1.6, 2.4}) {
    const Vec3 x = from_axis * Vec3(0.6, 0.8, 0.5);
    for (const int face : {Cylinder::inside, Cylinder::outside}) {
      const auto at = [&](double time) -> Vec3 {
        return cylinder.nearest(face, x + time * v).normal;
      };
      const Vec3 rate = (at(h) - at(-h)) / (2.0 * h);
      EXPECT_GT(rate.norm(), 0.1);
      EXPECT_LT((cylinder.normal_rate(cylinder.nearest(face, x), x, v) - rate).norm(), 1e-9);
    }
  }
  const Planes plane(2, true, false, 0.0, 0.0);
  EXPECT_EQ(plane.normal_rate(plane.nearest(0, Vec3(1, 2, 0.4)), Vec3(1, 2, 0.4), v),
            Vec3(Vec3::Zero()));
}

/* ---------------------------------------------------------------------- placement */

TEST(Placement, LeavesPointsAloneAtFirst)
{
  Placement placement;
  const Vec3 x(0.1, 0.7, -1.3);
  EXPECT_EQ(placement.to_shape(x), x);
  placement.displacement = Vec3(1, 2, 3);
  EXPECT_EQ(placement.to_shape(x), Vec3(x - Vec3(1, 2, 3)));
  EXPECT_FALSE(placement.is_turned());
}

TEST(Placement, TurnsAboutItsAxisAndGoesOnFromThere)
{
  Placement placement;
  placement.displacement = Vec3(10, 0, 0);
  // a quarter turn about z through (11, 0), then the wall moves by 1 along y, then half a turn
  // about x through the point (11, 1, 0)
  placement.begin_rotation(Vec3(11, 0, 0), Vec3(0, 0, 1));
  placement.turn_to(std::acos(-1.0) / 2);
  placement.displacement += Vec3(0, 1, 0);
  const Vec3 first = placement.to_space(Vec3(2, 0, 5));
  EXPECT_LT((first - Vec3(11, 2, 5)).norm(), 1e-14);
  placement.begin_rotation(Vec3(11, 1, 0), Vec3(1, 0, 0));
  EXPECT_LT((placement.to_space(Vec3(2, 0, 5)) - first).norm(), 1e-14);
  placement.turn_to(std::acos(-1.0));
  EXPECT_LT((placement.to_space(Vec3(2, 0, 5)) - Vec3(11, 0, -5)).norm(), 1e-13);
  EXPECT_LT((placement.to_shape(placement.to_space(Vec3(2, 3, 5))) - Vec3(2, 3, 5)).norm(), 1e-13);
  EXPECT_LT((placement.axis_of_shape() - placement.direction_to_shape(Vec3(1, 0, 0))).norm(),
            1e-15);
  EXPECT_LT((placement.to_space(placement.pivot_of_shape()) - Vec3(11, 1, 0)).norm(), 1e-13);
}

TEST(Placement, VelocityIsTheRateOfItsPoints)
{
  const double h = 1e-6, speed = 0.7;
  const Vec3 y(0.4, -1.2, 2.0), drift(0.2, -0.3, 0.9);
  const auto at = [&](double time) {
    Placement placement;
    placement.displacement = Vec3(0.5, 0.1, 0.0);
    placement.begin_rotation(Vec3(1, 2, 3), Vec3(0.6, 0.0, 0.8));
    placement.displacement += time * drift;
    placement.velocity = drift;
    placement.turn_to(0.3 + speed * time);
    placement.set_angular_velocity(speed);
    return placement;
  };
  const Vec3 rate = (at(h).to_space(y) - at(-h).to_space(y)) / (2.0 * h);
  EXPECT_LT((at(0.0).velocity_at(at(0.0).to_space(y)) - rate).norm(), 1e-9);
}

}    // namespace
