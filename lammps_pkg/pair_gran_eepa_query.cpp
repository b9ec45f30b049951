// SPDX-License-Identifier: GPL-2.0-only

// What PairGranEepa tells of its contacts: single(), the census.

#include "pair_gran_eepa.h"

#include "contact_history.h"
#include "contact_status.h"
#include "particle_contact.h"

#include <eepa/dispatch.h>

#include "atom.h"
#include "error.h"
#include "force.h"
#include "neigh_list.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;
using eepa::Vec3;

void PairGranEepa::choose_single()
{
  eepa::with_law(style.settings, rolling, twisting, [this](auto law) {
    single_law = &PairGranEepa::single_contact<decltype(law)>;
  });
}

int PairGranEepa::find_history(int i, int j, const double *&values, double &sign) const
{
  const int size = history_size();
  // the pair stands with either partner; seen from the other one the springs change sign
  for (int turn = 0; turn < 2; turn++) {
    const int owner = turn ? j : i;
    const int partner = turn ? i : j;
    if (owner >= atom->nlocal) continue;
    for (int jj = 0; jj < list->numneigh[owner]; jj++) {
      if ((list->firstneigh[owner][jj] & NEIGHMASK) != partner) continue;
      values = fix_history->firstvalue[owner] + static_cast<std::ptrdiff_t>(size) * jj;
      sign = turn ? -1.0 : 1.0;
      return fix_history->firstflag[owner][jj];
    }
  }
  return ContactStatus::none;
}

void PairGranEepa::require_their_distance(int i, int j, double rsq) const
{
  const int known = atom->nlocal + atom->nghost;
  const double there = std::max(i, j) < known
      ? (Vec3(atom->x[i]) - Vec3(atom->x[j])).squaredNorm()
      : std::numeric_limits<double>::infinity();
  if (std::fabs(rsq - there) <= 1e-9 * there) return;
  error->one(FLERR,
             "pair_style gran/eepa: the force of a contact depends on its history and exists only "
             "for particles where they are, not for any distance ({:.6g} was asked for); pair_write, "
             "fix widom and fix gcmc can not be used",
             std::sqrt(rsq));
}

double PairGranEepa::single(int i, int j, int itype, int jtype, double rsq, double /*factor_coul*/,
                            double factor_lj, double &fforce)
{
  require_their_distance(i, j, rsq);
  fforce = 0.0;
  for (int k = 0; k < single_extra; k++) svector[k] = 0.0;
  const double reach = atom->radius[i] + atom->radius[j];
  if (rsq >= reach * reach || !single_law) return 0.0;
  if (masses.holds_some() && masses.hold_together(i, j)) return 0.0;

  // the masses of these two alone: compute pair/local asks for every pair
  const ParticleArrays particles = {atom->x[0], atom->v[0], atom->omega[0], atom->radius,
                                    atom->rmass};
  eepa::Contact contact;
  gather_contact<true>(particles, i, j, particles.at(particles.x, i) - particles.at(particles.x, j),
                       rsq, 0.0, contact);
  contact.effective_mass = eepa::effective_mass(masses.mass(i), masses.mass(j));
  const double *values = nullptr;
  double sign = 1.0;
  const int status = find_history(i, j, values, sign);
  const double energy = (this->*single_law)(coefficients[pair_index(itype, jtype)], contact,
                                            status ? values : nullptr, sign, fforce);
  // what the last step found, where it saw this contact: a second evaluation can not tell the
  // end of the adhesive branch from the start of the line that leaves it
  if (status > ContactStatus::touching) {
    svector[BRANCH] = static_cast<int>(ContactStatus::branch(status));
    svector[SLIP] = (status & ContactStatus::sliding) ? 1.0 : 0.0;
  }
  // as special_bonds weakens a contact, all its forces, torques and energies
  for (int k = 0; k < N_SINGLE; k++)
    if (k < BRANCH || k > SLIP) svector[k] *= factor_lj;
  fforce *= factor_lj / std::sqrt(rsq);
  return factor_lj * energy;
}

template <class ContactLaw>
double PairGranEepa::single_contact(const eepa::Coefficients &c, const eepa::Contact &contact,
                                    const double *values, double sign, double &normal_force)
{
  eepa::History history;
  if (values) {
    history = eepa::load_history<typename ContactLaw::Layout>(values);
    // a twist has the same sign for both
    history.tangential_spring *= sign;
    history.rolling_spring *= sign;
  }
  // the energies are those of the springs as the last step left them: an evaluation with the
  // velocities of the end of the step could let a sliding contact slip once more
  const eepa::History stored = history;
  const eepa::Response evaluated =
      ContactLaw::evaluate(c, style.settings.limit_damping, contact, 0.0, history);
  const eepa::StoredEnergy energy = ContactLaw::stored_energy(
      c, contact.size, contact.overlap, stored.max_overlap > 0.0 ? stored : history);
  normal_force = evaluated.normal_force;
  svector[BRANCH] = static_cast<int>(evaluated.branch);
  svector[OVERLAP] = contact.overlap;
  svector[MAX_OVERLAP] = history.max_overlap;
  svector[PLASTIC_OVERLAP] = ContactLaw::Normal::plastic_overlap(c, history.max_overlap);
  svector[SLIP] = evaluated.sliding ? 1.0 : 0.0;
  for (int k = 0; k < 3; k++) svector[TANGENTIAL_X + k] = evaluated.tangential_force[k];
  svector[TANGENTIAL] = evaluated.tangential_force.norm();
  svector[HYSTERETIC] = evaluated.hysteretic_force;
  svector[FRICTION_BOUND] = evaluated.friction_bound;
  svector[ENERGY_NORMAL] = energy.normal;
  svector[ENERGY_TANGENTIAL] = energy.tangential;
  svector[ENERGY_ROLLING] = energy.rolling;
  if constexpr (ContactLaw::has_rolling)
    for (int k = 0; k < 3; k++) svector[ROLLING_TORQUE_X + k] = evaluated.rolling_torque[k];
  if constexpr (ContactLaw::has_twisting) svector[TWISTING_TORQUE] = evaluated.twisting_torque;
  svector[ENERGY_TWISTING] = energy.twisting;
  return energy.total();
}

ContactCensus PairGranEepa::census(int groupbit)
{
  // sums in one array so that one reduction serves: see the assignments below
  double sum[7] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  double largest = 0.0;
  for (int ii = 0; list && ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int status = fix_history->firstflag[i][jj];
      if (!status) continue;
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      const int ends = ((atom->mask[i] & groupbit) ? 1 : 0) + ((atom->mask[j] & groupbit) ? 1 : 0);
      if (ends == 0) continue;
      const double share = share_of_pair(j);
      const double reach = atom->radius[i] + atom->radius[j];
      const Vec3 offset = Vec3(atom->x[i]) - Vec3(atom->x[j]);
      const double ratio = (reach - offset.norm()) / reach;
      const eepa::Branch branch = ContactStatus::branch(status);
      sum[0] += share;
      if (branch == eepa::Branch::loading) sum[1] += share;
      if (branch == eepa::Branch::unloading) sum[2] += share;
      if (branch == eepa::Branch::adhesive) sum[3] += share;
      if (status & ContactStatus::sliding) sum[4] += share;
      sum[5] += share * ends;
      sum[6] += share * ratio;
      largest = std::max(largest, ratio);
    }
  }
  double all[7], all_largest;
  MPI_Allreduce(sum, all, 7, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&largest, &all_largest, 1, MPI_DOUBLE, MPI_MAX, world);
  ContactCensus census;
  census.contacts = all[0];
  census.loading = all[1];
  census.unloading = all[2];
  census.adhesive = all[3];
  census.sliding = all[4];
  census.ends = all[5];
  census.mean_overlap_ratio = all[0] > 0.0 ? all[6] / all[0] : 0.0;
  census.max_overlap_ratio = all_largest;
  return census;
}
