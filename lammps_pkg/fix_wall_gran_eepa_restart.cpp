// SPDX-License-Identifier: GPL-2.0-only

// How FixWallGranEepa writes restart files and reads them.
//
// The fix writes a list of numbers, `names` below. The first is the format, the second their count.
// A new kind of wall adds the numbers of its shape at the end, with a new value of `kind`.
//
// A particle has {length, values a contact, contacts n, n times {face, values of the contact}},
// where length counts itself. Only faces in contact are written: a wall may have many faces.

#include "fix_wall_gran_eepa.h"

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
using eepa::WallDrive;

namespace {

constexpr double restart_format = 3.0;

enum StateIndex {
  FORMAT,
  COUNT,
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
  N_STATE = VECTOR + 16
};

const char *name_of(int index)
{
  static const char *const names[] = {"format",
                                      "count",
                                      "kind",
                                      "sides",
                                      "lo",
                                      "hi",
                                      "radius",
                                      "law",
                                      "exponent",
                                      "rolling spring",
                                      "twisting spring",
                                      "values a contact",
                                      "drive",
                                      "displacement",
                                      "displacement",
                                      "displacement",
                                      "origin of motion",
                                      "origin of motion",
                                      "origin of motion",
                                      "time before",
                                      "time step",
                                      "number of steps",
                                      "wiggle dimension",
                                      "wiggle A",
                                      "wiggle period",
                                      "velocity",
                                      "velocity",
                                      "velocity",
                                      "speed of the surface",
                                      "load mass",
                                      "load position",
                                      "load velocity",
                                      "load work",
                                      "load dissipation"};
  static_assert(sizeof(names) / sizeof(names[0]) == VECTOR, "a name for each number");
  return index < VECTOR ? names[index] : "output";
}

bool is_count(double value, double least, double most)
{
  return value >= least && value <= most && value == std::floor(value);
}

/// Why the numbers can not have been written by this fix; "" where they can.
std::string damage(const std::vector<double> &state)
{
  const auto wrong = [&state](int index) {
    return fmt::format("{} = {}", name_of(index), state[index]);
  };
  for (int k = 0; k < N_STATE; k++)
    if (!std::isfinite(state[k])) return wrong(k);
  constexpr double huge = 9007199254740992.0;    // 2^53: larger integers are not exact
  const struct {
    int index;
    double least, most;
  } integers[] = {{KIND, 0, 3},
                  {SIDES, 1, 3},
                  {LAW, 0, eepa::law_count - 1},
                  {ROLLING_SPRING, 0, 1},
                  {TWISTING_SPRING, 0, 1},
                  {DRIVE, 0, 4},
                  {VALUES_A_CONTACT, 1, 1000},
                  {TIME_STEPS, 0, huge},
                  {WIGGLE_AXIS, 0, 2}};
  for (const auto &number : integers)
    if (!is_count(state[number.index], number.least, number.most)) return wrong(number.index);
  for (const int index : {EXPONENT, WIGGLE_PERIOD})
    if (state[index] <= 0.0) return wrong(index);
  for (const int index : {RADIUS, PLATEN_MASS, TIME_STEP})
    if (state[index] < 0.0) return wrong(index);
  return "";
}

int sides_of(const WallSurfaces &surfaces)
{
  if (!surfaces.is_plane()) return 3;
  return (surfaces.has_lo ? 1 : 0) + (surfaces.has_hi ? 2 : 0);
}

std::string shape_name(int kind, int sides)
{
  WallSurfaces surfaces;
  surfaces.kind = static_cast<WallSurfaces::Kind>(kind);
  std::string name = surfaces.kind_name();
  if (surfaces.is_plane()) name += sides == 1 ? " lo NULL" : sides == 2 ? " NULL hi" : " lo hi";
  return name;
}

}    // namespace

/* ---------------------------------------------------------------------- the fix */

std::vector<double> FixWallGranEepa::restart_state() const
{
  std::vector<double> state(N_STATE, 0.0);
  state[FORMAT] = restart_format;
  state[COUNT] = N_STATE;
  state[KIND] = surfaces.kind;
  state[SIDES] = sides_of(surfaces);
  state[LO] = initial_position[0];
  state[HI] = initial_position[1];
  state[RADIUS] = surfaces.radius;
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
  std::copy_n(surfaces.velocity.begin(), 3, state.begin() + SURFACE_VELOCITY);
  state[SURFACE_SPEED] = surfaces.surface_speed;
  state[PLATEN_MASS] = platen.mass;
  state[PLATEN_POSITION] = platen.position;
  state[PLATEN_VELOCITY] = platen.velocity;
  state[PLATEN_WORK] = platen.work;
  state[PLATEN_DISSIPATED] = platen.dissipated;
  static_assert(N_VECTOR == N_STATE - VECTOR, "the file has the whole global vector");
  std::copy(output_vector.begin(), output_vector.end(), state.begin() + VECTOR);
  return state;
}

void FixWallGranEepa::write_restart(FILE *fp)
{
  // on all ranks, because it sums the forces of all ranks where that was not done yet
  FixWallGranEepa::compute_vector(0);
  if (comm->me != 0) return;
  const std::vector<double> state = restart_state();
  const int bytes = static_cast<int>(state.size() * sizeof(double));
  fwrite(&bytes, sizeof(int), 1, fp);
  fwrite(state.data(), sizeof(double), state.size(), fp);
}

void FixWallGranEepa::restart(char *buf)
{
  std::vector<double> state(N_STATE);
  // read the format alone first: another format may be shorter
  std::memcpy(state.data(), buf, sizeof(double));
  if (state[FORMAT] != restart_format)
    error->all(FLERR,
               "fix {} wall/gran/eepa: the restart file has format {}, this version reads {}", id,
               state[FORMAT], restart_format);
  std::memcpy(state.data(), buf, 2 * sizeof(double));
  if (state[COUNT] != N_STATE)
    error->all(FLERR,
               "fix {} wall/gran/eepa: the restart file is damaged: count = {}, it must be {}", id,
               state[COUNT], static_cast<int>(N_STATE));
  std::memcpy(state.data(), buf, N_STATE * sizeof(double));
  const std::string wrong = damage(state);
  if (!wrong.empty())
    error->all(FLERR, "fix {} wall/gran/eepa: the restart file is damaged: {}", id, wrong);
  require_same_wall(state);
  take_up_motion(state);
  std::copy_n(state.begin() + VECTOR, N_VECTOR, output_vector.begin());
  output_is_summed = true;
}

/// Stops where the histories belong to other faces or another layout. Warns where law or exponent
/// differ, which read histories differently, or a plane's coordinate: that of the file is kept.
void FixWallGranEepa::require_same_wall(const std::vector<double> &state) const
{
  const std::string was = shape_name(static_cast<int>(state[KIND]), static_cast<int>(state[SIDES])),
                    is = shape_name(surfaces.kind, sides_of(surfaces));
  if (was != is)
    error->all(FLERR,
               "fix {} wall/gran/eepa: the wall of the restart file is {}, this one is {}: its "
               "contacts can not be those of another surface; give the same wall, or another fix "
               "ID to begin without them",
               id, was, is);
  if (state[RADIUS] != surfaces.radius)
    error->all(
        FLERR,
        "fix {} wall/gran/eepa: wall zcylinder R = {:.15g} is not allowed: it must be {:.15g} "
        "as in the restart file",
        id, surfaces.radius, state[RADIUS]);
  const std::vector<double> now = restart_state();
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
  } planes[] = {{"lo", surfaces.has_lo, initial_position[0], state[LO]},
                {"hi", surfaces.has_hi, initial_position[1], state[HI]}};
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
  initial_position = {state[LO], state[HI]};
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
  place_surfaces();

  const bool same_wiggle = typed.wiggle_axis == motion.wiggle_axis &&
      typed.amplitude == motion.amplitude && typed.period == motion.period;
  if (typed.drive != motion_args.drive || loaded() ||
      (typed.drive == WallDrive::wiggle && !same_wiggle)) {
    change_motion(typed);
    return;
  }
  // the same motion goes on; numbers of the command replace those of the file
  motion_args = typed;
  for (int k = 0; k < 3; k++)
    if (motion_args.velocity[k].variable.empty()) motion.given[k] = motion_args.velocity[k].value;
  sliding = motion_args.shear.value;
  if (motion_args.slides && !motion_args.shear.variable.empty())
    sliding = surfaces.is_plane() || motion_args.shear_axis == 2
        ? state[SURFACE_VELOCITY + motion_args.shear_axis]
        : state[SURFACE_SPEED];
  place_surfaces();
}

/* ---------------------------------------------------------------------- particles */

int FixWallGranEepa::maxsize_restart()
{
  return 3 + surfaces.count() * (1 + history_size);
}

int FixWallGranEepa::size_restart(int i)
{
  int contacts = 0;
  for (int surface = 0; surface < surfaces.count(); surface++)
    if (history[i][surface * history_size + eepa::MAX_OVERLAP] != 0.0) contacts++;
  return 3 + contacts * (1 + history_size);
}

int FixWallGranEepa::pack_restart(int i, double *buf)
{
  int at = 3, contacts = 0;
  for (int surface = 0; surface < surfaces.count(); surface++) {
    const double *values = history[i] + static_cast<std::ptrdiff_t>(surface) * history_size;
    if (values[eepa::MAX_OVERLAP] == 0.0) continue;
    buf[at] = surfaces.face(surface);
    std::copy_n(values, history_size, buf + at + 1);
    at += 1 + history_size;
    contacts++;
  }
  buf[0] = at;    // first, because other fixes skip over it
  buf[1] = history_size;
  buf[2] = contacts;
  return at;
}

void FixWallGranEepa::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  const auto refuse = [this, i](const char *name, double value) {
    error->one(FLERR,
               "fix {} wall/gran/eepa: the restart file is damaged at atom {}: {} of its contacts "
               "with the wall = {}",
               id, atom->tag[i], name, value);
  };
  // number of values that all fixes together have for one atom
  const double end = atom->nextra_store;
  double start = 0.0;
  for (int k = 0; k <= nth; k++) {
    const double length = start < end ? extra[static_cast<int>(start)] : 0.0;
    if (!is_count(length, 1.0, end - start)) refuse("length", length);
    if (k < nth) start += length;
  }
  const double *entry = extra + static_cast<int>(start);
  if (entry[0] < 3.0) refuse("length", entry[0]);
  if (entry[1] != history_size)
    error->one(
        FLERR,
        "fix {} wall/gran/eepa: the restart file has {} values a contact at atom {} and the "
        "fix needs {}: rolling sds and twisting can not be switched on or off with a restart",
        id, entry[1], atom->tag[i], history_size);
  const double contacts = entry[2];
  if (!is_count(contacts, 0.0, surfaces.count())) refuse("number", contacts);
  if (entry[0] != 3.0 + contacts * (1 + history_size)) refuse("length", entry[0]);

  std::fill_n(history[i], n_values, 0.0);
  for (int c = 0; c < static_cast<int>(contacts); c++) {
    const double *contact = entry + 3 + static_cast<std::ptrdiff_t>(c) * (1 + history_size);
    int surface = 0;
    while (surface < surfaces.count() && surfaces.face(surface) != contact[0]) surface++;
    if (surface == surfaces.count()) refuse("face", contact[0]);
    double *values = history[i] + static_cast<std::ptrdiff_t>(surface) * history_size;
    std::copy_n(contact + 1, history_size, values);
    for (int k = 0; k < history_size; k++)
      if (!std::isfinite(values[k])) refuse("history", values[k]);
    if (values[eepa::MAX_OVERLAP] <= 0.0) refuse("delta_max", values[eepa::MAX_OVERLAP]);
  }
}
