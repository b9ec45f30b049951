// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TESTS_SIMULATION_H
#define EEPA_TESTS_SIMULATION_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <memory>
#include <mpi.h>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eepa_test {

using Vec3 = Eigen::Vector3d;

constexpr double pi = 3.14159265358979323846;

/// Density at which a sphere of diameter 1 has mass 1.
constexpr double unit_density = 6.0 / pi;

/// A particle that a test creates.
struct Sphere {
  Vec3 x = Vec3::Zero();
  Vec3 v = Vec3::Zero();
  Vec3 omega = Vec3::Zero();
  double radius = 0.5;
  double density = unit_density;
  int type = 1;
};

double mass_of(const Sphere &sphere);

/// A particle's state in LAMMPS; x is unwrapped.
struct Particle {
  int id, type;
  Vec3 x, v, f, omega, torque;
  double radius, mass;
  Vec3 angular_momentum() const;    ///< orbital and spin, about the origin
  double kinetic_energy() const;    ///< of translation and rotation
};

/// A contact from compute property/local and pair/local; forces act on the particle of lower ID.
struct PairContact {
  int i, j;    ///< IDs, in the order of LAMMPS's neighbour list
  double distance, energy;
  double normal_force;      ///< along the line of centres, positive repels
  std::vector<double> p;    ///< p1, p2, ... of compute pair/local: p[0] is p1
  double branch() const { return p[4]; }
  double overlap() const { return p[5]; }
  double max_overlap() const { return p[6]; }
  double plastic_overlap() const { return p[7]; }
  double slip() const { return p[8]; }
  Vec3 tangential() const { return {p[0], p[1], p[2]}; }    ///< on i
};

/// How LAMMPS's KOKKOS communicates and sorts: with kernels for the device, with the same kernels for the host, or with
/// the functions of a LAMMPS without KOKKOS.
enum class KokkosComm { device, host, classic };

/// LAMMPS's command line for KOKKOS.
/// \param where what follows `-kokkos on`: "t 2" for two threads, "g 1" for a GPU. A process has that of its first LAMMPS.
std::vector<std::string> kokkos_with(const std::string &where, KokkosComm = KokkosComm::device);
/// The same with what the environment's EEPA_TEST_KOKKOS says; nothing without it.
std::vector<std::string> kokkos_of_environment();

/// A LAMMPS with this package's styles. Everything is collective over `comm`, and every answer
/// is the same on all ranks.
class Simulation {
 public:
  /// \param comm  MPI_COMM_SELF for a run of one rank beside the others
  /// \param log  file for the log, or "none"
  /// \param more  of LAMMPS's command line
  explicit Simulation(MPI_Comm comm = MPI_COMM_WORLD, const std::string &log = "none",
                      const std::vector<std::string> &more = kokkos_of_environment());
  ~Simulation();

  /// Runs command lines; `&` at a line's end continues it.
  /// \throw LAMMPS_NS::LAMMPSException
  void operator()(const std::string &lines);

  /// Runs `steps` steps without a summary.
  void run(int steps);

  /// A box [-half, half]^3 with non-periodic faces, `types` atom types, newton on.
  void open_box(double half, int types = 1, const std::string &boundary = "f f f",
                const std::string &newton = "on");

  /// Adds particles; IDs go on from those that exist.
  void create(const std::vector<Sphere> &spheres);

  /// All particles by ascending ID.
  std::vector<Particle> particles() const;
  Particle particle(int id) const;

  /// Sets the velocities of one particle.
  void set_velocity(int id, const Vec3 &v, const Vec3 &omega = Vec3::Zero());

  /// Makes contacts() ready. Call it before a run.
  void watch_contacts();
  /// Contacts between particles, by ascending pair of IDs.
  std::vector<PairContact> contacts() const;

  double compute(const std::string &id) const;
  std::vector<double> compute_vector(const std::string &id) const;
  double fix(const std::string &id, int element) const;    ///< f_ID[element], from 1
  Vec3 wall_force(const std::string &id) const { return {fix(id, 1), fix(id, 2), fix(id, 3)}; }
  /// Row of a fix's per-atom array.
  std::vector<double> fix_row(const std::string &id, int particle) const;
  double thermo(const std::string &keyword) const;

  LAMMPS_NS::LAMMPS *lammps() const { return lammps_.get(); }
  MPI_Comm comm() const { return comm_; }

 private:
  MPI_Comm comm_;
  std::unique_ptr<LAMMPS_NS::LAMMPS> lammps_;
};

/// The message of the LAMMPS error that `lines` cause, "" when there is none.
std::string error_of(Simulation &simulation, const std::string &lines);

/// Whether `lines` cause a LAMMPS error in whose message the regular expression is found.
testing::AssertionResult refuses(Simulation &simulation, const std::string &lines,
                                 const std::string &regex);

/// A file name of this test's own, the same on all ranks of `comm`; removed at the end.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string &suffix, MPI_Comm comm = MPI_COMM_WORLD);
  ~ScratchFile();
  ScratchFile(const ScratchFile &) = delete;
  ScratchFile &operator=(const ScratchFile &) = delete;
  const std::string &name() const { return name_; }
  std::string text() const;

 private:
  std::string name_;
  MPI_Comm comm_;
};

/// Digits enough to read the same double back.
std::string exact(double value);

/// Largest difference between two states, each quantity relative to its largest component.
double difference(const std::vector<Particle> &a, const std::vector<Particle> &b);

}    // namespace eepa_test

#endif
