// SPDX-License-Identifier: GPL-2.0-only
#include "coefficient_classes.h"

#include <eepa_commands/restart_numbers.h>

#include <algorithm>
#include <array>

namespace LAMMPS_NS {

void CoefficientClasses::choose(int types, const std::vector<eepa::Parameters> &parameters,
                                const std::vector<eepa::Coefficients> &coefficients)
{
  // pair_coeff * * gives many pairs of types the same coefficients
  std::vector<std::array<double, eepa::packed_parameters_size>> given;
  std::vector<std::size_t> class_of(parameters.size());
  rows.clear();
  stride = types + 1;
  for (int i = 1; i <= types; i++) {
    for (int j = i; j <= types; j++) {
      const int pair = i * stride + j;
      const auto own = eepa::pack(parameters[pair]);
      const auto same = std::find(given.begin(), given.end(), own);
      class_of[pair] = class_of[j * stride + i] = same - given.begin();
      if (same != given.end()) continue;
      if (given.empty()) some = coefficients[pair];
      given.push_back(own);
      rows.emplace_back(coefficients[pair]);
    }
  }
  of_pair.resize(class_of.size());
  for (std::size_t pair = 0; pair < class_of.size(); pair++) of_pair[pair] = &rows[class_of[pair]];
}

}    // namespace LAMMPS_NS
