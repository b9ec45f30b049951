// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_TRIANGLE_H
#define EEPA_WALLS_TRIANGLE_H

#include <eepa/vector.h>

#include <cmath>

// Plain functions of one triangle, for the processor and for a GPU.

namespace eepa {

// Overloads for doubles, so that Eigen's expressions can be passed.
EEPA_FUNCTION double dot(const Vec3 &a, const Vec3 &b)
{
  return dot<double>(a, b);
}
EEPA_FUNCTION double squared_length(const Vec3 &a)
{
  return dot<double>(a, a);
}

EEPA_FUNCTION Vec3 cross(const Vec3 &a, const Vec3 &b)
{
  return Vec3(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

/// A triangle a, b, c. Its edge k leads from corner k to corner k + 1 (mod 3).
struct Triangle {
  Vec3 corner[3];
  Vec3 normal;    ///< unit vector, to the side from which a, b, c are seen counterclockwise
};

/// Twice the area times the unit normal; along an axis if and only if the triangle is normal to it to the
/// last bit. From the two shorter edges, of which the product loses least.
EEPA_FUNCTION Vec3 area_vector(const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double l0 = squared_length(ab), l1 = squared_length(bc), l2 = squared_length(ca);
  if (l0 >= l1 && l0 >= l2) return cross(bc, ca);
  if (l1 >= l2) return cross(ca, ab);
  return cross(ab, bc);
}

enum class Feature { inside, edge, corner };

/// The point of a triangle that is nearest to another point.
struct TrianglePoint {
  Vec3 point;
  double distance;    ///< >= 0 [length]
  double height;      ///< of the other point over the triangle's plane, along its normal [length]
  Feature feature;    ///< where the point is
  int number;         ///< of the edge or corner, 0 to 2
};

/// The point of the segment from p to q that is nearest to x; the same bits for q to p.
/// \param[out] part  0 at p or 1 at q, else in between
EEPA_FUNCTION Vec3 closest_on_segment(const Vec3 &x, const Vec3 &p, const Vec3 &q, double &part)
{
  const bool swap = p[0] != q[0] ? p[0] > q[0] : (p[1] != q[1] ? p[1] > q[1] : p[2] > q[2]);
  const Vec3 &first = swap ? q : p;
  const Vec3 &last = swap ? p : q;
  const Vec3 along = last - first;
  const double t = dot(x - first, along) / squared_length(along);
  if (!(t > 0.0)) {
    part = swap ? 1.0 : 0.0;
    return first;
  }
  if (t >= 1.0) {
    part = swap ? 0.0 : 1.0;
    return last;
  }
  part = swap ? 1.0 - t : t;
  return first + t * along;
}

/// Finds the point of a triangle that is nearest to x.
///
/// Inside, the distance is that from the plane, |n.(x - a)|: the bits that an analytic plane normal to an
/// axis has. A foot that is on the boundary to rounding counts as inside, so that edges between coplanar
/// triangles do not show. On an edge or corner, triangles that share it get the same bits. The triangle
/// may be as narrow as its normal can be told.
EEPA_FUNCTION TrianglePoint closest_point(const Vec3 &x, const Triangle &t)
{
  using std::fabs;
  using std::sqrt;
  // The foot is within 6.1e-8 of the distance from the boundary when the two distances agree to this; further off by
  // what the height is wrong with the normal of a sliver.
  constexpr double rounding = 8 * 2.3e-16;

  TrianglePoint found;
  found.height = dot(t.normal, x - t.corner[0]);
  found.feature = Feature::inside;
  found.number = 0;
  double least = 0.0;
  for (int k = 0; k < 3; ++k) {
    // The nearest point lies on an edge beyond which the foot is.
    const Vec3 &p = t.corner[k];
    const Vec3 &q = t.corner[k == 2 ? 0 : k + 1];
    if (!(dot(cross(q - p, t.normal), x - p) > 0.0)) continue;
    double part = 0.0;
    const Vec3 point = closest_on_segment(x, p, q, part);
    const double square = squared_length(x - point);
    if (found.feature != Feature::inside && !(square < least)) continue;
    least = square;
    found.point = point;
    const bool at_end = !(part > 0.0 && part < 1.0);
    found.feature = at_end ? Feature::corner : Feature::edge;
    found.number = at_end && part > 0.0 ? (k + 1) % 3 : k;
  }
  if (found.feature != Feature::inside) {
    found.distance = sqrt(least);
    if (fabs(found.height) < found.distance * (1.0 - rounding)) return found;
    found.feature = Feature::inside;
    found.number = 0;
  }
  found.point = x - found.height * t.normal;
  found.distance = fabs(found.height);
  return found;
}

/// Whether the segment between two points meets a triangle. Nothing slips through an edge that
/// triangles share, after Woop, Benthin and Wald, J. Comput. Graphics Tech. 2 (2013) 65: corners are
/// projected along the segment, each in one way, and the sign of an edge function of projected corners
/// is right or 0. Nor through the place where one segment ends and the next one begins: a point has one
/// height over the plane, and is on both sides when that is 0 to rounding.
/// \param rounding  of heights [length]
EEPA_FUNCTION bool crosses(const Vec3 &from, const Vec3 &to, const Triangle &t, double rounding)
{
  using std::fabs;
  const double before = dot(t.normal, from - t.corner[0]);
  const double now = dot(t.normal, to - t.corner[0]);
  if (before > rounding && now > rounding) return false;
  if (before < -rounding && now < -rounding) return false;
  const Vec3 along = to - from;
  int z = 0;
  if (fabs(along[1]) > fabs(along[z])) z = 1;
  if (fabs(along[2]) > fabs(along[z])) z = 2;
  if (!(fabs(along[z]) > 0.0)) return false;
  const int x = (z + 1) % 3, y = (z + 2) % 3;
  const double slope_x = along[x] / along[z], slope_y = along[y] / along[z];
  double u[3], v[3];
  for (int k = 0; k < 3; ++k) {
    const Vec3 corner = t.corner[k] - from;
    u[k] = corner[x] - slope_x * corner[z];
    v[k] = corner[y] - slope_y * corner[z];
  }
  const double a = u[2] * v[1] - v[2] * u[1];
  const double b = u[0] * v[2] - v[0] * u[2];
  const double c = u[1] * v[0] - v[1] * u[0];
  if ((a < 0.0 || b < 0.0 || c < 0.0) && (a > 0.0 || b > 0.0 || c > 0.0)) return false;
  // A triangle that is seen edge-on is passed by; its neighbours are met.
  return a != 0.0 || b != 0.0 || c != 0.0;
}

}    // namespace eepa

#endif
