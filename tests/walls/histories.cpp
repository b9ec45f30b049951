// SPDX-License-Identifier: GPL-2.0-only
// Which contact of the last step a contact is, when the sphere moves over a mesh.

#include "support.h"

namespace histories_test {
using namespace eepa_walls_test;

/// Moves a sphere over a surface on which it always has one contact, and requires that each contact goes
/// on from the one of the step before.
template <class Path>
void expect_one_history(const MeshShape &shape, double radius, int steps, const Path &path)
{
  int last = -1, changes = 0;
  for (int i = 0; i < steps; ++i) {
    const Vec3 x = path(i);
    const auto found = contacts(shape, x, radius);
    ASSERT_EQ(found.size(), 1u) << x.transpose();
    if (last >= 0) {
      ASSERT_TRUE(shape.continues(last, found[0], x)) << i << ": " << x.transpose();
      changes += last != found[0].face;
    }
    last = found[0].face;
  }
  EXPECT_GT(changes, 10);
}

TEST(Continues, AlongAPlate)
{
  Random random(1);
  Soup fan;
  for (int i = 0; i < 3000; ++i)
    fan.add(Vec3(1.1, 0.7, 0), Vec3(4 * i / 3000.0, 0, 0), Vec3(4 * (i + 1) / 3000.0, 0, 0));
  for (const Soup &s : {plate(4, 3, 1, 1), plate(4, 3, 40, 30, &random), fan}) {
    const MeshShape shape = s.shape();
    const bool is_fan = s.triangles.size() == 3000;
    Vec3 x(1.5, 0.2, 0.45);
    // up to a tenth of the radius a step: many slivers at once
    expect_one_history(shape, 0.5, is_fan ? 2000 : 100000, [&](int) {
      Vec3 next = x + 0.05 * random.direction();
      next[0] = std::min(std::max(next[0], 0.3), 3.5);
      next[1] = std::min(std::max(next[1], 0.01), is_fan ? 0.2 : 3.0);
      next[2] = std::min(std::max(next[2], 0.4), 0.499);
      return x = next;
    });
  }
}

TEST(Continues, AroundABox)
{
  // over its edges and corners, which are convex, with steps up to a twentieth of the radius
  const Vec3 size(1, 1.2, 1.4);
  const MeshShape shape = box(Vec3(0, 0, 0), size).shape();
  Random random(2);
  Vec3 x(0.5, 0.5, -0.4);
  expect_one_history(shape, 0.5, 100000, [&](int) {
    for (;;) {
      const Vec3 next = x + 0.025 * random.direction();
      const double distance = (next - next.cwiseMax(Vec3(0, 0, 0)).cwiseMin(size)).norm();
      if (distance > 0.4 && distance < 0.499) return x = next;
    }
  });
}

TEST(Continues, AlongAPrismFromInsideAndOutside)
{
  // with steps up to a twentieth of the radius, so that no facet is left behind before the next one is deepest
  Random random(3);
  for (const int facets : {30, 60, 300})
    for (const bool inside : {false, true}) {
      const MeshShape shape = prism(facets, 2, 0, 4, 3).shape();
      Vec3 x(inside ? 1.6 : 2.4, 0, 2);
      expect_one_history(shape, 0.5, 20000, [&](int) {
        for (;;) {
          const Vec3 next = x + 0.025 * random.direction();
          const double gap = std::fabs(std::hypot(next[0], next[1]) - 2);
          if (gap > 0.4 && gap < 0.48 && next[2] > 0.5 && next[2] < 3.5) return x = next;
        }
      });
    }
}

TEST(Continues, NeverFromOneSideOfAConcaveEdgeToTheOther)
{
  // grooves of several angles above that of smooth edges, cut in many pieces along the edge
  Random random(4);
  for (const double degrees : {20.0, 45.0, 90.0, 150.0}) {
    const double angle = degrees * M_PI / 180.0;
    const Vec3 up(-4 * std::cos(angle), 0, 4 * std::sin(angle));
    const MeshShape shape = drawn_out({Vec3(4, 0, 0), Vec3(0, 0, 0), up}, 0, 4, 40).shape();
    const Vec3 floor(0, 0, 1), wall(std::sin(angle), 0, std::cos(angle));
    std::vector<SurfacePoint> last;
    int both = 0;
    // on the bisector of floor and wall
    const double half = 0.5 * (M_PI - angle);
    Vec3 x = Vec3(0, 2, 0) + 0.45 / std::sin(half) * Vec3(std::cos(half), 0, std::sin(half));
    for (int i = 0; i < 20000; ++i) {
      for (;;) {
        const Vec3 next = x + 0.03 * random.direction();
        if (next[1] < 0.1 || next[1] > 3.9) continue;
        // above both faces, near either
        const double a = next.dot(floor), b = next.dot(wall);
        if (a < 0.4 || b < 0.4 || std::min(a, b) > 0.48 || std::hypot(next[0], next[2]) > 2)
          continue;
        x = next;
        break;
      }
      const auto found = contacts(shape, x, 0.5);
      ASSERT_GE(found.size(), 1u);
      ASSERT_LE(found.size(), 2u);
      both += found.size() == 2;
      for (const SurfacePoint &now : found)
        for (const SurfacePoint &then : last) {
          const bool same_side = (now.normal - then.normal).norm() < 1e-6;
          ASSERT_EQ(shape.continues(then.face, now, x), same_side) << degrees << " " << i;
        }
      last = found;
    }
    EXPECT_GT(both, 100);
  }
}

TEST(Continues, NotFromFacesThatAreNotThere)
{
  const MeshShape shape = plate(1, 1, 1, 1).shape();
  const auto found = contacts(shape, Vec3(0.5, 0.2, 0.1), 0.5);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(shape.continues(2, found[0], Vec3(0.5, 0.2, 0.1)));
  EXPECT_FALSE(shape.continues(-1, found[0], Vec3(0.5, 0.2, 0.1)));
}

TEST(Smooth, MustBeAnAngle)
{
  const Soup s = plate(1, 1, 1, 1);
  for (const double angle : {-1.0, 91.0, std::nan(""), HUGE_VAL}) {
    try {
      s.shape(angle);
      FAIL() << angle;
    } catch (const std::invalid_argument &error) {
      EXPECT_NE(std::string(error.what()).find("must be between 0 and 90 degrees"),
                std::string::npos)
          << error.what();
    }
  }
  // coplanar triangles are one surface with 0 too
  const MeshShape shape = plate(1, 1, 5, 5).shape(0);
  EXPECT_EQ(contacts(shape, Vec3(0.5, 0.4, 0.1), 0.5).size(), 1u);
  for (std::size_t e = 0; e < shape.mesh().edges.size(); ++e)
    EXPECT_EQ(shape.is_smooth(static_cast<int>(e)), shape.mesh().edges[e].count == 2);
}

}    // namespace histories_test
