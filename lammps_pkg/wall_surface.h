// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_WALL_SURFACE_H
#define LMP_EEPA_WALL_SURFACE_H

#include <eepa/body.h>
#include <eepa_commands/wall_commands.h>

#include <array>
#include <cmath>

namespace LAMMPS_NS {

/// The surfaces of one wall: two planes normal to an axis, or both sides of the lateral surface of a
/// cylinder along z. Geometry and motion only; a kind of wall that is new belongs here and, as typed, in
/// eepa::WallShape.
///
/// A particle in contact stays on the side of the cylinder where the contact began: its overlap
/// with that side grows beyond its radius when its centre has gone through.
class WallSurfaces : public eepa::WallShape {
 public:
  std::array<double, 3> displacement = {0.0, 0.0, 0.0};    ///< since the wall was made
  std::array<double, 3> velocity = {0.0, 0.0, 0.0};
  double surface_speed = 0.0;    ///< cylinder: of its surface, turning about its axis

  /// Number of a surface in restart files: 0 for lo and a cylinder's inner side, 1 for the other.
  int face(int surface) const { return is_plane() && !has_lo ? 1 : surface; }

  /// Position along the normal of the first surface; the radius of a cylinder.
  double position() const
  {
    return is_plane() ? (has_lo ? lo : hi) + displacement[axis()] : radius;
  }
  /// Moves a single plane to a coordinate, without displacement.
  void place(double coordinate) { (has_lo ? lo : hi) = coordinate; }
  /// Direction from the first plane to the particles: 1 or -1 along the axis.
  double inward() const { return has_lo ? 1.0 : -1.0; }
  double normal_velocity() const { return is_plane() ? velocity[axis()] : 0.0; }

  /// Whether a new contact at x belongs to this surface and not to the other side of the cylinder.
  bool on_side(int surface, const double *x) const
  {
    return is_plane() || is_inner(surface) == (distance_from_axis(x) < radius);
  }

  /// Whether nearest() would find an overlap: a cheap test for the many particles without one.
  bool reaches(int surface, const double *x, double particle_radius) const
  {
    if (!is_plane())
      return on_side(surface, x) && std::fabs(radius - distance_from_axis(x)) < particle_radius;
    return plane_distance(surface, x) < particle_radius;
  }

  /// Whether x is nearer to any surface than `reach`, or behind a plane.
  bool near(const double *x, double reach) const
  {
    if (!is_plane()) return std::fabs(radius - distance_from_axis(x)) < reach;
    for (int surface = 0; surface < count(); surface++)
      if (plane_distance(surface, x) < reach) return true;
    return false;
  }

  /// Largest distance by which the surfaces may have approached any point since `before` [length]
  double moved_since(const WallSurfaces &before) const
  {
    if (is_plane()) return std::fabs(position() - before.position());
    return std::hypot(displacement[0] - before.displacement[0],
                      displacement[1] - before.displacement[1]);
  }

  /// Whether the inner side of a plane faces +axis.
  bool is_lower(int surface) const { return has_lo && surface == 0; }

  /// The point of a surface that is nearest to a particle.
  /// \param surface  0 .. count() - 1
  eepa::WallPoint<double> nearest(int surface, const eepa::Body<double> &particle) const
  {
    const double *x = particle.x.data();
    eepa::WallPoint<double> point;
    point.velocity = eepa::Vec3(velocity.data());
    if (is_plane()) {
      const int dim = axis();
      point.overlap = particle.radius - plane_distance(surface, x);
      point.normal.setZero();
      point.normal[dim] = is_lower(surface) ? 1.0 : -1.0;
      point.normal_rate.setZero();
      return point;
    }
    const double dx = x[0] - displacement[0];
    const double dy = x[1] - displacement[1];
    const double from_axis = distance_from_axis(x);
    const double inside = is_inner(surface) ? 1.0 : -1.0;
    point.overlap = particle.radius - inside * (radius - from_axis);
    eepa::Vec3 radial(1.0, 0.0, 0.0);    // arbitrary for a particle on the axis
    if (from_axis > 0.0) radial = eepa::Vec3(dx / from_axis, dy / from_axis, 0.0);
    point.normal = -inside * radial;
    // inside a cylinder the normal points at the axis, so it turns against the particle's motion
    // around the axis, relative to the cylinder
    const double curvature = from_axis > 0.0 ? inside / from_axis : 0.0;
    const eepa::Vec3 relative = particle.v - point.velocity;
    const eepa::Vec3 around(relative[0], relative[1], 0.0);
    point.normal_rate = -curvature * (around - around.dot(point.normal) * point.normal);
    point.velocity += surface_speed * eepa::Vec3(radial[1], -radial[0], 0.0);
    return point;
  }

 private:
  static bool is_inner(int surface) { return surface == 0; }

  double distance_from_axis(const double *x) const
  {
    const double dx = x[0] - displacement[0];
    const double dy = x[1] - displacement[1];
    return std::sqrt(dx * dx + dy * dy);
  }

  /// Distance of a centre from a plane, > 0 on the plane's inner side [length]
  double plane_distance(int surface, const double *x) const
  {
    const int dim = axis();
    return is_lower(surface) ? x[dim] - (lo + displacement[dim])
                             : (hi + displacement[dim]) - x[dim];
  }
};

}    // namespace LAMMPS_NS

#endif
