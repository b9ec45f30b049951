// SPDX-License-Identifier: GPL-2.0-only
// Welding, edges, what is left out and what is said of it; scale, rotation and offset.

#include "support.h"

#include <limits>
#include <set>

namespace triangle_mesh_test {
using namespace eepa_walls_test;

const MeshFinding *finding(const TriangleMesh &mesh, MeshDefect kind)
{
  for (const MeshFinding &found : mesh.findings)
    if (found.kind == kind) return &found;
  return nullptr;
}

void expect_finding(const TriangleMesh &mesh, MeshDefect kind, int count,
                    const std::vector<int> &triangles, const std::string &text)
{
  const MeshFinding *found = finding(mesh, kind);
  ASSERT_NE(found, nullptr) << text;
  EXPECT_EQ(found->count, count);
  EXPECT_EQ(found->triangles, triangles);
  EXPECT_EQ(found->text(), text);
}

template <class Function> void expect_error(const Function &make, const std::string &message)
{
  try {
    make();
    FAIL() << "no error with " << message;
  } catch (const std::invalid_argument &error) {
    EXPECT_EQ(std::string(error.what()), message);
  }
}

TEST(Mesh, OfABoxIsClosed)
{
  const TriangleMesh mesh = box(Vec3(0, 0, 0), Vec3(1, 2, 3)).mesh();
  EXPECT_EQ(mesh.count(), 12);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  ASSERT_EQ(mesh.edges.size(), 18u);
  int flat = 0;
  for (const TriangleMesh::Edge &edge : mesh.edges) {
    EXPECT_EQ(edge.count, 2);
    EXPECT_LT(edge.first, edge.second);
    flat += edge.angle == 0.0f;
    EXPECT_NEAR(edge.angle, edge.angle == 0.0f ? 0.0 : M_PI / 2, 1e-7);
  }
  EXPECT_EQ(flat, 6);
  EXPECT_TRUE(mesh.findings.empty());
  EXPECT_EQ(mesh.low, Vec3(0, 0, 0));
  EXPECT_EQ(mesh.high, Vec3(1, 2, 3));
  EXPECT_NEAR(mesh.tolerance, 1e-7 * std::sqrt(14.0), 1e-20);
  double area = 0.0;
  Vec3 sum = Vec3::Zero();
  for (int t = 0; t < 12; ++t) {
    area += mesh.areas[t];
    sum += mesh.areas[t] * mesh.normal(t);
    EXPECT_EQ(mesh.file_number[t], t + 1);
    // normals outwards
    EXPECT_GT(mesh.normal(t).dot(mesh.centroid(t) - Vec3(0.5, 1, 1.5)), 0.0);
    // each edge of a triangle has its corners
    for (int k = 0; k < 3; ++k) {
      const TriangleMesh::Edge &edge = mesh.edges[mesh.facets[t].edges[k]];
      EXPECT_TRUE(edge.first == t || edge.second == t);
    }
  }
  EXPECT_NEAR(area, 22.0, 1e-14);
  EXPECT_LE(largest_difference(sum, Vec3(0, 0, 0)), 1e-15);
}

TEST(Mesh, HasTheSameEdgesAsAListOfPairs)
{
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    std::vector<Vec3> corners;
    for (int k = 0; k < 12; ++k) corners.push_back(random.vector(1));
    Soup s;
    for (int k = 0; k < 30; ++k) {
      const int a = random.below(12), b = random.below(12), c = random.below(12);
      if (a != b && b != c && c != a) s.add(corners[a], corners[b], corners[c]);
    }
    const TriangleMesh mesh = s.mesh();
    std::set<std::pair<int, int>> pairs;
    for (int t = 0; t < mesh.count(); ++t)
      for (int k = 0; k < 3; ++k) {
        const int a = mesh.facets[t].corners[k], b = mesh.facets[t].corners[(k + 1) % 3];
        pairs.insert({std::min(a, b), std::max(a, b)});
        // all triangles of this edge, counted
        std::vector<int> owners;
        for (int u = 0; u < mesh.count(); ++u) {
          const auto &c = mesh.facets[u].corners;
          if (std::count(c.begin(), c.end(), a) && std::count(c.begin(), c.end(), b))
            owners.push_back(u);
        }
        const TriangleMesh::Edge &edge = mesh.edges[mesh.facets[t].edges[k]];
        ASSERT_EQ(edge.count, static_cast<int>(owners.size()));
        ASSERT_EQ(edge.first, owners[0]);
        ASSERT_EQ(edge.second, owners.size() == 2 ? owners[1] : -1);
      }
    ASSERT_EQ(mesh.edges.size(), pairs.size());
  }
}

TEST(Mesh, WeldsCornersWithinTheTolerance)
{
  Random random(2);
  for (const double off : {0.3, 3.0}) {
    // each triangle's corners off by up to a part of the tolerance, also across cells of the grid
    const double tolerance = 1e-7 * 5;
    const Soup s = plate(4, 3, 20, 15).moved([&](const Vec3 &p) {
      return Vec3(p + 0.5 * off * tolerance * random.direction());
    });
    const TriangleMesh mesh = s.mesh();
    EXPECT_EQ(mesh.count(), 600);
    EXPECT_EQ(mesh.vertices.size() == 21u * 16u, off < 1.0);
    EXPECT_EQ(finding(mesh, MeshDefect::open_edge)->count == 70, off < 1.0);
  }
}

TEST(Mesh, NamesWhatItLeavesOut)
{
  Soup s = box(Vec3(0, 0, 0), Vec3(1, 2, 3));
  const auto insert = [&s](int place, const Vec3 &a, const Vec3 &b, const Vec3 &c) {
    s.triangles.insert(s.triangles.begin() + place, Corners{a, b, c});
  };
  insert(0, Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 2, 3));               // 1
  insert(5, Vec3(0, 0, 0), Vec3(0.5, 1, 1.5), Vec3(1, 2, 3));           // 6
  insert(9, Vec3(0, 0, 0), Vec3(0.5, 1, 1.5 + 1e-8), Vec3(1, 2, 3));    // 10
  s.add(Vec3(1, 1, 1), Vec3(1, 1, 1 + 1e-8), Vec3(1, 1 + 1e-8, 1));     // 16
  const Corners twice = s.triangles[12];
  insert(16, twice[1], twice[0], twice[2]);    // 17
  const TriangleMesh mesh = s.mesh();
  EXPECT_EQ(mesh.count(), 12);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.file_number, (std::vector<int>{2, 3, 4, 5, 7, 8, 9, 11, 12, 13, 14, 15}));
  EXPECT_EQ(mesh.findings.size(), 2u);
  expect_finding(mesh, MeshDefect::degenerate, 4, {1, 6, 10, 16},
                 "4 triangles without area are left out (triangles 1, 6, 10, 16)");
  expect_finding(mesh, MeshDefect::duplicate, 1, {17},
                 "1 triangle that is there twice is left out once (triangle 17)");
  // narrow, but not without area
  insert(0, Vec3(0, 0, 0), Vec3(0.5, 1, 1.5 + 1e-5), Vec3(1, 2, 3));
  EXPECT_EQ(s.mesh().count(), 13);
}

TEST(Mesh, NamesCracksAndBranches)
{
  Soup s = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  s.triangles.erase(s.triangles.begin() + 4);
  expect_finding(s.mesh(), MeshDefect::open_edge, 3, s.mesh().findings[0].triangles,
                 s.mesh().findings[0].text());
  EXPECT_EQ(s.mesh().findings[0].text().find("3 edges belong to one triangle only: cracks, or the "
                                             "rim of an open surface (triangles "),
            0u);
  // a wall within the box, on its diagonals
  s = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  s.add(Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(0.5, 0.5, 0.5));
  const TriangleMesh mesh = s.mesh();
  expect_finding(mesh, MeshDefect::branching_edge, 1, {1},
                 "1 edge belongs to more than two triangles (triangle 1)");
  expect_finding(mesh, MeshDefect::open_edge, 2, {13},
                 "2 edges belong to one triangle only: cracks, or the rim of an open surface "
                 "(triangle 13, ...)");
  // only the first few are named
  const TriangleMesh plates = plate(1, 1, 10, 10).mesh();
  EXPECT_EQ(plates.findings[0].count, 40);
  EXPECT_EQ(plates.findings[0].triangles.size(), 5u);
}

TEST(Mesh, NamesFlippedTrianglesAndStoredNormals)
{
  Soup s = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  std::swap(s.triangles[2][0], s.triangles[2][1]);
  const TriangleMesh mesh = s.mesh();
  ASSERT_EQ(mesh.findings.size(), 1u);
  expect_finding(mesh, MeshDefect::opposite, 1, {3},
                 "1 triangle is the other way round than those next to it (flipped normals), which "
                 "does no harm (triangle 3)");
  // flat edges stay flat
  int flat = 0;
  for (const TriangleMesh::Edge &edge : mesh.edges) flat += edge.angle == 0.0f;
  EXPECT_EQ(flat, 6);

  // in each part the fewer, whichever comes first
  Soup parts = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  for (int t = 0; t < 8; ++t) std::swap(parts.triangles[t][0], parts.triangles[t][1]);
  Soup other = plate(1, 1, 3, 3).moved([](const Vec3 &p) {
    return Vec3(p[0] + 3, p[1], p[2]);
  });
  for (const int t : {1, 4}) std::swap(other.triangles[t][1], other.triangles[t][2]);
  parts.append(other);
  const TriangleMesh several = parts.mesh();
  EXPECT_EQ(finding(several, MeshDefect::opposite)->count, 4 + 2);
  EXPECT_EQ(finding(several, MeshDefect::opposite)->triangles,
            (std::vector<int>{9, 10, 11, 12, 14}));

  StlTriangles stl = plate(1, 1, 1, 1).stl();
  stl.normals = {0, 0, 0, 0.1f, 0, -1};
  const TriangleMesh stored(stl);
  expect_finding(stored, MeshDefect::stored_normal, 1, {2},
                 "1 triangle has a stored normal against the order of the corners, and the order "
                 "counts (triangle 2)");
  // normals turn with the mesh
  stl.normals = {0, 0, 1, 0, 0, 1};
  EXPECT_EQ(
      finding(TriangleMesh(stl, {1, Vec3(1, 0, 0), 180, Vec3(0, 0, 0)}), MeshDefect::stored_normal),
      nullptr);
}

TEST(Mesh, WithoutAnyAreaIsAnError)
{
  Soup s;
  expect_error(
      [&] {
        s.mesh();
      },
      "soup: holds no triangles");
  s.add(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0));
  expect_error(
      [&] {
        s.mesh();
      },
      "soup: its only triangle has no area");
  s.add(Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(2, 0, 0));
  expect_error(
      [&] {
        s.mesh();
      },
      "soup: none of its 2 triangles has an area");
  s = Soup();
  s.add(Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1));
  expect_error(
      [&] {
        s.mesh();
      },
      "soup: its only triangle has no area");
}

TEST(Mesh, OutOfRangeIsAnError)
{
  Soup s;
  s.add(Vec3(0, 0, 0), Vec3(1e31, 0, 0), Vec3(0, 1, 0));
  expect_error(
      [&] {
        s.mesh();
      },
      "soup: triangle 1 has a corner at 1e+31 0 0: coordinates must be between -1e+30 and "
      "1e+30");
  s = Soup();
  s.add(Vec3(0, 0, 0), Vec3(3e-31, 0, 0), Vec3(0, 4e-31, 0));
  expect_error(
      [&] {
        s.mesh();
      },
      "soup: its bounding box has a diagonal of 5e-31: it must be at least 1e-30");
  // any size between them will do
  for (const double size : {1e-29, 1e29}) {
    const TriangleMesh mesh(box(Vec3(0, 0, 0), size * Vec3(1, 2, 3)).stl());
    EXPECT_EQ(mesh.count(), 12);
    EXPECT_TRUE(mesh.findings.empty());
    const MeshShape shape(mesh);
    EXPECT_EQ(contacts(shape, size * Vec3(0.5, 0.4, 0.3), 0.45 * size).size(), 2u);
  }
}

TEST(Transformation, ScalesThenTurnsThenMoves)
{
  const PointTransformation move({2.0, Vec3(0, 0, 3), 90.0, Vec3(10, 20, 30)});
  EXPECT_EQ(move(Vec3(1, 2, 3)), Vec3(10 - 4, 20 + 2, 30 + 6));
  EXPECT_EQ(move.rotate(Vec3(1, 2, 3)), Vec3(-2, 1, 3));
  // about any axis against Eigen's
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 axis = random.direction(), point = random.vector(1);
    const double angle = random.between(-1000, 1000);
    const PointTransformation turn({1.0, 5 * axis, angle, Vec3(0, 0, 0)});
    const Vec3 expected = Eigen::AngleAxisd(angle * M_PI / 180, axis) * point;
    ASSERT_LE(largest_difference(turn(point), expected), 1e-14);
  }
}

TEST(Transformation, ByQuartersIsExact)
{
  const Vec3 axes[] = {Vec3(1, 0, 0), Vec3(0, -2, 0), Vec3(0, 0, 0.1)};
  for (const Vec3 &axis : axes)
    for (int quarters = -9; quarters <= 9; ++quarters) {
      const PointTransformation turn({1.0, axis, 90.0 * quarters, Vec3(0, 0, 0)});
      Vec3 v(0.1, 0.2, 0.3);
      for (int i = 0; i < ((quarters % 4) + 4) % 4; ++i) {
        const Vec3 k = axis.normalized();
        v = k.cross(v) + k.dot(v) * k;
      }
      EXPECT_EQ(turn(Vec3(0.1, 0.2, 0.3)), v) << axis.transpose() << " " << quarters;
    }
  const PointTransformation none({});
  EXPECT_EQ(none(Vec3(0.1, -0.2, 1e10)), Vec3(0.1, -0.2, 1e10));
}

TEST(Transformation, NamesWhatIsWrong)
{
  const auto make = [](double scale, const Vec3 &axis, double angle, const Vec3 &offset) {
    return [=] {
      PointTransformation({scale, axis, angle, offset});
    };
  };
  const Vec3 z(0, 0, 1), none(0, 0, 0);
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  expect_error(make(0, z, 0, none), "scale of a mesh = 0 is not allowed: it must be > 0");
  expect_error(make(-1, z, 0, none), "scale of a mesh = -1 is not allowed: it must be > 0");
  expect_error(make(inf, z, 0, none), "scale of a mesh = inf is not allowed: it must be > 0");
  expect_error(make(1, none, 0, none),
               "rotation axis of a mesh = 0 0 0 is not allowed: it must be finite and not zero");
  expect_error(make(1, Vec3(1, inf, 0), 0, none),
               "rotation axis of a mesh = 1 inf 0 is not allowed: it must be finite and not zero");
  expect_error(make(1, z, nan, none),
               "rotation angle of a mesh = nan is not allowed: it must be a finite number");
  expect_error(make(1, z, 0, Vec3(0, nan, 0)),
               "offset of a mesh = 0 nan 0 is not allowed: it must be finite");
}

}    // namespace triangle_mesh_test
