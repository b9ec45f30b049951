// SPDX-License-Identifier: GPL-2.0-only
#include "partner_exchange.h"
#include "partner_lists.h"

#include <algorithm>
#include <string>

using namespace LAMMPS_NS;

namespace {
template <class View> View uninitialized(const std::string &name, bigint size)
{
  return View(Kokkos::view_alloc(name, Kokkos::WithoutInitializing), size);
}

/// The first `count` elements of a view.
template <class View> auto beginning(const View &view, bigint count)
{
  return Kokkos::subview(view, std::make_pair(bigint{0}, count));
}

template <class DeviceType> using Range = Kokkos::RangePolicy<DeviceType>;

/// Copies what was written in one space to where DeviceType reads it. LAMMPS does not mark its buffers as modified.
template <class DeviceType, class DualView> void bring_to(DualView &view, ExecutionSpace written)
{
  view.clear_sync_state();
  if (written == Device)
    view.template modify<LMPDeviceType>();
  else
    view.template modify<LMPHostType>();
  view.template sync<DeviceType>();
  view.clear_sync_state();
}
}    // namespace

/* ---------------------------------------------------------------------- memory */

template <class DeviceType> void ContactPartnersKokkos<DeviceType>::grow(int particles)
{
  if (lists.count.extent(0) == 0) {
    lists.first = decltype(lists.first)("eepa:partners:first", particles);
    lists.count = decltype(lists.count)("eepa:partners:count", particles);
    lists.owner = decltype(lists.owner)("eepa:partners:owner", particles);
    return;
  }
  Kokkos::resize(lists.first, particles);
  Kokkos::resize(lists.count, particles);
  Kokkos::resize(lists.owner, particles);
}

/// Makes room for partners behind those that are in use.
template <class DeviceType> void ContactPartnersKokkos<DeviceType>::reserve(bigint partners)
{
  const bigint needed = used + partners;
  if (needed <= static_cast<bigint>(lists.ids.extent(0))) return;
  const bigint reserved = needed + needed / 8;    // the number of contacts varies a little
  if (used == 0) {                                // first, so that there is never memory for both
    lists.ids = decltype(lists.ids)();
    lists.quads = decltype(lists.quads)();
  }
  auto ids = uninitialized<decltype(lists.ids)>("eepa:partners:ids", reserved);
  auto quads =
      uninitialized<decltype(lists.quads)>("eepa:partners:quads", reserved * quads_of_contact);
  if (used > 0) {
    Kokkos::deep_copy(beginning(ids, used), beginning(lists.ids, used));
    Kokkos::deep_copy(beginning(quads, used * quads_of_contact),
                      beginning(lists.quads, used * quads_of_contact));
  }
  lists.ids = ids;
  lists.quads = quads;
}

template <class DeviceType>
const PartnerLists<DeviceType> &ContactPartnersKokkos<DeviceType>::renew(bigint partners)
{
  used = 0;
  reserve(partners);
  used = partners;
  return lists;
}

template <class DeviceType> double ContactPartnersKokkos<DeviceType>::memory_usage() const
{
  return static_cast<double>(lists.first.span() * sizeof(bigint) +
                             lists.count.span() * sizeof(int) +
                             (lists.owner.span() + lists.ids.span()) * sizeof(tagint) +
                             lists.quads.span() * sizeof(eepa::Quad) + starts.span() * sizeof(int));
}

/* ---------------------------------------------------------------------- from and to a neighbour list */

template <class DeviceType>
bool ContactPartnersKokkos<DeviceType>::has_newcomers(int particles) const
{
  int found = 0;
  Kokkos::parallel_reduce("eepa:count_new", Range<DeviceType>(0, particles),
                          CountNew<DeviceType>{lists}, found);
  return found > 0;
}

template <class DeviceType>
void ContactPartnersKokkos<DeviceType>::collect(const List &list, const Rows &rows, const Ids &ids,
                                                int particles)
{
  const ListedContacts<DeviceType> listed(list, rows, lists, ids);
  Kokkos::deep_copy(lists.count, 0);
  Kokkos::parallel_for("eepa:count_partners", Range<DeviceType>(0, list.inum),
                       CountPartners<DeviceType>(listed, particles));
  bigint partners = 0;
  Kokkos::parallel_scan("eepa:place_partners", Range<DeviceType>(0, particles),
                        PlaceLists<DeviceType>{lists}, partners);
  Kokkos::parallel_reduce("eepa:most_partners", Range<DeviceType>(0, particles),
                          LargestCount<DeviceType>{lists}, Kokkos::Max<int>(largest_count));
  largest_count = std::max(largest_count, 0);    // of no particles it is the least integer
  used = 0;
  reserve(partners);
  used = partners;
  Kokkos::deep_copy(lists.count, 0);
  Kokkos::parallel_for(
      "eepa:fill_partners", Range<DeviceType>(0, list.inum),
      FillLists<DeviceType>(ListedContacts<DeviceType>(list, rows, lists, ids), particles));
  Kokkos::deep_copy(beginning(lists.owner, particles), beginning(ids, particles));
}

template <class DeviceType>
void ContactPartnersKokkos<DeviceType>::put_beside(
    const List &list, const Rows &rows, const typename ArrayTypes<DeviceType>::t_tagint_1d &ids,
    bool parting) const
{
  Kokkos::parallel_for(
      "eepa:put_histories", Range<DeviceType>(0, list.inum),
      PutBeside<DeviceType>(ListedContacts<DeviceType>(list, rows, lists, ids), parting));
}

/* ---------------------------------------------------------------------- going with a particle */

template <class DeviceType>
int ContactPartnersKokkos<DeviceType>::pack_exchange(int sent, DAT::tdual_xfloat_2d &buffer,
                                                     DAT::tdual_int_1d &sendlist,
                                                     DAT::tdual_int_1d &copylist,
                                                     ExecutionSpace space)
{
  sendlist.template sync<DeviceType>();
  copylist.template sync<DeviceType>();
  const auto sent_particles = sendlist.template view<DeviceType>();
  if (static_cast<int>(starts.extent(0)) < sent)
    starts = uninitialized<decltype(starts)>("eepa:partners:starts", sent + sent / 8);
  int numbers = 0;
  Kokkos::parallel_scan("eepa:size_of_sent", Range<DeviceType>(0, sent),
                        SizeOfSent<DeviceType>{lists, sent_particles, starts, values}, numbers);
  numbers += sent;

  // LAMMPS has made room for as many as maxexchange says, and keeps pointers to it
  if (static_cast<bigint>(buffer.extent(0) * buffer.extent(1)) < numbers)
    Kokkos::abort("gran/eepa/kk: particles take more contacts along than was reserved");
  Kokkos::parallel_for("eepa:pack_partners", Range<DeviceType>(0, sent),
                       Pack<DeviceType>{lists, sent_particles, copylist.template view<DeviceType>(),
                                        starts, numbers_of<DeviceType>(buffer), sent, values,
                                        quads_of_contact});
  DeviceType().fence();
  constexpr auto own = ExecutionSpaceFromDevice<DeviceType>::space;
  if (space != own) {
    if (space == Device)
      bring_to<LMPDeviceType>(buffer, own);
    else
      bring_to<LMPHostType>(buffer, own);
  }
  return numbers;
}

template <class DeviceType>
void ContactPartnersKokkos<DeviceType>::unpack_exchange(DAT::tdual_xfloat_2d &buffer,
                                                        DAT::tdual_int_1d &indices, int received,
                                                        int received_first, int numbers_first,
                                                        ExecutionSpace space)
{
  if (space != ExecutionSpaceFromDevice<DeviceType>::space) {
    bring_to<DeviceType>(buffer, space);
    bring_to<DeviceType>(indices, space);
  }
  if (static_cast<int>(starts.extent(0)) < received)
    starts = uninitialized<decltype(starts)>("eepa:partners:starts", received + received / 8);
  Arrivals<DeviceType> arrivals{lists,
                                indices.template view<DeviceType>(),
                                starts,
                                numbers_of<DeviceType>(buffer),
                                received_first,
                                numbers_first,
                                values,
                                quads_of_contact,
                                used};
  int partners = 0;
  Kokkos::parallel_scan("eepa:place_arrivals", Range<DeviceType>(0, received),
                        PlaceArrivals<DeviceType>{arrivals}, partners);
  reserve(partners);
  arrivals.lists = lists;
  int most = 0;
  Kokkos::parallel_reduce("eepa:unpack_partners", Range<DeviceType>(0, received),
                          Unpack<DeviceType>{arrivals}, Kokkos::Max<int>(most));
  used += partners;
  largest_count = std::max(largest_count, most);
}

namespace {
/// Sorts on the device, where LAMMPS always does.
template <class Sorter, class View> void sort_by(Sorter &sorter, const View &view)
{
  const auto sorted = Kokkos::create_mirror_view_and_copy(LMPDeviceType(), view);
  sorter.sort(LMPDeviceType(), sorted);
  if (sorted.data() != view.data()) Kokkos::deep_copy(view, sorted);
}
}    // namespace

template <class DeviceType> void ContactPartnersKokkos<DeviceType>::sort(Sorter &sorter)
{
  sort_by(sorter, lists.first);
  sort_by(sorter, lists.count);
  sort_by(sorter, lists.owner);
}

/* ---------------------------------------------------------------------- on the host */

// The copies are memory of their own also where the host could reach the device's: so tests of a host's back end find
// a copy that is missing.

template <class DeviceType>
typename ContactPartnersKokkos<DeviceType>::OnHost
ContactPartnersKokkos<DeviceType>::room_on_host(bigint partners) const
{
  OnHost host;
  host.first = Kokkos::create_mirror(lists.first);
  host.count = Kokkos::create_mirror(lists.count);
  host.owner = Kokkos::create_mirror(lists.owner);
  host.ids = decltype(host.ids)("eepa:partners:ids:host", partners);
  host.quads = decltype(host.quads)("eepa:partners:quads:host", partners * quads_of_contact);
  return host;
}

template <class DeviceType>
typename ContactPartnersKokkos<DeviceType>::OnHost
ContactPartnersKokkos<DeviceType>::to_host() const
{
  const OnHost host = room_on_host(used);
  Kokkos::deep_copy(host.first, lists.first);
  Kokkos::deep_copy(host.count, lists.count);
  Kokkos::deep_copy(host.owner, lists.owner);
  Kokkos::deep_copy(host.ids, beginning(lists.ids, used));
  Kokkos::deep_copy(host.quads, beginning(lists.quads, used * quads_of_contact));
  return host;
}

template <class DeviceType>
void ContactPartnersKokkos<DeviceType>::from_host(const OnHost &host, int most)
{
  const auto partners = static_cast<bigint>(host.ids.extent(0));
  used = 0;
  reserve(partners);
  used = partners;
  largest_count = most;
  Kokkos::deep_copy(lists.first, host.first);
  Kokkos::deep_copy(lists.count, host.count);
  Kokkos::deep_copy(lists.owner, host.owner);
  Kokkos::deep_copy(beginning(lists.ids, used), host.ids);
  Kokkos::deep_copy(beginning(lists.quads, used * quads_of_contact), host.quads);
}

namespace LAMMPS_NS {
template class ContactPartnersKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class ContactPartnersKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
