// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_STATUS_H
#define EEPA_STATUS_H

#include "contact_law.h"

namespace eepa {

/// Status of a contact, which a driver keeps as one integer beside each neighbour: 0 where there is
/// no contact, else its branch and whether it slides, as the last force call found them. LAMMPS's
/// neighbour-history fix only tests it for 0, and sets `touching` when it carries a contact over to
/// a new list.
namespace ContactStatus {
  constexpr int none = 0;
  constexpr int touching = 1;
  constexpr int branch_shift = 1;
  constexpr int branch_mask = 3;
  constexpr int sliding = 8;

  EEPA_FUNCTION int of(const Response &response)
  {
    return touching | (static_cast<int>(response.branch) << branch_shift) |
        (response.sliding ? sliding : 0);
  }
  EEPA_FUNCTION Branch branch(int status)
  {
    return static_cast<Branch>((status >> branch_shift) & branch_mask);
  }
  EEPA_FUNCTION bool slides(int status)
  {
    return (status & sliding) != 0;
  }

#ifdef EEPA_HAS_LANES
  /// The status of every lane. A branch is a double there, and its bits are added.
  /// \param[out] of_lane  one pointer for each lane
  EEPA_FUNCTION void store(const ResponseOf<Lanes> &response, const LanePointers<int> &of_lane)
  {
    namespace simd = std::experimental;
    Lanes status = Lanes(touching) + Lanes(1 << branch_shift) * response.branch;
    where(response.sliding, status) += Lanes(sliding);
    const auto whole = simd::static_simd_cast<simd::rebind_simd_t<int, Lanes>>(status);
    for (std::size_t lane = 0; lane < Lanes::size(); lane++) *of_lane[lane] = whole[lane];
  }
#endif
}    // namespace ContactStatus

}    // namespace eepa

#endif
