// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_MESH_VIEW_H
#define EEPA_WALLS_MESH_VIEW_H

#include "shape.h"
#include "triangle.h"
#include "triangle_mesh.h"

#include <cmath>

// Which places of a mesh are contacts of a sphere, in plain arrays, for GPUs too. MeshContacts says what the rules are.

namespace eepa {

/// The triangles of a MeshShape.
struct MeshView {
  const TriangleMesh::Facet *facets;
  const char *smooth_edges;    ///< whether each edge is smooth
  int count;
  double tolerance;                          ///< as TriangleMesh has it [length]
  double rounding;                           ///< of coordinates [length]
  double smooth_cosine, continues_cosine;    ///< as MeshShape has them

  EEPA_FUNCTION const Triangle &triangle(int t) const { return facets[t].triangle; }
  /// By how much distances up to `reach` may be off. [length]
  EEPA_FUNCTION double off(double reach) const { return reach * 1e-12 + rounding; }
  EEPA_FUNCTION double safe(double reach) const { return reach + off(reach); }
};

/// Whether a triangle is within reach of a centre.
/// \param[out] piece  of the surface, if it is
EEPA_FUNCTION bool is_piece(const MeshView &mesh, int t, const Vec3 &centre, double reach,
                            SurfacePiece &piece)
{
  using std::fabs;
  const double safe = mesh.safe(reach);
  const Triangle &triangle = mesh.triangle(t);
  if (!(fabs(dot(triangle.normal, centre - triangle.corner[0])) <= safe)) return false;
  const double distance = closest_point(centre, triangle).distance;
  if (!(distance <= safe)) return false;
  piece.number = t;
  piece.distance = piece_distance(distance, mesh.off(reach));
  return true;
}

/// A triangle that a sphere touches.
struct MeshTouch {
  TrianglePoint at;
  int triangle;
  int patch;    ///< first of those that hang together with it through smooth edges
  int group;    ///< first of the contacts that are one with it; -1 where it is none
};

/// Distances that agree to this are the same: a foot beyond an edge by 1e-6 of the distance adds less.
constexpr double same_distance = 1.0 + 1e-12;

/// What a Shape tells of a point of a triangle.
EEPA_FUNCTION SurfacePoint surface_point(const Triangle &triangle, int number,
                                         const TrianglePoint &at, const Vec3 &centre)
{
  using std::sqrt;
  SurfacePoint point;
  point.face = number;
  point.distance = at.distance;
  if (at.feature == Feature::inside || !(at.distance > 0.0)) {
    point.normal = at.height < 0.0 ? Vec3(-triangle.normal) : triangle.normal;
    return point;
  }
  point.normal = (centre - at.point) / at.distance;
  point.curvature = 1.0 / at.distance;
  if (at.feature == Feature::edge) {
    const Vec3 along = triangle.corner[(at.number + 1) % 3] - triangle.corner[at.number];
    point.straight = along / sqrt(squared_length(along));
  }
  return point;
}

/// Whether the edge or corner that is touched is one of a triangle's as well.
EEPA_FUNCTION bool has_place_of(const MeshView &mesh, int triangle, int touched,
                                const TrianglePoint &at)
{
  const TriangleMesh::Facet &facet = mesh.facets[triangle], &own = mesh.facets[touched];
  for (int k = 0; k < 3; k++) {
    if (at.feature == Feature::corner && facet.corners[k] == own.corners[at.number]) return true;
    if (at.feature == Feature::edge && facet.edges[k] == own.edges[at.number]) return true;
  }
  return false;
}

EEPA_FUNCTION bool is_on(const MeshView &mesh, int triangle, const Vec3 &point)
{
  using std::fabs;
  const Triangle &t = mesh.triangle(triangle);
  if (fabs(dot(t.normal, point - t.corner[0])) > mesh.tolerance) return false;
  return closest_point(point, t).distance <= mesh.tolerance;
}

/// Whether a sphere lies on the face of a triangle, and not on its edge or corner.
EEPA_FUNCTION bool lies_on_face(const MeshView &mesh, const TrianglePoint &at)
{
  using std::fabs;
  return fabs(at.height) >= mesh.smooth_cosine * at.distance;
}

/// Whether two contacts on one patch are one.
EEPA_FUNCTION bool are_one(const MeshView &mesh, const TrianglePoint &a, const TrianglePoint &b,
                           const Vec3 &centre)
{
  return (lies_on_face(mesh, a) && lies_on_face(mesh, b)) ||
      dot(centre - a.point, centre - b.point) >= mesh.smooth_cosine * a.distance * b.distance;
}

/// As MeshShape::continues().
EEPA_FUNCTION bool continues(const MeshView &mesh, int face, const SurfacePoint &now,
                             const Vec3 &centre)
{
  if (face == now.face) return true;
  if (face < 0 || face >= mesh.count) return false;
  const Triangle &triangle = mesh.triangle(face);
  const TrianglePoint at = closest_point(centre, triangle);
  if (dot(surface_point(triangle, face, at, centre).normal, now.normal) >= mesh.continues_cosine)
    return true;
  // the foot may have left the old triangle by a second edge
  const double cosine = dot(triangle.normal, now.normal);
  return (at.height < 0.0 ? -cosine : cosine) >= mesh.continues_cosine;
}

namespace detail {
  EEPA_FUNCTION void sort_touches(MeshTouch *touches, int count)
  {
    for (int k = 1; k < count; k++) {
      const MeshTouch one = touches[k];
      int m = k;
      for (; m > 0; m--) {
        const MeshTouch &other = touches[m - 1];
        const bool later = one.at.distance != other.at.distance
            ? one.at.distance > other.at.distance
            : one.triangle > other.triangle;
        if (later) break;
        touches[m] = other;
      }
      touches[m] = one;
    }
  }

  EEPA_FUNCTION bool share_smooth_edge(const MeshView &mesh, int a, int b)
  {
    for (int k = 0; k < 3; k++) {
      const int edge = mesh.facets[a].edges[k];
      if (!mesh.smooth_edges[edge]) continue;
      for (int m = 0; m < 3; m++)
        if (mesh.facets[b].edges[m] == edge) return true;
    }
    return false;
  }
}    // namespace detail

/// Finds the contacts among the triangles that a sphere touches, as MeshContacts::find(): those of which `group` is
/// their own place. It compares all with each other.
/// \param[in,out] touches  nearest first afterwards
EEPA_FUNCTION void find_mesh_contacts(const MeshView &mesh, MeshTouch *touches, int count,
                                      const Vec3 &centre)
{
  detail::sort_touches(touches, count);
  int contacts = 0;
  for (int k = 0; k < count; k++) {
    MeshTouch &touch = touches[k];
    touch.patch = k;
    touch.group = k;
    for (int m = 0; m < k && touch.group >= 0; m++)
      if (has_place_of(mesh, touches[m].triangle, touch.triangle, touch.at)) touch.group = -1;
    contacts += touch.group >= 0;
  }
  if (contacts < 2) return;
  for (int k = 0; k < count; k++) {
    MeshTouch &touch = touches[k];
    if (touch.group < 0) continue;
    for (int m = 0; m < k && touch.group >= 0; m++)
      if (is_on(mesh, touches[m].triangle, touch.at.point) ||
          (touches[m].group >= 0 && touch.at.distance <= touches[m].at.distance * same_distance &&
           is_on(mesh, touch.triangle, touches[m].at.point)))
        touch.group = -1;
    contacts -= touch.group < 0;
  }
  if (contacts < 2) return;
  // patches, until none changes: there are few
  for (bool changed = true; changed;) {
    changed = false;
    for (int k = 1; k < count; k++)
      for (int m = 0; m < k; m++) {
        const int first = touches[k].patch < touches[m].patch ? touches[k].patch : touches[m].patch;
        if (touches[k].patch == touches[m].patch ||
            !detail::share_smooth_edge(mesh, touches[k].triangle, touches[m].triangle))
          continue;
        touches[k].patch = touches[m].patch = first;
        changed = true;
      }
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (int k = 1; k < count; k++)
      for (int m = 0; m < k; m++) {
        MeshTouch &a = touches[m], &b = touches[k];
        if (a.group < 0 || b.group < 0 || a.group == b.group || a.patch != b.patch) continue;
        if (!are_one(mesh, a.at, b.at, centre)) continue;
        a.group = b.group = a.group < b.group ? a.group : b.group;
        changed = true;
      }
  }
}

}    // namespace eepa

#endif
