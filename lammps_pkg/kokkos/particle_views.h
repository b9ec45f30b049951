// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_PARTICLE_VIEWS_H
#define LMP_EEPA_PARTICLE_VIEWS_H

#include "atom_kokkos.h"
#include "contact_masses.h"
#include "kokkos_type.h"

#include <eepa/body.h>

#include <limits>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Particles on a device: gathers their bodies. Pair style and walls have it.
template <class DeviceType> struct ParticleViews {
  using Arrays = ArrayTypes<DeviceType>;
  using Numbers = Kokkos::View<double *, DeviceType>;

  typename Arrays::t_x_array x;
  typename Arrays::t_v_array v, omega;
  typename Arrays::t_float_1d radius, rmass;
  typename Arrays::t_int_1d type, mask;
  typename Arrays::t_f_array f, torque;

  bool has_bodies = false;    // as ContactMasses has it
  int freeze_groupbit = 0;
  double infinite = std::numeric_limits<double>::infinity();
  Numbers body_mass;

  /// Takes LAMMPS's arrays, which change with the number of particles, and which particles can not move.
  void take(const AtomKokkos &atom, const ContactMasses &masses, const Numbers &masses_of_bodies)
  {
    x = atom.k_x.template view<DeviceType>();
    v = atom.k_v.template view<DeviceType>();
    omega = atom.k_omega.template view<DeviceType>();
    radius = atom.k_radius.template view<DeviceType>();
    rmass = atom.k_rmass.template view<DeviceType>();
    type = atom.k_type.template view<DeviceType>();
    mask = atom.k_mask.template view<DeviceType>();
    f = atom.k_f.template view<DeviceType>();
    torque = atom.k_torque.template view<DeviceType>();
    has_bodies = masses.has_bodies();
    freeze_groupbit = masses.freeze_groupbit();
    body_mass = masses_of_bodies;
  }

  KOKKOS_INLINE_FUNCTION double mass(int i) const
  {
    if (mask(i) & freeze_groupbit) return infinite;
    return has_bodies && body_mass(i) > 0.0 ? body_mass(i) : static_cast<double>(rmass(i));
  }
  KOKKOS_INLINE_FUNCTION eepa::Vec3 centre_of(int i) const
  {
    return eepa::Vec3(x(i, 0), x(i, 1), x(i, 2));
  }
  KOKKOS_INLINE_FUNCTION eepa::Body<double> body_of(int i) const
  {
    return {centre_of(i), eepa::Vec3(v(i, 0), v(i, 1), v(i, 2)),
            eepa::Vec3(omega(i, 0), omega(i, 1), omega(i, 2)), radius(i), mass(i)};
  }
};

/// Copies numbers of the host to a device.
template <class T, class View>
void send_to_device(const std::vector<T> &numbers, const std::string &name, View &view)
{
  if (view.extent(0) != numbers.size())
    view = View(Kokkos::view_alloc(name, Kokkos::WithoutInitializing), numbers.size());
  Kokkos::deep_copy(view,
                    Kokkos::View<const T *, Kokkos::HostSpace, Kokkos::MemoryUnmanaged>(
                        numbers.data(), numbers.size()));
}

}    // namespace LAMMPS_NS

#endif
