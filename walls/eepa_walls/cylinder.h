// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_CYLINDER_H
#define EEPA_WALLS_CYLINDER_H

#include "shape.h"

#include <cmath>
#include <limits>

namespace eepa {

/// The geometry of Cylinder, for GPUs too.
struct CylinderSurface {
  static constexpr int inside = 0, outside = 1;

  double radius;    ///< > 0 [length]

  EEPA_FUNCTION static double from_axis(const Vec3 &centre)
  {
    return std::sqrt(centre[0] * centre[0] + centre[1] * centre[1]);
  }
  EEPA_FUNCTION SurfacePoint nearest(int face, const Vec3 &centre) const
  {
    const double r = from_axis(centre), sign = face == inside ? 1.0 : -1.0;
    SurfacePoint point;
    point.face = face;
    point.distance = sign * (radius - r);
    Vec3 radial(1.0, 0.0, 0.0);    // arbitrary for a centre on the axis
    if (r > 0.0) radial = Vec3(centre[0] / r, centre[1] / r, 0.0);
    point.normal = -sign * radial;
    // inside, the normal points at the axis, so it turns against the motion around the axis
    point.curvature = r > 0.0 ? -sign / r : 0.0;
    point.straight = Vec3(0.0, 0.0, 1.0);
    return point;
  }
  /// Whether a sphere may touch the surface, as Shape::collect().
  EEPA_FUNCTION bool is_near(const Vec3 &centre, double reach) const
  {
    return std::fabs(radius - from_axis(centre)) < reach;
  }
  /// \param found  is called with the point of each contact
  template <class Found>
  EEPA_FUNCTION void visit(const Vec3 &centre, double of_sphere, const Found &found) const
  {
    const double r = from_axis(centre);
    if (std::fabs(radius - r) < of_sphere) found(nearest(r < radius ? inside : outside, centre));
  }
  EEPA_FUNCTION bool continues(int face, const SurfacePoint &now, const Vec3 & /*centre*/) const
  {
    return face == now.face;
  }
  EEPA_FUNCTION bool is_between(const Vec3 &before, const Vec3 &now) const
  {
    if ((from_axis(before) < radius) != (from_axis(now) < radius)) return true;
    if (from_axis(before) < radius) return false;    // a cylinder is convex
    // both outside: the path crosses if its point nearest to the axis is inside
    const double x = now[0] - before[0], y = now[1] - before[1], length_squared = x * x + y * y;
    if (!(length_squared > 0.0)) return false;
    const double part = -(before[0] * x + before[1] * y) / length_squared;
    if (part <= 0.0 || part >= 1.0) return false;
    using std::hypot;
    return hypot(before[0] + part * x, before[1] + part * y) < radius;
  }
  /// How many contacts a sphere may have.
  EEPA_FUNCTION int room() const { return 1; }
};

/// The lateral surface of an endless cylinder about the z axis, which spheres touch from inside (face 0)
/// and from outside (face 1).
class Cylinder final : public Shape {
 public:
  static constexpr int inside = CylinderSurface::inside, outside = CylinderSurface::outside;

  /// \param radius  > 0 [length]
  explicit Cylinder(double radius) : surface_{radius} {}

  bool collect(const Vec3 &centre, double reach,
               std::vector<SurfacePiece> & /*pieces*/) const override
  {
    return surface_.is_near(centre, reach);
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

  /// A cylinder that turns about an axis along z moves no further than its own axis does.
  double extent(const Vec3 &point, const Vec3 &axis) const override
  {
    return std::fabs(axis[2]) == 1.0 ? std::hypot(point[0], point[1])
                                     : std::numeric_limits<double>::infinity();
  }

  double approach(const Vec3 &shift) const override { return std::hypot(shift[0], shift[1]); }

  bool has_face(int face) const override { return face == inside || face == outside; }

  const CylinderSurface &surface() const { return surface_; }

 private:
  CylinderSurface surface_;
};

}    // namespace eepa

#endif
