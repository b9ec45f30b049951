// SPDX-License-Identifier: GPL-2.0-only
#include "contact_history.h"

#include "atom.h"
#include "comm.h"
#include "modify.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

using namespace LAMMPS_NS;

namespace {
/// The name of LAMMPS's own fix: restart files say the same, whichever wrote them.
constexpr const char *style_name = "NEIGH_HISTORY";

/// Has LAMMPS make its fix NEIGH_HISTORY with another constructor as long as it lives.
class OtherCreator {
 public:
  OtherCreator(Modify *modify, Modify::FixCreator creator) :
      current((*modify->fix_map)[style_name]), lammps_own(current)
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

/// Of an ordered pair of IDs (the finaliser of splitmix64).
std::uint64_t hash(tagint a, tagint b)
{
  std::uint64_t h =
      static_cast<std::uint64_t>(a) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(b);
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
  return h ^ (h >> 31);
}
}    // namespace

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
      place_holder, fmt::format("{} all {} {}", id, style_name, values), 0));
  made->pair = contacts_of;
  return made;
}

void ContactHistory::post_run()
{
  FixNeighHistory::post_run();
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

bool ContactHistory::partners_are_mutual() const
{
  std::uint64_t mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal; i++)
    for (int m = 0; m < npartner[i]; m++)
      mine += hash(atom->tag[i], partner[i][m]) - hash(partner[i][m], atom->tag[i]);
  MPI_Allreduce(&mine, &all, 1, MPI_UINT64_T, MPI_SUM, world);
  return all == 0;
}

bool ContactHistory::keep_mutual_partners()
{
  if (partners_are_mutual()) return true;

  std::vector<tagint> mine;
  for (int i = 0; i < atom->nlocal; i++)
    if (npartner[i] > 0) mine.push_back(atom->tag[i]);
  const int n = static_cast<int>(mine.size());
  std::vector<int> sizes(comm->nprocs), starts(comm->nprocs, 0);
  MPI_Allgather(&n, 1, MPI_INT, sizes.data(), 1, MPI_INT, world);
  std::partial_sum(sizes.begin(), sizes.end() - 1, starts.begin() + 1);
  std::vector<tagint> known(starts.back() + sizes.back());
  MPI_Allgatherv(mine.data(), n, MPI_LMP_TAGINT, known.data(), sizes.data(), starts.data(),
                 MPI_LMP_TAGINT, world);
  std::sort(known.begin(), known.end());
  for (int i = 0; i < atom->nlocal; i++) {
    int kept = 0;
    for (int m = 0; m < npartner[i]; m++) {
      if (!std::binary_search(known.begin(), known.end(), partner[i][m])) continue;
      partner[i][kept] = partner[i][m];
      std::copy_n(valuepartner[i] + static_cast<std::ptrdiff_t>(dnum) * m, dnum,
                  valuepartner[i] + static_cast<std::ptrdiff_t>(dnum) * kept);
      kept++;
    }
    npartner[i] = kept;
  }
  return partners_are_mutual();
}
