// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_FIND_CONTACT_OWNERS_H
#define LMP_EEPA_FIND_CONTACT_OWNERS_H

#include "fix_wall_gran_eepa.h"
#include "pair_gran_eepa.h"

#include "error.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"

#include <vector>

namespace LAMMPS_NS {

/// Every pair style gran/eepa in use: none, one, or several as sub-styles of hybrid.
inline std::vector<PairGranEepa *> find_eepa_pairs(Force *force)
{
  std::vector<PairGranEepa *> found;
  // pair_match() returns the same style for every nth where there is only one, alone or in hybrid
  for (int nth = 1;; nth++) {
    auto *pair = dynamic_cast<PairGranEepa *>(force->pair_match("^gran/eepa", 0, nth));
    if (!pair || (!found.empty() && found.back() == pair)) break;
    found.push_back(pair);
  }
  return found;
}

/// Every fix wall/gran/eepa.
inline std::vector<FixWallGranEepa *> find_eepa_walls(Modify *modify)
{
  std::vector<FixWallGranEepa *> found;
  for (auto *fix : modify->get_fix_list())
    if (auto *wall = dynamic_cast<FixWallGranEepa *>(fix)) found.push_back(wall);
  return found;
}

/// Stops where a compute of energies has no contacts, or can not know the forces that act.
inline void require_contacts_of_eepa(const char *compute, LAMMPS *lmp)
{
  const bool pairs = !find_eepa_pairs(lmp->force).empty();
  if (!pairs && find_eepa_walls(lmp->modify).empty())
    lmp->error->all(FLERR, "{} needs pair_style gran/eepa or fix wall/gran/eepa", compute);
  if (pairs && utils::strmatch(lmp->force->pair_style, "^hybrid/scaled"))
    lmp->error->all(FLERR,
                    "{} can not be used with pair_style hybrid/scaled, which scales forces without "
                    "gran/eepa knowing by how much; use hybrid or hybrid/overlay",
                    compute);
}

}    // namespace LAMMPS_NS

#endif
