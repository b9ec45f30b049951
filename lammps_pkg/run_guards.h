// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_RUN_GUARDS_H
#define LMP_EEPA_RUN_GUARDS_H

// Checks before a run: what the styles of this package can not work with is refused by name, and
// what is likely to be a mistake is named once.

#include <string>

namespace LAMMPS_NS {

class LAMMPS;

/// Stops in units in which force is not mass times acceleration.
/// \param who  begins the message: "pair_style gran/eepa"
void require_consistent_units(LAMMPS *, const std::string &who);

/// Stops where a command, an integrator, a fix or a compute asks for forces more or less often than
/// once a step. To be called in an init.
void require_force_once_a_step(LAMMPS *, const std::string &who);

/// Stops with comm_style tiled and newton on; LAMMPS's own error is less clear.
void require_history_communication(LAMMPS *, const std::string &who);

/// Warning of fixes that move particles and do not turn them.
/// \param mu  the largest coefficient of friction
/// \return the text, "" where there is no such fix or mu = 0
std::string advice_on_rotation(LAMMPS *, double mu);

/// \return warning of fix heat/flow, as contacts of this package conduct no heat; "" without one
std::string advice_on_heat(LAMMPS *);

/// \return warning of the command rerun, "" in any other command
std::string advice_on_rerun(LAMMPS *);

/// Advice where particles are on a device and a wall is on the host, "" otherwise.
std::string advice_on_device(LAMMPS *);

}    // namespace LAMMPS_NS

#endif
