/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(gran/eepa/energy,ComputeGranEepaEnergy);
// clang-format on
#else

#ifndef LMP_COMPUTE_GRAN_EEPA_ENERGY_H
#define LMP_COMPUTE_GRAN_EEPA_ENERGY_H

#include "compute.h"

namespace LAMMPS_NS {

/// Energy ledger of all contacts of gran/eepa, walls included. Pair style and walls keep their
/// ledgers only while this compute exists; without it there is no cost.
class ComputeGranEepaEnergy : public Compute {
 public:
  ComputeGranEepaEnergy(class LAMMPS *, int, char **);
  ~ComputeGranEepaEnergy() override;
  void init() override;
  void compute_vector() override;

 private:
  enum {
    ELASTIC_NORMAL,    ///< stored at present
    ELASTIC_TANGENTIAL,
    ELASTIC_ROLLING,
    DISSIPATED_HYSTERESIS,    ///< since the first run with this compute
    DISSIPATED_NORMAL_DASHPOT,
    DISSIPATED_TANGENTIAL_DASHPOT,
    DISSIPATED_SLIDING,
    DISSIPATED_ROLLING,
    WALL_WORK,    ///< done by walls on particles since then
    ELASTIC_TWISTING,
    DISSIPATED_TWISTING,
    N_QUANTITIES
  };
};

}    // namespace LAMMPS_NS

#endif
#endif
