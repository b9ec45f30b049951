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

/// What the contacts of each particle have dissipated since the first run with this compute, by
/// kind: half of a contact between particles, all of one with a wall. Pair style and walls hand in
/// what each step adds; the sums go with the particles in LAMMPS's fix STORE/ATOM.
class ComputeGranEepaEnergyAtom : public Compute {
 public:
  ComputeGranEepaEnergyAtom(class LAMMPS *, int, char **);
  ~ComputeGranEepaEnergyAtom() override;
  void init() override;
  void compute_peratom() override;
  void set_arrays(int) override;
  double memory_usage() override;

  /// Adds to the sums of one of this rank's particles.
  void add(int atom, const double *losses);

  /// All that there are.
  static std::vector<ComputeGranEepaEnergyAtom *> find(class Modify *);

 private:
  std::string store_id;
  class FixStoreAtom *store;
  int nmax = 0;
};

}    // namespace LAMMPS_NS

#endif
#endif
