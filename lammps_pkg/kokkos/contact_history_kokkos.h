// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_HISTORY_KOKKOS_H
#define LMP_EEPA_CONTACT_HISTORY_KOKKOS_H

#include "contact_history.h"
#include "contact_rows.h"

#include "neigh_list_kokkos.h"

#include <vector>

namespace LAMMPS_NS {

/// Histories on a device. Between two neighbour lists they are there, beside the list. When a new list is made, they
/// come to the host, go with their particles there as ContactHistory has it, and return: restart files, processors,
/// insertion and deletion are those of the host's style.
///
/// LAMMPS's own fix for KOKKOS would leave the particles on the device, but has none of ContactHistory's checks, reads no
/// restart files, needs newton off, and writes beyond its arrays where a particle has more than 8 contacts.
template <class DeviceType> class ContactHistoryKokkos : public ContactHistory {
 public:
  static ContactHistoryKokkos *make(LAMMPS *, const std::string &id, int values,
                                    class Pair *contacts_of);

  /// Sets the neighbour list that LAMMPS makes on the device.
  /// \return the same list on the host, from the next list that is made on
  NeighList *follow(NeighListKokkos<DeviceType> *);

  /// Contacts on the device; valid until the next neighbour list.
  const ContactRows<DeviceType> &rows() const { return on_device; }
  /// Marks the contacts on the device as newer than those on the host.
  void device_has_changed() { device_is_newer = true; }
  /// Copies statuses and histories to the host where those on the device are newer.
  void bring_to_host();

  void post_integrate() override;
  void pre_exchange() override;
  void post_neighbor() override;
  double memory_usage() override;

 private:
  ContactHistoryKokkos(LAMMPS *, int, char **);
  static Fix *create(LAMMPS *, int, char **);
  void copy_list_to_host();
  void reserve_slots();
  void send_to_device();

  template <class View> using OnHost = typename View::HostMirror;
  using Rows = ContactRows<DeviceType>;

  NeighListKokkos<DeviceType> *device_list = nullptr;
  NeighList host_list;    // of the arrays that follow
  OnHost<typename ArrayTypes<DeviceType>::t_int_1d> ilist_on_host, numneigh_on_host;
  Kokkos::View<int *, DeviceType> neighbors;    // of all slots
  OnHost<Kokkos::View<int *, DeviceType>> neighbors_on_host;
  std::vector<int *> firstneigh_on_host;

  bigint slots = 0;    // in use
  Rows on_device;
  OnHost<decltype(Rows::first)> first_on_host;
  OnHost<decltype(Rows::status)> status_on_host;
  OnHost<decltype(Rows::quads)> quads_on_host;
  bool device_is_newer = false;
};

}    // namespace LAMMPS_NS

#endif
