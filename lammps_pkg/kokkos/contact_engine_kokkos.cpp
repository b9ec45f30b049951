// SPDX-License-Identifier: GPL-2.0-only
#include "contact_engine_kokkos.h"

namespace LAMMPS_NS {

using eepa::LawSettings, eepa::RollingModel, eepa::TwistingModel;

template <class DeviceType>
MadeEngine<DeviceType> make_contact_engine_kokkos(const LawSettings &settings, RollingModel rolling,
                                                  TwistingModel twisting)
{
  switch (rolling) {
    case RollingModel::constant:
      return make_engine_with_rolling<RollingModel::constant, DeviceType>(settings, twisting);
    case RollingModel::sds:
      return make_engine_with_rolling<RollingModel::sds, DeviceType>(settings, twisting);
    case RollingModel::none:
      break;
  }
  return make_engine_with_rolling<RollingModel::none, DeviceType>(settings, twisting);
}

template MadeEngine<LMPDeviceType>
make_contact_engine_kokkos<LMPDeviceType>(const LawSettings &, RollingModel, TwistingModel);
#ifdef LMP_KOKKOS_GPU
template MadeEngine<LMPHostType>
make_contact_engine_kokkos<LMPHostType>(const LawSettings &, RollingModel, TwistingModel);
#endif

}    // namespace LAMMPS_NS
