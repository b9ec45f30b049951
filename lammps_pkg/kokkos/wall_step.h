// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_WALL_STEP_H
#define LMP_EEPA_WALL_STEP_H

#include "contact_step.h"

#include <eepa/history.h>
#include <eepa_walls/placement.h>
#include <eepa_walls/shape.h>

namespace LAMMPS_NS {

/// A contact with a wall that was found in a force call, as geometry knows it.
struct WallTouch {
  eepa::WallPoint<double> wall;
  int face;
  int history;          ///< number of its history among those of the particle; -1 where it has none
  eepa::Vec3 normal;    ///< in the shape's frame
  double distance;      ///< [length]
};

/// Histories of a wall's contacts on a device, beside the particles that may touch it (candidates). Each candidate has
/// as many slots as it can have contacts. The first quad of a slot is where the centre was in the step before, normal
/// and distance; then comes the history.
template <class DeviceType> struct WallRows {
  int candidates = 0;
  bigint slots = 0;
  Kokkos::View<int *, DeviceType> particle;    ///< of a candidate
  Kokkos::View<bigint *, DeviceType> first;    ///< first slot of a candidate, and the end of all
  Kokkos::View<int *, DeviceType> count;       ///< contacts of a candidate in the step before
  Kokkos::View<int *, DeviceType> face;        ///< of a slot
  Kokkos::View<eepa::Quad *, DeviceType> quads;
  int quads_of_slot = 2;

  KOKKOS_INLINE_FUNCTION eepa::Quad &place(bigint slot) const
  {
    return quads(slot * quads_of_slot);
  }
  KOKKOS_INLINE_FUNCTION eepa::Vec3 normal(bigint slot) const
  {
    const eepa::Quad &quad = place(slot);
    return eepa::Vec3(quad.value[0], quad.value[1], quad.value[2]);
  }
  KOKKOS_INLINE_FUNCTION double distance(bigint slot) const { return place(slot).value[3]; }
  KOKKOS_INLINE_FUNCTION eepa::QuadRow<eepa::Quad> history(bigint slot) const
  {
    return {&quads(slot * quads_of_slot + 1), 1};
  }
  KOKKOS_INLINE_FUNCTION void copy(bigint from, bigint to) const
  {
    if (from == to) return;
    face(to) = face(from);
    for (int q = 0; q < quads_of_slot; q++)
      quads(to * quads_of_slot + q) = quads(from * quads_of_slot + q);
  }
};

/// Why a force call must stop: what, and the particle, in one number of which the largest counts.
struct WallStop {
  enum Reason : int { none, behind, too_deep, too_many };

  KOKKOS_INLINE_FUNCTION static bigint of(Reason reason, int i)
  {
    return static_cast<bigint>(reason) << 32 | i;
  }
  static Reason reason_of(bigint stop) { return static_cast<Reason>(stop >> 32); }
  static int particle_of(bigint stop) { return static_cast<int>(stop & 0xFFFFFFFFLL); }
};

/// Sums over the contacts with a wall.
struct WallSums {
  double force[2][3] = {{0.0, 0.0, 0.0},
                        {0.0, 0.0, 0.0}};    ///< on the wall's first and second plane
  double moment[3] = {0.0, 0.0, 0.0};        ///< on the wall
  double contacts = 0.0;
  double energy = 0.0;    ///< recoverable
  bigint stop = 0;        ///< see WallStop

  KOKKOS_INLINE_FUNCTION void add(const WallSums &other)
  {
    for (int k = 0; k < 3; k++) {
      force[0][k] += other.force[0][k];
      force[1][k] += other.force[1][k];
      moment[k] += other.moment[k];
    }
    contacts += other.contacts;
    energy += other.energy;
    stop = eepa::max(stop, other.stop);
  }
};

/// The same with all that a step may ask for.
struct WallTallies : WallSums {
  double power = 0.0;    ///< of the wall on particles
  StepSums of_contacts;

  KOKKOS_INLINE_FUNCTION void add(const WallTallies &other)
  {
    WallSums::add(other);
    power += other.power;
    of_contacts.add(other.of_contacts);
  }
};

/// Columns of the table that keyword `contacts` asks for, as FixWallGranEepa has them.
struct WallTable {
  enum {
    CONTACTS,
    FORCE,
    POINT = FORCE + 3,
    OVERLAP = POINT + 3,
    MAX_OVERLAP,
    BRANCH,
    SLIP,
    COLUMNS
  };
};

/// Makes room in a view, whose contents are lost.
template <class View> void reserve(View &view, const std::string &name, bigint size)
{
  if (size <= static_cast<bigint>(view.extent(0))) return;
  view = View();    // first, so that there is never memory for both
  view = View(Kokkos::view_alloc(name, Kokkos::WithoutInitializing), size + size / 8);
}
template <class Table>
void reserve_rows(Table &table, const std::string &name, int rows, int columns)
{
  if (rows > static_cast<int>(table.extent(0))) table = Table(name, rows, columns);
}

/// All that a force call of a wall reads and writes on a device.
template <class DeviceType> struct WallStep : ParticleViews<DeviceType> {
  using Rows = WallRows<DeviceType>;
  using Table = Kokkos::View<double **, Kokkos::LayoutRight, DeviceType>;

  Rows rows;
  eepa::RigidMotion motion;
  double surface_speed = 0.0, margin = 0.0;    // as FixWallGranEepa has them
  eepa::Coefficients coefficients;
  eepa::Vec3 about = eepa::Vec3::Zero();
  int groupbit = 0;    // 0 for all particles
  bool two_planes = false;

  StepRequest request;
  bool ledger = false, books_setup = false, virial = false, virial_of_atoms = false, table = false;
  bool losses_of_atoms = false;

  // what the search for contacts leaves for the law
  Kokkos::View<int *, DeviceType>
      found;    ///< contacts of a candidate; a WallStop::Reason less 100 where the run must stop
  Kokkos::View<unsigned *, DeviceType> kept;        ///< bit m: history m has a contact
  Kokkos::View<WallTouch *, DeviceType> touches;    ///< of a slot
  Kokkos::View<int *, DeviceType> parted;    ///< contacts of a candidate that are none any more
  Kokkos::View<WallTouch *, DeviceType> partings;    ///< two for a slot

  Table table_rows;     // of WallTable
  Table atom_losses;    // as Dissipation::by_kind()
  Table atom_virial;

  static constexpr int most_slots = 32;    ///< of a candidate: as many bits as `kept` has
  static constexpr int stops = -100;

  KOKKOS_INLINE_FUNCTION bool is_member(int i) const
  {
    return groupbit == 0 || (this->mask(i) & groupbit);
  }
  KOKKOS_INLINE_FUNCTION int room(int candidate) const
  {
    return static_cast<int>(rows.first(candidate + 1) - rows.first(candidate));
  }
  /// Velocity of a particle relative to the wall, times the step.
  KOKKOS_INLINE_FUNCTION eepa::Vec3 path_of(const eepa::Vec3 &x, const eepa::Vec3 &v) const
  {
    return request.time_step * (v - motion.velocity_at(x));
  }
};

}    // namespace LAMMPS_NS

#endif
