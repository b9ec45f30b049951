// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_PARTICLE_ARRAYS_H
#define LMP_EEPA_PARTICLE_ARRAYS_H

#include <eepa/body.h>

#include <cstddef>

namespace LAMMPS_NS {

/// The per-atom arrays that bodies are gathered from, as flat runs of 3 doubles an atom: LAMMPS's arrays of pointers
/// to rows are as scattered a read as the rows themselves.
struct ParticleArrays {
  const double *x, *v, *omega;    ///< 3 doubles an atom
  const double *radius, *mass;    ///< 1 double an atom
  const int *type;

  static Eigen::Map<const eepa::Vec3> at(const double *array, int i)
  {
    return Eigen::Map<const eepa::Vec3>(array + 3 * static_cast<std::ptrdiff_t>(i));
  }
  eepa::Body<double> body(int i) const
  {
    return {at(x, i), at(v, i), at(omega, i), radius[i], mass[i]};
  }
};

/// The per-atom arrays that wrenches are added to, as flat runs of 3 doubles an atom.
struct ForceArrays {
  double *f, *torque;

  void add(int i, const eepa::Vec3 &force, const eepa::Vec3 &moment) const
  {
    using Row = Eigen::Map<eepa::Vec3>;
    Row(f + 3 * static_cast<std::ptrdiff_t>(i)) += force;
    Row(torque + 3 * static_cast<std::ptrdiff_t>(i)) += moment;
  }
};

/// Fetches the 3 numbers of an atom, which will be read soon. They may lie in two lines of the cache.
inline void prefetch_row(const double *array, int i)
{
  const double *row = array + 3 * static_cast<std::ptrdiff_t>(i);
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(row, 1);
  __builtin_prefetch(row + 2, 1);
#else
  (void) row;
#endif
}

}    // namespace LAMMPS_NS

#endif
