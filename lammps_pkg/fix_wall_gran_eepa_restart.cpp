// SPDX-License-Identifier: GPL-2.0-only

// How FixWallGranEepa writes restart files and reads them.
//
// The block of the fix is the list of wall_state.h and, where faces are told of, the wear of each.
// Those of particles are in fix_wall_gran_eepa_contacts.cpp.

#include "fix_wall_gran_eepa.h"

#include "face_loads.h"
#include "region_shape.h"
#include "wall_state.h"

#include <eepa/history.h>
#include <eepa_commands/restart_numbers.h>

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

using namespace LAMMPS_NS;
using namespace LAMMPS_NS::wall_state;
using eepa::WallDrive;

namespace {

int sides_of(const eepa::WallShape &shape)
{
  if (!shape.is_plane()) return 3;
  return (shape.has_lo ? 1 : 0) + (shape.has_hi ? 2 : 0);
}

std::string shape_name(int kind, int sides)
{
  eepa::WallShape shape;
  shape.kind = static_cast<eepa::WallShape::Kind>(kind);
  std::string name = shape.kind_name();
  if (shape.is_plane()) name += sides == 1 ? " lo NULL" : sides == 2 ? " NULL hi" : " lo hi";
  return name;
}

void put(std::vector<double> &state, int index, const eepa::Vec3 &vector)
{
  std::copy_n(vector.data(), 3, state.begin() + index);
}

eepa::Vec3 vector_at(const std::vector<double> &state, int index)
{
  return eepa::Vec3(state.data() + index);
}

}    // namespace

/* ---------------------------------------------------------------------- the fix */

std::vector<double> FixWallGranEepa::restart_state() const
{
  std::vector<double> state(N_STATE, 0.0);
  state[FORMAT] = restart_format;
  state[COUNT] = N_STATE;
  state[KIND] = typed_shape.kind;
  state[SIDES] = sides_of(typed_shape);
  state[LO] = typed_shape.lo;
  state[HI] = typed_shape.hi;
  state[RADIUS] = typed_shape.radius;
  state[LAW] = static_cast<double>(style.settings.law);
  state[EXPONENT] = style.settings.exponent;
  state[ROLLING_SPRING] = parameters.rolling == eepa::RollingModel::sds ? 1.0 : 0.0;
  state[TWISTING_SPRING] = parameters.twisting == eepa::TwistingModel::marshall ? 1.0 : 0.0;
  state[VALUES_A_CONTACT] = history_size;
  state[DRIVE] = static_cast<double>(motion_args.drive);
  std::copy_n(motion.displacement.begin(), 3, state.begin() + DISPLACEMENT);
  std::copy_n(motion.origin.begin(), 3, state.begin() + ORIGIN);
  state[TIME_BEFORE] = motion.time.before;
  state[TIME_STEP] = motion.time.step;
  state[TIME_STEPS] = static_cast<double>(motion.time.steps);
  state[WIGGLE_AXIS] = motion.wiggle_axis;
  state[WIGGLE_AMPLITUDE] = motion.amplitude;
  state[WIGGLE_PERIOD] = motion.period;
  put(state, SURFACE_VELOCITY, placement.velocity);
  state[SURFACE_SPEED] = surface_speed;
  state[PLATEN_MASS] = platen.mass;
  state[PLATEN_POSITION] = platen.position;
  state[PLATEN_VELOCITY] = platen.velocity;
  state[PLATEN_WORK] = platen.work;
  state[PLATEN_DISSIPATED] = platen.dissipated;
  state[ROTATES] = motion_args.rotates ? 1.0 : 0.0;
  state[TURNED_BY] = placement.angle;
  state[ANGLE_BEFORE] = angle_before;
  state[ANGULAR_SPEED] = angular_speed;
  state[BEGUN_AT] = placement.begun_at.w();
  put(state, BEGUN_AT + 1, placement.begun_at.vec());
  put(state, SHIFT_BEGUN_AT, placement.shift_begun_at);
  put(state, PIVOT, placement.pivot);
  put(state, AXIS, placement.axis);
  std::copy_n(motion_args.rotation.point.begin(), 3, state.begin() + POINT);
  state[LOAD_AXIS] = load_axis();
  state[SHAPE_CHECK] = shape->check();
  state[WEAR] = face_loads ? face_loads->wear_size() : 0;
  const RegionMotion region = region_shape ? region_shape->motion() : RegionMotion();
  state[REGION_STEP] = static_cast<double>(region.step);
  put(state, REGION_DISPLACEMENT, region.displacement);
  state[REGION_ANGLE] = region.angle;
  put(state, REGION_VELOCITY, region.velocity);
  put(state, REGION_ANGULAR_VELOCITY, region.angular_velocity);
  state[REGION_SIZE_BEFORE] = region.size_before;
  static_assert(N_VECTOR == N_OLD_VECTOR + N_MORE_VECTOR, "the file has the whole global vector");
  std::copy_n(output_vector.begin(), static_cast<int>(N_OLD_VECTOR), state.begin() + VECTOR);
  std::copy_n(output_vector.begin() + N_OLD_VECTOR, static_cast<int>(N_MORE_VECTOR),
              state.begin() + MORE_VECTOR);
  return state;
}

void FixWallGranEepa::write_restart(FILE *fp)
{
  // on all ranks, because it sums the forces of all ranks where that was not done yet
  FixWallGranEepa::compute_vector(0);
  // LAMMPS asks rank 0 for the length of the longest entry of a particle
  int mine = 0;
  for (int i = 0; i < atom->nlocal; i++)
    mine = std::max(mine, static_cast<int>(histories.list(i).size()));
  MPI_Allreduce(&mine, &most_contacts, 1, MPI_INT, MPI_MAX, world);
  std::vector<double> wear;
  if (face_loads) wear = face_loads->wear(world);
  if (comm->me != 0) return;
  std::vector<double> state = restart_state();
  state.insert(state.end(), wear.begin(), wear.end());
  const int bytes = static_cast<int>(state.size() * sizeof(double));
  fwrite(&bytes, sizeof(int), 1, fp);
  fwrite(state.data(), sizeof(double), state.size(), fp);
}

void FixWallGranEepa::restart(char *buf)
{
  std::vector<double> state(N_STATE);
  // read the format alone first: another format may be shorter
  std::memcpy(state.data(), buf, sizeof(double));
  const double format = state[FORMAT];
  if (format != restart_format && format != oldest_format)
    error->all(
        FLERR,
        "fix {} wall/gran/eepa: the restart file has format {}, this version reads {} and {}", id,
        format, oldest_format, restart_format);
  std::memcpy(state.data(), buf, 2 * sizeof(double));
  const int count = format == restart_format ? N_STATE : N_OLD_STATE;
  if (state[COUNT] != count)
    error->all(FLERR,
               "fix {} wall/gran/eepa: the restart file is damaged: count = {}, it must be {}", id,
               state[COUNT], count);
  if (format == oldest_format) {
    // what a wall of that time could not do
    state[BEGUN_AT] = 1.0;
    state[AXIS + 2] = 1.0;
    state[REGION_STEP] = -1.0;
  }
  std::memcpy(state.data(), buf, count * sizeof(double));
  if (format == oldest_format && state[KIND] <= eepa::WallShape::zplane)
    state[LOAD_AXIS] = state[KIND];
  const std::string wrong = damage(state);
  if (!wrong.empty())
    error->all(FLERR, "fix {} wall/gran/eepa: the restart file is damaged: {}", id, wrong);
  require_same_wall(state);
  take_up_motion(state);
  if (face_loads && state[WEAR] == face_loads->wear_size() && comm->me == 0) {
    std::vector<double> wear(face_loads->wear_size());
    std::memcpy(wear.data(), buf + N_STATE * sizeof(double), wear.size() * sizeof(double));
    face_loads->set_wear(wear.data());
  }
  std::copy_n(state.begin() + VECTOR, static_cast<int>(N_OLD_VECTOR), output_vector.begin());
  std::copy_n(state.begin() + MORE_VECTOR, static_cast<int>(N_MORE_VECTOR),
              output_vector.begin() + N_OLD_VECTOR);
  output_is_summed = true;
}

/// Stops where the histories belong to other faces or another layout. Warns where law or exponent
/// differ, which read histories differently, or a plane's coordinate: that of the file is kept.
void FixWallGranEepa::require_same_wall(const std::vector<double> &state) const
{
  const std::string was = shape_name(static_cast<int>(state[KIND]), static_cast<int>(state[SIDES])),
                    is = shape_name(typed_shape.kind, sides_of(typed_shape));
  if (was != is)
    error->all(FLERR,
               "fix {} wall/gran/eepa: the wall of the restart file is {}, this one is {}: its "
               "contacts can not be those of another surface; give the same wall, or another fix "
               "ID to begin without them",
               id, was, is);
  if (state[RADIUS] != typed_shape.radius)
    error->all(
        FLERR,
        "fix {} wall/gran/eepa: wall zcylinder R = {:.15g} is not allowed: it must be {:.15g} "
        "as in the restart file",
        id, typed_shape.radius, state[RADIUS]);
  const std::vector<double> now = restart_state();
  if (state[SHAPE_CHECK] != now[SHAPE_CHECK])
    error->all(FLERR,
               "fix {} wall/gran/eepa: the triangles of wall {} are others than those of the "
               "restart file: its contacts can not be those of another surface; give the same "
               "file with the same keywords, or another fix ID to begin without them",
               id, typed_shape.kind_name());
  if (state[VALUES_A_CONTACT] != now[VALUES_A_CONTACT] ||
      state[ROLLING_SPRING] != now[ROLLING_SPRING] ||
      state[TWISTING_SPRING] != now[TWISTING_SPRING])
    error->all(FLERR,
               "fix {} wall/gran/eepa: the restart file has {} values a contact{}{} and the fix "
               "needs {}: rolling sds and twisting can not be switched on or off with a restart",
               id, state[VALUES_A_CONTACT], state[ROLLING_SPRING] != 0.0 ? " with rolling sds" : "",
               state[TWISTING_SPRING] != 0.0 ? " with twisting" : "", history_size);
  if (comm->me != 0) return;
  const eepa::Law law = eepa::unpack_law(state[LAW]);
  if (law != style.settings.law)
    error->warning(FLERR,
                   "fix {} wall/gran/eepa: the law was {} when the restart file was written and is "
                   "{} now: contacts keep their largest overlap, and their forces change at once",
                   id, eepa::entry_of(law).name, eepa::entry_of(style.settings.law).name);
  if (state[EXPONENT] != style.settings.exponent)
    error->warning(
        FLERR,
        "fix {} wall/gran/eepa: exponent was {} when the restart file was written and is "
        "{} now: contacts keep their largest overlap, and their forces change at once",
        id, state[EXPONENT], style.settings.exponent);
  const struct {
    const char *name;
    bool there;
    double typed, stored;
  } planes[] = {{"lo", typed_shape.has_lo, typed_shape.lo, state[LO]},
                {"hi", typed_shape.has_hi, typed_shape.hi, state[HI]}};
  for (const auto &plane : planes)
    if (plane.there && plane.typed != plane.stored)
      error->warning(FLERR,
                     "fix {} wall/gran/eepa: wall {} = {:.15g} is not used: the restart file has "
                     "it made at {:.15g}, and the wall stays where it was",
                     id, plane.name, plane.typed, plane.stored);
}

/// Restores the wall of the file, then changes its motion where the command gives another one.
void FixWallGranEepa::take_up_motion(const std::vector<double> &state)
{
  const eepa::MotionArguments typed = motion_args;
  if (typed_shape.is_plane()) {
    typed_shape.lo = state[LO];
    typed_shape.hi = state[HI];
    initial_position = typed_shape.has_lo ? typed_shape.lo : typed_shape.hi;
    make_shape();
  }
  motion_args = eepa::MotionArguments();
  motion_args.drive = static_cast<WallDrive>(static_cast<int>(state[DRIVE]));
  motion.drive = motion_args.drive;
  std::copy_n(state.begin() + DISPLACEMENT, 3, motion.displacement.begin());
  std::copy_n(state.begin() + ORIGIN, 3, motion.origin.begin());
  motion.time.before = state[TIME_BEFORE];
  motion.time.step = state[TIME_STEP];
  motion.time.steps = static_cast<std::int64_t>(state[TIME_STEPS]);
  motion.wiggle_axis = static_cast<int>(state[WIGGLE_AXIS]);
  motion.amplitude = state[WIGGLE_AMPLITUDE];
  motion.period = state[WIGGLE_PERIOD];
  std::copy_n(state.begin() + SURFACE_VELOCITY, 3, motion.given.begin());
  platen.mass = state[PLATEN_MASS];
  platen.position = state[PLATEN_POSITION];
  platen.velocity = state[PLATEN_VELOCITY];
  platen.work = state[PLATEN_WORK];
  platen.dissipated = state[PLATEN_DISSIPATED];
  motion_args.load.axis = static_cast<int>(state[LOAD_AXIS]);
  motion_args.rotates = state[ROTATES] != 0.0;
  std::copy_n(state.begin() + POINT, 3, motion_args.rotation.point.begin());
  std::copy_n(state.begin() + AXIS, 3, motion_args.rotation.axis.begin());
  placement.begun_at = Eigen::Quaterniond(state[BEGUN_AT], state[BEGUN_AT + 1], state[BEGUN_AT + 2],
                                          state[BEGUN_AT + 3]);
  placement.shift_begun_at = vector_at(state, SHIFT_BEGUN_AT);
  placement.pivot = vector_at(state, PIVOT);
  placement.axis = vector_at(state, AXIS);
  placement.turn_to(state[TURNED_BY]);
  angle_before = state[ANGLE_BEFORE];
  angular_speed = state[ANGULAR_SPEED];
  measure_rotation();
  if (region_shape) {
    RegionMotion region;
    region.step = static_cast<bigint>(state[REGION_STEP]);
    region.displacement = vector_at(state, REGION_DISPLACEMENT);
    region.angle = state[REGION_ANGLE];
    region.velocity = vector_at(state, REGION_VELOCITY);
    region.angular_velocity = vector_at(state, REGION_ANGULAR_VELOCITY);
    region.size_before = state[REGION_SIZE_BEFORE];
    region_shape->set_motion(region);
  }
  place_wall();

  const bool same_wiggle = typed.wiggle_axis == motion.wiggle_axis &&
      typed.amplitude == motion.amplitude && typed.period == motion.period;
  const bool same_rotation = typed.rotates == motion_args.rotates &&
      (!typed.rotates ||
       (typed.rotation.axis == motion_args.rotation.axis &&
        typed.rotation.point == motion_args.rotation.point));
  if (typed.drive != motion_args.drive || loaded() || !same_rotation ||
      (typed.drive == WallDrive::wiggle && !same_wiggle)) {
    change_motion(typed, same_rotation);
    return;
  }
  // the same motion goes on; numbers of the command replace those of the file
  motion_args = typed;
  for (int k = 0; k < 3; k++)
    if (motion_args.velocity[k].variable.empty()) motion.given[k] = motion_args.velocity[k].value;
  sliding = motion_args.shear.value;
  if (motion_args.slides && !motion_args.shear.variable.empty())
    sliding = typed_shape.is_plane() || motion_args.shear_axis == 2
        ? state[SURFACE_VELOCITY + motion_args.shear_axis]
        : state[SURFACE_SPEED];
  if (motion_args.rotation.speed.variable.empty()) angular_speed = motion_args.rotation.speed.value;
  place_wall();
}
