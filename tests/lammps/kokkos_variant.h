// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TESTS_KOKKOS_VARIANT_H
#define EEPA_TESTS_KOKKOS_VARIANT_H

#include "simulation.h"

#include "counts.h"

#include <cstdlib>
#include <dlfcn.h>

namespace eepa_test {

/// A LAMMPS with KOKKOS, whatever the environment says, or one without.
class Variant : public Simulation {
 public:
  explicit Variant(bool kokkos, MPI_Comm comm = MPI_COMM_WORLD,
                   KokkosComm kokkos_comm = KokkosComm::device) :
      Simulation(comm, "none", kokkos ? with_kokkos(kokkos_comm) : std::vector<std::string>())
  {
  }

 private:
  static std::vector<std::string> with_kokkos(KokkosComm comm)
  {
    const char *where = std::getenv("EEPA_TEST_KOKKOS");
    if (!where) where = std::getenv("EEPA_KOKKOS_DEVICE");
    return kokkos_with(where ? where : "t 1", comm);
  }
};

/// What Kokkos has done, as tests/kokkos_tool counts it.
struct KokkosCounts {
  decltype(&eepa_counted) counted = nullptr;
  decltype(&eepa_reset_counts) reset = nullptr;

  KokkosCounts()
  {
    const char *path = std::getenv("KOKKOS_TOOLS_LIBS");
    void *library = path ? dlopen(path, RTLD_LAZY | RTLD_NOLOAD) : nullptr;
    if (!library) return;
    counted = reinterpret_cast<decltype(counted)>(dlsym(library, "eepa_counted"));
    reset = reinterpret_cast<decltype(reset)>(dlsym(library, "eepa_reset_counts"));
  }
};

}    // namespace eepa_test

#endif
