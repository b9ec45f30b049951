// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_ROWS_H
#define LMP_EEPA_CONTACT_ROWS_H

#include "kokkos_type.h"

#include <eepa/history.h>
#include <eepa/status.h>

namespace LAMMPS_NS {

/// Statuses and histories of contacts on a device, beside its neighbour list: one slot a neighbour, the slots of a
/// particle one after another. A history is one quad, or two: as much as a GPU reads at once from memory.
template <class DeviceType> struct ContactRows {
  Kokkos::View<bigint *, DeviceType> first;    ///< first slot of a particle
  Kokkos::View<int *, DeviceType> status;      ///< of a slot, see eepa::ContactStatus
  Kokkos::View<eepa::Quad *, DeviceType> quads;
  int quads_of_slot = 1;

  KOKKOS_INLINE_FUNCTION eepa::QuadRow<eepa::Quad> history(bigint slot) const
  {
    return {&quads(slot * quads_of_slot), 1};
  }
  /// A pair that does not touch: its history is 0, so that a new contact needs no test.
  KOKKOS_INLINE_FUNCTION void clear(bigint slot) const
  {
    status(slot) = eepa::ContactStatus::none;
    for (int k = 0; k < quads_of_slot; k++) quads(slot * quads_of_slot + k) = eepa::Quad{};
  }
};

}    // namespace LAMMPS_NS

#endif
