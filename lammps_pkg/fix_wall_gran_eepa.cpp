// SPDX-License-Identifier: GPL-2.0-only

// What FixWallGranEepa does outside the force call: its command, per-atom arrays, restart.

#include "fix_wall_gran_eepa.h"

#include <eepa/history.h>
#include <eepa/time_step.h>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "input.h"
#include "memory.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

using namespace LAMMPS_NS;

namespace {
constexpr double restart_format = 1.0;
constexpr int restart_size = 6;    // format, values an atom, displacement, time origin
}    // namespace

FixWallGranEepa::FixWallGranEepa(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), masses(lmp), felt{}, felt_vector{}
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR,
               "fix {} wall/gran/eepa: atoms must have radius, rmass, omega and torque; use "
               "atom_style sphere",
               id);

  const eepa::Words words(arg, arg + narg);
  int iarg = 3;
  try {
    iarg = static_cast<int>(eepa::parse_style(words, iarg, "coeff", style));
    if (iarg == narg) throw std::invalid_argument("missing keyword coeff");
    eepa::Words warnings;
    iarg = static_cast<int>(
        eepa::parse_parameters(words, iarg + 1, "wall", style.settings, parameters, warnings));
    if (iarg == narg) throw std::invalid_argument("missing keyword wall");
    if (!warnings.empty() && comm->me == 0)
      error->warning(FLERR, "fix {} wall/gran/eepa: {}", id, warnings.front());
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "fix {} wall/gran/eepa: {}", id, e.what());
  }
  coefficients = eepa::resolve(parameters, style.settings);
  iarg = parse_wall(narg, arg, iarg + 1);
  while (iarg < narg) iarg = parse_motion(narg, arg, iarg);

  create_attribute = 1;
  restart_peratom = 1;
  restart_global = 1;
  time_integrate = 0;
  vector_flag = 1;
  size_vector = N_VECTOR;
  global_freq = 1;
  extvector = 0;
  dynamic_group_allow = 1;
  peratom_flag = contact_table ? 1 : 0;
  if (contact_table) {
    size_peratom_cols = N_ATOM;
    peratom_freq = 1;
  }
  history_size = parameters.rolling == eepa::RollingModel::sds ? eepa::SIZE_WITH_ROLLING
                                                               : eepa::SIZE_WITHOUT_ROLLING;
  n_values = history_size * surfaces.count();
  maxexchange = n_values;
  time_origin = update->ntimestep;
  dt = update->dt;

  FixWallGranEepa::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  for (int i = 0; i < atom->nlocal; i++) FixWallGranEepa::set_arrays(i);
}

FixWallGranEepa::~FixWallGranEepa()
{
  if (copymode) return;
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  memory->destroy(history);
  if (contact_table) memory->destroy(array_atom);
}

/* ---------------------------------------------------------------------- command */

void FixWallGranEepa::require(int narg, int iarg, int count, const char *what)
{
  if (iarg + count > narg) error->all(FLERR, "fix {} wall/gran/eepa: missing value: {}", id, what);
}

double FixWallGranEepa::number(const char *name, const char *word)
{
  try {
    return eepa::parse_number(name, word);
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "fix {} wall/gran/eepa: {}", id, e.what());
  }
  return 0.0;
}

int FixWallGranEepa::dimension(const char *name, const char *word)
{
  const std::string dim = word;
  if (dim != "x" && dim != "y" && dim != "z")
    error->all(FLERR,
               "fix {} wall/gran/eepa: {} dimension '{}' is not allowed: it must be x, y or z", id,
               name, dim);
  return dim[0] - 'x';
}

int FixWallGranEepa::parse_wall(int narg, char **arg, int iarg)
{
  require(narg, iarg, 1, "kind of wall (xplane, yplane, zplane or zcylinder)");
  const std::string kind = arg[iarg];
  if (kind == "zcylinder") {
    require(narg, iarg, 2, "wall zcylinder R");
    surfaces.kind = WallSurfaces::zcylinder;
    surfaces.radius = number("wall zcylinder R", arg[iarg + 1]);
    if (surfaces.radius <= 0.0)
      error->all(FLERR,
                 "fix {} wall/gran/eepa: wall zcylinder R = {} is not allowed: it must be > 0", id,
                 arg[iarg + 1]);
    if (domain->xperiodic || domain->yperiodic)
      error->all(FLERR,
                 "fix {} wall/gran/eepa: wall zcylinder can not be used where x or y is periodic",
                 id);
    return iarg + 2;
  }
  if (kind != "xplane" && kind != "yplane" && kind != "zplane")
    error->all(FLERR,
               "fix {} wall/gran/eepa: wall '{}' is unknown: it must be xplane, yplane, zplane or "
               "zcylinder",
               id, kind);
  require(narg, iarg, 3, "wall planes lo hi");
  surfaces.kind = static_cast<WallSurfaces::Kind>(kind[0] - 'x');
  surfaces.has_lo = std::strcmp(arg[iarg + 1], "NULL") != 0;
  surfaces.has_hi = std::strcmp(arg[iarg + 2], "NULL") != 0;
  if (surfaces.has_lo) surfaces.lo = number("wall lo", arg[iarg + 1]);
  if (surfaces.has_hi) surfaces.hi = number("wall hi", arg[iarg + 2]);
  if (!surfaces.has_lo && !surfaces.has_hi)
    error->all(FLERR,
               "fix {} wall/gran/eepa: wall {} NULL NULL has no surface: give lo, hi or both", id,
               kind);
  if (surfaces.has_lo && surfaces.has_hi && surfaces.lo >= surfaces.hi)
    error->all(FLERR, "fix {} wall/gran/eepa: wall {} lo = {} is not allowed: it must be < hi = {}",
               id, kind, arg[iarg + 1], arg[iarg + 2]);
  if (domain->periodicity[surfaces.axis()])
    error->all(FLERR, "fix {} wall/gran/eepa: wall {} can not be used where {} is periodic", id,
               kind, kind[0]);
  return iarg + 3;
}

int FixWallGranEepa::parse_motion(int narg, char **arg, int iarg)
{
  const std::string key = arg[iarg];
  if (key == "contacts") {
    contact_table = true;
    return iarg + 1;
  }
  if (key != "velocity" && key != "wiggle" && key != "shear")
    error->all(
        FLERR,
        "fix {} wall/gran/eepa: keyword '{}' is unknown: it must be velocity, wiggle, shear or "
        "contacts",
        id, key);
  if (motion != Motion::still)
    error->all(FLERR, "fix {} wall/gran/eepa: only one of velocity, wiggle and shear is allowed",
               id);

  if (key == "velocity") {
    require(narg, iarg, 4, "velocity vx vy vz");
    motion = Motion::velocity;
    for (int k = 0; k < 3; k++) {
      if (utils::strmatch(arg[iarg + 1 + k], "^v_"))
        velocity_variable[k] = arg[iarg + 1 + k] + 2;
      else
        velocity[k] = number("velocity", arg[iarg + 1 + k]);
    }
    return iarg + 4;
  }
  if (key == "wiggle") {
    require(narg, iarg, 4, "wiggle dim A period");
    motion = Motion::wiggle;
    motion_axis = dimension("wiggle", arg[iarg + 1]);
    amplitude = number("wiggle A", arg[iarg + 2]);
    period = number("wiggle period", arg[iarg + 3]);
    if (period <= 0.0)
      error->all(FLERR, "fix {} wall/gran/eepa: wiggle period = {} is not allowed: it must be > 0",
                 id, arg[iarg + 3]);
    return iarg + 4;
  }
  require(narg, iarg, 3, "shear dim v");
  motion = Motion::shear;
  motion_axis = dimension("shear", arg[iarg + 1]);
  shear_velocity = number("shear v", arg[iarg + 2]);
  if (surfaces.is_plane() && motion_axis == surfaces.axis())
    error->all(
        FLERR,
        "fix {} wall/gran/eepa: shear dimension {} is not allowed: it must lie in the plane; "
        "use velocity to move a plane along its normal",
        id, arg[iarg + 1]);
  return iarg + 3;
}

/* ---------------------------------------------------------------------- set-up */

int FixWallGranEepa::setmask()
{
  return FixConst::INITIAL_INTEGRATE | FixConst::POST_FORCE;
}

void FixWallGranEepa::init()
{
  dt = update->dt;
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "fix {} wall/gran/eepa can not be used with run_style respa", id);
  masses.init("fix wall/gran/eepa");
  keep_ledger = EnergyLedger::wanted(modify);
  for (const auto &name : velocity_variable) {
    if (name.empty()) continue;
    const int index = input->variable->find(name.c_str());
    if (index < 0)
      error->all(FLERR, "fix {} wall/gran/eepa: velocity variable {} does not exist", id, name);
    if (!input->variable->equalstyle(index))
      error->all(
          FLERR,
          "fix {} wall/gran/eepa: velocity variable {} is not allowed: it must be equal-style", id,
          name);
  }
}

void FixWallGranEepa::reset_dt()
{
  dt = update->dt;
}

TimeStepBound FixWallGranEepa::largest_time_step()
{
  double mine = std::numeric_limits<double>::infinity();
  const double *mass = masses.masses();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit) || std::isinf(mass[i])) continue;
    const double stiffness = eepa::largest_stiffness(coefficients, 2.0 * atom->radius[i]);
    mine = std::min(mine, eepa::largest_time_step(mass[i], stiffness));
  }
  TimeStepBound bound;
  MPI_Allreduce(&mine, &bound.time_step, 1, MPI_DOUBLE, MPI_MIN, world);
  bound.origin = std::string("fix ") + id;
  return bound;
}

/* ---------------------------------------------------------------------- per-atom arrays */

void FixWallGranEepa::grow_arrays(int nmax)
{
  memory->grow(history, nmax, n_values, "wall/gran/eepa:history");
  if (contact_table)
    memory->grow(array_atom, nmax, static_cast<int>(N_ATOM), "wall/gran/eepa:array_atom");
}

void FixWallGranEepa::copy_arrays(int i, int j, int /*delflag*/)
{
  std::copy_n(history[i], n_values, history[j]);
  if (contact_table) std::copy_n(array_atom[i], static_cast<int>(N_ATOM), array_atom[j]);
}

void FixWallGranEepa::set_arrays(int i)
{
  std::fill_n(history[i], n_values, 0.0);
  if (contact_table) std::fill_n(array_atom[i], static_cast<int>(N_ATOM), 0.0);
}

int FixWallGranEepa::pack_exchange(int i, double *buf)
{
  std::copy_n(history[i], n_values, buf);
  return n_values;
}

int FixWallGranEepa::unpack_exchange(int i, double *buf)
{
  std::copy_n(buf, n_values, history[i]);
  if (contact_table) std::fill_n(array_atom[i], static_cast<int>(N_ATOM), 0.0);
  return n_values;
}

/* ---------------------------------------------------------------------- restart */

int FixWallGranEepa::pack_restart(int i, double *buf)
{
  buf[0] = n_values + 1;    // first, because other fixes skip over it
  std::copy_n(history[i], n_values, buf + 1);
  return n_values + 1;
}

void FixWallGranEepa::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  int at = 0;
  for (int k = 0; k < nth; k++) at += static_cast<int>(extra[at]);
  const int count = static_cast<int>(extra[at]) - 1;
  if (count != n_values)
    error->one(FLERR,
               "fix {} wall/gran/eepa: the restart file has {} values a particle and the fix needs "
               "{}: surfaces and rolling sds must be as they were",
               id, count, n_values);
  std::copy_n(extra + at + 1, n_values, history[i]);
}

int FixWallGranEepa::maxsize_restart()
{
  return n_values + 1;
}

int FixWallGranEepa::size_restart(int /*i*/)
{
  return n_values + 1;
}

void FixWallGranEepa::write_restart(FILE *fp)
{
  if (comm->me != 0) return;
  const double numbers[restart_size] = {restart_format,  static_cast<double>(n_values),
                                        displacement[0], displacement[1],
                                        displacement[2], static_cast<double>(time_origin)};
  const int bytes = sizeof(numbers);
  fwrite(&bytes, sizeof(int), 1, fp);
  fwrite(numbers, sizeof(double), restart_size, fp);
}

void FixWallGranEepa::restart(char *buf)
{
  double numbers[restart_size];
  std::memcpy(numbers, buf, sizeof(numbers));
  if (numbers[0] != restart_format)
    error->all(FLERR,
               "fix {} wall/gran/eepa: the restart file has format {}, this version reads {}", id,
               numbers[0], restart_format);
  std::copy_n(numbers + 2, 3, displacement.begin());
  time_origin = static_cast<bigint>(numbers[5]);
}

double FixWallGranEepa::memory_usage()
{
  return static_cast<double>(atom->nmax) * sizeof(double) *
      (n_values + (contact_table ? N_ATOM : 0)) +
      masses.memory_usage();
}
