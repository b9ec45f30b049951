// SPDX-License-Identifier: GPL-2.0-only

// build/lmp: LAMMPS with the styles of this package. LAMMPS itself is a shared library.

#include "eepa_styles.h"

#include "exceptions.h"
#include "input.h"
#include "lammps.h"

#include <mpi.h>

#include <cstdio>
#include <exception>

using namespace LAMMPS_NS;

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  try {
    LAMMPS lammps(argc, argv, MPI_COMM_WORLD);
    register_eepa_styles(&lammps);
    lammps.input->file();
  } catch (LAMMPSAbortException &abort) {    // one rank only failed
    MPI_Abort(abort.get_universe(), 1);
  } catch (LAMMPSException &) {    // all ranks failed alike, and said so
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Finalize();
    return 1;
  } catch (std::exception &failure) {
    std::fprintf(stderr, "Exception: %s\n", failure.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Finalize();
  return 0;
}
