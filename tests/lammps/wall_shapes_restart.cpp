// SPDX-License-Identifier: GPL-2.0-only

// Restart files of meshes: others are refused, and files of the format before are read.

#include "packing.h"
#include "triangles.h"
#include "wall_state.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

using namespace eepa_test;

namespace {

constexpr const char *restarted_box =
    "comm_modify vel yes\nneighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
    "thermo 1000000\n";
const std::string law = "fix w all wall/gran/eepa linear coeff 1e4 4e4 5e3 -1 0.5 wall ";
const std::string rest = "fix integrate all nve/sphere\ntimestep 1e-4\n"
                         "fix gravity all gravity 10 vector 0.3 0 -1\n";

void open(Simulation &simulation, const std::string &wall)
{
  simulation.open_box(4.0);
  simulation.create({{Vec3(0.2, 0.3, 0.49), Vec3(0.5, 0.3, -0.2), Vec3(1, 2, 3)}});
  simulation("pair_style zero 1.0\npair_coeff * *\n" + rest + law + wall);
}

TEST(ShapeRestart, RefusesOtherTriangles)
{
  const ScratchFile one(".stl"), other(".stl"), restart(".restart");
  std::vector<Corners> plate;
  add_rectangle(plate, Vec3(-3, -3, 0), Vec3(6, 0, 0), Vec3(0, 6, 0), 3, false, 1);
  write_stl(one.name(), plate);
  plate.pop_back();
  write_stl(other.name(), plate);
  {
    Simulation original;
    open(original, "mesh " + one.name());
    original.run(10);
    original("write_restart " + restart.name());
  }
  const std::string refusal = "fix w wall/gran/eepa: the triangles of wall mesh are others than";
  for (const std::string &wall :
       {other.name(), one.name() + " scale 1.001", one.name() + " offset 0 0 1e-3",
        one.name() + " rotation 0 0 1 90", one.name() + " smooth 20"}) {
    Simulation restarted;
    EXPECT_TRUE(refuses(
        restarted, "read_restart " + restart.name() + "\n" + restarted_box + law + "mesh " + wall,
        refusal))
        << wall;
  }
  Simulation region, same;
  EXPECT_TRUE(refuses(region,
                      "read_restart " + restart.name() + "\n" + restarted_box +
                          "region r sphere 0 0 0 2\n" + law + "region r",
                      "the wall of the restart file is mesh, this one is region"));
  EXPECT_EQ(error_of(same,
                     "read_restart " + restart.name() + "\n" + restarted_box + rest + law +
                         "mesh " + one.name() + " scale 1 smooth 12\nrun 1 post no"),
            "");
}

/// Makes a file of format 3 out of one of today's that has one particle with one contact.
void make_older(const std::string &name)
{
  using namespace LAMMPS_NS::wall_state;
  std::ifstream in(name, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  in.close();
  const auto put = [&bytes](std::size_t at, auto value) {
    bytes.replace(at, sizeof(value), reinterpret_cast<const char *>(&value), sizeof(value));
  };
  const auto number_at = [&bytes](std::size_t at) {
    double value = 0.0;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
  };
  // the list of the fix, after its size in bytes
  const double begin[] = {restart_format, N_STATE};
  const auto list = bytes.find(std::string(reinterpret_cast<const char *>(begin), sizeof(begin)));
  ASSERT_NE(list, std::string::npos);
  put(list, oldest_format);
  put(list + sizeof(double), static_cast<double>(N_OLD_STATE));
  put(list - sizeof(int), static_cast<int>(N_OLD_STATE * sizeof(double)));
  bytes.erase(list + N_OLD_STATE * sizeof(double), (N_STATE - N_OLD_STATE) * sizeof(double));
  // the particle: 12 numbers with 4 values of a history, 1 contact at face 0, whose place is left out
  const double entry[] = {12.0, 4.0, 1.0, 0.0};
  const auto contact =
      bytes.find(std::string(reinterpret_cast<const char *>(entry), sizeof(entry)));
  ASSERT_NE(contact, std::string::npos);
  std::size_t record = contact;
  for (;; record--) {
    ASSERT_GT(record, 4u);
    int length;
    std::memcpy(&length, bytes.data() + record - sizeof(int), sizeof(int));
    if (length > 12 && length < 100 && number_at(record) == length) break;
  }
  const double length = number_at(record);
  put(record - sizeof(int), static_cast<int>(length) - 4);
  put(record, length - 4.0);
  put(contact, 8.0);
  bytes.erase(contact + 4 * sizeof(double), 4 * sizeof(double));
  std::ofstream(name, std::ios::binary) << bytes;
}

TEST(ShapeRestart, ReadsTheFormatBefore)
{
  for (const char *wall :
       {"zplane 0 NULL", "zplane 0 NULL velocity 0.3 0 0.02", "zplane 0 NULL wiggle z 0.01 0.03",
        "zplane 0 NULL shear x 1", "zplane 0 NULL load 20 mass 5 damping 2"}) {
    const ScratchFile file(".restart");
    Simulation original, restarted;
    open(original, wall);
    original.run(100);
    original("write_restart " + file.name());
    make_older(file.name());
    if (HasFatalFailure()) return;
    restarted("read_restart " + file.name() + "\n" + restarted_box + rest + law + wall);
    original.run(0);
    restarted.run(0);
    EXPECT_EQ(original.fix("w", 6), 1.0);
    EXPECT_GT(original.particle(1).f.norm(), 10.0);
    EXPECT_EQ((original.particle(1).f - restarted.particle(1).f).norm(), 0.0) << wall;
    for (int k = 1; k <= 24; k++)
      EXPECT_EQ(original.fix("w", k), restarted.fix("w", k)) << wall << k;
    original.run(300);
    restarted.run(300);
    EXPECT_LT(difference(original.particles(), restarted.particles()), 1e-10) << wall;
  }
}

}    // namespace
