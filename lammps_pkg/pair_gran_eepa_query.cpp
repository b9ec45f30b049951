// SPDX-License-Identifier: GPL-2.0-only

// Queries of PairGranEepa's contacts: single(), the census.

#include "pair_gran_eepa.h"

#include "contact_history.h"

#include <eepa/status.h>

#include "atom.h"
#include "error.h"
#include "force.h"
#include "neigh_list.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;
using eepa::Vec3;

int PairGranEepa::find_history(int i, int j, const double *&values, double &sign) const
{
  const int size = history_size();
  // the list has the pair with one of its particles; for the other one the springs change sign
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
  return eepa::ContactStatus::none;
}

void PairGranEepa::require_their_distance(int i, int j, double rsq) const
{
  const int known = atom->nlocal + atom->nghost;
  const double there = std::max(i, j) < known ? (Vec3(atom->x[i]) - Vec3(atom->x[j])).squaredNorm()
                                              : std::numeric_limits<double>::infinity();
  if (std::fabs(rsq - there) <= 1e-9 * there) return;
  error->one(
      FLERR,
      "pair_style gran/eepa: the force of a contact depends on its history and exists only "
      "for particles where they are, not for any distance ({:.6g} was asked for); pair_write, "
      "fix widom and fix gcmc can not be used",
      std::sqrt(rsq));
}

double PairGranEepa::single(int i, int j, int itype, int jtype, double rsq, double /*factor_coul*/,
                            double factor_lj, double &fforce)
{
  bring_to_host(HostData::CONTACTS);
  require_their_distance(i, j, rsq);
  fforce = 0.0;
  for (int k = 0; k < single_extra; k++) svector[k] = 0.0;
  const double reach = atom->radius[i] + atom->radius[j];
  if (rsq >= reach * reach || !engine) return 0.0;
  if (masses.holds_some() && masses.hold_together(i, j)) return 0.0;

  const eepa::Contact contact = eepa::contact_of(lone_body(i), lone_body(j), 0.0);
  const double *history = nullptr;
  double sign = 1.0;
  const int status = find_history(i, j, history, sign);
  const ContactReport report = engine->report(coefficients[pair_index(itype, jtype)], contact,
                                              status ? history : nullptr, sign);
  set_quantities(contact, report);
  // branch and slip are those of the last step, if it saw this contact: a second evaluation can not
  // distinguish the end of the adhesive branch from the start of the reloading line
  if (status > eepa::ContactStatus::touching) {
    svector[BRANCH] = static_cast<int>(eepa::ContactStatus::branch(status));
    svector[SLIP] = eepa::ContactStatus::slides(status) ? 1.0 : 0.0;
  }
  // special_bonds weakens all forces, torques and energies of a contact
  for (int k = 0; k < N_SINGLE; k++)
    if (k < BRANCH || k > SLIP) svector[k] *= factor_lj;
  fforce = report.response.normal_force * (factor_lj / std::sqrt(rsq));
  return factor_lj * report.energy.total();
}

/// One particle with its mass. compute() gets the masses of all particles at once, which would be
/// too slow here: compute pair/local asks for every pair.
eepa::Body<double> PairGranEepa::lone_body(int i) const
{
  return {Vec3(atom->x[i]), Vec3(atom->v[i]), Vec3(atom->omega[i]), atom->radius[i],
          masses.mass(i)};
}

void PairGranEepa::set_quantities(const eepa::Contact &contact, const ContactReport &report)
{
  const eepa::Response &response = report.response;
  svector[BRANCH] = static_cast<int>(response.branch);
  svector[OVERLAP] = contact.overlap;
  svector[MAX_OVERLAP] = report.max_overlap;
  svector[PLASTIC_OVERLAP] = report.plastic_overlap;
  svector[SLIP] = response.sliding ? 1.0 : 0.0;
  svector[TANGENTIAL] = response.tangential_force.norm();
  svector[HYSTERETIC] = response.hysteretic_force;
  svector[FRICTION_BOUND] = response.friction_bound;
  svector[ENERGY_NORMAL] = report.energy.normal;
  svector[ENERGY_TANGENTIAL] = report.energy.tangential;
  svector[ENERGY_ROLLING] = report.energy.rolling;
  for (int k = 0; k < 3; k++) {
    svector[TANGENTIAL_X + k] = response.tangential_force[k];
    svector[ROLLING_TORQUE_X + k] = response.rolling_torque[k];
  }
  svector[TWISTING_TORQUE] = response.twisting_torque;
  svector[ENERGY_TWISTING] = report.energy.twisting;
}

ContactCensus PairGranEepa::census(int groupbit)
{
  bring_to_host(HostData::CONTACTS);
  // all sums in one array for a single reduction: see the assignments below
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
      const double ratio = eepa::overlap_of_spheres(Vec3(atom->x[i]), atom->radius[i],
                                                    Vec3(atom->x[j]), atom->radius[j]) /
          eepa::size_of_pair(atom->radius[i], atom->radius[j]);
      const eepa::Branch branch = eepa::ContactStatus::branch(status);
      sum[0] += share;
      if (branch == eepa::Branch::loading) sum[1] += share;
      if (branch == eepa::Branch::unloading) sum[2] += share;
      if (branch == eepa::Branch::adhesive) sum[3] += share;
      if (eepa::ContactStatus::slides(status)) sum[4] += share;
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
