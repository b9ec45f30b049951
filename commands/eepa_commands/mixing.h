// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_MIXING_H
#define EEPA_COMMANDS_MIXING_H

#include <eepa/parameters.h>

#include <cmath>
#include <string>

namespace eepa {

namespace detail {
  /// Harmonic mean: two springs (or dashpots) in series, each of half the contact.
  inline double series(double a, double b)
  {
    return (a > 0.0 && b > 0.0) ? 2.0 / (1.0 / a + 1.0 / b) : 0.0;
  }
}    // namespace detail

/// Mixes the parameters of two types into those of their contact.
///
/// Stiffnesses and given dashpots harmonically (in series), f0, mu, mu_r and e geometrically.
/// Mixing a type with itself returns its own parameters (to rounding), and k2 >= k1 (k2 >= 2 k1) of both
/// types holds for the mixture too.
/// \param[out] why  the reason if the two can not be mixed, else untouched
/// \return whether they can
inline bool mix(const Parameters &a, const Parameters &b, Parameters &mixed, std::string &why)
{
  if (a.damping != b.damping) {
    why = "one has restitution and the other viscous damping";
    return false;
  }
  const bool both_roll = a.rolling != RollingModel::none && b.rolling != RollingModel::none;
  if (both_roll && a.rolling != b.rolling) {
    why = "one has rolling constant and the other rolling sds";
    return false;
  }
  mixed = Parameters();
  mixed.k1 = detail::series(a.k1, b.k1);
  mixed.k2 = detail::series(a.k2, b.k2);
  mixed.k_adh = detail::series(a.k_adh, b.k_adh);
  // separate roots: the product of two tiny forces could underflow
  mixed.f0 = -(std::sqrt(-a.f0) * std::sqrt(-b.f0));
  mixed.mu = std::sqrt(a.mu) * std::sqrt(b.mu);
  mixed.kt_given = a.kt_given || b.kt_given;
  mixed.kt = mixed.kt_given ? detail::series(tangential_stiffness(a), tangential_stiffness(b))
                            : 0.0;
  mixed.damping = a.damping;
  mixed.restitution = std::sqrt(a.restitution * b.restitution);
  mixed.viscous_normal = detail::series(a.viscous_normal, b.viscous_normal);
  mixed.viscous_tangential = detail::series(a.viscous_tangential, b.viscous_tangential);
  if (both_roll) {
    mixed.rolling = a.rolling;
    mixed.mu_r = std::sqrt(a.mu_r) * std::sqrt(b.mu_r);
    mixed.kr = detail::series(a.kr, b.kr);
    mixed.rolling_viscous = detail::series(a.rolling_viscous, b.rolling_viscous);
  }
  if (a.twisting == b.twisting) mixed.twisting = a.twisting;
  return true;
}

}    // namespace eepa

#endif
