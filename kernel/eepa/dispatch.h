// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_DISPATCH_H
#define EEPA_DISPATCH_H

#include "contact_law.h"
#include "luding_law.h"

// Host only: turns the user's choice at run time into a compile-time policy, once, outside of every
// loop. The list of all laws is here and nowhere else.

namespace eepa {

namespace detail {
  template <class NormalLaw, class TwistingLaw, class Function>
  auto with_rolling(RollingModel model, Function &&function)
  {
    switch (model) {
      case RollingModel::constant:
        return function(ContactLaw<NormalLaw, RollingConstant, TwistingLaw>{});
      case RollingModel::sds:
        return function(ContactLaw<NormalLaw, RollingSds, TwistingLaw>{});
      case RollingModel::none:
        break;
    }
    return function(ContactLaw<NormalLaw, RollingNone, TwistingLaw>{});
  }

  template <class NormalLaw, class Function>
  auto with_models(RollingModel rolling, TwistingModel twisting, Function &&function)
  {
    if (twisting == TwistingModel::marshall)
      return with_rolling<NormalLaw, TwistingMarshall>(rolling, function);
    return with_rolling<NormalLaw, TwistingNone>(rolling, function);
  }
}    // namespace detail

/// Calls `function` with the ContactLaw that the settings name.
/// \param function  generic callable; its return type must not depend on the law
template <class Function>
auto with_law(const LawSettings &settings, RollingModel rolling, TwistingModel twisting,
              Function &&function)
{
  switch (settings.law) {    // without a default, so that compilers warn of a law that is left out
    case Law::plateau:
      return detail::with_models<PlateauLaw>(rolling, twisting, function);
    case Law::luding:
      return detail::with_models<LudingLaw>(rolling, twisting, function);
    case Law::linear:
      break;
  }
  if (settings.exponent == 1.0)
    return detail::with_models<LinearLaw<UnitExponent>>(rolling, twisting, function);
  return detail::with_models<LinearLaw<GeneralExponent>>(rolling, twisting, function);
}

/// with_law() for the models that the parameters of a pair of types name.
template <class Function>
auto with_law(const LawSettings &settings, const Parameters &parameters, Function &&function)
{
  return with_law(settings, parameters.rolling, parameters.twisting, function);
}

}    // namespace eepa

#endif
