// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_PLANES_H
#define EEPA_WALLS_PLANES_H

#include "shape.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace eepa {

/// The geometry of Planes, for GPUs too.
struct PlanesSurface {
  static constexpr int lower = 0, upper = 1;

  int axis;
  bool has[2];
  double coordinate[2];    ///< [length]

  EEPA_FUNCTION double distance(int face, const Vec3 &centre) const
  {
    return face == lower ? centre[axis] - coordinate[lower] : coordinate[upper] - centre[axis];
  }
  EEPA_FUNCTION SurfacePoint nearest(int face, const Vec3 &centre) const
  {
    SurfacePoint point;
    point.face = face;
    point.distance = distance(face, centre);
    point.normal[axis] = face == lower ? 1.0 : -1.0;
    return point;
  }
  /// Whether a sphere may touch a plane, as Shape::collect().
  EEPA_FUNCTION bool is_near(const Vec3 &centre, double reach) const
  {
    for (int face = lower; face <= upper; face++)
      if (has[face] && distance(face, centre) < reach + rounding(centre, reach)) return true;
    return false;
  }
  /// \param found  is called with the point of each contact
  template <class Found>
  EEPA_FUNCTION void visit(const Vec3 &centre, double radius, const Found &found) const
  {
    for (int face = lower; face <= upper; face++)
      if (has[face] && distance(face, centre) < radius) found(nearest(face, centre));
  }
  EEPA_FUNCTION bool continues(int face, const SurfacePoint &now, const Vec3 & /*centre*/) const
  {
    return face == now.face;
  }
  /// Never: a centre behind a plane is a contact of a large overlap.
  EEPA_FUNCTION bool is_between(const Vec3 & /*before*/, const Vec3 & /*now*/) const
  {
    return false;
  }
  /// How many contacts a sphere may have.
  EEPA_FUNCTION int room() const { return has[lower] && has[upper] ? 2 : 1; }

  /// By how much a distance may be off. [length]
  EEPA_FUNCTION double rounding(const Vec3 &centre, double reach) const
  {
    return 1e-12 * reach + 1e-15 * std::fabs(centre[axis]);
  }
};

/// One or two planes normal to an axis. Each bounds a half space: a centre behind it is at a negative
/// distance. Face 0 is the lower plane, whose normal is +axis, face 1 the upper one.
class Planes final : public Shape {
 public:
  static constexpr int lower = PlanesSurface::lower, upper = PlanesSurface::upper;

  /// \param axis  0, 1 or 2
  /// \param coordinate  of lower and upper plane [length]
  Planes(int axis, bool has_lower, bool has_upper, double lower_at, double upper_at) :
      surface_{axis, {has_lower, has_upper}, {lower_at, upper_at}}
  {
  }

  /// A piece is a plane.
  bool collect(const Vec3 &centre, double reach, std::vector<SurfacePiece> &pieces) const override
  {
    const std::size_t before = pieces.size();
    const double rounding = surface_.rounding(centre, reach);
    for (const int face : {lower, upper})
      if (has_face(face) && surface_.distance(face, centre) < reach + rounding)
        pieces.push_back({face, piece_distance(surface_.distance(face, centre), rounding)});
    if (pieces.size() > before + 1 && pieces[before + 1].distance < pieces[before].distance)
      std::swap(pieces[before], pieces[before + 1]);
    return pieces.size() > before;
  }

  void visit(const Vec3 &centre, double radius, const SurfacePiece * /*pieces*/, int /*count*/,
             std::vector<SurfacePoint> &found) const override
  {
    surface_.visit(centre, radius, [&found](const SurfacePoint &point) EEPA_LAMBDA {
      found.push_back(point);
    });
  }

  SurfacePoint nearest(int face, const Vec3 &centre) const override
  {
    return surface_.nearest(face, centre);
  }

  bool is_between(const Vec3 &before, const Vec3 &now) const override
  {
    return surface_.is_between(before, now);
  }

  /// A plane that turns about its normal stays where it is.
  double extent(const Vec3 & /*point*/, const Vec3 &axis) const override
  {
    return std::fabs(axis[surface_.axis]) == 1.0 ? 0.0 : std::numeric_limits<double>::infinity();
  }

  double approach(const Vec3 &shift) const override { return std::fabs(shift[surface_.axis]); }

  bool has_face(int face) const override
  {
    return (face == lower || face == upper) && surface_.has[face];
  }

  const PlanesSurface &surface() const { return surface_; }

 private:
  PlanesSurface surface_;
};

}    // namespace eepa

#endif
