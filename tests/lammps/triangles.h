// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TESTS_TRIANGLES_H
#define EEPA_TESTS_TRIANGLES_H

#include "packing.h"

#include <array>
#include <cmath>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace eepa_test {

using Corners = std::array<Vec3, 3>;

/// A text file with all digits. Every rank writes the same, the first one alone to disk.
inline void write_stl(const std::string &name, const std::vector<Corners> &triangles)
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) {
    std::ofstream file(name);
    file << "solid test\n";
    for (const Corners &corners : triangles) {
      file << "facet normal 0 0 0\nouter loop\n";
      for (const Vec3 &c : corners)
        file << "vertex " << exact(c[0]) << " " << exact(c[1]) << " " << exact(c[2]) << "\n";
      file << "endloop\nendfacet\n";
    }
    file << "endsolid test\n";
  }
  MPI_Barrier(MPI_COMM_WORLD);
}

/// A rectangle of cells, each cut into two triangles.
/// \param side, up  its edges
/// \param random  whether inner corners are moved in the plane, and cells cut at random
inline void add_rectangle(std::vector<Corners> &triangles, const Vec3 &corner, const Vec3 &side,
                          const Vec3 &up, int cells, bool random, unsigned seed)
{
  std::mt19937 generator(seed);
  std::vector<Vec3> points;
  for (int j = 0; j <= cells; j++)
    for (int i = 0; i <= cells; i++) {
      double a = i, b = j;
      const double da = 0.3 * uniform(generator), db = 0.3 * uniform(generator);
      if (random && i > 0 && j > 0 && i < cells && j < cells) {
        a += da;
        b += db;
      }
      points.push_back(corner + a / cells * side + b / cells * up);
    }
  const auto at = [&](int i, int j) {
    return points[j * (cells + 1) + i];
  };
  for (int j = 0; j < cells; j++)
    for (int i = 0; i < cells; i++) {
      const Vec3 p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1), s = at(i, j + 1);
      if (random && uniform(generator) > 0.0) {
        triangles.push_back({p, q, s});
        triangles.push_back({q, r, s});
      } else {
        triangles.push_back({p, q, r});
        triangles.push_back({p, r, s});
      }
    }
}

/// The surface of a cube [-half, half]^3.
inline std::vector<Corners> box(double half, int cells, bool random = false)
{
  std::vector<Corners> triangles;
  for (int axis = 0; axis < 3; axis++)
    for (const double sign : {-1.0, 1.0}) {
      Vec3 corner = Vec3::Constant(-half), side = Vec3::Zero(), up = Vec3::Zero();
      corner[axis] = sign * half;
      side[(axis + 1) % 3] = 2.0 * half;
      up[(axis + 2) % 3] = 2.0 * half;
      add_rectangle(triangles, corner, side, up, cells, random, 2 * axis + (sign > 0.0));
    }
  return triangles;
}

/// The lateral surface of a regular prism about the z axis, from -half to half, and its ends where wanted.
/// \param radius  of its corners
inline std::vector<Corners> prism(int facets, double radius, double half, bool ends)
{
  std::vector<Corners> triangles;
  const auto corner = [&](int k, double z) {
    const double angle = 2.0 * pi * (k % facets) / facets;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  for (int k = 0; k < facets; k++) {
    triangles.push_back({corner(k, -half), corner(k + 1, -half), corner(k + 1, half)});
    triangles.push_back({corner(k, -half), corner(k + 1, half), corner(k, half)});
    if (!ends) continue;
    for (const double z : {-half, half})
      triangles.push_back({Vec3(0, 0, z), corner(k, z), corner(k + 1, z)});
  }
  return triangles;
}

/// A prism with ends, and four lifters along it: plates from its wall inwards.
inline std::vector<Corners> drum(int facets)
{
  auto triangles = prism(facets, 3.3, 3.0, true);
  for (int k = 0; k < 4; k++) {
    const double angle = 0.3 + 0.5 * pi * k;
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    add_rectangle(triangles, 2.4 * out - Vec3(0, 0, 2.9), 0.88 * out, Vec3(0, 0, 5.8), 3, false, 1);
  }
  return triangles;
}

/// A text with each `word` of it replaced, such as the place of a file's name in a command.
inline std::string with(std::string text, const std::string &word, const std::string &value)
{
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + value.size()))
    text.replace(at, word.size(), value);
  return text;
}

}    // namespace eepa_test

#endif
