// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_MACROS_H
#define EEPA_MACROS_H

/// Marks every function of the kernel: compiled for host and device alike when a CUDA or HIP
/// compiler (KOKKOS) includes these headers, and inlined without fail. Left to themselves
/// compilers stop inlining once a law is used in a second loop, and a contact then takes twice
/// the instructions, its vectors passed through memory. EEPA_PLAIN_INLINE leaves it to them: with
/// sanitizers a loop that has everything inlined takes many minutes to compile.
#if defined(__CUDACC__) || defined(__HIPCC__)
#define EEPA_FUNCTION __host__ __device__ __forceinline__
#elif (defined(__GNUC__) || defined(__clang__)) && !defined(EEPA_PLAIN_INLINE)
#define EEPA_FUNCTION inline __attribute__((always_inline))
#else
#define EEPA_FUNCTION inline
#endif

/// The same for a lambda; it stands behind the parameters.
#if (defined(__GNUC__) || defined(__clang__)) && !defined(EEPA_PLAIN_INLINE)
#define EEPA_LAMBDA __attribute__((always_inline))
#else
#define EEPA_LAMBDA
#endif

#endif
