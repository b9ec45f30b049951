// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_HISTORY_KOKKOS_H
#define LMP_EEPA_CONTACT_HISTORY_KOKKOS_H

#include "contact_history_on_host.h"
#include "contact_partners_kokkos.h"
#include "contact_rows.h"

#include "kokkos_base.h"
#include "neigh_list_kokkos.h"

#include <vector>

namespace LAMMPS_NS {

/// Histories on a device. Between two neighbour lists they are there beside the list. When a new list is made they go
/// with their particles there, too, as LAMMPS's KOKKOS has it.
///
/// They come to the host, and are those of ContactHistory there, where LAMMPS itself works on the host: in set-ups,
/// restart files, insertion and deletion, exchange and sorting on the host. With newton on they do so at each new list,
/// for LAMMPS has no communication on a device that would bring them from a ghost to its particle.
///
/// LAMMPS's own fix for KOKKOS has none of ContactHistory's checks, reads no restart files, refuses newton on, and writes
/// beyond its arrays where a particle has more than 8 contacts.
template <class DeviceType>
class ContactHistoryKokkos : public ContactHistoryOnHost, public KokkosBase {
 public:
  static ContactHistoryKokkos *make(LAMMPS *, const std::string &id, int values,
                                    class Pair *contacts_of);

  /// Sets the neighbour list that LAMMPS makes on the device.
  /// \return the same list on the host, valid after bring_to_host()
  NeighList *follow(NeighListKokkos<DeviceType> *);

  /// Contacts on the device; valid until the next neighbour list.
  const ContactRows<DeviceType> &rows() const { return on_device; }
  /// Marks the contacts on the device as newer than those on the host.
  void device_has_changed() { device_is_newer = true; }
  /// Copies the neighbour list, statuses and histories to the host where those on the device are newer.
  void bring_to_host();

  void init() override;
  void post_integrate() override;
  void pre_exchange() override;
  void post_neighbor() override;
  double memory_usage() override;

  void grow_arrays(int) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;

  int pack_exchange_kokkos(const int &, DAT::tdual_xfloat_2d &, DAT::tdual_int_1d,
                           DAT::tdual_int_1d, ExecutionSpace) override;
  void unpack_exchange_kokkos(DAT::tdual_xfloat_2d &, DAT::tdual_int_1d &, int, int, int,
                              ExecutionSpace) override;
  void sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &) override;

 protected:
  void bring_partners_to_host() override;
  void change_partners_on_host() override;

 private:
  ContactHistoryKokkos(LAMMPS *, int, char **);
  static Fix *create(LAMMPS *, int, char **);
  void forget_newcomers();
  void make_rows();
  void copy_list_to_host();
  void collect_partners_on_host();
  void send_partners_to_device();
  void clear_absent();

  template <class View> using OnHost = typename View::HostMirror;
  using Rows = ContactRows<DeviceType>;

  NeighListKokkos<DeviceType> *device_list = nullptr;
  bigint slots = 0;    // in use
  Rows on_device;
  Kokkos::View<tagint *, DeviceType> device_list_ids;    // as list_ids

  // the neighbour list and its contacts on the host
  NeighList host_list;    // of the arrays that follow
  OnHost<typename ArrayTypes<DeviceType>::t_int_1d> ilist_on_host, numneigh_on_host;
  std::vector<int> neighbors_on_host;
  std::vector<int *> firstneigh_on_host;
  OnHost<decltype(Rows::first)> first_on_host;
  OnHost<decltype(Rows::status)> status_on_host;
  std::vector<double> values_on_host;
  bool list_is_on_host = false;
  bool device_is_newer = false;

  // lists of partners; those of the host are ContactHistory's
  ContactPartnersKokkos<DeviceType> partners;
  bool partners_are_on_host = true, partners_are_on_device = false;
};

}    // namespace LAMMPS_NS

#endif
