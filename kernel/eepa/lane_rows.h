// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_LANE_ROWS_H
#define EEPA_LANE_ROWS_H

#include "real.h"
#include "vector.h"

#ifdef EEPA_HAS_LANES

#ifdef __AVX__
#include <immintrin.h>
#endif

#include <array>
#include <cstddef>

// Converts a driver's rows, 3 doubles a particle, into vectors with a contact in each lane, and
// back. This transposition is half of the cost of a contact. Compilers do it one number at a time;
// with AVX it takes two or four at once.

namespace eepa {

#ifdef __AVX__
namespace detail {
  EEPA_FUNCTION std::array<Lanes, 4> transpose(const __m256d (&row)[4])
  {
    const __m256d a = _mm256_permute2f128_pd(row[0], row[2], 0x20),
                  b = _mm256_permute2f128_pd(row[1], row[3], 0x20),
                  c = _mm256_permute2f128_pd(row[0], row[2], 0x31),
                  d = _mm256_permute2f128_pd(row[1], row[3], 0x31);
    return {Lanes(_mm256_unpacklo_pd(a, b)), Lanes(_mm256_unpackhi_pd(a, b)),
            Lanes(_mm256_unpacklo_pd(c, d)), Lanes(_mm256_unpackhi_pd(c, d))};
  }
}    // namespace detail
#endif

/// One pointer for each lane.
template <class T> using LanePointers = T *[Lanes::size()];

/// The numbers that the lanes point at.
EEPA_FUNCTION Lanes gather_numbers(const LanePointers<const double> &at)
{
  return Lanes([&at](auto lane) EEPA_LAMBDA { return *at[lane]; });
}

/// The rows of 3 numbers that the lanes point at.
EEPA_FUNCTION Vector3<Lanes> gather_rows(const LanePointers<const double> &at)
{
#ifdef __AVX__
  if constexpr (Lanes::size() == 4) {
    const __m256d even =
        _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(at[0])), _mm_loadu_pd(at[2]), 1);
    const __m256d odd =
        _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(at[1])), _mm_loadu_pd(at[3]), 1);
    const __m128d low = _mm_loadh_pd(_mm_load_sd(at[0] + 2), at[1] + 2);
    const __m128d high = _mm_loadh_pd(_mm_load_sd(at[2] + 2), at[3] + 2);
    return Vector3<Lanes>(
        Lanes(_mm256_unpacklo_pd(even, odd)), Lanes(_mm256_unpackhi_pd(even, odd)),
        Lanes(_mm256_insertf128_pd(_mm256_castpd128_pd256(low), high, 1)));
  }
#endif
  return Vector3<Lanes>(Lanes([&at](auto lane) EEPA_LAMBDA { return at[lane][0]; }),
                        Lanes([&at](auto lane) EEPA_LAMBDA { return at[lane][1]; }),
                        Lanes([&at](auto lane) EEPA_LAMBDA { return at[lane][2]; }));
}

/// The rows of 4 numbers that the lanes point at.
template <class T>
EEPA_FUNCTION std::array<Lanes, 4> gather_rows_of_4(const LanePointers<T> &at)
{
#ifdef __AVX__
  if constexpr (Lanes::size() == 4) {
    const __m256d row[4] = {_mm256_loadu_pd(at[0]), _mm256_loadu_pd(at[1]), _mm256_loadu_pd(at[2]),
                            _mm256_loadu_pd(at[3])};
    return detail::transpose(row);
  }
#endif
  const auto column = [&at](int k) EEPA_LAMBDA {
    return Lanes([&at, k](auto lane) EEPA_LAMBDA { return at[lane][k]; });
  };
  return {column(0), column(1), column(2), column(3)};
}

/// The inverse of gather_rows_of_4.
EEPA_FUNCTION void scatter_rows_of_4(const std::array<Lanes, 4> &column,
                                     const LanePointers<double> &at)
{
#ifdef __AVX__
  if constexpr (Lanes::size() == 4) {
    const __m256d native[4] = {
        static_cast<__m256d>(column[0]), static_cast<__m256d>(column[1]),
        static_cast<__m256d>(column[2]), static_cast<__m256d>(column[3])};
    const std::array<Lanes, 4> row = detail::transpose(native);
    for (int lane = 0; lane < 4; lane++)
      _mm256_storeu_pd(at[lane], static_cast<__m256d>(row[lane]));
    return;
  }
#endif
  for (std::size_t lane = 0; lane < Lanes::size(); lane++)
    for (int k = 0; k < 4; k++) at[lane][k] = column[k][lane];
}

/// The vector of each lane as a row of 3 numbers.
class LaneRows {
 public:
  EEPA_FUNCTION explicit LaneRows(const Vector3<Lanes> &vector)
  {
#ifdef __AVX__
    if constexpr (Lanes::size() == 4) {
      const __m256d x = static_cast<__m256d>(vector[0]), y = static_cast<__m256d>(vector[1]),
                    z = static_cast<__m256d>(vector[2]);
      const __m256d even = _mm256_unpacklo_pd(x, y), odd = _mm256_unpackhi_pd(x, y);
      xy_[0] = _mm256_castpd256_pd128(even);
      xy_[1] = _mm256_castpd256_pd128(odd);
      xy_[2] = _mm256_extractf128_pd(even, 1);
      xy_[3] = _mm256_extractf128_pd(odd, 1);
      z_[0] = _mm256_castpd256_pd128(z);
      z_[1] = _mm_unpackhi_pd(z_[0], z_[0]);
      z_[2] = _mm256_extractf128_pd(z, 1);
      z_[3] = _mm_unpackhi_pd(z_[2], z_[2]);
      return;
    }
#endif
    for (std::size_t lane = 0; lane < Lanes::size(); lane++)
      for (int k = 0; k < 3; k++) set(lane, k, vector[k][lane]);
  }

  EEPA_FUNCTION void add_to(double *row, std::size_t lane) const
  {
    combine(row, lane, [](auto a, auto b) EEPA_LAMBDA { return a + b; });
  }
  EEPA_FUNCTION void subtract_from(double *row, std::size_t lane) const
  {
    combine(row, lane, [](auto a, auto b) EEPA_LAMBDA { return a - b; });
  }
  EEPA_FUNCTION void store(double *row, std::size_t lane) const
  {
    combine(row, lane, [](auto, auto b) EEPA_LAMBDA { return b; });
  }
  EEPA_FUNCTION Vec3 operator[](std::size_t lane) const
  {
    Vec3 row;
    store(row.data(), lane);
    return row;
  }

 private:
#ifdef __AVX__
  __m128d xy_[Lanes::size()], z_[Lanes::size()];

  EEPA_FUNCTION void set(std::size_t lane, int k, double value)
  {
    if (k == 2)
      z_[lane] = _mm_set_sd(value);
    else
      xy_[lane] = k ? _mm_loadh_pd(xy_[lane], &value) : _mm_set_sd(value);
  }
  template <class Operation>
  EEPA_FUNCTION void combine(double *row, std::size_t lane, Operation operation) const
  {
    _mm_storeu_pd(row, operation(_mm_loadu_pd(row), xy_[lane]));
    row[2] = operation(row[2], _mm_cvtsd_f64(z_[lane]));
  }
#else
  double rows_[Lanes::size()][3];

  EEPA_FUNCTION void set(std::size_t lane, int k, double value) { rows_[lane][k] = value; }
  template <class Operation>
  EEPA_FUNCTION void combine(double *row, std::size_t lane, Operation operation) const
  {
    for (int k = 0; k < 3; k++) row[k] = operation(row[k], rows_[lane][k]);
  }
#endif
};

}    // namespace eepa

#endif
#endif
