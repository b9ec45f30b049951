/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(gran/eepa/contacts,ComputeGranEepaContacts);
// clang-format on
#else

#ifndef LMP_COMPUTE_GRAN_EEPA_CONTACTS_H
#define LMP_COMPUTE_GRAN_EEPA_CONTACTS_H

#include "compute.h"

namespace LAMMPS_NS {

/// Counts the contacts of pair_style gran/eepa by their status in the last force call, and those with walls.
class ComputeGranEepaContacts : public Compute {
 public:
  ComputeGranEepaContacts(class LAMMPS *, int, char **);
  ~ComputeGranEepaContacts() override;
  void init() override;
  void compute_vector() override;

 private:
  enum {
    CONTACTS,
    LOADING,
    UNLOADING,
    ADHESIVE,
    SLIDING,
    COORDINATION_NUMBER,
    MAX_OVERLAP_RATIO,
    MEAN_OVERLAP_RATIO,
    WALL_CONTACTS,
    N_QUANTITIES
  };
};

}    // namespace LAMMPS_NS

#endif
#endif
