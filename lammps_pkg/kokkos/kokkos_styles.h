// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_KOKKOS_STYLES_H
#define LMP_EEPA_KOKKOS_STYLES_H

namespace LAMMPS_NS {

class Pair;
class LAMMPS;

// Makers of the styles for KOKKOS, for source files that are compiled without it.
Pair *make_gran_eepa_on_device(LAMMPS *);
Pair *make_gran_eepa_on_host(LAMMPS *);

}    // namespace LAMMPS_NS

#endif
