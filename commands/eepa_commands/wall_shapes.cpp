// SPDX-License-Identifier: GPL-2.0-only
#include "wall_shapes.h"

namespace eepa {

namespace {

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
    if (shape.planes() == 0) refuse(wall + " NULL NULL has no surface: give lo, hi or both");
    if (shape.planes() == 2 && shape.lo >= shape.hi)
      refuse(wall + " lo = " + lo + " is not allowed: it must be < hi = " + hi);
    return shape;
  }

  WallShape read_region(Reader &reader)
  {
    WallShape shape;
    shape.kind = WallShape::region;
    shape.region_id = reader.word("wall region ID");
    return shape;
  }

  const Words mesh_keywords = {"scale", "rotation", "offset", "smooth"};

  void read_mesh_option(Reader &reader, WallShape &shape)
  {
    const std::string key = reader.keyword();
    MeshPlacement &placement = shape.placement;
    if (key == "scale") {
      placement.scale = reader.number("mesh scale");
      if (placement.scale <= 0.0) refuse_value("mesh scale", placement.scale, "> 0");
    } else if (key == "rotation") {
      reader.require(4, "mesh rotation ax ay az degrees");
      for (double &component : placement.axis) component = reader.number("mesh rotation axis");
      if (placement.axis == std::array<double, 3>{0.0, 0.0, 0.0})
        refuse("mesh rotation axis = 0 0 0 is not allowed: it must have a direction");
      placement.degrees = reader.number("mesh rotation degrees");
    } else if (key == "offset") {
      reader.require(3, "mesh offset x y z");
      for (double &component : placement.offset) component = reader.number("mesh offset");
    } else {
      shape.smooth = reader.number("mesh smooth");
      if (shape.smooth < 0.0 || shape.smooth >= 90.0)
        refuse_value("mesh smooth", shape.smooth, ">= 0 and < 90 degrees");
    }
  }

  WallShape read_mesh(Reader &reader)
  {
    WallShape shape;
    shape.kind = WallShape::mesh;
    shape.file = reader.word("wall mesh FILE");
    while (!reader.done() && contains(mesh_keywords, reader.peek()))
      read_mesh_option(reader, shape);
    return shape;
  }

}    // namespace

WallShape parse_shape(Reader &reader)
{
  const std::string kinds = "xplane, yplane, zplane, zcylinder, region or mesh";
  const std::string &kind = reader.word("kind of wall (" + kinds + ")");
  if (kind == "zcylinder") return read_cylinder(reader);
  if (kind == "region") return read_region(reader);
  if (kind == "mesh") return read_mesh(reader);
  for (const auto plane : {WallShape::xplane, WallShape::yplane, WallShape::zplane}) {
    WallShape shape;
    shape.kind = plane;
    if (kind == shape.kind_name()) return read_planes(reader, plane);
  }
  refuse("wall '" + kind + "' is unknown: it must be " + kinds);
}

}    // namespace eepa
