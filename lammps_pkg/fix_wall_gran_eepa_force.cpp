// SPDX-License-Identifier: GPL-2.0-only

// The force call of FixWallGranEepa.

#include "fix_wall_gran_eepa.h"

#include "compute_gran_eepa_energy_atom.h"

#include <eepa/status.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using eepa::Vec3;

void FixWallGranEepa::setup(int vflag)
{
  // variables may read the position of the wall
  place_surfaces();
  evaluate_motion();
  if (masses.has_bodies()) masses.collect_bodies();
  platen_warned = false;    // its own bound is checked where its contacts are known
  time_step_warned = false;
  check_time_step();
  post_force(vflag);
  needs_setup = false;
}

void FixWallGranEepa::post_force(int /*vflag*/)
{
  if (masses.has_bodies() && neighbor->ago == 0) masses.collect_bodies();
  if (neighbor->ago == 0 && update->setupflag == 0 && atom->natoms > checked_particles)
    check_time_step();
  place_surfaces();
  if (update->setupflag || neighbor->ago == 0 || !motion_is_bounded() ||
      !(surfaces.moved_since(collected_at) <= travel_left))
    collect_candidates();
  surface_sums = {};
  output_is_summed = false;
  ledger.elastic = eepa::StoredEnergy();
  const double power_before = power;
  power = 0.0;
  atom_losses.clear();
  if (keep_ledger) atom_losses = ComputeGranEepaEnergyAtom::find(modify);
  const bool step = update->setupflag == 0;
  request = StepRequest::of_call(step, dt, keep_ledger, ledger_starts);
  for (const int i : candidates) meet(i);
  after_setup = !step;
  if (step) ledger_starts = false;
  if (loaded()) {
    const int dim = surfaces.axis();
    const double platen_force_before = platen_force;
    platen_force = -surface_sums[0].force[dim];
    // a platen's velocity may change within a step, so force times displacement is the work
    const double platen_shear_power_before = platen_shear_power;
    platen_shear_power =
        motion_args.slides ? -surface_sums[0].force[motion_args.shear_axis] * sliding : 0.0;
    if (keep_ledger && step) {
      ledger.wall_work += 0.5 * (platen_force_before + platen_force) * platen.travel();
      ledger.wall_work += 0.5 * (platen_shear_power_before + platen_shear_power) * dt;
    }
    // MPI gives every rank the same bits, so that all ranks move the platen alike
    sum_forces();
    load_now = evaluate_load();
    if (!step) platen.set_forces(load_now, output_vector[FORCE_X + dim]);
    check_platen();
  } else if (keep_ledger && step) {
    ledger.wall_work += 0.5 * (power_before + power) * dt;
  }
}

/// Whether no atom moves by more than half the skin between two neighbour lists. LAMMPS ensures
/// this only if it checks all atoms, or makes a new list, in every step.
bool FixWallGranEepa::motion_is_bounded() const
{
  return neighbor->every == 1 && neighbor->delay <= 1 && !neighbor->build_once &&
      !neighbor->includegroup && !radii_may_change;
}

/// Collects the atoms that can touch a surface before the next collection, of any group, because
/// groups may change. Where their motion is not bounded, collects those that touch at present.
void FixWallGranEepa::collect_candidates()
{
  double margin = 0.0;
  travel_left = 0.0;
  if (motion_is_bounded()) {
    // Surfaces may move by half the skin. Atoms may move by half the skin from their positions in a
    // new neighbour list; in an older list they may have done so already, the other way. Some
    // rounding is added.
    travel_left = 0.5 * neighbor->skin;
    margin = (1.0 + 1e-6) * (travel_left + (neighbor->ago == 0 ? 0.5 : 1.0) * neighbor->skin);
  }
  collected_at = surfaces;
  candidates.clear();
  const int n_surfaces = surfaces.count();
  for (int i = 0; i < atom->nlocal; i++) {
    bool known = false;
    for (int surface = 0; surface < n_surfaces; surface++)
      known |= history_of(i, surface)[eepa::MAX_OVERLAP] != 0.0;
    if (known || surfaces.near(atom->x[i], atom->radius[i] + margin)) candidates.push_back(i);
  }
  if (contact_table && atom->nlocal > 0)
    std::fill_n(array_atom[0], static_cast<std::size_t>(atom->nlocal) * N_ATOM, 0.0);
}

double *FixWallGranEepa::history_of(int i, int surface) const
{
  return history[i] + static_cast<std::ptrdiff_t>(surface) * history_size;
}

void FixWallGranEepa::meet(int i)
{
  if (contact_table) std::fill_n(array_atom[i], static_cast<int>(N_ATOM), 0.0);
  // a particle that leaves the group in contact must not find its old history when it comes back
  const bool member = atom->mask[i] & groupbit;
  if (!member && !keep_ledger) {
    std::fill_n(history[i], n_values, 0.0);
    return;
  }
  for (int surface = 0; surface < surfaces.count(); surface++) meet(i, surface, member);
}

void FixWallGranEepa::meet(int i, int surface, bool member)
{
  const double *x = atom->x[i];
  const double radius = atom->radius[i];
  double *values = history_of(i, surface);
  const bool known = values[eepa::MAX_OVERLAP] != 0.0;
  if (!known && !surfaces.on_side(surface, x)) return;
  // a set-up leaves no history, so whether the particle touched then is found from its motion
  const bool unknown_is_new = !(keep_ledger && after_setup && request.advance);
  if (!known && (!member || (unknown_is_new && !surfaces.reaches(surface, x, radius)))) return;

  const eepa::Body<double> body = {Vec3(x), Vec3(atom->v[i]), Vec3(atom->omega[i]), radius,
                                   masses.mass(i)};
  const eepa::WallPoint<double> point = surfaces.nearest(surface, body);
  if (point.overlap <= 0.0 && !known && unknown_is_new) return;
  const eepa::Contact contact = eepa::contact_at_wall(body, point, request.time_step);
  const bool touched = known ||
      (!unknown_is_new && point.overlap + contact.velocity.dot(contact.normal) * dt > 0.0);
  if (point.overlap <= 0.0 || !member) {
    if (keep_ledger && touched && (request.advance || !member))
      book(i, engine->open(coefficients, request, contact, values));
    std::fill_n(values, history_size, 0.0);
    return;
  }
  if (eepa::too_deep(point.overlap, radius)) stop_at_overlap(i, surface, point.overlap);

  const ContactOutcome outcome = engine->evaluate(coefficients, request, contact, !touched, values);
  const eepa::Wrench<double> &wrench = outcome.wrench;
  if (keep_ledger) {
    power += wrench.force.dot(point.velocity);
    ledger.store(outcome.energy, 1.0);
    if (request.wants_losses) book(i, outcome.lost);
  }
  for (int k = 0; k < 3; k++) {
    atom->f[i][k] += wrench.force[k];
    atom->torque[i][k] += wrench.torque_i[k];
    surface_sums[surface].force[k] -= wrench.force[k];
  }
  surface_sums[surface].contacts += 1.0;
  if (contact_table) tabulate(i, body, point, outcome);
}

void FixWallGranEepa::tabulate(int i, const eepa::Body<double> &body,
                               const eepa::WallPoint<double> &point, const ContactOutcome &outcome)
{
  double *row = array_atom[i];
  row[ATOM_CONTACTS] += 1.0;
  for (int k = 0; k < 3; k++) row[ATOM_FORCE_X + k] += outcome.wrench.force[k];
  if (point.overlap <= row[ATOM_OVERLAP]) return;
  const double reach = body.radius - point.overlap;
  for (int k = 0; k < 3; k++) row[ATOM_POINT_X + k] = body.x[k] - reach * point.normal[k];
  row[ATOM_OVERLAP] = point.overlap;
  row[ATOM_MAX_OVERLAP] = outcome.max_overlap;
  row[ATOM_BRANCH] = static_cast<int>(eepa::ContactStatus::branch(outcome.status));
  row[ATOM_SLIP] = eepa::ContactStatus::slides(outcome.status) ? 1.0 : 0.0;
}

void FixWallGranEepa::book(int i, const eepa::Dissipation &lost)
{
  ledger.dissipated.add(lost, 1.0);
  for (auto *compute : atom_losses) compute->add(i, AtomLosses::by_kind(lost).data());
}

void FixWallGranEepa::stop_at_overlap(int i, int surface, double overlap) const
{
  std::string where;
  if (surfaces.is_plane())
    where = fmt::format("or it was put behind the plane: {} {} at {:.6g} bounds a half space",
                        surfaces.kind_name(), surfaces.is_lower(surface) ? "lo" : "hi",
                        (surfaces.is_lower(surface) ? surfaces.lo : surfaces.hi) +
                            surfaces.displacement[surfaces.axis()]);
  else
    where =
        fmt::format("its center is through the cylinder of radius {:.6g}, which it touched from {}",
                    surfaces.radius, surface == 0 ? "inside" : "outside");
  error->one(
      FLERR,
      "fix {} wall/gran/eepa: atom {} overlaps the wall by {:.6g} at step {}, more than its "
      "radius {:.6g}: the time step is too large, the stiffness too small or the wall too fast; {}",
      id, atom->tag[i], overlap, update->ntimestep, atom->radius[i], where);
}

/// Sums the forces and contacts of all ranks. Collective.
void FixWallGranEepa::sum_forces()
{
  double mine[8], all[8];
  for (int s = 0; s < 2; s++) {
    std::copy_n(surface_sums[s].force, 3, mine + 4 * s);
    mine[4 * s + 3] = surface_sums[s].contacts;
  }
  MPI_Allreduce(mine, all, 8, MPI_DOUBLE, MPI_SUM, world);
  if (!surfaces.is_plane()) {
    // the two sides of a cylinder are one surface to a user
    for (int k = 0; k < 4; k++) {
      all[k] += all[4 + k];
      all[4 + k] = 0.0;
    }
  }
  for (int k = 0; k < 3; k++) {
    output_vector[FIRST_FORCE_X + k] = all[k];
    output_vector[SECOND_FORCE_X + k] = all[4 + k];
    output_vector[FORCE_X + k] = all[k] + all[4 + k];
  }
  output_vector[CONTACTS] = all[3] + all[7];
  output_is_summed = true;
}

double FixWallGranEepa::compute_vector(int n)
{
  if (!output_is_summed) sum_forces();
  output_vector[POSITION] = loaded() ? platen.position : surfaces.position();
  output_vector[VELOCITY] = loaded() ? platen.velocity : surfaces.normal_velocity();
  output_vector[LOAD_FORCE] = loaded() ? load_now : 0.0;
  output_vector[LOAD_KINETIC_ENERGY] = loaded() ? platen.kinetic_energy() : 0.0;
  output_vector[LOAD_WORK] = platen.work;
  output_vector[LOAD_DISSIPATED] = platen.dissipated;
  return output_vector[n];
}
