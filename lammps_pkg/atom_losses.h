// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_ATOM_LOSSES_H
#define LMP_EEPA_ATOM_LOSSES_H

#include <eepa/dissipation.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace LAMMPS_NS {

/// Energy that the contacts of each particle dissipated in one force call; that of ghosts is then
/// sent to their owners. Kept only while a compute gran/eepa/energy/atom exists.
class AtomLosses {
 public:
  static constexpr int kinds = eepa::Dissipation::Kinds::count;    // the compute's columns

  void start(int atoms) { lost.assign(static_cast<std::size_t>(atoms) * kinds, 0.0); }
  void add(int atom, const eepa::Dissipation &of_contact, double share)
  {
    const eepa::Dissipation::Kinds more = of_contact.by_kind();
    for (int k = 0; k < kinds; k++) row(atom)[k] += share * more.value[k];
  }
  double *row(int atom) { return lost.data() + static_cast<std::size_t>(atom) * kinds; }

  int pack(int n, int first, double *buf)
  {
    std::copy_n(row(first), static_cast<std::size_t>(n) * kinds, buf);
    return n * kinds;
  }
  void unpack(int n, const int *atoms, const double *buf)
  {
    for (int m = 0; m < n; m++)
      for (int k = 0; k < kinds; k++) row(atoms[m])[k] += *buf++;
  }
  double memory_usage() const { return static_cast<double>(lost.capacity() * sizeof(double)); }

 private:
  std::vector<double> lost;
};

}    // namespace LAMMPS_NS

#endif
