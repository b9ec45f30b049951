// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_DISPATCH_H
#define EEPA_DISPATCH_H

#include "contact_law.h"

// Host only: turns what a user chose at run time into a compile-time policy, once, outside of
// every loop. The list of all laws that exist is here and nowhere else.

namespace eepa {

namespace detail {
  template <class NormalLaw, class Function>
  auto with_rolling(RollingModel model, Function &&function)
  {
    switch (model) {
      case RollingModel::constant:
        return function(ContactLaw<NormalLaw, RollingConstant>{});
      case RollingModel::sds:
        return function(ContactLaw<NormalLaw, RollingSds>{});
      case RollingModel::none:
        break;
    }
    return function(ContactLaw<NormalLaw, RollingNone>{});
  }
}    // namespace detail

/// Calls `function` with the ContactLaw that the settings name.
/// \param function  generic callable; its return type must not depend on the law
template <class Function>
auto with_law(const LawSettings &settings, RollingModel model, Function &&function)
{
  if (settings.law == Law::plateau) return detail::with_rolling<PlateauLaw>(model, function);
  if (settings.exponent == 1.0)
    return detail::with_rolling<LinearLaw<UnitExponent>>(model, function);
  return detail::with_rolling<LinearLaw<GeneralExponent>>(model, function);
}

}    // namespace eepa

#endif
