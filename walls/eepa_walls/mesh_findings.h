// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_MESH_FINDINGS_H
#define EEPA_WALLS_MESH_FINDINGS_H

#include <string>
#include <vector>

namespace eepa {

/// What can be wrong with a mesh without harm.
enum class MeshDefect {
  degenerate,        ///< triangles without area: dropped
  duplicate,         ///< triangles with the corners of an earlier one: dropped
  open_edge,         ///< edges of one triangle only: a crack, or the rim of an open surface
  branching_edge,    ///< edges of more than two triangles
  opposite,          ///< triangles that are the other way round than most of those around them
  stored_normal      ///< triangles with a stored normal against the order of their corners
};

struct MeshFinding {
  MeshDefect kind;
  int count = 0;                 ///< of triangles or edges, see MeshDefect
  std::vector<int> triangles;    ///< the first few of them, as counted in the file, from 1

  /// A sentence for a warning, without the name of the file.
  std::string text() const;
};

/// How many triangles a finding names.
constexpr int named_triangles = 5;

}    // namespace eepa

#endif
