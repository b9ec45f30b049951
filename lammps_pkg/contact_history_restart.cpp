// SPDX-License-Identifier: GPL-2.0-only

// How ContactHistory writes restart files, and checks them before it takes them up.

#include "contact_history.h"

#include <eepa_commands/restart_numbers.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "neigh_list.h"
#include "pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

using namespace LAMMPS_NS;

namespace {
/// Numbers of the law that made the histories, stored once for all particles.
enum LawNumbers { LAW, EXPONENT, N_LAW_NUMBERS };

/// Entry of a restart file for one particle, as LAMMPS's fix and this one write it: its size, the
/// number of partners, ID and values of each partner, and the tail.
class Entry {
 public:
  static constexpr int head_size = 2;

  /// \param extra  the entries of all fixes, one after another, `available` numbers
  Entry(const double *extra, int available, int nth)
  {
    int begin = 0, end = 0;
    for (int k = 0; k <= nth; k++) {
      begin = end;
      // a damaged size must not lead out of the array
      const double size = begin < available ? extra[begin] : 0.0;
      if (!(size >= 1.0 && size <= available - begin)) return;
      end = begin + static_cast<int>(size);
    }
    at_ = extra + begin;
    size_ = end - begin;
  }
  int size() const { return size_; }    ///< 0 where there is none
  double partners() const { return at_[1]; }
  double operator[](int k) const { return at_[k]; }
  const double *tail(int tail_size) const { return at_ + size_ - tail_size; }

 private:
  const double *at_ = nullptr;
  int size_ = 0;
};

tagint id_of(double stored)
{
  return static_cast<tagint>(ubuf(stored).i);
}
}    // namespace

/* ---------------------------------------------------------------------- for all particles */

void ContactHistory::write_restart(FILE *fp)
{
  if (!partners_are_newest) pre_exchange();
  if (comm->me != 0) return;
  std::array<double, N_LAW_NUMBERS> numbers;
  numbers[LAW] = static_cast<double>(made_by.law);
  numbers[EXPONENT] = made_by.exponent;
  const int bytes = sizeof(numbers);
  fwrite(&bytes, sizeof(int), 1, fp);
  fwrite(numbers.data(), sizeof(double), numbers.size(), fp);
}

void ContactHistory::restart(char *buf)
{
  std::array<double, N_LAW_NUMBERS> numbers;
  std::memcpy(numbers.data(), buf, sizeof(numbers));
  try {
    made_by.law = eepa::unpack_law(numbers[LAW]);
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "pair_style gran/eepa: {}", e.what());
  }
  made_by.exponent = numbers[EXPONENT];
  law_is_known = true;
  just_restarted = true;
}

void ContactHistory::go_on_with(const eepa::LawSettings &law)
{
  if (law_is_known && (law.law != made_by.law || law.exponent != made_by.exponent)) {
    bring_partners_to_host();
    bigint mine = 0, all = 0;
    for (int i = 0; i < atom->nlocal; i++) mine += npartner[i];
    MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
    if (all > 0 && comm->me == 0)
      error->warning(FLERR,
                     "pair_style gran/eepa: {} contacts have histories of the law {} with exponent "
                     "{} and go on with {} and exponent {}",
                     all / 2, eepa::entry_of(made_by.law).name, made_by.exponent, eepa::entry_of(law.law).name,
                     law.exponent);
  }
  made_by = law;
  law_is_known = true;
}

/* ---------------------------------------------------------------------- of each particle */

int ContactHistory::pack_restart(int i, double *buf)
{
  const int m = FixNeighHistory::pack_restart(i, buf);
  double *tail = buf + m;
  tail[TAIL_ID] = ubuf(atom->tag[i]).d;
  tail[TAIL_OWNER] = ubuf(owner[i]).d;
  tail[TAIL_VALUES] = dnum;
  buf[0] = m + TAIL_SIZE;
  return m + TAIL_SIZE;
}

int ContactHistory::size_restart(int i)
{
  return FixNeighHistory::size_restart(i) + TAIL_SIZE;
}

int ContactHistory::maxsize_restart()
{
  return FixNeighHistory::maxsize_restart() + TAIL_SIZE;
}

void ContactHistory::unpack_restart(int i, int nth)
{
  npartner[i] = 0;
  const Entry entry(atom->extra[i], atom->nextra_store, nth);
  const bool whole = entry.size() >= Entry::head_size + TAIL_SIZE;
  const double *tail = whole ? entry.tail(TAIL_SIZE) : nullptr;
  // the number of values a contact comes first, because reading depends on it
  const double n = whole ? entry.partners() : -1.0;
  const double values = whole ? tail[TAIL_VALUES] : 0.0;
  if (!(n >= 0.0) || !(values >= 1.0) ||
      entry.size() != Entry::head_size + n * (values + 1.0) + TAIL_SIZE) {
    misfit.damaged++;
    return;
  }
  if (values != dnum) {
    misfit.values = static_cast<int>(values);
    return;
  }
  if (id_of(tail[TAIL_ID]) != atom->tag[i]) {
    misfit.moved++;
    return;
  }
  for (int k = 0; k < n; k++) {
    const int at = Entry::head_size + k * (dnum + 1);
    bool sound = id_of(entry[at]) > 0;
    for (int v = 1; v <= dnum; v++) sound &= std::isfinite(entry[at + v]);
    if (sound) continue;
    misfit.damaged++;
    return;
  }
  FixNeighHistory::unpack_restart(i, nth);
  reserve_exchange();
  owner[i] = id_of(tail[TAIL_OWNER]);
}

/// Why the histories of a restart file can not be taken up, "" where they can. Collective.
std::string ContactHistory::what_does_not_fit() const
{
  const int mine[] = {misfit.values, misfit.moved, misfit.damaged};
  int all[3];
  MPI_Allreduce(mine, all, 3, MPI_INT, MPI_MAX, world);
  if (all[2] > 0)
    return "the restart file is damaged: histories of contacts have impossible numbers";
  if (all[0] > 0)
    return fmt::format("the restart file has {} values a contact and the pair_coeffs need {}; "
                       "rolling sds and twisting can not be switched on or off with a restart",
                       all[0], dnum);
  if (all[1] > 0)
    return "atoms were deleted, or given other IDs, after read_restart and before the first run: "
           "LAMMPS does not move the histories of the restart file with the atoms; put run 0 "
           "before that command, and use delete_atoms with compress no";
  return "";
}

/// Warns of histories of a restart file that have no pair in the first neighbour list. Contacts
/// touch, so that each has one, unless it belongs to another sub-style of hybrid. Collective.
/// \param stored  number of histories of this rank's particles
void ContactHistory::warn_of_lost_histories(bigint stored)
{
  just_restarted = false;
  bigint mine[] = {stored, 0}, all[2];
  for (int ii = 0; ii < pair->list->inum; ii++) {
    const int i = pair->list->ilist[ii];
    mine[1] += std::count(firstflag[i], firstflag[i] + pair->list->numneigh[i], 1);
  }
  MPI_Allreduce(mine, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all[0] > 0 && all[1] == 0 && comm->me == 0)
    error->warning(FLERR,
                   "pair_style gran/eepa: none of the {} contacts that the restart file has for "
                   "fix {} is one of this pair style, and all contacts start as new ones; "
                   "sub-styles of pair_style hybrid must be in the order of the first script",
                   all[0] / 2, id);
}
