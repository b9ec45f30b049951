// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_PARTICLE_SIZES_H
#define LMP_EEPA_PARTICLE_SIZES_H

#include "modify.h"

#include <string>

namespace LAMMPS_NS {

/// A bound on the time step and the contact that sets it.
struct TimeStepBound {
  double time_step;      ///< [time]; infinity where nothing can touch
  std::string origin;    ///< "pair of types 1 and 2", "fix top"
};

/// Particles that are still to be inserted, as a user announces them.
struct AnnouncedParticles {
  int type;
  double smallest, largest;    ///< diameters [length]
  double density;              ///< [mass/length^3]
};

/// Whether a fix is known to change radii in mid-run.
inline bool radii_may_change(Modify *modify)
{
  for (const char *style : {"^adapt", "^set$", "^GRANULAR/MDR$"})
    if (!modify->get_fix_by_style(style).empty()) return true;
  return false;
}

}    // namespace LAMMPS_NS

#endif
