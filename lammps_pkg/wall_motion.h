// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_WALL_MOTION_H
#define LMP_EEPA_WALL_MOTION_H

#include <eepa_commands/wall_commands.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace LAMMPS_NS {

/// Time that has passed, step by step. Steps of one length are counted, so that their sum has one
/// rounding; a step of another length adds to what was there.
class ElapsedTime {
 public:
  double before = 0.0;       ///< what had passed when the present length of step began [time]
  double step = 0.0;         ///< the present length of step [time]
  std::int64_t steps = 0;    ///< of that length

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

/// Where a wall is and how fast its surfaces go, under all drives but `load`. Displacement belongs
/// to the wall: each drive begins where the last one left it, and the time of a wiggle is what has
/// passed since it began, whatever the number and the length of the steps. Knows no contacts.
class WallMotion {
 public:
  using Vector = std::array<double, 3>;

  eepa::WallDrive drive = eepa::WallDrive::still;
  Vector given = {0.0, 0.0, 0.0};    ///< `velocity`, as evaluated last [length/time]
  int wiggle_axis = 0;
  double amplitude = 0.0;    ///< [length]
  double period = 1.0;       ///< [time]

  // what a restart keeps
  Vector displacement = {0.0, 0.0, 0.0};    ///< since the wall was made [length]
  Vector origin = {0.0, 0.0, 0.0};          ///< displacement where the present drive began
  ElapsedTime time;                         ///< since then

  /// The drive as told begins here and now.
  void begin()
  {
    origin = displacement;
    time = ElapsedTime();
  }

  /// To the end of a step.
  void advance(double dt)
  {
    time.add(dt);
    if (drive == eepa::WallDrive::velocity) {
      for (int k = 0; k < 3; k++) displacement[k] += given[k] * dt;
    } else if (drive == eepa::WallDrive::wiggle) {
      displacement[wiggle_axis] = origin[wiggle_axis] + amplitude - amplitude * std::cos(phase());
    }
  }

  /// Of the wall as a body: what its surface does besides (`shear`) moves nothing.
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
