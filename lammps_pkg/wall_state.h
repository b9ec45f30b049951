// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_WALL_STATE_H
#define LMP_EEPA_WALL_STATE_H

#include <string>
#include <vector>

// The list of numbers that FixWallGranEepa writes to restart files.

namespace LAMMPS_NS {
namespace wall_state {

  constexpr double restart_format = 5.0, oldest_format = 3.0;

  /// Places in the list. Integers are exact. Format 4 added those from ROTATES on, and lost the phase of a wiggle
  /// that turns. No name may be one of the fix's own enumerators, which would hide it.
  enum Index {
    FORMAT,    ///< first, so that it can be read alone
    COUNT,     ///< of the numbers
    KIND,
    SIDES,
    LO,
    HI,
    RADIUS,
    LAW,
    EXPONENT,
    ROLLING_SPRING,
    TWISTING_SPRING,
    VALUES_A_CONTACT,
    DRIVE,
    DISPLACEMENT,
    ORIGIN = DISPLACEMENT + 3,
    TIME_BEFORE = ORIGIN + 3,
    TIME_STEP,
    TIME_STEPS,
    WIGGLE_AXIS,
    WIGGLE_AMPLITUDE,
    WIGGLE_PERIOD,
    SURFACE_VELOCITY,
    SURFACE_SPEED = SURFACE_VELOCITY + 3,
    PLATEN_MASS,
    PLATEN_POSITION,
    PLATEN_VELOCITY,
    PLATEN_WORK,
    PLATEN_DISSIPATED,
    VECTOR,
    N_OLD_VECTOR = 16,
    N_OLD_STATE = VECTOR + N_OLD_VECTOR,    // of format 3
    ROTATES = N_OLD_STATE,
    TURNED_BY,
    ANGLE_BEFORE,
    ANGULAR_SPEED,
    BEGUN_AT,    // quaternion, scalar first
    SHIFT_BEGUN_AT = BEGUN_AT + 4,
    PIVOT = SHIFT_BEGUN_AT + 3,
    AXIS = PIVOT + 3,
    POINT = AXIS + 3,
    LOAD_AXIS = POINT + 3,
    SHAPE_CHECK,
    REGION_STEP,
    REGION_DISPLACEMENT,
    REGION_ANGLE = REGION_DISPLACEMENT + 3,
    REGION_VELOCITY,
    REGION_ANGULAR_VELOCITY = REGION_VELOCITY + 3,
    REGION_SIZE_BEFORE = REGION_ANGULAR_VELOCITY + 3,
    MORE_VECTOR,
    N_MORE_VECTOR = 8,
    WEAR = MORE_VECTOR + N_MORE_VECTOR,    // number of values of wear that follow the list
    N_STATE
  };

  /// Why the numbers can not have been written by this fix; "" where they can.
  /// \param state  N_STATE numbers
  std::string damage(const std::vector<double> &state);

}    // namespace wall_state
}    // namespace LAMMPS_NS

#endif
