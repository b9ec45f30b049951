/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifdef PAIR_CLASS
// clang-format off
PairStyle(gran/eepa/omp,PairGranEepaOMP);
// clang-format on
#else

#ifndef LMP_PAIR_GRAN_EEPA_OMP_H
#define LMP_PAIR_GRAN_EEPA_OMP_H

#include "pair_gran_eepa.h"

#include <vector>

namespace LAMMPS_NS {

/// pair_style gran/eepa/omp: the neighbour list cut into a slice for each thread. A thread writes
/// forces on its own run of atoms; those on atoms of others it hands over, and they are added in
/// the order of the slices when all are done: no copy of the forces for each thread, and the same
/// bits in every run with as many threads.
///
/// It needs nothing of LAMMPS's OPENMP package but the number of threads, and so the plugin still
/// loads into a LAMMPS without it.
class PairGranEepaOMP : public PairGranEepa {
 public:
  using PairGranEepa::PairGranEepa;

 protected:
  void work_through_list() override;

 private:
  std::vector<int> first_places, first_atoms;    // of each slice, and where the last one ends

  void cut_list(int count);
  void add_deferred(int slice);
};

}    // namespace LAMMPS_NS

#endif
#endif
