// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_MIXING_H
#define EEPA_COMMANDS_MIXING_H

#include <eepa/parameters.h>

#include <string>

namespace eepa {

/// Mixes the parameters of two types into those of their contact, each by the rule of the table of
/// parameters. Mixing a type with itself returns its own parameters, to the bit, and if k2 >= k1
/// (k2 >= 2 k1) holds for both types, it holds for the mixture too.
/// \param[out] mixed  changed only if the types can be mixed
/// \param[out] why  the reason if the types can not be mixed, else unchanged
/// \return whether the types can be mixed
bool mix(const Parameters &a, const Parameters &b, Parameters &mixed, std::string &why);

}    // namespace eepa

#endif
