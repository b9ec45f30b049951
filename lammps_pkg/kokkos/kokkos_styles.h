// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_KOKKOS_STYLES_H
#define LMP_EEPA_KOKKOS_STYLES_H

namespace LAMMPS_NS {

class Fix;
class LAMMPS;
class Pair;

// Makers of the styles for KOKKOS, for source files that are compiled without it.
Pair *make_gran_eepa_on_device(LAMMPS *);
Pair *make_gran_eepa_on_host(LAMMPS *);
Fix *make_wall_gran_eepa_on_device(LAMMPS *, int, char **);
Fix *make_wall_gran_eepa_on_host(LAMMPS *, int, char **);

}    // namespace LAMMPS_NS

#endif
