// SPDX-License-Identifier: GPL-2.0-only

// The two places where PairGranEepa calls the law: the loop over contacts and single().

#include "pair_gran_eepa.h"

#include "contact_status.h"
#include "particle_contact.h"

#include <eepa/dispatch.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_neigh_history.h"
#include "force.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace LAMMPS_NS;
using eepa::Vec3;

namespace {
Eigen::Map<Vec3> vector_at(double *array, int i)
{
  return Eigen::Map<Vec3>(array + 3 * static_cast<std::ptrdiff_t>(i));
}

ParticleArrays particle_arrays(const Atom *atom, const double *mass)
{
  return {atom->x[0], atom->v[0], atom->omega[0], atom->radius, mass};
}
}    // namespace

void PairGranEepa::choose_law()
{
  eepa::with_law(style.settings, rolling, [this](auto law) {
    using ContactLaw = decltype(law);
    loop = &PairGranEepa::contact_loop<ContactLaw, false>;
    accounting_loop = &PairGranEepa::contact_loop<ContactLaw, true>;
    single_law = &PairGranEepa::single_contact<ContactLaw>;
  });
}

void PairGranEepa::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (masses.has_bodies() && neighbor->ago == 0) {
    masses.collect_bodies();
    comm->forward_comm(this);
  }
  (this->*((evflag || keep_ledger) ? accounting_loop : loop))();
}

template <class ContactLaw, bool Accounting> void PairGranEepa::contact_loop()
{
  ledger.elastic = eepa::StoredEnergy();
  const int inum = list->inum;
  if (inum == 0) return;
  const int *ilist = list->ilist;
  const int *numneigh = list->numneigh;
  int **firstneigh = list->firstneigh;
  int **first_status = fix_history->firstflag;
  double **first_history = fix_history->firstvalue;

  const int nlocal = atom->nlocal;
  const bool newton = force->newton_pair;
  const double *special = force->special_lj;
  const int *type = atom->type;
  const ParticleArrays particles = particle_arrays(atom, masses.masses());
  const double *x = particles.x;
  const double *radius = particles.radius;
  double *f = atom->f[0];
  double *torque = atom->torque[0];

  // the set-up call computes forces from the stored state and leaves that as it is
  const bool store = update->setupflag == 0;
  const double time_step = store ? dt : 0.0;
  const bool limit_damping = style.settings.limit_damping;
  constexpr int size = ContactLaw::history_size;
  constexpr bool rolling_spring = ContactLaw::Rolling::has_spring;

  eepa::Contact contact;
  for (int ii = 0; ii < inum; ii++) {
    const int i = ilist[ii];
    const int *neighbors = firstneigh[i];
    const int jnum = numneigh[i];
    int *status = first_status[i];
    const Vec3 x_i = particles.at(x, i);
    const double radius_i = radius[i];

    // find contacts first: most neighbours do not touch, and cost one distance
    if (static_cast<int>(touching.size()) < jnum) touching.resize(jnum);
    int *found = touching.data();
    int count = 0;
    for (int jj = 0; jj < jnum; jj++) {
      const int j = neighbors[jj] & NEIGHMASK;
      const double reach = radius_i + radius[j];
      found[count] = jj;
      if ((x_i - particles.at(x, j)).squaredNorm() < reach * reach)
        count++;
      else if (status[jj]) {
        if constexpr (Accounting)
          if (keep_ledger && store)
            book_opening<ContactLaw>(particles, i, j, first_history[i] + size * jj);
        status[jj] = ContactStatus::none;    // its history is stale from here on
      }
    }
    if (count == 0) continue;

    const eepa::Coefficients *row = &coefficients[pair_index(type[i], 0)];
    Vec3 force_i = Vec3::Zero();
    Vec3 torque_i = Vec3::Zero();
    for (int n = 0; n < count; n++) {
      const int jj = found[n];
      const int j = neighbors[jj] & NEIGHMASK;
      const double factor = special[sbmask(neighbors[jj])];
      if (factor == 0.0) continue;

      const Vec3 offset = x_i - particles.at(x, j);
      const LeverArms arms = gather_contact<ContactLaw::has_rolling>(particles, i, j, offset,
                                                                     offset.squaredNorm(), contact);
      const eepa::Coefficients &c = row[type[j]];
      // the centre of one in the other: nothing that happens from here on has a meaning
      if (contact.overlap > std::min(radius_i, radius[j])) stop_at_overlap(i, j, contact.overlap);

      double *values = first_history[i] + static_cast<std::ptrdiff_t>(size) * jj;
      eepa::History history;
      const bool first = !status[jj];
      if (!first)
        history = eepa::load_history<rolling_spring>(values);
      else if (!store)
        eepa::store_history<rolling_spring>(history, values);    // virgin, not stale
      [[maybe_unused]] eepa::History before;
      if constexpr (Accounting) before = history;
      eepa::Response response = ContactLaw::evaluate(c, limit_damping, contact, time_step, history);
      status[jj] = ContactStatus::of(response.branch, response.sliding);
      if (store) eepa::store_history<rolling_spring>(history, values);

      [[maybe_unused]] eepa::StoredEnergy energy;
      if constexpr (Accounting) {
        if (eflag_either || keep_ledger)
          energy = ContactLaw::stored_energy(c, contact.size, contact.overlap, history);
        if (keep_ledger) {
          const double share = factor * share_of_pair(j);
          ledger.store(energy, share);
          if (store)
            ledger.dissipated.add(eepa::dissipation_of_step<ContactLaw>(
                                      c, contact, response, time_step, first, before, history),
                                  share);
        }
      }

      Vec3 pair_force = ContactLaw::force_on_i(response, contact);
      Vec3 moment = ContactLaw::tangential_moment(response, contact);
      if (factor != 1.0) {
        pair_force *= factor;
        moment *= factor;
        if constexpr (ContactLaw::has_rolling) response.rolling_torque *= factor;
      }
      force_i += pair_force;
      torque_i -= arms.i * moment;
      if constexpr (ContactLaw::has_rolling) torque_i += response.rolling_torque;
      if (newton || j < nlocal) {
        vector_at(f, j) -= pair_force;
        Vec3 torque_j = arms.j * moment;
        if constexpr (ContactLaw::has_rolling) torque_j += response.rolling_torque;
        vector_at(torque, j) -= torque_j;
      }

      if constexpr (Accounting)
        if (evflag)
          ev_tally_xyz(i, j, nlocal, newton, factor * energy.total(), 0.0, pair_force[0],
                       pair_force[1], pair_force[2], offset[0], offset[1], offset[2]);
    }
    vector_at(f, i) += force_i;
    vector_at(torque, i) += torque_i;
  }
}

double PairGranEepa::share_of_pair(int j) const
{
  // without newton both ranks hold a pair that crosses them
  return (force->newton_pair || j < atom->nlocal) ? 1.0 : 0.5;
}

template <class ContactLaw>
void PairGranEepa::book_opening(const ParticleArrays &particles, int i, int j, const double *values)
{
  eepa::Contact contact;
  const Vec3 offset = particles.at(particles.x, i) - particles.at(particles.x, j);
  gather_contact<true>(particles, i, j, offset, offset.squaredNorm(), contact);
  ledger.dissipated.add(eepa::dissipation_of_opening<ContactLaw>(
                            coefficients[pair_index(atom->type[i], atom->type[j])], contact, dt,
                            eepa::load_history<ContactLaw::Rolling::has_spring>(values)),
                        share_of_pair(j));
}

void PairGranEepa::stop_at_overlap(int i, int j, double overlap) const
{
  error->one(
      FLERR,
      "pair_style gran/eepa: atoms {} and {} overlap by {:.6g} at step {}, more than a radius "
      "({:.6g} and {:.6g}): the time step is too large, the stiffness too small or the start "
      "too dense",
      atom->tag[i], atom->tag[j], overlap, update->ntimestep, atom->radius[i], atom->radius[j]);
  std::abort();    // error->one does not return
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

double PairGranEepa::single(int i, int j, int itype, int jtype, double rsq, double /*factor_coul*/,
                            double factor_lj, double &fforce)
{
  fforce = 0.0;
  for (int k = 0; k < single_extra; k++) svector[k] = 0.0;
  const double reach = atom->radius[i] + atom->radius[j];
  if (rsq >= reach * reach || !single_law) return 0.0;

  const ParticleArrays particles = particle_arrays(atom, masses.masses());
  eepa::Contact contact;
  gather_contact<true>(particles, i, j, particles.at(particles.x, i) - particles.at(particles.x, j),
                       rsq, contact);
  eepa::History history;
  const double *values = nullptr;
  double sign = 1.0;
  const int status = find_history(i, j, values, sign);
  if (status) {
    history = history_size() == eepa::SIZE_WITH_ROLLING ? eepa::load_history<true>(values)
                                                        : eepa::load_history<false>(values);
    history.tangential_spring *= sign;
    history.rolling_spring *= sign;
  }
  const double energy =
      (this->*single_law)(coefficients[pair_index(itype, jtype)], contact, history, fforce);
  // what the last step found, where it saw this contact: a second evaluation can not tell the
  // end of the adhesive branch from the start of the line that leaves it
  if (status > ContactStatus::touching) {
    svector[BRANCH] = static_cast<int>(ContactStatus::branch(status));
    svector[SLIP] = (status & ContactStatus::sliding) ? 1.0 : 0.0;
  }
  fforce *= factor_lj / std::sqrt(rsq);
  return factor_lj * energy;
}

template <class ContactLaw>
double PairGranEepa::single_contact(const eepa::Coefficients &c, const eepa::Contact &contact,
                                    eepa::History &history, double &normal_force)
{
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
