// SPDX-License-Identifier: GPL-2.0-only
#include "wall_commands.h"

#include <cmath>

namespace eepa {

namespace {

  /// Takes the options of a wall out of its words, wherever they stand.
  /// \return the other words
  Words take_options(const Words &words, std::size_t first, WallArguments &wall)
  {
    Words rest;
    Words given;
    for (Reader reader(words, first); !reader.done();) {
      const std::string &word = reader.word("option");
      const bool is_option = word == "contacts" || word == "about" || word == "faces";
      if (is_option && word != "contacts" && contains(given, word))
        refuse("keyword " + word + " is given twice");
      if (is_option) given.push_back(word);
      if (word == "contacts") {
        wall.contact_table = true;
      } else if (word == "about") {
        reader.require(3, "about x y z");
        for (double &component : wall.about) component = reader.number("about");
      } else if (word == "faces") {
        const double interval = reader.number("faces");
        if (wall.shape.kind != WallShape::mesh)
          refuse(std::string("faces is not allowed with wall ") + wall.shape.kind_name() +
                 ": only a mesh has faces");
        if (!(interval >= 1.0 && interval <= 2147483647.0 && interval == std::floor(interval)))
          refuse_value("faces", interval, "a whole number of steps, >= 1");
        wall.face_interval = static_cast<int>(interval);
      } else {
        rest.push_back(word);
      }
    }
    return rest;
  }

}    // namespace

WallArguments parse_wall(const Words &words, std::size_t first, Words &warnings)
{
  WallArguments wall;
  std::size_t next = parse_style(words, first, "coeff", wall.style);
  if (next == words.size()) refuse("missing keyword coeff");
  next = parse_parameters(words, next + 1, "wall", wall.style.settings, wall.parameters, warnings);
  if (next == words.size()) refuse("missing keyword wall");
  Reader reader(words, next + 1);
  wall.shape = parse_shape(reader);
  const Words rest = take_options(words, reader.position(), wall);
  next = parse_motion(rest, 0, {}, wall.shape, wall.motion);
  if (next < rest.size())
    refuse(
        "keyword '" + rest[next] +
        "' is unknown: it must be velocity, wiggle, shear, load, rotate, still, contacts, about or "
        "faces");
  return wall;
}

std::size_t parse_wall_change(const Words &words, const WallShape &shape, MotionArguments &motion)
{
  if (words.empty() || !is_motion(words.front())) return 0;
  return parse_motion(words, 0, {"dynamic/dof", "energy", "virial", "respa"}, shape, motion);
}

}    // namespace eepa
