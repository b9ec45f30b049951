// SPDX-License-Identifier: GPL-2.0-only
// Which contacts a sphere has with bodies of several faces.

#include "support.h"

namespace bodies_test {
using namespace eepa_walls_test;

TEST(Box, HasAContactForEachFaceFromInside)
{
  const Vec3 size(4, 5, 6);
  const MeshShape shape = box(Vec3(0, 0, 0), size).shape();
  EXPECT_EQ(shape.mesh().count(), 12);
  EXPECT_TRUE(shape.mesh().findings.empty());
  Random random(1);
  int seen[4] = {0, 0, 0, 0};
  for (int i = 0; i < 100000; ++i) {
    const double radius = random.between(0.1, 1.9);
    Vec3 x;
    for (int k = 0; k < 3; ++k) x[k] = random.between(0.05, size[k] - 0.05);
    // the planes that it touches, in the order of planes
    std::vector<SurfacePoint> expected;
    for (int k = 0; k < 3; ++k)
      for (const bool high : {false, true}) {
        SurfacePoint p;
        p.distance = high ? size[k] - x[k] : x[k];
        p.normal[k] = high ? -1.0 : 1.0;
        if (p.distance < radius) expected.push_back(p);
      }
    auto found = contacts(shape, x, radius);
    ASSERT_EQ(found.size(), expected.size()) << x.transpose() << " " << radius;
    for (const SurfacePoint &e : expected) {
      const auto same = std::find_if(found.begin(), found.end(), [&](const SurfacePoint &p) {
        return p.normal == e.normal;
      });
      ASSERT_NE(same, found.end());
      EXPECT_EQ(same->distance, e.distance);
      EXPECT_EQ(same->curvature, 0.0);
    }
    if (found.size() < 4) ++seen[found.size()];
  }
  for (const int n : seen) EXPECT_GT(n, 100);
}

TEST(Box, HasOneContactFromOutsideWithAContinuousDistance)
{
  const Vec3 size(4, 5, 6);
  const MeshShape shape = box(Vec3(0, 0, 0), size).shape();
  Random random(2);
  int faces = 0, edges = 0, corners = 0;
  for (int i = 0; i < 100000; ++i) {
    const double radius = random.between(0.1, 1.9);
    Vec3 x;
    for (int k = 0; k < 3; ++k) x[k] = random.between(-1, size[k] + 1);
    const Vec3 nearest = x.cwiseMax(Vec3(0, 0, 0)).cwiseMin(size);
    const double distance = (x - nearest).norm();
    if (distance == 0.0) continue;    // inside
    const auto found = contacts(shape, x, radius);
    if (distance >= radius) {
      ASSERT_TRUE(found.empty());
      continue;
    }
    // the opposite face, seen through the box, is far
    ASSERT_EQ(found.size(), 1u) << x.transpose();
    ASSERT_NEAR(found[0].distance, distance, 1e-15);
    ASSERT_LE(largest_difference(found[0].normal, (x - nearest) / distance), 1e-14 / distance);
    const int outside = static_cast<int>(((x - nearest).array() != 0.0).count());
    faces += outside == 1;
    edges += outside == 2;
    corners += outside == 3;
    if (outside == 1)
      ASSERT_EQ(found[0].curvature, 0.0);
    else
      ASSERT_NEAR(found[0].curvature * distance, 1.0, 1e-14);
    Vec3 straight = Vec3::Zero();
    if (outside == 2)
      for (int k = 0; k < 3; ++k) straight[k] = x[k] == nearest[k];
    ASSERT_LE(largest_difference(found[0].straight.cwiseAbs(), straight), 1e-15);
  }
  EXPECT_GT(faces, 1000);
  EXPECT_GT(edges, 1000);
  EXPECT_GT(corners, 1000);
}

TEST(Box, HasOneContactNextToTheLinesWhereFacesEnd)
{
  // the feet of two faces, or of a face and of an edge, agree to rounding
  const MeshShape shape = box(Vec3(0, 0, 0), Vec3(1, 1, 1)).shape();
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const double offset = std::pow(10.0, random.between(-18, -5)) * (random.below(2) ? 1 : -1);
    const double other = std::pow(10.0, random.between(-18, -5)) * (random.below(2) ? 1 : -1);
    const double height = 1.0 + random.between(0.01, 0.2);
    const Vec3 x = i % 2 ? Vec3(1.0 + offset, random.between(0, 1), height)
                         : Vec3(1.0 + offset, other, height);
    const auto found = contacts(shape, x, 0.25);
    ASSERT_EQ(found.size(), 1u) << offset << " " << other;
    ASSERT_NEAR(found[0].distance, height - 1.0, 1e-8);
    ASSERT_LE(largest_difference(found[0].normal, Vec3(0, 0, 1)), 1e-3);
  }
}

TEST(Prism, ConvergesToACylinderWithOneContact)
{
  const double radius = 2.0;
  Random random(4);
  for (const int facets : {30, 48, 200, 1000}) {
    const MeshShape shape = prism(facets, radius, -3, 3, facets < 100 ? 5 : 1).shape();
    // chords lie inside of the circle by this at most
    const double sagitta = radius * (1.0 - std::cos(M_PI / facets));
    for (int i = 0; i < 5000; ++i) {
      const double angle = random.between(0, 2 * M_PI);
      const double r = i % 2 ? random.between(1.2, 1.95) : random.between(2.05, 2.8);
      const double gap = std::fabs(r - radius);
      // up to a large overlap, with many facets
      const double sphere = gap * (1.0 + std::pow(10.0, random.between(-3, 0))) + sagitta;
      if (r < radius && sphere > 0.9 * radius) continue;
      const Vec3 radial(std::cos(angle), std::sin(angle), 0);
      const Vec3 x = r * radial + Vec3(0, 0, random.between(-1, 1));
      const auto found = contacts(shape, x, sphere);
      ASSERT_EQ(found.size(), 1u) << facets << " " << x.transpose() << " " << sphere;
      ASSERT_NEAR(found[0].distance, gap, 1.01 * sagitta);
      const Vec3 normal = r < radius ? Vec3(-radial) : radial;
      ASSERT_GE(found[0].normal.dot(normal),
                std::cos(1.01 * M_PI / facets * std::max(1.0, radius / gap)));
    }
  }
}

TEST(Prism, WithFewFacetsHasTwoContactsAtAConcaveEdge)
{
  const MeshShape shape = prism(8, 2.0, -3, 3).shape();
  const double toward_edge = 2.0 - 0.5 / std::cos(M_PI / 8);
  EXPECT_EQ(contacts(shape, Vec3(toward_edge, 0, 0.3), 0.55).size(), 2u);
  EXPECT_EQ(contacts(shape, Vec3(2.3, 0, 0.3), 0.55).size(), 1u);
  // the same where a larger angle counts as smooth
  EXPECT_EQ(contacts(prism(8, 2.0, -3, 3).shape(46), Vec3(toward_edge, 0, 0.3), 0.55).size(), 1u);
}

TEST(Prism, OfThirtyFacetsIsSmoothInAFileOfSinglePrecisionToo)
{
  const MeshShape shape(TriangleMesh(prism(30, 2.0, -3, 3)
                                         .moved([](const Vec3 &p) {
                                           return Vec3(static_cast<float>(p[0]),
                                                       static_cast<float>(p[1]),
                                                       static_cast<float>(p[2]));
                                         })
                                         .stl()));
  for (std::size_t e = 0; e < shape.mesh().edges.size(); ++e)
    EXPECT_EQ(shape.is_smooth(static_cast<int>(e)), shape.mesh().edges[e].count == 2);
}

TEST(ThinPlate, IsTouchedOnTheSideWhereTheSphereIs)
{
  const MeshShape shape = box(Vec3(0, 0, 0), Vec3(4, 4, 0.1)).shape();
  Random random(5);
  for (int i = 0; i < 10000; ++i) {
    const double height = random.between(0.41, 0.5);
    const double x = random.between(0, 4), y = random.between(0, 4);
    const auto above = contacts(shape, Vec3(x, y, 0.1 + height), 0.5);
    const auto below = contacts(shape, Vec3(x, y, -height), 0.5);
    ASSERT_EQ(above.size(), 1u);
    ASSERT_EQ(below.size(), 1u);
    EXPECT_EQ(above[0].normal, Vec3(0, 0, 1));
    EXPECT_EQ(below[0].normal, Vec3(0, 0, -1));
    EXPECT_NE(above[0].face, below[0].face);
  }
}

TEST(Groove, HasTwoContactsAndNoThirdAtItsEdge)
{
  // an L, from its inner side; and the other sides of both plates
  const MeshShape shape = drawn_out({Vec3(4, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 4)}, 0, 4, 7).shape();
  Random random(6);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x(random.between(0.01, 0.49), random.between(0, 4), random.between(0.01, 0.49));
    const auto found = contacts(shape, x, 0.5);
    ASSERT_EQ(found.size(), 2u) << x.transpose();
    const bool first = found[0].normal[0] == 1.0;
    EXPECT_EQ(found[first ? 0 : 1].normal, Vec3(1, 0, 0));
    EXPECT_EQ(found[first ? 0 : 1].distance, x[0]);
    EXPECT_EQ(found[first ? 1 : 0].normal, Vec3(0, 0, 1));
    EXPECT_EQ(found[first ? 1 : 0].distance, x[2]);
    // around the edge from outside
    const Vec3 outside = -x * random.between(0.1, 0.7);
    ASSERT_EQ(contacts(shape, Vec3(outside[0], x[1], outside[2]), 0.5).size(), 1u);
  }
}

TEST(Stairs, HaveEachTreadRiserAndNosing)
{
  const MeshShape shape = drawn_out({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 1), Vec3(2, 0, 1),
                                     Vec3(2, 0, 2), Vec3(3, 0, 2)},
                                    0, 4, 3)
                              .shape();
  const auto count = [&](double x, double z, double radius) {
    return contacts(shape, Vec3(x, 1.3, z), radius).size();
  };
  EXPECT_EQ(count(0.5, 0.4, 0.45), 1u);     // tread
  EXPECT_EQ(count(0.6, 0.4, 0.45), 2u);     // tread and riser
  EXPECT_EQ(count(0.75, 1.1, 0.3), 1u);     // nosing
  EXPECT_EQ(count(1.65, 1.4, 0.45), 2u);    // tread and riser of the next step
  // a large one on two nosings
  const auto found = contacts(shape, Vec3(0.7, 1.3, 2.3), 1.5);
  ASSERT_EQ(found.size(), 2u);
  for (const SurfacePoint &p : found) {
    EXPECT_LE(largest_difference(p.straight.cwiseAbs(), Vec3(0, 1, 0)), 1e-15);
    EXPECT_NEAR(p.distance, std::hypot(1.3, 0.3), 1e-15);
  }
}

/// A ring of two circles of triangles in the plane z = 0.
Soup ring(int n, double inner, double outer)
{
  Soup s;
  for (int i = 0; i < n; ++i) {
    const auto at = [&](int k, double r) {
      const double angle = 2 * M_PI * (k % n) / n;
      return Vec3(r * std::cos(angle), r * std::sin(angle), 0);
    };
    s.add_quad(at(i, inner), at(i, outer), at(i + 1, outer), at(i + 1, inner));
  }
  return s;
}

TEST(Hole, OfAPlateIsTouchedAtItsRim)
{
  const MeshShape shape = ring(200, 1, 3).shape();
  // over the plate, over the hole, and over the rim
  EXPECT_EQ(contacts(shape, Vec3(2, 0.1, 0.4), 0.5).size(), 1u);
  EXPECT_EQ(contacts(shape, Vec3(0.1, 0.1, 0.4), 0.5).size(), 0u);
  const auto rim = contacts(shape, Vec3(0.8, 0, 0.2), 0.5);
  ASSERT_EQ(rim.size(), 1u);
  EXPECT_NEAR(rim[0].distance, 0.2 * std::sqrt(2.0), 1e-3);
  EXPECT_LE(largest_difference(rim[0].normal, Vec3(-1, 0, 1).normalized()), std::sin(M_PI / 200));
  // a sphere that lies on a fine rim all around has one contact with it, the nearest, as with a tube
  EXPECT_EQ(contacts(shape, Vec3(0.01, 0, 0.8), 1.4).size(), 1u);
}

TEST(Hole, WithFourSidesIsTouchedAtEach)
{
  // a frame of 8 triangles around a square hole of 2 x 2: a plate that hangs together
  Soup frame;
  for (int i = 0; i < 4; ++i) {
    const auto at = [](int k, double r) {
      const double x[] = {-r, r, r, -r}, y[] = {-r, -r, r, r};
      return Vec3(x[k % 4], y[k % 4], 0);
    };
    frame.add_quad(at(i, 1), at(i, 3), at(i + 1, 3), at(i + 1, 1));
  }
  const MeshShape shape = frame.shape();
  const auto found = contacts(shape, Vec3(0.01, 0.02, 0.8), 1.4);
  ASSERT_EQ(found.size(), 4u);
  for (const SurfacePoint &p : found) {
    EXPECT_NEAR(p.distance, std::hypot(1.0, 0.8), 0.02);
    EXPECT_NEAR(std::fabs(p.normal[0]) + std::fabs(p.normal[1]), 1.0 / p.distance, 0.03);
  }
  // and over its bars one contact, also where triangles on both sides of the hole are touched
  EXPECT_EQ(contacts(shape, Vec3(2, 0, 0.4), 0.5).size(), 1u);
}

TEST(SingleTriangle, FromAllSides)
{
  Soup s;
  s.add(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0));
  const MeshShape shape = s.shape();
  ASSERT_EQ(shape.mesh().findings.size(), 1u);
  EXPECT_EQ(shape.mesh().findings[0].kind, MeshDefect::open_edge);
  EXPECT_EQ(shape.mesh().findings[0].count, 3);
  Random random(7);
  int touched = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x = random.vector(3);
    const auto found = contacts(shape, x, 1.0);
    const TrianglePoint p = closest_point(x, shape.mesh().triangle(0));
    ASSERT_EQ(found.size(), p.distance < 1.0 ? 1u : 0u);
    if (found.empty()) continue;
    ++touched;
    ASSERT_EQ(found[0].distance, p.distance);
    ASSERT_LE(largest_difference(found[0].normal * p.distance, x - p.point), 1e-14);
  }
  EXPECT_GT(touched, 1000);
  // in its plane, and in it: a unit normal whatever happens
  for (const Vec3 &x : {Vec3(0.5, 0.5, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(-0.5, 0.5, 0)}) {
    const auto found = contacts(shape, x, 1.0);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].normal.norm(), 1.0, 1e-15);
    EXPECT_TRUE(std::isfinite(found[0].curvature));
  }
}

TEST(Parts, ThatStandOnOneAnotherWithoutSharedEdges)
{
  // a slanting blade, which leans away from the sphere, on a floor that knows nothing of it
  Soup s = plate(4, 4, 3, 3);
  s.add_quad(Vec3(2, 0.3, 0), Vec3(2, 3.7, 0), Vec3(3.5, 3.7, 1.5), Vec3(3.5, 0.3, 1.5));
  const MeshShape shape = s.shape();
  // in the obtuse edge: floor and blade; and no third one at the blade's foot
  EXPECT_EQ(contacts(shape, Vec3(1.9, 2, 0.4), 0.45).size(), 2u);
  EXPECT_EQ(contacts(shape, Vec3(1.7, 2, 0.4), 0.45).size(), 1u);
  EXPECT_EQ(contacts(shape, Vec3(1.5, 2, 0.4), 0.7).size(), 1u);
  EXPECT_EQ(contacts(shape, Vec3(2.9, 2, 0.3), 0.45).size(), 2u);
}

}    // namespace bodies_test
