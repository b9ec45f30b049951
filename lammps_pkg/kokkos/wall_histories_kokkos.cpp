// SPDX-License-Identifier: GPL-2.0-only
#include "wall_histories_kokkos.h"

#include "partner_exchange.h"

#include <Kokkos_Profiling_ScopedRegion.hpp>

#include <algorithm>

using namespace LAMMPS_NS;

namespace {
constexpr int place_size = 4;    // normal and distance, before the values of a history

template <class DeviceType> struct RowsAndLists {
  WallRows<DeviceType> rows;
  PartnerLists<DeviceType> lists;
};

/// Gives each candidate with contacts its part of the pool.
template <class DeviceType> struct PlaceLists : RowsAndLists<DeviceType> {
  KOKKOS_INLINE_FUNCTION void operator()(int c, bigint &sum, bool is_final) const
  {
    const int i = this->rows.particle(c);
    if (is_final) {
      this->lists.first(i) = sum;
      this->lists.count(i) = this->rows.count(c);
    }
    sum += this->rows.count(c);
  }
};

template <class DeviceType> struct FillLists : RowsAndLists<DeviceType> {
  KOKKOS_INLINE_FUNCTION void operator()(int c) const
  {
    const int quads = this->rows.quads_of_slot;
    const bigint first = this->rows.first(c), at = this->lists.first(this->rows.particle(c));
    for (int m = 0; m < this->rows.count(c); m++) {
      this->lists.ids(at + m) = this->rows.face(first + m);
      for (int q = 0; q < quads; q++)
        this->lists.quads((at + m) * quads + q) = this->rows.quads((first + m) * quads + q);
    }
  }
};

template <class DeviceType> struct PutBesideCandidates : RowsAndLists<DeviceType> {
  KOKKOS_INLINE_FUNCTION void operator()(int c) const
  {
    const int quads = this->rows.quads_of_slot, i = this->rows.particle(c);
    const int room = static_cast<int>(this->rows.first(c + 1) - this->rows.first(c));
    const int count = this->lists.count(i) < room ? this->lists.count(i) : room;
    const bigint first = this->rows.first(c), at = this->lists.first(i);
    this->rows.count(c) = count;
    for (int m = 0; m < count; m++) {
      this->rows.face(first + m) = static_cast<int>(this->lists.ids(at + m));
      for (int q = 0; q < quads; q++)
        this->rows.quads((first + m) * quads + q) = this->lists.quads((at + m) * quads + q);
    }
  }
};
}    // namespace

template <class DeviceType>
WallHistoriesKokkos<DeviceType>::WallHistoriesKokkos(eepa::FaceHistories &on_host, int size,
                                                     int most) :
    host(on_host),
    size(size), most(most), lists(place_size + size, 1 + (size + 3) / 4)
{
  beside.quads_of_slot = 1 + (size + 3) / 4;
}

template <class DeviceType> int WallHistoriesKokkos<DeviceType>::most_exchanged() const
{
  return 1 + head_size + most * (1 + place_size + size);
}

template <class DeviceType> void WallHistoriesKokkos<DeviceType>::lists_from_rows()
{
  RowsAndLists<DeviceType> both{beside, lists.all()};
  Kokkos::deep_copy(both.lists.count, 0);
  const Kokkos::RangePolicy<DeviceType> range(0, beside.candidates);
  bigint contacts = 0;
  Kokkos::parallel_scan("eepa:place_wall_lists", range, PlaceLists<DeviceType>{both}, contacts);
  both.lists = lists.renew(contacts);
  Kokkos::parallel_for("eepa:fill_wall_lists", range, FillLists<DeviceType>{both});
}

/// Of all places: while LAMMPS exchanges particles on the device it has changed their number before it asks for what
/// goes with them.
template <class DeviceType> void WallHistoriesKokkos<DeviceType>::lists_from_host()
{
  const Kokkos::Profiling::ScopedRegion region("gran/eepa: wall histories to the device");
  const auto places = static_cast<int>(host.places());
  bigint contacts = 0;
  for (int i = 0; i < places; i++) contacts += static_cast<bigint>(host.list(i).size());
  auto copy = lists.room_on_host(contacts);
  Kokkos::deep_copy(copy.count, 0);
  Kokkos::deep_copy(copy.first, 0);
  Kokkos::deep_copy(copy.owner, 0);
  bigint at = 0;
  for (int i = 0; i < places; i++) {
    const auto &list = host.list(i);
    copy.first(i) = at;
    copy.count(i) = static_cast<int>(list.size());
    for (std::size_t m = 0; m < list.size(); m++, at++) {
      copy.ids(at) = list[m].face;
      eepa::Quad *quads = &copy.quads(at * beside.quads_of_slot);
      std::copy_n(list[m].normal.data(), 3, quads[0].value);
      quads[0].value[3] = list[m].distance;
      for (int k = 0; k < size; k++) quads[1 + k / 4].value[k % 4] = list[m].values[k];
    }
  }
  lists.from_host(copy, most);
}

template <class DeviceType> void WallHistoriesKokkos<DeviceType>::make_lists()
{
  if (lists_are_valid) return;
  if (rows_are_valid)
    lists_from_rows();
  else
    lists_from_host();
  lists_are_valid = true;
}

template <class DeviceType> void WallHistoriesKokkos<DeviceType>::bring_to_host(int particles)
{
  if (host_is_valid) return;
  make_lists();
  const Kokkos::Profiling::ScopedRegion region("gran/eepa: wall histories to the host");
  const auto copy = lists.to_host();
  for (int i = 0; i < static_cast<int>(host.places()); i++) host.clear(i);
  for (int i = 0; i < particles; i++) {
    for (int m = 0; m < copy.count(i); m++) {
      const eepa::Quad *quads = &copy.quads((copy.first(i) + m) * beside.quads_of_slot);
      eepa::FaceHistory contact;
      contact.face = static_cast<int>(copy.ids(copy.first(i) + m));
      contact.normal = eepa::Vec3(quads[0].value);
      contact.distance = quads[0].value[3];
      for (int k = 0; k < size; k++) contact.values[k] = quads[1 + k / 4].value[k % 4];
      host.mutable_list(i).push_back(contact);
    }
  }
  host_is_valid = true;
}

template <class DeviceType> void WallHistoriesKokkos<DeviceType>::change_on_host(int particles)
{
  bring_to_host(particles);
  lists_are_valid = rows_are_valid = false;
}

template <class DeviceType>
ContactPartnersKokkos<DeviceType> &WallHistoriesKokkos<DeviceType>::change_lists()
{
  make_lists();
  host_is_valid = rows_are_valid = false;
  return lists;
}

template <class DeviceType>
void WallHistoriesKokkos<DeviceType>::put_beside(WallSurfaceKokkos<DeviceType> &surface,
                                                 const WallStep<DeviceType> &step, int particles)
{
  make_lists();
  surface.collect(beside, step, lists.all(), particles);
  Kokkos::parallel_for("eepa:put_wall_histories",
                       Kokkos::RangePolicy<DeviceType>(0, beside.candidates),
                       PutBesideCandidates<DeviceType>{{beside, lists.all()}});
  rows_are_valid = true;
}

template <class DeviceType> double WallHistoriesKokkos<DeviceType>::memory_usage() const
{
  return lists.memory_usage() +
      static_cast<double>(
             (beside.particle.span() + beside.count.span() + beside.face.span()) * sizeof(int) +
             beside.first.span() * sizeof(bigint) + beside.quads.span() * sizeof(eepa::Quad));
}

namespace LAMMPS_NS {
template class WallHistoriesKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class WallHistoriesKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
