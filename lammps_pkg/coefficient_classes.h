// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_COEFFICIENT_CLASSES_H
#define LMP_EEPA_COEFFICIENT_CLASSES_H

#include <eepa/coefficient_rows.h>
#include <eepa/coefficients.h>
#include <eepa/parameters.h>

#include <vector>

namespace LAMMPS_NS {

/// The different sets of coefficients among all pairs of types. Where there is one, all contacts of
/// a run have the same coefficients; where there are more, each contact has those of its class.
class CoefficientClasses {
 public:
  bool empty() const { return rows.empty(); }
  void clear() { rows.clear(); }

  /// \param types  number of types, which are numbered from 1
  /// \param parameters, coefficients  of each pair of types, (types + 1)^2, by i (types + 1) + j
  void choose(int types, const std::vector<eepa::Parameters> &parameters,
              const std::vector<eepa::Coefficients> &coefficients);

  bool all_the_same() const { return rows.size() == 1; }
  /// Coefficients of all contacts where all_the_same(); else of some.
  const eepa::Coefficients &first() const { return some; }

  /// Finds the coefficients of a pair of types.
  struct Table {
    const eepa::CoefficientRows *const *of_pair;
    int stride;

    EEPA_FUNCTION const eepa::CoefficientRows *operator()(int itype, int jtype) const
    {
      return of_pair[itype * stride + jtype];
    }
  };
  Table table() const { return {of_pair.data(), stride}; }

  double memory_usage() const
  {
    return static_cast<double>(rows.capacity() * sizeof(eepa::CoefficientRows) +
                               of_pair.capacity() * sizeof(eepa::CoefficientRows *));
  }

 private:
  eepa::Coefficients some{};
  std::vector<eepa::CoefficientRows> rows;               // one a class
  std::vector<const eepa::CoefficientRows *> of_pair;    // (types + 1)^2
  int stride = 0;
};

}    // namespace LAMMPS_NS

#endif
