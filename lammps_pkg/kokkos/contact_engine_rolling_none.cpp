// SPDX-License-Identifier: GPL-2.0-only
#include "contact_engine_of.h"

namespace LAMMPS_NS {
template MadeEngine<LMPDeviceType>
make_engine_with_rolling<eepa::RollingModel::none, LMPDeviceType>(const eepa::LawSettings &,
                                                                  eepa::TwistingModel);
#ifdef LMP_KOKKOS_GPU
template MadeEngine<LMPHostType>
make_engine_with_rolling<eepa::RollingModel::none, LMPHostType>(const eepa::LawSettings &,
                                                                eepa::TwistingModel);
#endif
}    // namespace LAMMPS_NS
