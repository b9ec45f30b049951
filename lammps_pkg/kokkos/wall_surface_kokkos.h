// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_WALL_SURFACE_KOKKOS_H
#define LMP_EEPA_WALL_SURFACE_KOKKOS_H

#include "wall_step.h"

#include "contact_partners_kokkos.h"

#include <memory>

namespace eepa {
class MeshShape;
}

namespace LAMMPS_NS {

/// The shape of a wall on a device: what depends on it in a force call. The law does not.
template <class DeviceType> class WallSurfaceKokkos {
 public:
  using Step = WallStep<DeviceType>;

  virtual ~WallSurfaceKokkos() = default;

  /// Most contacts that a particle can have.
  virtual int most_contacts() const = 0;
  /// Makes the list of particles that may touch the shape or have touched it, and their slots, which are empty.
  /// \param particles  of this process
  virtual void collect(WallRows<DeviceType> &, const Step &, const PartnerLists<DeviceType> &,
                       int particles) = 0;
  /// A particle that got from one side of the surface to the other in this step, or -1.
  virtual int one_behind(const Step &, int particles) const = 0;
  /// Finds the contacts of all candidates, and their histories.
  virtual void find(const Step &) const = 0;
};

template <class DeviceType> using MadeSurface = std::unique_ptr<WallSurfaceKokkos<DeviceType>>;

/// The shape for a device; nullptr where it has none.
template <class DeviceType> MadeSurface<DeviceType> make_wall_surface(const eepa::Shape &);
template <class DeviceType> MadeSurface<DeviceType> make_wall_mesh(const eepa::MeshShape &);

}    // namespace LAMMPS_NS

#endif
