// SPDX-License-Identifier: GPL-2.0-only
// One triangle: its nearest point, and whether a segment meets it.

#include "support.h"

namespace triangle_test {
using namespace eepa_walls_test;

Triangle triangle(const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  return {{a, b, c}, area_vector(a, b, c).normalized()};
}

double longest_edge(const Triangle &t)
{
  return std::max({(t.corner[1] - t.corner[0]).norm(), (t.corner[2] - t.corner[1]).norm(),
                   (t.corner[0] - t.corner[2]).norm()});
}

/// The nearest point of a convex set is the one point of it from which the set lies behind the plane
/// normal to the way to x: (x - p).(v - p) <= 0 for all corners v.
void expect_nearest(const Vec3 &x, const Triangle &t)
{
  const TrianglePoint p = closest_point(x, t);
  const double size = longest_edge(t) + p.distance;
  const Vec3 away = x - p.point;
  ASSERT_NEAR(away.norm(), p.distance, 4e-15 * size);
  for (const Vec3 &corner : t.corner)
    ASSERT_LE(away.dot(corner - p.point), 1e-14 * size * size) << static_cast<int>(p.feature);
  // and it belongs to the triangle: its barycentric coordinates, of the two shorter edges
  const Vec3 total = area_vector(t.corner[0], t.corner[1], t.corner[2]);
  const double width = total.norm() / longest_edge(t);
  // A foot counts as inside that is beyond an edge by less than the distance tells; that is as wrong as the normal.
  const double wrong = 2e-15 * p.distance + 1e-15 * size * size / width;
  const double beyond =
      1e-14 * size + (p.feature == Feature::inside ? std::sqrt(2 * p.distance * wrong) : 0.0);
  for (int k = 0; k < 3; ++k) {
    const Vec3 &q = t.corner[k], &r = t.corner[(k + 1) % 3];
    const double part = cross(r - q, p.point - q).dot(total) / total.squaredNorm();
    ASSERT_GE(part, -beyond / width) << k;
  }
}

TEST(ClosestPoint, IsThatOfAConvexSet)
{
  Random random(1);
  int inside = 0, edge = 0, corner = 0;
  for (int i = 0; i < 100000; ++i) {
    const Triangle t = triangle(random.vector(1), random.vector(1), random.vector(1));
    if (area_vector(t.corner[0], t.corner[1], t.corner[2]).norm() < 1e-3) continue;
    const Vec3 x = random.vector(1.5);
    expect_nearest(x, t);
    if (HasFatalFailure()) return;
    const Feature feature = closest_point(x, t).feature;
    inside += feature == Feature::inside;
    edge += feature == Feature::edge;
    corner += feature == Feature::corner;
  }
  EXPECT_GT(inside, 5000);
  EXPECT_GT(edge, 5000);
  EXPECT_GT(corner, 5000);
}

TEST(ClosestPoint, OfSliversToo)
{
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const Vec3 a = random.vector(1), along = random.direction();
    const double width = std::pow(10.0, random.between(-6, -1));
    // needles with one short edge, and caps with a corner next to the middle of an edge
    const Vec3 b = a + along;
    const Vec3 c =
        (i % 2 ? b : Vec3(a + random.between(0, 1) * along)) + width * random.direction();
    const Triangle t = triangle(a, b, c);
    if (!(area_vector(a, b, c).norm() > 0.1 * width)) continue;
    const Vec3 near = a + random.between(-0.1, 1.1) * along;
    expect_nearest(near + std::pow(10.0, random.between(-6, 0)) * random.direction(), t);
    if (HasFatalFailure()) return;
  }
}

TEST(ClosestPoint, IsNearerThanAnyOther)
{
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Triangle t = triangle(random.vector(1), random.vector(1), random.vector(1));
    const Vec3 x = random.vector(1.5);
    const double distance = closest_point(x, t).distance;
    for (int k = 0; k < 100; ++k) {
      double u = random.between(0, 1), v = random.between(0, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 other =
          t.corner[0] + u * (t.corner[1] - t.corner[0]) + v * (t.corner[2] - t.corner[0]);
      ASSERT_LE(distance, (x - other).norm() + 1e-15);
    }
  }
}

TEST(ClosestPoint, NamesItsPlace)
{
  const Triangle t = triangle(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0));
  const auto place = [&](double x, double y) {
    const TrianglePoint p = closest_point(Vec3(x, y, 3), t);
    return std::make_pair(p.feature, p.number);
  };
  EXPECT_EQ(place(0.5, 0.5).first, Feature::inside);
  EXPECT_EQ(place(0.5, -1), std::make_pair(Feature::edge, 0));
  EXPECT_EQ(place(2, 2), std::make_pair(Feature::edge, 1));
  EXPECT_EQ(place(-1, 0.5), std::make_pair(Feature::edge, 2));
  EXPECT_EQ(place(-1, -1), std::make_pair(Feature::corner, 0));
  EXPECT_EQ(place(4, -1), std::make_pair(Feature::corner, 1));
  EXPECT_EQ(place(-1, 4), std::make_pair(Feature::corner, 2));
  // on the boundary to rounding: a face, so that the edges of a plate do not show
  EXPECT_EQ(place(0.5, 0).first, Feature::inside);
  EXPECT_EQ(place(0.5, -1e-9).first, Feature::inside);
  EXPECT_EQ(place(0.5, -1e-6).first, Feature::edge);
  EXPECT_EQ(closest_point(Vec3(0.5, 0.5, -3), t).height, -3.0);
}

TEST(ClosestPoint, OfASharedEdgeHasTheSameBits)
{
  Random random(4);
  int edges = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 p = random.vector(1), q = random.vector(1);
    const Triangle one = triangle(p, q, random.vector(1)), other = triangle(q, p, random.vector(1));
    const Vec3 x = random.vector(1.5);
    const TrianglePoint a = closest_point(x, one), b = closest_point(x, other);
    if (a.feature != Feature::edge || a.number != 0) continue;
    if (b.feature != Feature::edge || b.number != 0) continue;
    ++edges;
    ASSERT_EQ(a.point, b.point);
    ASSERT_EQ(a.distance, b.distance);
  }
  EXPECT_GT(edges, 100);
}

TEST(ClosestPoint, OfAPlateAlongAnAxisHasTheBitsOfAPlane)
{
  Random random(5);
  for (int i = 0; i < 10000; ++i) {
    const int axis = i % 3;
    const double height = random.between(-3, 3);
    const auto corner = [&] {
      Vec3 v = random.vector(2);
      v[axis] = height;
      return v;
    };
    const Triangle t = triangle(corner(), corner(), corner());
    const Vec3 x = random.vector(2);
    const TrianglePoint p = closest_point(x, t);
    ASSERT_EQ(std::fabs(t.normal[axis]), 1.0);
    if (p.feature == Feature::inside) { ASSERT_EQ(p.distance, std::fabs(x[axis] - height)); }
  }
}

TEST(Crosses, FromOneSideToTheOther)
{
  const Triangle t = triangle(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0));
  const auto meets = [&](const Vec3 &a, const Vec3 &b) {
    const bool found = crosses(a, b, t, 1e-15);
    EXPECT_EQ(found, crosses(b, a, t, 1e-15));
    return found;
  };
  EXPECT_TRUE(meets(Vec3(0.5, 0.5, 1), Vec3(0.6, 0.5, -1)));
  EXPECT_FALSE(meets(Vec3(0.5, 0.5, 1), Vec3(0.6, 0.5, 0.1)));
  EXPECT_FALSE(meets(Vec3(0.5, 0.5, -1), Vec3(0.6, 0.5, -0.1)));
  EXPECT_FALSE(meets(Vec3(1.5, 1.5, 1), Vec3(1.5, 1.5, -1)));
  EXPECT_FALSE(meets(Vec3(-3, 0.5, 1), Vec3(-1, 0.5, -1)));
  // through an edge, through a corner, and up to the surface
  EXPECT_TRUE(meets(Vec3(0.5, 0, 1), Vec3(0.5, 0, -1)));
  EXPECT_TRUE(meets(Vec3(2, 0, 1), Vec3(2, 0, -1)));
  EXPECT_TRUE(meets(Vec3(0.5, 0.5, 1), Vec3(0.6, 0.5, 0)));
  EXPECT_FALSE(meets(Vec3(0.5, 0.5, 1), Vec3(0.5, 0.5, 1)));
  // within the plane: neighbours are met, or nothing is
  EXPECT_FALSE(meets(Vec3(-1, 0.5, 0), Vec3(3, 0.5, 0)));
}

}    // namespace triangle_test
