// SPDX-License-Identifier: GPL-2.0-only
#include "compute_gran_eepa_dt.h"

#include "find_contact_owners.h"

#include "error.h"
#include "update.h"

#include <algorithm>
#include <limits>

using namespace LAMMPS_NS;

ComputeGranEepaDt::ComputeGranEepaDt(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg)
{
  if (narg != 3)
    error->all(FLERR, "compute gran/eepa/dt takes no arguments, {} given: {}", narg - 3, arg[3]);
  scalar_flag = 1;
  extscalar = 0;
}

void ComputeGranEepaDt::init()
{
  if (find_eepa_pairs(force).empty() && find_eepa_walls(modify).empty())
    error->all(FLERR, "compute gran/eepa/dt needs pair_style gran/eepa or fix wall/gran/eepa");
}

double ComputeGranEepaDt::compute_scalar()
{
  invoked_scalar = update->ntimestep;
  scalar = std::numeric_limits<double>::infinity();
  for (auto *pair : find_eepa_pairs(force))
    scalar = std::min(scalar, pair->largest_time_step().time_step);
  for (auto *wall : find_eepa_walls(modify))
    scalar = std::min(scalar, wall->largest_time_step().time_step);
  return scalar;
}
