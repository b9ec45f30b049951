// SPDX-License-Identifier: GPL-2.0-only
// A plate of triangles is a plane: one contact, the plane's distance and normal.

#include "support.h"

namespace plates_test {
using namespace eepa_walls_test;

/// Moves a centre over a plate of 4 x 3 and back, across edges and corners, and stops over each of
/// those that it is near.
void expect_plane(const MeshShape &shape, int positions, unsigned seed)
{
  Random random(seed);
  const double radius = 0.5;
  Vec3 centre(2, 1.5, 0.45), velocity = 0.01 * random.direction();
  for (int i = 0; i < positions; ++i) {
    centre += velocity;
    velocity = (velocity + 1e-3 * random.direction()).normalized() * 0.01;
    for (int k = 0; k < 2; ++k) centre[k] = std::fabs(centre[k]);
    if (centre[0] > 4) centre[0] = 8 - centre[0];
    if (centre[1] > 3) centre[1] = 6 - centre[1];
    const double side = random.below(2) ? 1.0 : -1.0;
    Vec3 x = centre;
    if (i % 4 == 0) {
      // exactly over a vertex or an edge
      const TriangleMesh &mesh = shape.mesh();
      const auto &corners = mesh.facets[random.below(mesh.count())].corners;
      const Vec3 &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]];
      x = a + (i % 8 == 0 ? 0.0 : random.between(0, 1)) * (b - a);
    }
    x[2] = side * random.between(0.01, 0.499);
    const auto found = contacts(shape, x, radius);
    ASSERT_EQ(found.size(), 1u) << x.transpose();
    EXPECT_EQ(found[0].distance, std::fabs(x[2])) << x.transpose();
    EXPECT_EQ(found[0].normal, Vec3(0, 0, side)) << x.transpose();
    EXPECT_EQ(found[0].curvature, 0.0);
  }
}

TEST(Plate, IsAPlaneWhateverItsTriangles)
{
  expect_plane(plate(4, 3, 1, 1).shape(), 100000, 1);
  expect_plane(plate(4, 3, 10, 10).shape(), 100000, 2);
  expect_plane(plate(4, 3, 100, 100).shape(), 2000, 3);
  Random random(5);
  expect_plane(plate(4, 3, 12, 9, &random).shape(), 100000, 4);
}

/// A fan of triangles around a point of a plate of 4 x 3, which become slivers.
Soup fan(int n, const Vec3 &hub)
{
  std::vector<Vec3> rim;
  const Vec3 corners[] = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(4, 3, 0), Vec3(0, 3, 0)};
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < n; ++i)
      rim.push_back(corners[side] + (corners[(side + 1) % 4] - corners[side]) * i / n);
  Soup s;
  for (std::size_t i = 0; i < rim.size(); ++i) s.add(hub, rim[i], rim[(i + 1) % rim.size()]);
  return s;
}

TEST(Plate, OfAFanOfSlivers)
{
  expect_plane(fan(1, Vec3(2, 1.5, 0)).shape(), 30000, 6);
  expect_plane(fan(100, Vec3(1.1, 0.7, 0)).shape(), 3000, 7);
  expect_plane(fan(3000, Vec3(1.1, 0.7, 0)).shape(), 200, 8);
}

TEST(Plate, WithCornersOnTheEdgesOfOtherTriangles)
{
  // neighbouring strips that are cut at places of their own, random or a multiple of each other's
  for (const bool anywhere : {false, true}) {
    Random random(9);
    Soup s;
    for (int strip = 0; strip < 6; ++strip) {
      Random own(10 + strip);
      s.append(plate(4, 0.5, anywhere ? 3 + strip : 1 << (strip % 3), 1, anywhere ? &own : nullptr)
                   .moved([&](const Vec3 &p) {
                     return Vec3(p[0], p[1] + 0.5 * strip, 0);
                   }));
    }
    const MeshShape shape = s.shape();
    EXPECT_EQ(shape.mesh().findings[0].kind, MeshDefect::open_edge);
    expect_plane(shape, 100000, 11);
  }
}

TEST(Plate, AnyWayUpAndInAnyPlace)
{
  Random random(12);
  const Soup flat = plate(4, 3, 7, 6, &random);
  Soup slivers = fan(100, Vec3(1.1, 0.7, 0));
  for (int i = 0; i < 6; ++i) {
    const Vec3 axis = random.direction();
    const double angle = random.between(0, 360);
    const MeshTransformation place = {1.0, axis, angle, random.vector(10.0)};
    const PointTransformation transform(place);
    const bool narrow = i % 2;
    const MeshShape shape(TriangleMesh((narrow ? slivers : flat).stl(), place));
    const Vec3 normal = transform.rotate(Vec3(0, 0, 1));
    // corners are off by the last digit of their coordinates, and the normal of a narrow triangle by that
    // over its width
    const double rounding = 2e-14, turned = narrow ? 2e-13 : 1e-14;
    for (int k = 0; k < 20000; ++k) {
      const double x = random.between(0, 4), y = random.between(0, 3);
      const double z = random.between(-0.499, 0.499);
      const auto found = contacts(shape, transform(Vec3(x, y, z)), 0.5);
      ASSERT_EQ(found.size(), 1u) << x << " " << y << " " << z;
      ASSERT_NEAR(found[0].distance, std::fabs(z), rounding);
      const Vec3 side = z < 0 ? Vec3(-normal) : normal;
      if (std::fabs(z) > 0.01) { ASSERT_LE(largest_difference(found[0].normal, side), turned); }
    }
  }
}

TEST(Plate, OfAFileInSinglePrecisionIsOneContactToo)
{
  // corners off the plane by the rounding of the file, narrow triangles by degrees
  Random random(13);
  for (int i = 0; i < 10; ++i) {
    const Vec3 axis = random.direction();
    const PointTransformation transform({1.0, axis, random.between(0, 360), random.vector(1)});
    Soup s = i % 2 ? fan(100, Vec3(1.1, 0.7, 0)) : plate(4, 3, 40, 30, &random);
    s = s.moved([&](const Vec3 &p) {
      const Vec3 q = transform(p);
      return Vec3(static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]));
    });
    const MeshShape shape = s.shape();
    for (int k = 0; k < 10000; ++k) {
      const double x = random.between(0, 4), y = random.between(0, 3);
      const double z = random.between(-0.499, 0.499);
      const auto found = contacts(shape, transform(Vec3(x, y, z)), 0.5);
      ASSERT_EQ(found.size(), 1u) << i << " " << x << " " << y << " " << z;
      ASSERT_NEAR(found[0].distance, std::fabs(z), 1e-6);
    }
  }
}

}    // namespace plates_test
