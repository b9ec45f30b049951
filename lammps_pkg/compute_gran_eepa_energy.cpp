// SPDX-License-Identifier: GPL-2.0-only
#include "compute_gran_eepa_energy.h"

#include "find_contact_owners.h"
#include "run_guards.h"

#include "error.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

ComputeGranEepaEnergy::ComputeGranEepaEnergy(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg)
{
  if (narg != 3)
    error->all(FLERR, "compute gran/eepa/energy takes no arguments, {} given: {}", narg - 3,
               arg[3]);
  require_consistent_units(lmp, "compute gran/eepa/energy");
  if (igroup != 0)
    error->all(FLERR, "compute gran/eepa/energy: group {} is not allowed: it must be all", arg[1]);
  vector_flag = 1;
  size_vector = N_QUANTITIES;
  extvector = 1;
  vector = new double[N_QUANTITIES];
}

ComputeGranEepaEnergy::~ComputeGranEepaEnergy()
{
  delete[] vector;
}

void ComputeGranEepaEnergy::init()
{
  require_contacts_of_eepa("compute gran/eepa/energy", lmp);
}

void ComputeGranEepaEnergy::compute_vector()
{
  invoked_vector = update->ntimestep;
  EnergyLedger sum;
  const auto add = [&sum](const EnergyLedger &ledger) {
    sum.elastic.add(ledger.elastic, 1.0);
    sum.dissipated.add(ledger.dissipated, 1.0);
    sum.wall_work += ledger.wall_work;
  };
  for (auto *pair : find_eepa_pairs(force)) add(pair->energy_ledger());
  for (auto *wall : find_eepa_walls(modify)) add(wall->energy_ledger());

  double mine[N_QUANTITIES];
  mine[ELASTIC_NORMAL] = sum.elastic.normal;
  mine[ELASTIC_TANGENTIAL] = sum.elastic.tangential;
  mine[ELASTIC_ROLLING] = sum.elastic.rolling;
  mine[DISSIPATED_HYSTERESIS] = sum.dissipated.hysteresis;
  mine[DISSIPATED_NORMAL_DASHPOT] = sum.dissipated.normal_dashpot;
  mine[DISSIPATED_TANGENTIAL_DASHPOT] = sum.dissipated.tangential_dashpot;
  mine[DISSIPATED_SLIDING] = sum.dissipated.sliding;
  mine[DISSIPATED_ROLLING] = sum.dissipated.rolling;
  mine[WALL_WORK] = sum.wall_work;
  mine[ELASTIC_TWISTING] = sum.elastic.twisting;
  mine[DISSIPATED_TWISTING] = sum.dissipated.twisting;
  MPI_Allreduce(mine, vector, N_QUANTITIES, MPI_DOUBLE, MPI_SUM, world);
}
