// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CITATIONS_H
#define LMP_EEPA_CITATIONS_H

#include <eepa/parameters.h>

namespace LAMMPS_NS {

/// Hands the papers of the chosen law and models to LAMMPS, which prints each once before the run.
/// To be called while commands are read: what is added in an init, LAMMPS prints at the end.
void cite_papers(class LAMMPS *, const eepa::LawSettings &, const eepa::Parameters &);

}    // namespace LAMMPS_NS

#endif
