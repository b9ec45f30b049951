// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_CYLINDER_H
#define EEPA_WALLS_CYLINDER_H

#include "shape.h"

#include <cmath>
#include <limits>

namespace eepa {

/// The lateral surface of an endless cylinder about the z axis, which spheres touch from inside (face 0)
/// and from outside (face 1).
class Cylinder final : public Shape {
 public:
  static constexpr int inside = 0, outside = 1;

  /// \param radius  > 0 [length]
  explicit Cylinder(double radius) : radius_(radius) {}

  bool collect(const Vec3 &centre, double reach,
               std::vector<SurfacePiece> & /*pieces*/) const override
  {
    return std::fabs(radius_ - from_axis(centre)) < reach;
  }

  void visit(const Vec3 &centre, double radius, const SurfacePiece * /*pieces*/, int /*count*/,
             std::vector<SurfacePoint> &found) const override
  {
    const double r = from_axis(centre);
    if (std::fabs(radius_ - r) < radius)
      found.push_back(nearest(r < radius_ ? inside : outside, centre));
  }

  SurfacePoint nearest(int face, const Vec3 &centre) const override
  {
    const double r = from_axis(centre), sign = face == inside ? 1.0 : -1.0;
    SurfacePoint point;
    point.face = face;
    point.distance = sign * (radius_ - r);
    Vec3 radial(1.0, 0.0, 0.0);    // arbitrary for a centre on the axis
    if (r > 0.0) radial = Vec3(centre[0] / r, centre[1] / r, 0.0);
    point.normal = -sign * radial;
    // inside, the normal points at the axis, so it turns against the motion around the axis
    point.curvature = r > 0.0 ? -sign / r : 0.0;
    point.straight = Vec3(0.0, 0.0, 1.0);
    return point;
  }

  bool is_between(const Vec3 &before, const Vec3 &now) const override
  {
    if ((from_axis(before) < radius_) != (from_axis(now) < radius_)) return true;
    if (from_axis(before) < radius_) return false;    // a cylinder is convex
    // both outside: the path crosses if its point nearest to the axis is inside
    const double x = now[0] - before[0], y = now[1] - before[1], length_squared = x * x + y * y;
    if (!(length_squared > 0.0)) return false;
    const double part = -(before[0] * x + before[1] * y) / length_squared;
    if (part <= 0.0 || part >= 1.0) return false;
    return std::hypot(before[0] + part * x, before[1] + part * y) < radius_;
  }

  /// A cylinder that turns about an axis along z moves no further than its own axis does.
  double extent(const Vec3 &point, const Vec3 &axis) const override
  {
    return std::fabs(axis[2]) == 1.0 ? std::hypot(point[0], point[1])
                                     : std::numeric_limits<double>::infinity();
  }

  double approach(const Vec3 &shift) const override { return std::hypot(shift[0], shift[1]); }

  bool has_face(int face) const override { return face == inside || face == outside; }

 private:
  double radius_;

  static double from_axis(const Vec3 &centre)
  {
    return std::sqrt(centre[0] * centre[0] + centre[1] * centre[1]);
  }
};

}    // namespace eepa

#endif
