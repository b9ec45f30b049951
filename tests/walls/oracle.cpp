// SPDX-License-Identifier: GPL-2.0-only
// Contacts of a sphere with random meshes against the rules of mesh_contacts.h, applied to all triangles
// and all pairs of them, with another way to the nearest point and no list of edges.

#include "support.h"

#include <numeric>

namespace oracle_test {
using namespace eepa_walls_test;

using LongVec = Eigen::Matrix<long double, 3, 1>;

struct Nearest {
  LongVec point;
  long double distance;
  long double height;    ///< over the plane
};

/// The nearest of the foot on the plane, where it is within, and of the nearest points of the edges.
Nearest nearest_point(const Vec3 &centre, const Corners &t)
{
  const LongVec x = centre.cast<long double>();
  const LongVec corner[] = {t[0].cast<long double>(), t[1].cast<long double>(),
                            t[2].cast<long double>()};
  const LongVec area = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const LongVec normal = area / area.norm();
  Nearest best;
  best.distance = HUGE_VALL;
  best.height = normal.dot(x - corner[0]);
  const LongVec foot = x - best.height * normal;
  bool within = true;
  for (int k = 0; k < 3; ++k) {
    const LongVec &p = corner[k];
    const LongVec along = corner[(k + 1) % 3] - p;
    within = within && normal.dot(along.cross(foot - p)) >= 0;
    const long double part = along.dot(x - p) / along.squaredNorm();
    const LongVec point = p + std::min(std::max(part, 0.0L), 1.0L) * along;
    const long double distance = (x - point).norm();
    if (distance < best.distance) {
      best.distance = distance;
      best.point = point;
    }
  }
  if (within) {
    best.distance = std::fabs(best.height);
    best.point = foot;
  }
  return best;
}

bool share_two_corners(const Corners &s, const Corners &t, Vec3 shared[2])
{
  int n = 0;
  for (const Vec3 &a : s)
    for (const Vec3 &b : t)
      if (a == b && n < 2) shared[n++] = a;
  return n == 2;
}

bool has(const Corners &t, const Vec3 &corner)
{
  return t[0] == corner || t[1] == corner || t[2] == corner;
}

/// Whether two triangles alone share an edge and turn by no more than an angle there.
bool smooth(const std::vector<Corners> &all, std::size_t i, std::size_t j, double degrees)
{
  Vec3 shared[2];
  if (!share_two_corners(all[i], all[j], shared)) return false;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (k != i && k != j && has(all[k], shared[0]) && has(all[k], shared[1])) return false;
  // from the heights over the edge, which are opposite where the surface goes straight on
  const Vec3 along = (shared[1] - shared[0]).normalized();
  const auto height = [&](const Corners &t) {
    for (const Vec3 &corner : t)
      if (corner != shared[0] && corner != shared[1]) {
        const Vec3 h = corner - shared[0];
        return Vec3((h - h.dot(along) * along).normalized());
      }
    return Vec3(0, 0, 0);
  };
  const double cosine = -height(all[i]).dot(height(all[j]));
  return std::acos(std::min(1.0, std::max(-1.0, cosine))) <= degrees * M_PI / 180 + 1e-4;
}

struct Contact {
  int triangle;
  Nearest at;
};

std::vector<Contact> expected_contacts(const std::vector<Corners> &all, const Vec3 &centre,
                                       double radius, double degrees)
{
  std::vector<Contact> touched;
  for (std::size_t t = 0; t < all.size(); ++t) {
    const Nearest at = nearest_point(centre, all[t]);
    if (at.distance < radius) touched.push_back({static_cast<int>(t), at});
  }
  const std::size_t n = touched.size();
  // (i)
  std::vector<Contact> minima;
  std::vector<std::size_t> place;
  const long double same = 1e-16L;
  for (std::size_t i = 0; i < n; ++i) {
    bool goes_on = false;
    for (std::size_t j = 0; j < n && !goes_on; ++j) {
      if (i == j) continue;
      const long double difference = touched[i].at.distance - touched[j].at.distance;
      if (difference < -same) continue;
      if (difference < same && j > i) continue;
      const Vec3 point = touched[i].at.point.cast<double>();
      goes_on = nearest_point(point, all[touched[j].triangle]).distance < 1e-7L;
    }
    if (goes_on) continue;
    minima.push_back(touched[i]);
    place.push_back(i);
  }
  // (ii): the touched triangles that can be reached from each one
  const auto reached_from = [&](std::size_t start) {
    std::vector<char> reached(n, 0);
    std::vector<std::size_t> todo = {start};
    reached[start] = 1;
    while (!todo.empty()) {
      const std::size_t i = todo.back();
      todo.pop_back();
      for (std::size_t j = 0; j < n; ++j)
        if (!reached[j] && smooth(all, touched[i].triangle, touched[j].triangle, degrees)) {
          reached[j] = 1;
          todo.push_back(j);
        }
    }
    return reached;
  };
  const long double cosine = std::cos(degrees * M_PI / 180 + 1e-4);
  const auto on_face = [&](const Contact &c) {
    return std::fabs(c.at.height) >= cosine * c.at.distance;
  };
  std::vector<int> group(minima.size());
  std::iota(group.begin(), group.end(), 0);
  for (std::size_t i = 0; i < minima.size(); ++i) {
    const auto reached = reached_from(place[i]);
    for (std::size_t j = 0; j < minima.size(); ++j) {
      if (!reached[place[j]]) continue;
      const LongVec x = centre.cast<long double>();
      const LongVec a = (x - minima[i].at.point).normalized(),
                    b = (x - minima[j].at.point).normalized();
      if (!(on_face(minima[i]) && on_face(minima[j])) && a.dot(b) < cosine) continue;
      const int from = group[i], to = group[j];
      for (int &g : group)
        if (g == from) g = to;
    }
  }
  std::vector<Contact> found;
  for (std::size_t g = 0; g < minima.size(); ++g) {
    const Contact *deepest = nullptr;
    for (std::size_t i = 0; i < minima.size(); ++i)
      if (group[i] == static_cast<int>(g) &&
          (!deepest || minima[i].at.distance < deepest->at.distance))
        deepest = &minima[i];
    if (deepest) found.push_back(*deepest);
  }
  std::sort(found.begin(), found.end(), [](const Contact &a, const Contact &b) {
    return a.at.distance < b.at.distance;
  });
  return found;
}

/// Compares the contacts of many spheres around a mesh; gives how many contacts spheres had.
std::vector<int> compare(const Soup &soup, double degrees, int spheres, Random &random,
                         double largest_radius)
{
  const MeshShape shape = soup.shape(degrees);
  EXPECT_EQ(shape.mesh().count(), static_cast<int>(soup.triangles.size()));
  const Vec3 size = shape.mesh().high - shape.mesh().low;
  std::vector<int> seen(6, 0);
  for (int i = 0; i < spheres; ++i) {
    const double radius = largest_radius * random.between(0.1, 1);
    Vec3 x;
    for (int k = 0; k < 3; ++k)
      x[k] = shape.mesh().low[k] - radius + random.between(0, 1) * (size[k] + 2 * radius);
    const auto expected = expected_contacts(soup.triangles, x, radius, degrees);
    auto found = contacts(shape, x, radius);
    std::sort(found.begin(), found.end(), [](const SurfacePoint &a, const SurfacePoint &b) {
      return a.distance < b.distance;
    });
    EXPECT_EQ(found.size(), expected.size()) << i << ": " << x.transpose() << ", " << radius;
    if (found.size() != expected.size()) break;
    for (std::size_t c = 0; c < found.size(); ++c) {
      EXPECT_NEAR(found[c].distance, static_cast<double>(expected[c].at.distance), 1e-12);
      const Vec3 away = x - expected[c].at.point.cast<double>();
      EXPECT_LE(largest_difference(found[c].normal * found[c].distance, away), 1e-9);
    }
    ++seen[std::min<std::size_t>(found.size(), 5)];
  }
  return seen;
}

TEST(Oracle, HillsOfSeveralHeights)
{
  Random random(1);
  for (const double height : {0.02, 0.1, 0.5})
    for (int i = 0; i < 20; ++i) {
      // heights of the corners of a plate, shared by its triangles
      std::vector<double> z(100);
      for (double &value : z) value = height * random.between(-1, 1);
      const Soup s = plate(3, 3, 6, 6).moved([&](const Vec3 &p) {
        return Vec3(
            p[0], p[1],
            z[static_cast<std::size_t>(std::lround(2 * p[0]) * 10 + std::lround(2 * p[1]))]);
      });
      compare(s, 12, 200, random, 1.0);
      if (HasFailure()) return;
    }
}

TEST(Oracle, TrianglesOfFewCorners)
{
  // edges of any number of triangles, and triangles that pass through one another
  Random random(2);
  std::vector<int> sum(6, 0);
  for (int i = 0; i < 100; ++i) {
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k) corners.push_back(random.vector(1));
    std::vector<TriangleMesh::Three> used;
    Soup s;
    while (s.triangles.size() < 16) {
      TriangleMesh::Three t = {random.below(8), random.below(8), random.below(8)};
      TriangleMesh::Three sorted = t;
      std::sort(sorted.begin(), sorted.end());
      if (sorted[0] == sorted[1] || sorted[1] == sorted[2]) continue;
      if (std::any_of(used.begin(), used.end(), [&](const auto &other) {
            return std::equal(other.begin(), other.end(), sorted.begin());
          }))
        continue;
      used.push_back(sorted);
      s.add(corners[t[0]], corners[t[1]], corners[t[2]]);
    }
    const auto seen = compare(s, random.between(0, 90), 200, random, 1.5);
    for (int k = 0; k < 6; ++k) sum[k] += seen[k];
    if (HasFailure()) return;
  }
  for (const int n : sum) EXPECT_GT(n, 100);
}

TEST(Oracle, BodiesOfFlatFaces)
{
  // coplanar triangles, equal distances and directions
  Random random(3);
  Soup s = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  s.append(drawn_out({Vec3(2, 0, 1), Vec3(2, 0, 0), Vec3(3, 0, 0), Vec3(3.5, 0, 0.1)}, 0, 1, 3));
  s.append(plate(1, 1, 2, 2).moved([](const Vec3 &p) {
    return Vec3(p[0], p[1], p[2] + 1.5);
  }));
  compare(s, 12, 10000, random, 1.2);
}

TEST(Oracle, TubesFromInside)
{
  Random random(4);
  for (const int facets : {9, 30, 50}) compare(prism(facets, 1, 0, 1.5, 2), 12, 300, random, 0.9);
}

TEST(Contacts, DoNotDependOnTheOrderOrOrientationOfTriangles)
{
  Random random(5);
  Soup s = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  s.append(prism(20, 0.8, -1, 2, 2).moved([](const Vec3 &p) {
    return Vec3(p[0] + 0.5, p[1] + 0.5, p[2]);
  }));
  const MeshShape shape = s.shape();
  for (int i = 0; i < 30; ++i) {
    Soup other = s;
    random.shuffle(other.triangles);
    for (Corners &t : other.triangles) {
      if (random.below(2)) std::swap(t[0], t[1]);
      std::rotate(t.begin(), t.begin() + random.below(3), t.end());
    }
    const MeshShape changed = other.shape();
    for (int k = 0; k < 500; ++k) {
      const Vec3 x = Vec3(0.5, 0.5, 0.5) + random.vector(1);
      const double radius = random.between(0.1, 0.5);
      auto a = contacts(shape, x, radius), b = contacts(changed, x, radius);
      ASSERT_EQ(a.size(), b.size());
      const auto nearer = [](const SurfacePoint &p, const SurfacePoint &q) {
        return p.distance < q.distance;
      };
      std::sort(a.begin(), a.end(), nearer);
      std::sort(b.begin(), b.end(), nearer);
      for (std::size_t c = 0; c < a.size(); ++c) {
        ASSERT_NEAR(a[c].distance, b[c].distance, 1e-15);
        ASSERT_LE(largest_difference(a[c].normal, b[c].normal), 1e-13);
        ASSERT_NEAR(a[c].curvature, b[c].curvature, 1e-12 * a[c].curvature);
      }
    }
  }
}

TEST(Contacts, MoveAndTurnWithTheMesh)
{
  Random random(6);
  Soup s = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  s.append(prism(40, 0.8, -1, 2, 2));
  const MeshShape shape = s.shape();
  for (int i = 0; i < 30; ++i) {
    const Vec3 axis = random.direction();
    const double angle = random.between(0, 360);
    const MeshTransformation place = {1.0, axis, angle, random.vector(1.0)};
    const PointTransformation transform(place);
    const MeshShape moved(TriangleMesh(s.stl(), place));
    for (int k = 0; k < 500; ++k) {
      const Vec3 x = random.vector(1.2);
      const double radius = random.between(0.1, 0.5);
      const auto a = contacts(shape, x, radius), b = contacts(moved, transform(x), radius);
      ASSERT_EQ(a.size(), b.size()) << x.transpose() << " " << radius;
      for (std::size_t c = 0; c < a.size(); ++c) {
        ASSERT_NEAR(a[c].distance, b[c].distance, 1e-12);
        ASSERT_LE(largest_difference(transform.rotate(a[c].normal), b[c].normal), 1e-12);
      }
    }
  }
}

}    // namespace oracle_test
