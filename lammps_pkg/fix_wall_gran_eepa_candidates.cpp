// SPDX-License-Identifier: GPL-2.0-only

// Which particles FixWallGranEepa looks at: those that may touch the wall until the next collection, and of
// these the ones that may touch it in the present step.

#include "fix_wall_gran_eepa.h"

#include "particle_arrays.h"

#include "atom.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using eepa::Vec3;

/// Whether candidates stay for several steps: particles do not grow, and the wall moves by its drive only.
bool FixWallGranEepa::candidates_stay() const
{
  return !radii_may_change && !shape->moves();
}

/// Whether LAMMPS makes a new neighbour list as soon as an atom has moved by half the skin. It does so only
/// if it checks all atoms, or makes a new list, in every step.
bool FixWallGranEepa::lists_bound_motion() const
{
  return neighbor->every == 1 && neighbor->delay <= 1 && !neighbor->build_once &&
      !neighbor->includegroup;
}

/// Whether candidates must be collected again before this force call, however little atoms have moved.
bool FixWallGranEepa::particles_are_elsewhere() const
{
  // Particles change their local indices when a list is made, and when another fix reorders them.
  if (update->setupflag != 0 || neighbor->ago == 0 || particles_are_moved) return true;
  return !candidates_stay() || !(travelled() <= travel_left);
}

/// Whether atoms may move by more than half the skin before LAMMPS makes a new list.
bool FixWallGranEepa::atoms_may_be_far() const
{
  return candidates_stay() && !lists_bound_motion();
}

bool FixWallGranEepa::candidates_are_old() const
{
  if (particles_are_elsewhere()) return true;
  if (places.empty()) return false;
  const double most = 0.25 * neighbor->skin * neighbor->skin;
  for (int i = 0; i < atom->nlocal; i++)
    if (!((Vec3(atom->x[i]) - places[i]).squaredNorm() <= most)) return true;
  return false;
}

/// Whether no drive moves the surface, except along itself.
bool FixWallGranEepa::surface_stays() const
{
  const bool drive_stays = motion_args.drive == eepa::WallDrive::still ||
      motion_args.drive == eepa::WallDrive::shear;
  return drive_stays && !motion_args.rotates;
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

/// Begins a collection at the present place of the wall.
/// \return by how much a particle may move before the next one [length]
double FixWallGranEepa::margin_of_candidates()
{
  collected_margin = 0.0;
  travel_left = 0.0;
  if (candidates_stay()) {
    // A wall that moves may do so by half the skin. Atoms may move by half the skin from their
    // positions in a new neighbour list; in an older list they may have done so already, the other
    // way. Some rounding is added.
    if (!surface_stays()) travel_left = 0.5 * neighbor->skin;
    const double of_atoms = lists_bound_motion() && neighbor->ago != 0 ? 1.0 : 0.5;
    collected_margin = (1.0 + 1e-6) * (travel_left + of_atoms * neighbor->skin);
  }
  collected_at = placement;
  rotation_is_new = false;
  return collected_margin;
}

/// Collects the atoms that can touch a face before the next collection, of any group, because
/// groups may change. Where candidates do not stay, collects those that touch at present.
void FixWallGranEepa::collect_candidates()
{
  const double margin = margin_of_candidates();
  places.clear();
  if (atoms_may_be_far())
    for (int i = 0; i < atom->nlocal; i++) places.emplace_back(atom->x[i]);
  for (int i = 0; i < atom->nlocal; i++) require_slow(i);
  candidates.clear();
  for (int i = 0; i < atom->nlocal; i++) {
    const Vec3 centre = placement.to_shape(Vec3(atom->x[i]));
    candidates.add(i, centre, atom->radius[i], margin, *shape, histories.has_some(i));
  }
  histories.arrange(candidates.particles());
  particles_are_moved = false;
  if (contact_table && atom->nlocal > 0)
    std::fill_n(array_atom[0], static_cast<std::size_t>(atom->nlocal) * N_ATOM, 0.0);
}

/// Whether a candidate has a contact, had one or may have one.
bool FixWallGranEepa::must_be_met(std::size_t candidate, int &pieces)
{
  const int i = candidates.particle(candidate);
  if (contact_table) std::fill_n(array_atom[i], static_cast<int>(N_ATOM), 0.0);
  // a particle that leaves the group in contact must not find its old history when it comes back
  const bool member = is_member(i);
  if (!member && !keep_ledger) histories.clear(i);
  bool meets = histories.has_some(i);
  pieces = 0;
  if (!member) return meets;
  // one that stays this near to where it was collected makes no larger steps than its radius
  if (!(2.0 * collected_margin <= candidates.radius(candidate))) require_slow(i);
  pieces = candidates.near_pieces(candidate, placement.to_shape(ParticleArrays::at(atom->x[0], i)));
  // a shape without pieces is asked for each candidate
  return meets || pieces > 0 || candidates.piece_count(candidate) == 0 || books_setup();
}

/// Meets the candidates that must be. Particles at a wall are scattered over all particles, and few of their
/// data are in the cache: what is needed of each is fetched some visits ahead.
void FixWallGranEepa::meet_candidates()
{
  constexpr std::size_t soon = 16;    // candidates ahead
  constexpr std::size_t delay = 8;    // visits
  visits.clear();
  std::size_t met = 0;
  const std::size_t count = candidates.count();
  for (std::size_t k = 0; k < count; k++) {
    if (k + soon < count) prefetch_place(candidates.particle(k + soon));
    int pieces;
    if (!must_be_met(k, pieces)) continue;
    visits.push_back({static_cast<int>(k), pieces});
    prefetch(visits.back());
    if (visits.size() > met + delay) meet(visits[met++]);
  }
  while (met < visits.size()) meet(visits[met++]);
}

void FixWallGranEepa::prefetch_place(int i) const
{
  prefetch_row(atom->x[0], i);
  histories.prefetch(i);
}

void FixWallGranEepa::prefetch(const Visit &visit) const
{
  const int i = candidates.particle(visit.candidate);
  prefetch_row(atom->v[0], i);
  prefetch_row(atom->omega[0], i);
  prefetch_row(atom->f[0], i);
  prefetch_row(atom->torque[0], i);
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(atom->rmass + i);
#endif
  histories.prefetch_list(i);
  shape->prefetch(candidates.pieces(visit.candidate), visit.pieces);
}
