// SPDX-License-Identifier: GPL-2.0-only
#include "mesh_contacts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace eepa {

namespace {

  std::int64_t key_of_vertex(int vertex)
  {
    return 2 * static_cast<std::int64_t>(vertex);
  }
  std::int64_t key_of_edge(int edge)
  {
    return 2 * static_cast<std::int64_t>(edge) + 1;
  }

  int root_of(std::vector<int> &parents, int i)
  {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
  }

  /// Joins two trees of a forest; the lower number becomes the root.
  void join(std::vector<int> &parents, int i, int j)
  {
    i = root_of(parents, i);
    j = root_of(parents, j);
    parents[std::max(i, j)] = std::min(i, j);
  }

}    // namespace

void MeshContacts::find(const MeshView &mesh, const Vec3 &centre, double radius,
                        const SurfacePiece *pieces, int count)
{
  found_.clear();
  touch(mesh, centre, radius, pieces, count);
  if (touched_.empty()) return;
  if (touched_.size() == 1) {
    found_.push_back(touched_.data());
    return;
  }
  keep_minima(mesh);
  if (found_.size() > 1) drop_hidden_minima(mesh);
  if (found_.size() > 1) join_smooth(mesh, centre);
  std::sort(found_.begin(), found_.end(), [](const Touch *a, const Touch *b) {
    return a->triangle < b->triangle;
  });
}

void MeshContacts::touch(const MeshView &mesh, const Vec3 &centre, double radius,
                         const SurfacePiece *pieces, int count)
{
  touched_.clear();
  for (int i = 0; i < count; ++i) {
    const int t = pieces[i].number;
    const TrianglePoint at = closest_point(centre, mesh.triangle(t));
    if (at.distance < radius) touched_.push_back({at, t});
  }
  if (touched_.size() < 2) return;
  std::sort(touched_.begin(), touched_.end(), [](const Touch &a, const Touch &b) {
    return a.at.distance != b.at.distance ? a.at.distance < b.at.distance : a.triangle < b.triangle;
  });
}

/// Rule (i), for edges and corners that triangles share: a nearer triangle has been there.
void MeshContacts::keep_minima(const MeshView &mesh)
{
  // so few are compared with each other sooner than they are looked up
  constexpr std::size_t few = 8;
  if (touched_.size() <= few) {
    for (const Touch &touch : touched_) {
      const bool nearer_there = std::any_of(
          static_cast<const Touch *>(touched_.data()), &touch, [&](const Touch &nearer) {
            return has_place_of(mesh, nearer.triangle, touch.triangle, touch.at);
          });
      if (!nearer_there) found_.push_back(&touch);
    }
    return;
  }
  places_.clear(6 * touched_.size());
  for (const Touch &touch : touched_) {
    const TriangleMesh::Three &corners = mesh.facets[touch.triangle].corners;
    const TriangleMesh::Three &edges = mesh.facets[touch.triangle].edges;
    const int number = touch.at.number;
    const bool nearer_there =
        (touch.at.feature == Feature::corner && places_.contains(key_of_vertex(corners[number]))) ||
        (touch.at.feature == Feature::edge && places_.contains(key_of_edge(edges[number])));
    if (!nearer_there) found_.push_back(&touch);
    for (int k = 0; k < 3; ++k) {
      places_.insert(key_of_vertex(corners[k]), 0);
      places_.insert(key_of_edge(edges[k]), 0);
    }
  }
}

/// Rule (i), for triangles that meet elsewhere: a corner on another one's edge, parts that stand on one
/// another, and the foot that is on an edge to rounding, of which one of the triangles knows and the other
/// one does not.
void MeshContacts::drop_hidden_minima(const MeshView &mesh)
{
  std::size_t kept = 0;
  for (const Touch *minimum : found_) {
    bool dropped = false;
    for (const Touch *nearer = touched_.data(); nearer != minimum && !dropped; ++nearer)
      dropped = is_on(mesh, nearer->triangle, minimum->at.point);
    for (std::size_t i = 0; i < kept && !dropped; ++i)
      dropped = minimum->at.distance <= found_[i]->at.distance * same_distance &&
          is_on(mesh, minimum->triangle, found_[i]->at.point);
    if (!dropped) found_[kept++] = minimum;
  }
  found_.resize(kept);
}

/// Rule (ii)
void MeshContacts::join_smooth(const MeshView &mesh, const Vec3 &centre)
{
  // which touched triangles hang together
  parents_.resize(touched_.size());
  std::iota(parents_.begin(), parents_.end(), 0);
  places_.clear(3 * touched_.size());
  for (int i = 0; i < static_cast<int>(touched_.size()); ++i)
    for (const int edge : mesh.facets[touched_[i].triangle].edges)
      if (mesh.smooth_edges[edge]) join(parents_, i, places_.insert(key_of_edge(edge), i));

  const auto patch_of = [&](const Touch *touch) {
    return root_of(parents_, static_cast<int>(touch - touched_.data()));
  };
  groups_.resize(found_.size());
  std::iota(groups_.begin(), groups_.end(), 0);
  for (std::size_t j = 1; j < found_.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      if (patch_of(found_[i]) == patch_of(found_[j]) &&
          are_one(mesh, found_[i]->at, found_[j]->at, centre))
        join(groups_, static_cast<int>(i), static_cast<int>(j));
    }
  // the root is the first of its group, and so the deepest
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found_.size(); ++i)
    if (groups_[i] == static_cast<int>(i)) found_[kept++] = found_[i];
  found_.resize(kept);
}

}    // namespace eepa
