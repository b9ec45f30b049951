// SPDX-License-Identifier: GPL-2.0-only
#include "triangle_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace eepa {

TriangleGrid::TriangleGrid(const TriangleMesh &mesh)
{
  view_.low = mesh.low;
  view_.high = mesh.high;
  constexpr double most_cells = 1 << 23;
  const std::size_t most_entries =
      (std::size_t{1} << 20) + 64 * static_cast<std::size_t>(mesh.count());
  double cells = std::min(8.0 * mesh.count(), most_cells);
  place_cells(cells);
  while (!fill(mesh, most_entries)) {
    cells /= 8.0;
    place_cells(cells);
  }
}

/// Cells that are nearly cubes.
void TriangleGrid::place_cells(double cells)
{
  const Vec3 size = view_.high - view_.low;
  const double longest = size.maxCoeff();
  double shares = 1.0;
  for (int k = 0; k < 3; k++) shares *= std::max(size[k] / longest, 1e-3);
  const double along_longest = std::cbrt(std::max(cells, 1.0) / shares);
  for (int k = 0; k < 3; k++) {
    const double number = std::floor(along_longest * size[k] / longest);
    view_.cells[k] = static_cast<int>(std::min(std::max(number, 1.0), 4096.0));
    view_.cells_per_length[k] = size[k] > 0.0 ? view_.cells[k] / size[k] : 0.0;
  }
}

/// \return false where there would be more than `most` triangles in all cells together
bool TriangleGrid::fill(const TriangleMesh &mesh, std::size_t most)
{
  const auto count = static_cast<std::size_t>(view_.cells[0]) * view_.cells[1] * view_.cells[2];
  const auto for_each_cell = [&](int t, const auto &visit) {
    int begin[3], end[3];
    for (int k = 0; k < 3; k++) {
      const Vec3 *corner = mesh.triangle(t).corner;
      begin[k] = view_.cell_of(TriangleGridView::lowest(mesh.triangle(t), k), k);
      end[k] = view_.cell_of(std::max({corner[0][k], corner[1][k], corner[2][k]}), k);
    }
    for (int z = begin[2]; z <= end[2]; z++)
      for (int y = begin[1]; y <= end[1]; y++)
        for (int x = begin[0]; x <= end[0]; x++)
          visit(static_cast<std::size_t>(x + view_.cells[0] * (y + view_.cells[1] * z)));
  };
  std::size_t entries = 0;
  first_.assign(count + 1, 0);
  for (int t = 0; t < mesh.count(); t++) {
    for_each_cell(t, [&](std::size_t cell) {
      first_[cell + 1]++;
      entries++;
    });
    if (entries > most && count > 1) return false;
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  triangles_.resize(entries);
  std::vector<int> place(first_.begin(), first_.end() - 1);
  for (int t = 0; t < mesh.count(); t++)
    for_each_cell(t, [&](std::size_t cell) {
      triangles_[place[cell]++] = t;
    });
  return true;
}

}    // namespace eepa
