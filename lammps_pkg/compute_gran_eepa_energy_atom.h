/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(gran/eepa/energy/atom,ComputeGranEepaEnergyAtom);
// clang-format on
#else

#ifndef LMP_COMPUTE_GRAN_EEPA_ENERGY_ATOM_H
#define LMP_COMPUTE_GRAN_EEPA_ENERGY_ATOM_H

#include "compute.h"

#include "atom_losses.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Energy that the contacts of each particle have dissipated since the first run with this compute,
/// by kind: half of the loss of a contact between particles, the whole of one with a wall. Pair
/// style and walls add the losses of each step; LAMMPS's fix STORE/ATOM moves the sums with the
/// particles.
class ComputeGranEepaEnergyAtom : public Compute {
 public:
  ComputeGranEepaEnergyAtom(class LAMMPS *, int, char **);
  ~ComputeGranEepaEnergyAtom() override;
  void init() override;
  void compute_peratom() override;
  void set_arrays(int) override;
  double memory_usage() override;

  /// Adds losses to the sums of one of this rank's particles.
  void add(int atom, const double *losses);

  /// All computes of this style.
  static std::vector<ComputeGranEepaEnergyAtom *> find(class Modify *);

 private:
  std::string store_id;
  class FixStoreAtom *store;
  int nmax = 0;
};

}    // namespace LAMMPS_NS

#endif
#endif
