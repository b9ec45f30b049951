// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_NORMAL_LAW_H
#define EEPA_NORMAL_LAW_H

#include "coefficients.h"
#include "real.h"

#include <cmath>
#include <type_traits>

namespace eepa {

/// The branch of the hysteretic force that a contact is on.
enum class Branch : int { loading = 1, unloading = 2, adhesive = 3 };

/// The branch of a contact; where Real is lanes, its number in each lane.
template <class Real> using BranchOf = std::conditional_t<is_lanes<Real>, Real, Branch>;

template <class Real> EEPA_FUNCTION BranchOf<Real> branch_of(Branch branch)
{
  if constexpr (is_lanes<Real>)
    return BranchOf<Real>(static_cast<double>(static_cast<int>(branch)));
  else
    return branch;
}

/// Result of a normal law for one overlap.
template <class Real> struct NormalForceOf {
  Real force;             ///< f_hys, positive repels [force]
  Real coulomb_force;     ///< the part of the friction bound that mu multiplies [force]
  Real coulomb_offset;    ///< the part of the friction bound that mu does not multiply [force]
  Real max_overlap;       ///< the delta_max to remember [length]
  BranchOf<Real> branch;
};
using NormalForce = NormalForceOf<double>;

/// Power policy of exponent 1: p(delta) = delta.
struct UnitExponent {
  static constexpr bool is_unit = true;
  /// p(delta) such that s k p(delta) is the spring force of a contact of scale s
  template <class Number, class Real>
  EEPA_FUNCTION static Real power(const Real &overlap, const CoefficientsOf<Number> &,
                                  const ScaleOf<Real> &)
  {
    return overlap;
  }
  /// the overlap whose power is `fraction` times that of `overlap`
  EEPA_FUNCTION static double scale_overlap(double overlap, double fraction, const Coefficients &)
  {
    return overlap * fraction;
  }
};

/// Power policy of a general exponent n: p(delta) = delta (delta/s)^(n-1).
struct GeneralExponent {
  static constexpr bool is_unit = false;
  template <class Number, class Real>
  EEPA_FUNCTION static Real power(const Real &overlap, const CoefficientsOf<Number> &c,
                                  const ScaleOf<Real> &scale)
  {
    return overlap * eepa::pow<Real>(overlap * scale.inverse_size, c.exponent - 1.0);
  }
  EEPA_FUNCTION static double scale_overlap(double overlap, double fraction, const Coefficients &c)
  {
    return overlap * std::pow(fraction, 1.0 / c.exponent);
  }
  /// dp/d(delta); not needed for exponent 1, where it is 1
  template <class Number, class Real>
  EEPA_FUNCTION static Real slope(const Real &overlap, const CoefficientsOf<Number> &c,
                                  const ScaleOf<Real> &scale)
  {
    return c.exponent * eepa::pow<Real>(overlap * scale.inverse_size, c.exponent - 1.0);
  }
};

/// The law exactly as printed in the article (sections 2 and 4), exponent 1.
///
/// With delta_p = (k1/k2) delta_max:
///   f_hys = f0 + k1 delta            if k2 (delta - delta_p) >= k1 delta
///           -k_adh delta_p           if k2 (delta - delta_p) <= -k_adh delta_p
///           f0 + k2 (delta-delta_p)  otherwise
///   |f_t| <= mu (f_hys + k_adh delta_p) - f0
/// For f0 != 0 the force steps by f0 where the plateau begins.
struct PlateauLaw {
  static constexpr Law law = Law::plateau;
  static constexpr bool reads_effective_radius = false;
  using Exponent = UnitExponent;

  /// \param overlap  delta > 0 [length]
  /// \param max_overlap  remembered delta_max, 0 for a virgin contact [length]
  template <class Number, class Real>
  EEPA_FUNCTION static NormalForceOf<Real> force(const CoefficientsOf<Number> &c,
                                                 const ScaleOf<Real> &scale, const Real &overlap,
                                                 const Real &max_overlap)
  {
    NormalForceOf<Real> result;
    // the comparison, not the arithmetic below, decides that a contact at its largest overlap loads
    const auto virgin = overlap >= max_overlap;
    result.max_overlap = select(virgin, overlap, max_overlap);
    const Real s = scale.stiffness();
    const Real f0 = scale.force() * c.f0;
    const Real plastic_overlap = c.plastic_fraction * result.max_overlap;
    const Real loading = s * c.k1 * overlap;
    const Real unloading = s * c.k2 * (overlap - plastic_overlap);
    const Real pull = s * c.k_adh * plastic_overlap;
    const auto loads = virgin || unloading >= loading;
    const auto adheres = !loads && unloading <= -pull;
    result.branch = select(
        loads, branch_of<Real>(Branch::loading),
        select(adheres, branch_of<Real>(Branch::adhesive), branch_of<Real>(Branch::unloading)));
    result.force = select(loads, f0 + loading, select(adheres, -pull, f0 + unloading));
    result.coulomb_force = result.force + pull;
    result.coulomb_offset = -f0;
    return result;
  }

  /// delta_p, where the unloading line crosses f0 [length]
  EEPA_FUNCTION static double plastic_overlap(const Coefficients &c, const Scale &,
                                              double max_overlap)
  {
    return c.plastic_fraction * max_overlap;
  }

  /// Recoverable energy: the work of f_hys from the stress-free overlap delta_p to delta with
  /// delta_max held, plus that of f0 from 0. At fixed delta_max the law is path-independent,
  /// so this closes the energy balance. Energy that the plateau holds at delta = 0 is lost there.
  /// \return [force length]
  EEPA_FUNCTION static double elastic_energy(const Coefficients &c, const Scale &scale,
                                             double overlap, double max_overlap)
  {
    const double s = scale.stiffness();
    const double peak = overlap >= max_overlap ? overlap : max_overlap;
    const double plastic = c.plastic_fraction * peak;
    // overlaps where the plateau begins, and where unloading leaves the loading line
    const double plateau_stretch = c.k_adh * plastic / c.k2;
    const double plateau_overlap = plastic - plateau_stretch;
    const double parting_overlap = c.k1 / (c.k2 - c.k1) * peak;
    if (overlap <= plateau_overlap)
      return s *
          (0.5 * c.k2 * plateau_stretch * plateau_stretch +
           c.k_adh * plastic * (plateau_overlap - overlap)) +
          scale.force() * c.f0 * plateau_overlap;
    const double on_k2_line = (overlap < parting_overlap ? overlap : parting_overlap);
    double energy = 0.5 * c.k2 * (on_k2_line - plastic) * (on_k2_line - plastic);
    if (overlap > parting_overlap)
      energy += 0.5 * c.k1 * (overlap - parting_overlap) * (overlap + parting_overlap);
    return s * energy + scale.force() * c.f0 * overlap;
  }

  /// Energy lost to hysteresis while the remembered overlap went from `before` to `after`.
  /// Only loading dissipates; the plateau's work is recoverable until the contact opens.
  EEPA_FUNCTION static double loss(const Coefficients &c, const Scale &scale, double before,
                                   double after)
  {
    return scale.stiffness() * c.loading_loss * (after - before) * (after + before);
  }

  /// Energy lost when a contact opens: what it holds at delta = 0. Negative (energy is created)
  /// where f0 outweighs the plateau, by up to |f0| times the overlap at which the plateau begins.
  EEPA_FUNCTION static double opening_loss(const Coefficients &c, const Scale &scale,
                                           double max_overlap)
  {
    return elastic_energy(c, scale, 0.0, max_overlap);
  }
};

/// The law as published (Thakur et al., Granular Matter 16 (2014) 383, equations 1-4; for
/// exponent 1 Luding, Granular Matter 10 (2008) 235, equation 4).
///
/// With delta_p^n = (1 - k1/k2) delta_max^n:
///   f_hys = f0 + k1 delta^n                 if k2 (delta^n - delta_p^n) >= k1 delta^n
///           f0 - k_adh delta^n              if k2 (delta^n - delta_p^n) <= -k_adh delta^n
///           f0 + k2 (delta^n - delta_p^n)   otherwise
///   |f_t| <= mu (f_hys + k_adh delta^n - f0)
/// The adhesive branch lowers delta_max, so that reloading leaves the branch on a k2 line through
/// the present point. The force is continuous in delta > 0.
/// \tparam ExponentPolicy  UnitExponent or GeneralExponent
template <class ExponentPolicy> struct LinearLaw {
  static constexpr Law law = Law::linear;
  static constexpr bool reads_effective_radius = false;
  using Exponent = ExponentPolicy;

  /// \copydoc PlateauLaw::force
  template <class Number, class Real>
  EEPA_FUNCTION static NormalForceOf<Real> force(const CoefficientsOf<Number> &c,
                                                 const ScaleOf<Real> &scale, const Real &overlap,
                                                 const Real &max_overlap)
  {
    NormalForceOf<Real> result;
    const auto virgin = overlap >= max_overlap;
    const Real s = scale.stiffness();
    const Real f0 = scale.force() * c.f0;
    const Real power = Exponent::power(overlap, c, scale);
    const Real loading = s * c.k1 * power;
    const Real pull = s * c.k_adh * power;
    const Real plastic_power = c.plastic_fraction * Exponent::power(max_overlap, c, scale);
    const Real unloading = s * c.k2 * (power - plastic_power);
    // the margin keeps a contact at rest on the adhesive branch there, in spite of rounding
    const Real rounding = 1e-14 * s * (c.k2 + c.k_adh) * power;
    const auto loads = virgin || unloading >= loading;
    const auto adheres = !loads && unloading <= rounding - pull;
    const Real remembered = select(adheres, c.adhesive_memory * overlap, max_overlap);
    const Real spring = select(loads, loading, select(adheres, -pull, unloading));
    result.max_overlap = select(virgin, overlap, remembered);
    result.branch = select(
        loads, branch_of<Real>(Branch::loading),
        select(adheres, branch_of<Real>(Branch::adhesive), branch_of<Real>(Branch::unloading)));
    result.force = f0 + spring;
    result.coulomb_force = spring + pull;
    result.coulomb_offset = 0.0;
    return result;
  }

  /// delta_p, where the unloading line crosses f0 [length]
  EEPA_FUNCTION static double plastic_overlap(const Coefficients &c, const Scale &,
                                              double max_overlap)
  {
    return Exponent::scale_overlap(max_overlap, c.plastic_fraction, c);
  }

  /// Recoverable energy: the work of the k2 line from the stress-free overlap delta_p to delta,
  /// plus that of f0 from 0; for exponent 1: k2 (delta - delta_p)^2 / 2 + f0 delta.
  /// \param max_overlap  delta_max as force() returned it for this overlap
  /// \return [force length]
  EEPA_FUNCTION static double elastic_energy(const Coefficients &c, const Scale &scale,
                                             double overlap, double max_overlap)
  {
    const double peak = overlap >= max_overlap ? overlap : max_overlap;
    const double plastic = plastic_overlap(c, scale, peak);
    const double plastic_power = c.plastic_fraction * Exponent::power(peak, c, scale);
    double energy;
    if constexpr (Exponent::is_unit) {
      energy = 0.5 * (overlap - plastic) * (overlap - plastic);
    } else {
      const double power = Exponent::power(overlap, c, scale);
      energy = (overlap * power - plastic * plastic_power) / (c.exponent + 1.0) -
          plastic_power * (overlap - plastic);
      // a difference of nearly equal numbers next to delta_p
      if (energy < 0.0) energy = 0.0;
    }
    return scale.stiffness() * c.k2 * energy + scale.force() * c.f0 * overlap;
  }

  /// Energy lost to hysteresis while the remembered overlap went from `before` to `after`: up
  /// by loading, or down along the adhesive branch. Exact for any path between the two.
  /// \return [force length], >= 0
  EEPA_FUNCTION static double loss(const Coefficients &c, const Scale &scale, double before,
                                   double after)
  {
    const double lost = after >= before
        ? scale.stiffness() * c.loading_loss *
            (after * Exponent::power(after, c, scale) - before * Exponent::power(before, c, scale))
        : opening_loss(c, scale, before) - opening_loss(c, scale, after);
    return lost > 0.0 ? lost : 0.0;    // rounding must not give energy back
  }

  /// Energy lost when a contact opens: the loss along the adhesive branch from where unloading
  /// meets it down to delta = 0, where nothing is stored any more.
  EEPA_FUNCTION static double opening_loss(const Coefficients &c, const Scale &scale,
                                           double max_overlap)
  {
    const double onset = max_overlap / c.adhesive_memory;
    return scale.stiffness() * c.adhesive_loss * onset * Exponent::power(onset, c, scale);
  }
};

}    // namespace eepa

#endif
