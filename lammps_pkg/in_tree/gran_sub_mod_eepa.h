/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifdef GRAN_SUB_MOD_CLASS
// clang-format off
GranSubModStyle(eepa,GranSubModNormalEepa,NORMAL);
GranSubModStyle(luding,GranSubModNormalLuding,NORMAL);
// clang-format on
#else

#ifndef LMP_GRAN_SUB_MOD_EEPA_H
#define LMP_GRAN_SUB_MOD_EEPA_H

#include "gran_sub_mod_normal.h"

#include <eepa/luding_law.h>

namespace LAMMPS_NS {
namespace Granular_NS {

  /// A normal law of the kernel for pair_style granular and fix wall/gran. It contains no physics.
  template <class NormalLaw> class GranSubModNormalKernel : public GranSubModNormal {
   public:
    GranSubModNormalKernel(class GranularModel *, class LAMMPS *);
    void mix_coeffs(double *, double *) override;
    void coeffs_to_local() override;
    double calculate_forces() override;
    void set_fncrit() override;

   private:
    eepa::Parameters read_parameters(const double *) const;
    /// Places in coeffs, behind those of the parameters.
    int dashpot_place() const { return num_coeffs - 2; }
    int diameter_place() const { return num_coeffs - 1; }

    eepa::Coefficients coefficients;
    double friction_bound = 0.0;    ///< what the friction coefficient multiplies
  };

  using GranSubModNormalEepa = GranSubModNormalKernel<eepa::LinearLaw<eepa::UnitExponent>>;
  using GranSubModNormalLuding = GranSubModNormalKernel<eepa::LudingLaw>;

}    // namespace Granular_NS
}    // namespace LAMMPS_NS

#endif
#endif
