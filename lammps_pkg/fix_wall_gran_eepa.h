/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifdef FIX_CLASS
// clang-format off
FixStyle(wall/gran/eepa,FixWallGranEepa);
// clang-format on
#else

#ifndef LMP_FIX_WALL_GRAN_EEPA_H
#define LMP_FIX_WALL_GRAN_EEPA_H

#include "fix.h"

#include "contact_masses.h"
#include "eepa_commands.h"
#include "energy_ledger.h"
#include "particle_sizes.h"
#include "platen.h"
#include "wall_surface.h"

#include <eepa/coefficients.h>

#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// fix wall/gran/eepa: walls whose contacts obey the same law as those of particles. Each
/// surface (both planes, the cylinder) keeps its own history with every particle.
class FixWallGranEepa : public Fix {
 public:
  FixWallGranEepa(class LAMMPS *, int, char **);
  ~FixWallGranEepa() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void post_force(int) override;
  void final_integrate() override;
  void reset_dt() override;
  double compute_vector(int) override;
  double memory_usage() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int maxsize_restart() override;
  int size_restart(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  /// The largest stable time step of the contacts with this wall, those of particles that are still
  /// to come with them. Collective.
  TimeStepBound largest_time_step(const std::vector<AnnouncedParticles> &announced = {});
  /// This rank's energies; all zero unless a compute gran/eepa/energy existed at the last init.
  const EnergyLedger &energy_ledger() const { return ledger; }

 private:
  /// the global vector
  enum {
    FORCE_X,    ///< of the particles on the wall, all surfaces together
    FORCE_Y,
    FORCE_Z,
    POSITION,    ///< of the first surface along its normal
    VELOCITY,
    CONTACTS,
    FIRST_FORCE_X,    ///< on the first surface (lo, or the only one)
    FIRST_FORCE_Y,
    FIRST_FORCE_Z,
    SECOND_FORCE_X,    ///< on the second surface (hi next to lo), else 0
    SECOND_FORCE_Y,
    SECOND_FORCE_Z,
    LOAD_FORCE,    ///< of `load`, along the plane's axis
    LOAD_KINETIC_ENERGY,
    LOAD_WORK,          ///< done by LOAD_FORCE so far
    LOAD_DISSIPATED,    ///< by the platen's damping and at its limits so far
    N_VECTOR
  };
  /// the per-atom table that keyword `contacts` asks for
  enum {
    ATOM_CONTACTS,    ///< surfaces in contact
    ATOM_FORCE_X,     ///< on the particle, all surfaces together
    ATOM_FORCE_Y,
    ATOM_FORCE_Z,
    ATOM_POINT_X,    ///< contact point, of the deepest contact as all below
    ATOM_POINT_Y,
    ATOM_POINT_Z,
    ATOM_OVERLAP,
    ATOM_MAX_OVERLAP,
    ATOM_BRANCH,
    ATOM_SLIP,
    N_ATOM
  };
  enum class Motion { still, velocity, wiggle, shear, load };
  /// what a surface felt in the last force call, this rank's part
  struct SurfaceSum {
    double force[3];
    double contacts;
  };

  eepa::StyleArguments style;
  eepa::Parameters parameters;
  eepa::Coefficients coefficients;
  ContactMasses masses;
  WallSurfaces surfaces;

  Motion motion = Motion::still;
  std::array<std::string, 3> velocity_variable;    // empty where a number was given
  std::array<double, 3> velocity = {0.0, 0.0, 0.0};
  std::array<double, 3> displacement = {0.0, 0.0, 0.0};
  int motion_axis = 0;
  double amplitude = 0.0, period = 0.0, shear_velocity = 0.0;
  bigint time_origin = 0;
  eepa::LoadArguments load;
  Platen platen;
  double load_now = 0.0;          // force from outside at the last force call
  double load_stiffness = 0.0;    // the largest of a contact with the platen, all ranks
  bool platen_warned = false, rotation_warned = false, time_step_warned = false;
  bigint checked_particles = 0;    // how many there were when the time step was checked

  double dt = 0.0;
  int history_size;              // values of one contact
  int n_values;                  // values of all surfaces
  double **history = nullptr;    // nmax x n_values, delta_max = 0 where there is no contact
  bool contact_table = false;
  std::array<SurfaceSum, 2> felt;
  std::array<double, N_VECTOR> felt_vector;
  bigint felt_reduced = -1;

  // the atoms that contact_loop() visits: all that can touch a surface before they are collected
  // again
  std::vector<int> candidates;
  WallSurfaces collected_at;        // the surfaces then
  double way_left = 0.0;            // how far they may go until then
  bool radii_may_change = false;    // in mid-run

  EnergyLedger ledger;
  bool keep_ledger = false;
  bool ledger_starts = false;    // with the next step: no ledger has booked the one before
  bool after_setup = false;      // whether the last force call was a set-up's
  std::vector<class ComputeGranEepaEnergyAtom *> atom_losses;    // who wants them by particle
  double power = 0.0;    // of the surfaces on this rank's particles, at the last force call
  double push = 0.0;     // of the platen on them along its axis, likewise

  typedef void (FixWallGranEepa::*Loop)();
  Loop loop = nullptr;

  int parse_wall(int narg, char **arg, int iarg);
  int parse_motion(int narg, char **arg, int iarg);
  int parse_load(int narg, char **arg, int iarg);
  double number(const char *name, const char *word);
  int dimension(const char *name, const char *word);
  void require(int narg, int iarg, int count, const char *what);
  void require_equal_style(const char *what, const std::string &variable);
  void evaluate_velocity();
  double evaluate(const char *what, const eepa::Quantity &quantity);
  double evaluate_load();
  void move_surfaces();
  bool motion_is_bounded() const;
  void collect_candidates();
  void sum_forces();
  /// The largest stable time step of particles on the wall. Collective.
  double contact_time_step();
  /// The largest stable time step of the platen on the contacts that it has now.
  double platen_time_step() const;
  void check_platen();
  void book(int i, const eepa::Dissipation &);
  std::string style_name() const;
  void warn_of_rotation();
  void check_time_step();
  void complain(const std::string &message);
  void stop_at_overlap(int i, double overlap) const;
  template <class ContactLaw> void contact_loop();
};

}    // namespace LAMMPS_NS

#endif
#endif
