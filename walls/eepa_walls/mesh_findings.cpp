// SPDX-License-Identifier: GPL-2.0-only
#include "mesh_findings.h"

namespace eepa {

std::string MeshFinding::text() const
{
  const bool one = count == 1;
  std::string text = std::to_string(count);
  switch (kind) {
    case MeshDefect::degenerate:
      text += one ? " triangle without area is left out" : " triangles without area are left out";
      break;
    case MeshDefect::duplicate:
      text += one ? " triangle that is there twice is left out once"
                  : " triangles that are there more than once are left out";
      break;
    case MeshDefect::open_edge:
      text += one ? " edge belongs" : " edges belong";
      text += " to one triangle only: cracks, or the rim of an open surface";
      break;
    case MeshDefect::branching_edge:
      text += one ? " edge belongs" : " edges belong";
      text += " to more than two triangles";
      break;
    case MeshDefect::opposite:
      text += one ? " triangle is" : " triangles are";
      text += " the other way round than those next to ";
      text += one ? "it" : "them";
      text += " (flipped normals), which does no harm";
      break;
    case MeshDefect::stored_normal:
      text += one ? " triangle has" : " triangles have";
      text += " a stored normal against the order of the corners, and the order counts";
      break;
  }
  text += triangles.size() == 1 ? " (triangle" : " (triangles";
  for (std::size_t i = 0; i < triangles.size(); ++i)
    text += (i == 0 ? " " : ", ") + std::to_string(triangles[i]);
  if (count > static_cast<int>(triangles.size())) text += ", ...";
  return text + ")";
}

}    // namespace eepa
