// SPDX-License-Identifier: GPL-2.0-only

// The force call of FixWallGranEepa: which particles may touch the wall, and the contacts of each.

#include "fix_wall_gran_eepa.h"

#include "compute_gran_eepa_energy_atom.h"
#include "face_loads.h"
#include "region_shape.h"

#include <eepa/status.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using eepa::FaceHistory;
using eepa::SurfacePoint;
using eepa::Vec3;

void FixWallGranEepa::setup(int vflag)
{
  // variables may read the position of the wall
  place_wall();
  evaluate_motion();
  if (masses.has_bodies()) masses.collect_bodies();
  platen_warned = false;    // its own bound is checked where its contacts are known
  time_step_warned = false;
  check_time_step();
  post_force(vflag);
  needs_setup = false;
}

void FixWallGranEepa::post_force(int vflag)
{
  v_init(vflag);
  if (masses.has_bodies() && neighbor->ago == 0) masses.collect_bodies();
  if (neighbor->ago == 0 && update->setupflag == 0 && atom->natoms > checked_particles)
    check_time_step();
  place_wall();
  if (region_shape && region_shape->moves()) {
    // variables of the region may ask for computes
    modify->clearstep_compute();
    region_shape->update(update->ntimestep, dt);
    modify->addstep_compute(update->ntimestep + 1);
  }
  const bool step = update->setupflag == 0;
  request = StepRequest::of_call(step, dt, keep_ledger, ledger_starts);
  request.wants_energy = true;
  if (!step || neighbor->ago == 0 || !motion_is_bounded() || !(travelled() <= travel_left))
    collect_candidates();
  sums = {};
  output_is_summed = false;
  ledger.elastic = eepa::StoredEnergy();
  elastic_energy = 0.0;
  const double power_before = power;
  power = 0.0;
  atom_losses.clear();
  if (keep_ledger) atom_losses = ComputeGranEepaEnergyAtom::find(modify);
  if (face_loads && step) face_loads->start_step();
  const std::size_t count = candidates.size();
  for (std::size_t k = 0; k < count; k++) {
    constexpr std::size_t soon = 4;    // particles ahead
    if (k + soon < count) prefetch_candidate(k + soon);
    meet(candidates[k], pieces.data() + first_piece[k], first_piece[k + 1] - first_piece[k]);
  }
  after_setup = !step;
  if (step) ledger_starts = false;
  if (loaded()) {
    const int dim = load_axis();
    const double platen_force_before = platen_force, other_power_before = other_power;
    platen_force = -(sums.force[0][dim] + sums.force[1][dim]);
    // a platen's velocity may change within a step, so force times displacement is the work
    other_power = power - platen_force * platen.velocity;
    if (keep_ledger && step) {
      ledger.wall_work += 0.5 * (platen_force_before + platen_force) * platen.travel();
      ledger.wall_work += 0.5 * (other_power_before + other_power) * dt;
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

/* ---------------------------------------------------------------------- candidates */

/// Whether no atom moves by more than half the skin between two neighbour lists, and the wall moves
/// by its drive only. LAMMPS ensures the former only if it checks all atoms, or makes a new list, in
/// every step.
bool FixWallGranEepa::motion_is_bounded() const
{
  return neighbor->every == 1 && neighbor->delay <= 1 && !neighbor->build_once &&
      !neighbor->includegroup && !radii_may_change && !shape->moves();
}

/// Largest distance by which the surface may have approached any point since the last collection.
double FixWallGranEepa::travelled() const
{
  if (rotation_is_new) return HUGE_VAL;
  const Vec3 shift = placement.displacement - collected_at.displacement;
  const double turn = std::fabs(placement.angle - collected_at.angle);
  if (turn == 0.0) return shape->approach(placement.direction_to_shape(shift));
  return shift.norm() + turn * rotation_reach;
}

/// Collects the atoms that can touch a face before the next collection, of any group, because
/// groups may change. Where their motion is not bounded, collects those that touch at present.
void FixWallGranEepa::collect_candidates()
{
  double margin = 0.0;
  travel_left = 0.0;
  if (motion_is_bounded()) {
    // The wall may move by half the skin. Atoms may move by half the skin from their positions in a
    // new neighbour list; in an older list they may have done so already, the other way. Some
    // rounding is added.
    travel_left = 0.5 * neighbor->skin;
    margin = (1.0 + 1e-6) * (travel_left + (neighbor->ago == 0 ? 0.5 : 1.0) * neighbor->skin);
  }
  collected_at = placement;
  rotation_is_new = false;
  candidates.clear();
  pieces.clear();
  first_piece.assign(1, 0);
  for (int i = 0; i < atom->nlocal; i++) {
    require_slow(i);
    const Vec3 centre = placement.to_shape(Vec3(atom->x[i]));
    const bool near = shape->collect(centre, atom->radius[i] + margin, pieces);
    if (!near && !histories.has_some(i)) {
      pieces.resize(first_piece.back());
      continue;
    }
    candidates.push_back(i);
    first_piece.push_back(static_cast<int>(pieces.size()));
  }
  if (contact_table && atom->nlocal > 0)
    std::fill_n(array_atom[0], static_cast<std::size_t>(atom->nlocal) * N_ATOM, 0.0);
}

/// Candidates are scattered over the particles: few of their data are in the cache.
void FixWallGranEepa::prefetch_candidate(std::size_t k) const
{
#if defined(__GNUC__) || defined(__clang__)
  const int i = candidates[k];
  __builtin_prefetch(atom->x[i]);
  __builtin_prefetch(atom->v[i]);
  __builtin_prefetch(atom->omega[i]);
  __builtin_prefetch(atom->f[i], 1);
  __builtin_prefetch(atom->torque[i], 1);
  __builtin_prefetch(atom->radius + i);
  __builtin_prefetch(atom->rmass + i);
  __builtin_prefetch(atom->mask + i);
#endif
  shape->prefetch(pieces.data() + first_piece[k], first_piece[k + 1] - first_piece[k]);
}

/* ---------------------------------------------------------------------- contacts of a particle */

eepa::Body<double> FixWallGranEepa::body_of(int i) const
{
  return {Vec3(atom->x[i]), Vec3(atom->v[i]), Vec3(atom->omega[i]), atom->radius[i],
          masses.mass(i)};
}

void FixWallGranEepa::meet(int i, const int *pieces_of_i, int count)
{
  if (contact_table) std::fill_n(array_atom[i], static_cast<int>(N_ATOM), 0.0);
  // a particle that leaves the group in contact must not find its old history when it comes back
  const bool member = atom->mask[i] & groupbit;
  if (!member && !keep_ledger) histories.clear(i);
  if (!member && !histories.has_some(i)) return;
  if (member) require_slow(i);

  const Vec3 centre = placement.to_shape(Vec3(atom->x[i]));
  found.clear();
  if (member) shape->visit(centre, atom->radius[i], pieces_of_i, count, found);
  // a set-up leaves no history, so whether the particle touched then is found from its motion
  const bool unknown_may_be_old = member && keep_ledger && after_setup && request.advance;
  if (found.empty() && !histories.has_some(i) && !unknown_may_be_old) return;

  const eepa::Body<double> body = body_of(i);
  match(i, centre);
  if (histories.has_some(i)) {
    FaceHistory *list = histories.mutable_list(i).data();
    for (std::size_t k = 0; k < is_matched.size(); k++)
      if (!is_matched[k]) part(i, body, centre, list[k], member);
  }
  if (unknown_may_be_old) part_after_setup(i, body, centre, pieces_of_i, count);
  for (std::size_t k = 0; k < found.size(); k++) touch(i, body, centre, static_cast<int>(k));

  if (!histories.has_some(i)) return;
  auto &list = histories.mutable_list(i);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < list.size(); k++)
    if (k >= is_matched.size() || is_matched[k]) list[kept++] = list[k];
  list.resize(kept);
  allow_for(kept);
  histories.release(i);
}

/// Finds the history of each contact: of the same face, or of a face from which the particle slid.
/// Those whose normals are nearest belong together, because contacts may share the number of a face.
void FixWallGranEepa::match(int i, const Vec3 &centre)
{
  const auto &list = histories.list(i);
  history_of_found.assign(found.size(), -1);
  is_matched.assign(list.size(), 0);
  for (const bool same_face : {true, false})
    for (;;) {
      double closest = 0.0;
      std::size_t contact = found.size(), history = 0;
      for (std::size_t k = 0; k < found.size(); k++) {
        if (history_of_found[k] >= 0) continue;
        for (std::size_t m = 0; m < list.size(); m++) {
          if (is_matched[m]) continue;
          const bool is_known = list[m].normal != Vec3::Zero();
          const double alike = is_known ? eepa::dot(list[m].normal, found[k].normal) : 1.0;
          if (alike <= closest) continue;
          if (same_face ? list[m].face != found[k].face
                        : !shape->continues(list[m].face, found[k], centre))
            continue;
          closest = alike;
          contact = k;
          history = m;
        }
      }
      if (contact == found.size()) break;
      history_of_found[contact] = static_cast<int>(history);
      is_matched[history] = 1;
    }
}

/// A contact of this step.
void FixWallGranEepa::touch(int i, const eepa::Body<double> &body, const Vec3 &centre, int which)
{
  const SurfacePoint &point = found[which];
  FaceHistory fresh;
  fresh.face = point.face;
  const bool known = history_of_found[which] >= 0;
  FaceHistory &history = known ? histories.mutable_list(i)[history_of_found[which]] : fresh;
  const eepa::WallPoint<double> wall = wall_point(point, body, centre);
  if (eepa::too_deep(wall.overlap, body.radius)) stop_at_overlap(i, point.face, wall.overlap);
  const eepa::Contact contact = eepa::contact_at_wall(body, wall, request.time_step);
  const bool touched_in_setup = keep_ledger && after_setup && request.advance &&
      wall.overlap + contact.velocity.dot(contact.normal) * dt > 0.0;
  const ContactOutcome outcome = engine->evaluate(
      coefficients, request, contact, !known && !touched_in_setup, history.values.data());
  history.face = point.face;
  if (request.advance) {
    history.normal = point.normal;
    history.distance = point.distance;
    if (!known) histories.mutable_list(i).push_back(history);
  }

  const eepa::Wrench<double> &wrench = outcome.wrench;
  elastic_energy += outcome.energy.total();
  if (keep_ledger) ledger.store(outcome.energy, 1.0);
  if (request.wants_losses) book(i, outcome.lost);
  if (keep_ledger) {
    // at the end of the step, as the force
    eepa::WallPoint<double> now = wall;
    const Vec3 spot = eepa::middle_of_overlap(body, wall.normal, wall.overlap);
    now.velocity += placement.velocity_at(spot) -
        placement.velocity_before(spot, body.v, 0.5 * request.time_step);
    power += eepa::power_of_wall(wrench, contact, now);
  }
  const Vec3 moment = eepa::moment_on_wall(wrench, body.x, Vec3(about.data()));
  double *force_on_wall = sums.force[typed_shape.planes() == 2 ? point.face : 0];
  for (int k = 0; k < 3; k++) {
    atom->f[i][k] += wrench.force[k];
    atom->torque[i][k] += wrench.torque_i[k];
    force_on_wall[k] -= wrench.force[k];
    sums.moment[k] += moment[k];
  }
  sums.contacts += 1.0;
  if (contact_table) tabulate(i, body, wall, outcome);
  if (face_loads && request.advance) face_loads->add(point.face, contact, wrench, dt);
  if (vflag_either) {
    const Vec3 arm = point.distance * wall.normal;
    const Vec3 &f = wrench.force;
    double virial_of_i[6] = {arm[0] * f[0], arm[1] * f[1], arm[2] * f[2],
                             arm[0] * f[1], arm[0] * f[2], arm[1] * f[2]};
    v_tally(i, virial_of_i);
  }
}

/// A contact of the step before that is none any more.
void FixWallGranEepa::part(int i, const eepa::Body<double> &body, const Vec3 &centre,
                           const FaceHistory &history, bool member)
{
  if (member && (got_through(body, history) || (request.advance && shape->is_behind(centre))))
    stop_behind_wall(i);
  if (!keep_ledger || (!request.advance && member)) return;
  SurfacePoint point = shape->nearest(history.face, centre);
  if (point.normal == Vec3::Zero()) {
    point.normal = history.normal;
    point.distance = body.radius;
  }
  const eepa::WallPoint<double> wall = wall_point(point, body, centre);
  const eepa::Contact contact = eepa::contact_at_wall(body, wall, request.time_step);
  book(i, engine->open(coefficients, request, contact, history.values.data()));
}

/// Books the opening of contacts that the set-up had and the first step has not: the set-up stored
/// no history.
void FixWallGranEepa::part_after_setup(int i, const eepa::Body<double> &body, const Vec3 &centre,
                                       const int *pieces_of_i, int count)
{
  const double step = dt * (body.v - placement.velocity_at(body.x)).norm();
  std::vector<SurfacePoint> near;
  shape->visit(centre, body.radius + step, pieces_of_i, count, near);
  const FaceHistory none;
  for (const SurfacePoint &point : near) {
    if (point.distance < body.radius) continue;
    const auto has_face = [&point](const auto &other) {
      return other.face == point.face;
    };
    const auto &list = histories.list(i);
    if (std::any_of(found.begin(), found.end(), has_face) ||
        std::any_of(list.begin(), list.end(), has_face))
      continue;
    const eepa::WallPoint<double> wall = wall_point(point, body, centre);
    const eepa::Contact contact = eepa::contact_at_wall(body, wall, request.time_step);
    if (wall.overlap + contact.velocity.dot(contact.normal) * dt > 0.0)
      book(i, engine->open(coefficients, request, contact, none.values.data()));
  }
}

/// The wall as the law sees it, in space and with its motion.
eepa::WallPoint<double> FixWallGranEepa::wall_point(const SurfacePoint &point,
                                                    const eepa::Body<double> &body,
                                                    const Vec3 &centre) const
{
  eepa::WallPoint<double> wall;
  wall.normal = placement.direction_to_space(point.normal);
  wall.overlap = body.radius - point.distance;
  const Vec3 relative = body.v - placement.velocity_at(body.x);
  wall.normal_rate = placement.direction_to_space(
      shape->normal_rate(point, centre, placement.direction_to_shape(relative)));
  const Vec3 spot = eepa::middle_of_overlap(body, wall.normal, wall.overlap);
  // as the particle's velocity, that of half a step ago
  wall.velocity = placement.velocity_before(spot, body.v, 0.5 * request.time_step);
  if (placement.angular_velocity() != Vec3::Zero()) {
    wall.angular_velocity = placement.angular_velocity();
    wall.normal_rate += wall.angular_velocity.cross(wall.normal);
  }
  if (shape->moves()) {
    const eepa::SurfaceVelocity own = shape->velocity(
        point, centre, 0.5 * request.time_step * placement.direction_to_shape(relative));
    // of the surface, from which the middle of the overlap is not far
    const Vec3 inwards = spot - body.x + point.distance * wall.normal;
    const Vec3 own_angular = placement.direction_to_space(own.angular);
    wall.velocity += placement.direction_to_space(own.linear) + own_angular.cross(inwards);
    wall.angular_velocity += own_angular;
  }
  if (surface_speed != 0.0) {    // of a cylinder
    const Vec3 around(wall.normal[1], -wall.normal[0], 0.0);
    wall.velocity += (point.face == 0 ? -surface_speed : surface_speed) * around;
  }
  return wall;
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
