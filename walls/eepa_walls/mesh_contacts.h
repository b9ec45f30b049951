// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_MESH_CONTACTS_H
#define EEPA_WALLS_MESH_CONTACTS_H

#include "mesh_view.h"
#include "number_map.h"
#include "shape.h"

#include <vector>

namespace eepa {

/// Finds the contacts of a sphere with a mesh, and keeps the memory for the next one.
///
/// (i) A touched triangle (nearer than the radius) is no contact when its nearest point is also on
/// another triangle that is nearer: the distance goes on falling there. Of triangles that are as near to
/// rounding and share the point, one stands for all.
///
/// (ii) Contacts that are left on triangles that hang together through smooth edges, all of them touched,
/// are one where the sphere lies on their faces (within the angle of smooth edges), or where the
/// directions to the centre differ by no more than this angle, also in several steps; the deepest one
/// counts. The sphere on a square hole so has the four contacts of its rim, though the rim is one plate.
class MeshContacts {
 public:
  /// A triangle that the sphere touches.
  struct Touch {
    TrianglePoint at;
    int triangle;
  };

  /// \param pieces, count  triangles that may be touched, each once
  void find(const MeshView &mesh, const Vec3 &centre, double radius, const SurfacePiece *pieces,
            int count);

  /// The contacts, by the number of the triangle.
  const std::vector<const Touch *> &found() const { return found_; }

 private:
  void touch(const MeshView &mesh, const Vec3 &centre, double radius, const SurfacePiece *pieces,
             int count);
  void keep_minima(const MeshView &mesh);
  void drop_hidden_minima(const MeshView &mesh);
  void join_smooth(const MeshView &mesh, const Vec3 &centre);

  std::vector<Touch> touched_;          ///< nearest first
  std::vector<const Touch *> found_;    ///< nearest first, until they are sorted at the end
  std::vector<int> parents_;            ///< of a forest over touched_: triangles that hang together
  std::vector<int> groups_;             ///< of a forest over found_: contacts that are one
  NumberMap places_;                    ///< vertices and edges
};

}    // namespace eepa

#endif
