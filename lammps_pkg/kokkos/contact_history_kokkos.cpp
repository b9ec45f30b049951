// SPDX-License-Identifier: GPL-2.0-only
#include "contact_history_kokkos.h"

#include "atom_kokkos.h"
#include "atom_masks.h"
#include "pair.h"

#include <algorithm>

using namespace LAMMPS_NS;

template <class DeviceType>
ContactHistoryKokkos<DeviceType>::ContactHistoryKokkos(LAMMPS *lmp, int narg, char **arg) :
    ContactHistory(lmp, narg, arg), host_list(lmp)
{
  // what this fix reads of particles it asks for itself
  kokkosable = 1;
  execution_space = Host;
  datamask_read = datamask_modify = EMPTY_MASK;
  host_list.copymode = 1;    // it does not own its arrays
  on_device.quads_of_slot = (dnum + 3) / 4;
}

template <class DeviceType>
Fix *ContactHistoryKokkos<DeviceType>::create(LAMMPS *lmp, int narg, char **arg)
{
  return new ContactHistoryKokkos(lmp, narg, arg);
}

template <class DeviceType>
ContactHistoryKokkos<DeviceType> *
ContactHistoryKokkos<DeviceType>::make(LAMMPS *lmp, const std::string &id, int values,
                                       Pair *contacts_of)
{
  return static_cast<ContactHistoryKokkos *>(
      ContactHistory::make(lmp, id, values, contacts_of, &create));
}

template <class DeviceType>
NeighList *ContactHistoryKokkos<DeviceType>::follow(NeighListKokkos<DeviceType> *list)
{
  device_list = list;
  return &host_list;
}

/* ---------------------------------------------------------------------- a new neighbour list */

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::pre_exchange()
{
  bring_to_host();
  atomKK->sync(Host, TAG_MASK);
  ContactHistory::pre_exchange();
}

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::post_neighbor()
{
  atomKK->sync(Host, TAG_MASK | X_MASK | RADIUS_MASK);
  copy_list_to_host();
  ContactHistory::post_neighbor();
  send_to_device();
}

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::post_integrate()
{
  if (!watches_radii()) return;
  atomKK->sync(Host, X_MASK | RADIUS_MASK);
  ContactHistory::post_integrate();
}

namespace {
/// The copy of a view on the host, which is the view itself where the host can reach it.
template <class View, class Mirror> void copy_to_host(const View &view, Mirror &mirror)
{
  mirror = Kokkos::create_mirror_view(view);
  Kokkos::deep_copy(mirror, view);
}

/// The first `count` elements of a view.
template <class View> auto beginning(const View &view, bigint count)
{
  return Kokkos::subview(view, std::make_pair(bigint{0}, count));
}

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
}    // namespace

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::copy_list_to_host()
{
  const NeighListKokkos<DeviceType> &list = *device_list;
  copy_to_host(list.d_ilist, ilist_on_host);
  copy_to_host(list.d_numneigh, numneigh_on_host);
  host_list.inum = list.inum;
  host_list.ilist = ilist_on_host.data();
  host_list.numneigh = numneigh_on_host.data();

  const auto atoms = list.d_numneigh.extent(0);
  if (on_device.first.extent(0) < atoms) {
    on_device.first =
        decltype(Rows::first)(Kokkos::view_alloc("eepa:first", Kokkos::WithoutInitializing), atoms);
    first_on_host = Kokkos::create_mirror_view(on_device.first);
  }
  slots = 0;
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = host_list.ilist[ii];
    first_on_host(i) = slots;
    slots += host_list.numneigh[i];
  }
  Kokkos::deep_copy(on_device.first, first_on_host);
  reserve_slots();

  Kokkos::parallel_for("eepa:pack_neighbors", Kokkos::RangePolicy<DeviceType>(0, list.inum),
                       PackNeighbors<DeviceType>{list.d_ilist, list.d_numneigh, list.d_neighbors,
                                                 on_device.first, neighbors});
  Kokkos::deep_copy(beginning(neighbors_on_host, slots), beginning(neighbors, slots));
  firstneigh_on_host.assign(atoms, nullptr);
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = host_list.ilist[ii];
    firstneigh_on_host[i] = neighbors_on_host.data() + first_on_host(i);
  }
  host_list.firstneigh = firstneigh_on_host.data();
}

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::reserve_slots()
{
  if (slots <= static_cast<bigint>(neighbors.extent(0))) return;
  const bigint reserved = slots + slots / 8;    // lists vary a little in size
  const auto without = [](const std::string &name) {
    return Kokkos::view_alloc(name, Kokkos::WithoutInitializing);
  };
  neighbors = decltype(neighbors)(without("eepa:neighbors"), reserved);
  on_device.status = decltype(Rows::status)(without("eepa:status"), reserved);
  on_device.quads =
      decltype(Rows::quads)(without("eepa:quads"), reserved * on_device.quads_of_slot);
  neighbors_on_host = Kokkos::create_mirror_view(neighbors);
  status_on_host = Kokkos::create_mirror_view(on_device.status);
  quads_on_host = Kokkos::create_mirror_view(on_device.quads);
}

/* ---------------------------------------------------------------------- between host and device */

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::send_to_device()
{
  const int quads = on_device.quads_of_slot;
  for (int ii = 0; ii < host_list.inum; ii++) {
    const int i = host_list.ilist[ii];
    for (int jj = 0; jj < host_list.numneigh[i]; jj++) {
      const bigint slot = first_on_host(i) + jj;
      eepa::Quad *quad = &quads_on_host(slot * quads);
      status_on_host(slot) = firstflag[i][jj];
      std::fill_n(quad, quads, eepa::Quad{});
      if (firstflag[i][jj] == eepa::ContactStatus::none) continue;
      const double *values = firstvalue[i] + static_cast<std::ptrdiff_t>(dnum) * jj;
      for (int k = 0; k < dnum; k++) quad[k / 4].value[k % 4] = values[k];
    }
  }
  Kokkos::deep_copy(beginning(on_device.status, slots), beginning(status_on_host, slots));
  Kokkos::deep_copy(beginning(on_device.quads, slots * quads),
                    beginning(quads_on_host, slots * quads));
  device_is_newer = false;
}

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::bring_to_host()
{
  if (!device_is_newer) return;
  device_is_newer = false;
  const int quads = on_device.quads_of_slot;
  Kokkos::deep_copy(beginning(status_on_host, slots), beginning(on_device.status, slots));
  Kokkos::deep_copy(beginning(quads_on_host, slots * quads),
                    beginning(on_device.quads, slots * quads));
  for (int ii = 0; ii < host_list.inum; ii++) {
    const int i = host_list.ilist[ii];
    for (int jj = 0; jj < host_list.numneigh[i]; jj++) {
      const bigint slot = first_on_host(i) + jj;
      firstflag[i][jj] = status_on_host(slot);
      double *values = firstvalue[i] + static_cast<std::ptrdiff_t>(dnum) * jj;
      const eepa::Quad *quad = &quads_on_host(slot * quads);
      for (int k = 0; k < dnum; k++) values[k] = quad[k / 4].value[k % 4];
    }
  }
}

template <class DeviceType> double ContactHistoryKokkos<DeviceType>::memory_usage()
{
  const double reserved = static_cast<double>(neighbors.extent(0));
  return ContactHistory::memory_usage() +
      reserved *
      static_cast<double>(2 * sizeof(int) + on_device.quads_of_slot * sizeof(eepa::Quad)) +
      static_cast<double>(on_device.first.extent(0) * sizeof(bigint));
}

namespace LAMMPS_NS {
template class ContactHistoryKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class ContactHistoryKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
