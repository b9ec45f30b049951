// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TESTS_WALLS_SUPPORT_H
#define EEPA_TESTS_WALLS_SUPPORT_H

#include <eepa_walls/candidates.h>
#include <eepa_walls/mesh_shape.h>
#include <eepa_walls/triangle_grid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

// Each test file has a namespace of its own, so that all of them can also be compiled as one.

namespace eepa_walls_test {

using namespace eepa;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high)
  {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned long>(n)); }
  Vec3 vector(double magnitude)
  {
    const double x = between(-magnitude, magnitude), y = between(-magnitude, magnitude);
    return Vec3(x, y, between(-magnitude, magnitude));
  }
  Vec3 direction()
  {
    for (;;) {
      const Vec3 v = vector(1.0);
      const double length = v.norm();
      if (length > 0.1 && length < 1.0) return v / length;
    }
  }
  template <class List> void shuffle(List &list)
  {
    std::shuffle(list.begin(), list.end(), engine_);
  }

 private:
  std::mt19937_64 engine_;
};

using Corners = std::array<Vec3, 3>;

/// A surface as a list of triangles.
struct Soup {
  std::vector<Corners> triangles;

  void add(const Vec3 &a, const Vec3 &b, const Vec3 &c) { triangles.push_back({a, b, c}); }
  void add_quad(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d)
  {
    add(a, b, c);
    add(a, c, d);
  }
  void append(const Soup &other)
  {
    triangles.insert(triangles.end(), other.triangles.begin(), other.triangles.end());
  }
  template <class Function> Soup moved(const Function &move) const
  {
    Soup result = *this;
    for (Corners &t : result.triangles)
      for (Vec3 &corner : t) corner = move(corner);
    return result;
  }

  StlTriangles stl() const
  {
    StlTriangles s;
    s.name = "soup";
    for (const Corners &t : triangles)
      for (const Vec3 &corner : t)
        s.corners.insert(s.corners.end(), corner.data(), corner.data() + 3);
    s.normals.resize(s.corners.size() / 3);
    return s;
  }
  TriangleMesh mesh() const { return TriangleMesh(stl()); }
  MeshShape shape(double smooth = MeshShape::default_smooth) const
  {
    return MeshShape(mesh(), smooth);
  }
};

/// The rectangle from 0, 0 to width, depth in the plane z = 0, cut along lines at random places.
inline Soup plate(double width, double depth, int nx, int ny, Random *random = nullptr)
{
  const auto cuts = [&](int n, double length) {
    std::vector<double> x;
    for (int i = 0; i <= n; ++i) x.push_back(length * i / n);
    if (random)
      for (int i = 1; i < n; ++i) x[i] += 0.49 * length / n * random->between(-1.0, 1.0);
    return x;
  };
  const std::vector<double> x = cuts(nx, width), y = cuts(ny, depth);
  Soup s;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      const Vec3 a(x[i], y[j], 0), b(x[i + 1], y[j], 0), c(x[i + 1], y[j + 1], 0),
          d(x[i], y[j + 1], 0);
      if (random && random->below(2))
        s.add_quad(b, c, d, a);
      else
        s.add_quad(a, b, c, d);
    }
  return s;
}

/// The surface of a box, normals outwards, 12 triangles.
inline Soup box(const Vec3 &low, const Vec3 &high)
{
  const auto corner = [&](int x, int y, int z) {
    return Vec3(x ? high[0] : low[0], y ? high[1] : low[1], z ? high[2] : low[2]);
  };
  Soup s;
  s.add_quad(corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0));
  s.add_quad(corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
  s.add_quad(corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
  s.add_quad(corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0));
  s.add_quad(corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0));
  s.add_quad(corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1));
  return s;
}

/// The lateral surface of a regular prism about z, of which the corners are on a circle; normals outwards.
/// Each facet is cut once along its height or more often.
inline Soup prism(int facets, double radius, double low, double high, int layers = 1)
{
  const auto corner = [&](int i, int layer) {
    const double angle = 2.0 * M_PI * (i % facets) / facets;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle),
                low + (high - low) * layer / layers);
  };
  Soup s;
  for (int i = 0; i < facets; ++i)
    for (int j = 0; j < layers; ++j)
      s.add_quad(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
  return s;
}

/// A profile in the plane of x and z, drawn out along y.
inline Soup drawn_out(const std::vector<Vec3> &profile, double low, double high, int cuts)
{
  Soup s;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    for (int j = 0; j < cuts; ++j) {
      const Vec3 from(0, low + (high - low) * j / cuts, 0);
      const Vec3 to(0, low + (high - low) * (j + 1) / cuts, 0);
      s.add_quad(profile[i] + from, profile[i] + to, profile[i + 1] + to, profile[i + 1] + from);
    }
  return s;
}

/// The grid of a mesh, made anew when another mesh comes.
inline const TriangleGrid &grid_of(const TriangleMesh &mesh)
{
  static std::vector<double> known;
  static std::unique_ptr<const TriangleGrid> grid;
  std::vector<double> corners;
  for (int t = 0; t < mesh.count(); t++)
    for (const Vec3 &corner : mesh.triangle(t).corner)
      corners.insert(corners.end(), corner.data(), corner.data() + 3);
  if (!grid || corners != known) {
    grid = std::make_unique<const TriangleGrid>(mesh);
    known = corners;
  }
  return *grid;
}

/// The contacts by what GPUs use: a grid in place of a tree, and all triangles compared with each other.
inline std::vector<SurfacePoint> contacts_by_grid(const MeshShape &shape, const Vec3 &x,
                                                  double radius)
{
  const TriangleGrid &grid = grid_of(shape.mesh());
  const MeshView mesh = shape.view();
  std::vector<SurfacePiece> pieces, by_tree;
  for_each_piece(mesh, grid.view(grid.first().data(), grid.triangles().data()), x, radius,
                 [&](const SurfacePiece &piece) {
                   pieces.push_back(piece);
                 });
  std::sort(pieces.begin(), pieces.end(), is_nearer);
  shape.collect(x, radius, by_tree);
  EXPECT_EQ(pieces.size(), by_tree.size());
  std::vector<MeshTouch> touches;
  for (std::size_t k = 0; k < std::min(pieces.size(), by_tree.size()); k++) {
    EXPECT_EQ(pieces[k].number, by_tree[k].number);
    EXPECT_EQ(pieces[k].distance, by_tree[k].distance);
    const TrianglePoint at = closest_point(x, mesh.triangle(pieces[k].number));
    if (at.distance < radius) touches.push_back({at, pieces[k].number, 0, 0});
  }
  find_mesh_contacts(mesh, touches.data(), static_cast<int>(touches.size()), x);
  std::vector<SurfacePoint> found;
  for (std::size_t k = 0; k < touches.size(); k++)
    if (touches[k].group == static_cast<int>(k)) {
      const int t = touches[k].triangle;
      found.push_back(surface_point(mesh.triangle(t), t, touches[k].at, x));
    }
  std::sort(found.begin(), found.end(), [](const SurfacePoint &a, const SurfacePoint &b) {
    return a.face < b.face;
  });
  return found;
}

/// The contacts of a sphere, candidates from collect() and all else as a driver does it.
inline std::vector<SurfacePoint> contacts(const MeshShape &shape, const Vec3 &centre, double radius)
{
  std::vector<SurfacePiece> pieces;
  std::vector<SurfacePoint> found;
  if (shape.collect(centre, radius, pieces))
    shape.visit(centre, radius, pieces.data(), static_cast<int>(pieces.size()), found);
  // GPUs find them in another way, which is asked now and then, for it takes longer than all else here
  static int asked = 0;
  if (asked++ % 8 != 0) return found;
  const auto by_grid = contacts_by_grid(shape, centre, radius);
  EXPECT_EQ(found.size(), by_grid.size()) << centre.transpose() << ", " << radius;
  for (std::size_t c = 0; c < std::min(found.size(), by_grid.size()); ++c) {
    EXPECT_EQ(found[c].face, by_grid[c].face);
    EXPECT_EQ(found[c].distance, by_grid[c].distance);
    EXPECT_EQ(found[c].normal, by_grid[c].normal);
  }
  return found;
}

inline double largest_difference(const Vec3 &a, const Vec3 &b)
{
  return (a - b).cwiseAbs().maxCoeff();
}

}    // namespace eepa_walls_test

#endif
