// SPDX-License-Identifier: GPL-2.0-only
#include "contact_history.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "my_page.h"
#include "neighbor.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace LAMMPS_NS;

namespace {
/// The name of LAMMPS's own fix, so that restart files do not depend on which fix wrote them.
constexpr const char *fix_style = "NEIGH_HISTORY";

/// Makes LAMMPS use another constructor for fix NEIGH_HISTORY while this object lives.
class OtherCreator {
 public:
  OtherCreator(Modify *modify, Modify::FixCreator creator) :
      current((*modify->fix_map)[fix_style]), lammps_own(current)
  {
    current = creator;
  }
  ~OtherCreator() { current = lammps_own; }
  OtherCreator(const OtherCreator &) = delete;
  OtherCreator &operator=(const OtherCreator &) = delete;

 private:
  Modify::FixCreator &current;
  const Modify::FixCreator lammps_own;
};
}    // namespace

namespace {
/// Gives a variable another value while this object lives.
class Meanwhile {
 public:
  Meanwhile(int &of, int value) : variable(of), before(of) { variable = value; }
  ~Meanwhile() { variable = before; }
  Meanwhile(const Meanwhile &) = delete;
  Meanwhile &operator=(const Meanwhile &) = delete;

 private:
  int &variable;
  const int before;
};
}    // namespace

ContactHistory::ContactHistory(LAMMPS *lmp, int narg, char **arg, bool with_borders) :
    FixNeighHistory(lmp, narg, arg), owner(atom->nmax, 0), place_in_list(atom->nmax, -1)
{
  std::copy_n(atom->tag, atom->nlocal, owner.begin());
  if (!with_borders) return;
  comm_border = 1;    // tells whether a ghost is a new particle
  atom->add_callback(Atom::BORDER);
}

ContactHistory::~ContactHistory()
{
  if (!copymode && comm_border) atom->delete_callback(id, Atom::BORDER);
}

Fix *ContactHistory::create(LAMMPS *lmp, int narg, char **arg)
{
  return new ContactHistory(lmp, narg, arg);
}

ContactHistory *ContactHistory::make(LAMMPS *lmp, const std::string &id, int values,
                                     Pair *contacts_of, Modify::FixCreator make_fix)
{
  ContactHistory *made = nullptr;
  {
    const OtherCreator creator(lmp->modify, make_fix);
    // without a suffix: NEIGH_HISTORY/omp forgets contacts with ghosts with newton on
    made = static_cast<ContactHistory *>(lmp->modify->replace_fix(
        place_holder(id), fmt::format("{} all {} {}", id, fix_style, values), 0));
  }
  made->pair = contacts_of;
  const std::string reason = made->what_does_not_fit();
  if (!reason.empty()) {
    lmp->modify->replace_fix(id, place_holder(id) + " all DUMMY", 0);
    lmp->error->all(FLERR, "pair_style gran/eepa: {}", reason);
  }
  return made;
}

/* ---------------------------------------------------------------------- which is newer */

void ContactHistory::force_is_computed()
{
  if (list_is_old)
    error->all(FLERR,
               "pair_style gran/eepa: run with pre no after a command that set the system up anew, "
               "such as write_restart: particles are no more where the neighbour list has them; "
               "leave out pre no");
  partners_are_newest = false;
}

void ContactHistory::end_interrupted_run()
{
  if (partners_are_newest) return;
  int mine = !list_is_old && atom_count_is_listed() && nall_neigh == atom->nlocal + atom->nghost;
  for (int i = 0; i < atom->nlocal; i++) mine &= place_of(i) == i;
  int all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, world);
  if (!all)
    error->all(FLERR,
               "pair_style gran/eepa: an error ended the last run while particles changed places, "
               "and the history of contacts is lost; go on from a restart file");
  post_run();
}

void ContactHistory::post_run()
{
  // after `run 0 pre no` the list may be old: nothing was computed, and the partners are valid
  if (!list_is_old) FixNeighHistory::post_run();
  partners_are_newest = true;
}

void ContactHistory::init()
{
  if (ipage_atom && (pgsize != neighbor->pgsize || oneatom != neighbor->oneatom))
    keep_partners_in_new_pages();
  else
    FixNeighHistory::init();
  // the caller of an init may move particles to other processors next, as write_restart does
  list_is_old = true;
}

/// Keeps histories across `neigh_modify one` and `page`, where LAMMPS's fix can lose them.
void ContactHistory::keep_partners_in_new_pages()
{
  std::vector<tagint> ids;
  std::vector<double> values;
  for (int i = 0; i < atom->nlocal; i++) {
    ids.insert(ids.end(), partner[i], partner[i] + npartner[i]);
    values.insert(values.end(), valuepartner[i], valuepartner[i] + dnum * npartner[i]);
  }
  FixNeighHistory::init();
  const tagint *id = ids.data();
  const double *value = values.data();
  for (int i = 0; i < atom->nlocal; i++) {
    const int n = npartner[i];
    partner[i] = ipage_atom->get(n);
    valuepartner[i] = dpage_atom->get(dnum * n);
    if (!partner[i] || !valuepartner[i])
      error->one(FLERR,
                 "neigh_modify one = {} is not allowed: a particle has {} contacts, and it must be "
                 "larger",
                 neighbor->oneatom, n);
    std::copy_n(id, n, partner[i]);
    std::copy_n(value, dnum * n, valuepartner[i]);
    id += n;
    value += dnum * n;
  }
}

/* ---------------------------------------------------------------------- which particle a list belongs to */

bool ContactHistory::ids_are_kept()
{
  bring_partners_to_host();
  int mine = 1, all = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (npartner[i] > 0 && owner[i] != atom->tag[i]) mine = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, world);
  return all != 0;
}

namespace {
/// Gives LAMMPS other atom IDs while this object lives.
class OtherIds {
 public:
  OtherIds(Atom *atom, tagint *ids) : tag(atom->tag), lammps_own(atom->tag) { tag = ids; }
  ~OtherIds() { tag = lammps_own; }
  OtherIds(const OtherIds &) = delete;
  OtherIds &operator=(const OtherIds &) = delete;

 private:
  tagint *&tag;
  tagint *const lammps_own;
};
}    // namespace

void ContactHistory::pre_exchange()
{
  {
    // The neighbour list holds local indices. A fix that ran before this one may have deleted
    // particles, whose indices others took, and inserted new ones over the IDs of ghosts.
    const OtherIds of_list(atom, list_ids.data());
    FixNeighHistory::pre_exchange();
  }
  follow_particles();
  reserve_exchange();
  for (int i = 0; i < atom->nlocal; i++)
    if (place_of(i) >= 0) owner[i] = atom->tag[i];
}

/// Moves the lists of partners from the indices that their particles had when the neighbour list
/// was made to the present ones.
void ContactHistory::follow_particles()
{
  if (in_place) return;
  const int n = atom->nlocal;
  const std::vector<int> counts(npartner, npartner + nlocal_neigh);
  const std::vector<tagint *> ids(partner, partner + nlocal_neigh);
  const std::vector<double *> values(valuepartner, valuepartner + nlocal_neigh);
  for (int i = 0; i < n; i++) {
    const int place = place_of(i);
    npartner[i] = place < 0 ? 0 : counts[place];
    if (place < 0) continue;
    partner[i] = ids[place];
    valuepartner[i] = values[place];
  }
}

void ContactHistory::post_neighbor()
{
  forget_partners_with_new_ids();
  const auto stored = std::accumulate(npartner, npartner + atom->nlocal, bigint{0});
  {
    const Meanwhile keep_those_that_part(pair->beyond_contact, parting_contacts ? 1 : 0);
    FixNeighHistory::post_neighbor();
  }
  list_ids.assign(atom->tag, atom->tag + nall_neigh);
  list_is_made();
  if (just_restarted) warn_of_lost_histories(stored);
}

void ContactHistory::list_is_made()
{
  list_is_old = false;
  in_place = true;
  if (radii_change) remember_sizes();
}

bool ContactHistory::atom_count_is_listed() const
{
  return nlocal_neigh == atom->nlocal;
}

/// Index that a particle had when the neighbour list was made, -1 where it was not there.
int ContactHistory::place_of(int i) const
{
  if (in_place) return i < nlocal_neigh ? i : -1;
  return place_in_list[i];
}

/// Prepares for the first particle that leaves its place. Most often there is none.
void ContactHistory::leave_places()
{
  if (!in_place) return;
  in_place = false;
  const auto end = place_in_list.begin() + nlocal_neigh;
  std::iota(place_in_list.begin(), end, 0);
  std::fill(end, place_in_list.end(), -1);
}

/// Removes new particles from the lists of partners. A new particle may have the ID of a deleted
/// one, but has no history. All partners of a list are particles or ghosts of this rank, and ghosts
/// carry whether they are new.
void ContactHistory::forget_partners_with_new_ids()
{
  new_here.clear();
  std::vector<tagint> fresh;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (owner[i] == 0) fresh.push_back(atom->tag[i]);
  if (fresh.empty()) return;
  for (int i = 0; i < atom->nlocal; i++) {
    if (owner[i] != 0) continue;
    owner[i] = atom->tag[i];
    new_here.push_back(i);
  }
  std::sort(fresh.begin(), fresh.end());
  for (int i = 0; i < atom->nlocal; i++) {
    int kept = 0;
    for (int m = 0; m < npartner[i]; m++) {
      if (std::binary_search(fresh.begin(), fresh.end(), partner[i][m])) continue;
      partner[i][kept] = partner[i][m];
      std::copy_n(valuepartner[i] + static_cast<std::ptrdiff_t>(dnum) * m, dnum,
                  valuepartner[i] + static_cast<std::ptrdiff_t>(dnum) * kept);
      kept++;
    }
    npartner[i] = kept;
  }
}

/* ---------------------------------------------------------------------- particles that grow */

int ContactHistory::setmask()
{
  return FixNeighHistory::setmask() | FixConst::POST_INTEGRATE;
}

void ContactHistory::watch_radii(bool change)
{
  radii_change = change;
  force_reneighbor = change ? 1 : 0;    // LAMMPS then asks for next_reneighbor in every step
  next_reneighbor = -1;
}

void ContactHistory::remember_sizes()
{
  std::copy_n(domain->boxlo, 3, listed_box.begin());
  std::copy_n(domain->boxhi, 3, listed_box.begin() + 3);
  listed_radius.assign(atom->radius, atom->radius + atom->nlocal);
  listed_position.resize(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) std::copy_n(atom->x[i], 3, listed_position[i].begin());
}

/// LAMMPS rebuilds the list when a particle has moved by half the skin; growth counts like motion.
/// Positions are those of this step, but radii those of the step before: they grow once more before
/// the forces, which is estimated by the mean growth of a step.
void ContactHistory::post_integrate()
{
  if (!radii_change) return;
  const double steps = std::max(1, neighbor->ago);
  double mine[] = {0.0, 0.0}, all[2];    // motion with growth, growth alone
  for (int i = 0; i < std::min(atom->nlocal, static_cast<int>(listed_radius.size())); i++) {
    double displacement_squared = 0.0;
    for (int k = 0; k < 3; k++) {
      const double displacement = atom->x[i][k] - listed_position[i][k];
      displacement_squared += displacement * displacement;
    }
    const double grown = std::max(0.0, atom->radius[i] - listed_radius[i]);
    mine[0] = std::max(mine[0], std::sqrt(displacement_squared) + grown * (1.0 + 1.0 / steps));
    mine[1] = std::max(mine[1], grown);
  }
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_MAX, world);
  if (2.0 * all[1] > neighbor->skin)
    error->all(FLERR,
               "pair_style gran/eepa: radii grew by up to {:.6g} in {} steps, more than half the "
               "skin of {:.6g}, so that contacts were missed: let them grow in smaller steps, or "
               "make the skin larger with the command neighbor",
               all[1], neighbor->ago, neighbor->skin);
  if (2.0 * all[0] > neighbor->skin - box_moved()) next_reneighbor = update->ntimestep;
}

/// What LAMMPS subtracts from the skin where the box changes: the travel of two opposite corners.
double ContactHistory::box_moved() const
{
  double lower = 0.0, upper = 0.0;
  for (int k = 0; k < 3; k++) {
    lower += std::pow(domain->boxlo[k] - listed_box[k], 2);
    upper += std::pow(domain->boxhi[k] - listed_box[3 + k], 2);
  }
  return std::sqrt(lower) + std::sqrt(upper);
}

double ContactHistory::memory_usage()
{
  return FixNeighHistory::memory_usage() +
      static_cast<double>((owner.capacity() + list_ids.capacity()) * sizeof(tagint) +
                          place_in_list.capacity() * sizeof(int));
}
