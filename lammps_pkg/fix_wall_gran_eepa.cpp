// SPDX-License-Identifier: GPL-2.0-only

// FixWallGranEepa outside the force call: its command, set-up, per-atom arrays.

#include "fix_wall_gran_eepa.h"

#include "citations.h"
#include "face_loads.h"
#include "find_contact_owners.h"
#include "read_mesh.h"
#include "region_shape.h"
#include "run_guards.h"

#include <eepa/history.h>
#include <eepa/time_step.h>
#include <eepa_walls/cylinder.h>
#include <eepa_walls/planes.h>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace LAMMPS_NS;

FixWallGranEepa::FixWallGranEepa(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), masses(lmp), sums{}, output_vector{}
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR,
               "fix {} wall/gran/eepa: atoms must have radius, rmass, omega and torque; use "
               "atom_style sphere",
               id);
  require_consistent_units(lmp, style_name());

  eepa::WallArguments typed;
  eepa::Words warnings;
  try {
    typed = eepa::parse_wall(eepa::Words(arg, arg + narg), 3, warnings);
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "fix {} wall/gran/eepa: {}", id, e.what());
  }
  if (!warnings.empty() && comm->me == 0)
    error->warning(FLERR, "fix {} wall/gran/eepa: {}", id, warnings.front());
  style = typed.style;
  parameters = typed.parameters;
  cite_papers(lmp, style.settings, parameters);
  coefficients = eepa::resolve(parameters, style.settings);
  typed_shape = typed.shape;
  initial_position = typed_shape.has_lo ? typed_shape.lo : typed_shape.hi;
  contact_table = typed.contact_table;
  about = typed.about;
  require_walls_in_the_box();
  make_shape();
  if (typed.face_interval == 0) face_loads.reset();
  change_motion(typed.motion);

  create_attribute = 1;
  restart_peratom = 1;
  restart_global = 1;
  time_integrate = 0;
  scalar_flag = 1;
  vector_flag = 1;
  size_vector = N_VECTOR;
  global_freq = 1;
  extscalar = 1;
  extvector = 0;
  energy_global_flag = 1;
  virial_global_flag = virial_peratom_flag = 1;
  maxexchange_dynamic = 1;
  dynamic_group_allow = 1;
  peratom_flag = contact_table ? 1 : 0;
  if (contact_table) {
    size_peratom_cols = N_ATOM;
    peratom_freq = 1;
  }
  engine = make_contact_engine(lmp, style.settings, parameters.rolling, parameters.twisting);
  history_size = engine->history_size();
  waiting_outcomes.resize(engine->lanes());
  maxexchange = 1;
  dt = update->dt;
  if (typed.face_interval > 0) {
    nevery = local_freq = typed.face_interval;
    local_flag = 1;
    size_local_cols = FaceLoads::N_COLUMNS;
    face_loads->sum(world);
    size_local_rows = face_loads->row_count();
    array_local = face_loads->rows();
  }

  FixWallGranEepa::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  for (int i = 0; i < atom->nlocal; i++) FixWallGranEepa::set_arrays(i);
}

/// A plane or a cylinder can not lie across a periodic dimension.
void FixWallGranEepa::require_walls_in_the_box() const
{
  if (typed_shape.kind == eepa::WallShape::zcylinder) {
    if (domain->xperiodic || domain->yperiodic)
      error->all(FLERR,
                 "fix {} wall/gran/eepa: wall zcylinder can not be used where x or y is periodic",
                 id);
  } else if (typed_shape.is_plane() && domain->periodicity[typed_shape.axis()]) {
    error->all(FLERR, "fix {} wall/gran/eepa: wall {} can not be used where {} is periodic", id,
               typed_shape.kind_name(), typed_shape.kind_name()[0]);
  }
}

void FixWallGranEepa::make_shape()
{
  if (typed_shape.is_plane()) {
    shape = std::make_unique<eepa::Planes>(typed_shape.axis(), typed_shape.has_lo,
                                           typed_shape.has_hi, typed_shape.lo, typed_shape.hi);
  } else if (typed_shape.kind == eepa::WallShape::zcylinder) {
    shape = std::make_unique<eepa::Cylinder>(typed_shape.radius);
  } else if (typed_shape.kind == eepa::WallShape::region) {
    auto of_region = std::make_unique<RegionShape>(find_region());
    region_shape = of_region.get();
    shape = std::move(of_region);
  } else {
    auto mesh = read_mesh(lmp, typed_shape, style_name());
    face_loads = std::make_unique<FaceLoads>(mesh->mesh().file_number, mesh->mesh().areas);
    shape = std::move(mesh);
  }
}

/// Whether a part of a union or an intersection turns by its own keywords.
static bool has_parts_that_turn(const Region *region)
{
  for (int k = 0; region->reglist && k < region->nregion; k++)
    if (region->reglist[k]->rotateflag || has_parts_that_turn(region->reglist[k])) return true;
  return false;
}

Region *FixWallGranEepa::find_region() const
{
  // Region::surface() of a part has turned its contacts back into space. Of 4 Jul 2026, that of a union or an
  // intersection turns them once more, and others of the list with them.
  constexpr int turned_once = 20250204;
  Region *region = domain->get_region_by_id(typed_shape.region_id);
  if (!region)
    error->all(FLERR, "fix {} wall/gran/eepa: wall region {} does not exist", id,
               typed_shape.region_id);
  if (lmp->num_ver > turned_once && has_parts_that_turn(region))
    error->all(
        FLERR,
        "fix {} wall/gran/eepa: wall region {} has a part with keyword rotate: LAMMPS newer than 4 "
        "Feb 2025 finds contacts with such a region in wrong places; turn the whole wall with "
        "rotate of the fix",
        id, typed_shape.region_id);
  return region;
}

FixWallGranEepa::~FixWallGranEepa()
{
  if (copymode) return;
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  if (contact_table) memory->destroy(array_atom);
}

/* ---------------------------------------------------------------------- set-up */

int FixWallGranEepa::setmask()
{
  // fix_modify may set a load between any two runs
  return FixConst::INITIAL_INTEGRATE | FixConst::POST_FORCE | FixConst::FINAL_INTEGRATE |
      (face_loads ? FixConst::END_OF_STEP : 0);
}

void FixWallGranEepa::init()
{
  dt = update->dt;
  require_force_once_a_step(lmp, style_name());
  warn_of_rotation();
  warn_of_device();
  if (region_shape) region_shape->set_region(find_region());
  masses.init("fix wall/gran/eepa");
  const bool kept = keep_ledger;
  keep_ledger = EnergyLedger::wanted(modify);
  ledger_starts = keep_ledger && (ledger_starts || !kept);
  radii_may_change = LAMMPS_NS::radii_may_change(modify);
  require_variables(motion_args);
  if (loaded()) require_limits(motion_args.load, platen.position);
}

std::string FixWallGranEepa::style_name() const
{
  return std::string("fix ") + id + " wall/gran/eepa";
}

/// Warns only once, also with several walls and a pair style.
void FixWallGranEepa::warn_of_rotation()
{
  if (comm->me != 0) return;
  for (const auto *pair : find_eepa_pairs(force))
    if (pair->has_warned_of_rotation()) return;
  for (const auto *wall : find_eepa_walls(modify))
    if (wall->rotation_warned) return;
  const std::string advice = advice_on_rotation(lmp, parameters.mu);
  if (advice.empty()) return;
  rotation_warned = true;
  error->warning(FLERR, "{}: {}", style_name(), advice);
}

void FixWallGranEepa::warn_of_device()
{
  if (comm->me != 0) return;
  for (const auto *wall : find_eepa_walls(modify))
    if (wall->device_warned) return;
  const std::string advice = advice_on_device(lmp);
  if (advice.empty()) return;
  device_warned = true;
  error->warning(FLERR, "{}: {}", style_name(), advice);
}

void FixWallGranEepa::reset_dt()
{
  dt = update->dt;
}

TimeStepBound FixWallGranEepa::largest_time_step(const std::vector<AnnouncedParticles> &announced)
{
  TimeStepBound bound = {contact_time_step(), std::string("fix ") + id};
  for (const AnnouncedParticles &come : announced)
    bound.time_step =
        std::min(bound.time_step,
                 eepa::largest_time_step(eepa::sphere_mass(come.smallest, come.density),
                                         eepa::largest_stiffness(coefficients, come.smallest)));
  if (loaded()) bound.time_step = std::min(bound.time_step, platen_time_step());
  return bound;
}

/// Checks the time step at the start of a run and when particles were inserted. Collective.
void FixWallGranEepa::check_time_step()
{
  checked_particles = atom->natoms;
  const double bound = contact_time_step();
  if (style.time_step_check == eepa::TimeStepCheck::off || update->dt <= bound || time_step_warned)
    return;
  time_step_warned = true;
  complain(fmt::format("fix {} wall/gran/eepa: timestep {:.6g} is larger than {:.6g} = 0.2 "
                       "sqrt(m_min/k_max) of contacts with this wall",
                       id, update->dt, bound));
}

double FixWallGranEepa::contact_time_step()
{
  bring_sizes_to_host();
  double mine = std::numeric_limits<double>::infinity(), stiffest = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_member(i)) continue;
    const double mass = masses.mass(i);
    const double stiffness = eepa::largest_stiffness(coefficients, 2.0 * atom->radius[i]);
    stiffest = std::max(stiffest, stiffness);
    if (!std::isinf(mass)) mine = std::min(mine, eepa::largest_time_step(mass, stiffness));
  }
  double bound;
  MPI_Allreduce(&mine, &bound, 1, MPI_DOUBLE, MPI_MIN, world);
  if (loaded()) MPI_Allreduce(&stiffest, &load_stiffness, 1, MPI_DOUBLE, MPI_MAX, world);
  return bound;
}

double FixWallGranEepa::platen_time_step() const
{
  // the platen is a mass on parallel springs
  const double stiffness = output_vector[CONTACTS] * load_stiffness;
  return stiffness > 0.0 ? eepa::largest_time_step(platen.mass, stiffness)
                         : std::numeric_limits<double>::infinity();
}

void FixWallGranEepa::check_platen()
{
  if (style.time_step_check == eepa::TimeStepCheck::off || platen_warned) return;
  const double bound = platen_time_step();
  if (dt <= bound) return;
  platen_warned = true;
  complain(
      fmt::format("fix {} wall/gran/eepa: timestep {:.6g} is larger than {:.6g} = 0.2 "
                  "sqrt(m/(n k_max)) of the platen of mass m = {:.6g} on its n = {:.0f} contacts; "
                  "make it at least as heavy as the particles that touch it",
                  id, dt, bound, platen.mass, output_vector[CONTACTS]));
}

/// Raises an error or a warning, according to dtcheck.
void FixWallGranEepa::complain(const std::string &message)
{
  if (style.time_step_check == eepa::TimeStepCheck::error)
    error->all(FLERR, message);
  else if (comm->me == 0)
    error->warning(FLERR, message);
}

double FixWallGranEepa::memory_usage()
{
  double bytes = histories.memory_usage() + masses.memory_usage() + candidates.memory_usage() +
      static_cast<double>(visits.capacity() * sizeof(Visit));
  if (contact_table) bytes += static_cast<double>(atom->nmax) * N_ATOM * sizeof(double);
  if (face_loads) bytes += face_loads->memory_usage();
  return bytes;
}
