// SPDX-License-Identifier: GPL-2.0-only

// The force call of FixWallGranEepa, and the contacts of a particle.

#include "fix_wall_gran_eepa.h"

#include "compute_gran_eepa_energy_atom.h"
#include "face_loads.h"
#include "particle_arrays.h"
#include "region_shape.h"

#include <eepa/status.h>
#include <eepa_walls/matching.h>
#include <eepa_walls/touched_wall.h>

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
  sums = {};
  output_is_summed = false;
  ledger.elastic = eepa::StoredEnergy();
  elastic_energy = 0.0;
  const double power_before = power;
  power = 0.0;
  atom_losses.clear();
  if (keep_ledger) atom_losses = ComputeGranEepaEnergyAtom::find(modify);
  if (face_loads && step) face_loads->start_step();
  add_contacts();
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

/// Finds and evaluates all contacts.
void FixWallGranEepa::add_contacts()
{
  if (candidates_are_old()) collect_candidates();
  // the evaluation in lanes gives neither losses nor the status that these requests need
  may_wait =
      !waiting_outcomes.empty() && request.advance && !keep_ledger && !contact_table && !face_loads;
  // an error may have ended the run before in the midst of a force call
  waiting_contacts.clear();
  waiting.clear();
  meet_candidates();
  evaluate_waiting();
}

/* ---------------------------------------------------------------------- contacts of a particle */

eepa::Body<double> FixWallGranEepa::body_of(int candidate) const
{
  const int i = candidates.particle(candidate);
  return {ParticleArrays::at(atom->x[0], i), ParticleArrays::at(atom->v[0], i),
          ParticleArrays::at(atom->omega[0], i), candidates.radius(candidate), masses.mass(i)};
}

/// Whether losses of contacts that a set-up had are booked in this step: it leaves no history, so whether
/// a particle touched then is found from its motion.
bool FixWallGranEepa::books_setup() const
{
  return keep_ledger && after_setup && request.advance;
}

void FixWallGranEepa::meet(const Visit &visit)
{
  const int i = candidates.particle(visit.candidate);
  const bool member = is_member(i);
  const Vec3 centre = placement.to_shape(ParticleArrays::at(atom->x[0], i));
  found.clear();
  if (member)
    shape->visit(centre, candidates.radius(visit.candidate), candidates.pieces(visit.candidate),
                 visit.pieces, found);
  const bool had_some = histories.has_some(i);
  if (found.empty() && !had_some && !books_setup()) return;

  const eepa::Body<double> body = body_of(visit.candidate);
  if (found.size() == 1 && had_some) {
    // by far the most frequent case: the contact of the step before goes on
    auto &list = histories.mutable_list(i);
    if (list.size() == 1 && list[0].face == found[0].face &&
        eepa::alikeness(list[0].normal, found[0].normal) > 0.0) {
      const eepa::WallPoint<double> wall = touched_wall(i, body, centre, found[0]);
      if (may_wait)
        wait_for_others(body, wall, {i, found[0], &list[0]});
      else
        evaluate(body, wall, {i, found[0], &list[0]});
      return;
    }
  }
  match(i, centre);
  if (had_some) {
    const auto &list = histories.list(i);
    for (std::size_t k = 0; k < is_matched.size(); k++)
      if (!is_matched[k]) part(i, body, centre, list[k], member);
  }
  if (member && books_setup()) part_after_setup(visit.candidate, body, centre);
  for (std::size_t k = 0; k < found.size(); k++) {
    const int which = history_of_found[k];
    evaluate(body, touched_wall(i, body, centre, found[k]),
             {i, found[k], which < 0 ? nullptr : &histories.mutable_list(i)[which]});
  }

  if (!histories.has_some(i)) return;
  auto &list = histories.mutable_list(i);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < list.size(); k++)
    if (k >= is_matched.size() || is_matched[k]) list[kept++] = list[k];
  list.truncate(kept);
  allow_for(kept);
  histories.release(i);
}

namespace {
/// Contacts and histories of a particle, for match_contacts().
struct ContactsOfParticle {
  const std::vector<SurfacePoint> &points;
  const eepa::FaceHistoryList &list;
  const eepa::Shape &shape;
  const Vec3 &centre;
  std::vector<int> &history_of_found;
  std::vector<char> &matched;

  int found() const { return static_cast<int>(points.size()); }
  int histories() const { return static_cast<int>(list.size()); }
  bool is_taken(int k) const { return history_of_found[k] >= 0; }
  bool is_matched(int m) const { return matched[m] != 0; }
  double alike(int k, int m) const { return eepa::alikeness(list[m].normal, points[k].normal); }
  bool belong(int k, int m, bool same_face) const
  {
    return same_face ? list[m].face == points[k].face
                     : shape.continues(list[m].face, points[k], centre);
  }
  void match(int k, int m) const
  {
    history_of_found[k] = m;
    matched[m] = 1;
  }
};
}    // namespace

/// Finds the history of each contact.
void FixWallGranEepa::match(int i, const Vec3 &centre)
{
  const auto &list = histories.list(i);
  history_of_found.assign(found.size(), -1);
  is_matched.assign(list.size(), 0);
  eepa::match_contacts(
      ContactsOfParticle{found, list, *shape, centre, history_of_found, is_matched});
}

/// The wall at a contact of this step; stops the run where it is too deep.
eepa::WallPoint<double> FixWallGranEepa::touched_wall(int i, const eepa::Body<double> &body,
                                                      const Vec3 &centre,
                                                      const SurfacePoint &point) const
{
  const eepa::WallPoint<double> wall = wall_point(point, body, centre);
  if (eepa::too_deep(wall.overlap, body.radius)) stop_at_overlap(i, point.face, wall.overlap);
  return wall;
}

/// Evaluates a contact together with others. Until then the list of histories of its particle must stay
/// as it is.
void FixWallGranEepa::wait_for_others(const eepa::Body<double> &body,
                                      const eepa::WallPoint<double> &wall, const Touch &touch)
{
  waiting_contacts.push_back({body, wall, touch.history->values.data()});
  waiting.push_back(touch);
  if (waiting.size() < waiting_outcomes.size()) return;
  engine->evaluate_wall_lanes(coefficients, request.time_step, waiting_contacts.data(),
                              waiting_outcomes.data());
  for (std::size_t k = 0; k < waiting.size(); k++)
    finish(waiting[k], waiting_contacts[k].body, waiting_contacts[k].wall, waiting_outcomes[k]);
  waiting_contacts.clear();
  waiting.clear();
}

/// Contacts that are too few to fill the lanes.
void FixWallGranEepa::evaluate_waiting()
{
  for (std::size_t k = 0; k < waiting.size(); k++)
    evaluate(waiting_contacts[k].body, waiting_contacts[k].wall, waiting[k]);
  waiting_contacts.clear();
  waiting.clear();
}

/// \param touch  its history is nullptr where the contact begins
void FixWallGranEepa::evaluate(const eepa::Body<double> &body, const eepa::WallPoint<double> &wall,
                               const Touch &touch)
{
  FaceHistory fresh;
  FaceHistory &history = touch.history ? *touch.history : fresh;
  const eepa::Contact contact = eepa::contact_at_wall(body, wall, request.time_step);
  const bool touched_in_setup = books_setup() && eepa::overlap_before(contact, dt) > 0.0;
  const ContactOutcome outcome = engine->evaluate(
      coefficients, request, contact, !touch.history && !touched_in_setup, history.values.data());
  if (keep_ledger) {
    ledger.elastic.add(outcome.energy, 1.0);
    if (request.wants_losses) book(touch.particle, outcome.lost);
    const auto now = eepa::at_end_of_step(wall, body, placement, request.time_step);
    power += eepa::power_of_wall(outcome.wrench, contact, now);
  }
  if (face_loads && request.advance) face_loads->add(touch.point.face, contact, outcome.wrench, dt);
  finish({touch.particle, touch.point, &history}, body, wall, outcome);
  if (request.advance && !touch.history) histories.mutable_list(touch.particle).push_back(fresh);
}

/// Adds up what a contact does, and keeps where it is.
void FixWallGranEepa::finish(const Touch &touch, const eepa::Body<double> &body,
                             const eepa::WallPoint<double> &wall, const ContactOutcome &outcome)
{
  const int i = touch.particle;
  const SurfacePoint &point = touch.point;
  if (request.advance) {
    touch.history->face = point.face;
    touch.history->normal = point.normal;
    touch.history->distance = point.distance;
  }
  const eepa::Wrench<double> &wrench = outcome.wrench;
  elastic_energy += outcome.energy.total();
  const Vec3 moment = eepa::moment_on_wall(wrench, body.x, Vec3(about.data()));
  ForceArrays{atom->f[0], atom->torque[0]}.add(i, wrench.force, wrench.torque_i);
  double *force_on_wall = sums.force[typed_shape.planes() == 2 ? point.face : 0];
  for (int k = 0; k < 3; k++) {
    force_on_wall[k] -= wrench.force[k];
    sums.moment[k] += moment[k];
  }
  sums.contacts += 1.0;
  if (contact_table) tabulate(i, body, wall, outcome);
  if (evflag) {    // Fix::v_setup() does not set vflag_either
    const Vec3 arm = point.distance * wall.normal;
    const Vec3 &f = wrench.force;
    double virial_of_i[6] = {arm[0] * f[0], arm[1] * f[1], arm[2] * f[2],
                             arm[0] * f[1], arm[0] * f[2], arm[1] * f[2]};
    v_tally(i, virial_of_i);
  }
}

/// Ends a contact that existed in the last step.
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
void FixWallGranEepa::part_after_setup(int candidate, const eepa::Body<double> &body,
                                       const Vec3 &centre)
{
  const int i = candidates.particle(candidate);
  const double step = dt * (body.v - placement.velocity_at(body.x)).norm();
  std::vector<SurfacePoint> near;
  shape->visit(centre, body.radius + step, candidates.pieces(candidate),
               candidates.piece_count(candidate), near);
  const FaceHistory none;
  for (const SurfacePoint &point : near) {
    if (point.distance < body.radius) continue;
    bool known = std::any_of(found.begin(), found.end(), [&point](const SurfacePoint &other) {
      return other.face == point.face;
    });
    const auto &list = histories.list(i);
    for (std::size_t k = 0; k < list.size(); k++) known |= list[k].face == point.face;
    if (known) continue;
    const eepa::WallPoint<double> wall = wall_point(point, body, centre);
    const eepa::Contact contact = eepa::contact_at_wall(body, wall, request.time_step);
    if (eepa::overlap_before(contact, dt) > 0.0)
      book(i, engine->open(coefficients, request, contact, none.values.data()));
  }
}

/// The wall as the law sees it, in space and with its motion.
eepa::WallPoint<double> FixWallGranEepa::wall_point(const SurfacePoint &point,
                                                    const eepa::Body<double> &body,
                                                    const Vec3 &centre) const
{
  const Vec3 relative = body.v - placement.velocity_at(body.x);
  eepa::WallPoint<double> wall =
      eepa::touched_wall(point, body, placement,
                         shape->normal_rate(point, centre, placement.direction_to_shape(relative)),
                         surface_speed, request.time_step);
  if (shape->moves()) {
    const eepa::SurfaceVelocity own = shape->velocity(
        point, centre, 0.5 * request.time_step * placement.direction_to_shape(relative));
    // of the surface, from which the middle of the overlap is not far
    const Vec3 spot = eepa::middle_of_overlap(body, wall.normal, wall.overlap);
    const Vec3 inwards = spot - body.x + point.distance * wall.normal;
    const Vec3 own_angular = placement.direction_to_space(own.angular);
    wall.velocity += placement.direction_to_space(own.linear) + own_angular.cross(inwards);
    wall.angular_velocity += own_angular;
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
  for (auto *compute : atom_losses) compute->add(i, lost.by_kind().value);
}
