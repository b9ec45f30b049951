// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_WALL_MOTION_H
#define LMP_EEPA_WALL_MOTION_H

#include <eepa_commands/wall_commands.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace LAMMPS_NS {

/// Time that has passed, summed step by step. Steps of equal length are counted, so that their sum
/// is rounded only once.
class ElapsedTime {
 public:
  double before = 0.0;       ///< time that had passed when the time step last changed [time]
  double step = 0.0;         ///< the present time step [time]
  std::int64_t steps = 0;    ///< number of steps of that length

  double value() const { return before + step * static_cast<double>(steps); }
  void add(double dt)
  {
    if (dt != step) {
      before = value();
      step = dt;
      steps = 0;
    }
    steps++;
  }
};

/// Displacement and velocity of a wall under all drives except `load`. Each drive starts from the
/// displacement at which the last one ended. The phase of a wiggle follows the time since it began,
/// for any number and length of steps. Knows nothing of contacts.
class WallMotion {
 public:
  using Vector = std::array<double, 3>;

  eepa::WallDrive drive = eepa::WallDrive::still;
  Vector given = {0.0, 0.0, 0.0};    ///< last value of `velocity` [length/time]
  int wiggle_axis = 0;
  double amplitude = 0.0;    ///< [length]
  double period = 1.0;       ///< [time]

  // kept in restart files
  Vector displacement = {0.0, 0.0, 0.0};    ///< since the wall was made [length]
  Vector origin = {0.0, 0.0, 0.0};          ///< displacement when the present drive began [length]
  ElapsedTime time;                         ///< since the present drive began

  /// Begins the present drive at the present displacement.
  void begin()
  {
    origin = displacement;
    time = ElapsedTime();
  }

  /// Moves the wall to the end of a step.
  void advance(double dt)
  {
    time.add(dt);
    if (drive == eepa::WallDrive::velocity) {
      for (int k = 0; k < 3; k++) displacement[k] += given[k] * dt;
    } else if (drive == eepa::WallDrive::wiggle) {
      displacement[wiggle_axis] = origin[wiggle_axis] + amplitude - amplitude * std::cos(phase());
    }
  }

  /// Velocity of the wall as a body, without that of its surface (`shear`) [length/time]
  Vector velocity() const
  {
    if (drive == eepa::WallDrive::velocity) return given;
    Vector all = {0.0, 0.0, 0.0};
    if (drive == eepa::WallDrive::wiggle)
      all[wiggle_axis] = amplitude * frequency() * std::sin(phase());
    return all;
  }

 private:
  double frequency() const { return 2.0 * 3.14159265358979323846 / period; }
  double phase() const { return frequency() * time.value(); }
};

}    // namespace LAMMPS_NS

#endif
