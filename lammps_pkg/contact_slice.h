// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_SLICE_H
#define LMP_EEPA_CONTACT_SLICE_H

#include "atom_losses.h"
#include "energy_ledger.h"

#include <eepa/vector.h>

#include <vector>

namespace LAMMPS_NS {

/// A pair that touches, as the search writes it. It is small, because most candidates are
/// overwritten by the next one.
struct TouchingPair {
  int i;
  int slot;    ///< of j among the neighbours of i
};

/// A pair that touches, with the data of the contact looked up.
struct FoundContact {
  int i, j;
  int *status;        ///< see eepa::ContactStatus
  double *history;    ///< see eepa::HistoryIndex
};

/// Force of a contact on a particle that another slice writes.
struct DeferredForce {
  int atom;
  eepa::Vec3 force, torque;    ///< on j
};

/// Loss of a contact at a particle that another slice writes.
struct DeferredLoss {
  int atom;
  eepa::Dissipation of_contact;
  double share;
};

/// A part of the neighbour list and of the atoms, processed by one thread; the whole without
/// threads.
struct ContactSlice {
  /// Contacts are found, fetched and evaluated in blocks small enough to stay in the cache.
  static constexpr int block = 64;

  int begin = 0, end = 0;                // slots in the neighbour list
  int first_atom = 0, atom_count = 0;    // range of atoms whose forces only this slice writes
  int deferrable = 0;                    // forces are deferred for atoms below this index
  std::vector<TouchingPair> touching;
  std::vector<FoundContact> contacts;     // of a block
  std::vector<DeferredForce> deferred;    // forces on atoms of other slices
  EnergyLedger ledger;                    // of this force call
  AtomLosses *atom_losses = nullptr;      // where they are kept
  std::vector<DeferredLoss> deferred_losses;
  int deep_i = -1, deep_j = -1;    // a contact deeper than a radius, if there is one

  double memory_usage() const
  {
    return static_cast<double>(touching.capacity() * sizeof(TouchingPair) +
                               contacts.capacity() * sizeof(FoundContact) +
                               deferred.capacity() * sizeof(DeferredForce) +
                               deferred_losses.capacity() * sizeof(DeferredLoss));
  }
  bool writes(int atom) const
  {
    return static_cast<unsigned>(atom - first_atom) < static_cast<unsigned>(atom_count);
  }
  /// Whether another slice writes the atom; else it is a ghost whose owner computes this contact,
  /// too.
  bool defers(int atom) const { return atom < deferrable; }

  /// Books the loss of the contact of i and j.
  /// \param factor  factor of special_bonds
  /// \param share  part of the loss that this rank sums
  void book(int i, int j, const eepa::Dissipation &lost, double factor, double share)
  {
    ledger.dissipated.add(lost, factor * share);
    if (!atom_losses) return;
    atom_losses->add(i, lost, 0.5 * factor);
    if (writes(j))
      atom_losses->add(j, lost, 0.5 * factor);
    else if (defers(j))
      deferred_losses.push_back({j, lost, 0.5 * factor});
  }

  /// Records a contact for which eepa::too_deep() holds: the run will stop.
  void note_too_deep(int i, int j)
  {
    deep_i = i;
    deep_j = j;
  }
};

}    // namespace LAMMPS_NS

#endif
