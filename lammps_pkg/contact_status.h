// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_STATUS_H
#define LMP_EEPA_CONTACT_STATUS_H

#include <eepa/normal_law.h>

namespace LAMMPS_NS {

/// What the neighbour-history fix keeps beside each neighbour: 0 where there is no contact,
/// else the branch and whether it slides, as the last force call found them. The fix itself
/// only asks whether it is 0, and sets 1 when it carries a contact over to a new list.
namespace ContactStatus {
  constexpr int none = 0;
  constexpr int touching = 1;
  constexpr int branch_shift = 1;
  constexpr int branch_mask = 3;
  constexpr int sliding = 8;

  inline int of(eepa::Branch branch, bool slides)
  {
    return touching | (static_cast<int>(branch) << branch_shift) | (slides ? sliding : 0);
  }
  inline eepa::Branch branch(int status)
  {
    return static_cast<eepa::Branch>((status >> branch_shift) & branch_mask);
  }
}    // namespace ContactStatus

}    // namespace LAMMPS_NS

#endif
