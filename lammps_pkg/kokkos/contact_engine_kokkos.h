// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_ENGINE_KOKKOS_H
#define LMP_EEPA_CONTACT_ENGINE_KOKKOS_H

#include "contact_step.h"
#include "wall_step.h"

#include <eepa/parameters.h>

#include <memory>

namespace LAMMPS_NS {

/// What depends on the law in a force call on a device; made once a run, as ContactEngine is on the host.
template <class DeviceType> class ContactEngineKokkos {
 public:
  virtual ~ContactEngineKokkos() = default;

  /// Finds and evaluates all contacts, in a step that asks for forces and nothing else.
  virtual void add_forces(const ContactStep<DeviceType> &) const = 0;
  /// The same with all that a step or a set-up may ask for.
  virtual StepSums add_forces_and_tally(const ContactStep<DeviceType> &) const = 0;

  /// The same for contacts with a wall, which its surface has found.
  virtual WallSums add_wall_forces(const WallStep<DeviceType> &) const = 0;
  virtual WallTallies add_wall_forces_and_tally(const WallStep<DeviceType> &) const = 0;
};

template <class DeviceType>
using MadeEngine = std::unique_ptr<const ContactEngineKokkos<DeviceType>>;

/// Makes the engine of the chosen law.
template <class DeviceType>
MadeEngine<DeviceType> make_contact_engine_kokkos(const eepa::LawSettings &, eepa::RollingModel,
                                                  eepa::TwistingModel);

/// Makes the engine of a law with one rolling model. Each model has a source file of its own: compilers for GPUs take
/// minutes for each.
template <eepa::RollingModel, class DeviceType>
MadeEngine<DeviceType> make_engine_with_rolling(const eepa::LawSettings &, eepa::TwistingModel);

}    // namespace LAMMPS_NS

#endif
