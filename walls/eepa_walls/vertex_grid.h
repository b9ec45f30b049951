// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_VERTEX_GRID_H
#define EEPA_WALLS_VERTEX_GRID_H

#include "triangle.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace eepa {

/// Gives the same number to points that are equal or nearer than a tolerance: the lowest number of such a
/// point, so that the same point always has the same number.
class VertexGrid {
 public:
  /// \param low  corner of the points' bounding box
  /// \param tolerance  > 0 [length]
  /// \param expected  roughly how many different points there will be
  /// \param[in,out] points  receives the different points
  VertexGrid(const Vec3 &low, double tolerance, std::size_t expected, std::vector<Vec3> &points) :
      low_(low), tolerance_(tolerance), points_(points)
  {
    std::size_t size = 16;
    while (size < expected) size *= 2;
    first_.assign(size, -1);
    mask_ = size - 1;
  }

  int number_of(const Vec3 &point)
  {
    std::int64_t from[3], to[3];
    for (int i = 0; i < 3; ++i) {
      from[i] = cell_of(point[i] - tolerance_, i);
      to[i] = cell_of(point[i] + tolerance_, i);
    }
    int found = -1;
    for (std::int64_t x = from[0]; x <= to[0]; ++x)
      for (std::int64_t y = from[1]; y <= to[1]; ++y)
        for (std::int64_t z = from[2]; z <= to[2]; ++z)
          for (int p = first_[bucket_of(x, y, z)]; p >= 0; p = next_[p])
            if ((found < 0 || p < found) &&
                squared_length(points_[p] - point) <= tolerance_ * tolerance_)
              found = p;
    return found >= 0 ? found : add(point);
  }

 private:
  /// Cells in tolerances: few points are near two of them, and few cells have two points.
  static constexpr double cell_size = 16.0;

  std::int64_t cell_of(double x, int axis) const
  {
    // coordinates that many points have, such as those of the box, in the middle of cells
    return std::llround(std::floor((x - low_[axis]) / (cell_size * tolerance_) + 0.5));
  }

  std::size_t bucket_of(std::int64_t x, std::int64_t y, std::int64_t z) const
  {
    // products by large odd numbers, of which the high bits depend on all of the low ones
    const std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u ^
        static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu ^
        static_cast<std::uint64_t>(z) * 0x165667b19e3779f9u;
    return (h ^ h >> 29 ^ h >> 43) & mask_;
  }

  int add(const Vec3 &point)
  {
    const std::size_t bucket =
        bucket_of(cell_of(point[0], 0), cell_of(point[1], 1), cell_of(point[2], 2));
    const int number = static_cast<int>(points_.size());
    points_.push_back(point);
    next_.push_back(first_[bucket]);
    first_[bucket] = number;
    return number;
  }

  Vec3 low_;
  double tolerance_;
  std::vector<Vec3> &points_;
  std::vector<int> first_, next_;    ///< of each bucket, and after each point
  std::size_t mask_ = 0;
};

}    // namespace eepa

#endif
