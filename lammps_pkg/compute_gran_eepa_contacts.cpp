// SPDX-License-Identifier: GPL-2.0-only
#include "compute_gran_eepa_contacts.h"

#include "find_contact_owners.h"
#include "run_guards.h"

#include "error.h"
#include "group.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

ComputeGranEepaContacts::ComputeGranEepaContacts(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg)
{
  if (narg != 3)
    error->all(FLERR, "compute gran/eepa/contacts takes no arguments, {} given: {}", narg - 3,
               arg[3]);
  require_consistent_units(lmp, "compute gran/eepa/contacts");
  vector_flag = 1;
  size_vector = N_QUANTITIES;
  extvector = -1;
  extlist = new int[N_QUANTITIES];
  std::fill_n(extlist, static_cast<int>(N_QUANTITIES), 0);
  std::fill_n(extlist, SLIDING + 1, 1);
  extlist[WALL_CONTACTS] = 1;
  vector = new double[N_QUANTITIES];
}

ComputeGranEepaContacts::~ComputeGranEepaContacts()
{
  delete[] extlist;
  delete[] vector;
}

void ComputeGranEepaContacts::init()
{
  if (find_eepa_pairs(force).empty())
    error->all(FLERR, "compute gran/eepa/contacts needs pair_style gran/eepa");
}

void ComputeGranEepaContacts::compute_vector()
{
  invoked_vector = update->ntimestep;
  ContactCensus total;
  double overlap_sum = 0.0;
  for (auto *pair : find_eepa_pairs(force)) {
    const ContactCensus census = pair->census(groupbit);
    total.contacts += census.contacts;
    total.loading += census.loading;
    total.unloading += census.unloading;
    total.adhesive += census.adhesive;
    total.sliding += census.sliding;
    total.ends += census.ends;
    total.max_overlap_ratio = std::max(total.max_overlap_ratio, census.max_overlap_ratio);
    overlap_sum += census.contacts * census.mean_overlap_ratio;
  }
  const auto particles = static_cast<double>(group->count(igroup));
  vector[CONTACTS] = total.contacts;
  vector[LOADING] = total.loading;
  vector[UNLOADING] = total.unloading;
  vector[ADHESIVE] = total.adhesive;
  vector[SLIDING] = total.sliding;
  vector[COORDINATION_NUMBER] = particles > 0.0 ? total.ends / particles : 0.0;
  vector[MAX_OVERLAP_RATIO] = total.max_overlap_ratio;
  vector[MEAN_OVERLAP_RATIO] = total.contacts > 0.0 ? overlap_sum / total.contacts : 0.0;
  vector[WALL_CONTACTS] = 0.0;
  for (auto *wall : find_eepa_walls(modify)) vector[WALL_CONTACTS] += wall->contacts();
}
