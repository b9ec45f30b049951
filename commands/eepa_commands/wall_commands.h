// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_WALL_COMMANDS_H
#define EEPA_COMMANDS_WALL_COMMANDS_H

#include "commands.h"

#include <array>
#include <limits>
#include <string>

// The parser of fix wall/gran/eepa and of its fix_modify. It does not depend on LAMMPS: checks that
// need the box or the existence of variables are left to the fix.

namespace eepa {

/* ---------------------------------------------------------------------- surfaces */

/// The surfaces of a wall as typed: one or two planes normal to an axis, or a cylinder along z.
struct WallShape {
  /// Restart files have these values.
  enum Kind { xplane = 0, yplane = 1, zplane = 2, zcylinder = 3 };

  Kind kind = zplane;
  bool has_lo = false, has_hi = false;
  double lo = 0.0, hi = 0.0;    ///< positions of the planes given, lo < hi [length]
  double radius = 0.0;          ///< radius of a cylinder, > 0 [length]

  bool is_plane() const { return kind != zcylinder; }
  /// Axis of a plane's normal.
  int axis() const { return static_cast<int>(kind); }
  /// Number of surfaces: lo and hi, or the only plane; inner and outer side of a cylinder.
  int count() const { return is_plane() ? (has_lo ? 1 : 0) + (has_hi ? 1 : 0) : 2; }
  const char *kind_name() const
  {
    constexpr const char *names[] = {"xplane", "yplane", "zplane", "zcylinder"};
    return names[kind];
  }
};

/* ---------------------------------------------------------------------- motion */

/// Drive of a wall. Restart files have these values.
enum class WallDrive { still = 0, velocity = 1, wiggle = 2, shear = 3, load = 4 };

/// The keyword of a drive, for messages.
const char *name_of(WallDrive drive);

/// Load and mechanical properties of a platen, along the plane's axis.
struct LoadArguments {
  bool by_pressure = false;    ///< whether a pressure was given, else a force
  Quantity force;              ///< > 0 towards + [force]
  Quantity pressure;           ///< > 0 towards the particles [force/length^2]
  Quantity area;               ///< > 0 [length^2]
  double mass = 0.0;           ///< > 0 [mass]
  double damping = 0.0;        ///< >= 0 [mass/time]
  double lowest = -std::numeric_limits<double>::infinity();    ///< limits of travel [length]
  double highest = std::numeric_limits<double>::infinity();
};

/// Motion of a wall, as typed.
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
/// \param others  keywords that may follow
/// \param motion  changed only where there is no error
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

/// Reads `law style_keywords coeff parameters wall kind args [motion] [contacts]` from words[first]
/// on, all of them; `contacts` may stand anywhere after the surfaces.
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
