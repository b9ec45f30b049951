// SPDX-License-Identifier: GPL-2.0-only
#include "triangle_tree.h"

#include <numeric>

namespace eepa {

TriangleTree::TriangleTree(const TriangleMesh &mesh)
{
  std::vector<int> triangles(mesh.count());
  std::iota(triangles.begin(), triangles.end(), 0);
  std::vector<Box> boxes(mesh.count());
  for (const int t : triangles) {
    for (const int v : mesh.facets[t].corners) boxes[t].extend(mesh.vertices[v]);
    all_.extend(boxes[t]);
  }
  tree_.init(triangles.begin(), triangles.end(), boxes.begin(), boxes.end());
}

}    // namespace eepa
