// SPDX-License-Identifier: GPL-2.0-only
#include "wall_drives.h"

#include <cmath>

namespace eepa {

namespace {

  const Words motion_keywords = {"still", "velocity", "wiggle", "shear", "load", "rotate"};

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
    if (shape.kind == WallShape::region || shape.kind == WallShape::mesh)
      refuse(std::string("shear is not allowed with wall ") + shape.kind_name() +
             ": it needs planes or a cylinder; use velocity or rotate");
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

  void read_rotation(Reader &reader, MotionArguments &motion)
  {
    reader.require(7, "rotate px py pz ax ay az omega");
    if (motion.drive == WallDrive::still) motion.drive = WallDrive::rotate;
    motion.rotates = true;
    RotationArguments &rotation = motion.rotation;
    for (double &component : rotation.point) component = reader.number("rotate point");
    for (double &component : rotation.axis) component = reader.number("rotate axis");
    double length = 0.0;    // hypot() neither overflows nor underflows
    for (const double component : rotation.axis) length = std::hypot(length, component);
    if (!(length > 0.0) || !std::isfinite(length))
      refuse("rotate axis = " + brief(rotation.axis[0]) + " " + brief(rotation.axis[1]) + " " +
             brief(rotation.axis[2]) + " is not allowed: it must have a direction");
    for (double &component : rotation.axis) component /= length;
    rotation.speed = reader.quantity("rotate omega");
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

  /// `[dim] F|pressure p area A mass M [damping c] [limits lo hi]`; F, p and A may be v_name.
  /// \param ends  keywords that may follow
  LoadArguments read_load(Reader &reader, const Words &ends, const WallShape &shape)
  {
    LoadArguments load;
    load.axis = shape.is_plane() ? shape.axis() : reader.dimension("load");
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
    if (shape.planes() == 2 || shape.kind == WallShape::zcylinder)
      refuse(std::string("load is not allowed with wall ") +
             (shape.is_plane() ? "lo hi" : "zcylinder") +
             ": it needs one plane alone, lo or hi, a region or a mesh");
    motion.drive = WallDrive::load;
    Words ends = motion_keywords;
    ends.insert(ends.end(), others.begin(), others.end());
    motion.load = read_load(reader, ends, shape);
  }

  /// Whether two motions can be given at the same time.
  bool go_together(const Words &given, const std::string &key)
  {
    if (given.size() != 1) return false;
    const auto are = [&](const char *one, const char *other) {
      return (given[0] == one && key == other) || (given[0] == other && key == one);
    };
    return are("load", "shear") || are("load", "rotate") || are("velocity", "rotate") ||
        are("wiggle", "rotate");
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
    case WallDrive::rotate:
      return "rotate";
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
    if (!given.empty() && !go_together(given, key))
      refuse(
          "only one of velocity, wiggle, shear, load and rotate is allowed, or load and shear, or "
          "rotate beside velocity, wiggle or load: " +
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
    else if (key == "rotate")
      read_rotation(reader, read);
    next = reader.position();
  }
  if (read.drive == WallDrive::load && read.rotates && shape.is_plane() &&
      std::fabs(read.rotation.axis[shape.axis()]) < 1.0)
    refuse(
        "rotate beside load: a plane must turn about its normal, so that its load does not turn");
  motion = read;
  return next;
}

}    // namespace eepa
