// SPDX-License-Identifier: GPL-2.0-only
#include "compute_gran_eepa_energy_atom.h"

#include "find_contact_owners.h"
#include "run_guards.h"

#include "atom.h"
#include "error.h"
#include "fix_store_atom.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

ComputeGranEepaEnergyAtom::ComputeGranEepaEnergyAtom(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg)
{
  if (narg != 3)
    error->all(FLERR, "compute gran/eepa/energy/atom takes no arguments, {} given: {}", narg - 3,
               arg[3]);
  require_consistent_units(lmp, "compute gran/eepa/energy/atom");
  peratom_flag = 1;
  size_peratom_cols = AtomLosses::kinds;
  create_attribute = 1;
  // for all particles, because they may join the group later
  store_id = std::string(id) + "_COMPUTE_STORE";
  store = dynamic_cast<FixStoreAtom *>(
      modify->add_fix(fmt::format("{} all STORE/ATOM {} 0 0 0", store_id, AtomLosses::kinds)));
}

ComputeGranEepaEnergyAtom::~ComputeGranEepaEnergyAtom()
{
  if (modify->nfix) modify->delete_fix(store_id);
  memory->destroy(array_atom);
}

void ComputeGranEepaEnergyAtom::init()
{
  store = dynamic_cast<FixStoreAtom *>(modify->get_fix_by_id(store_id));
  if (!store) error->all(FLERR, "compute gran/eepa/energy/atom: its fix {} was deleted", store_id);
  require_contacts_of_eepa("compute gran/eepa/energy/atom", lmp);
}

void ComputeGranEepaEnergyAtom::add(int atom, const double *losses)
{
  for (int k = 0; k < AtomLosses::kinds; k++) store->astore[atom][k] += losses[k];
}

void ComputeGranEepaEnergyAtom::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(array_atom);
    memory->create(array_atom, nmax, size_peratom_cols, "gran/eepa/energy/atom:array_atom");
  }
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom->mask[i] & groupbit)
      std::copy_n(store->astore[i], size_peratom_cols, array_atom[i]);
    else
      std::fill_n(array_atom[i], size_peratom_cols, 0.0);
  }
}

/// A new particle has dissipated nothing.
void ComputeGranEepaEnergyAtom::set_arrays(int i)
{
  std::fill_n(store->astore[i], size_peratom_cols, 0.0);
}

double ComputeGranEepaEnergyAtom::memory_usage()
{
  return static_cast<double>(nmax) * size_peratom_cols * sizeof(double);
}

std::vector<ComputeGranEepaEnergyAtom *> ComputeGranEepaEnergyAtom::find(Modify *modify)
{
  std::vector<ComputeGranEepaEnergyAtom *> found;
  for (auto *compute : modify->get_compute_list())
    if (auto *one = dynamic_cast<ComputeGranEepaEnergyAtom *>(compute)) found.push_back(one);
  return found;
}
