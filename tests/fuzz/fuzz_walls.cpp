// SPDX-License-Identifier: GPL-2.0-only

// Any bytes as an STL file: it is read or refused by a message with its name, and what is read becomes a
// mesh, or is refused, in which spheres have contacts that make sense. Bytes that are no file are the
// corners of a small mesh, on a coarse lattice so that they meet, or anywhere.
// libFuzzer calls this; replay.cpp does where there is none.

#include <eepa_walls/mesh_shape.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace eepa;

#define REQUIRE(condition, value, limit)                                                           \
  do {                                                                                             \
    if (!(condition)) {                                                                            \
      std::fprintf(stderr, "%s:%d: violated: %s (%.17g, %.17g)\n", __FILE__, __LINE__, #condition, \
                   static_cast<double>(value), static_cast<double>(limit));                        \
      std::abort();                                                                                \
    }                                                                                              \
  } while (false)

const std::string name = "fuzz.stl";

void require_message(const std::invalid_argument &error)
{
  const std::string message = error.what();
  REQUIRE(message.compare(0, name.size() + 2, name + ": ") == 0, message.size(), 0);
  REQUIRE(message.size() < 400, message.size(), 400);
  for (const char c : message) REQUIRE(c >= ' ' && c <= '~', c, 0);
}

void touch(const MeshShape &shape, const Vec3 &centre, double radius,
           const std::vector<SurfacePiece> &all)
{
  const TriangleMesh &mesh = shape.mesh();
  std::vector<SurfacePiece> pieces;
  std::vector<SurfacePoint> found, whole;
  shape.collect(centre, radius, pieces);
  shape.visit(centre, radius, pieces.data(), static_cast<int>(pieces.size()), found);
  shape.visit(centre, radius, all.data(), static_cast<int>(all.size()), whole);
  REQUIRE(found.size() == whole.size(), found.size(), whole.size());
  double least = radius;
  for (const SurfacePiece &piece : all)
    least = std::min(least, shape.nearest(piece.number, centre).distance);
  REQUIRE(found.empty() == !(least < radius), least, radius);
  double nearest = radius;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const SurfacePoint &p = found[i];
    REQUIRE(p.face == whole[i].face && p.distance == whole[i].distance, p.distance,
            whole[i].distance);
    REQUIRE(i == 0 || found[i - 1].face < p.face, p.face, 0);
    REQUIRE(shape.has_face(p.face), p.face, mesh.count());
    REQUIRE(p.distance >= 0.0 && p.distance < radius, p.distance, radius);
    REQUIRE(std::fabs(p.normal.norm() - 1.0) < 1e-6, p.normal.norm(), 1);
    REQUIRE(std::isfinite(p.curvature) && p.curvature >= 0.0, p.curvature, 0);
    REQUIRE(p.straight.allFinite(), 0, 0);
    REQUIRE(shape.continues(p.face, p, centre), p.face, 0);
    nearest = std::min(nearest, p.distance);
  }
  // the nearest place of all is always a contact
  if (!found.empty()) REQUIRE(nearest == least, nearest, least);
}

void use(const StlTriangles &triangles)
{
  try {
    const MeshShape shape{TriangleMesh(triangles)};
    const TriangleMesh &mesh = shape.mesh();
    REQUIRE(mesh.count() > 0 && mesh.count() <= triangles.count(), mesh.count(), 0);
    REQUIRE(mesh.file_number.back() <= triangles.count(), mesh.file_number.back(), 0);
    REQUIRE(!shape.has_face(mesh.count()), mesh.count(), 0);
    for (const MeshFinding &finding : mesh.findings) {
      REQUIRE(finding.count >= 1 && !finding.triangles.empty(), finding.count, 0);
      REQUIRE(finding.text().size() < 300, finding.text().size(), 300);
    }
    for (int t = 0; t < mesh.count(); ++t) {
      REQUIRE(mesh.areas[t] > 0.0, mesh.areas[t], 0);
      REQUIRE(std::fabs(mesh.normal(t).norm() - 1.0) < 1e-12, mesh.normal(t).norm(), 1);
    }
    std::vector<SurfacePiece> all(mesh.count());
    for (int t = 0; t < mesh.count(); ++t) all[t] = {t, 0.0f};
    const double diagonal = (mesh.high - mesh.low).norm();
    Vec3 last = mesh.high;
    for (int t = 0; t < std::min(mesh.count(), 8); ++t) {
      const double radius = diagonal * std::pow(2.0, -t);
      for (const double height : {0.0, 0.5, 0.999}) {
        const Vec3 centre = mesh.centroid(t) + height * radius * mesh.normal(t);
        touch(shape, centre, radius, all);
        shape.is_between(last, centre);
        last = centre;
      }
      touch(shape, mesh.vertices[mesh.facets[t].corners[0]], radius, all);
    }
  } catch (const std::invalid_argument &error) {
    require_message(error);
  }
}

/// A small mesh out of bytes.
StlTriangles drawn(const std::uint8_t *data, std::size_t size)
{
  StlTriangles triangles;
  triangles.name = name;
  if (size < 10) return triangles;
  const bool lattice = data[0] % 2 == 0;
  const int cells = 1 + data[0] / 2 % 4;
  const double scale = std::pow(10.0, data[0] / 8 % 8 - 4);
  const std::size_t count = std::min<std::size_t>((size - 1) / 9, 40);
  for (std::size_t i = 0; i < 9 * count; ++i) {
    const int byte = data[1 + i];
    triangles.corners.push_back(scale * (lattice ? byte % (cells + 1) : byte / 255.0));
  }
  triangles.normals.resize(3 * count);
  return triangles;
}

}    // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  // a copy of exactly this size, so that a sanitizer sees what is read beyond
  const std::vector<char> bytes(data, data + size);
  try {
    use(parse_stl(bytes.data(), bytes.size(), name));
  } catch (const std::invalid_argument &error) {
    require_message(error);
  }
  use(drawn(data, size));
  return 0;
}
