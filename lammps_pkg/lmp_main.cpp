// SPDX-License-Identifier: GPL-2.0-only

// build/lmp, installed as lmp-eepa: LAMMPS that loads the plugin of this build or installation. LAMMPS loads
// it from LAMMPS_PLUGIN_PATH at every start, also after the command `clear`.

#include "exceptions.h"
#include "input.h"
#include "lammps.h"
#include "library.h"

#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

using namespace LAMMPS_NS;

namespace {

/// Puts the plugin's folder in front of LAMMPS_PLUGIN_PATH: that of this program in a build folder, and in
/// an installation EEPA_PLUGIN_FOLDER, which is relative to this program so that a prefix may be moved.
/// \return false, with a message, where the plugin is in neither
bool add_own_folder_to_plugin_path(const char *program)
{
  std::error_code failed;
  std::filesystem::path self = std::filesystem::canonical("/proc/self/exe", failed);
  if (failed) self = std::filesystem::absolute(program, failed);    // no procfs
  std::filesystem::path folder = self.parent_path();
  if (!std::filesystem::exists(folder / "eepaplugin.so", failed)) {
    const std::filesystem::path installed = (folder / EEPA_PLUGIN_FOLDER).lexically_normal();
    if (!std::filesystem::exists(installed / "eepaplugin.so", failed)) {
      std::fprintf(stderr, "ERROR: eepaplugin.so must lie beside %s or in %s\n", self.c_str(),
                   installed.c_str());
      return false;
    }
    folder = installed;
  }
  std::string path = folder.string();
  if (const char *given = std::getenv("LAMMPS_PLUGIN_PATH")) path += std::string(":") + given;
  return setenv("LAMMPS_PLUGIN_PATH", path.c_str(), 1) == 0;
}

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  if (!add_own_folder_to_plugin_path(argv[0])) MPI_Abort(MPI_COMM_WORLD, 1);
  try {
    LAMMPS lammps(argc, argv, MPI_COMM_WORLD);
    lammps.input->file();
  } catch (LAMMPSAbortException &abort) {    // one rank only failed
    MPI_Abort(abort.get_universe(), 1);
  } catch (LAMMPSException &) {    // all ranks failed, and LAMMPS printed the message
    lammps_kokkos_finalize();
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Finalize();
    return 1;
  } catch (std::exception &failure) {
    std::fprintf(stderr, "Exception: %s\n", failure.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  lammps_kokkos_finalize();    // nothing where KOKKOS was not in use
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Finalize();
  return 0;
}
