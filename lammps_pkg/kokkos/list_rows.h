// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_LIST_ROWS_H
#define LMP_EEPA_LIST_ROWS_H

#include "neigh_list_kokkos.h"

namespace LAMMPS_NS {

// The loops of ContactHistoryKokkos over the rows of a neighbour list.

/// Gives each particle of a neighbour list its slots.
template <class DeviceType> struct PlaceSlots {
  typename ArrayTypes<DeviceType>::t_int_1d ilist, numneigh;
  Kokkos::View<bigint *, DeviceType> first;

  KOKKOS_INLINE_FUNCTION void operator()(int ii, bigint &sum, bool is_final) const
  {
    const int i = ilist(ii);
    if (is_final) first(i) = sum;
    sum += numneigh(i);
  }
};

/// Puts the rows of a neighbour list one after another.
template <class DeviceType> struct PackNeighbors {
  typename ArrayTypes<DeviceType>::t_int_1d ilist, numneigh;
  typename ArrayTypes<DeviceType>::t_neighbors_2d neighbors;
  Kokkos::View<bigint *, DeviceType> first;
  Kokkos::View<int *, DeviceType> packed;

  KOKKOS_INLINE_FUNCTION void operator()(int ii) const
  {
    const int i = ilist(ii);
    for (int jj = 0; jj < numneigh(i); jj++) packed(first(i) + jj) = neighbors(i, jj);
  }
};

}    // namespace LAMMPS_NS

#endif
