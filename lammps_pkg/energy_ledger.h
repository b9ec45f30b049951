// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_ENERGY_LEDGER_H
#define LMP_EEPA_ENERGY_LEDGER_H

#include <eepa/dissipation.h>

#include "modify.h"

namespace LAMMPS_NS {

/// Energies of one rank's contacts of a pair style or a wall. Kept only while a compute
/// gran/eepa/energy exists.
struct EnergyLedger {
  eepa::StoredEnergy elastic;      ///< at the last force call
  eepa::Dissipation dissipated;    ///< since the ledger began
  double wall_work = 0.0;          ///< work on particles since the ledger began, walls only

  static bool wanted(Modify *modify)
  {
    return !modify->get_compute_by_style("^gran/eepa/energy").empty();
  }
};

}    // namespace LAMMPS_NS

#endif
