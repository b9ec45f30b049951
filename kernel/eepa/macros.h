// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_MACROS_H
#define EEPA_MACROS_H

/// Marks every function of the kernel: always inlined, and compiled for host and device by a CUDA
/// or HIP compiler. Where Kokkos is included first, Kokkos's own macro is used.
///
/// Without it, compilers stop inlining once a law is used in a second loop: a contact then takes
/// twice the instructions, and its vectors pass through memory. EEPA_PLAIN_INLINE leaves the choice
/// to the compiler: with sanitizers, a loop with everything inlined takes minutes to compile.
#if defined(KOKKOS_FORCEINLINE_FUNCTION)
#define EEPA_FUNCTION KOKKOS_FORCEINLINE_FUNCTION
#elif defined(__CUDACC__) || defined(__HIPCC__)
#define EEPA_FUNCTION __host__ __device__ __forceinline__
#elif (defined(__GNUC__) || defined(__clang__)) && !defined(EEPA_PLAIN_INLINE)
#define EEPA_FUNCTION inline __attribute__((always_inline))
#else
#define EEPA_FUNCTION inline
#endif

/// The same for a lambda of host code; the macro follows the lambda's parameters.
#if (defined(__GNUC__) || defined(__clang__)) && !defined(EEPA_PLAIN_INLINE)
#define EEPA_LAMBDA __attribute__((always_inline))
#else
#define EEPA_LAMBDA
#endif

#endif
