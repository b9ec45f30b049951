// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_LANES_H
#define EEPA_LANES_H

// Several doubles side by side, from the Parallelism TS 2 that GCC's standard library has had
// since version 11. Where it is missing, EEPA_HAS_LANES is not defined and drivers evaluate one
// contact at a time.

#if defined(__has_include) && !defined(__CUDACC__) && !defined(__HIPCC__)
#if __has_include(<experimental/simd>)
#include <experimental/simd>
#endif
#endif

#ifdef __cpp_lib_experimental_parallel_simd
// where() of GCC 12's library, compiled by clang for AVX-512, selects the wrong one of two lanes.
#if !(defined(__clang__) && defined(__AVX512F__))
#define EEPA_HAS_LANES 1
#endif
#endif

#ifdef EEPA_HAS_LANES

#include "eigen.h"

namespace eepa {
/// As many doubles as a register holds, 4 at most: 2 with SSE2, 4 with AVX, AVX2 and AVX-512. For
/// 8, the square root of GCC 12's library does not compile without a warning.
using Lanes = std::experimental::simd<
    double, std::experimental::simd_abi::deduce_t<
                double, (std::experimental::native_simd<double>::size() < 4
                             ? std::experimental::native_simd<double>::size()
                             : 4)>>;
}    // namespace eepa

namespace Eigen {
/// Lets Lanes be the scalar type of an Eigen::Matrix.
template <> struct NumTraits<eepa::Lanes> {
  using Real = eepa::Lanes;
  using NonInteger = eepa::Lanes;
  using Nested = eepa::Lanes;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
}    // namespace Eigen
#endif

#endif
