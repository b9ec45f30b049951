// SPDX-License-Identifier: GPL-2.0-only
#include "wall_search.h"

#include <eepa_walls/cylinder.h>
#include <eepa_walls/mesh_shape.h>
#include <eepa_walls/planes.h>

using namespace LAMMPS_NS;

namespace {
/// Gives each candidate as many slots as there are contacts of one particle.
template <class DeviceType> struct PlaceEqualSlots {
  WallRows<DeviceType> rows;
  int room;

  KOKKOS_INLINE_FUNCTION void operator()(int c) const
  {
    rows.first(c) = static_cast<bigint>(c) * room;
    if (c < rows.candidates) rows.count(c) = 0;
  }
};

/// Planes and cylinders.
template <class DeviceType, class Surface>
class WallOfFewFaces final : public WallSurfaceOf<DeviceType, Surface> {
 public:
  using WallSurfaceOf<DeviceType, Surface>::WallSurfaceOf,
      WallSurfaceOf<DeviceType, Surface>::surface;
  using typename WallSurfaceOf<DeviceType, Surface>::Step;

  int most_contacts() const override { return surface.room(); }

  void collect(WallRows<DeviceType> &rows, const Step &step, const PartnerLists<DeviceType> &lists,
               int particles) override
  {
    this->collect_particles(rows, step, lists, particles);
    this->reserve_slots(rows, static_cast<bigint>(rows.candidates) * surface.room());
    Kokkos::parallel_for("eepa:place_wall_slots",
                         Kokkos::RangePolicy<DeviceType>(0, rows.candidates + 1),
                         PlaceEqualSlots<DeviceType>{rows, surface.room()});
  }
};
}    // namespace

template <class DeviceType>
MadeSurface<DeviceType> LAMMPS_NS::make_wall_surface(const eepa::Shape &shape)
{
  using PlanesSurface = WithoutLists<eepa::PlanesSurface>;
  using CylinderSurface = WithoutLists<eepa::CylinderSurface>;
  if (const auto *planes = dynamic_cast<const eepa::Planes *>(&shape))
    return std::make_unique<WallOfFewFaces<DeviceType, PlanesSurface>>(
        PlanesSurface(planes->surface()));
  if (const auto *cylinder = dynamic_cast<const eepa::Cylinder *>(&shape))
    return std::make_unique<WallOfFewFaces<DeviceType, CylinderSurface>>(
        CylinderSurface(cylinder->surface()));
  if (const auto *mesh = dynamic_cast<const eepa::MeshShape *>(&shape))
    return make_wall_mesh<DeviceType>(*mesh);
  return nullptr;
}

namespace LAMMPS_NS {
template MadeSurface<LMPDeviceType> make_wall_surface<LMPDeviceType>(const eepa::Shape &);
#ifdef LMP_KOKKOS_GPU
template MadeSurface<LMPHostType> make_wall_surface<LMPHostType>(const eepa::Shape &);
#endif
}    // namespace LAMMPS_NS
