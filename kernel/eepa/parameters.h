// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_PARAMETERS_H
#define EEPA_PARAMETERS_H

#include "macros.h"

namespace eepa {

/// The normal law. There is no default: the user names one.
enum class Law { plateau, linear, luding };

/// How a contact resists rolling.
enum class RollingModel { none, constant, sds };

/// How a contact resists twisting, that is relative spin about its normal.
enum class TwistingModel { none, marshall };

/// What bounds the tangential force.
enum class FrictionBound {
  adhesive,    ///< the law's own bound, to which adhesion adds
  contact      ///< mu max(f_hys, 0)
};

/// How the dashpots are given.
enum class Damping { restitution, viscous };

/// Settings of all contacts of a pair style or a wall.
struct LawSettings {
  Law law = Law::linear;
  double exponent = 1.0;              ///< n of the linear law, [1, 2]; 1 for the others
  bool scaled = false;                ///< whether coefficients scale with the contact's size
  double reference_diameter = 1.0;    ///< d_ref of the coefficients if scaled [length], > 0
  bool limit_damping = false;         ///< the normal dashpot adds no tension
};

/// Parameters of one pair of types as the user typed them, for particles of diameter d_ref.
///
/// Dimensions are for exponent n; [force/length] where n = 1.
struct Parameters {
  double k1 = 0.0;       ///< loading stiffness, > 0 [force/length^n]
  double k2 = 0.0;       ///< unloading and reloading stiffness, >= k1 [force/length^n]
  double k_adh = 0.0;    ///< adhesive stiffness, >= 0 [force/length^n]
  double f0 = 0.0;       ///< constant pull-off force, <= 0, negative attracts [force]
  double mu = 0.0;       ///< sliding friction, >= 0
  double depth = 0.0;    ///< phi_f, largest plastic overlap over 2 R*, (0, 1]; luding only
  FrictionBound bound = FrictionBound::adhesive;

  bool kt_given = false;
  double kt = 0.0;    ///< tangential stiffness, >= 0 [force/length]; 2/7 k1 if not given

  Damping damping = Damping::restitution;
  double restitution = 1.0;           ///< e in [0, 1]; 1 is no damping, 0 is critical
  double viscous_normal = 0.0;        ///< B_n, >= 0 [force time/length]
  double viscous_tangential = 0.0;    ///< B_t, >= 0 [force time/length]

  RollingModel rolling = RollingModel::none;
  double mu_r = 0.0;               ///< rolling friction, >= 0
  double kr = 0.0;                 ///< sds: rolling stiffness, >= 0 [force/length]
  double rolling_viscous = 0.0;    ///< sds: rolling dashpot, >= 0 [force time/length]

  TwistingModel twisting = TwistingModel::none;    ///< its coefficients are those of sliding
};

/// The tangential stiffness: as given, or 2/7 k1 (article, section 2).
EEPA_FUNCTION double tangential_stiffness(const Parameters &p)
{
  return p.kt_given ? p.kt : 2.0 / 7.0 * p.k1;
}

}    // namespace eepa

#endif
