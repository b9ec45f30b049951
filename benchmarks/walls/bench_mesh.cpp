// SPDX-License-Identifier: GPL-2.0-only

// What a wall of triangles costs without LAMMPS: reading a file, welding, edges, search tree, memory, and
// the contacts of a sphere. Times are the processor's.
//
//   bench_mesh [TRIANGLES [FILE.stl]]
//
// Without a file: a drum of about 10^6 triangles, closed by two plates, as binary and as text.

#include <eepa_walls/mesh_shape.h>

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace eepa;

/// Of this process, so that others on the machine count less.
double seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Memory of this process [MB]
double memory()
{
  std::ifstream file("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  file >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// A drum of radius 1 and length 2 about z: 2 n * m triangles around, and about as large ones in its ends.
std::vector<float> drum(int triangles)
{
  // 2 pi m^2 around and 2 * pi m^2 in the ends
  const int m = std::max(2, static_cast<int>(std::sqrt(triangles / (4.0 * M_PI))));
  const int n = std::max(8, static_cast<int>(M_PI * m));
  const int rings = m / 2 + 1;
  std::vector<float> corners;
  const auto put = [&](double r, int i, double z) {
    const double angle = 2.0 * M_PI * (i % n) / n;
    corners.push_back(static_cast<float>(r * std::cos(angle)));
    corners.push_back(static_cast<float>(r * std::sin(angle)));
    corners.push_back(static_cast<float>(z));
  };
  const auto quad = [&](int i, double r0, double z0, double r1, double z1) {
    put(r0, i, z0), put(r0, i + 1, z0), put(r1, i + 1, z1);
    if (r1 > 0.0) put(r0, i, z0), put(r1, i + 1, z1), put(r1, i, z1);
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) quad(i, 1.0, 2.0 * j / m, 1.0, 2.0 * (j + 1) / m);
    for (int j = 0; j < rings; ++j)
      for (const double z : {0.0, 2.0})
        quad(i, 1.0 - static_cast<double>(j) / rings, z, 1.0 - (j + 1.0) / rings, z);
  }
  return corners;
}

std::string binary(const std::vector<float> &corners)
{
  const std::uint32_t count = static_cast<std::uint32_t>(corners.size() / 9);
  std::string bytes(84 + 50 * static_cast<std::size_t>(count), '\0');
  std::memcpy(&bytes[80], &count, 4);
  for (std::size_t t = 0; t < count; ++t)
    std::memcpy(&bytes[84 + 50 * t + 12], &corners[9 * t], 36);
  return bytes;
}

std::string text(const std::vector<float> &corners)
{
  std::string bytes = "solid drum\n";
  char line[200];
  for (std::size_t t = 0; t < corners.size() / 9; ++t) {
    bytes += "facet normal 0.000000e+00 0.000000e+00 0.000000e+00\nouter loop\n";
    for (std::size_t c = 0; c < 3; ++c) {
      const float *x = &corners[9 * t + 3 * c];
      std::snprintf(line, sizeof line, "vertex %.9e %.9e %.9e\n", x[0], x[1], x[2]);
      bytes += line;
    }
    bytes += "endloop\nendfacet\n";
  }
  return bytes + "endsolid drum\n";
}

StlTriangles measure_reading(const char *kind, const std::string &bytes)
{
  const double start = seconds();
  StlTriangles triangles = parse_stl(bytes.data(), bytes.size(), kind);
  std::printf("%-8s %9d triangles  %8.1f MB read in %.3f s\n", kind, triangles.count(),
              static_cast<double>(bytes.size()) / 1e6, seconds() - start);
  return triangles;
}

/// Spheres that touch the mesh, their overlap a hundredth of their radius.
void measure_contacts(const MeshShape &shape, double radius, int spheres)
{
  const TriangleMesh &mesh = shape.mesh();
  std::mt19937_64 random(1);
  const auto number = [&] {
    return static_cast<double>(random() >> 11) * 0x1p-53;
  };
  std::vector<Vec3> centres;
  std::vector<SurfacePiece> pieces;
  std::vector<std::size_t> first = {0};
  for (int i = 0; i < spheres; ++i) {
    const int t = static_cast<int>(number() * mesh.count());
    centres.push_back(mesh.centroid(t) + 0.99 * radius * mesh.normal(t));
  }
  double start = seconds();
  for (const Vec3 &centre : centres) {
    shape.collect(centre, 1.1 * radius, pieces);
    first.push_back(pieces.size());
  }
  const double collect = seconds() - start;
  std::vector<SurfacePoint> found;
  std::size_t contacts = 0;
  constexpr int repeats = 5;
  start = seconds();
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (std::size_t i = 0; i < centres.size(); ++i) {
      found.clear();
      shape.visit(centres[i], radius, pieces.data() + first[i],
                  static_cast<int>(first[i + 1] - first[i]), found);
      contacts += found.size();
    }
  const double visit = (seconds() - start) / repeats;
  start = seconds();
  int crossings = 0;
  for (const Vec3 &centre : centres)
    crossings += shape.is_between(centre, centre + Vec3(1e-3 * radius, 0, 0));
  const double between = seconds() - start;
  std::printf("radius %-9.3g candidates %8.1f  contacts %.2f  collect %8.3f us  visit %8.3f us  "
              "is_between %6.3f us\n",
              radius, static_cast<double>(pieces.size()) / spheres,
              static_cast<double>(contacts) / repeats / spheres, 1e6 * collect / spheres,
              1e6 * visit / spheres, 1e6 * between / spheres + 0.0 * crossings);
}

}    // namespace

int main(int argc, char **argv)
{
  const double before = memory();
  const int wanted = argc > 1 ? std::atoi(argv[1]) : 1'000'000;
  StlTriangles triangles;
  if (argc > 2) {
    const std::vector<char> bytes = read_bytes(argv[2]);
    triangles = measure_reading("file", std::string(bytes.begin(), bytes.end()));
  } else {
    const std::vector<float> corners = drum(wanted);
    {
      measure_reading("text", text(corners));
    }
    triangles = measure_reading("binary", binary(corners));
  }
  double start = seconds();
  TriangleMesh mesh(triangles);
  std::printf("mesh     %9d triangles, %zu vertices, %zu edges in %.3f s\n", mesh.count(),
              mesh.vertices.size(), mesh.edges.size(), seconds() - start);
  for (const MeshFinding &finding : mesh.findings) std::printf("  %s\n", finding.text().c_str());
  triangles = StlTriangles();
  start = seconds();
  const double size = std::sqrt(2.0 * mesh.areas[0]);
  const MeshShape shape(std::move(mesh));
  std::printf("tree     in %.3f s\n", seconds() - start);
  std::printf("memory   %.0f MB more than before, %.0f bytes a triangle\n", memory() - before,
              1e6 * (memory() - before) / shape.mesh().count());
  for (const double radius : {0.3 * size, size, 3 * size, 10 * size, 100 * size})
    measure_contacts(shape, radius, radius > 20 * size ? 2000 : 100000);
  return 0;
}
