// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_ENGINE_OF_H
#define LMP_EEPA_CONTACT_ENGINE_OF_H

#include "contact_engine_kokkos.h"
#include "contact_kernel.h"
#include "wall_kernel.h"

#include <eepa/dispatch.h>

namespace LAMMPS_NS {

template <class DeviceType, class ContactLaw>
class ContactEngineKokkosOf final : public ContactEngineKokkos<DeviceType> {
 public:
  void add_forces(const ContactStep<DeviceType> &step) const override
  {
    // a law takes up to 128 of the 65536 registers of a multiprocessor
    using Policy = Kokkos::RangePolicy<DeviceType, Kokkos::LaunchBounds<128, 4>>;
    Kokkos::parallel_for("gran/eepa", Policy(0, step.inum),
                         ContactKernel<DeviceType, ContactLaw, false>(step));
  }
  StepSums add_forces_and_tally(const ContactStep<DeviceType> &step) const override
  {
    StepSums sums;
    Kokkos::parallel_reduce("gran/eepa:tally", Kokkos::RangePolicy<DeviceType>(0, step.inum),
                            ContactKernel<DeviceType, ContactLaw, true>(step), sums);
    return sums;
  }

  WallSums add_wall_forces(const WallStep<DeviceType> &step) const override
  {
    WallSums sums;
    Kokkos::parallel_reduce("gran/eepa:wall",
                            Kokkos::RangePolicy<DeviceType>(0, step.rows.candidates),
                            WallKernel<DeviceType, ContactLaw, false>(step), sums);
    return sums;
  }
  WallTallies add_wall_forces_and_tally(const WallStep<DeviceType> &step) const override
  {
    WallTallies sums;
    Kokkos::parallel_reduce("gran/eepa:wall_tally",
                            Kokkos::RangePolicy<DeviceType>(0, step.rows.candidates),
                            WallKernel<DeviceType, ContactLaw, true>(step), sums);
    return sums;
  }
};

template <eepa::RollingModel rolling, class DeviceType>
MadeEngine<DeviceType> make_engine_with_rolling(const eepa::LawSettings &settings,
                                                eepa::TwistingModel twisting)
{
  return eepa::with_law(settings, rolling, twisting, [](auto law) -> MadeEngine<DeviceType> {
    using ContactLaw = decltype(law);
    if constexpr (ContactLaw::Rolling::model == rolling)
      return std::make_unique<ContactEngineKokkosOf<DeviceType, ContactLaw>>();
    else
      return nullptr;
  });
}

}    // namespace LAMMPS_NS

#endif
