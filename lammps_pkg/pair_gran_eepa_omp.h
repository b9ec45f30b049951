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

/// pair_style gran/eepa/omp: the neighbour list is cut into one slice for each thread. A thread
/// writes forces on the atoms of its slice. Forces on atoms of other slices it hands over; they are
/// added in the order of the slices when all threads are done. So no thread has a copy of all
/// forces, and the same number of threads gives the same bits in every run.
///
/// The style takes only the number of threads from LAMMPS's OPENMP package, so that the plugin also
/// loads into a LAMMPS without that package.
class PairGranEepaOMP : public PairGranEepa {
 public:
  using PairGranEepa::PairGranEepa;

 protected:
  void work_through_list() override;

 private:
  std::vector<int> first_places, first_atoms;    // of each slice, and the end of the last slice

  void cut_list(int count);
  void add_deferred(int slice);
};

}    // namespace LAMMPS_NS

#endif
#endif
