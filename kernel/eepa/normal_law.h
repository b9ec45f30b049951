// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_NORMAL_LAW_H
#define EEPA_NORMAL_LAW_H

#include "coefficients.h"

#include <cmath>

namespace eepa {

/// The branch of the hysteretic force that a contact is on.
enum class Branch : int { loading = 1, unloading = 2, adhesive = 3 };

/// What a normal law says of one overlap.
struct NormalForce {
  double force;             ///< f_hys, positive repels [force]
  double coulomb_force;     ///< what mu multiplies in the friction bound [force]
  double coulomb_offset;    ///< what is added to the bound unmultiplied [force]
  double max_overlap;       ///< the delta_max to remember [length]
  Branch branch;
};

/// Power policy of exponent 1: p(delta) = delta.
struct UnitExponent {
  static constexpr bool is_unit = true;
  /// p(delta) such that s k p(delta) is the spring force of a contact of scale s
  EEPA_FUNCTION static double power(double overlap, const Coefficients &, const Scale &)
  {
    return overlap;
  }
  /// the overlap whose power is `fraction` times that of `overlap`
  EEPA_FUNCTION static double scale_overlap(double overlap, double fraction, const Coefficients &)
  {
    return overlap * fraction;
  }
  /// dp/d(delta)
  EEPA_FUNCTION static double slope(double, const Coefficients &, const Scale &) { return 1.0; }
};

/// Power policy of a general exponent n: p(delta) = delta (delta/s)^(n-1).
struct GeneralExponent {
  static constexpr bool is_unit = false;
  EEPA_FUNCTION static double power(double overlap, const Coefficients &c, const Scale &scale)
  {
    return overlap * std::pow(overlap * scale.inverse_size, c.exponent - 1.0);
  }
  EEPA_FUNCTION static double scale_overlap(double overlap, double fraction, const Coefficients &c)
  {
    return overlap * std::pow(fraction, 1.0 / c.exponent);
  }
  EEPA_FUNCTION static double slope(double overlap, const Coefficients &c, const Scale &scale)
  {
    return c.exponent * std::pow(overlap * scale.inverse_size, c.exponent - 1.0);
  }
};

/// The article's law, to the letter (sections 2 and 4), exponent 1.
///
/// With delta_p = (k1/k2) delta_max:
///   f_hys = f0 + k1 delta            if k2 (delta - delta_p) >= k1 delta
///           -k_adh delta_p           if k2 (delta - delta_p) <= -k_adh delta_p
///           f0 + k2 (delta-delta_p)  otherwise
///   |f_t| <= mu (f_hys + k_adh delta_p) - f0
/// For f0 != 0 the force steps by f0 where the plateau begins.
struct PlateauLaw {
  static constexpr Law law = Law::plateau;
  using Exponent = UnitExponent;

  /// \param overlap  delta > 0 [length]
  /// \param max_overlap  remembered delta_max, 0 for a virgin contact [length]
  EEPA_FUNCTION static NormalForce force(const Coefficients &c, const Scale &scale, double overlap,
                                         double max_overlap)
  {
    NormalForce result;
    // the comparison, not the arithmetic below, decides that a contact at its largest overlap loads
    const bool virgin = overlap >= max_overlap;
    result.max_overlap = virgin ? overlap : max_overlap;
    const double s = scale.stiffness();
    const double f0 = scale.force() * c.f0;
    const double plastic_overlap = c.plastic_fraction * result.max_overlap;
    const double loading = s * c.k1 * overlap;
    const double unloading = s * c.k2 * (overlap - plastic_overlap);
    const double pull = s * c.k_adh * plastic_overlap;
    if (virgin || unloading >= loading) {
      result.branch = Branch::loading;
      result.force = f0 + loading;
    } else if (unloading <= -pull) {
      result.branch = Branch::adhesive;
      result.force = -pull;
    } else {
      result.branch = Branch::unloading;
      result.force = f0 + unloading;
    }
    result.coulomb_force = result.force + pull;
    result.coulomb_offset = -f0;
    return result;
  }

  /// delta_p, where the unloading line crosses f0 [length]
  EEPA_FUNCTION static double plastic_overlap(const Coefficients &c, double max_overlap)
  {
    return c.plastic_fraction * max_overlap;
  }

  /// Recoverable energy: the work of f_hys from the stress-free overlap delta_p to delta with
  /// delta_max held, plus that of f0 from 0. At fixed delta_max the law is path-independent,
  /// so this closes the energy balance; what the plateau holds at delta = 0 is lost there.
  /// \return [force length]
  EEPA_FUNCTION static double elastic_energy(const Coefficients &c, const Scale &scale,
                                             double overlap, double max_overlap)
  {
    const double s = scale.stiffness();
    const double peak = overlap >= max_overlap ? overlap : max_overlap;
    const double plastic = c.plastic_fraction * peak;
    // where the plateau begins, and where unloading parts from the loading line
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
  /// Only loading loses; the plateau gives back what it took until the contact opens.
  EEPA_FUNCTION static double loss(const Coefficients &c, const Scale &scale, double before,
                                   double after)
  {
    return scale.stiffness() * c.loading_loss * (after - before) * (after + before);
  }

  /// Energy lost when a contact opens: what it holds at delta = 0. Negative, that is created,
  /// where f0 != 0 outweighs the plateau: by up to |f0| times the overlap at which it begins.
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
/// The adhesive branch lowers delta_max so that reloading leaves it on a k2 line through the
/// present point. Continuous in delta > 0.
/// \tparam ExponentPolicy  UnitExponent or GeneralExponent
template <class ExponentPolicy> struct LinearLaw {
  static constexpr Law law = Law::linear;
  using Exponent = ExponentPolicy;

  /// \copydoc PlateauLaw::force
  EEPA_FUNCTION static NormalForce force(const Coefficients &c, const Scale &scale, double overlap,
                                         double max_overlap)
  {
    NormalForce result;
    const bool virgin = overlap >= max_overlap;
    const double s = scale.stiffness();
    const double f0 = scale.force() * c.f0;
    const double power = Exponent::power(overlap, c, scale);
    const double loading = s * c.k1 * power;
    const double pull = s * c.k_adh * power;
    double spring = loading;
    result.max_overlap = overlap;
    result.branch = Branch::loading;
    if (!virgin) {
      const double plastic_power = c.plastic_fraction * Exponent::power(max_overlap, c, scale);
      const double unloading = s * c.k2 * (power - plastic_power);
      result.max_overlap = max_overlap;
      if (unloading < loading) {
        // a contact at rest on the adhesive branch stays there, whatever rounding says
        const double rounding = 1e-14 * s * (c.k2 + c.k_adh) * power;
        if (unloading <= rounding - pull) {
          result.branch = Branch::adhesive;
          spring = -pull;
          result.max_overlap = c.adhesive_memory * overlap;
        } else {
          result.branch = Branch::unloading;
          spring = unloading;
        }
      }
    }
    result.force = f0 + spring;
    result.coulomb_force = spring + pull;
    result.coulomb_offset = 0.0;
    return result;
  }

  /// delta_p, where the unloading line crosses f0 [length]
  EEPA_FUNCTION static double plastic_overlap(const Coefficients &c, double max_overlap)
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
    const double plastic = plastic_overlap(c, peak);
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

  /// Energy lost when a contact opens: that of the adhesive branch from where unloading meets
  /// it down to delta = 0. Nothing stays stored there.
  EEPA_FUNCTION static double opening_loss(const Coefficients &c, const Scale &scale,
                                           double max_overlap)
  {
    const double onset = max_overlap / c.adhesive_memory;
    return scale.stiffness() * c.adhesive_loss * onset * Exponent::power(onset, c, scale);
  }
};

}    // namespace eepa

#endif
