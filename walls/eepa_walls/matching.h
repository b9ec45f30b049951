// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_MATCHING_H
#define EEPA_WALLS_MATCHING_H

#include "shape.h"

namespace eepa {

/// Cosine of the angle by which the normal of a contact has turned, 1 where it was not known.
EEPA_FUNCTION double alikeness(const Vec3 &normal_before, const Vec3 &normal_now)
{
  const bool known = normal_before[0] != 0.0 || normal_before[1] != 0.0 || normal_before[2] != 0.0;
  return known ? dot<double>(normal_before, normal_now) : 1.0;
}

/// Finds the history of each contact of a particle: of the same face, or of a face from which the particle slid.
/// Those whose normals are nearest belong together, because contacts may share the number of a face.
/// \tparam Lists  has the contacts found and the histories of the step before:
///     int found(), histories(); bool is_taken(k), is_matched(m); double alike(k, m);
///     bool belong(k, m, same_face); void match(k, m)
template <class Lists> EEPA_FUNCTION void match_contacts(Lists &&lists)
{
  const int found = lists.found(), histories = lists.histories();
  if (found == 0 || histories == 0) return;
  for (int pass = 0; pass < 2; pass++)
    for (;;) {
      double closest = 0.0;
      int contact = found, history = 0;
      for (int k = 0; k < found; k++) {
        if (lists.is_taken(k)) continue;
        for (int m = 0; m < histories; m++) {
          if (lists.is_matched(m)) continue;
          const double alike = lists.alike(k, m);
          if (alike <= closest || !lists.belong(k, m, pass == 0)) continue;
          closest = alike;
          contact = k;
          history = m;
        }
      }
      if (contact == found) break;
      lists.match(contact, history);
    }
}

}    // namespace eepa

#endif
