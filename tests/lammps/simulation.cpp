// SPDX-License-Identifier: GPL-2.0-only
#include "simulation.h"

#include "eepa_styles.h"

#include "atom.h"
#include "compute.h"
#include "domain.h"
#include "exceptions.h"
#include "fix.h"
#include "input.h"
#include "lammps.h"
#include "library.h"
#include "modify.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

using namespace LAMMPS_NS;

namespace eepa_test {

namespace {
  /// All ranks' numbers, one after another.
  std::vector<double> gather(const std::vector<double> &mine, MPI_Comm comm)
  {
    int ranks;
    MPI_Comm_size(comm, &ranks);
    const int count = static_cast<int>(mine.size());
    std::vector<int> counts(ranks), starts(ranks, 0);
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
    for (int r = 1; r < ranks; r++) starts[r] = starts[r - 1] + counts[r - 1];
    std::vector<double> all(starts.back() + counts.back());
    MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), starts.data(),
                   MPI_DOUBLE, comm);
    return all;
  }

  void push(std::vector<double> &to, const double *three)
  {
    to.insert(to.end(), three, three + 3);
  }
}    // namespace

double mass_of(const Sphere &sphere)
{
  return 4.0 / 3.0 * pi * sphere.radius * sphere.radius * sphere.radius * sphere.density;
}

Vec3 Particle::angular_momentum() const
{
  return mass * x.cross(v) + 0.4 * mass * radius * radius * omega;
}

double Particle::kinetic_energy() const
{
  return 0.5 * mass * v.squaredNorm() + 0.2 * mass * radius * radius * omega.squaredNorm();
}

std::vector<std::string> kokkos_of_environment()
{
  const char *where = std::getenv("EEPA_TEST_KOKKOS");
  return where ? kokkos_with(where) : std::vector<std::string>();
}

std::vector<std::string> kokkos_with(const std::string &where, KokkosComm comm)
{
  const char *loops = comm == KokkosComm::device ? "device"
      : comm == KokkosComm::host                 ? "host"
                                                 : "no";
  std::vector<std::string> words = {"-kokkos", "on"};
  std::istringstream stream(where);
  for (std::string word; stream >> word;) words.push_back(word);
  for (const char *word :
       {"-suffix", "kk", "-package", "kokkos", "neigh", "half", "comm", loops, "sort", loops})
    words.push_back(word);
  return words;
}

Simulation::Simulation(MPI_Comm comm, const std::string &log,
                       const std::vector<std::string> &more) :
    comm_(comm)
{
  LAMMPS::argv arguments = {"test_lammps", "-log", log, "-screen", "none", "-nocite"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  lammps_ = std::make_unique<LAMMPS>(arguments, comm);
#ifndef EEPA_STYLES_IN_LAMMPS
  register_eepa_styles(lammps_.get());
#endif
  // fix nve/sphere/kk makes one step of two half steps, except at the end of a run, so that a run cut in two would have
  // other bits; not where there is a limit of time
  if (!more.empty()) lammps_->input->one("timer timeout 99:00:00");
}

Simulation::~Simulation() = default;

void Simulation::operator()(const std::string &lines)
{
  std::istringstream stream(lines);
  std::string line, command;
  while (std::getline(stream, line)) {
    command += line;
    const auto last = command.find_last_not_of(" \t");
    if (last == std::string::npos) {
      command.clear();
    } else if (command[last] == '&') {
      command[last] = ' ';
    } else {
      lammps_->input->one(command);
      command.clear();
    }
  }
}

void Simulation::run(int steps)
{
  lammps_->input->one("run " + std::to_string(steps) + " post no");
}

void Simulation::open_box(double half, int types, const std::string &boundary,
                          const std::string &newton)
{
  const std::string side = exact(-half) + " " + exact(half) + " ";
  (*this)("units si\natom_style sphere\natom_modify map array\nnewton " + newton + "\nboundary " +
          boundary + "\nregion box block " + side + side + side + "\ncreate_box " +
          std::to_string(types) + " box\ncomm_modify vel yes\nneighbor 0.1 bin\n" +
          "neigh_modify every 1 delay 0 check yes\nthermo 1000000");
}

void Simulation::create(const std::vector<Sphere> &spheres)
{
  const auto before = particles();
  const int first = before.empty() ? 1 : before.back().id + 1;
  const int n = static_cast<int>(spheres.size());
  std::vector<tagint> ids(n);
  std::vector<int> types(n);
  std::vector<double> x, v;
  for (int k = 0; k < n; k++) {
    ids[k] = first + k;
    types[k] = spheres[k].type;
    push(x, spheres[k].x.data());
    push(v, spheres[k].v.data());
  }
  lammps_create_atoms(lammps_.get(), n, ids.data(), types.data(), x.data(), v.data(), nullptr, 0);
  const Atom *atom = lammps_->atom;
  if (atom->natoms != static_cast<bigint>(before.size()) + n)
    throw std::logic_error("a particle lies outside of the box");
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom->tag[i] < first) continue;
    const Sphere &sphere = spheres[atom->tag[i] - first];
    atom->radius[i] = sphere.radius;
    atom->rmass[i] = mass_of(sphere);
    std::copy_n(sphere.omega.data(), 3, atom->omega[i]);
  }
}

std::vector<Particle> Simulation::particles() const
{
  const Atom *atom = lammps_->atom;
  constexpr int size = 19;
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; i++) {
    double x[3];
    lammps_->domain->unmap(atom->x[i], atom->image[i], x);
    mine.push_back(static_cast<double>(atom->tag[i]));
    mine.push_back(atom->type[i]);
    push(mine, x);
    push(mine, atom->v[i]);
    push(mine, atom->f[i]);
    push(mine, atom->omega[i]);
    push(mine, atom->torque[i]);
    mine.push_back(atom->radius[i]);
    mine.push_back(atom->rmass[i]);
  }
  const auto all = gather(mine, comm_);
  std::vector<Particle> found;
  for (std::size_t at = 0; at < all.size(); at += size) {
    const double *n = &all[at];
    found.push_back({static_cast<int>(n[0]), static_cast<int>(n[1]), Vec3(n + 2), Vec3(n + 5),
                     Vec3(n + 8), Vec3(n + 11), Vec3(n + 14), n[17], n[18]});
  }
  std::sort(found.begin(), found.end(), [](const Particle &a, const Particle &b) {
    return a.id < b.id;
  });
  return found;
}

Particle Simulation::particle(int id) const
{
  for (const auto &one : particles())
    if (one.id == id) return one;
  throw std::logic_error("there is no particle " + std::to_string(id));
}

void Simulation::set_velocity(int id, const Vec3 &v, const Vec3 &omega)
{
  const Atom *atom = lammps_->atom;
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom->tag[i] != id) continue;
    std::copy_n(v.data(), 3, atom->v[i]);
    std::copy_n(omega.data(), 3, atom->omega[i]);
  }
}

void Simulation::watch_contacts()
{
  std::string quantities;
  for (int k = 1; k <= 17; k++) quantities += " p" + std::to_string(k);
  (*this)("compute test_ids all property/local patom1 patom2 cutoff radius\n"
          "compute test_values all pair/local dist eng force" +
          quantities + " cutoff radius");
}

std::vector<PairContact> Simulation::contacts() const
{
  auto *ids = lammps_->modify->get_compute_by_id("test_ids");
  auto *values = lammps_->modify->get_compute_by_id("test_values");
  ids->compute_local();
  values->compute_local();
  if (ids->size_local_rows != values->size_local_rows)
    throw std::logic_error("property/local and pair/local differ in their pairs");
  std::vector<double> mine;
  const int columns = values->size_local_cols;
  for (int row = 0; row < ids->size_local_rows; row++) {
    mine.insert(mine.end(), ids->array_local[row], ids->array_local[row] + 2);
    mine.insert(mine.end(), values->array_local[row], values->array_local[row] + columns);
  }
  const auto all = gather(mine, comm_);
  std::vector<PairContact> found;
  for (std::size_t at = 0; at < all.size(); at += columns + 2) {
    const double *n = &all[at];
    found.push_back({static_cast<int>(n[0]), static_cast<int>(n[1]), n[2], n[3], n[4],
                     std::vector<double>(n + 5, n + 2 + columns)});
  }
  std::sort(found.begin(), found.end(), [](const PairContact &a, const PairContact &b) {
    return std::minmax(a.i, a.j) < std::minmax(b.i, b.j);
  });
  return found;
}

double Simulation::compute(const std::string &id) const
{
  return lammps_->modify->get_compute_by_id(id)->compute_scalar();
}

std::vector<double> Simulation::compute_vector(const std::string &id) const
{
  auto *compute = lammps_->modify->get_compute_by_id(id);
  compute->compute_vector();
  return {compute->vector, compute->vector + compute->size_vector};
}

double Simulation::fix(const std::string &id, int element) const
{
  return lammps_->modify->get_fix_by_id(id)->compute_vector(element - 1);
}

std::vector<double> Simulation::fix_row(const std::string &id, int particle) const
{
  const auto *fix = lammps_->modify->get_fix_by_id(id);
  const Atom *atom = lammps_->atom;
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->tag[i] == particle)
      mine.assign(fix->array_atom[i], fix->array_atom[i] + fix->size_peratom_cols);
  return gather(mine, comm_);
}

double Simulation::thermo(const std::string &keyword) const
{
  return lammps_get_thermo(lammps_.get(), keyword.c_str());
}

std::string error_of(Simulation &simulation, const std::string &lines)
{
  try {
    simulation(lines);
  } catch (const LAMMPSException &e) {
    return e.what();
  }
  return "";
}

testing::AssertionResult refuses(Simulation &simulation, const std::string &lines,
                                 const std::string &regex)
{
  const std::string message = error_of(simulation, lines);
  if (message.empty()) return testing::AssertionFailure() << "no error from:\n" << lines;
  if (!std::regex_search(message, std::regex(regex)))
    return testing::AssertionFailure() << message << "does not match\n  " << regex;
  return testing::AssertionSuccess();
}

ScratchFile::ScratchFile(const std::string &suffix, MPI_Comm comm) : comm_(comm)
{
  int rank;
  MPI_Comm_rank(comm, &rank);
  char name[200] = "";
  if (rank == 0) {
    const char *folder = std::getenv("TMPDIR");
    std::snprintf(name, sizeof(name), "%s/eepa_test.XXXXXX", folder ? folder : "/tmp");
    const int handle = mkstemp(name);
    if (handle >= 0) close(handle);
  }
  MPI_Bcast(name, sizeof(name), MPI_CHAR, 0, comm);
  name_ = std::string(name) + suffix;
  if (rank == 0) std::rename(name, name_.c_str());
}

ScratchFile::~ScratchFile()
{
  int rank;
  MPI_Comm_rank(comm_, &rank);
  MPI_Barrier(comm_);
  if (rank == 0) std::remove(name_.c_str());
}

std::string ScratchFile::text() const
{
  std::ifstream file(name_);
  std::ostringstream all;
  all << file.rdbuf();
  return all.str();
}

std::string exact(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

double difference(const std::vector<Particle> &a, const std::vector<Particle> &b)
{
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  constexpr Vec3 Particle::*quantities[] = {&Particle::x, &Particle::v, &Particle::f,
                                            &Particle::omega, &Particle::torque};
  double worst = 0.0;
  for (const auto quantity : quantities) {
    double largest = 0.0, deviation = 0.0;
    for (std::size_t k = 0; k < a.size(); k++) {
      if (a[k].id != b[k].id) return std::numeric_limits<double>::infinity();
      const Vec3 distance = a[k].*quantity - b[k].*quantity;
      if (!distance.allFinite()) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, (a[k].*quantity).cwiseAbs().maxCoeff());
      deviation = std::max(deviation, distance.cwiseAbs().maxCoeff());
    }
    if (deviation > 0.0) worst = std::max(worst, deviation / largest);
  }
  return worst;
}

}    // namespace eepa_test
