// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_WALL_COMMANDS_H
#define EEPA_COMMANDS_WALL_COMMANDS_H

#include "commands.h"
#include "wall_drives.h"
#include "wall_shapes.h"

#include <array>

// The parser of fix wall/gran/eepa and of its fix_modify. It does not depend on LAMMPS: checks that
// need the box or the existence of variables are left to the fix.

namespace eepa {

/// fix ID group wall/gran/eepa ...
struct WallArguments {
  StyleArguments style;
  Parameters parameters;
  WallShape shape;
  MotionArguments motion;
  bool contact_table = false;    ///< keyword `contacts`
  std::array<double, 3> about = {0.0, 0.0,
                                 0.0};    ///< keyword `about`: point of the torque [length]
  int face_interval = 0;    ///< keyword `faces`: steps between outputs of each face, 0: none
};

/// Reads `law style_keywords coeff parameters wall kind args [motion] [contacts] [about x y z] [faces N]`
/// from words[first] on, all of them; options may stand anywhere after the surface.
/// \param warnings  receives warnings for the log
/// \throw std::invalid_argument naming argument, value and what is allowed
WallArguments parse_wall(const Words &words, std::size_t first, Words &warnings);

/// Reads the words of fix_modify for a wall.
/// \param motion  changed only where there is a motion and no error
/// \return number of words read: 0 where they do not begin with a motion, else up to an option that
/// LAMMPS has for all fixes
/// \throw std::invalid_argument naming argument, value and what is allowed
std::size_t parse_wall_change(const Words &words, const WallShape &shape, MotionArguments &motion);

}    // namespace eepa

#endif
