// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TESTS_KOKKOS_COUNTS_H
#define EEPA_TESTS_KOKKOS_COUNTS_H

/// What Kokkos has done since the last reset, summed over all names that contain `name`.
enum EepaCount {
  EEPA_REGIONS,         ///< number of regions of profiles that were entered
  EEPA_KERNELS,         ///< number of kernels that were started
  EEPA_COPIED_BYTES,    ///< bytes copied from another view; between two spaces if there are two
  EEPA_N_COUNTS
};

extern "C" {
unsigned long long eepa_counted(EepaCount, const char *name);
void eepa_reset_counts();
}

#endif
