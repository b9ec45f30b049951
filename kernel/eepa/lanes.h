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
#define EEPA_HAS_LANES 1

#include <Eigen/Core>

namespace eepa {
/// As many doubles as a register holds: 2 with SSE2, 4 with AVX2, 8 with AVX-512.
using Lanes = std::experimental::native_simd<double>;
}    // namespace eepa

namespace Eigen {
/// Lets Lanes be the numbers of an Eigen::Matrix.
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
