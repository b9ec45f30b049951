// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_WALL_COMMANDS_H
#define EEPA_COMMANDS_WALL_COMMANDS_H

#include "commands.h"

#include <array>
#include <string>

// What a user may type to move a wall: the one parser of fix wall/gran/eepa's motion and of
// fix_modify. It knows nothing of LAMMPS.

namespace eepa {

/// What drives a wall. The values stand in restart files.
enum class WallDrive { still = 0, velocity = 1, wiggle = 2, shear = 3, load = 4 };

/// The keyword of a drive, for messages.
const char *name_of(WallDrive drive);

/// What a wall is, as far as it limits how it may be moved.
struct WallForMotion {
  bool plane = true;
  int surfaces = 1;
  int axis = 2;    ///< of a plane's normal
};

/// How a wall moves, as typed.
struct MotionArguments {
  WallDrive drive = WallDrive::still;
  std::array<Quantity, 3> velocity;    ///< [length/time]
  int wiggle_axis = 0;
  double amplitude = 0.0;    ///< [length]
  double period = 0.0;       ///< > 0 [time]
  bool slides = false;       ///< `shear`, alone or beside `load`
  int shear_axis = 0;
  Quantity shear;    ///< velocity of the surface [length/time]
  LoadArguments load;
};

/// Whether `word` starts a motion: still, velocity, wiggle, shear or load.
bool is_motion(const std::string &word);

/// Reads `still | velocity vx vy vz | wiggle dim A period | shear dim v | load ...` or `load ...`
/// and `shear dim v` in any order, from words[first] on, as long as there are such keywords.
/// \param others  keywords that may come after them
/// \param motion  changed only where all is right
/// \return index of the first word not read
/// \throw std::invalid_argument naming argument, value and what is allowed
std::size_t parse_motion(const Words &words, std::size_t first, const Words &others,
                         const WallForMotion &wall, MotionArguments &motion);

}    // namespace eepa

#endif
