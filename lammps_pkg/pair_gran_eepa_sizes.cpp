// SPDX-License-Identifier: GPL-2.0-only

// Sizes of particles in PairGranEepa: the reach of neighbour lists and the bound on the time step.

#include "pair_gran_eepa.h"

#include "contact_history.h"

#include <eepa/time_step.h>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;

namespace {
constexpr const char *style_name = "pair_style gran/eepa";
constexpr double never = std::numeric_limits<double>::infinity();
}    // namespace

/* ---------------------------------------------------------------------- radii */

void PairGranEepa::init_radii()
{
  const int n = atom->ntypes;
  std::vector<double> dynamic(n + 1, 0.5 * style.largest_diameter), frozen(n + 1, 0.0);
  dynamic[0] = 0.0;    // types count from 1
  // particles that fix pour and fix deposit will insert
  particles_come = false;
  for (const char *inserting : {"^pour", "^deposit"}) {
    for (auto *fix : modify->get_fix_by_style(inserting)) {
      particles_come = true;
      for (int itype = 1; itype <= n; itype++) {
        int dim = itype;
        const auto *radius = static_cast<double *>(fix->extract("radius", dim));
        if (radius) dynamic[itype] = std::max(dynamic[itype], *radius);
      }
    }
  }
  for (int i = 0; i < atom->nlocal; i++) {
    std::vector<double> &radii = (atom->mask[i] & masses.freeze_groupbit()) ? frozen : dynamic;
    radii[atom->type[i]] = std::max(radii[atom->type[i]], atom->radius[i]);
  }
  max_radius_dynamic.assign(n + 1, 0.0);
  max_radius_frozen.assign(n + 1, 0.0);
  MPI_Allreduce(dynamic.data(), max_radius_dynamic.data(), n + 1, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(frozen.data(), max_radius_frozen.data(), n + 1, MPI_DOUBLE, MPI_MAX, world);
  warn_of_narrow_box();
}

void PairGranEepa::warn_of_narrow_box()
{
  if (narrow_box_warned) return;
  double largest = 0.0;
  for (int type = 1; type <= atom->ntypes; type++)
    largest = std::max(largest, 2.0 * largest_partner(type));
  const int periodic[] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  for (int dim = 0; dim < domain->dimension; dim++) {
    if (!periodic[dim] || domain->prd[dim] >= 2.0 * largest) continue;
    narrow_box_warned = true;
    if (comm->me == 0)
      error->warning(FLERR,
                     "{}: the box is {} wide along {}, less than two of the largest diameters, {}: "
                     "LAMMPS keeps one history for two particles that touch through two images",
                     style_name, domain->prd[dim], "xyz"[dim], largest);
    return;
  }
}

/// Largest radius of a type at the start of the run, particles still to be inserted included.
double PairGranEepa::largest_partner(int type) const
{
  return std::max(max_radius_dynamic[type], max_radius_frozen[type]);
}

/// Largest radius that a particle of a type may have in this run, rounding apart.
double PairGranEepa::allowed_radius(int type) const
{
  return largest_partner(type) * (1.0 + 1e-9);
}

/// Stops where a radius exceeds the largest at the start of the run, which sets the reach of
/// neighbour lists.
void PairGranEepa::check_radii()
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom->radius[i] <= allowed_radius(atom->type[i])) continue;
    error->one(FLERR,
               "{}: atom {} of type {} has grown to a diameter of {:.6g} at step {}, and the "
               "neighbor lists of this run were made for at most {:.6g}: contacts would be missed; "
               "add `largest d` to pair_style, with d the largest diameter in the run",
               style_name, atom->tag[i], atom->type[i], 2.0 * atom->radius[i], update->ntimestep,
               2.0 * largest_partner(atom->type[i]));
  }
}

/* ---------------------------------------------------------------------- time step */

TimeStepBound PairGranEepa::largest_time_step(const std::vector<AnnouncedParticles> &announced)
{
  bring_to_host(HostData::SIZES);
  const int n = atom->ntypes;
  std::vector<double> partner(n + 1, 0.0);
  for (int type = 1; type <= n; type++) partner[type] = largest_partner(type);
  for (const AnnouncedParticles &come : announced)
    partner[come.type] = std::max(partner[come.type], 0.5 * come.largest);

  // the lightest particle need not have the stiffest contact, so each is paired with the largest
  // partner of every type
  std::vector<double> mine((n + 1) * (n + 1), never), all((n + 1) * (n + 1), never);
  const auto meet_all = [&](int itype, double radius, double mass) {
    for (int jtype = 1; jtype <= n; jtype++) {
      if (partner[jtype] == 0.0) continue;
      const double stiffness =
          eepa::largest_stiffness(coefficients[pair_index(itype, jtype)], radius + partner[jtype]);
      double &least = mine[pair_index(std::min(itype, jtype), std::max(itype, jtype))];
      least = std::min(least, eepa::largest_time_step(mass, stiffness));
    }
  };
  const double *mass = masses.masses();
  for (int i = 0; i < atom->nlocal; i++)
    if (!std::isinf(mass[i])) meet_all(atom->type[i], atom->radius[i], mass[i]);
  for (const AnnouncedParticles &come : announced)
    meet_all(come.type, 0.5 * come.smallest, eepa::sphere_mass(come.smallest, come.density));
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_MIN, world);

  TimeStepBound bound = {never, "no contact"};
  for (int i = 1; i <= n; i++) {
    for (int j = i; j <= n; j++) {
      if (all[pair_index(i, j)] >= bound.time_step) continue;
      bound.time_step = all[pair_index(i, j)];
      bound.origin = fmt::format("the pair of types {} {}", i, j);
    }
  }
  return bound;
}

void PairGranEepa::check_time_step()
{
  time_step_warned = false;
  checked_particles = atom->natoms;
  if (style.time_step_check == eepa::TimeStepCheck::off) return;
  const TimeStepBound bound = largest_time_step();
  if (update->dt <= bound.time_step) return;
  time_step_warned = true;
  const auto message = fmt::format(
      "{}: timestep {:.6g} is larger than {:.6g} = 0.2 sqrt(m_min/k_max), which {} sets",
      style_name, update->dt, bound.time_step, bound.origin);
  if (style.time_step_check == eepa::TimeStepCheck::error)
    error->all(FLERR, message);
  else if (comm->me == 0)
    error->warning(FLERR, message);
}

/// Checks the time step for particles that were inserted after it was checked. Their largest
/// partners were known then, because fixes that insert particles announce their radii. Collective.
void PairGranEepa::check_newcomers()
{
  if (style.time_step_check == eepa::TimeStepCheck::off || time_step_warned) return;
  // no communication where no particles are inserted
  if (!particles_come && atom->natoms == checked_particles) return;
  checked_particles = atom->natoms;
  double bound = never;
  int worst = -1;
  for (const int i : fix_history->newcomers()) {
    const double mass = masses.mass(i);
    if (std::isinf(mass)) continue;
    const int itype = atom->type[i];
    for (int jtype = 1; jtype <= atom->ntypes; jtype++) {
      const double partner =
          std::max(largest_partner(jtype), jtype == itype ? atom->radius[i] : 0.0);
      if (partner == 0.0) continue;
      const double own =
          eepa::largest_time_step(mass,
                                  eepa::largest_stiffness(coefficients[pair_index(itype, jtype)],
                                                          atom->radius[i] + partner));
      if (own >= bound) continue;
      bound = own;
      worst = i;
    }
  }
  // the rank with the smallest bound warns
  struct {
    double bound;
    int rank;
  } mine = {bound, comm->me}, least;
  MPI_Allreduce(&mine, &least, 1, MPI_DOUBLE_INT, MPI_MINLOC, world);
  if (update->dt <= least.bound) return;
  time_step_warned = true;
  if (comm->me != least.rank) return;
  const auto message =
      fmt::format("{}: timestep {:.6g} is larger than {:.6g} = 0.2 sqrt(m_min/k_max), which atom "
                  "{} of type {} and diameter {:.6g} sets, inserted by step {}",
                  style_name, update->dt, bound, atom->tag[worst], atom->type[worst],
                  2.0 * atom->radius[worst], update->ntimestep);
  if (style.time_step_check == eepa::TimeStepCheck::error) error->one(FLERR, message);
  error->warning(FLERR, message);
}
