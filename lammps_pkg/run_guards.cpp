// SPDX-License-Identifier: GPL-2.0-only
#include "run_guards.h"

#include "comm.h"
#include "compute.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "pair.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>

using namespace LAMMPS_NS;

namespace {
typedef std::initializer_list<const char *> Names;

/// A style's name without the suffix of an accelerator package.
std::string plain(const std::string &style)
{
  for (const std::string suffix : {"/omp", "/kk", "/kk/host", "/kk/device", "/intel", "/opt"})
    if (style.size() > suffix.size() &&
        style.compare(style.size() - suffix.size(), suffix.size(), suffix) == 0)
      return style.substr(0, style.size() - suffix.size());
  return style;
}

bool is_one_of(const std::string &style, Names names)
{
  const std::string own = plain(style);
  return std::any_of(names.begin(), names.end(), [&own](const char *name) {
    return own == name;
  });
}

// Commands that do not run consecutive steps but exchange or displace positions, so that contacts
// have no history. All other unfit commands minimize and are found by that.
constexpr Names commands_without_history = {
    "dynamical_matrix", "third_order", "prd",        "tad", "hyper",
    "temper",           "temper/grem", "temper/npt", "neb", "neb/spin"};
// Fixes and computes that call the pair style for trial positions.
constexpr Names fixes_calling_forces = {
    "numdiff",           "numdiff/virial", "gcmc",     "widom", "gemc",         "hmc",
    "charge/regulation", "atom/swap",      "mol/swap", "sgcmc", "neighbor/swap"};
constexpr Names computes_calling_forces = {"fep", "fep/ta", "born/matrix"};
}    // namespace

void LAMMPS_NS::require_consistent_units(LAMMPS *lmp, const std::string &who)
{
  if (lmp->force->ftm2v == 1.0) return;
  lmp->error->all(
      FLERR,
      "{}: units {} is not allowed: it must be si, cgs, micro, nano or lj, where force is mass "
      "times acceleration",
      who, lmp->update->unit_style);
}

void LAMMPS_NS::require_force_once_a_step(LAMMPS *lmp, const std::string &who)
{
  constexpr const char *why =
      "contacts have a history, which has to go on by exactly one force call a step";
  const char *command = lmp->input->command;
  if (command && is_one_of(command, commands_without_history))
    lmp->error->all(FLERR, "{} can not be used with {}: {}", who, command, why);
  if (lmp->update->whichflag == 2)
    lmp->error->all(FLERR,
                    "{} can not be used with {}: {}; bring particles to rest with run and fix "
                    "viscous or fix nve/limit",
                    who, command ? command : "minimize", why);
  if (lmp->update->whichflag == 1) {
    const std::string integrator = lmp->update->integrate_style;
    if (integrator == "verlet/split" || !utils::strmatch(integrator, "^verlet"))
      lmp->error->all(FLERR, "{} can not be used with run_style {}: it must be verlet, because {}",
                      who, integrator, why);
  }
  for (const auto *fix : lmp->modify->get_fix_list())
    if (is_one_of(fix->style, fixes_calling_forces))
      lmp->error->all(FLERR, "{} can not be used with fix {} {}, which calls the forces itself: {}",
                      who, fix->id, fix->style, why);
  for (const auto *compute : lmp->modify->get_compute_list())
    if (is_one_of(compute->style, computes_calling_forces))
      lmp->error->all(FLERR,
                      "{} can not be used with compute {} {}, which calls the forces itself: {}",
                      who, compute->id, compute->style, why);
}

void LAMMPS_NS::require_history_communication(LAMMPS *lmp, const std::string &who)
{
  if (lmp->comm->style != Comm::TILED || !lmp->force->newton_pair) return;
  lmp->error->all(FLERR,
                  "{}: comm_style tiled needs newton off: LAMMPS can not send the history of "
                  "contacts back otherwise; say newton off before the box is made",
                  who);
}

std::string LAMMPS_NS::advice_on_rotation(LAMMPS *lmp, double mu)
{
  if (mu <= 0.0) return "";
  for (const auto *fix : lmp->modify->get_fix_list())
    if (is_one_of(fix->style, {"nve", "nve/limit", "nvt", "npt", "nph", "nvt/sllod", "nvk"}))
      return fmt::format("fix {} {} moves particles but never turns them, and friction with "
                         "mu = {:.6g} acts: their angular velocities stay as they are; use fix "
                         "nve/sphere",
                         fix->id, fix->style, mu);
  return "";
}

std::string LAMMPS_NS::advice_on_heat(LAMMPS *lmp)
{
  for (const auto *fix : lmp->modify->get_fix_list())
    if (is_one_of(fix->style, {"heat/flow"}))
      return fmt::format("fix {} {}: contacts of gran/eepa conduct no heat, so that temperatures "
                         "change only by what other fixes bring",
                         fix->id, fix->style);
  return "";
}

std::string LAMMPS_NS::advice_on_device(LAMMPS *lmp)
{
  const Pair *pair = lmp->force->pair_match("^gran/eepa", 0, 1);
  if (!pair || pair->execution_space != Device) return "";
  return "this wall is evaluated on the host, as regions, meshes with keyword faces and style "
         "wall/gran/eepa without suffix kk are: the data of all particles are copied to the host "
         "and back in every step";
}

std::string LAMMPS_NS::advice_on_rerun(LAMMPS *lmp)
{
  const char *command = lmp->input->command;
  if (!command || std::strcmp(command, "rerun") != 0) return "";
  return "rerun takes every contact for a new one: forces are those of loading, without the "
         "hysteresis, friction and rolling resistance of the run";
}
