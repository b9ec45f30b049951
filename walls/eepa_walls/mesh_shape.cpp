// SPDX-License-Identifier: GPL-2.0-only
#include "mesh_shape.h"

#include "mesh_contacts.h"
#include "text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace eepa {

namespace {

  constexpr double degree = M_PI / 180.0;
  /// Angles that a mesh is meant to have, such as the 12 degrees of 30 facets, come out of a file with
  /// an error [radians].
  constexpr double angle_rounding = 1e-4;
  /// A contact that goes on may turn by this at least, so that it passes a nearly flat edge.
  constexpr double least_turn = 1.0 * degree;

  double checked(double smooth)
  {
    if (!(smooth >= 0.0 && smooth <= 90.0))
      throw std::invalid_argument("smooth = " + text_of(smooth) +
                                  " is not allowed: it must be between 0 and 90 degrees");
    return smooth * degree;
  }

}    // namespace

MeshShape::MeshShape(TriangleMesh mesh, double smooth) : mesh_(std::move(mesh)), tree_(mesh_)
{
  const double angle = checked(smooth);
  smooth_cosine_ = std::cos(angle + angle_rounding);
  continues_cosine_ = std::cos(std::max(angle, least_turn) + angle_rounding);
  smooth_edges_.resize(mesh_.edges.size());
  for (std::size_t e = 0; e < mesh_.edges.size(); ++e) {
    const TriangleMesh::Edge &edge = mesh_.edges[e];
    smooth_edges_[e] = edge.count == 2 && edge.angle <= angle + edge.rounding + angle_rounding;
  }
  rounding_ = 1e-15 * mesh_.low.cwiseAbs().cwiseMax(mesh_.high.cwiseAbs()).maxCoeff();
}

MeshView MeshShape::view() const
{
  return {mesh_.facets.data(), smooth_edges_.data(), mesh_.count(),    mesh_.tolerance,
          rounding_,           smooth_cosine_,       continues_cosine_};
}

bool MeshShape::collect(const Vec3 &centre, double reach, std::vector<SurfacePiece> &pieces) const
{
  const std::size_t before = pieces.size();
  const MeshView mesh = view();
  tree_.for_each_near(centre, mesh.safe(reach), [&](int t) {
    SurfacePiece piece;
    if (is_piece(mesh, t, centre, reach, piece)) pieces.push_back(piece);
  });
  std::sort(pieces.begin() + static_cast<std::ptrdiff_t>(before), pieces.end(),
            [](const SurfacePiece &a, const SurfacePiece &b) {
              return is_nearer(a, b);
            });
  return pieces.size() > before;
}

void MeshShape::visit(const Vec3 &centre, double radius, const SurfacePiece *pieces, int count,
                      std::vector<SurfacePoint> &found) const
{
  if (count == 1) {    // mostly, and nothing to compare it with
    const int t = pieces[0].number;
    const TrianglePoint at = closest_point(centre, mesh_.triangle(t));
    if (at.distance < radius) found.push_back(surface_point(mesh_.triangle(t), t, at, centre));
    return;
  }
  // kept, so that no memory is asked for once it is large enough
  thread_local MeshContacts contacts;
  contacts.find(view(), centre, radius, pieces, count);
  for (const MeshContacts::Touch *touch : contacts.found())
    found.push_back(
        surface_point(mesh_.triangle(touch->triangle), touch->triangle, touch->at, centre));
}

void MeshShape::prefetch(const SurfacePiece *pieces, int count) const
{
#if defined(__GNUC__) || defined(__clang__)
  for (int k = 0; k < count; k++) {
    const auto *facet = reinterpret_cast<const char *>(&mesh_.facets[pieces[k].number]);
    __builtin_prefetch(facet);
    __builtin_prefetch(facet + 64);
  }
#else
  (void) pieces;
  (void) count;
#endif
}

SurfacePoint MeshShape::nearest(int face, const Vec3 &centre) const
{
  const Triangle &triangle = mesh_.triangle(face);
  return surface_point(triangle, face, closest_point(centre, triangle), centre);
}

bool MeshShape::continues(int face, const SurfacePoint &now, const Vec3 &centre) const
{
  return eepa::continues(view(), face, now, centre);
}

bool MeshShape::is_between(const Vec3 &before, const Vec3 &now) const
{
  TriangleTree::Box box(before);
  box.extend(now);
  box.min().array() -= rounding_;
  box.max().array() += rounding_;
  return tree_.any_in(box, [&](int t) {
    return crosses(before, now, mesh_.triangle(t), rounding_);
  });
}

double MeshShape::extent(const Vec3 &point, const Vec3 &axis) const
{
  double most = 0.0;
  for (const Vec3 &vertex : mesh_.vertices)
    most = std::max(most, squared_length(cross(axis, vertex - point)));
  return std::sqrt(most);
}

double MeshShape::check() const
{
  // Fowler-Noll-Vo
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](std::uint64_t value) {
    hash = (hash ^ value) * 0x100000001b3u;
  };
  for (const TriangleMesh::Facet &facet : mesh_.facets)
    for (const int vertex : facet.corners) add(static_cast<std::uint64_t>(vertex));
  for (const int number : mesh_.file_number) add(static_cast<std::uint64_t>(number));
  const auto add_number = [&add](double number) {
    std::uint64_t bits_of_number;
    std::memcpy(&bits_of_number, &number, sizeof number);
    add(bits_of_number);
  };
  for (const Vec3 &vertex : mesh_.vertices)
    for (int k = 0; k < 3; k++) add_number(vertex[k]);
  // which facets are one contact depends on it
  add_number(smooth_cosine_);
  constexpr int bits = 53;
  return static_cast<double>(hash >> (64 - bits));
}

}    // namespace eepa
