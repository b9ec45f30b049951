// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_WALL_HISTORIES_KOKKOS_H
#define LMP_EEPA_WALL_HISTORIES_KOKKOS_H

#include "contact_partners_kokkos.h"
#include "wall_surface_kokkos.h"

#include <eepa_walls/face_histories.h>

namespace LAMMPS_NS {

/// Histories of a wall's contacts, on a device and on the host. On the device they lie beside the candidates between two
/// collections, and in lists by particle while particles move in memory: a face is there what a partner is in a pair.
/// Each copy is made when it is asked for, from one that is valid.
template <class DeviceType> class WallHistoriesKokkos {
 public:
  using Partners = ContactPartnersKokkos<DeviceType>;

  /// \param on_host  those of the fix
  /// \param size  number of values of a history
  /// \param most  contacts of a particle
  WallHistoriesKokkos(eepa::FaceHistories &on_host, int size, int most);

  /// Sets for how many particles there is room.
  void grow(int particles) { lists.grow(particles); }
  /// Numbers that a particle takes along at most.
  int most_exchanged() const;

  /// Brings them to the host. \param particles  of this process
  void bring_to_host(int particles);
  /// The same, where they change next.
  void change_on_host(int particles);
  /// Puts them beside the candidates of a new collection.
  void put_beside(WallSurfaceKokkos<DeviceType> &, const WallStep<DeviceType> &, int particles);
  /// Beside candidates, where the force call changes them.
  const WallRows<DeviceType> &rows() const { return beside; }
  void force_call_changes_them() { lists_are_valid = host_is_valid = false; }
  /// By particle, which are about to move.
  Partners &change_lists();

  double memory_usage() const;

 private:
  void make_lists();
  void lists_from_rows();
  void lists_from_host();

  eepa::FaceHistories &host;
  const int size, most;
  Partners lists;
  WallRows<DeviceType> beside;
  bool host_is_valid = true, lists_are_valid = false, rows_are_valid = false;
};

}    // namespace LAMMPS_NS

#endif
