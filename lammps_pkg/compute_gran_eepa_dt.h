/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(gran/eepa/dt,ComputeGranEepaDt);
// clang-format on
#else

#ifndef LMP_COMPUTE_GRAN_EEPA_DT_H
#define LMP_COMPUTE_GRAN_EEPA_DT_H

#include "compute.h"

#include "particle_sizes.h"

#include <vector>

namespace LAMMPS_NS {

/// Largest time step that is stable for all contacts of gran/eepa, walls included.
class ComputeGranEepaDt : public Compute {
 public:
  ComputeGranEepaDt(class LAMMPS *, int, char **);
  void init() override;
  double compute_scalar() override;

 private:
  std::vector<AnnouncedParticles> announced;
  bool warned = false;    // that there are no particles yet

  void parse_particles(int narg, char **arg, int iarg);
};

}    // namespace LAMMPS_NS

#endif
#endif
