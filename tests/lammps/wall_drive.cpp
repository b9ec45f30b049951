// SPDX-License-Identifier: GPL-2.0-only

// The position belongs to the wall: a change of the time step, a restart or a change of the drive
// does not move the wall and loses no contact.

#include "simulation.h"
#include "wall_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>

using namespace eepa_test;

namespace {

constexpr int POSITION = 4, VELOCITY = 5, LOAD_WORK = 15, LOAD_DISSIPATED = 16;
constexpr const char *restarted_box =
    "comm_modify vel yes\nneighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
    "thermo 1000000\n";
const std::string contact = "fix w all wall/gran/eepa linear coeff 1e4 4e4 5e3 -1 0.5 ";

/// One sphere above, on or far from a wall, moved by its forces.
void open(Simulation &simulation, const std::string &wall, double height = 0.49, double dt = 1e-4)
{
  simulation.open_box(5.0);
  simulation.create({{Vec3(0, 0, height)}});
  simulation("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\ntimestep " +
             exact(dt) + "\n" + contact + wall);
}

double wiggled(double amplitude, double period, double t)
{
  return amplitude - amplitude * std::cos(2.0 * pi * t / period);
}

/* ---------------------------------------------------------------------- time */

TEST(WiggleTime, IsThatOfTheStepsMade)
{
  Simulation simulation;
  open(simulation, "wall zplane 0 NULL wiggle z 0.02 0.05", 3.0, 1e-5);
  simulation.run(1000);
  double t = 1000e-5;
  for (const char *lines : {"timestep 2e-5", "reset_timestep 0", "reset_timestep 70000"}) {
    simulation(lines);
    simulation.run(0);
    EXPECT_NEAR(simulation.fix("w", POSITION), wiggled(0.02, 0.05, t), 1e-12) << lines;
    simulation.run(500);
    t += 500 * 2e-5;
    EXPECT_NEAR(simulation.fix("w", POSITION), wiggled(0.02, 0.05, t), 1e-12) << lines;
  }
  // steps that grow in mid-run; LAMMPS's own sum of them is `time`
  simulation("fix dt all dt/reset 10 1e-5 4e-5 1e-3 units box");
  simulation.set_velocity(1, Vec3(0, 0, 30));
  const double before = simulation.thermo("time");
  simulation.run(100);
  const double passed = simulation.thermo("time") - before;
  EXPECT_GT(passed, 100 * 2.1e-5);
  EXPECT_NEAR(simulation.fix("w", POSITION), wiggled(0.02, 0.05, t + passed), 1e-11);
}

/* ---------------------------------------------------------------------- restart */

TEST(WallRestartDrive, StaysInPhaseWithAnotherTimeStep)
{
  const ScratchFile file(".restart");
  Simulation original, restarted;
  open(original, "wall zplane 0 NULL wiggle z 0.02 0.05", 3.0);
  original.run(123);
  original("write_restart " + file.name());
  restarted("read_restart " + file.name() + "\n" + restarted_box + "timestep 3e-4\n" + contact +
            "wall zplane 0 NULL wiggle z 0.02 0.05");
  EXPECT_EQ(restarted.fix("w", POSITION), original.fix("w", POSITION));    // before a run
  restarted.run(0);
  EXPECT_EQ(restarted.fix("w", POSITION), original.fix("w", POSITION));
  restarted.run(50);
  EXPECT_NEAR(restarted.fix("w", POSITION), wiggled(0.02, 0.05, 123e-4 + 50 * 3e-4), 1e-13);
}

class WallRestartOfAnother :
    public testing::TestWithParam<std::pair<const char *, const char *>> {};

// Position, contact and force of the wall stay, for any drive before and after.
TEST_P(WallRestartOfAnother, MotionLeavesItInItsPlace)
{
  const ScratchFile file(".restart");
  Simulation original, restarted;
  open(original, std::string("wall zplane -0.03 NULL ") + GetParam().first);
  original.run(150);
  const double place = original.fix("w", POSITION), force = original.fix("w", 3);
  ASSERT_GT(std::fabs(place + 0.03), 1e-4);
  ASSERT_NE(force, 0.0);
  original("write_restart " + file.name());
  restarted("read_restart " + file.name() + "\n" + restarted_box +
            "fix integrate all nve/sphere\ntimestep 1e-4\n" + contact + "wall zplane -0.03 NULL " +
            GetParam().second);
  EXPECT_NEAR(restarted.fix("w", POSITION), place, 1e-15);
  EXPECT_EQ(restarted.fix("w", 3), force);
  restarted.run(0);
  EXPECT_NEAR(restarted.fix("w", POSITION), place, 1e-15);
  EXPECT_NEAR(restarted.fix("w", 3), force, 1e-9 * std::fabs(force) + 1e-10);
  if (std::strncmp(GetParam().second, "wiggle", 6) == 0) {
    restarted.run(77);
    EXPECT_NEAR(restarted.fix("w", POSITION), place + wiggled(0.001, 0.03, 77e-4), 1e-13);
  }
}
INSTANTIATE_TEST_SUITE_P(Motions, WallRestartOfAnother,
                         testing::Values(std::pair("velocity 0 0 2.1", ""),
                                         std::pair("velocity 0 0 2.1", "shear x 0"),
                                         std::pair("velocity 0 0 2.1", "wiggle z 0.001 0.03"),
                                         std::pair("velocity 0 0 2.1", "load 0 mass 1"),
                                         std::pair("wiggle z 0.02 0.03", ""),
                                         std::pair("wiggle z 0.02 0.03", "wiggle z 0.001 0.03"),
                                         std::pair("load 300 mass 1", ""),
                                         std::pair("load 300 mass 1", "shear y 0"),
                                         std::pair("load 300 mass 1", "load 0 mass 1"),
                                         std::pair("load 300 mass 1", "velocity 0 0 0")));

// A velocity that depends on the wall's own position and force is the same before and after.
TEST(WallRestartDrive, EvaluatesVariablesWhereTheWallIs)
{
  const ScratchFile file(".restart");
  const std::string rest = "fix gravity all gravity 10 vector 0 0 -1\n" + contact +
      "restitution 0.5 wall zplane 0 NULL velocity 0 0 v_s";
  const std::string variable = "variable s equal 2*(f_w[4]<0.004)+0.001*f_w[3]-0.1*f_w[4]\n";
  Simulation original, restarted;
  original.open_box(4.0);
  original.create({{Vec3(0, 0, 0.49)}});
  original("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\ntimestep 1e-4\n" +
           variable + rest);
  original.run(150);
  original("write_restart " + file.name());
  restarted("read_restart " + file.name() + "\n" + restarted_box + variable +
            "fix integrate all nve/sphere\ntimestep 1e-4\n" + rest);
  for (int k = 1; k <= 6; k++) EXPECT_EQ(original.fix("w", k), restarted.fix("w", k)) << k;
  for (const int steps : {0, 300}) {
    original.run(steps);
    restarted.run(steps);
    for (int k = 1; k <= 6; k++) EXPECT_EQ(original.fix("w", k), restarted.fix("w", k)) << k;
  }
}

/* ---------------------------------------------------------------------- what does not fit */

class WallRestartMisfit : public testing::Test {
 protected:
  const ScratchFile file{".restart"};
  void write(const std::string &wall)
  {
    Simulation original;
    open(original, wall);
    original.run(10);
    original("write_restart " + file.name());
  }
  testing::AssertionResult refused(const std::string &wall, const std::string &regex)
  {
    Simulation restarted;
    return refuses(restarted, "read_restart " + file.name() + "\n" + restarted_box + contact + wall,
                   "fix w wall/gran/eepa: " + regex);
  }
  /// Replaces number `which` of the only occurrence of some numbers by another one.
  void damage(const std::vector<double> &numbers, std::size_t which, double value)
  {
    std::string bytes = file.text();
    const std::string before(reinterpret_cast<const char *>(numbers.data()),
                             numbers.size() * sizeof(double));
    const auto at = bytes.find(before);
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at + which * sizeof(double), sizeof(double),
                  reinterpret_cast<const char *>(&value), sizeof(double));
    std::ofstream(file.name(), std::ios::binary) << bytes;
  }
};

TEST_F(WallRestartMisfit, OfTheSurfaceIsRefused)
{
  write("wall zplane 0 NULL");
  for (const auto &[wall, name] :
       {std::pair("zplane NULL 0", "zplane NULL hi"), std::pair("xplane 0 NULL", "xplane lo NULL"),
        std::pair("zcylinder 3", "zcylinder"), std::pair("zplane 0 3", "zplane lo hi")})
    EXPECT_TRUE(refused(
        std::string("wall ") + wall,
        std::string("the wall of the restart file is zplane lo NULL, this one is ") + name));
  write("wall zcylinder 3");
  EXPECT_TRUE(refused("wall zcylinder 3.5", "wall zcylinder R = 3.5 is not allowed: it must be 3"));
}

// Another law reads the same histories differently, and a plane stays at the position of the file.
TEST_F(WallRestartMisfit, OfLawAndPlaceIsSaid)
{
  write("wall zplane 0 NULL");
  const std::string coefficients = " coeff 1e4 2e4 5e3 0 0.5 kt 1e3 wall zplane ";
  const struct {
    const char *law, *place, *words;
  } changes[] = {{"plateau", "0 NULL", "the law was linear when the restart file was written"},
                 {"linear exponent 1.5", "0 NULL", "exponent was 1 when the restart file"},
                 {"linear", "0.25 NULL", "wall lo = 0.25 is not used"},
                 {"linear", "0 NULL", ""}};
  for (const auto &change : changes) {
    const ScratchFile log(".log");
    {
      Simulation restarted(MPI_COMM_WORLD, log.name());
      restarted("read_restart " + file.name() + "\n" + restarted_box + "fix w all wall/gran/eepa " +
                change.law + coefficients + change.place);
      restarted.run(0);
      EXPECT_EQ(restarted.fix("w", POSITION), 0.0);
    }
    if (*change.words)
      EXPECT_NE(log.text().find(change.words), std::string::npos) << change.words;
    else
      EXPECT_EQ(log.text().find("WARNING: fix w"), std::string::npos);
  }
}

TEST_F(WallRestartMisfit, OfDamagedNumbersIsNamed)
{
  const std::string wall = "wall zplane -0.0625 NULL";
  write(wall);
  damage({LAMMPS_NS::wall_state::restart_format, LAMMPS_NS::wall_state::N_STATE, 2.0, 1.0, -0.0625},
         0, 2.0);
  EXPECT_TRUE(refused(wall, "the restart file has format 2, this version reads 3 and 5"));
  write(wall);
  damage({LAMMPS_NS::wall_state::restart_format, LAMMPS_NS::wall_state::N_STATE, 2.0, 1.0, -0.0625},
         1, 1e9);
  EXPECT_TRUE(refused(wall, "the restart file is damaged: count = "));
  write(wall);
  damage({LAMMPS_NS::wall_state::restart_format, LAMMPS_NS::wall_state::N_STATE, 2.0, 1.0, -0.0625},
         2, 7.0);
  EXPECT_TRUE(refused(wall, "the restart file is damaged: kind = 7"));
  write(wall);
  damage({LAMMPS_NS::wall_state::restart_format, LAMMPS_NS::wall_state::N_STATE, 2.0, 1.0, -0.0625},
         4, std::nan(""));
  EXPECT_TRUE(refused(wall, "the restart file is damaged: lo = -?nan"));
  // a particle's entry: 12 numbers of 4 values for 1 contact with face 0
  const struct {
    std::size_t which;
    double value;
    const char *regex;
  } damages[] = {{0, 7.0, "damaged at atom 1: length"},
                 {0, std::nan(""), "damaged at atom 1: length"},
                 {0, 1e15, "damaged at atom 1: length"},
                 {1, 7.0, "has 7 values a contact at atom 1 and the fix needs 4"},
                 {2, -1.0, "damaged at atom 1: number of its contacts with the wall = -1"},
                 {2, 1e9, "damaged at atom 1: number of its contacts"},
                 {3, 1.0, "damaged at atom 1: face of its contacts with the wall = 1"}};
  for (const auto &d : damages) {
    write("wall zplane 0 NULL");
    damage({12.0, 4.0, 1.0, 0.0}, d.which, d.value);
    EXPECT_TRUE(refused("wall zplane 0 NULL", std::string("the restart file (is )?") + d.regex));
  }
}

/* ---------------------------------------------------------------------- variables */

TEST(WallVariable, MustBeFinite)
{
  for (const char *value : {"exp(1000)-exp(1000)", "exp(1000)"})
    for (const char *motion : {"velocity 0 0 v_s", "shear x v_s"}) {
      Simulation simulation;
      simulation(std::string("variable s equal (") + value + ")*(step==7)+0");
      open(simulation, std::string("wall zplane 0 NULL ") + motion);
      const std::string name(motion, std::strcspn(motion, " "));
      EXPECT_TRUE(refuses(simulation, "run 20",
                          "fix w wall/gran/eepa: " + name +
                              " variable s = -?(nan|inf) at step [0-9]+ is not finite"));
    }
}

TEST(WallVariable, MustStillBeThere)
{
  Simulation simulation;
  simulation("variable s equal 0.1");
  open(simulation, "wall zplane 0 NULL velocity 0 0 v_s");
  simulation.run(5);
  EXPECT_TRUE(refuses(simulation, "variable s delete\nrun 5 pre no",
                      "fix w wall/gran/eepa: velocity variable s does not exist"));
}

TEST(WallVariable, NeedsANameAndIsNoPosition)
{
  Simulation simulation;
  open(simulation, "wall zplane 0 NULL");
  const std::string other = "fix o all wall/gran/eepa linear coeff 1e4 4e4 5e3 -1 0.5 wall ";
  EXPECT_TRUE(refuses(simulation, other + "zplane 0 NULL velocity 0 0 v_",
                      "fix o wall/gran/eepa: velocity = v_ names no variable"));
  EXPECT_TRUE(refuses(simulation, other + "yplane v_lo NULL",
                      "wall lo = v_lo is not allowed: .* velocity 0 v_name 0 .* load"));
}

/* ---------------------------------------------------------------------- cylinder */

// A particle that passes through the lateral surface at high speed, from inside and from outside.
TEST(CylinderContact, StaysOnItsSide)
{
  for (const double side : {1.0, -1.0}) {    // from inside, from outside
    Simulation simulation;
    simulation.open_box(5.0);
    simulation.create({{Vec3(2.0 - side * 0.6, 0, 0), Vec3(side * 100.0, 0, 0)}});
    simulation(
        "pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\ntimestep 1e-4\n" +
        contact + "wall zcylinder 2");
    EXPECT_TRUE(
        refuses(simulation, "run 300",
                "fix w wall/gran/eepa: the center of atom 1 is through the cylinder of radius 2 at "
                "step [0-9]+, at (2.00|1.99).*: it moves by .* a step and its radius is 0.5"));
  }
}

/* ---------------------------------------------------------------------- fix_modify */

// The wall continues from its position, with its contact; a platen also with its velocity.
TEST(ChangeOfDrive, KeepsPlaceContactAndSpeed)
{
  Simulation simulation;
  open(simulation, "wall zplane -0.03 NULL velocity 0 0 0.5", 0.48, 1e-4);
  simulation.run(150);
  double place = -0.03 + 0.5 * 150e-4;
  EXPECT_NEAR(simulation.fix("w", POSITION), place, 1e-14);
  const std::string changes[] = {"load 0 mass 2",
                                 "still",
                                 "wiggle z 0.001 0.03",
                                 "shear x 0",
                                 "load 0 mass 1 shear y 0",
                                 "shear y 0 load 5 mass 3",
                                 "still"};
  for (const auto &change : changes) {
    const double before = simulation.fix("w", POSITION), force = simulation.fix("w", 3);
    const double speed = simulation.fix("w", VELOCITY);
    simulation("fix_modify w " + change);
    EXPECT_NEAR(simulation.fix("w", POSITION), before, 1e-15) << change;
    simulation.run(0);
    EXPECT_NEAR(simulation.fix("w", POSITION), before, 1e-15) << change;
    EXPECT_NEAR(simulation.fix("w", 3), force, 1e-9 * std::fabs(force) + 1e-10) << change;
    if (change.find("load") != std::string::npos) {
      EXPECT_EQ(simulation.fix("w", VELOCITY), speed) << change;
    }
    simulation.run(20);
  }
}

// A free platen, started at 0.5 with mass 2 and stopped: work and dissipation balance.
TEST(ChangeOfDrive, BooksThePlatensEnergy)
{
  Simulation simulation;
  open(simulation, "wall zplane -4 NULL velocity 0 0 0.5", 3.0);
  simulation.run(10);
  simulation("fix_modify w load 0 mass 2");
  simulation.run(10);
  EXPECT_EQ(simulation.fix("w", VELOCITY), 0.5);
  EXPECT_EQ(simulation.fix("w", LOAD_WORK), 0.25);
  simulation("fix_modify w still");
  simulation.run(10);
  EXPECT_EQ(simulation.fix("w", LOAD_DISSIPATED), 0.25);
  EXPECT_NEAR(simulation.fix("w", POSITION), -4 + 0.5 * 20e-4, 1e-14);
}

TEST(ChangeOfDrive, OfAMistakeChangesNothing)
{
  Simulation simulation;
  open(simulation, "wall zplane -4 NULL velocity 0 0 0.5", 3.0);
  simulation.run(10);
  for (const auto &[line, regex] :
       {std::pair("velocity 0 0", "missing value: velocity vx vy vz"),
        std::pair("load 5", "load: missing keyword mass"),
        std::pair("load 5 mass 1 limits 0 1", "load limits 0 to 1 are not allowed"),
        std::pair("shear z 1", "shear dimension z is not allowed"),
        std::pair("velocity 0 0 v_none", "velocity variable none does not exist"),
        std::pair("still wiggle z 1 1", "only one of")})
    EXPECT_TRUE(refuses(simulation, std::string("fix_modify w ") + line, regex));
  simulation.run(10);
  EXPECT_NEAR(simulation.fix("w", POSITION), -4 + 0.5 * 20e-4, 1e-14);
}

/* ---------------------------------------------------------------------- load and shear */

// A platen of weight F on a sphere that is held below: it falls as without shear, and its surface
// drags the sphere with mu f.
TEST(LoadedSlide, DragsByFrictionAndMovesByItsLoad)
{
  const std::string platen = "fix w all wall/gran/eepa linear coeff 1e4 1e4 0 0 0.3 wall zplane "
                             "NULL 0.495 load -60 mass 1";
  double place[2], drag = 0.0, normal = 0.0;
  for (const int slides : {0, 1}) {
    Simulation simulation;
    simulation("variable v equal 2");
    simulation.open_box(5.0);
    simulation.create({{Vec3(0, 0, 0)}});
    simulation("pair_style zero 1.0\npair_coeff * *\ntimestep 1e-4\n" + platen +
               (slides ? " shear x v_v" : ""));
    simulation.run(300);
    place[slides] = simulation.fix("w", POSITION);
    drag = simulation.particle(1).f.x();
    normal = -simulation.particle(1).f.z();
  }
  EXPECT_EQ(place[0], place[1]);
  EXPECT_GT(normal, 1.0);
  EXPECT_NEAR(drag, 0.3 * normal, 1e-12 * normal);
}

// No force call has computed the reaction on the new platen.
TEST(ChangeOfDrive, ToALoadNeedsASetUp)
{
  Simulation simulation;
  open(simulation, "wall zplane 0 NULL velocity 0 0 0.5");
  simulation.run(5);
  EXPECT_TRUE(refuses(simulation, "fix_modify w load 5 mass 1\nrun 2 pre no",
                      "fix w wall/gran/eepa: load was given by fix_modify after the last set-up.*"
                      "leave out pre no"));
  EXPECT_EQ(simulation.thermo("step"), 6.0);
  simulation("run 2 post no\nrun 2 pre no post no");
}

TEST(MotionKeywords, MayHaveContactsBetweenThem)
{
  const std::string wall =
      "fix v all wall/gran/eepa linear coeff 1e4 2e4 0 0 0 wall zplane -4 NULL ";
  Simulation simulation;
  open(simulation, "wall zplane 0 NULL");
  simulation(wall + "shear x 0.1 contacts load 1 mass 1\nunfix v\n" + wall +
             "load 1 mass 1 contacts shear x 0.1\nunfix v");
  EXPECT_TRUE(refuses(simulation, wall + "still contacts velocity 0 0 1",
                      "only one of velocity, wiggle, shear, load and rotate is allowed"));
}

TEST(LoadedWall, HasFiniteEnergiesWithoutTime)
{
  Simulation simulation;
  open(simulation, "wall zplane 0 NULL load 5 mass 1 damping 2");
  simulation.run(10);
  const double dissipated = simulation.fix("w", LOAD_DISSIPATED);
  simulation("timestep 0");
  simulation.run(3);
  EXPECT_EQ(simulation.fix("w", LOAD_DISSIPATED), dissipated);
}

}    // namespace
