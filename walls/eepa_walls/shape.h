// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_SHAPE_H
#define EEPA_WALLS_SHAPE_H

#include <eepa/vector.h>

#include <cmath>
#include <vector>

namespace eepa {

/// A place where a sphere and a shape touch or nearly touch: the point of one face that is nearest to the
/// sphere's centre.
struct SurfacePoint {
  int face = 0;                  ///< which contact of the sphere this is, see Shape
  Vec3 normal = Vec3::Zero();    ///< unit vector from the surface to the centre
  double distance =
      0.0;    ///< of the centre; negative behind the one face of a half space [length]
  /// Change of the normal with the motion of the centre along the surface: 0 at a flat face, 1/distance
  /// at an edge or a corner, 1/r outside of a cylinder, -1/r inside [1/length]
  double curvature = 0.0;
  Vec3 straight = Vec3::Zero();    ///< unit vector along which the normal stays the same, or 0
};

/// du/dt while the centre moves along a surface that stands still [1/time]
/// \param velocity  of the centre [length/time]
EEPA_FUNCTION Vec3 normal_rate(const SurfacePoint &point, const Vec3 &velocity)
{
  if (point.curvature == 0.0) return Vec3::Zero();
  const Vec3 along = velocity - dot<double>(velocity, point.normal) * point.normal;
  return point.curvature * (along - dot<double>(along, point.straight) * point.straight);
}

/// A piece of a surface, such as a triangle, that may touch a sphere.
struct SurfacePiece {
  int number;        ///< known to the shape
  float distance;    ///< at least this far from the centre at which it was collected [length]
};

/// A distance as a piece has it, for one that may be larger than the true one by rounding.
/// \param rounding  [length]
EEPA_FUNCTION float piece_distance(double distance, double rounding)
{
  using std::nextafter;
  const double least = distance - rounding;
  const auto near = static_cast<float>(least);
  return near > least ? nextafter(near, -HUGE_VALF) : near;
}
/// Whether a sphere may touch a piece.
/// \param moved  square of the distance between its centre and that at which the piece was collected [length^2]
EEPA_FUNCTION bool may_touch(const SurfacePiece &piece, double radius, double moved)
{
  const double gap = piece.distance - radius;
  return gap <= 0.0 || gap * gap <= moved;
}
/// Whether a piece comes before another one in a list.
EEPA_FUNCTION bool is_nearer(const SurfacePiece &a, const SurfacePiece &b)
{
  return a.distance != b.distance ? a.distance < b.distance : a.number < b.number;
}

/// Velocity of a surface at one point.
struct SurfaceVelocity {
  Vec3 linear = Vec3::Zero();     ///< [length/time]
  Vec3 angular = Vec3::Zero();    ///< [1/time]
};

/// A surface that spheres touch, fixed in a frame of its own. It knows geometry only: no law, no
/// motion and no histories.
///
/// A sphere can touch a shape at several places. Each contact is named by the number of a face, so
/// that it is found again in the next step. A face has at most one contact with a sphere.
class Shape {
 public:
  virtual ~Shape() = default;

  /// Finds what may touch a sphere, as long as its centre stays within a distance of the given one.
  /// \param reach  radius of the sphere and that distance [length]
  /// \param[in,out] pieces  receives pieces of the surface for visit(), the nearest first
  /// \return whether there may be a contact; `pieces` may stay empty even so
  virtual bool collect(const Vec3 &centre, double reach,
                       std::vector<SurfacePiece> &pieces) const = 0;

  /// Finds all contacts of a sphere: places nearer than its radius.
  /// \param pieces, count  as collect() gave them for this sphere; those may be left out that are too far
  ///     to be touched
  /// \param[in,out] found  receives them, in an order that depends on the sphere and the shape only
  virtual void visit(const Vec3 &centre, double radius, const SurfacePiece *pieces, int count,
                     std::vector<SurfacePoint> &found) const = 0;

  /// Fetches what visit() will read soon.
  virtual void prefetch(const SurfacePiece * /*pieces*/, int /*count*/) const {}

  /// The point of a face that is nearest to a centre, at any distance.
  virtual SurfacePoint nearest(int face, const Vec3 &centre) const = 0;

  /// du/dt while the centre moves [1/time]
  /// \param velocity  of the centre relative to the shape's frame [length/time]
  virtual Vec3 normal_rate(const SurfacePoint &point, const Vec3 & /*centre*/,
                           const Vec3 &velocity) const
  {
    return eepa::normal_rate(point, velocity);
  }

  /// Whether the surface moves in its own frame. Then visit() sees its present position, and nothing is
  /// known of where it will be in the next step.
  virtual bool moves() const { return false; }
  /// Velocity of the surface in its own frame where it touched the sphere a short time ago.
  /// \param path  of the sphere's centre since then [length]
  virtual SurfaceVelocity velocity(const SurfacePoint & /*point*/, const Vec3 & /*centre*/,
                                   const Vec3 & /*path*/) const
  {
    return {};
  }

  /// Velocity of the surface near a point in its own frame, without what changes its size.
  virtual Vec3 drift(const Vec3 & /*point*/) const { return Vec3::Zero(); }

  /// Whether a contact that was at `face` is the one that is at `now` in this step, because the sphere
  /// slides or rolls from one face to the next one.
  virtual bool continues(int face, const SurfacePoint &now, const Vec3 & /*centre*/) const
  {
    return face == now.face;
  }

  /// Whether a centre that moves in a straight line gets from one side of the surface to the other.
  virtual bool is_between(const Vec3 &before, const Vec3 &now) const = 0;

  /// Whether a centre is certainly on the side of a closed surface that spheres do not touch.
  virtual bool is_behind(const Vec3 & /*centre*/) const { return false; }

  /// Largest distance of the surface from an axis, infinity where it has none. A rotation about the
  /// axis moves no point further than that times the angle.
  /// \param axis  unit vector
  virtual double extent(const Vec3 &point, const Vec3 &axis) const = 0;

  /// Largest distance by which a shift of the shape brings its surface nearer to any point [length]
  virtual double approach(const Vec3 &shift) const { return shift.norm(); }

  /// A number that differs between shapes of different faces, for restart files; below 2^53.
  virtual double check() const { return 0.0; }

  /// Whether a number of a face, read from a file, is one of this shape.
  virtual bool has_face(int face) const = 0;
};

}    // namespace eepa

#endif
