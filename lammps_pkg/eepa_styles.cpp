// SPDX-License-Identifier: GPL-2.0-only
#include "eepa_styles.h"

#include "compute_gran_eepa_contacts.h"
#include "compute_gran_eepa_dt.h"
#include "compute_gran_eepa_energy.h"
#include "compute_gran_eepa_energy_atom.h"
#include "fix_wall_gran_eepa.h"
#include "pair_gran_eepa.h"
#ifdef _OPENMP
#include "pair_gran_eepa_omp.h"
#endif
#ifdef EEPA_KOKKOS
#include "kokkos/kokkos_styles.h"
#endif

#include "force.h"
#include "lammps.h"
#include "modify.h"

#include <string>

using namespace LAMMPS_NS;

namespace {
template <class Style> Pair *pair_maker(LAMMPS *lmp)
{
  return new Style(lmp);
}
template <class Base, class Style> Base *maker(LAMMPS *lmp, int narg, char **arg)
{
  return new Style(lmp, narg, arg);
}
}    // namespace

const std::vector<EepaStyle> &LAMMPS_NS::eepa_styles()
{
  static const std::vector<EepaStyle> styles = {
      {"pair", "gran/eepa", "elasto-plastic adhesive frictional contact law",
       pair_maker<PairGranEepa>, nullptr, nullptr},
#ifdef _OPENMP
      {"pair", "gran/eepa/omp", "the same with threads", pair_maker<PairGranEepaOMP>, nullptr,
       nullptr},
#endif
#ifdef EEPA_KOKKOS
      {"pair", "gran/eepa/kk", "the same on the device of KOKKOS", make_gran_eepa_on_device, nullptr,
       nullptr},
      {"pair", "gran/eepa/kk/device", "the same", make_gran_eepa_on_device, nullptr, nullptr},
      {"pair", "gran/eepa/kk/host", "the same on the host, with KOKKOS", make_gran_eepa_on_host,
       nullptr, nullptr},
#endif
      {"fix", "wall/gran/eepa", "walls of pair style gran/eepa", nullptr,
       maker<Fix, FixWallGranEepa>, nullptr},
#ifdef EEPA_KOKKOS
      {"fix", "wall/gran/eepa/kk", "the same on the device of KOKKOS", nullptr,
       make_wall_gran_eepa_on_device, nullptr},
      {"fix", "wall/gran/eepa/kk/device", "the same", nullptr, make_wall_gran_eepa_on_device,
       nullptr},
      {"fix", "wall/gran/eepa/kk/host", "the same on the host, with KOKKOS", nullptr,
       make_wall_gran_eepa_on_host, nullptr},
#endif
      {"compute", "gran/eepa/contacts", "contacts by branch, coordination number", nullptr, nullptr,
       maker<Compute, ComputeGranEepaContacts>},
      {"compute", "gran/eepa/energy", "stored and dissipated energies", nullptr, nullptr,
       maker<Compute, ComputeGranEepaEnergy>},
      {"compute", "gran/eepa/energy/atom", "dissipated energies of each particle", nullptr, nullptr,
       maker<Compute, ComputeGranEepaEnergyAtom>},
      {"compute", "gran/eepa/dt", "largest stable time step", nullptr, nullptr,
       maker<Compute, ComputeGranEepaDt>},
  };
  return styles;
}

void LAMMPS_NS::register_eepa_style(LAMMPS *lmp, const EepaStyle &style)
{
  const std::string name = style.name;
  if (style.make_pair) (*lmp->force->pair_map)[name] = style.make_pair;
  if (style.make_fix) (*lmp->modify->fix_map)[name] = style.make_fix;
  if (style.make_compute) (*lmp->modify->compute_map)[name] = style.make_compute;
}

bool LAMMPS_NS::has_eepa_style(const LAMMPS *lmp, const EepaStyle &style)
{
  const std::string name = style.name;
  if (style.make_pair) return lmp->force->pair_map->count(name) > 0;
  if (style.make_fix) return lmp->modify->fix_map->count(name) > 0;
  return lmp->modify->compute_map->count(name) > 0;
}

void LAMMPS_NS::register_eepa_styles(LAMMPS *lmp)
{
  for (const auto &style : eepa_styles()) register_eepa_style(lmp, style);
}
