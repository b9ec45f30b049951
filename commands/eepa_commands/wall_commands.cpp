// SPDX-License-Identifier: GPL-2.0-only
#include "wall_commands.h"

#include <algorithm>

namespace eepa {

namespace {

  const Words motion_keywords = {"still", "velocity", "wiggle", "shear", "load"};

  /* -------------------------------------------------------------------- surfaces */

  /// A plane's coordinate.
  double read_position(Reader &reader, const WallShape &shape, const std::string &name)
  {
    const std::string &word = reader.word(name);
    if (word.compare(0, 2, "v_") == 0) {
      const char *const velocities[] = {"v_name 0 0", "0 v_name 0", "0 0 v_name"};
      refuse(
          name + " = " + word +
          " is not allowed: a position that a variable sets has no velocity for the law to know; "
          "move the plane by velocity " +
          velocities[shape.axis()] + " with a variable of its speed, or by a force with load");
    }
    return parse_number(name, word);
  }

  WallShape read_cylinder(Reader &reader)
  {
    WallShape shape;
    shape.kind = WallShape::zcylinder;
    reader.require(1, "wall zcylinder R");
    const std::string &word = reader.peek();
    shape.radius = reader.number("wall zcylinder R");
    if (shape.radius <= 0.0)
      refuse("wall zcylinder R = " + word + " is not allowed: it must be > 0");
    return shape;
  }

  WallShape read_planes(Reader &reader, WallShape::Kind kind)
  {
    WallShape shape;
    shape.kind = kind;
    reader.require(2, "wall planes lo hi");
    const auto read = [&](const char *name, bool &has, double &coordinate) {
      const std::string word = reader.peek();
      has = word != "NULL";
      if (has)
        coordinate = read_position(reader, shape, name);
      else
        reader.word(name);
      return word;
    };
    const std::string lo = read("wall lo", shape.has_lo, shape.lo);
    const std::string hi = read("wall hi", shape.has_hi, shape.hi);
    const std::string wall = std::string("wall ") + shape.kind_name();
    if (shape.count() == 0) refuse(wall + " NULL NULL has no surface: give lo, hi or both");
    if (shape.count() == 2 && shape.lo >= shape.hi)
      refuse(wall + " lo = " + lo + " is not allowed: it must be < hi = " + hi);
    return shape;
  }

  WallShape read_shape(Reader &reader)
  {
    const std::string &kind = reader.word("kind of wall (xplane, yplane, zplane or zcylinder)");
    if (kind == "zcylinder") return read_cylinder(reader);
    for (const auto plane : {WallShape::xplane, WallShape::yplane, WallShape::zplane}) {
      WallShape shape;
      shape.kind = plane;
      if (kind == shape.kind_name()) return read_planes(reader, plane);
    }
    refuse("wall '" + kind + "' is unknown: it must be xplane, yplane, zplane or zcylinder");
  }

  /* -------------------------------------------------------------------- motion */

  void read_velocity(Reader &reader, MotionArguments &motion)
  {
    reader.require(3, "velocity vx vy vz");
    motion.drive = WallDrive::velocity;
    for (auto &component : motion.velocity) component = reader.quantity("velocity");
  }

  void read_wiggle(Reader &reader, MotionArguments &motion)
  {
    reader.require(3, "wiggle dim A period");
    motion.drive = WallDrive::wiggle;
    motion.wiggle_axis = reader.dimension("wiggle");
    motion.amplitude = reader.number("wiggle A");
    const std::string &period = reader.peek();
    motion.period = reader.number("wiggle period");
    if (motion.period <= 0.0)
      refuse("wiggle period = " + period + " is not allowed: it must be > 0");
  }

  void read_shear(Reader &reader, const WallShape &shape, MotionArguments &motion)
  {
    reader.require(2, "shear dim v");
    if (motion.drive == WallDrive::still) motion.drive = WallDrive::shear;
    motion.slides = true;
    const std::string &dim = reader.peek();
    motion.shear_axis = reader.dimension("shear");
    motion.shear = reader.quantity("shear v");
    if (shape.is_plane() && motion.shear_axis == shape.axis())
      refuse("shear dimension " + dim +
             " is not allowed: it must lie in the plane; use velocity to move a plane along its "
             "normal");
  }

  /// A limit of travel; NULL means `open`.
  double read_limit(Reader &reader, const std::string &name, double open)
  {
    const std::string &word = reader.word(name);
    return word == "NULL" ? open : parse_number(name, word);
  }

  void read_load_option(Reader &reader, const std::string &key, LoadArguments &load)
  {
    if (key == "mass") {
      load.mass = reader.number("load mass");
      if (load.mass <= 0.0) refuse_value("load mass", load.mass, "> 0");
    } else if (key == "area") {
      load.area = reader.quantity("load area");
      if (load.area.variable.empty() && load.area.value <= 0.0)
        refuse_value("load area", load.area.value, "> 0");
    } else if (key == "damping") {
      load.damping = reader.number("load damping");
      if (load.damping < 0.0) refuse_value("load damping", load.damping, ">= 0");
    } else if (key == "limits") {
      load.lowest = read_limit(reader, "load limits lo", load.lowest);
      load.highest = read_limit(reader, "load limits hi", load.highest);
      if (load.lowest > load.highest)
        refuse_value("load limits lo", load.lowest, "<= hi = " + brief(load.highest));
    } else {
      refuse("load keyword '" + key + "' is unknown: it must be mass, area, damping or limits");
    }
  }

  /// `F|pressure p area A mass M [damping c] [limits lo hi]`; F, p and A may be v_name.
  /// \param ends  keywords that may follow
  LoadArguments read_load(Reader &reader, const Words &ends)
  {
    LoadArguments load;
    load.by_pressure = !reader.done() && reader.peek() == "pressure";
    if (load.by_pressure) {
      reader.keyword();
      load.pressure = reader.quantity("load pressure");
    } else {
      load.force = reader.quantity("load force");
    }
    Words given;
    while (!reader.done() && !contains(ends, reader.peek())) {
      given.push_back(reader.keyword());
      read_load_option(reader, given.back(), load);
    }
    const bool has_area = contains(given, "area");
    if (!contains(given, "mass")) refuse("load: missing keyword mass");
    if (load.by_pressure && !has_area) refuse("load pressure: missing keyword area");
    if (!load.by_pressure && has_area) refuse("load area is allowed with load pressure only");
    return load;
  }

  void read_platen(Reader &reader, const Words &others, const WallShape &shape,
                   MotionArguments &motion)
  {
    if (!shape.is_plane() || shape.count() != 1)
      refuse(std::string("load is not allowed with wall ") +
             (shape.is_plane() ? "lo hi" : "zcylinder") + ": it needs one plane alone, lo or hi");
    motion.drive = WallDrive::load;
    Words ends = motion_keywords;
    ends.insert(ends.end(), others.begin(), others.end());
    motion.load = read_load(reader, ends);
  }

}    // namespace

const char *name_of(WallDrive drive)
{
  switch (drive) {
    case WallDrive::velocity:
      return "velocity";
    case WallDrive::wiggle:
      return "wiggle";
    case WallDrive::shear:
      return "shear";
    case WallDrive::load:
      return "load";
    default:
      return "still";
  }
}

bool is_motion(const std::string &word)
{
  return contains(motion_keywords, word);
}

std::size_t parse_motion(const Words &words, std::size_t first, const Words &others,
                         const WallShape &shape, MotionArguments &motion)
{
  MotionArguments read;
  Words given;
  std::size_t next = first;
  while (next < words.size() && is_motion(words[next])) {
    const std::string &key = words[next];
    const bool loaded_slide = given.size() == 1 &&
        ((key == "shear" && given[0] == "load") || (key == "load" && given[0] == "shear"));
    if (!given.empty() && !loaded_slide)
      refuse("only one of velocity, wiggle, shear and load is allowed, or load and shear: " +
             given.back() + " and " + key + " are given");
    given.push_back(key);
    Reader reader(words, next + 1);
    if (key == "velocity")
      read_velocity(reader, read);
    else if (key == "wiggle")
      read_wiggle(reader, read);
    else if (key == "shear")
      read_shear(reader, shape, read);
    else if (key == "load")
      read_platen(reader, others, shape, read);
    next = reader.position();
  }
  motion = read;
  return next;
}

WallArguments parse_wall(const Words &words, std::size_t first, Words &warnings)
{
  WallArguments wall;
  std::size_t next = parse_style(words, first, "coeff", wall.style);
  if (next == words.size()) refuse("missing keyword coeff");
  next = parse_parameters(words, next + 1, "wall", wall.style.settings, wall.parameters, warnings);
  if (next == words.size()) refuse("missing keyword wall");
  Reader reader(words, next + 1);
  wall.shape = read_shape(reader);

  Words rest(words.begin() + static_cast<std::ptrdiff_t>(reader.position()), words.end());
  const auto end = std::remove(rest.begin(), rest.end(), "contacts");
  wall.contact_table = end != rest.end();
  rest.erase(end, rest.end());
  next = parse_motion(rest, 0, {}, wall.shape, wall.motion);
  if (next < rest.size())
    refuse("keyword '" + rest[next] +
           "' is unknown: it must be velocity, wiggle, shear, load, still or contacts");
  return wall;
}

std::size_t parse_wall_change(const Words &words, const WallShape &shape, MotionArguments &motion)
{
  if (words.empty() || !is_motion(words.front())) return 0;
  return parse_motion(words, 0, {"dynamic/dof", "energy", "virial", "respa"}, shape, motion);
}

}    // namespace eepa
