// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_RUN_GUARDS_H
#define LMP_EEPA_RUN_GUARDS_H

// What the styles of this package can not work with, refused by name before a step is run, and
// what is likely to be a mistake, named once.

#include <string>

namespace LAMMPS_NS {

class LAMMPS;

/// An error where force is not mass times acceleration in the chosen units.
/// \param who  begins the message: "pair_style gran/eepa"
void require_consistent_units(LAMMPS *, const std::string &who);

/// An error where a command, an integrator, a fix or a compute asks for forces more or less than
/// once a step. To be called in an init.
void require_force_once_a_step(LAMMPS *, const std::string &who);

/// An error with comm_style tiled and newton on, of which LAMMPS says less.
void require_history_communication(LAMMPS *, const std::string &who);

/// \return what to say about fixes that move particles and do not turn them, "" without one
/// \param mu  the largest coefficient of friction
std::string advice_on_rotation(LAMMPS *, double mu);

/// \return what to say about fix heat/flow, to which no contact of this package brings heat
std::string advice_on_heat(LAMMPS *);

/// \return what to say about the command rerun, "" in any other
std::string advice_on_rerun(LAMMPS *);

}    // namespace LAMMPS_NS

#endif
