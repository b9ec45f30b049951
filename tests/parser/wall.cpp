// SPDX-License-Identifier: GPL-2.0-only

// The parser of fix wall/gran/eepa and of its fix_modify: whole commands, as the fix hands them over.

#include "support.h"

#include <eepa_commands/wall_commands.h>

#include <cmath>

using namespace eepa_test;

namespace {

#define COEFF "linear coeff 1e4 2e4 0 0 0 "

WallArguments wall_of(const std::string &line)
{
  Words warnings;
  return parse_wall(words("w all wall/gran/eepa " + line), 3, warnings);
}

WallShape upper_plane()
{
  WallShape shape;
  shape.has_hi = true;
  return shape;
}

TEST(Wall, IsReadAsAWhole)
{
  const WallArguments wall =
      wall_of("plateau scale 2 dtcheck off coeff 1 2 3 -4 5 kt 6 rolling constant 7 wall xplane "
              "-1.5 2 wiggle z 0.5 8 contacts");
  EXPECT_EQ(wall.style.settings.law, Law::plateau);
  EXPECT_EQ(wall.style.settings.reference_diameter, 2.0);
  EXPECT_EQ(wall.style.time_step_check, TimeStepCheck::off);
  EXPECT_EQ(wall.parameters.mu, 5.0);
  EXPECT_EQ(wall.parameters.kt, 6.0);
  EXPECT_EQ(wall.parameters.mu_r, 7.0);
  EXPECT_EQ(wall.shape.kind, WallShape::xplane);
  EXPECT_TRUE(wall.shape.has_lo && wall.shape.has_hi);
  EXPECT_EQ(wall.shape.lo, -1.5);
  EXPECT_EQ(wall.shape.hi, 2.0);
  EXPECT_EQ(wall.motion.drive, WallDrive::wiggle);
  EXPECT_EQ(wall.motion.wiggle_axis, 2);
  EXPECT_EQ(wall.motion.amplitude, 0.5);
  EXPECT_EQ(wall.motion.period, 8.0);
  EXPECT_TRUE(wall.contact_table);
}

TEST(Wall, StandsStillWithoutATableByDefault)
{
  const WallArguments wall = wall_of(COEFF "wall zplane 0 NULL");
  EXPECT_EQ(wall.motion.drive, WallDrive::still);
  EXPECT_FALSE(wall.motion.slides);
  EXPECT_FALSE(wall.contact_table);
}

TEST(Wall, HasTheSurfacesThatAreTyped)
{
  const WallShape lower = wall_of(COEFF "wall yplane -3 NULL").shape;
  EXPECT_EQ(lower.kind, WallShape::yplane);
  EXPECT_TRUE(lower.has_lo && !lower.has_hi);
  EXPECT_EQ(lower.lo, -3.0);
  EXPECT_EQ(lower.axis(), 1);
  EXPECT_EQ(lower.planes(), 1);
  const WallShape upper = wall_of(COEFF "wall zplane NULL 4").shape;
  EXPECT_TRUE(!upper.has_lo && upper.has_hi);
  EXPECT_EQ(upper.hi, 4.0);
  const WallShape cylinder = wall_of(COEFF "wall zcylinder 0.25").shape;
  EXPECT_FALSE(cylinder.is_plane());
  EXPECT_EQ(cylinder.radius, 0.25);
  EXPECT_EQ(cylinder.planes(), 0);
  EXPECT_STREQ(cylinder.kind_name(), "zcylinder");
}

TEST(Wall, TakesContactsAnywhereAfterTheSurfaces)
{
  for (const char *line :
       {"contacts load 1 mass 2 shear x 3", "load 1 contacts mass 2 shear x 3",
        "load 1 mass 2 contacts shear x 3", "load 1 mass 2 shear x 3 contacts"}) {
    const WallArguments wall = wall_of(std::string(COEFF "wall zplane 0 NULL ") + line);
    EXPECT_TRUE(wall.contact_table) << line;
    EXPECT_EQ(wall.motion.load.mass, 2.0);
    EXPECT_EQ(wall.motion.shear.value, 3.0);
  }
}

TEST(Wall, PassesWarningsOn)
{
  Words warnings;
  parse_wall(words("plateau coeff 1 4 0 0 0 wall zplane 0 NULL"), 0, warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("plateau with k2 = 4 > 2 k1 = 2"), std::string::npos);
}

MotionArguments motion_of(const std::string &line)
{
  return wall_of(COEFF "wall zplane NULL 1 " + line).motion;
}

TEST(Motion, IsWhatIsTyped)
{
  EXPECT_EQ(motion_of("still").drive, WallDrive::still);
  const MotionArguments velocity = motion_of("velocity 1 v_speed -2e-3");
  EXPECT_EQ(velocity.drive, WallDrive::velocity);
  EXPECT_EQ(velocity.velocity[0].value, 1.0);
  EXPECT_EQ(velocity.velocity[1].variable, "speed");
  EXPECT_EQ(velocity.velocity[2].value, -2e-3);
  EXPECT_FALSE(velocity.slides);
  const MotionArguments shear = motion_of("shear y v_s");
  EXPECT_EQ(shear.drive, WallDrive::shear);
  EXPECT_TRUE(shear.slides);
  EXPECT_EQ(shear.shear_axis, 1);
  EXPECT_EQ(shear.shear.variable, "s");
  for (const char *line : {"load 5 mass 1 shear x 0.1", "shear x 0.1 load 5 mass 1"}) {
    const MotionArguments both = motion_of(line);
    EXPECT_EQ(both.drive, WallDrive::load) << line;
    EXPECT_TRUE(both.slides) << line;
    EXPECT_EQ(both.shear.value, 0.1) << line;
    EXPECT_EQ(both.load.force.value, 5.0) << line;
  }
  // a cylinder slides along its axis and around it
  for (const char *dim : {"x", "y", "z"})
    EXPECT_TRUE(wall_of(std::string(COEFF "wall zcylinder 1 shear ") + dim + " 2").motion.slides);
}

TEST(Wall, IsARegionOrAMesh)
{
  const WallArguments region = wall_of(COEFF "wall region hopper contacts velocity 0 0 1");
  EXPECT_EQ(region.shape.kind, WallShape::region);
  EXPECT_EQ(region.shape.region_id, "hopper");
  EXPECT_TRUE(region.contact_table);
  EXPECT_EQ(region.motion.velocity[2].value, 1.0);
  const WallShape plain = wall_of(COEFF "wall mesh drum.stl").shape;
  EXPECT_EQ(plain.kind, WallShape::mesh);
  EXPECT_EQ(plain.file, "drum.stl");
  EXPECT_EQ(plain.placement.scale, 1.0);
  EXPECT_EQ(plain.smooth, WallShape::default_smooth);
  const WallArguments mesh = wall_of(
      COEFF "wall mesh lid.stl offset 1 2 3 scale 1e-3 rotation 0 2 0 90 smooth 30 faces 100 "
            "about 7 8 9 still");
  EXPECT_EQ(mesh.shape.placement.scale, 1e-3);
  EXPECT_EQ(mesh.shape.placement.axis, (std::array<double, 3>{0.0, 2.0, 0.0}));
  EXPECT_EQ(mesh.shape.placement.degrees, 90.0);
  EXPECT_EQ(mesh.shape.placement.offset, (std::array<double, 3>{1.0, 2.0, 3.0}));
  EXPECT_EQ(mesh.shape.smooth, 30.0);
  EXPECT_EQ(mesh.face_interval, 100);
  EXPECT_EQ(mesh.about, (std::array<double, 3>{7.0, 8.0, 9.0}));
}

TEST(Motion, TurnsBesideOtherDrives)
{
  const MotionArguments alone = motion_of("rotate 1 2 3 0 0 -4 v_omega");
  EXPECT_EQ(alone.drive, WallDrive::rotate);
  EXPECT_TRUE(alone.rotates);
  EXPECT_EQ(alone.rotation.point, (std::array<double, 3>{1.0, 2.0, 3.0}));
  EXPECT_EQ(alone.rotation.axis, (std::array<double, 3>{0.0, 0.0, -1.0}));
  EXPECT_EQ(alone.rotation.speed.variable, "omega");
  for (const char *line :
       {"rotate 0 0 0 0 0 1 5 velocity 1 0 0", "velocity 1 0 0 rotate 0 0 0 0 0 1 5"}) {
    const MotionArguments both = motion_of(line);
    EXPECT_EQ(both.drive, WallDrive::velocity) << line;
    EXPECT_TRUE(both.rotates) << line;
    EXPECT_EQ(both.rotation.speed.value, 5.0) << line;
  }
  EXPECT_TRUE(motion_of("rotate 0 0 0 0 0 1 5 wiggle z 1 1").rotates);
  // a lid that is pressed and turned
  for (const char *line : {"load z -5 mass 1 limits -1 0 rotate 0 0 0 3 0 4 5",
                           "rotate 0 0 0 3 0 4 5 load z -5 mass 1 limits -1 0"}) {
    const MotionArguments lid = wall_of(std::string(COEFF "wall mesh lid.stl ") + line).motion;
    EXPECT_EQ(lid.drive, WallDrive::load) << line;
    EXPECT_EQ(lid.load.axis, 2) << line;
    EXPECT_EQ(lid.load.force.value, -5.0) << line;
    EXPECT_EQ(lid.load.lowest, -1.0) << line;
    EXPECT_TRUE(lid.rotates) << line;
    EXPECT_EQ(lid.rotation.axis, (std::array<double, 3>{0.6, 0.0, 0.8})) << line;
  }
  EXPECT_EQ(wall_of(COEFF "wall region lid load x pressure 2 area 3 mass 1").motion.load.axis, 0);
}

TEST(Motion, HasANameForEachDrive)
{
  for (const char *line : {"still", "velocity 0 0 0", "wiggle x 1 1", "shear x 1", "load 1 mass 1",
                           "rotate 0 0 0 0 0 1 2"})
    EXPECT_EQ(name_of(motion_of(line).drive), words(line)[0]);
}

LoadArguments load_of(const std::string &line, std::size_t *end = nullptr)
{
  MotionArguments motion;
  const std::size_t stop =
      parse_motion(words("load " + line), 0, {"contacts", "shear"}, upper_plane(), motion);
  if (end) *end = stop;
  return motion.load;
}

TEST(LoadArguments, AreAForceOrAPressureAndAMass)
{
  const LoadArguments force = load_of("-5.5 mass 2");
  EXPECT_FALSE(force.by_pressure);
  EXPECT_EQ(force.force.value, -5.5);
  EXPECT_EQ(force.force.variable, "");
  EXPECT_EQ(force.mass, 2.0);
  EXPECT_EQ(force.damping, 0.0);
  EXPECT_EQ(force.lowest, -HUGE_VAL);
  EXPECT_EQ(force.highest, HUGE_VAL);
  const LoadArguments pressure =
      load_of("pressure v_p limits -1 NULL damping 3 mass 1e-3 area v_a_2");
  EXPECT_TRUE(pressure.by_pressure);
  EXPECT_EQ(pressure.pressure.variable, "p");
  EXPECT_EQ(pressure.area.variable, "a_2");
  EXPECT_EQ(pressure.mass, 1e-3);
  EXPECT_EQ(pressure.damping, 3.0);
  EXPECT_EQ(pressure.lowest, -1.0);
  EXPECT_EQ(pressure.highest, HUGE_VAL);
  EXPECT_EQ(load_of("pressure 1e5 area 0.25 mass 1").area.value, 0.25);
  EXPECT_EQ(load_of("1 mass 1 limits NULL 4").highest, 4.0);
}

TEST(LoadArguments, EndAtAKeywordOfAnother)
{
  std::size_t end = 0;
  load_of("5 mass 2 damping 1", &end);
  EXPECT_EQ(end, 6u);
  load_of("5 mass 2 contacts damping 1", &end);
  EXPECT_EQ(end, 4u);
  EXPECT_NE(refusal([] {
              load_of("contacts");
            }),
            "");
  EXPECT_EQ(refusal([] {
              load_of("5 contacts mass 2");
            }),
            "load: missing keyword mass");
}

TEST(FixModify, ReadsAMotionUpToWhatIsNotItsOwn)
{
  MotionArguments motion;
  EXPECT_EQ(parse_wall_change(words("velocity 1 2 3"), upper_plane(), motion), 4u);
  EXPECT_EQ(motion.drive, WallDrive::velocity);
  for (const char *other : {"dynamic/dof", "energy", "virial", "respa"})
    EXPECT_EQ(parse_wall_change(words(std::string("load 5 mass 1 ") + other + " yes"),
                                upper_plane(), motion),
              4u);
  EXPECT_EQ(motion.drive, WallDrive::load);
  EXPECT_EQ(parse_wall_change(words("still"), upper_plane(), motion), 1u);
  EXPECT_EQ(motion.drive, WallDrive::still);
}

TEST(FixModify, LeavesAloneWhatIsNoMotionOrWrong)
{
  MotionArguments motion = motion_of("velocity 1 2 3");
  EXPECT_EQ(parse_wall_change(words("energy yes"), upper_plane(), motion), 0u);
  EXPECT_EQ(parse_wall_change({}, upper_plane(), motion), 0u);
  EXPECT_EQ(refusal([&] {
              parse_wall_change(words("wiggle x 1 0"), upper_plane(), motion);
            }),
            "wiggle period = 0 is not allowed: it must be > 0");
  EXPECT_EQ(motion.drive, WallDrive::velocity);
  EXPECT_EQ(motion.velocity[2].value, 3.0);
}

TEST(FixModify, DoesNotRememberAnEarlierCommand)
{
  MotionArguments motion =
      motion_of("load pressure v_p area 2 mass 1 damping 2 limits 0 1 shear x 1");
  parse_wall_change(words("load 5 mass 3"), upper_plane(), motion);
  EXPECT_FALSE(motion.load.by_pressure);
  EXPECT_EQ(motion.load.pressure.variable, "");
  EXPECT_EQ(motion.load.damping, 0.0);
  EXPECT_EQ(motion.load.highest, HUGE_VAL);
  EXPECT_FALSE(motion.slides);
}

class WallMistake : public testing::TestWithParam<Mistake> {};
TEST_P(WallMistake, IsNamed)
{
  EXPECT_EQ(refusal([] {
              wall_of(GetParam().line);
            }),
            GetParam().message);
}
#define PLANE COEFF "wall xplane 0 NULL "
#define UNKNOWN_KEYWORD \
  " is unknown: it must be velocity, wiggle, shear, load, rotate, still, contacts, about or faces"
const Mistake wall_mistakes[] = {
    {"", "missing value: law (plateau, linear or luding)"},
    {"linear", "missing keyword coeff"},
    {"linear wall",
     "keyword 'wall' is unknown: it must be scale, exponent, limit_damping, dtcheck or largest"},
    {"linear coeff 1 2 3 -4", "missing value: mu"},
    {"linear coeff 1 2 3 wall xplane 0 1", "missing value: f0"},
    {COEFF, "missing keyword wall"},
    {COEFF "wall region", "missing value: wall region ID"},
    {COEFF "wall mesh", "missing value: wall mesh FILE"},
    {COEFF "wall mesh a.stl scale 0", "mesh scale = 0 is not allowed: it must be > 0"},
    {COEFF "wall mesh a.stl scale 1 scale 2", "keyword scale is given twice"},
    {COEFF "wall mesh a.stl rotation 0 0 0 90",
     "mesh rotation axis = 0 0 0 is not allowed: it must have a direction"},
    {COEFF "wall mesh a.stl rotation 0 0 1", "missing value: mesh rotation ax ay az degrees"},
    {COEFF "wall mesh a.stl offset 0 x 1", "mesh offset = x is not a finite number"},
    {COEFF "wall mesh a.stl smooth 90",
     "mesh smooth = 90 is not allowed: it must be >= 0 and < 90 degrees"},
    {COEFF "wall mesh a.stl faces 0",
     "faces = 0 is not allowed: it must be a whole number of steps, >= 1"},
    {COEFF "wall mesh a.stl faces 1.5",
     "faces = 1.5 is not allowed: it must be a whole number of steps, >= 1"},
    {COEFF "wall mesh a.stl faces 2 faces 2", "keyword faces is given twice"},
    {COEFF "wall zplane 0 NULL faces 5",
     "faces is not allowed with wall zplane: only a mesh has faces"},
    {COEFF "wall zplane 0 NULL about 1 2", "missing value: about x y z"},
    {COEFF "wall region r shear x 1",
     "shear is not allowed with wall region: it needs planes or a cylinder; use velocity or "
     "rotate"},
    {COEFF "wall mesh a.stl load 5 mass 1",
     "load dimension '5' is not allowed: it must be x, y or z"},
    {COEFF "wall zplane 0 NULL rotate 0 0 0 0 0 0 1",
     "rotate axis = 0 0 0 is not allowed: it must have a direction"},
    {COEFF "wall zplane 0 NULL rotate 0 0 0 0 0 1",
     "missing value: rotate px py pz ax ay az omega"},
    {COEFF "wall zplane 0 NULL rotate 0 0 0 0 0 1 1 shear x 1",
     "only one of velocity, wiggle, shear, load and rotate is allowed, or load and shear, or "
     "rotate beside velocity, wiggle or load: rotate and shear are given"},
    {COEFF "wall zplane 0 NULL load 5 mass 1 rotate 0 0 0 1 0 1 1",
     "rotate beside load: a plane must turn about its normal, so that its load does not turn"},
    {COEFF "wall",
     "missing value: kind of wall (xplane, yplane, zplane, zcylinder, region or mesh)"},
    {COEFF "wall sphere 1",
     "wall 'sphere' is unknown: it must be xplane, yplane, zplane, zcylinder, region or mesh"},
    {COEFF "wall xplane", "missing value: wall planes lo hi"},
    {COEFF "wall xplane 0", "missing value: wall planes lo hi"},
    {COEFF "wall yplane NULL NULL", "wall yplane NULL NULL has no surface: give lo, hi or both"},
    {COEFF "wall xplane 1.0 1.00", "wall xplane lo = 1.0 is not allowed: it must be < hi = 1.00"},
    {COEFF "wall xplane nan 1", "wall lo = nan is not a finite number"},
    {COEFF "wall xplane 0 null", "wall hi = null is not a finite number"},
    {COEFF "wall yplane v_place NULL",
     "wall lo = v_place is not allowed: a position that a variable sets has no velocity for the "
     "law to "
     "know; move the plane by velocity 0 v_name 0 with a variable of its speed, or by a force with "
     "load"},
    {COEFF "wall zplane NULL v_place",
     "wall hi = v_place is not allowed: a position that a variable sets has no velocity for the "
     "law to "
     "know; move the plane by velocity 0 0 v_name with a variable of its speed, or by a force with "
     "load"},
    {COEFF "wall zcylinder", "missing value: wall zcylinder R"},
    {COEFF "wall zcylinder 0", "wall zcylinder R = 0 is not allowed: it must be > 0"},
    {COEFF "wall zcylinder v_r", "wall zcylinder R = v_r is not a finite number"},
    {PLANE "spin 2", "keyword 'spin'" UNKNOWN_KEYWORD},
    {PLANE "still 2", "keyword '2'" UNKNOWN_KEYWORD},
    {PLANE "velocity 1 2", "missing value: velocity vx vy vz"},
    {PLANE "velocity 1 2 contacts", "missing value: velocity vx vy vz"},
    {PLANE "velocity 1 v_ 2", "velocity = v_ names no variable"},
    {PLANE "velocity 1 0 0 wiggle x 1 1",
     "only one of velocity, wiggle, shear, load and rotate is allowed, or load and shear, or "
     "rotate beside velocity, wiggle or load: velocity and "
     "wiggle "
     "are given"},
    {PLANE "shear y 1 load 1 mass 1 shear y 1",
     "only one of velocity, wiggle, shear, load and rotate is allowed, or load and shear, or "
     "rotate beside velocity, wiggle or load: load and shear "
     "are "
     "given"},
    {PLANE "wiggle x 1", "missing value: wiggle dim A period"},
    {PLANE "wiggle w 1 1", "wiggle dimension 'w' is not allowed: it must be x, y or z"},
    {PLANE "wiggle x a 1", "wiggle A = a is not a finite number"},
    {PLANE "wiggle x 1 -2.0", "wiggle period = -2.0 is not allowed: it must be > 0"},
    {PLANE "shear y", "missing value: shear dim v"},
    {PLANE "shear q 1", "shear dimension 'q' is not allowed: it must be x, y or z"},
    {PLANE "shear x 1",
     "shear dimension x is not allowed: it must lie in the plane; use velocity to move a plane "
     "along "
     "its normal"},
    {PLANE "shear y nan", "shear v = nan is not a finite number"},
    {COEFF "wall xplane 0 1 load 1 mass 1",
     "load is not allowed with wall lo hi: it needs one plane alone, lo or hi, a region or a mesh"},
    {COEFF "wall zcylinder 1 load 1 mass 1",
     "load is not allowed with wall zcylinder: it needs one plane alone, lo or hi, a region or a "
     "mesh"},
    {PLANE "load", "missing value: load force"},
    {PLANE "load x mass 1", "load force = x is not a finite number"},
    {PLANE "load pressure", "missing value: load pressure"},
    {PLANE "load 1", "load: missing keyword mass"},
    {PLANE "load 1 mass", "missing value: load mass"},
    {PLANE "load 1 mass 0", "load mass = 0 is not allowed: it must be > 0"},
    {PLANE "load 1 mass 1 mass 1", "keyword mass is given twice"},
    {PLANE "load 1 mass 1 area 1", "load area is allowed with load pressure only"},
    {PLANE "load pressure 1 mass 1", "load pressure: missing keyword area"},
    {PLANE "load pressure 1 mass 1 area -1", "load area = -1 is not allowed: it must be > 0"},
    {PLANE "load 1 mass 1 damping -1", "load damping = -1 is not allowed: it must be >= 0"},
    {PLANE "load 1 mass 1 limits 0", "missing value: load limits hi"},
    {PLANE "load 1 mass 1 limits 2 1", "load limits lo = 2 is not allowed: it must be <= hi = 1"},
    {PLANE "load 1 mass 1 spring 1",
     "load keyword 'spring' is unknown: it must be mass, area, damping or limits"},
};
INSTANTIATE_TEST_SUITE_P(Lines, WallMistake, testing::ValuesIn(wall_mistakes));

}    // namespace
