// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TESTS_PACKING_H
#define EEPA_TESTS_PACKING_H

#include "simulation.h"

#include <random>

namespace eepa_test {

/// Uniform in [-1, 1]; the same numbers with every library, unlike std distributions.
inline double uniform(std::mt19937 &generator)
{
  return static_cast<double>(generator()) / 2147483647.5 - 1.0;
}

inline Vec3 uniform_vector(std::mt19937 &generator)
{
  const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
  return {x, y, z};
}

/// A shaken cubic lattice in [-half, half]^3 whose neighbours overlap by a few percent.
struct Packing {
  int side = 6;             ///< particles along an edge
  double spacing = 0.97;    ///< between centres; the diameter is 1
  double jitter = 0.02;     ///< of positions and radii
  double speed = 0.5;       ///< of velocities, and of surfaces through spin
  int types = 1;
  bool polydisperse = false;

  double half() const { return 0.5 * side * spacing; }

  std::vector<Sphere> spheres(unsigned seed = 1) const
  {
    std::mt19937 generator(seed);
    std::vector<Sphere> all;
    for (int k = 0; k < side; k++) {
      for (int j = 0; j < side; j++) {
        for (int i = 0; i < side; i++) {
          Sphere s;
          s.x = spacing * (Vec3(i, j, k) - Vec3::Constant(0.5 * (side - 1))) +
              jitter * uniform_vector(generator);
          s.v = speed * uniform_vector(generator);
          s.omega = 2.0 * speed * uniform_vector(generator);
          if (polydisperse) s.radius = 0.5 + jitter * uniform(generator);
          s.type = 1 + static_cast<int>(all.size()) % types;
          all.push_back(s);
        }
      }
    }
    return all;
  }
};

}    // namespace eepa_test

#endif
