// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_TEXT_H
#define EEPA_WALLS_TEXT_H

#include <eepa/vector.h>

#include <string>

namespace eepa {

/// A number for messages, with 6 digits.
std::string text_of(double value);
/// Three numbers for messages.
std::string text_of(const Vec3 &value);

}    // namespace eepa

#endif
