// SPDX-License-Identifier: GPL-2.0-only
#include "compute_gran_eepa_dt.h"

#include "find_contact_owners.h"
#include "run_guards.h"

#include <eepa_commands/commands.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

using namespace LAMMPS_NS;

ComputeGranEepaDt::ComputeGranEepaDt(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg)
{
  for (int iarg = 3; iarg < narg; iarg += 5) {
    if (std::strcmp(arg[iarg], "particles") != 0)
      error->all(FLERR, "compute gran/eepa/dt: keyword '{}' is unknown: it must be particles",
                 arg[iarg]);
    parse_particles(narg, arg, iarg + 1);
  }
  require_consistent_units(lmp, "compute gran/eepa/dt");
  scalar_flag = 1;
  extscalar = 0;
}

void ComputeGranEepaDt::parse_particles(int narg, char **arg, int iarg)
{
  if (iarg + 4 > narg)
    error->all(FLERR, "compute gran/eepa/dt: missing value: particles type d_min d_max density");
  try {
    const double type = eepa::parse_number("particles type", arg[iarg]);
    if (type != std::floor(type) || type < 1.0 || type > atom->ntypes)
      eepa::refuse_value("particles type", type, fmt::format("from 1 to {}", atom->ntypes));
    AnnouncedParticles come;
    come.type = static_cast<int>(type);
    come.smallest = eepa::parse_number("particles d_min", arg[iarg + 1]);
    if (come.smallest <= 0.0) eepa::refuse_value("particles d_min", come.smallest, "> 0");
    come.largest = eepa::parse_number("particles d_max", arg[iarg + 2]);
    if (come.largest < come.smallest)
      eepa::refuse_value("particles d_max", come.largest,
                         fmt::format(">= d_min = {:g}", come.smallest));
    come.density = eepa::parse_number("particles density", arg[iarg + 3]);
    if (come.density <= 0.0) eepa::refuse_value("particles density", come.density, "> 0");
    announced.push_back(come);
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "compute gran/eepa/dt: {}", e.what());
  }
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
    scalar = std::min(scalar, pair->largest_time_step(announced).time_step);
  for (auto *wall : find_eepa_walls(modify))
    scalar = std::min(scalar, wall->largest_time_step(announced).time_step);
  if (std::isinf(scalar) && !warned && comm->me == 0)
    error->warning(FLERR,
                   "compute {} gran/eepa/dt: there are no particles yet and the time step has no "
                   "limit; announce those to come with keyword particles",
                   id);
  warned = true;
  return scalar;
}
