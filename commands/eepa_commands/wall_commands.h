// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_WALL_COMMANDS_H
#define EEPA_COMMANDS_WALL_COMMANDS_H

#include "commands.h"

#include <array>
#include <limits>
#include <string>

// The parser of fix wall/gran/eepa and of its fix_modify. It knows nothing of LAMMPS: what depends on the
// box or on variables that must exist is left to the fix.

namespace eepa {

/* ---------------------------------------------------------------------- surfaces */

/// The surfaces of a wall as typed: one or two planes normal to an axis, or a cylinder along z.
struct WallShape {
  /// The values stand in restart files.
  enum Kind { xplane = 0, yplane = 1, zplane = 2, zcylinder = 3 };

  Kind kind = zplane;
  bool has_lo = false, has_hi = false;
  double lo = 0.0, hi = 0.0;    ///< of planes that there are, lo < hi [length]
  double radius = 0.0;          ///< of a cylinder, > 0 [length]

  bool is_plane() const { return kind != zcylinder; }
  /// Of a plane's normal.
  int axis() const { return static_cast<int>(kind); }
  /// Planes: lo and hi, or the one that there is; a cylinder: inner and outer side.
  int count() const { return is_plane() ? (has_lo ? 1 : 0) + (has_hi ? 1 : 0) : 2; }
  const char *kind_name() const
  {
    constexpr const char *names[] = {"xplane", "yplane", "zplane", "zcylinder"};
    return names[kind];
  }
};

/* ---------------------------------------------------------------------- motion */

/// What drives a wall. The values stand in restart files.
enum class WallDrive { still = 0, velocity = 1, wiggle = 2, shear = 3, load = 4 };

/// The keyword of a drive, for messages.
const char *name_of(WallDrive drive);

/// What drives a platen, and how it answers. Along the plane's axis.
struct LoadArguments {
  bool by_pressure = false;    ///< else by a force
  Quantity force;              ///< > 0 towards + [force]
  Quantity pressure;           ///< > 0 towards the particles [force/length^2]
  Quantity area;               ///< > 0 [length^2]
  double mass = 0.0;           ///< > 0 [mass]
  double damping = 0.0;        ///< >= 0 [mass/time]
  double lowest = -std::numeric_limits<double>::infinity();    ///< limits of travel [length]
  double highest = std::numeric_limits<double>::infinity();
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
                         const WallShape &shape, MotionArguments &motion);

/* ---------------------------------------------------------------------- whole commands */

/// fix ID group wall/gran/eepa ...
struct WallArguments {
  StyleArguments style;
  Parameters parameters;
  WallShape shape;
  MotionArguments motion;
  bool contact_table = false;    ///< keyword `contacts`
};

/// Reads `law style_keywords coeff parameters wall kind args [motion] [contacts]` from words[first] on,
/// all of them; `contacts` may stand anywhere after the surfaces.
/// \param warnings  gets what deserves a line in the log
/// \throw std::invalid_argument naming argument, value and what is allowed
WallArguments parse_wall(const Words &words, std::size_t first, Words &warnings);

/// Reads what fix_modify tells a wall.
/// \param motion  changed only where all is right, and there is a motion
/// \return how many words were read: 0 where they begin with no motion, else up to an option that
/// LAMMPS has for all fixes
/// \throw std::invalid_argument naming argument, value and what is allowed
std::size_t parse_wall_change(const Words &words, const WallShape &shape, MotionArguments &motion);

}    // namespace eepa

#endif
