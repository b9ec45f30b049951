// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_PLANES_H
#define EEPA_WALLS_PLANES_H

#include "shape.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace eepa {

/// One or two planes normal to an axis. Each bounds a half space: a centre behind it is at a negative
/// distance. Face 0 is the lower plane, whose normal is +axis, face 1 the upper one.
class Planes final : public Shape {
 public:
  static constexpr int lower = 0, upper = 1;

  /// \param axis  0, 1 or 2
  /// \param coordinate  of lower and upper plane [length]
  Planes(int axis, bool has_lower, bool has_upper, double lower_at, double upper_at) :
      axis_(axis), has_{has_lower, has_upper}, coordinate_{lower_at, upper_at}
  {
  }

  /// A piece is a plane.
  bool collect(const Vec3 &centre, double reach, std::vector<SurfacePiece> &pieces) const override
  {
    const std::size_t before = pieces.size();
    const double rounding = 1e-12 * reach + 1e-15 * std::fabs(centre[axis_]);
    for (const int face : {lower, upper})
      if (has_[face] && distance(face, centre) < reach + rounding)
        pieces.push_back({face, piece_distance(distance(face, centre), rounding)});
    if (pieces.size() > before + 1 && pieces[before + 1].distance < pieces[before].distance)
      std::swap(pieces[before], pieces[before + 1]);
    return pieces.size() > before;
  }

  void visit(const Vec3 &centre, double radius, const SurfacePiece * /*pieces*/, int /*count*/,
             std::vector<SurfacePoint> &found) const override
  {
    for (const int face : {lower, upper})
      if (has_[face] && distance(face, centre) < radius) found.push_back(nearest(face, centre));
  }

  SurfacePoint nearest(int face, const Vec3 &centre) const override
  {
    SurfacePoint point;
    point.face = face;
    point.distance = distance(face, centre);
    point.normal[axis_] = face == lower ? 1.0 : -1.0;
    return point;
  }

  /// Never: a centre behind a plane is a contact of a large overlap.
  bool is_between(const Vec3 & /*before*/, const Vec3 & /*now*/) const override { return false; }

  /// A plane that turns about its normal stays where it is.
  double extent(const Vec3 & /*point*/, const Vec3 &axis) const override
  {
    return std::fabs(axis[axis_]) == 1.0 ? 0.0 : std::numeric_limits<double>::infinity();
  }

  double approach(const Vec3 &shift) const override { return std::fabs(shift[axis_]); }

  bool has_face(int face) const override { return (face == lower || face == upper) && has_[face]; }

 private:
  int axis_;
  bool has_[2];
  double coordinate_[2];

  double distance(int face, const Vec3 &centre) const
  {
    return face == lower ? centre[axis_] - coordinate_[lower] : coordinate_[upper] - centre[axis_];
  }
};

}    // namespace eepa

#endif
