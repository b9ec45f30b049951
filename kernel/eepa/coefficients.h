// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COEFFICIENTS_H
#define EEPA_COEFFICIENTS_H

#include "parameters.h"
#include "real.h"

#include <cmath>

namespace eepa {

/// Coefficients that the force loop reads for one pair of types: the parameters at d_ref, and what
/// derives from them and is the same for all contacts of these types.
/// \tparam Number  double; or Lanes, for contacts of several pairs of types side by side
template <class Number> struct CoefficientsOf {
  Number k1, k2, k_adh, f0;      ///< as in Parameters
  Number mu, kt;                 ///< as in Parameters, kt resolved
  Number depth;                  ///< as in Parameters
  Number contact_bound;          ///< 1 for FrictionBound::contact, else 0
  Number inverse_kt;             ///< 1/kt; 0 where kt = 0
  Number plastic_fraction;       ///< linear: (delta_p/delta_max)^n = 1 - k1/k2; plateau: k1/k2
  Number adhesive_memory;        ///< linear: delta_max/delta on the adhesive branch, >= 1
  Number restitution_damping;    ///< B_n / sqrt(m* k1), [0, 2]; 0 for given dashpots
  Number tangential_ratio;       ///< sqrt(kt/k1): B_t/B_n of restitution damping for n = 1
  Number viscous_normal;         ///< given B_n, else 0
  Number viscous_tangential;     ///< given B_t, else 0
  Number mu_r, kr, inverse_kr, rolling_viscous;
  Number twisting_share;    ///< twisting bound over friction bound; 0: no model
  // of the energy ledger, which takes one contact at a time
  double loading_loss;     ///< energy lost by loading to delta_max, see NormalLaw::loss
  double adhesive_loss;    ///< linear: energy lost by the adhesive branch, likewise
  // the same for all pairs of types
  double exponent;                      ///< n
  double inverse_reference_diameter;    ///< 1/d_ref, or 0 when nothing scales
  bool limit_damping;                   ///< as in LawSettings
};
using Coefficients = CoefficientsOf<double>;

/// B_n / sqrt(m* k1) for a coefficient of restitution e of the linear spring-dashpot.
///
/// sqrt(4 / (1 + (pi/ln e)^2)): exactly 0 for e = 1, exactly 2 (critical) for e = 0.
/// Source: contract section 1; Thakur et al. (2014), equation 5.
/// \param restitution  e in [0, 1]
EEPA_FUNCTION double restitution_damping(double restitution)
{
  if (restitution >= 1.0) return 0.0;
  if (restitution <= 0.0) return 2.0;
  constexpr double pi = 3.14159265358979323846;
  const double ratio = pi / std::log(restitution);
  return 2.0 / std::sqrt(1.0 + ratio * ratio);
}

namespace detail {
  /// Work of the line k2 (x^n - y^n), y = delta_p, from y to x, divided by k2 x^(n+1).
  /// \param plastic_power  (y/x)^n
  EEPA_FUNCTION double line_energy(double plastic_power, double n)
  {
    const double y = std::pow(plastic_power, 1.0 / n);
    return (1.0 - plastic_power * y) / (n + 1.0) - plastic_power * (1.0 - y);
  }
}    // namespace detail

/// Resolves valid parameters into coefficients.
/// \param p  parameters without errors of validate()
/// \param s  settings without errors of validate()
EEPA_FUNCTION Coefficients resolve(const Parameters &p, const LawSettings &s)
{
  Coefficients c{};
  c.k1 = p.k1;
  c.k2 = p.k2;
  c.k_adh = p.k_adh;
  c.f0 = p.f0;
  c.mu = p.mu;
  c.depth = p.depth;
  c.contact_bound = p.bound == FrictionBound::contact ? 1.0 : 0.0;
  c.kt = tangential_stiffness(p);
  c.inverse_kt = c.kt > 0.0 ? 1.0 / c.kt : 0.0;
  c.exponent = s.exponent;
  c.limit_damping = s.limit_damping;
  c.inverse_reference_diameter = s.scaled ? 1.0 / s.reference_diameter : 0.0;
  if (s.law == Law::plateau) {
    c.plastic_fraction = p.k1 / p.k2;
    c.adhesive_memory = 1.0;
    // k1/2 (parting overlap) (plastic overlap) / delta_max^2: see PlateauLaw::elastic_energy
    c.loading_loss = 0.5 * p.k1 * (p.k1 / (p.k2 - p.k1)) * c.plastic_fraction;
  } else {
    c.plastic_fraction = (p.k2 - p.k1) / p.k2;
    // delta_p^n = (1 + k_adh/k2) delta^n and delta_p^n = (1 - k1/k2) delta_max^n; with k2 = k1
    // there is no adhesive branch
    c.adhesive_memory = p.k2 > p.k1 ? std::pow((p.k2 + p.k_adh) / (p.k2 - p.k1), 1.0 / s.exponent)
                                    : 1.0;
    // work of the branch less (loading) or plus (adhesive) what the k2 line holds at its end
    const double n = s.exponent;
    if (p.k2 > p.k1) {
      c.loading_loss = p.k1 / (n + 1.0) - p.k2 * detail::line_energy(c.plastic_fraction, n);
      c.adhesive_loss = p.k_adh / (n + 1.0) + p.k2 * detail::line_energy(1.0 + p.k_adh / p.k2, n);
    }
  }
  if (p.damping == Damping::restitution) {
    c.restitution_damping = restitution_damping(p.restitution);
    c.tangential_ratio = std::sqrt(c.kt / c.k1);
  } else {
    c.viscous_normal = p.viscous_normal;
    c.viscous_tangential = p.viscous_tangential;
  }
  if (p.rolling != RollingModel::none) c.mu_r = p.mu_r;
  if (p.rolling == RollingModel::sds) {
    c.kr = p.kr;
    c.inverse_kr = p.kr > 0.0 ? 1.0 / p.kr : 0.0;
    c.rolling_viscous = p.rolling_viscous;
  }
  // 2/3 a over the arm a/sqrt(2)
  if (p.twisting == TwistingModel::marshall) c.twisting_share = 2.0 / 3.0 * std::sqrt(2.0);
  return c;
}

/// How the coefficients of a contact of size d relate to those at d_ref.
///
/// With s = d/d_ref, stiffnesses scale with s, forces and given dashpots with s^2 (article,
/// section 3). For an exponent n, a stiffness of [force/length^n] scales with s^(2-n). The spring
/// force is written as s k (delta/s)^(n-1) delta: the same, and exact for s a power of 2.
template <class Real> struct ScaleOf {
  Real size = 1.0;            ///< s
  Real inverse_size = 1.0;    ///< 1/s
  /// R* of the contact [length]; set only for normal laws with reads_effective_radius
  Real effective_radius = 0.0;
  EEPA_FUNCTION Real stiffness() const { return size; }
  EEPA_FUNCTION Real force() const { return size * size; }
};
using Scale = ScaleOf<double>;

/// The scale of a contact.
/// \param c  coefficients of its types
/// \param size  d: R_i + R_j between particles, 2 R_i at a wall [length], > 0
template <class Number, class Real>
EEPA_FUNCTION ScaleOf<Real> contact_scale(const CoefficientsOf<Number> &c, const Real &size)
{
  ScaleOf<Real> scale;
  if (c.inverse_reference_diameter > 0.0) {
    scale.size = size * c.inverse_reference_diameter;
    scale.inverse_size = 1.0 / scale.size;
  }
  return scale;
}

}    // namespace eepa

#endif
