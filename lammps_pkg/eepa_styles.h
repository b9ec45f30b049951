// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_STYLES_H
#define LMP_EEPA_STYLES_H

#include <vector>

namespace LAMMPS_NS {

class Pair;
class Fix;
class Compute;
class LAMMPS;

/// A style of this package and the function that makes it. One list serves the plugin, build/lmp
/// and the tests.
struct EepaStyle {
  const char *category;    // "pair", "fix" or "compute"
  const char *name;
  const char *info;
  Pair *(*make_pair)(LAMMPS *);    // the one of the three that belongs to the category is set
  Fix *(*make_fix)(LAMMPS *, int, char **);
  Compute *(*make_compute)(LAMMPS *, int, char **);
};

const std::vector<EepaStyle> &eepa_styles();

/// Enters a style in the lists of one instance of LAMMPS.
void register_eepa_style(LAMMPS *lmp, const EepaStyle &style);

/// Whether the lists of an instance have a style of this name, whoever entered it.
bool has_eepa_style(const LAMMPS *lmp, const EepaStyle &style);

/// Enters all of them.
void register_eepa_styles(LAMMPS *lmp);

}    // namespace LAMMPS_NS

#endif
