// SPDX-License-Identifier: GPL-2.0-only
// What has gone through a mesh.

#include "support.h"

namespace crossing_test {
using namespace eepa_walls_test;

/// A closed surface around its middle: the faces of a cube, cut up and blown up, in a random place.
MeshShape lump(unsigned seed)
{
  Random random(seed);
  const Vec3 axis = random.direction();
  const double angle = random.between(0, 360);
  const MeshTransformation place = {1.0, axis, angle, random.vector(1.0)};
  Soup s;
  for (int k = 0; k < 3; ++k)
    for (const double side : {-1.0, 1.0})
      s.append(plate(2, 2, 6, 6).moved([&](const Vec3 &p) {
        // uneven, and the same on all faces, which so share their edges
        const auto uneven = [](double u) {
          return u + 0.3 * u * (1.0 - u * u);
        };
        Vec3 q;
        q[k] = side;
        q[(k + 1) % 3] = uneven(p[0] - 1.0);
        q[(k + 2) % 3] = uneven(p[1] - 1.0);
        return Vec3(q / std::sqrt(q.norm()));
      }));
  return MeshShape(TriangleMesh(s.stl(), place));
}

TEST(IsBetween, OfPointsInsideAndOutsideOfAClosedSurface)
{
  const MeshShape shape = lump(1);
  for (const MeshFinding &finding : shape.mesh().findings)
    EXPECT_EQ(finding.kind, MeshDefect::opposite) << finding.text();
  const Vec3 centre = 0.5 * (shape.mesh().low + shape.mesh().high);
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 inside = centre + random.vector(0.2), outside = centre + 5 * random.direction();
    ASSERT_TRUE(shape.is_between(inside, outside));
    ASSERT_TRUE(shape.is_between(outside, inside));
    ASSERT_FALSE(shape.is_between(inside, centre + random.vector(0.2)));
  }
}

TEST(IsBetween, NothingSlipsThroughEdgesAndCorners)
{
  for (const unsigned seed : {3u, 4u, 5u}) {
    const MeshShape shape = lump(seed);
    const TriangleMesh &mesh = shape.mesh();
    const Vec3 centre = 0.5 * (mesh.low + mesh.high);
    Random random(seed);
    for (int i = 0; i < 20000; ++i) {
      // aimed at a vertex or at a point of an edge, to rounding
      const auto &corners = mesh.facets[random.below(mesh.count())].corners;
      const Vec3 &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]];
      const Vec3 aim = i % 2 ? a : Vec3(a + random.between(0, 1) * (b - a));
      const Vec3 inside = centre + random.vector(0.1);
      const Vec3 outside = inside + random.between(1.5, 8) * (aim - inside);
      ASSERT_TRUE(shape.is_between(inside, outside)) << i;
    }
  }
}

TEST(IsBetween, NothingSlipsThroughInManySteps)
{
  const MeshShape shape = lump(6);
  const TriangleMesh &mesh = shape.mesh();
  const Vec3 centre = 0.5 * (mesh.low + mesh.high);
  Random random(7);
  for (int i = 0; i < 500; ++i) {
    const auto &corners = mesh.facets[random.below(mesh.count())].corners;
    const Vec3 &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]];
    const double part = i % 3 == 0 ? 0.0 : random.between(0, 1);
    Vec3 x = centre, aim = a + part * (b - a);
    // also with a step that ends on the surface to rounding
    const int steps = 1 + random.below(20);
    const Vec3 step = (aim - centre) / steps;
    int crossings = 0;
    for (int k = 0; k < 3 * steps; ++k) {
      const Vec3 next = x + step;
      crossings += shape.is_between(x, next);
      x = next;
    }
    ASSERT_GE(crossings, 1) << i;
    // what ends on the surface is on both sides
    ASSERT_LE(crossings, 2) << i;
  }
}

TEST(IsBetween, OfOneTriangleAndOfTheThinPlate)
{
  Soup s;
  s.add(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const MeshShape one = s.shape();
  EXPECT_TRUE(one.is_between(Vec3(0.2, 0.2, 0.1), Vec3(0.2, 0.2, -0.1)));
  EXPECT_FALSE(one.is_between(Vec3(0.2, 0.2, 0.1), Vec3(0.2, 0.2, 0.2)));
  EXPECT_FALSE(one.is_between(Vec3(0.9, 0.9, 0.1), Vec3(0.9, 0.9, -0.1)));
  const MeshShape thin = box(Vec3(0, 0, 0), Vec3(4, 4, 1e-3)).shape();
  EXPECT_TRUE(thin.is_between(Vec3(1, 1, 0.1), Vec3(1, 1, -0.1)));
}

TEST(Candidates, AreEnoughWhileTheCentreStaysWithinTheReach)
{
  Random random(8);
  const MeshShape shape = lump(9);
  std::vector<SurfacePiece> all(shape.mesh().count());
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = {static_cast<int>(t), 0.0f};
  int contacts_seen = 0, left_out = 0;
  std::vector<SurfacePiece> pieces = {{-7, 0.0f}};
  std::vector<SurfacePoint> some, whole;
  for (int i = 0; i < 3000; ++i) {
    const double radius = random.between(0.05, 0.4), margin = random.between(0, 0.2);
    const Vec3 centre = 0.5 * (shape.mesh().low + shape.mesh().high) + random.vector(1.5);
    pieces.resize(1);
    const bool any = shape.collect(centre, radius + margin, pieces);
    ASSERT_EQ(any, pieces.size() > 1);
    ASSERT_EQ(pieces[0].number, -7);
    for (std::size_t p = 1; p < pieces.size(); ++p) {
      const double distance = shape.nearest(pieces[p].number, centre).distance;
      ASSERT_LE(pieces[p].distance, distance);
      ASSERT_NEAR(pieces[p].distance, distance, 1e-6);
      ASSERT_LE(pieces[p - 1].distance, pieces[p].distance);
    }
    Candidates candidates;
    candidates.add(i, centre, radius, margin, shape, false);
    ASSERT_EQ(candidates.count(), any ? 1u : 0u);
    for (int k = 0; k < 5; ++k) {
      const Vec3 x = centre + (k == 4 ? margin : random.between(0, margin)) * random.direction();
      some.clear();
      whole.clear();
      if (any) {
        const int near = candidates.near_pieces(0, x);
        ASSERT_LE(near, candidates.piece_count(0));
        left_out += candidates.piece_count(0) - near;
        shape.visit(x, radius, candidates.pieces(0), near, some);
      }
      shape.visit(x, radius, all.data(), static_cast<int>(all.size()), whole);
      ASSERT_EQ(some.size(), whole.size());
      for (std::size_t c = 0; c < some.size(); ++c) {
        ASSERT_EQ(some[c].face, whole[c].face);
        ASSERT_EQ(some[c].distance, whole[c].distance);
        ASSERT_EQ(some[c].normal, whole[c].normal);
      }
      contacts_seen += static_cast<int>(some.size());
    }
  }
  EXPECT_GT(contacts_seen, 1000);
  EXPECT_GT(left_out, 10000);
}

TEST(Candidates, AreThoseWithinTheReachAndNoOthers)
{
  const MeshShape shape = plate(4, 3, 40, 30).shape();
  std::vector<SurfacePiece> pieces;
  EXPECT_FALSE(shape.collect(Vec3(2, 1, 0.5), 0.4999, pieces));
  EXPECT_FALSE(shape.collect(Vec3(1e9, 1, 0.5), 1, pieces));
  EXPECT_TRUE(shape.collect(Vec3(2.05, 1.02, 0.5), 0.50001, pieces));
  EXPECT_EQ(pieces.size(), 1u);
  pieces.clear();
  EXPECT_TRUE(shape.collect(Vec3(2, 1, 0.5), 10, pieces));
  EXPECT_EQ(pieces.size(), 2400u);
}

TEST(Extent, IsThatOfTheFurthestVertex)
{
  const MeshShape shape = box(Vec3(0, 0, 0), Vec3(3, 4, 5)).shape();
  EXPECT_NEAR(shape.extent(Vec3(0, 0, 0), Vec3(0, 0, 1)), 5.0, 1e-15);
  EXPECT_NEAR(shape.extent(Vec3(3, 4, 0), Vec3(1, 0, 0)), std::sqrt(41.0), 1e-15);
}

TEST(Faces, AreTriangles)
{
  const MeshShape shape = box(Vec3(0, 0, 0), Vec3(3, 4, 5)).shape();
  EXPECT_TRUE(shape.has_face(0) && shape.has_face(11));
  EXPECT_FALSE(shape.has_face(-1) || shape.has_face(12));
  // the number that tells meshes apart in restart files
  EXPECT_EQ(shape.check(), box(Vec3(0, 0, 0), Vec3(3, 4, 5)).shape().check());
  EXPECT_NE(shape.check(), box(Vec3(0, 0, 0), Vec3(6, 4, 5)).shape().check());
  Soup other = box(Vec3(0, 0, 0), Vec3(3, 4, 5));
  std::swap(other.triangles[3], other.triangles[4]);
  EXPECT_NE(shape.check(), other.shape().check());
  EXPECT_GE(shape.check(), 0.0);
  EXPECT_LT(shape.check(), 0x1p53);
}

}    // namespace crossing_test
