// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_MESH_TRANSFORMATION_H
#define EEPA_WALLS_MESH_TRANSFORMATION_H

#include <eepa/vector.h>

namespace eepa {

/// What is done to the points of a mesh when it is read: multiplied by the scale, then rotated about an
/// axis through the origin, then moved.
struct MeshTransformation {
  double scale = 1.0;                   ///< > 0, such as 0.001 from mm to m
  Vec3 axis = Vec3(0.0, 0.0, 1.0);      ///< of any length > 0
  double angle = 0.0;                   ///< of the right-handed rotation [degrees]
  Vec3 offset = Vec3(0.0, 0.0, 0.0);    ///< [length]
};

/// A transformation that is ready for many points. Angles that are a multiple of 90 degrees about an axis
/// of the coordinates are exact, so that a plate along an axis stays one.
class PointTransformation {
 public:
  /// \throw std::invalid_argument naming what is not finite or not > 0
  explicit PointTransformation(const MeshTransformation &transformation);

  Vec3 operator()(const Vec3 &point) const;
  /// Of a direction: rotated, and nothing else.
  Vec3 rotate(const Vec3 &direction) const;

 private:
  double scale_;
  Vec3 rows_[3];    ///< of the rotation's matrix
  Vec3 offset_;
};

}    // namespace eepa

#endif
