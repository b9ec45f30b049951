// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_MACROS_H
#define EEPA_MACROS_H

/// Marks every function of the kernel: inline, and compiled for host and device
/// alike when a CUDA or HIP compiler (KOKKOS) includes these headers.
#if defined(__CUDACC__) || defined(__HIPCC__)
#define EEPA_FUNCTION __host__ __device__ inline
#else
#define EEPA_FUNCTION inline
#endif

#endif
