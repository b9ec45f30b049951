// SPDX-License-Identifier: GPL-2.0-only

// What is wrong with a mesh file or its words is said by name before anything runs.

#include "simulation.h"
#include "triangles.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>

using namespace eepa_test;

namespace {

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    "endloop\nendfacet\n";

struct Mistake {
  const char *name;
  std::string content;
  const char *words, *message;
};

class MeshMistake : public testing::TestWithParam<Mistake> {};

TEST_P(MeshMistake, IsNamed)
{
  const ScratchFile file(".stl");
  std::ofstream(file.name(), std::ios::binary) << GetParam().content;
  Simulation simulation;
  simulation.open_box(5.0);
  simulation.create({{Vec3(0, 0, 3)}});
  simulation("pair_style zero 1.0\npair_coeff * *\nregion ball sphere 0 0 0 2");
  const std::string words = with(GetParam().words, "FILE", file.name());
  EXPECT_TRUE(refuses(
      simulation, "fix w all wall/gran/eepa linear coeff 1e4 1e4 0 0 0.5 wall " + words + "\nrun 0",
      GetParam().message));
}

const std::string good = "solid x\n" + facet + "endsolid x\n";
const Mistake mistakes[] = {
    {"no_file", "", "mesh no_such_file.stl",
     "fix w wall/gran/eepa: wall mesh: no_such_file.stl: .*can not be opened"},
    {"folder", "", "mesh .", "fix w wall/gran/eepa: wall mesh: .: the file can not be"},
    {"empty", "", "mesh FILE", "fix w wall/gran/eepa: wall mesh: .*stl: .*has 0 bytes"},
    {"truncated", good.substr(0, 60), "mesh FILE",
     "fix w .*stl: line [0-9]+ has the end of the file"},
    {"short_binary", std::string(80, 'b') + std::string("\3\0\0\0", 4) + std::string(77, '\0'),
     "mesh FILE", "fix w .*has 161 bytes where a binary STL file of 3 triangles, .* has 234"},
    {"broken_number", with(good, "1 0 0", "1 0 x"), "mesh FILE", "fix w .*stl: line 5 .*'x'"},
    {"not_a_number", with(good, "1 0 0", "1 nan 0"), "mesh FILE", "fix w .*stl: line 5 .*nan"},
    {"no_area", with(good, "0 1 0", "2 0 0"), "mesh FILE",
     "fix w .*stl: its only triangle has no area"},
    {"scale_0", good, "mesh FILE scale 0",
     "fix w wall/gran/eepa: .*scale.* 0 is not allowed: it must be > 0"},
    {"scale_of_nothing", good, "mesh FILE scale", "fix w wall/gran/eepa: .*scale"},
    {"axis_0", good, "mesh FILE rotation 0 0 0 90", "fix w wall/gran/eepa: .*rotation"},
    {"steep", good, "mesh FILE smooth 91",
     "fix w wall/gran/eepa: .*smooth = 91 is not allowed: it must be .*90"},
    {"no_region", good, "region nowhere", "fix w wall/gran/eepa: .*region.* nowhere"},
    {"lost_region", good, "region ball\nregion ball delete",
     "fix w wall/gran/eepa: .*region.* ball"},
    {"faces_of_region", good, "region ball faces 10", "fix w wall/gran/eepa: .*faces"},
    {"faces_0", good, "mesh FILE faces 0", "fix w wall/gran/eepa: .*faces.* 0 is not allowed"},
};
INSTANTIATE_TEST_SUITE_P(Words, MeshMistake, testing::ValuesIn(mistakes), [](const auto &info) {
  return std::string(info.param.name);
});

// Defects that do no harm are warnings with their number and the first triangles.
TEST(MeshDefects, AreWarningsWithTheirNumber)
{
  const ScratchFile file(".stl"), log(".log");
  auto triangles = box(1.0, 2);
  triangles.push_back(triangles[5]);                                     // twice: number 48 below
  triangles.push_back({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)});    // no area: 49 below
  triangles.erase(triangles.begin() + 20);    // a hole of 3 edges; half of a box are turned over
  write_stl(file.name(), triangles);
  {
    Simulation simulation(MPI_COMM_WORLD, log.name());
    simulation.open_box(5.0);
    simulation.create({{Vec3(0, 0, 3)}});
    simulation("pair_style zero 1.0\npair_coeff * *\n"
               "fix w all wall/gran/eepa linear coeff 1e4 1e4 0 0 0.5 wall mesh " +
               file.name());
  }
  const std::string text = log.text();
  for (const char *warning :
       {"1 triangle without area is left out \\(triangle 49\\)",
        "1 triangle that is there twice is left out once \\(triangle 48\\)",
        "3 edges belong to one triangle only: .* \\(triangles [0-9]+, [0-9]+, [0-9]+\\)",
        "triangles are the other way round .* does no harm \\(triangles 1, 2, 3, 4, 5, ...\\)"}) {
    EXPECT_TRUE(std::regex_search(text, std::regex(warning))) << warning << "\n" << text;
  }
}

}    // namespace
