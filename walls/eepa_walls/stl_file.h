// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_STL_FILE_H
#define EEPA_WALLS_STL_FILE_H

#include <cstddef>
#include <string>
#include <vector>

namespace eepa {

/// The triangles of an STL file, as they stand there.
struct StlTriangles {
  std::string name;    ///< of the file, for messages
  std::vector<double>
      corners;    ///< 9 a triangle: x, y, z of three corners [length unit of the file]
  std::vector<float> normals;    ///< 3 a triangle, as stored; zeros where the file gives none
  bool binary = false;

  int count() const { return static_cast<int>(corners.size() / 9); }
};

/// Reads a file as it is.
/// \throw std::invalid_argument naming the file when it can not be read
std::vector<char> read_bytes(const std::string &file);

/// Reads an STL file from memory: binary if and only if its size is 84 + 50 n bytes for the number n of
/// triangles that it gives, whatever its header says (many binary files begin with "solid"), else text.
/// Text may hold several solids, which are read as one surface. It may be of upper or lower case, with line
/// ends of any system; the decimal sign is a point in every locale.
/// \param name  of the file, for messages
/// \throw std::invalid_argument naming the file, the line, byte or triangle (counted from 1), what was
///     found there and what is allowed: for a file of another kind, one that is truncated, a facet
///     without exactly 3 vertices, a coordinate that is not a finite number, no triangles
StlTriangles parse_stl(const char *bytes, std::size_t size, const std::string &name);

/// read_bytes() and parse_stl()
StlTriangles read_stl(const std::string &file);

}    // namespace eepa

#endif
