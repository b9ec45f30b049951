// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_STEP_H
#define LMP_EEPA_CONTACT_STEP_H

#include "contact_rows.h"
#include "particle_views.h"

#include "contact_engine.h"

#include <eepa/coefficients.h>
#include <eepa/dissipation.h>

namespace LAMMPS_NS {

/// Sums over the contacts of a force call.
struct StepSums {
  double energy = 0.0;    ///< recoverable, of LAMMPS's tally
  double virial[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  eepa::StoredEnergy elastic;    ///< of the ledger
  eepa::Dissipation dissipated;

  KOKKOS_INLINE_FUNCTION void add(const StepSums &other)
  {
    energy += other.energy;
    for (int k = 0; k < 6; k++) virial[k] += other.virial[k];
    elastic.add(other.elastic, 1.0);
    dissipated.add(other.dissipated, 1.0);
  }
};

/// What a step tallies beside forces.
struct StepTallies {
  bool energy = false, virial = false;                      ///< of all contacts
  bool energy_of_atoms = false, virial_of_atoms = false;    ///< of each particle
  bool ledger = false;
  bool losses_of_atoms = false;

  KOKKOS_INLINE_FUNCTION bool any_of_lammps() const
  {
    return energy || virial || energy_of_atoms || virial_of_atoms;
  }
};

/// A contact that is deeper than a radius. Both particles are in one number of 64 bits, so that one atomic store writes them.
struct DeepContact {
  static constexpr unsigned long long none = ~0ULL;

  KOKKOS_INLINE_FUNCTION static unsigned long long of(int i, int j)
  {
    return static_cast<unsigned long long>(i) << 32 | static_cast<unsigned>(j);
  }
  static int i_of(unsigned long long contact) { return static_cast<int>(contact >> 32); }
  static int j_of(unsigned long long contact) { return static_cast<int>(contact & 0xFFFFFFFFULL); }
};

/// All that a force call on a device reads and writes. It gathers bodies and scatters wrenches.
template <class DeviceType> struct ContactStep : ParticleViews<DeviceType> {
  using Arrays = ArrayTypes<DeviceType>;
  using typename ParticleViews<DeviceType>::Numbers;
  using ParticleViews<DeviceType>::mask, ParticleViews<DeviceType>::type,
      ParticleViews<DeviceType>::f, ParticleViews<DeviceType>::torque,
      ParticleViews<DeviceType>::freeze_groupbit, ParticleViews<DeviceType>::has_bodies;
  static constexpr bool on_gpu = ExecutionSpaceFromDevice<DeviceType>::space == Device;

  int inum = 0;    // of the neighbour list
  typename Arrays::t_int_1d ilist, numneigh;
  typename Arrays::t_neighbors_2d neighbors;
  ContactRows<DeviceType> rows;

  int written = 0;               // number of particles that get forces
  bool several_write = false;    // several threads may add to the same particle at once

  bool holds_some = false;    // as ContactMasses has it
  Numbers body;

  Kokkos::View<const eepa::Coefficients *, DeviceType> coefficients;    // by pair of types
  int stride = 0;
  double special[4] = {1.0, 1.0, 1.0, 1.0};

  StepRequest request;
  StepTallies tallies;
  typename Arrays::t_efloat_1d energy_of_atoms;
  typename Arrays::t_virial_array virial_of_atoms;
  Kokkos::View<double **, Kokkos::LayoutRight, DeviceType> losses_of_atoms;
  Kokkos::View<unsigned long long, DeviceType> deep;

  /// Whether two particles can not move each other.
  KOKKOS_INLINE_FUNCTION bool hold_together(int i, int j) const
  {
    if (!holds_some) return false;
    if (mask(i) & mask(j) & freeze_groupbit) return true;
    return has_bodies && body(i) != 0.0 && body(i) == body(j);
  }
  KOKKOS_INLINE_FUNCTION const eepa::Coefficients &coefficients_of(int i, int j) const
  {
    return coefficients(type(i) * stride + type(j));
  }
  /// Factor of special_bonds.
  KOKKOS_INLINE_FUNCTION double factor_of(int neighbor) const
  {
    return special[neighbor >> SBBITS & 3];
  }
  /// Part of a contact that this rank counts: with newton off, both ranks have a pair that crosses their boundary.
  KOKKOS_INLINE_FUNCTION double share_of(int j) const { return j < written ? 1.0 : 0.5; }

  KOKKOS_INLINE_FUNCTION void note_too_deep(int i, int j) const
  {
    Kokkos::atomic_store(&deep(), DeepContact::of(i, j));
  }
  /// Adds to a number that other threads may be adding to.
  template <class T> KOKKOS_INLINE_FUNCTION void add(T &to, double more) const
  {
    if (on_gpu || several_write)
      Kokkos::atomic_add(&to, static_cast<T>(more));
    else
      to += more;
  }
  KOKKOS_INLINE_FUNCTION void add_wrench(int j, const eepa::Vec3 &force,
                                         const eepa::Vec3 &moment) const
  {
    for (int k = 0; k < 3; k++) {
      add(f(j, k), force[k]);
      add(torque(j, k), moment[k]);
    }
  }

  /// Books the loss of the contact of i and j, as ContactSlice::book().
  KOKKOS_INLINE_FUNCTION void book(int i, int j, const eepa::Dissipation &lost, double factor,
                                   StepSums &sums) const
  {
    sums.dissipated.add(lost, factor * share_of(j));
    if (!tallies.losses_of_atoms) return;
    book_at(i, lost, 0.5 * factor);
    if (j < written) book_at(j, lost, 0.5 * factor);
  }
  KOKKOS_INLINE_FUNCTION void book_at(int i, const eepa::Dissipation &lost, double share) const
  {
    const eepa::Dissipation::Kinds kinds = lost.by_kind();
    for (int k = 0; k < kinds.count; k++) add(losses_of_atoms(i, k), share * kinds.value[k]);
  }

  /// Tallies a contact for LAMMPS, as Pair::ev_tally_xyz().
  KOKKOS_INLINE_FUNCTION void tally(int i, int j, double energy, const eepa::Vec3 &force,
                                    const eepa::Vec3 &offset, StepSums &sums) const
  {
    const double share = share_of(j);
    const double moments[6] = {offset[0] * force[0], offset[1] * force[1], offset[2] * force[2],
                               offset[0] * force[1], offset[0] * force[2], offset[1] * force[2]};
    if (tallies.energy) sums.energy += share * energy;
    if (tallies.virial)
      for (int k = 0; k < 6; k++) sums.virial[k] += share * moments[k];
    const int atoms[] = {i, j};
    for (const int atom : atoms) {
      if (atom >= written) continue;
      if (tallies.energy_of_atoms) add(energy_of_atoms(atom), 0.5 * energy);
      if (tallies.virial_of_atoms)
        for (int k = 0; k < 6; k++) add(virial_of_atoms(atom, k), 0.5 * moments[k]);
    }
  }
};

}    // namespace LAMMPS_NS

#endif
