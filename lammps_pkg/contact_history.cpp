// SPDX-License-Identifier: GPL-2.0-only
#include "contact_history.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "modify.h"
#include "my_page.h"
#include "neighbor.h"

#include <algorithm>
#include <numeric>

using namespace LAMMPS_NS;

namespace {
/// The name of LAMMPS's own fix: restart files say the same, whichever wrote them.
constexpr const char *fix_style = "NEIGH_HISTORY";

/// Has LAMMPS make its fix NEIGH_HISTORY with another constructor as long as it lives.
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

ContactHistory::ContactHistory(LAMMPS *lmp, int narg, char **arg) :
    FixNeighHistory(lmp, narg, arg), owner(atom->nmax, 0)
{
  std::copy_n(atom->tag, atom->nlocal, owner.begin());
}

Fix *ContactHistory::make(LAMMPS *lmp, int narg, char **arg)
{
  return new ContactHistory(lmp, narg, arg);
}

ContactHistory *ContactHistory::replace(LAMMPS *lmp, const std::string &place_holder,
                                        const std::string &id, int values, Pair *contacts_of)
{
  const OtherCreator creator(lmp->modify, &ContactHistory::make);
  // without a suffix: NEIGH_HISTORY/omp forgets contacts with ghosts with newton on
  auto *made = static_cast<ContactHistory *>(lmp->modify->replace_fix(
      place_holder, fmt::format("{} all {} {}", id, fix_style, values), 0));
  made->pair = contacts_of;
  return made;
}

/* ---------------------------------------------------------------------- which is newer */

void ContactHistory::force_is_computed()
{
  if (list_is_old)
    error->all(FLERR,
               "pair_style gran/eepa: run with pre no after a command that set the system up anew, "
               "such as write_restart: particles are no more where the neighbour list has them; "
               "leave pre no away");
  partners_are_newest = false;
}

void ContactHistory::end_interrupted_run()
{
  if (partners_are_newest) return;
  const int mine =
      !list_is_old && nlocal_neigh == atom->nlocal && nall_neigh == atom->nlocal + atom->nghost;
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
  // after `run 0 pre no` it may be: nothing was computed, and the partners are as they were
  if (!list_is_old) FixNeighHistory::post_run();
  partners_are_newest = true;
}

void ContactHistory::write_restart(FILE *fp)
{
  if (!partners_are_newest) {
    FixNeighHistory::write_restart(fp);
  } else if (comm->me == 0) {
    // as LAMMPS's fix has it: no state beside that of the particles
    const int size = 0;
    fwrite(&size, sizeof(int), 1, fp);
  }
}

void ContactHistory::init()
{
  if (ipage_atom && (pgsize != neighbor->pgsize || oneatom != neighbor->oneatom))
    keep_partners_in_new_pages();
  else
    FixNeighHistory::init();
  // whoever calls an init may go on to move particles to other processors, as write_restart does
  list_is_old = true;
}

/// After `neigh_modify one` or `page`, of which LAMMPS's fix says that they can lose history.
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
                 "neigh_modify one {} is less than the {} contacts that a particle has: allowed "
                 "are more",
                 neighbor->oneatom, n);
    std::copy_n(id, n, partner[i]);
    std::copy_n(value, dnum * n, valuepartner[i]);
    id += n;
    value += dnum * n;
  }
}

/* ---------------------------------------------------------------------- whose lists they are */

bool ContactHistory::ids_are_kept() const
{
  int mine = 1, all = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (npartner[i] > 0 && owner[i] != atom->tag[i]) mine = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, world);
  return all != 0;
}

void ContactHistory::pre_exchange()
{
  FixNeighHistory::pre_exchange();
  reserve_exchange();
  // those beyond are new: other fixes have just brought them
  std::copy_n(atom->tag, std::min(nlocal_neigh, atom->nlocal), owner.begin());
}

void ContactHistory::post_neighbor()
{
  forget_partners_with_new_ids();
  FixNeighHistory::post_neighbor();
  list_is_old = false;
}

/// A new particle may have the ID of one that is gone: it has no history with anybody.
void ContactHistory::forget_partners_with_new_ids()
{
  std::vector<tagint> mine;
  for (int i = 0; i < atom->nlocal; i++) {
    if (owner[i] != 0) continue;
    owner[i] = atom->tag[i];
    mine.push_back(owner[i]);
  }
  const int n = static_cast<int>(mine.size());
  std::vector<int> sizes(comm->nprocs), starts(comm->nprocs, 0);
  MPI_Allgather(&n, 1, MPI_INT, sizes.data(), 1, MPI_INT, world);
  std::partial_sum(sizes.begin(), sizes.end() - 1, starts.begin() + 1);
  std::vector<tagint> fresh(starts.back() + sizes.back());
  if (fresh.empty()) return;
  MPI_Allgatherv(mine.data(), n, MPI_LMP_TAGINT, fresh.data(), sizes.data(), starts.data(),
                 MPI_LMP_TAGINT, world);
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

/* ---------------------------------------------------------------------- going with a particle */

/// Numbers that a particle takes along, at most; LAMMPS's fix forgets particles that came to it.
void ContactHistory::reserve_exchange()
{
  maxexchange = (dnum + 1) * maxpartner + 2;
}

void ContactHistory::grow_arrays(int nmax)
{
  FixNeighHistory::grow_arrays(nmax);
  owner.resize(nmax, 0);
}

void ContactHistory::copy_arrays(int i, int j, int delflag)
{
  FixNeighHistory::copy_arrays(i, j, delflag);
  owner[j] = owner[i];
}

void ContactHistory::set_arrays(int i)
{
  FixNeighHistory::set_arrays(i);
  owner[i] = 0;
}

int ContactHistory::pack_exchange(int i, double *buf)
{
  const int m = FixNeighHistory::pack_exchange(i, buf);
  buf[m] = ubuf(owner[i]).d;
  return m + 1;
}

int ContactHistory::unpack_exchange(int i, double *buf)
{
  const int m = FixNeighHistory::unpack_exchange(i, buf);
  owner[i] = static_cast<tagint>(ubuf(buf[m]).i);
  reserve_exchange();
  return m + 1;
}

int ContactHistory::pack_restart(int i, double *buf)
{
  const int m = FixNeighHistory::pack_restart(i, buf);
  buf[m] = ubuf(owner[i]).d;
  buf[0] = m + 1;
  return m + 1;
}

void ContactHistory::unpack_restart(int i, int nth)
{
  FixNeighHistory::unpack_restart(i, nth);
  reserve_exchange();
  const double *entry = atom->extra[i];
  for (int k = 0; k < nth; k++) entry += static_cast<int>(*entry);
  // a file of LAMMPS's own fix would have no owner
  const int size = static_cast<int>(*entry);
  owner[i] = size == size_restart(i) ? static_cast<tagint>(ubuf(entry[size - 1]).i) : atom->tag[i];
}

int ContactHistory::size_restart(int i)
{
  return FixNeighHistory::size_restart(i) + 1;
}

int ContactHistory::maxsize_restart()
{
  return FixNeighHistory::maxsize_restart() + 1;
}

double ContactHistory::memory_usage()
{
  return FixNeighHistory::memory_usage() + static_cast<double>(owner.capacity() * sizeof(tagint));
}
