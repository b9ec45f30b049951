// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_PARTNERS_KOKKOS_H
#define LMP_EEPA_CONTACT_PARTNERS_KOKKOS_H

#include "contact_rows.h"

#include "kokkos_base.h"
#include "neigh_list_kokkos.h"

namespace LAMMPS_NS {

/// Lists of partners on a device. The lists lie in one pool, in any order and with gaps, so that particles are sorted
/// and change places without their histories being moved.
template <class DeviceType> struct PartnerLists {
  Kokkos::View<bigint *, DeviceType> first;    ///< of a particle's list
  Kokkos::View<int *, DeviceType> count;       ///< 0 also for places without a particle
  Kokkos::View<tagint *, DeviceType> owner;    ///< as in ContactHistory
  Kokkos::View<tagint *, DeviceType> ids;      ///< of partners
  Kokkos::View<eepa::Quad *, DeviceType> quads;
};

/// Histories on a device while neighbour lists change: they go with their particles, by the partner's ID.
template <class DeviceType> class ContactPartnersKokkos {
 public:
  using List = NeighListKokkos<DeviceType>;
  using Rows = ContactRows<DeviceType>;
  using Ids = Kokkos::View<tagint *, DeviceType>;
  using Lists = PartnerLists<DeviceType>;
  using Sorter = Kokkos::BinSort<KokkosBase::KeyViewType, KokkosBase::BinOp>;

  ContactPartnersKokkos(int values, int quads_of_contact) :
      values(values), quads_of_contact(quads_of_contact)
  {
  }

  /// Sets for how many particles there is room; new ones have no partners.
  void grow(int particles);
  /// Number of partners of the particle that has most of them.
  int most() const { return largest_count; }
  /// Whether one of the first particles is new. ContactHistory::owner says what that means.
  bool has_newcomers(int particles) const;

  /// Makes the lists from histories beside a neighbour list of `particles`, whose pairs occur once.
  void collect(const List &, const Rows &, const Ids &, int particles);
  /// Puts the histories beside a new neighbour list; all other slots are cleared.
  /// \param parting  also those of pairs that do not touch any more
  void put_beside(const List &, const Rows &, const typename ArrayTypes<DeviceType>::t_tagint_1d &,
                  bool parting) const;

  /// The lists, to be read.
  const Lists &all() const { return lists; }
  /// Makes room for new lists of so many partners, which the caller writes.
  const Lists &renew(bigint partners);

  // as LAMMPS asks of fixes, see KokkosBase
  int pack_exchange(int sent, DAT::tdual_xfloat_2d &buffer, DAT::tdual_int_1d &sendlist,
                    DAT::tdual_int_1d &copylist, ExecutionSpace);
  void unpack_exchange(DAT::tdual_xfloat_2d &buffer, DAT::tdual_int_1d &indices, int received,
                       int received_first, int numbers_first, ExecutionSpace);
  void sort(Sorter &);

  /// Copies of the lists, in memory of the host.
  struct OnHost {
    typename decltype(Lists::first)::HostMirror first;
    typename decltype(Lists::count)::HostMirror count;
    typename decltype(Lists::owner)::HostMirror owner;
    typename decltype(Lists::ids)::HostMirror ids;
    typename decltype(Lists::quads)::HostMirror quads;
  };
  /// Memory for as many particles as there is room for and `partners`.
  OnHost room_on_host(bigint partners) const;
  OnHost to_host() const;
  void from_host(const OnHost &, int most);

  double memory_usage() const;

 private:
  void reserve(bigint partners);

  int values, quads_of_contact;
  Lists lists;
  bigint used = 0;    // of the pool
  int largest_count = 0;
  Kokkos::View<int *, DeviceType> starts;    // of what is sent or arrives
};

}    // namespace LAMMPS_NS

#endif
