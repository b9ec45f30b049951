// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_TRIANGLE_GRID_H
#define EEPA_WALLS_TRIANGLE_GRID_H

#include "mesh_view.h"

#include <vector>

namespace eepa {

/// Finds triangles in a box by the cells of a grid, in plain arrays, for GPUs, which TriangleTree is not for.
struct TriangleGridView {
  const int *first;        ///< place of a cell's triangles, and the end of all
  const int *triangles;    ///< of each cell, those of which the bounding box meets it
  Vec3 low, high;          ///< of the mesh
  double cells_per_length[3];
  int cells[3];

  EEPA_FUNCTION int cell_of(double x, int axis) const
  {
    const double cell = (x - low[axis]) * cells_per_length[axis];
    if (!(cell > 0.0)) return 0;
    return cell < cells[axis] - 1 ? static_cast<int>(cell) : cells[axis] - 1;
  }
  /// Lowest coordinate of a triangle.
  EEPA_FUNCTION static double lowest(const Triangle &t, int axis)
  {
    const double a = t.corner[0][axis], b = t.corner[1][axis], c = t.corner[2][axis];
    const double lower = a < b ? a : b;
    return lower < c ? lower : c;
  }

  /// Calls `visit(t)` once for each triangle of which the bounding box meets a box, and maybe for some others.
  template <class Visit>
  EEPA_FUNCTION void for_each_in(const MeshView &mesh, const Vec3 &from, const Vec3 &to,
                                 const Visit &visit) const
  {
    int begin[3], end[3], c[3];
    for (int k = 0; k < 3; k++) {
      if (!(from[k] <= high[k] && to[k] >= low[k])) return;
      begin[k] = cell_of(from[k], k);
      end[k] = cell_of(to[k], k);
    }
    for (c[2] = begin[2]; c[2] <= end[2]; c[2]++)
      for (c[1] = begin[1]; c[1] <= end[1]; c[1]++)
        for (c[0] = begin[0]; c[0] <= end[0]; c[0]++) {
          const int cell = c[0] + cells[0] * (c[1] + cells[1] * c[2]);
          for (int at = first[cell]; at < first[cell + 1]; at++) {
            // it counts in the first cell that it shares with the box
            bool is_first = true;
            for (int k = 0; k < 3; k++) {
              const int lowest_cell = cell_of(lowest(mesh.triangle(triangles[at]), k), k);
              is_first = is_first && c[k] == (lowest_cell > begin[k] ? lowest_cell : begin[k]);
            }
            if (is_first) visit(triangles[at]);
          }
        }
  }
};

/// Calls `visit(piece)` for each triangle within reach of a centre, as MeshShape::collect() finds them, in any order.
template <class Visit>
EEPA_FUNCTION void for_each_piece(const MeshView &mesh, const TriangleGridView &grid,
                                  const Vec3 &centre, double reach, const Visit &visit)
{
  const Vec3 half = Vec3::Constant(mesh.safe(reach));
  grid.for_each_in(mesh, centre - half, centre + half, [&](int t) {
    SurfacePiece piece;
    if (is_piece(mesh, t, centre, reach, piece)) visit(piece);
  });
}

/// The cells of a mesh. About eight a triangle, and fewer where large triangles would be in very many.
class TriangleGrid {
 public:
  explicit TriangleGrid(const TriangleMesh &mesh);

  const std::vector<int> &first() const { return first_; }
  const std::vector<int> &triangles() const { return triangles_; }
  /// \param first, triangles  copies of these arrays where they will be read
  TriangleGridView view(const int *first, const int *triangles) const
  {
    TriangleGridView view = view_;
    view.first = first;
    view.triangles = triangles;
    return view;
  }

 private:
  void place_cells(double cells);
  bool fill(const TriangleMesh &mesh, std::size_t most);

  TriangleGridView view_{};
  std::vector<int> first_, triangles_;
};

}    // namespace eepa

#endif
