/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifndef LMP_EEPA_ATOM_ROWS_H
#define LMP_EEPA_ATOM_ROWS_H

// Rows of LAMMPS's arrays of vectors, which lie one after the other. Going by the first row spares the array
// of pointers to rows, which is as scattered a read as the row itself.

#include <eepa/vector.h>

#include <cstddef>

namespace LAMMPS_NS {

/// The 3 numbers of an atom. \param rows  such as atom->x
inline double *row(double *const *rows, int i)
{
  return rows[0] + 3 * static_cast<std::ptrdiff_t>(i);
}

inline eepa::Vec3 row_of(double *const *rows, int i)
{
  return eepa::Vec3(row(rows, i));
}

/// Fetches what will be read soon. A row may lie in two lines of the cache.
inline void prefetch_row(double *const *rows, int i)
{
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(row(rows, i), 1);
  __builtin_prefetch(row(rows, i) + 2, 1);
#else
  (void) rows;
  (void) i;
#endif
}

}    // namespace LAMMPS_NS

#endif
