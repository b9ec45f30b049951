// SPDX-License-Identifier: GPL-2.0-only

// Where FixWallGranEepa calls the law.

#include "fix_wall_gran_eepa.h"

#include "compute_gran_eepa_energy_atom.h"

#include <eepa/dispatch.h>

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
  // variables may ask where the wall is
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
  if (!loop)
    eepa::with_law(style.settings, parameters, [this](auto law) {
      loop = &FixWallGranEepa::contact_loop<decltype(law)>;
    });
  if (masses.has_bodies() && neighbor->ago == 0) masses.collect_bodies();
  if (neighbor->ago == 0 && update->setupflag == 0 && atom->natoms > checked_particles)
    check_time_step();
  place_surfaces();
  if (update->setupflag || neighbor->ago == 0 || !motion_is_bounded() ||
      !(surfaces.moved_since(collected_at) <= way_left))
    collect_candidates();
  felt = {};
  felt_summed = false;
  ledger.elastic = eepa::StoredEnergy();
  const double power_before = power;
  power = 0.0;
  atom_losses.clear();
  if (keep_ledger) atom_losses = ComputeGranEepaEnergyAtom::find(modify);
  (this->*loop)();
  const bool step = update->setupflag == 0;
  after_setup = !step;
  if (step) ledger_starts = false;
  if (loaded()) {
    const int dim = surfaces.axis();
    const double push_before = push;
    push = -felt[0].force[dim];
    // a platen's velocity may change within a step: force times way is what Verlet integrates
    const double drag_before = drag;
    drag = told.slides ? -felt[0].force[told.shear_axis] * sliding : 0.0;
    if (keep_ledger && step) {
      ledger.wall_work += 0.5 * (push_before + push) * platen.travel();
      ledger.wall_work += 0.5 * (drag_before + drag) * dt;
    }
    // MPI gives every rank the same bits, so that all move the same platen
    sum_forces();
    load_now = evaluate_load();
    if (!step) platen.set_forces(load_now, felt_vector[FORCE_X + dim]);
    check_platen();
  } else if (keep_ledger && step) {
    ledger.wall_work += 0.5 * (power_before + power) * dt;
  }
}

/// Whether no atom moves by more than half the skin between two neighbour lists. LAMMPS promises that
/// only where it looks at all of them, or makes a new list, in every step.
bool FixWallGranEepa::motion_is_bounded() const
{
  return neighbor->every == 1 && neighbor->delay <= 1 && !neighbor->build_once &&
      !neighbor->includegroup && !radii_may_change;
}

/// Which atoms can touch a surface, whatever their group, which may change. Where nothing bounds
/// their motion: which do so now.
void FixWallGranEepa::collect_candidates()
{
  double margin = 0.0;
  way_left = 0.0;
  if (motion_is_bounded()) {
    // half the skin for the surfaces, and for the atoms as far as they may still go: from where
    // the neighbour list was made, or from one side of there to the other; and some rounding
    way_left = 0.5 * neighbor->skin;
    margin = (1.0 + 1e-6) * (way_left + (neighbor->ago == 0 ? 0.5 : 1.0) * neighbor->skin);
  }
  collected_at = surfaces;
  candidates.clear();
  const int n_surfaces = surfaces.count();
  for (int i = 0; i < atom->nlocal; i++) {
    bool known = false;
    for (int surface = 0; surface < n_surfaces; surface++)
      known |= history[i][surface * history_size + eepa::MAX_OVERLAP] != 0.0;
    if (known || surfaces.near(atom->x[i], atom->radius[i] + margin)) candidates.push_back(i);
  }
  if (contact_table && atom->nlocal > 0)
    std::fill_n(array_atom[0], static_cast<std::size_t>(atom->nlocal) * N_ATOM, 0.0);
}

template <class ContactLaw> void FixWallGranEepa::contact_loop()
{
  double **x = atom->x;
  double **v = atom->v;
  double **f = atom->f;
  double **omega = atom->omega;
  double **torque = atom->torque;
  const double *radius = atom->radius;
  const bool store = update->setupflag == 0;
  const double time_step = store ? dt : 0.0;
  const int n_surfaces = surfaces.count();
  using Layout = typename ContactLaw::Layout;
  const Vec3 wall_velocity(surfaces.velocity.data());

  eepa::Contact contact;
  for (const int i : candidates) {
    if (contact_table) std::fill_n(array_atom[i], static_cast<int>(N_ATOM), 0.0);
    // one that leaves the group in contact must not find its history when it comes back
    const bool member = atom->mask[i] & groupbit;
    if (!member && !keep_ledger) {
      std::fill_n(history[i], n_values, 0.0);
      continue;
    }

    for (int surface = 0; surface < n_surfaces; surface++) {
      double *values = history[i] + static_cast<std::ptrdiff_t>(surface) * ContactLaw::history_size;
      const bool known = values[eepa::MAX_OVERLAP] != 0.0;
      if (!known && !surfaces.on_side(surface, x[i])) continue;
      // a set-up leaves no history: who touched then?
      const bool unknown_is_new = !(keep_ledger && after_setup && store);
      if (!known && (!member || (unknown_is_new && !surfaces.reaches(surface, x[i], radius[i]))))
        continue;
      const SurfacePoint point = surfaces.nearest(surface, x[i], radius[i]);
      if (point.overlap <= 0.0 && !known && unknown_is_new) continue;

      contact.normal = point.normal;
      contact.overlap = point.overlap;
      contact.size = 2.0 * radius[i];
      // the wall: a partner of infinite mass and radius that does not turn
      const double mass = masses.mass(i);
      contact.effective_mass = std::isinf(mass) ? 0.0 : mass;
      contact.effective_radius = radius[i];
      const double arm = eepa::lever_arm(radius[i], point.overlap);
      contact.velocity = Vec3(v[i]) - point.velocity;
      contact.spin = arm * Vec3(omega[i]);
      contact.angular_velocity = Vec3(omega[i]);
      contact.turn = 0.5 * time_step * surfaces.turning(point, Vec3(v[i]) - wall_velocity);
      contact.twist =
          eepa::twist_of_pair<double>(contact.normal, contact.angular_velocity, time_step);

      eepa::History state = eepa::load_history<Layout>(values);
      const bool touched = known ||
          (!unknown_is_new && point.overlap + contact.velocity.dot(contact.normal) * dt > 0.0);
      if (point.overlap <= 0.0 || !member) {
        if (keep_ledger && touched && (store || !member))
          book(i,
               eepa::dissipation_of_opening<ContactLaw>(coefficients, contact, time_step, state,
                                                        !ledger_starts));
        eepa::store_history<Layout>(eepa::History(), values);
        continue;
      }
      if (point.overlap > radius[i]) stop_at_overlap(i, surface, point.overlap);
      const eepa::History before = state;
      const eepa::Response response = ContactLaw::evaluate(
          coefficients, style.settings.limit_damping, contact, time_step, state);
      if (store) eepa::store_history<Layout>(state, values);

      const Vec3 force = ContactLaw::force_on_i(response, contact);
      if (keep_ledger) {
        power += force.dot(point.velocity);
        ledger.store(ContactLaw::stored_energy(coefficients, contact.size, contact.overlap, state),
                     1.0);
        if (store)
          book(i,
               eepa::dissipation_of_step<ContactLaw>(coefficients, contact, response, time_step,
                                                     !touched, before, state, !ledger_starts));
      }
      Vec3 turn = -arm * ContactLaw::tangential_moment(response, contact), wall_turn = turn;
      ContactLaw::add_couple(response, contact, turn, wall_turn);
      for (int k = 0; k < 3; k++) {
        f[i][k] += force[k];
        torque[i][k] += turn[k];
        felt[surface].force[k] -= force[k];
      }
      felt[surface].contacts += 1.0;

      if (contact_table) {
        double *row = array_atom[i];
        row[ATOM_CONTACTS] += 1.0;
        for (int k = 0; k < 3; k++) row[ATOM_FORCE_X + k] += force[k];
        if (point.overlap > row[ATOM_OVERLAP]) {
          const double reach = radius[i] - point.overlap;
          for (int k = 0; k < 3; k++) row[ATOM_POINT_X + k] = x[i][k] - reach * point.normal[k];
          row[ATOM_OVERLAP] = point.overlap;
          row[ATOM_MAX_OVERLAP] = state.max_overlap;
          row[ATOM_BRANCH] = static_cast<int>(response.branch);
          row[ATOM_SLIP] = response.sliding ? 1.0 : 0.0;
        }
      }
    }
  }
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

/// Brings the forces and contacts of all ranks together. Collective.
void FixWallGranEepa::sum_forces()
{
  double mine[8], all[8];
  for (int s = 0; s < 2; s++) {
    std::copy_n(felt[s].force, 3, mine + 4 * s);
    mine[4 * s + 3] = felt[s].contacts;
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
    felt_vector[FIRST_FORCE_X + k] = all[k];
    felt_vector[SECOND_FORCE_X + k] = all[4 + k];
    felt_vector[FORCE_X + k] = all[k] + all[4 + k];
  }
  felt_vector[CONTACTS] = all[3] + all[7];
  felt_summed = true;
}

double FixWallGranEepa::compute_vector(int n)
{
  if (!felt_summed) sum_forces();
  felt_vector[POSITION] = loaded() ? platen.position : surfaces.position();
  felt_vector[VELOCITY] = loaded() ? platen.velocity : surfaces.normal_velocity();
  felt_vector[LOAD_FORCE] = loaded() ? load_now : 0.0;
  felt_vector[LOAD_KINETIC_ENERGY] = loaded() ? platen.kinetic_energy() : 0.0;
  felt_vector[LOAD_WORK] = platen.work;
  felt_vector[LOAD_DISSIPATED] = platen.dissipated;
  return felt_vector[n];
}
