// SPDX-License-Identifier: GPL-2.0-only

// The force call of PairGranEepa: contacts are found first and evaluated then.

#include "pair_gran_eepa.h"

#include "compute_gran_eepa_energy_atom.h"
#include "contact_history.h"

#include <eepa/status.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cstdlib>

using namespace LAMMPS_NS;
using eepa::Vec3;

ParticleArrays PairGranEepa::particle_arrays()
{
  return {atom->x[0], atom->v[0], atom->omega[0], atom->radius, masses.masses(), atom->type};
}

void PairGranEepa::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  begin_force_call();
  particles = particle_arrays();
  forces = {atom->f[0], atom->torque[0]};
  in_lanes = !evflag && !keep_ledger && request.advance && !bonds_weaken_contacts();
  work_through_list();
  for (auto &slice : slices) {
    if (slice.deep_i >= 0) stop_at_overlap(slice.deep_i, slice.deep_j);
    if (!keep_ledger) continue;
    ledger.elastic.add(slice.ledger.elastic, 1.0);
    ledger.dissipated.add(slice.ledger.dissipated, 1.0);
  }
  end_force_call();
}

void PairGranEepa::begin_force_call()
{
  // not in setup(), which rerun does not call
  if (classes.empty()) classes.choose(atom->ntypes, parameters, coefficients);
  if (masses.has_bodies() && neighbor->ago == 0) {
    masses.collect_bodies();
    comm->forward_comm(this);
  }
  if (neighbor->ago == 0 && update->setupflag == 0) {
    check_newcomers();
    check_radii();
  }
  request = StepRequest::of_call(update->setupflag == 0, dt, keep_ledger, ledger_starts);
  request.wants_energy |= eflag_either != 0;
  fix_history->force_is_computed();
  keep_atom_losses = request.wants_losses && !ComputeGranEepaEnergyAtom::find(modify).empty();
  if (keep_atom_losses) atom_losses.start(atom->nlocal + atom->nghost);
  ledger.elastic = eepa::StoredEnergy();
}

void PairGranEepa::end_force_call()
{
  if (keep_atom_losses) hand_over_atom_losses();
  if (update->setupflag == 0) ledger_starts = false;
}

void PairGranEepa::hand_over_atom_losses()
{
  for (const auto &slice : slices)
    for (const auto &deferred : slice.deferred_losses)
      atom_losses.add(deferred.atom, deferred.of_contact, deferred.share);
  if (force->newton_pair) comm->reverse_comm(this);
  for (auto *compute : ComputeGranEepaEnergyAtom::find(modify))
    for (int i = 0; i < atom->nlocal; i++) compute->add(i, atom_losses.row(i));
}

bool PairGranEepa::bonds_weaken_contacts() const
{
  const double *special = force->special_lj;
  return atom->molecular != Atom::ATOMIC &&
      (special[1] != 1.0 || special[2] != 1.0 || special[3] != 1.0);
}

void PairGranEepa::work_through_list()
{
  slices.resize(1);
  ContactSlice &slice = slices.front();
  slice.begin = 0;
  slice.end = list->inum;
  slice.first_atom = 0;
  slice.atom_count = force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
  slice.deferrable = 0;
  work_through(slice);
}

/* ---------------------------------------------------------------------- fetching ahead */

// These functions must be inlined: GCC takes a function that only prefetches for one without
// effect, and drops calls of it.

namespace {
EEPA_FUNCTION void prefetch([[maybe_unused]] const void *read)
{
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(read);
#endif
}

EEPA_FUNCTION void prefetch_written([[maybe_unused]] const void *written)
{
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(written, 1);
#endif
}

/// Prefetches the data of partner j that the evaluation of a contact reads and writes. Data of i
/// are in the cache, because particles are taken in turn.
EEPA_FUNCTION void prefetch_partner(std::ptrdiff_t j, const ParticleArrays &p,
                                    const ForceArrays &forces)
{
  prefetch(p.v + 3 * j);
  prefetch(p.omega + 3 * j);
  prefetch(p.mass + j);
  prefetch_written(forces.f + 3 * j);
  prefetch_written(forces.torque + 3 * j);
}

/// Pointers to the rows of the neighbour list and of the histories.
struct NeighborRows {
  const int *ilist, *numneigh;
  int *const *neighbors, *const *status;
  double *const *history;
};

NeighborRows rows_of(const NeighList &list, const ContactHistory &contacts)
{
  return {list.ilist, list.numneigh, list.firstneigh, contacts.firstflag, contacts.firstvalue};
}

/// Prefetches what the search will read, in that order, and all data of a contact with a particle's
/// last neighbour: a neighbour list goes through the box in layers, so that a particle occurs for
/// the first time as a last neighbour.
EEPA_FUNCTION void prefetch_neighbors(const NeighborRows &rows, int place, int end,
                                      const ParticleArrays &p, const ForceArrays &forces)
{
  constexpr int soon = 8, later = 16, much_later = 32;    // particles ahead
  // the pointers to the rows are not in the cache either
  constexpr int pointers_in_line = 8;
  if (place % pointers_in_line == 0 && place + 2 * much_later < end) {
    prefetch(rows.ilist + place + 2 * much_later);
    const int first = rows.ilist[place + much_later];
    prefetch(rows.numneigh + first);
    prefetch(rows.neighbors + first);
    prefetch(rows.status + first);
    prefetch(rows.history + first);
  }
  if (place + later >= end) return;
  const int far = rows.ilist[place + later], near = rows.ilist[place + soon];
  prefetch(rows.neighbors[far]);
  prefetch(rows.status[far]);
  prefetch_written(rows.history[near]);
  if (rows.numneigh[near] == 0) return;
  const std::ptrdiff_t j = rows.neighbors[near][rows.numneigh[near] - 1] & NEIGHMASK;
  prefetch(p.x + 3 * j);
  prefetch(p.radius + j);
  prefetch_partner(j, p, forces);
}
}    // namespace

/* ---------------------------------------------------------------------- finding contacts */

void PairGranEepa::work_through(ContactSlice &slice)
{
  slice.ledger = EnergyLedger();
  slice.atom_losses = keep_atom_losses ? &atom_losses : nullptr;
  slice.deferred_losses.clear();
  slice.deep_i = slice.deep_j = -1;
  const NeighborRows rows = rows_of(*list, *fix_history);
  const ParticleArrays p = particles;
  const ForceArrays f = forces;
  // about 300 bytes a particle: data of fewer particles are in the cache without prefetches
  constexpr int cached_particles = 8192;
  const bool far_from_cache = slice.end - slice.begin > cached_particles;
  const int side_by_side = std::max(1, engine->lanes());

  std::ptrdiff_t count = 0;
  for (int ii = slice.begin; ii < slice.end; ii++) {
    const int i = rows.ilist[ii];
    const int *neighbors = rows.neighbors[i];
    const int jnum = rows.numneigh[i];
    const int *status = rows.status[i];
    const double *x_i = p.x + 3 * static_cast<std::ptrdiff_t>(i);
    const double x_of_i = x_i[0], y_of_i = x_i[1], z_of_i = x_i[2];
    const double radius_i = p.radius[i];
    if (far_from_cache) prefetch_neighbors(rows, ii, slice.end, p, f);

    // most neighbours do not touch: they cost one distance, and the next one overwrites their entry
    if (static_cast<std::ptrdiff_t>(slice.touching.size()) < count + jnum)
      slice.touching.resize(count + jnum + ContactSlice::block);
    TouchingPair *const touching = slice.touching.data(), *next = touching + count;
    for (int jj = 0; jj < jnum; jj++) {
      const std::ptrdiff_t j = neighbors[jj] & NEIGHMASK;
      const double *x_j = p.x + 3 * j;
      const double dx = x_of_i - x_j[0], dy = y_of_i - x_j[1], dz = z_of_i - x_j[2];
      const double reach = radius_i + p.radius[j];
      const bool apart = !(dx * dx + dy * dy + dz * dz < reach * reach);
      const std::size_t touches = !apart;
      *next = {i, jj};
      next += touches;
      // true for a status other than 0 without touch: every status is less than 2^30
      if (status[jj] > static_cast<int>(touches << 30)) open_contact(slice, i, jj);
    }
    count = next - touching;
    if (count >= ContactSlice::block) {
      // contacts that would not fill the lanes wait for the next block
      const std::ptrdiff_t whole = count - count % side_by_side;
      evaluate_block(slice, static_cast<int>(whole));
      std::copy(touching + whole, next, touching);
      count -= whole;
    }
  }
  evaluate_block(slice, static_cast<int>(count));
}

void PairGranEepa::open_contact(ContactSlice &slice, int i, int slot)
{
  const int size = history_size();
  double *values = fix_history->firstvalue[i] + static_cast<std::ptrdiff_t>(size) * slot;
  if (request.wants_losses) book_opening(slice, i, list->firstneigh[i][slot], values);
  fix_history->firstflag[i][slot] = eepa::ContactStatus::none;
  // histories of pairs that do not touch are always 0, so that a new contact needs no test
  std::fill_n(values, size, 0.0);
}

void PairGranEepa::evaluate_block(ContactSlice &slice, int count)
{
  const NeighborRows rows = rows_of(*list, *fix_history);
  const ParticleArrays p = particles;
  const ForceArrays f = forces;
  const std::ptrdiff_t size = history_size();
  TouchingPair *touching = slice.touching.data();
  const auto partner_of = [=](TouchingPair pair) EEPA_LAMBDA {
    return rows.neighbors[pair.i][pair.slot] & NEIGHMASK;
  };
  const auto look_up = [=](TouchingPair pair, int j, FoundContact &contact) EEPA_LAMBDA {
    contact.i = pair.i;
    contact.j = j;
    contact.status = rows.status[pair.i] + pair.slot;
    contact.history = rows.history[pair.i] + size * pair.slot;
    prefetch_written(contact.history);
    prefetch_partner(j, p, f);
  };
  // pairs that can not move each other are no contacts, and their histories stay as they are
  if (masses.holds_some()) {
    const auto is_held = [this, partner_of](TouchingPair pair) {
      return masses.hold_together(pair.i, partner_of(pair));
    };
    count = static_cast<int>(std::remove_if(touching, touching + count, is_held) - touching);
  }
  if (static_cast<int>(slice.contacts.size()) < count) slice.contacts.resize(count);
  FoundContact *found = slice.contacts.data();
  for (int n = 0; n < count; n++) look_up(touching[n], partner_of(touching[n]), found[n]);
  const int done =
      in_lanes ? engine->evaluate_lanes(classes, dt, particles, forces, found, count, slice) : 0;
  for (int n = done; n < count; n++) evaluate_scalar(slice, found[n]);
}

void PairGranEepa::evaluate_scalar(ContactSlice &slice, const FoundContact &found)
{
  const int i = found.i, j = found.j;
  const int slot = static_cast<int>(found.status - fix_history->firstflag[i]);
  const double factor = force->special_lj[sbmask(list->firstneigh[i][slot])];
  if (factor == 0.0) return;

  const eepa::Coefficients &c = coefficients[pair_index(atom->type[i], atom->type[j])];
  const eepa::Contact contact =
      eepa::contact_of(particles.body(i), particles.body(j), request.time_step);
  if (eepa::too_deep(contact.overlap, std::min(particles.radius[i], particles.radius[j])))
    slice.note_too_deep(i, j);
  const bool first = *found.status == eepa::ContactStatus::none;
  const ContactOutcome outcome = engine->evaluate(c, request, contact, first, found.history);
  *found.status = outcome.status;

  if (keep_ledger) {
    const double share = share_of_pair(j);
    slice.ledger.elastic.add(outcome.energy, factor * share);
    if (request.wants_losses) slice.book(i, j, outcome.lost, factor, share);
  }
  const Vec3 pair_force = factor * outcome.wrench.force;
  forces.add(i, pair_force, factor * outcome.wrench.torque_i);
  if (slice.writes(j))
    forces.add(j, -pair_force, factor * outcome.wrench.torque_j);
  else if (slice.defers(j))
    slice.deferred.push_back({j, -pair_force, factor * outcome.wrench.torque_j});
  if (!evflag) return;
  const Vec3 offset = particles.at(particles.x, i) - particles.at(particles.x, j);
  ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, factor * outcome.energy.total(), 0.0,
               pair_force[0], pair_force[1], pair_force[2], offset[0], offset[1], offset[2]);
}

double PairGranEepa::share_of_pair(int j) const
{
  // with newton off both ranks have a pair that crosses their boundary
  return (force->newton_pair || j < atom->nlocal) ? 1.0 : 0.5;
}

void PairGranEepa::book_opening(ContactSlice &slice, int i, int neighbor,
                                const double *history) const
{
  const int j = neighbor & NEIGHMASK;
  const eepa::Contact contact =
      eepa::contact_of(particles.body(i), particles.body(j), request.time_step);
  const eepa::Coefficients &c = coefficients[pair_index(atom->type[i], atom->type[j])];
  slice.book(i, j, engine->open(c, request, contact, history), force->special_lj[sbmask(neighbor)],
             share_of_pair(j));
}

void PairGranEepa::stop_at_overlap(int i, int j) const
{
  const double overlap = eepa::overlap_of_spheres(Vec3(atom->x[i]), atom->radius[i],
                                                  Vec3(atom->x[j]), atom->radius[j]);
  error->one(
      FLERR,
      "pair_style gran/eepa: atoms {} and {} overlap by {:.6g} at step {}, more than a radius "
      "({:.6g} and {:.6g}): the time step is too large, the stiffness too small or the start "
      "too dense; particles of a clump belong into fix rigid, those of a floor into fix freeze, or "
      "their pairs are left out with neigh_modify exclude",
      atom->tag[i], atom->tag[j], overlap, update->ntimestep, atom->radius[i], atom->radius[j]);
  std::abort();    // error->one does not return
}
