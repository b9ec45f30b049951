// SPDX-License-Identifier: GPL-2.0-only
// Reading of STL files.

#include "support.h"

namespace stl_file_test {
using namespace eepa_walls_test;

StlTriangles parse(const std::string &bytes)
{
  return parse_stl(bytes.data(), bytes.size(), "file.stl");
}

const std::string one_facet = "facet normal 0 0 1\n outer loop\n"
                              "  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n"
                              " endloop\nendfacet\n";

TEST(StlFile, ReadsText)
{
  const StlTriangles s =
      parse("solid a b facet\n" + one_facet + one_facet + "endsolid a b facet\n");
  EXPECT_FALSE(s.binary);
  ASSERT_EQ(s.count(), 2);
  EXPECT_EQ(s.corners[3], 1.0);
  EXPECT_EQ(s.normals[2], 1.0f);
}

}    // namespace stl_file_test
