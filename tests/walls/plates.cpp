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
      const auto &corners = mesh.corners[random.below(mesh.count())];
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
  expect_plane(plate(4, 3, 1, 1).shape(), 10000, 1);
  expect_plane(plate(4, 3, 10, 10).shape(), 10000, 2);
  expect_plane(plate(4, 3, 100, 100).shape(), 1000, 3);
  Random random(5);
  expect_plane(plate(4, 3, 12, 9, &random).shape(), 10000, 4);
}

TEST(Box, HasAContactForEachFaceFromInsideAndOneFromOutside)
{
  const MeshShape shape = box(Vec3(0, 0, 0), Vec3(4, 5, 6)).shape();
  EXPECT_EQ(shape.mesh().count(), 12);
  EXPECT_TRUE(shape.mesh().findings.empty());
  EXPECT_EQ(contacts(shape, Vec3(2, 2, 3), 0.5).size(), 0u);
  EXPECT_EQ(contacts(shape, Vec3(2, 2, 0.4), 0.5).size(), 1u);
  EXPECT_EQ(contacts(shape, Vec3(2, 0.45, 0.4), 0.5).size(), 2u);
  EXPECT_EQ(contacts(shape, Vec3(3.6, 0.45, 0.4), 0.5).size(), 3u);
  EXPECT_EQ(contacts(shape, Vec3(2, 2, -0.4), 0.5).size(), 1u);
  const auto edge = contacts(shape, Vec3(2, -0.3, -0.3), 0.5);
  ASSERT_EQ(edge.size(), 1u);
  EXPECT_NEAR(edge[0].distance, 0.3 * std::sqrt(2.0), 1e-15);
  EXPECT_LE(largest_difference(edge[0].normal, Vec3(0, -1, -1).normalized()), 1e-15);
  EXPECT_NEAR(edge[0].curvature, 1.0 / edge[0].distance, 1e-15);
  EXPECT_LE(largest_difference(edge[0].straight.cwiseAbs(), Vec3(1, 0, 0)), 1e-15);
  const auto corner = contacts(shape, Vec3(-0.2, -0.2, -0.2), 0.5);
  ASSERT_EQ(corner.size(), 1u);
  EXPECT_NEAR(corner[0].distance, 0.2 * std::sqrt(3.0), 1e-15);
  EXPECT_EQ(corner[0].straight, Vec3(0, 0, 0));
}

}    // namespace plates_test
