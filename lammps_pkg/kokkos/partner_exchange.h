// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_PARTNER_EXCHANGE_H
#define LMP_EEPA_PARTNER_EXCHANGE_H

#include "contact_partners_kokkos.h"

namespace LAMMPS_NS {

// The loops of ContactPartnersKokkos over particles that go to another processor, with their partners.

/// A buffer of LAMMPS as a row of numbers.
template <class DeviceType>
using Numbers = Kokkos::View<X_FLOAT *, DeviceType, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

template <class DeviceType> Numbers<DeviceType> numbers_of(DAT::tdual_xfloat_2d &buffer)
{
  return Numbers<DeviceType>(buffer.template view<DeviceType>().data(),
                             buffer.extent(0) * buffer.extent(1));
}

KOKKOS_INLINE_FUNCTION X_FLOAT number_of(tagint integer)
{
  return d_ubuf(integer).d;
}
KOKKOS_INLINE_FUNCTION tagint integer_of(X_FLOAT number)
{
  return static_cast<tagint>(d_ubuf(number).i);
}

/// One number a particle comes first, where its numbers begin: owner, number of partners, ID and values of each.
constexpr int head_size = 2;

template <class DeviceType> struct SizeOfSent {
  PartnerLists<DeviceType> lists;
  typename ArrayTypes<DeviceType>::t_int_1d sendlist;
  Kokkos::View<int *, DeviceType> starts;
  int values;

  KOKKOS_INLINE_FUNCTION void operator()(int k, int &sum, bool is_final) const
  {
    if (is_final) starts(k) = sum;
    sum += head_size + lists.count(sendlist(k)) * (1 + values);
  }
};

template <class DeviceType> struct Pack {
  PartnerLists<DeviceType> lists;
  typename ArrayTypes<DeviceType>::t_int_1d sendlist, copylist;
  Kokkos::View<int *, DeviceType> starts;
  Numbers<DeviceType> buffer;
  int sent, values, quads;

  KOKKOS_INLINE_FUNCTION void operator()(int k) const
  {
    const int i = sendlist(k);
    int m = sent + starts(k);
    buffer(k) = number_of(m);
    buffer(m++) = number_of(lists.owner(i));
    buffer(m++) = number_of(lists.count(i));
    for (int n = 0; n < lists.count(i); n++) {
      const bigint at = lists.first(i) + n;
      buffer(m++) = number_of(lists.ids(at));
      for (int v = 0; v < values; v++) buffer(m++) = lists.quads(at * quads + v / 4).value[v % 4];
    }
    // the last particles fill the gaps; none of them is sent itself
    const int j = copylist(k);
    if (j < 0) return;
    lists.first(i) = lists.first(j);
    lists.count(i) = lists.count(j);
    lists.owner(i) = lists.owner(j);
  }
};

/// What arrived, from up to two processors.
template <class DeviceType> struct Arrivals {
  PartnerLists<DeviceType> lists;
  typename ArrayTypes<DeviceType>::t_int_1d indices;    // -1: goes to another processor
  Kokkos::View<int *, DeviceType> starts;
  Numbers<DeviceType> buffer;
  int received_first, numbers_first, values, quads;
  bigint used;

  KOKKOS_INLINE_FUNCTION int begin_of(int k) const
  {
    if (k < received_first) return static_cast<int>(integer_of(buffer(k)));
    return numbers_first + static_cast<int>(integer_of(buffer(numbers_first + k - received_first)));
  }
  KOKKOS_INLINE_FUNCTION int count_of(int k) const
  {
    return indices(k) < 0 ? 0 : static_cast<int>(integer_of(buffer(begin_of(k) + 1)));
  }
};

template <class DeviceType> struct PlaceArrivals : Arrivals<DeviceType> {
  KOKKOS_INLINE_FUNCTION void operator()(int k, int &sum, bool is_final) const
  {
    if (is_final) this->starts(k) = sum;
    sum += this->count_of(k);
  }
};

template <class DeviceType> struct Unpack : Arrivals<DeviceType> {
  KOKKOS_INLINE_FUNCTION void operator()(int k, int &most) const
  {
    const int i = this->indices(k), count = this->count_of(k), quads = this->quads;
    if (i < 0) return;
    most = eepa::max(most, count);
    int m = this->begin_of(k);
    const bigint first = this->used + this->starts(k);
    this->lists.first(i) = first;
    this->lists.count(i) = count;
    this->lists.owner(i) = integer_of(this->buffer(m));
    m += head_size;
    for (bigint at = first; at < first + count; at++) {
      this->lists.ids(at) = integer_of(this->buffer(m++));
      for (int q = 0; q < quads; q++) this->lists.quads(at * quads + q) = eepa::Quad{};
      for (int v = 0; v < this->values; v++)
        this->lists.quads(at * quads + v / 4).value[v % 4] = this->buffer(m++);
    }
  }
};

}    // namespace LAMMPS_NS

#endif
