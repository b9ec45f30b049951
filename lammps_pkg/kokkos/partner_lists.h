// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_PARTNER_LISTS_H
#define LMP_EEPA_PARTNER_LISTS_H

#include "contact_partners_kokkos.h"

#include <eepa/status.h>

namespace LAMMPS_NS {

// The loops of ContactPartnersKokkos between a neighbour list and the lists of partners.

/// The arrays that the loops below read for each pair of a neighbour list.
template <class DeviceType> struct ListedContacts {
  typename ArrayTypes<DeviceType>::t_int_1d ilist, numneigh;
  typename ArrayTypes<DeviceType>::t_neighbors_2d neighbors;
  ContactRows<DeviceType> rows;
  PartnerLists<DeviceType> lists;
  typename ArrayTypes<DeviceType>::t_tagint_1d ids;

  ListedContacts(const NeighListKokkos<DeviceType> &list, const ContactRows<DeviceType> &rows,
                 const PartnerLists<DeviceType> &lists,
                 const typename ArrayTypes<DeviceType>::t_tagint_1d &ids) :
      ilist(list.d_ilist),
      numneigh(list.d_numneigh), neighbors(list.d_neighbors), rows(rows), lists(lists), ids(ids)
  {
  }
};

template <class DeviceType> struct CountPartners : ListedContacts<DeviceType> {
  int particles;

  CountPartners(const ListedContacts<DeviceType> &listed, int particles) :
      ListedContacts<DeviceType>(listed), particles(particles)
  {
  }
  KOKKOS_INLINE_FUNCTION void operator()(int ii) const
  {
    const int i = this->ilist(ii);
    int own = 0;
    for (int jj = 0; jj < this->numneigh(i); jj++) {
      if (this->rows.status(this->rows.first(i) + jj) == eepa::ContactStatus::none) continue;
      own++;
      const int j = this->neighbors(i, jj) & NEIGHMASK;
      if (j < particles) Kokkos::atomic_inc(&this->lists.count(j));
    }
    if (own > 0) Kokkos::atomic_add(&this->lists.count(i), own);
  }
};

/// Gives each particle its part of the pool.
template <class DeviceType> struct PlaceLists {
  PartnerLists<DeviceType> lists;

  KOKKOS_INLINE_FUNCTION void operator()(int i, bigint &sum, bool is_final) const
  {
    if (is_final) lists.first(i) = sum;
    sum += lists.count(i);
  }
};

template <class DeviceType> struct LargestCount {
  PartnerLists<DeviceType> lists;

  KOKKOS_INLINE_FUNCTION void operator()(int i, int &most) const
  {
    most = eepa::max(most, lists.count(i));
  }
};

template <class DeviceType> struct FillLists : ListedContacts<DeviceType> {
  int particles;

  FillLists(const ListedContacts<DeviceType> &listed, int particles) :
      ListedContacts<DeviceType>(listed), particles(particles)
  {
  }
  KOKKOS_INLINE_FUNCTION void operator()(int ii) const
  {
    const int i = this->ilist(ii);
    for (int jj = 0; jj < this->numneigh(i); jj++) {
      const bigint slot = this->rows.first(i) + jj;
      if (this->rows.status(slot) == eepa::ContactStatus::none) continue;
      const int j = this->neighbors(i, jj) & NEIGHMASK;
      add(i, j, slot, 1.0);
      // as LAMMPS does where two particles change places
      if (j < particles) add(j, i, slot, -1.0);
    }
  }

 private:
  KOKKOS_INLINE_FUNCTION void add(int of, int partner, bigint slot, double sign) const
  {
    const int quads = this->rows.quads_of_slot;
    const bigint at = this->lists.first(of) + Kokkos::atomic_fetch_add(&this->lists.count(of), 1);
    this->lists.ids(at) = this->ids(partner);
    for (int q = 0; q < quads; q++)
      for (int k = 0; k < 4; k++)
        this->lists.quads(at * quads + q).value[k] =
            sign * this->rows.quads(slot * quads + q).value[k];
  }
};

template <class DeviceType> struct PutBeside : ListedContacts<DeviceType> {
  bool parting;

  PutBeside(const ListedContacts<DeviceType> &listed, bool parting) :
      ListedContacts<DeviceType>(listed), parting(parting)
  {
  }
  KOKKOS_INLINE_FUNCTION void operator()(int ii) const
  {
    const int i = this->ilist(ii), partners = this->lists.count(i);
    const int quads = this->rows.quads_of_slot;
    const bigint list = this->lists.first(i);
    for (int jj = 0; jj < this->numneigh(i); jj++) {
      const bigint slot = this->rows.first(i) + jj;
      this->rows.clear(slot);
      const int neighbor = this->neighbors(i, jj);
      // LAMMPS marks the pairs that touch
      if (partners == 0 || !(parting || (neighbor >> HISTBITS & 1))) continue;
      const tagint id = this->ids(neighbor & NEIGHMASK);
      for (bigint at = list; at < list + partners; at++) {
        if (this->lists.ids(at) != id) continue;
        this->rows.status(slot) = eepa::ContactStatus::
            touching;    // as LAMMPS's fix; the next force call writes what it is
        for (int q = 0; q < quads; q++)
          this->rows.quads(slot * quads + q) = this->lists.quads(at * quads + q);
        break;
      }
    }
  }
};

template <class DeviceType> struct CountNew {
  PartnerLists<DeviceType> lists;

  KOKKOS_INLINE_FUNCTION void operator()(int i, int &found) const
  {
    if (lists.owner(i) == 0) found++;
  }
};

}    // namespace LAMMPS_NS

#endif
