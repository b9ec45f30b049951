// SPDX-License-Identifier: GPL-2.0-only

// Restart and data files: history to the bit, the same motion, settings that need no re-typing.

#include "packing.h"

#include <eepa_commands/parameter_table.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace eepa_test;

namespace {

constexpr const char *restarted_box =
    "comm_modify vel yes\nneighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
    "thermo 1000000\n";
constexpr const char *integrate = "fix integrate all nve/sphere\ntimestep 2e-4";

/// Everything that single() shows of each contact, in the order of IDs.
std::vector<std::vector<double>> histories(const Simulation &simulation)
{
  std::vector<std::vector<double>> all;
  for (const auto &contact : simulation.contacts()) {
    // the order of i and j may change, but not their largest overlap and energies
    all.push_back({contact.overlap(), contact.max_overlap(), contact.plastic_overlap(),
                   contact.p[11], contact.p[12], contact.p[13]});
  }
  return all;
}

/// Reads a restart file and sets up, without a step.
void take_up(Simulation &restarted, const ScratchFile &file)
{
  restarted("read_restart " + file.name() + "\n" + restarted_box + integrate);
  restarted.watch_contacts();
  restarted.run(0);
}

class PackingRestart : public testing::TestWithParam<const char *> {};

TEST_P(PackingRestart, GoesOnInMidUnloading)
{
  Packing packing;
  packing.types = 2;
  packing.polydisperse = true;
  const ScratchFile file(".restart");
  Simulation original, restarted;
  original.open_box(packing.half(), 2, "p p p");
  original.create(packing.spheres());
  original(std::string("pair_style gran/eepa ") + GetParam() + "\n" + integrate);
  original.watch_contacts();
  original.run(200);
  original("write_restart " + file.name());

  take_up(restarted, file);
  original.run(0);
  const auto a = histories(original), b = histories(restarted);
  ASSERT_GT(a.size(), 400u);
  ASSERT_EQ(a.size(), b.size());
  int unloading = 0;
  for (const auto &contact : original.contacts()) unloading += contact.branch() > 1.0;
  EXPECT_GT(unloading, 50);
  for (std::size_t k = 0; k < a.size(); k++) EXPECT_EQ(a[k], b[k]) << "contact " << k;

  original.run(300);
  restarted.run(300);
  EXPECT_LT(difference(original.particles(), restarted.particles()), 1e-10);
}
INSTANTIATE_TEST_SUITE_P(
    Laws, PackingRestart,
    testing::Values("linear\npair_coeff 1 1 1e4 2e4 5e3 -1 0.3 restitution 0.8\n"
                    "pair_coeff 2 2 2e4 3e4 5e3 -2 0.5 restitution 0.7",
                    "plateau scale 0.5 limit_damping yes dtcheck off\n"
                    "pair_coeff 1 1 1e4 2e4 5e3 -1 0.3 viscous 1 1\n"
                    "pair_coeff 1 2 1e4 3e4 5e3 -1 0.3 viscous 2 1\n"
                    "pair_coeff 2 2 1e4 4e4 5e3 -1 0.3 viscous 3 1",
                    "luding\npair_coeff 1 1 1e4 2e4 5e3 -1 0.3 depth 0.02 restitution 0.8\n"
                    "pair_coeff 2 2 2e4 3e4 5e3 -2 0.5 depth 0.01 restitution 0.7",
                    "linear\npair_coeff * * 1e4 2e4 5e3 -1 0.3 restitution 0.8 bound contact",
                    "linear exponent 1.5\n"
                    "pair_coeff * * 1e5 2e5 5e4 -1 0.3 kt 3e3 rolling sds 1e3 1 0.1",
                    "linear\npair_coeff 1 1 1e4 2e4 5e3 -1 0.3 twisting marshall\n"
                    "pair_coeff 1 2 1e4 2e4 5e3 -1 0.3\n"
                    "pair_coeff 2 2 1e4 2e4 5e3 -1 0.3 twisting marshall"));

// A restart of two spheres in the middle of unloading: force and delta_max to the bit.
TEST(Restart, KeepsTheHistoryToTheBit)
{
  const ScratchFile file(".restart");
  Simulation original, restarted;
  original.open_box(3.0);
  original.create({{Vec3(0, 0, 0), Vec3(0.5, 0, 0)}, {Vec3(1.02, 0, 0), Vec3(-0.5, 0.1, 0)}});
  original("pair_style gran/eepa linear\npair_coeff 1 1 1e4 4e4 5e3 0 0.5\n"
           "fix integrate all nve/sphere\ntimestep 1e-4");
  original.watch_contacts();
  original.run(340);
  original("run 0 post no\nwrite_restart " + file.name());
  const PairContact before = original.contacts().at(0);
  EXPECT_EQ(before.branch(), 2.0);
  EXPECT_GT(before.tangential().norm(), 0.0);
  take_up(restarted, file);
  const PairContact after = restarted.contacts().at(0);
  EXPECT_EQ(before.max_overlap(), after.max_overlap());
  EXPECT_EQ(before.normal_force, after.normal_force);
  EXPECT_EQ(before.tangential(), after.tangential());
}

/// A packing in a periodic box whose particles have moved since the neighbour list was made, so
/// that write_restart finds other ghosts than the list has.
void move_under_an_old_list(Simulation &original, const std::string &newton, int steps)
{
  Packing packing;
  packing.speed = 2.0;
  original.open_box(packing.half(), 1, "p p p", newton);
  original.create(packing.spheres());
  original("neighbor 0.45 bin\nneigh_modify every 1 delay 1000000 check no\n"
           "pair_style gran/eepa linear\npair_coeff 1 1 1e4 2e4 5e3 -1 0.3\n" +
           std::string(integrate));
  original.run(steps);
}

class ParallelOldListRestart : public testing::TestWithParam<const char *> {};

TEST_P(ParallelOldListRestart, FindsThePartnersOfTheRunsEnd)
{
  const ScratchFile after(".restart"), again(".restart"), amid(".restart");
  Simulation original, gone_on;
  move_under_an_old_list(original, GetParam(), 300);
  original("write_restart " + after.name() + "\nwrite_restart " + again.name());
  original.watch_contacts();
  original.run(0);
  const auto expected = histories(original);
  ASSERT_GT(expected.size(), 400u);

  // after a run without a set-up the histories beside the list are the newer ones again
  move_under_an_old_list(gone_on, GetParam(), 200);
  gone_on("restart 300 " + amid.name() + " " + amid.name() + "\nrun 100 pre no post no");

  for (const ScratchFile *file : {&after, &again, &amid}) {
    Simulation restarted;
    take_up(restarted, *file);
    EXPECT_EQ(expected, histories(restarted)) << (file == &amid);
  }
}

// write_restart moves particles to their processors; the neighbour list still has the old indices.
TEST_P(ParallelOldListRestart, IsNotFollowedByARunWithoutPreparation)
{
  const ScratchFile file(".restart"), second(".restart");
  Simulation original, restarted;
  move_under_an_old_list(original, GetParam(), 300);
  original("write_restart " + file.name());
  // a run of no steps computes no force
  original("run 0 pre no post no\nwrite_restart " + second.name());
  take_up(restarted, second);
  Simulation expected;
  take_up(expected, file);
  original.watch_contacts();
  original.run(0);
  ASSERT_GT(histories(expected).size(), 400u);
  EXPECT_EQ(histories(expected), histories(original));
  EXPECT_EQ(histories(expected), histories(restarted));
  EXPECT_TRUE(refuses(original, "write_restart " + file.name() + "\nrun 1 pre no",
                      "run with pre no after a command that set the system up anew"));
}

// LAMMPS frees the pages that hold histories when the page size changes.
TEST_P(ParallelOldListRestart, OutlivesOtherPageSizes)
{
  Simulation usual, changed;
  for (Simulation *simulation : {&usual, &changed}) {
    move_under_an_old_list(*simulation, GetParam(), 300);
    simulation->watch_contacts();
  }
  usual.run(0);
  for (const char *change : {"neigh_modify page 200000", "neigh_modify one 3000"}) {
    const ScratchFile file(".restart");
    changed(std::string(change) + "\nwrite_restart " + file.name());
    changed.run(0);
    EXPECT_EQ(histories(usual), histories(changed)) << change;
    Simulation restarted;
    take_up(restarted, file);
    EXPECT_EQ(histories(usual), histories(restarted)) << change;
  }
}

// A program that uses LAMMPS as a library can catch an error and go on.
TEST_P(ParallelOldListRestart, HasTheHistoriesOfAnInterruptedRun)
{
  const ScratchFile file(".restart");
  Simulation whole, stopped, restarted;
  move_under_an_old_list(whole, GetParam(), 300);
  whole.run(50);
  move_under_an_old_list(stopped, GetParam(), 300);
  EXPECT_TRUE(refuses(stopped,
                      "variable step equal step\nfix stop all halt 1 v_step >= 350 error hard\n"
                      "run 100",
                      "halt"));
  stopped("unfix stop\nwrite_restart " + file.name());
  take_up(restarted, file);
  for (Simulation *simulation : {&whole, &stopped}) {
    simulation->watch_contacts();
    simulation->run(0);
  }
  EXPECT_EQ(histories(whole), histories(stopped));
  EXPECT_EQ(histories(whole), histories(restarted));
}

INSTANTIATE_TEST_SUITE_P(Newton, ParallelOldListRestart, testing::Values("on", "off"));

// A particle with more contacts than LAMMPS reserves room for, when particles change processors.
TEST(ParallelRestartOfRestart, TakesAllContactsOfAParticleAlong)
{
  const ScratchFile file(".restart");
  Simulation original, moved;
  original.open_box(8.0, 1, "p p p");
  std::vector<Sphere> spheres(1);
  spheres[0].x = Vec3(-3.5, -3.5, -3.5);
  spheres[0].radius = 3.0;
  for (int k = 0; k < 700; k++) {    // on a spiral around the large one
    const double z = 1.0 - (2.0 * k + 1.0) / 700.0, angle = k * pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    Sphere small;
    small.radius = 0.1;
    small.x = spheres[0].x + 3.09 * Vec3(r * std::cos(angle), r * std::sin(angle), z);
    spheres.push_back(small);
  }
  original.create(spheres);
  original("pair_style gran/eepa linear dtcheck off\npair_coeff * * 1e4 2e4 5e3 0 0.3\n" +
           std::string("fix integrate all nve/sphere\ntimestep 1e-5\ncomm_modify cutoff 7\n"));
  original.watch_contacts();
  original.run(5);
  original("write_restart " + file.name());
  original.run(0);
  moved("read_restart " + file.name() + "\n" + restarted_box +
        "comm_modify cutoff 7\nfix integrate all nve/sphere\ntimestep 1e-5\n");
  moved.watch_contacts();
  moved.run(0);
  moved("group large id 1\ndisplace_atoms large move 7 7 7 units box\n"
        "displace_atoms large move -7 -7 -7 units box");
  moved.run(0);
  ASSERT_GE(moved.contacts().size(), 700u);
  ASSERT_EQ(moved.contacts().size(), original.contacts().size());
  const auto a = original.contacts(), b = moved.contacts();
  for (std::size_t k = 0; k < a.size(); k++) EXPECT_EQ(a[k].max_overlap(), b[k].max_overlap());
}

TEST(Restart, BeforeAnyRunSaysThatItHasNoHistories)
{
  const ScratchFile file(".restart"), log(".log");
  Simulation original(MPI_COMM_WORLD, log.name()), restarted;
  original.open_box(3.0);
  original.create({{Vec3(0, 0, 0)}, {Vec3(0.99, 0, 0)}});
  original("pair_style gran/eepa linear\npair_coeff 1 1 1e4 4e4 5e3 0 0.5 rolling sds 1e3 1 0.1\n" +
           std::string("write_restart ") + file.name() + " noinit\nlog none");
  EXPECT_NE(log.text().find("the restart file has no histories of contacts"), std::string::npos);
  restarted("read_restart " + file.name() + "\n" + restarted_box + integrate);
  restarted.run(1);
  EXPECT_GT(restarted.particle(2).f.norm(), 1.0);
}

TEST(ParallelRestartOfRestart, IsWrittenAgainWithoutARunBetween)
{
  const ScratchFile first(".restart"), second(".restart");
  Simulation original, copied, restarted;
  move_under_an_old_list(original, "on", 300);
  original("write_restart " + first.name());
  copied("read_restart " + first.name() + "\nwrite_restart " + second.name());
  take_up(restarted, second);
  original.watch_contacts();
  original.run(0);
  EXPECT_EQ(histories(original), histories(restarted));
}

TEST(Restart, DoesNotTakeAnotherPairStyleBeforeForItsHistory)
{
  // in the run that writes, gran/eepa is the second style of its kind that the instance has made
  const ScratchFile file(".restart");
  Simulation original, restarted;
  original.open_box(3.0);
  original.create({{Vec3(0, 0, 0), Vec3(0.5, 0, 0)}, {Vec3(1.02, 0, 0), Vec3(-0.5, 0, 0)}});
  original("pair_style gran/eepa plateau\npair_style zero 1.0\npair_coeff * *\n"
           "pair_style gran/eepa linear\npair_coeff 1 1 1e4 4e4 5e3 0 0.5\n"
           "fix integrate all nve/sphere\ntimestep 1e-4");
  original.run(340);
  original("write_restart " + file.name() + "\nrun 0 post no");
  restarted("read_restart " + file.name() + "\n" + restarted_box + integrate);
  restarted.run(0);
  EXPECT_GT(original.particle(2).f.norm(), 1.0);
  EXPECT_EQ(original.particle(2).f, restarted.particle(2).f);
}

TEST(Restart, KeepsEachHistoryOfHybrid)
{
  Packing packing;
  packing.types = 2;
  const ScratchFile file(".restart");
  // LAMMPS restores hybrid's sub-styles and wants pair_coeffs again
  const std::string coefficients =
      "pair_coeff 1 * gran/eepa 1 1e4 2e4 5e3 -1 0.3 rolling sds 1e3 1 0.1\n"
      "pair_coeff 2 2 gran/eepa 2 1e4 3e4 5e3 -1 0.3\n";
  Simulation original, restarted;
  original.open_box(packing.half(), 2, "p p p");
  original.create(packing.spheres());
  original("pair_style hybrid gran/eepa linear gran/eepa plateau\n" + coefficients + integrate);
  original.run(200);
  original("write_restart " + file.name());
  restarted("read_restart " + file.name() + "\n" + restarted_box + coefficients + integrate);
  original.run(200);
  restarted.run(200);
  EXPECT_LT(difference(original.particles(), restarted.particles()), 1e-10);
}

std::vector<Particle> end_of_wall_run(Simulation &simulation, int steps)
{
  simulation.run(steps);
  return simulation.particles();
}

class WallRestart : public testing::TestWithParam<const char *> {};

TEST_P(WallRestart, KeepsHistoryAndDisplacement)
{
  const std::string wall =
      std::string("fix wall all wall/gran/eepa linear coeff 1e4 4e4 5e3 -1 0.5 restitution 0.8 ") +
      GetParam();
  const std::string gravity = "fix gravity all gravity 10 vector 0 0 -1\n";
  const ScratchFile file(".restart");
  Simulation original, restarted;
  original.open_box(4.0);
  std::vector<Sphere> spheres;
  for (int k = 0; k < 5; k++)
    spheres.push_back({Vec3(1.2 * k - 2.4, 0, 0.49), Vec3(0.5, 0.3, -0.2 * k), Vec3(1, 2, 3)});
  original.create(spheres);
  original("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\ntimestep 1e-4\n" +
           gravity + wall);
  original.run(150);
  original("write_restart " + file.name());
  const double position = original.fix("wall", 4), velocity = original.fix("wall", 5);

  restarted("read_restart " + file.name() + "\n" + restarted_box +
            "fix integrate all nve/sphere\ntimestep 1e-4\n" + gravity + wall);
  original.run(0);
  restarted.run(0);
  EXPECT_EQ(restarted.fix("wall", 4), position);
  EXPECT_EQ(restarted.fix("wall", 5), velocity);
  EXPECT_GE(original.fix("wall", 6), 1.0);
  for (int k = 1; k <= 12; k++) EXPECT_EQ(original.fix("wall", k), restarted.fix("wall", k)) << k;
  EXPECT_LT(difference(end_of_wall_run(original, 300), end_of_wall_run(restarted, 300)), 1e-10);
}
INSTANTIATE_TEST_SUITE_P(Motions, WallRestart,
                         testing::Values("wall zplane 0 NULL", "wall zplane 0 0.99",
                                         "wall zplane 0 NULL velocity 0.3 0 0.2",
                                         "wall zplane 0 NULL wiggle z 0.01 0.03",
                                         "wall zplane 0 NULL shear x 1",
                                         "rolling sds 1e3 1 0.1 wall zplane 0 NULL",
                                         "twisting marshall wall zplane 0 NULL"));

// Histories and settings that can not be restored are refused by name.
class RestartMismatch : public testing::Test {
 protected:
  const ScratchFile file{".restart"};
  void write(const std::string &rolling)
  {
    Simulation original;
    original.open_box(4.0);
    original.create({{Vec3(0, 0, 0.49)}, {Vec3(0.99, 0, 0.49)}});
    original("pair_style gran/eepa linear\npair_coeff 1 1 1e4 4e4 5e3 -1 0.5" + rolling +
             "\nfix integrate all nve/sphere\ntimestep 1e-4\n"
             "fix wall all wall/gran/eepa linear coeff 1e4 4e4 5e3 -1 0.5" +
             rolling + " wall zplane 0 NULL");
    original.run(10);
    original("write_restart " + file.name());
  }
};

TEST_F(RestartMismatch, OfRollingInThePairStyleIsRefused)
{
  write("");
  Simulation restarted;
  EXPECT_TRUE(refuses(restarted,
                      "read_restart " + file.name() + "\n" + restarted_box +
                          "pair_coeff 1 1 1e4 4e4 5e3 -1 0.5 rolling sds 1e3 1 0.1\n" + integrate +
                          "\nrun 0",
                      "the restart file has 4 values a contact and the pair_coeffs need 7; rolling "
                      "sds and twisting can not be switched on or off with a restart"));
}

TEST_F(RestartMismatch, OfTwistingIsRefused)
{
  write("");
  Simulation pair, wall;
  EXPECT_TRUE(refuses(pair,
                      "read_restart " + file.name() + "\n" + restarted_box +
                          "pair_coeff 1 1 1e4 4e4 5e3 -1 0.5 twisting marshall\n" + integrate +
                          "\nrun 0",
                      "has 4 values a contact and the pair_coeffs need 5"));
  EXPECT_TRUE(refuses(wall,
                      "read_restart " + file.name() + "\n" + restarted_box +
                          "fix wall all wall/gran/eepa linear coeff 1e4 4e4 5e3 -1 0.5 twisting "
                          "marshall wall zplane 0 NULL",
                      "the restart file has 4 values a contact and the fix needs 5"));
}

TEST_F(RestartMismatch, OfRollingSwitchedOffIsRefused)
{
  write(" rolling sds 1e3 1 0.1");
  Simulation restarted;
  EXPECT_TRUE(refuses(restarted,
                      "read_restart " + file.name() + "\n" + restarted_box +
                          "pair_coeff 1 1 1e4 4e4 5e3 -1 0.5\n" + integrate + "\nrun 0",
                      "has 7 values a contact and the pair_coeffs need 4"));
}

TEST_F(RestartMismatch, OfRollingAtAWallIsRefused)
{
  write("");
  Simulation restarted;
  EXPECT_TRUE(
      refuses(restarted,
              "read_restart " + file.name() + "\n" + restarted_box +
                  "fix wall all wall/gran/eepa linear coeff 1e4 4e4 5e3 -1 0.5 rolling sds "
                  "1e3 1 0.1 wall zplane 0 NULL",
              "fix wall wall/gran/eepa: the restart file has 4 values a contact and the fix "
              "needs 7"));
}

TEST_F(RestartMismatch, OfSurfacesIsRefused)
{
  write("");
  Simulation restarted;
  EXPECT_TRUE(
      refuses(restarted,
              "read_restart " + file.name() + "\n" + restarted_box +
                  "fix wall all wall/gran/eepa linear coeff 1e4 4e4 5e3 -1 0.5 wall zplane 0 "
                  "1",
              "the wall of the restart file is zplane lo NULL, this one is zplane lo hi"));
}

TEST_F(RestartMismatch, OfTheFormatIsRefused)
{
  write("");
  std::string bytes = file.text();
  // the package's format comes before the law, the exponent and scale: 1 1 0
  const double settings[] = {eepa::restart_format, 1.0, 1.0, 0.0, 1.0, 0.0, 1.0};
  const std::string before(reinterpret_cast<const char *>(settings), sizeof(settings));
  const auto at = bytes.find(before);
  ASSERT_NE(at, std::string::npos);
  const double other = 7.0;
  bytes.replace(at, sizeof(double), reinterpret_cast<const char *>(&other), sizeof(double));
  std::ofstream(file.name(), std::ios::binary) << bytes;
  Simulation restarted;
  EXPECT_TRUE(refuses(restarted, "read_restart " + file.name(),
                      "the restart file has format 7 of gran/eepa, this version reads 2 to " +
                          std::to_string(eepa::restart_format)));
}

// write_data keeps the coefficients, given and mixed, but no histories, as with LAMMPS's own
// styles.
TEST(DataFile, KeepsThePairCoefficients)
{
  for (const char *which : {"ii", "ij"}) {
    Packing packing;
    packing.types = 2;
    packing.side = 4;
    const ScratchFile file(".data");
    Simulation original, reread;
    const std::string cross =
        which[1] == 'j' ? "\npair_coeff 1 2 1.1e4 2.5e4 0 -0.3 0.1 restitution 0.5" : "";
    original.open_box(packing.half(), 2, "p p p");
    original.create(packing.spheres());
    original("pair_style gran/eepa linear scale 0.7\n"
             "pair_coeff 1 1 1e4 2e4 5e3 -0.1 0.3 kt 3e3 restitution 0.8 rolling sds 1e3 0.1 0.2\n"
             "pair_coeff 2 2 1e4 3e4 5e3 -0.2 0.3 restitution 0.3 rolling sds 1e3 0.1 0.2" +
             cross + "\n" + integrate + "\nrun 0 post no\nwrite_data " + file.name() + " pair " +
             which);
    reread("units si\natom_style sphere\natom_modify map array\nboundary p p p\n"
           "comm_modify vel yes\nneighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
           "pair_style gran/eepa linear scale 0.7\nread_data " +
           file.name() + "\n" + integrate + "\nrun 0 post no");
    EXPECT_NE(
        file.text().find(which[1] == 'j' ? "PairIJ Coeffs # gran/eepa" : "Pair Coeffs # gran/eepa"),
        std::string::npos);
    // forces are compared, not motion: a data file has 16 digits, so positions differ in the last
    const auto a = original.particles(), b = reread.particles();
    double largest = 0.0, worst = 0.0;
    for (std::size_t k = 0; k < a.size(); k++) {
      largest = std::max(largest, a[k].f.norm());
      worst = std::max({worst, (a[k].f - b[k].f).norm(), (a[k].torque - b[k].torque).norm()});
    }
    EXPECT_GT(largest, 1.0);
    EXPECT_LT(worst, 1e-9 * largest) << which;
  }
}

TEST(DataFile, SaysThatItHasNoHistory)
{
  for (const char *which : {"ii", "ij"}) {
    const ScratchFile file(".data"), log(".log");
    Simulation simulation(MPI_COMM_WORLD, log.name());
    simulation.open_box(3.0, 2);
    simulation.create({{Vec3(0, 0, 0)}, {Vec3(0.99, 0, 0)}});
    simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 0 0.3\n" +
               std::string(integrate) + "\nrun 1 post no\nwrite_data " + file.name() + " pair " +
               which + "\nlog none");
    const std::string text = log.text(),
                      warning = "write_data writes the coefficients but not the "
                                "history of contacts";
    const auto at = text.find(warning);
    EXPECT_NE(at, std::string::npos) << text;
    EXPECT_EQ(text.find(warning, at + 1), std::string::npos);    // once
  }
}

}    // namespace
