// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_MESH_SHAPE_H
#define EEPA_WALLS_MESH_SHAPE_H

#include "mesh_view.h"
#include "shape.h"
#include "triangle_mesh.h"
#include "triangle_tree.h"

namespace eepa {

/// A surface of triangles, touched from both sides. Faces are triangles.
///
/// Contacts of a sphere are the places of the surface that are nearest to its centre among all near
/// them (local minima of the distance) and nearer than its radius. So a convex edge or corner is one
/// contact and a concave edge two, one with each face. Triangles that meet at a smooth edge stand for
/// one curved surface, which has one contact however many of its triangles the sphere overlaps: the
/// deepest one. See mesh_contacts.cpp.
class MeshShape : public Shape {
 public:
  /// Largest angle between the planes of triangles that stand for a curved surface [degrees].
  ///
  /// Programs that write curved surfaces as triangles turn by 5 to 10 degrees an edge where they are told
  /// to be fine, a cylinder of 30 facets by 12. Edges that are meant begin above: the transition into a
  /// hopper of which the walls are 15 degrees from the vertical. A sphere that lies in a concave edge
  /// that counts as smooth has one contact in place of two, and its normal jumps by that angle where it
  /// passes, which is as good as the facets are.
  static constexpr double default_smooth = 12.0;

  /// \param smooth  see default_smooth [degrees], 0 to 90; coplanar triangles always count
  /// \throw std::invalid_argument for another angle
  explicit MeshShape(TriangleMesh mesh, double smooth = default_smooth);

  bool collect(const Vec3 &centre, double reach, std::vector<SurfacePiece> &pieces) const override;
  void visit(const Vec3 &centre, double radius, const SurfacePiece *pieces, int count,
             std::vector<SurfacePoint> &found) const override;
  void prefetch(const SurfacePiece *pieces, int count) const override;
  SurfacePoint nearest(int face, const Vec3 &centre) const override;
  /// Whether the place of the old face that is nearest now is in the same direction as the contact, within
  /// the angle of smooth edges: the contact has come along coplanar triangles, over a smooth edge or over
  /// a convex one, and not from the other face at a concave edge.
  bool continues(int face, const SurfacePoint &now, const Vec3 &centre) const override;
  bool is_between(const Vec3 &before, const Vec3 &now) const override;
  double extent(const Vec3 &point, const Vec3 &axis) const override;
  /// From the corners of all triangles, in their order, and the angle of smooth edges.
  double check() const override;
  bool has_face(int face) const override { return face >= 0 && face < mesh_.count(); }

  const TriangleMesh &mesh() const { return mesh_; }
  /// The triangles in plain arrays, as long as this shape lives.
  MeshView view() const;
  const std::vector<char> &smooth_edges() const { return smooth_edges_; }
  bool is_smooth(int edge) const { return smooth_edges_[edge] != 0; }

 private:
  TriangleMesh mesh_;
  TriangleTree tree_;
  std::vector<char> smooth_edges_;
  double smooth_cosine_, continues_cosine_;
  double rounding_;    ///< of coordinates [length]
};

}    // namespace eepa

#endif
