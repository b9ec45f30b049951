// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_TRIANGLE_TREE_H
#define EEPA_WALLS_TRIANGLE_TREE_H

#include "triangle_mesh.h"

#include <unsupported/Eigen/BVH>

namespace eepa {

/// Finds the triangles of a mesh that may be near something: a hierarchy of bounding boxes of Eigen, in
/// the frame of the mesh, so that it is built once for a wall that moves.
class TriangleTree {
 public:
  using Box = Eigen::AlignedBox<double, 3>;

  explicit TriangleTree(const TriangleMesh &mesh);

  /// Calls take(triangle) for those that may be within a distance of a point, in no order.
  template <class Function>
  void for_each_near(const Vec3 &point, double reach, const Function &take) const
  {
    struct Query {
      const Vec3 &point;
      double square;
      const Function &take;
      bool intersectVolume(const Box &box)
      {
        return !(box.squaredExteriorDistance(point) > square);
      }
      bool intersectObject(int triangle)
      {
        take(triangle);
        return false;
      }
    } query = {point, reach * reach, take};
    // the library asks for what is within the outermost box, not for this box itself
    if (query.intersectVolume(all_)) Eigen::BVIntersect(tree_, query);
  }

  /// Whether wanted(triangle) holds for any that may meet a box.
  template <class Function> bool any_in(const Box &box, const Function &wanted) const
  {
    struct Query {
      const Box &box;
      const Function &wanted;
      bool found;
      bool intersectVolume(const Box &other) { return box.intersects(other); }
      bool intersectObject(int triangle) { return found = wanted(triangle); }
    } query = {box, wanted, false};
    if (query.intersectVolume(all_)) Eigen::BVIntersect(tree_, query);
    return query.found;
  }

 private:
  Eigen::KdBVH<double, 3, int> tree_;
  Box all_;
};

}    // namespace eepa

#endif
