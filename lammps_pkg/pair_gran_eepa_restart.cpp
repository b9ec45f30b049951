// SPDX-License-Identifier: GPL-2.0-only

// Restart and data files of PairGranEepa.

#include "pair_gran_eepa.h"

#include "citations.h"

#include <eepa_commands/restart_numbers.h>

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <array>
#include <stdexcept>
#include <vector>

using namespace LAMMPS_NS;

namespace {
constexpr const char *style_name = "pair_style gran/eepa";

template <std::size_t N> void write_numbers(const std::array<double, N> &numbers, FILE *fp)
{
  fwrite(numbers.data(), sizeof(double), N, fp);
}
}    // namespace

void PairGranEepa::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  for (int i = 1; i <= atom->ntypes; i++) {
    for (int j = i; j <= atom->ntypes; j++) {
      fwrite(&setflag[i][j], sizeof(int), 1, fp);
      if (setflag[i][j]) write_numbers(eepa::pack(parameters[pair_index(i, j)]), fp);
    }
  }
}

void PairGranEepa::read_restart(FILE *fp)
{
  const int format = read_style(fp);
  allocate();
  for (int i = 1; i <= atom->ntypes; i++) {
    for (int j = i; j <= atom->ntypes; j++) {
      if (comm->me == 0) utils::sfread(FLERR, &setflag[i][j], sizeof(int), 1, fp, nullptr, error);
      MPI_Bcast(&setflag[i][j], 1, MPI_INT, 0, world);
      if (!setflag[i][j]) continue;
      std::vector<double> numbers(eepa::packed_size(format));
      read_numbers(numbers.data(), numbers.size(), fp);
      try {
        const eepa::Parameters read = eepa::unpack_parameters(numbers, format);
        eepa::Words warnings;    // printed already when the coefficients were typed
        eepa::require_valid(read, style.settings, warnings);
        parameters[pair_index(i, j)] = parameters[pair_index(j, i)] = read;
        cite_papers(lmp, style.settings, read);
      } catch (const std::invalid_argument &e) {
        error->all(FLERR, "{}: the restart file is damaged: pair_coeff {} {}: {}", style_name, i, j,
                   e.what());
      }
    }
  }
}

void PairGranEepa::write_restart_settings(FILE *fp)
{
  write_numbers(eepa::pack(style), fp);
  // there is none with write_restart noinit; LAMMPS calls this function on rank 0 only
  if (!fix_history)
    error->warning(FLERR,
                   "{}: the restart file has no histories of contacts, because there was neither a "
                   "run nor an init before it",
                   style_name);
}

void PairGranEepa::read_restart_settings(FILE *fp)
{
  read_style(fp);
}

/// \return the format of the file
int PairGranEepa::read_style(FILE *fp)
{
  std::array<double, eepa::packed_style_size> numbers;
  read_numbers(numbers.data(), numbers.size(), fp);
  int format = 0;
  try {
    style = eepa::unpack_style(numbers, format);
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "{}: {}", style_name, e.what());
  }
  return format;
}

/// Reads numbers from the file of rank 0 and sends them to all ranks.
void PairGranEepa::read_numbers(double *numbers, std::size_t count, FILE *fp)
{
  if (comm->me == 0) utils::sfread(FLERR, numbers, sizeof(double), count, fp, nullptr, error);
  MPI_Bcast(numbers, static_cast<int>(count), MPI_DOUBLE, 0, world);
}

void PairGranEepa::warn_of_data_file() const
{
  // LAMMPS calls write_data on rank 0 only
  error->warning(FLERR,
                 "{}: write_data writes the coefficients but not the history of contacts: they "
                 "will start as new ones; use write_restart to go on with this run",
                 style_name);
}

void PairGranEepa::write_data(FILE *fp)
{
  warn_of_data_file();
  for (int i = 1; i <= atom->ntypes; i++)
    fmt::print(fp, "{} {}\n", i, eepa::to_words(parameters[pair_index(i, i)]));
}

void PairGranEepa::write_data_all(FILE *fp)
{
  warn_of_data_file();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      fmt::print(fp, "{} {} {}\n", i, j, eepa::to_words(parameters[pair_index(i, j)]));
}
