// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_LUDING_LAW_H
#define EEPA_LUDING_LAW_H

#include "normal_law.h"

namespace eepa {

/// The law of Luding with its limit branch, exponent 1 (Granular Matter 10 (2008) 235, section 2.2;
/// Singh, Magnanimo, Luding, arXiv 1503.03720).
///
/// A contact that remembers the overlap m <= delta* unloads with the stiffness
///   kappa = k1 + (k2 - k1) m/delta*,   delta* = k2/(k2 - k1) phi_f 2 R*   (wall: R* = R_i)
/// and with delta_p = (1 - k1/kappa) m
///   f_hys = f0 + k1 delta                                          if m <= delta <= delta*
///           f0 + k1 delta* + k2 (delta - delta*)                   if m <= delta, delta > delta*
///           f0 - k_adh delta              if kappa (delta - delta_p) <= -k_adh delta
///           f0 + kappa (delta - delta_p)                           otherwise
///   |f_t| <= mu (f_hys + k_adh delta - f0)
/// Beyond delta* the contact is elastic: m stays at delta*. The adhesive branch lowers m so that
/// reloading leaves it through the present point. Continuous in delta > 0. The energies are derived
/// in tests/kernel/LUDING.md.
struct LudingLaw {
  static constexpr Law law = Law::luding;
  static constexpr bool reads_effective_radius = true;
  using Exponent = UnitExponent;

  /// \copydoc PlateauLaw::force
  template <class Number, class Real>
  EEPA_FUNCTION static NormalForceOf<Real> force(const CoefficientsOf<Number> &c,
                                                 const ScaleOf<Real> &scale, const Real &overlap,
                                                 const Real &max_overlap)
  {
    using std::sqrt;
    NormalForceOf<Real> result;
    const Real s = scale.stiffness();
    const Real limit = limit_overlap(c, scale);
    const Real before = eepa::min(max_overlap, limit);
    const auto loads = overlap >= before;
    Real remembered = select(loads, eepa::min(overlap, limit), before);
    const Real hardening = remembered / limit * (c.k2 - c.k1);
    // kappa (delta - delta_p); on the loading branch, where m = delta, it is k1 delta to the bit
    Real spring = s * (c.k1 * overlap + hardening * (overlap - remembered));
    const Real pull = s * c.k_adh * overlap;
    // the margin keeps a contact at rest on the adhesive branch there, in spite of rounding
    const Real rounding = 1e-14 * s * (c.k2 + c.k_adh) * overlap;
    const auto adheres = !loads && spring <= rounding - pull;
    if (any(adheres)) {
      const Number reach = 4.0 * (c.k1 + c.k_adh) / (c.k2 - c.k1);
      spring = select(adheres, -pull, spring);
      const Real meets = 0.5 * (overlap + sqrt(overlap * (overlap + reach * limit)));
      remembered = select(adheres, meets, remembered);
    }
    result.max_overlap = remembered;
    result.branch = select(
        loads, branch_of<Real>(Branch::loading),
        select(adheres, branch_of<Real>(Branch::adhesive), branch_of<Real>(Branch::unloading)));
    result.force = scale.force() * c.f0 + spring;
    result.coulomb_force = spring + pull;
    result.coulomb_offset = 0.0;
    return result;
  }

  /// delta*, from which on a contact is elastic [length]
  template <class Number, class Real>
  EEPA_FUNCTION static Real limit_overlap(const CoefficientsOf<Number> &c,
                                          const ScaleOf<Real> &scale)
  {
    return 2.0 * c.depth * (c.k2 / (c.k2 - c.k1)) * scale.effective_radius;
  }

  /// delta_p, where the unloading line crosses f0 [length]
  EEPA_FUNCTION static double plastic_overlap(const Coefficients &c, const Scale &scale,
                                              double max_overlap)
  {
    const Memory m(c, scale, max_overlap);
    return m.hardening * m.overlap / m.stiffness;
  }

  /// Recoverable energy: the work of the unloading line from delta_p to delta, and that of f0 from
  /// 0.
  /// \param max_overlap  m as force() returned it for this overlap
  /// \return [force length]
  EEPA_FUNCTION static double elastic_energy(const Coefficients &c, const Scale &scale,
                                             double overlap, double max_overlap)
  {
    const Memory m(c, scale, overlap >= max_overlap ? overlap : max_overlap);
    const double spring = c.k1 * overlap + m.hardening * (overlap - m.overlap);
    return scale.stiffness() * 0.5 * spring * spring / m.stiffness + scale.force() * c.f0 * overlap;
  }

  /// Energy lost to hysteresis while m went from `before` to `after`: up by loading, or down along
  /// the adhesive branch. Exact for any path between the two.
  /// \return [force length], >= 0
  EEPA_FUNCTION static double loss(const Coefficients &c, const Scale &scale, double before,
                                   double after)
  {
    const double lost = after >= before
        ? loading_loss(c, scale, after) - loading_loss(c, scale, before)
        : opening_loss(c, scale, before) - opening_loss(c, scale, after);
    return lost > 0.0 ? lost : 0.0;    // rounding must not give energy back
  }

  /// Energy lost when a contact opens: that of the adhesive branch from where unloading meets it
  /// down to delta = 0. Nothing stays stored there.
  EEPA_FUNCTION static double opening_loss(const Coefficients &c, const Scale &scale,
                                           double max_overlap)
  {
    const Memory m(c, scale, max_overlap);
    const double onset = m.hardening * m.overlap / (m.stiffness + c.k_adh);
    return scale.stiffness() * 0.5 * c.k_adh * onset * onset * (1.0 + c.k_adh / m.stiffness);
  }

 private:
  /// What a contact that remembers an overlap has become, at the reference size.
  struct Memory {
    double overlap;      ///< m <= delta* [length]
    double hardening;    ///< kappa - k1
    double stiffness;    ///< kappa
    EEPA_FUNCTION Memory(const Coefficients &c, const Scale &scale, double max_overlap)
    {
      const double limit = limit_overlap(c, scale);
      overlap = max_overlap < limit ? max_overlap : limit;
      hardening = overlap / limit * (c.k2 - c.k1);
      stiffness = c.k1 + hardening;
    }
  };

  /// k1 m^2/2, the work of loading to m, less what is stored there.
  EEPA_FUNCTION static double loading_loss(const Coefficients &c, const Scale &scale,
                                           double max_overlap)
  {
    const Memory m(c, scale, max_overlap);
    return scale.stiffness() * 0.5 * c.k1 * m.overlap * m.overlap * (m.hardening / m.stiffness);
  }
};

}    // namespace eepa

#endif
