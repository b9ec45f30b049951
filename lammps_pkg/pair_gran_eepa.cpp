// SPDX-License-Identifier: GPL-2.0-only

// PairGranEepa outside the force call: commands and set-up.

#include "pair_gran_eepa.h"

#include "citations.h"
#include "contact_history.h"
#include "run_guards.h"

#include <eepa_commands/mixing.h>
#include <eepa_commands/restart_numbers.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <array>
#include <stdexcept>

using namespace LAMMPS_NS;

namespace {
constexpr const char *style_name = "pair_style gran/eepa";
}    // namespace

PairGranEepa::PairGranEepa(LAMMPS *lmp) : Pair(lmp), masses(lmp)
{
  single_enable = 1;
  no_virial_fdotr_compute = 1;    // friction is not central, so the virial is tallied pair by pair
  centroidstressflag = CENTROID_NOTAVAIL;
  finitecutflag = 1;
  writedata = 1;
  comm_forward = 2;                      // mass and number of a body of fix rigid
  comm_reverse = AtomLosses::kinds;      // losses of ghosts
  single_extra = N_SINGLE;
  svector = new double[N_SINGLE];

  // A restart file finds the history by this ID. LAMMPS's styles number theirs by the pair styles
  // that a process ever had, so that an additional pair_style in the writing or the reading run
  // would lose the history without a warning. The first free ID avoids that.
  int n = 0;
  do {
    history_id = "NEIGH_HISTORY_EEPA" + std::to_string(n++);
  } while (modify->get_fix_by_id(history_id) ||
           modify->get_fix_by_id(ContactHistory::place_holder(history_id)));
  // reserves the position of the history fix in the list of fixes
  modify->add_fix(ContactHistory::place_holder(history_id) + " all DUMMY");
}

PairGranEepa::~PairGranEepa()
{
  if (copymode) return;
  delete[] svector;
  svector = nullptr;
  modify->delete_fix(fix_history ? history_id : ContactHistory::place_holder(history_id));
  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
}

int PairGranEepa::history_size() const
{
  return eepa::history_size(rolling, twisting);
}

void PairGranEepa::allocate()
{
  allocated = 1;
  const int n = ntypes_allocated = atom->ntypes;
  memory->create(setflag, n + 1, n + 1, "pair:setflag");
  for (int i = 1; i <= n; i++)
    for (int j = i; j <= n; j++) setflag[i][j] = 0;
  memory->create(cutsq, n + 1, n + 1, "pair:cutsq");
  parameters.assign((n + 1) * (n + 1), eepa::Parameters());
  coefficients.assign((n + 1) * (n + 1), eepa::Coefficients());
}

void PairGranEepa::warn(const eepa::Words &warnings)
{
  if (warnings.empty() || plateau_warned) return;
  plateau_warned = true;
  if (comm->me == 0) error->warning(FLERR, "{}: {}", style_name, warnings.front());
}

/* ---------------------------------------------------------------------- commands */

void PairGranEepa::settings(int narg, char **arg)
{
  eepa::StyleArguments given;
  try {
    eepa::parse_style(eepa::Words(arg, arg + narg), 0, "", given);
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "{}: {}", style_name, e.what());
  }
  style = given;
  plateau_warned = false;
}

void PairGranEepa::coeff(int narg, char **arg)
{
  if (narg < 2) error->all(FLERR, "pair_coeff for gran/eepa: missing types I J");
  if (!allocated) allocate();
  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  eepa::Parameters given;
  eepa::Words warnings;
  try {
    eepa::parse_parameters(eepa::Words(arg, arg + narg), 2, "", style.settings, given, warnings);
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "pair_coeff {} {} for gran/eepa: {}", arg[0], arg[1], e.what());
  }
  warn(warnings);
  cite_papers(lmp, style.settings, given);

  int count = 0;
  for (int i = ilo; i <= ihi; i++) {
    for (int j = std::max(jlo, i); j <= jhi; j++) {
      parameters[pair_index(i, j)] = parameters[pair_index(j, i)] = given;
      setflag[i][j] = 1;
      count++;
    }
  }
  if (count == 0)
    error->all(FLERR, "pair_coeff {} {} for gran/eepa: no pair of types with I <= J", arg[0],
               arg[1]);
}

/* ---------------------------------------------------------------------- set-up */

void PairGranEepa::init_style()
{
  require_consistent_units(lmp, style_name);
  require_force_once_a_step(lmp, style_name);
  require_history_communication(lmp, style_name);
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "{}: atoms must have radius, rmass, omega and torque; use atom_style sphere",
               style_name);
  if (!comm->ghost_velocity)
    error->all(FLERR, "{}: ghost atoms must have velocities; use comm_modify vel yes", style_name);
  if (!atom->tag_enable)
    error->all(FLERR, "{}: atoms must have IDs; use atom_modify id yes", style_name);

  dt = update->dt;
  masses.init(style_name);
  init_radii();
  const bool kept = keep_ledger;
  keep_ledger = EnergyLedger::wanted(modify);
  ledger_starts = keep_ledger && (ledger_starts || !kept);

  // all pairs of types use the same model of rolling and of twisting; pairs without it have a bound
  // of 0
  rolling = eepa::RollingModel::none;
  twisting = eepa::TwistingModel::none;
  for (int i = 1; i <= atom->ntypes; i++) {
    for (int j = i; j <= atom->ntypes; j++) {
      if (!setflag[i][j]) continue;
      if (parameters[pair_index(i, j)].twisting != eepa::TwistingModel::none)
        twisting = parameters[pair_index(i, j)].twisting;
      const eepa::RollingModel model = parameters[pair_index(i, j)].rolling;
      if (model == eepa::RollingModel::none) continue;
      if (rolling != eepa::RollingModel::none && rolling != model)
        error->all(FLERR,
                   "{}: pair_coeff {} {} has another rolling model than those before; constant and "
                   "sds can not be used together",
                   style_name, i, j);
      rolling = model;
    }
  }
  init_history();
  // the ledger must book contacts that open at a rebuild, so these are kept until the force call
  fix_history->keep_parting_contacts(keep_ledger);
  warn_of_fixes();
  engine = make_contact_engine(style.settings, rolling, twisting);
  classes.clear();    // made again after init_one()
  // the request comes last: after an error LAMMPS would keep that of a pair style that may be gone
  neighbor->add_request(this, NeighConst::REQ_SIZE | NeighConst::REQ_HISTORY);
}

void PairGranEepa::warn_of_fixes()
{
  double mu = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      if (setflag[i][j]) mu = std::max(mu, parameters[pair_index(i, j)].mu);
  const auto say_once = [this](const std::string &advice, bool &said) {
    if (advice.empty() || said) return;
    said = true;
    if (comm->me == 0) error->warning(FLERR, "{}: {}", style_name, advice);
  };
  say_once(advice_on_rotation(lmp, mu), rotation_warned);
  say_once(advice_on_heat(lmp), heat_warned);
  say_once(advice_on_rerun(lmp), rerun_warned);
}

void PairGranEepa::init_history()
{
  const int size = history_size();
  if (!fix_history) {
    fix_history = ContactHistory::make(lmp, history_id, size, this);
  } else if (fix_history->get_dnum() != size) {
    error->all(FLERR, "{}: rolling sds and twisting can not be switched on or off after a run",
               style_name);
  }
  fix_history->end_interrupted_run();
  // LAMMPS would give a history to any particle that has the ID now
  if (!fix_history->ids_are_kept())
    error->all(
        FLERR,
        "{}: atom IDs were renumbered while there were contacts, whose history is kept by ID; "
        "use delete_atoms with compress no, and no reset_atoms id",
        style_name);
  fix_history->go_on_with(style.settings);
  fix_history->watch_radii(radii_may_change(modify));
}

double PairGranEepa::init_one(int i, int j)
{
  if (!allocated) allocate();
  eepa::Parameters &own = parameters[pair_index(i, j)];
  eepa::Words warnings;
  if (setflag[i][j] == 0) {
    std::string why;
    if (setflag[i][i] == 0 || setflag[j][j] == 0)
      error->all(FLERR,
                 "{}: pair_coeff {} {} is not given and can not be mixed without {} {} and {} {}",
                 style_name, i, j, i, i, j, j);
    if (!eepa::mix(parameters[pair_index(i, i)], parameters[pair_index(j, j)], own, why))
      error->all(FLERR, "{}: pair_coeff {} {} can not be mixed: {}; give it", style_name, i, j,
                 why);
  }
  try {
    eepa::require_valid(own, style.settings, warnings);
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "pair_coeff {} {} for gran/eepa: {}", i, j, e.what());
  }
  warn(warnings);
  parameters[pair_index(j, i)] = own;
  coefficients[pair_index(i, j)] = coefficients[pair_index(j, i)] =
      eepa::resolve(own, style.settings);

  // no contacts between frozen particles
  return std::max({max_radius_dynamic[i] + max_radius_dynamic[j],
                   max_radius_frozen[i] + max_radius_dynamic[j],
                   max_radius_dynamic[i] + max_radius_frozen[j]});
}

void PairGranEepa::setup()
{
  if (masses.has_bodies()) masses.collect_bodies();    // those of ghosts in compute()
  check_time_step();
}

void PairGranEepa::reset_dt()
{
  dt = update->dt;
}

double PairGranEepa::atom2cut(int i)
{
  return 2.0 * atom->radius[i];
}

double PairGranEepa::radii2cut(double radius_i, double radius_j)
{
  return radius_i + radius_j;
}

/* ---------------------------------------------------------------------- what ghosts dissipated */

int PairGranEepa::pack_reverse_comm(int n, int first, double *buf)
{
  return atom_losses.pack(n, first, buf);
}

void PairGranEepa::unpack_reverse_comm(int n, int *atoms, double *buf)
{
  atom_losses.unpack(n, atoms, buf);
}

/* ---------------------------------------------------------------------- masses of rigid bodies */

int PairGranEepa::pack_forward_comm(int n, int *atoms, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  return masses.pack_bodies(n, atoms, buf);
}

void PairGranEepa::unpack_forward_comm(int n, int first, double *buf)
{
  masses.unpack_bodies(n, first, buf);
}

double PairGranEepa::memory_usage()
{
  double bytes = Pair::memory_usage() + masses.memory_usage() + atom_losses.memory_usage() +
      static_cast<double>(parameters.capacity() * sizeof(eepa::Parameters) +
                          coefficients.capacity() * sizeof(eepa::Coefficients)) +
      classes.memory_usage();
  for (const ContactSlice &slice : slices) bytes += slice.memory_usage();
  return bytes;
}
