// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_TRIANGLE_MESH_H
#define EEPA_WALLS_TRIANGLE_MESH_H

#include "mesh_findings.h"
#include "mesh_transformation.h"
#include "stl_file.h"
#include "triangle.h"

#include <cstddef>
#include <vector>

namespace eepa {

/// The surface that triangles make: corners that belong together are one, edges know their triangles.
/// All in plain arrays, numbered from 0.
class TriangleMesh {
 public:
  /// As std::array, for GPUs too.
  struct Three {
    int numbers[3];

    EEPA_FUNCTION int &operator[](std::size_t k) { return numbers[k]; }
    EEPA_FUNCTION const int &operator[](std::size_t k) const { return numbers[k]; }
    int *begin() { return numbers; }
    int *end() { return numbers + 3; }
    const int *begin() const { return numbers; }
    const int *end() const { return numbers + 3; }
  };

  /// Triangles at an edge.
  struct Edge {
    int first = 0;      ///< the triangle with the lowest number
    int second = -1;    ///< the other one; -1 where there is none, or more than one
    int count = 0;      ///< of triangles
    /// Between the planes of the two triangles: 0 where the surface goes straight on, pi where it is
    /// folded, whichever way round its triangles are [radians]
    float angle = 0.0f;
    /// By how much rounding of the corners may change the angle [radians]
    float rounding = 0.0f;
  };

  /// All that a contact needs of a triangle, so that it reads one place of memory: two lines of a cache.
  struct alignas(64) Facet {
    Triangle triangle;    ///< its normal by the order of corners
    Three corners;        ///< vertices
    Three edges;          ///< edge k leads from corner k to k + 1
  };

  /// Corners that are equal, or nearer than the tolerance, become one. Triangles without area within the
  /// tolerance and duplicates are left out, with a finding. Faces in a file are so counted by
  /// `file_number` and not by their place in the arrays.
  /// \throw std::invalid_argument naming the file when no triangle with an area is left, or when its
  ///     size or its distance from the origin is out of range
  explicit TriangleMesh(const StlTriangles &stl, const MeshTransformation &transformation = {});

  int count() const { return static_cast<int>(facets.size()); }
  const Triangle &triangle(int t) const { return facets[t].triangle; }
  const Vec3 &normal(int t) const { return facets[t].triangle.normal; }
  Vec3 centroid(int t) const
  {
    const Vec3 *corner = facets[t].triangle.corner;
    return (corner[0] + corner[1] + corner[2]) / 3.0;
  }

  std::vector<Vec3> vertices;
  std::vector<Facet> facets;
  std::vector<double> areas;
  std::vector<int> file_number;    ///< of each triangle, from 1
  std::vector<Edge> edges;
  Vec3 low, high;            ///< of the bounding box
  double tolerance = 0.0;    ///< by which places may be off [length]
  std::vector<MeshFinding> findings;

 private:
  void weld(const StlTriangles &stl, const PointTransformation &transform);
  void drop_degenerate(const std::string &name);
  void drop_duplicates();
  void keep(const std::vector<char> &wanted, MeshDefect why);
  void drop_unused_vertices();
  void measure();
  void find_edges();
  void measure_edge(Edge &edge, bool same_direction);
  void check_orientations();
  void check_stored_normals(const StlTriangles &stl, const PointTransformation &transform);
  void note(MeshDefect kind, int triangle);
};

}    // namespace eepa

#endif
