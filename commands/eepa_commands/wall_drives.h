// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_WALL_DRIVES_H
#define EEPA_COMMANDS_WALL_DRIVES_H

#include "wall_shapes.h"
#include "words.h"

#include <array>
#include <limits>
#include <string>

namespace eepa {

/// Drive of a wall. Restart files have these values.
enum class WallDrive { still = 0, velocity = 1, wiggle = 2, shear = 3, load = 4, rotate = 5 };
constexpr int drive_count = 6;

/// The keyword of a drive, for messages.
const char *name_of(WallDrive drive);

/// Load and mechanical properties of a platen, along its axis: the plane's normal, or the axis that is
/// typed for a region or a mesh.
struct LoadArguments {
  int axis = 2;
  bool by_pressure = false;    ///< whether a pressure was given, else a force
  Quantity force;              ///< > 0 towards + [force]
  /// > 0 towards the particles of a plane, else towards +axis [force/length^2]
  Quantity pressure;
  Quantity area;           ///< > 0 [length^2]
  double mass = 0.0;       ///< > 0 [mass]
  double damping = 0.0;    ///< >= 0 [mass/time]
  /// limits of travel: coordinates of a plane, else displacements along the axis [length]
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

/// Rotation of a wall about an axis that moves with it.
struct RotationArguments {
  std::array<double, 3> point = {0.0, 0.0,
                                 0.0};    ///< of the axis, when the rotation begins [length]
  std::array<double, 3> axis = {0.0, 0.0, 1.0};    ///< unit vector
  Quantity speed;                                  ///< right-handed about the axis [1/time]
};

/// Motion of a wall, as typed: a drive, and beside it a sliding surface or a rotation.
struct MotionArguments {
  /// Of the translation. Where there is none: shear or rotate, whichever is given.
  WallDrive drive = WallDrive::still;
  std::array<Quantity, 3> velocity;    ///< [length/time]
  int wiggle_axis = 0;
  double amplitude = 0.0;    ///< [length]
  double period = 0.0;       ///< > 0 [time]
  bool slides = false;       ///< `shear`, alone or beside `load`
  int shear_axis = 0;
  Quantity shear;          ///< velocity of the surface [length/time]
  bool rotates = false;    ///< `rotate`, alone or beside velocity, wiggle or load
  RotationArguments rotation;
  LoadArguments load;
};

/// Whether `word` starts a motion: still, velocity, wiggle, shear, load or rotate.
bool is_motion(const std::string &word);

/// Reads a motion from words[first] on, as long as there are keywords of motions: `still`, or one of
/// `velocity vx vy vz`, `wiggle dim A period`, `load [dim] ...` and beside it `rotate px py pz ax ay az
/// omega`; or `shear dim v`, alone or with `load`; in any order.
/// \param others  keywords that may follow
/// \param motion  changed only where there is no error
/// \return index of the first word not read
/// \throw std::invalid_argument naming argument, value and what is allowed
std::size_t parse_motion(const Words &words, std::size_t first, const Words &others,
                         const WallShape &shape, MotionArguments &motion);

}    // namespace eepa

#endif
