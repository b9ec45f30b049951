/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifdef FIX_CLASS
// clang-format off
FixStyle(wall/gran/eepa,FixWallGranEepa);
// clang-format on
#else

#ifndef LMP_FIX_WALL_GRAN_EEPA_H
#define LMP_FIX_WALL_GRAN_EEPA_H

#include "fix.h"

#include "contact_engine.h"
#include "contact_masses.h"
#include "energy_ledger.h"
#include "particle_sizes.h"
#include "platen.h"
#include "wall_motion.h"
#include "wall_surface.h"

#include <eepa/coefficients.h>
#include <eepa_commands/wall_commands.h>

#include <array>
#include <memory>
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
  int modify_param(int, char **) override;
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

  /// The largest stable time step of the contacts with this wall, those of announced particles
  /// included. Collective.
  TimeStepBound largest_time_step(const std::vector<AnnouncedParticles> &announced = {});
  /// This rank's energies; all zero unless a compute gran/eepa/energy existed at the last init.
  const EnergyLedger &energy_ledger() const { return ledger; }

 private:
  /// the global vector
  enum {
    FORCE_X,    ///< force of the particles on the wall, all surfaces together
    FORCE_Y,
    FORCE_Z,
    POSITION,    ///< position of the first surface along its normal
    VELOCITY,
    CONTACTS,
    FIRST_FORCE_X,    ///< force on the first surface (lo, or the only one)
    FIRST_FORCE_Y,
    FIRST_FORCE_Z,
    SECOND_FORCE_X,    ///< force on the second surface (hi next to lo), else 0
    SECOND_FORCE_Y,
    SECOND_FORCE_Z,
    LOAD_FORCE,    ///< force of `load`, along the plane's axis
    LOAD_KINETIC_ENERGY,
    LOAD_WORK,          ///< work of LOAD_FORCE so far, kinetic energy gained by changes of drive
    LOAD_DISSIPATED,    ///< loss by the platen's damping, limits and changes of drive so far
    N_VECTOR
  };
  /// the per-atom table that keyword `contacts` asks for
  enum {
    ATOM_CONTACTS,    ///< number of surfaces in contact
    ATOM_FORCE_X,     ///< force on the particle, all surfaces together
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
  /// force and contacts of a surface in the last force call, this rank's part
  struct SurfaceSum {
    double force[3];
    double contacts;
  };

  eepa::StyleArguments style;
  eepa::Parameters parameters;
  eepa::Coefficients coefficients;
  ContactMasses masses;
  WallSurfaces surfaces;

  std::array<double, 2> initial_position = {0.0, 0.0};    // planes lo and hi without displacement
  eepa::MotionArguments motion_args;                      // as typed last
  WallMotion motion;
  double sliding = 0.0;    // velocity of a surface by `shear`, as evaluated last
  Platen platen;
  double load_now = 0.0;          // external force at the last force call
  double load_stiffness = 0.0;    // largest stiffness of a contact with the platen, on all ranks
  bool platen_warned = false, rotation_warned = false, time_step_warned = false;
  bigint checked_particles = 0;    // number of particles when the time step was checked

  double dt = 0.0;
  int history_size;              // number of values of one contact
  int n_values;                  // number of values of all surfaces
  double **history = nullptr;    // nmax x n_values, delta_max = 0 where there is no contact
  bool contact_table = false;
  std::array<SurfaceSum, 2> surface_sums;
  std::array<double, N_VECTOR> output_vector;
  bool output_is_summed = true;    // whether output_vector has surface_sums of all ranks

  // the atoms that a force call visits: all that can touch a surface before the next collection
  std::vector<int> candidates;
  WallSurfaces collected_at;        // the surfaces at the last collection
  double travel_left = 0.0;         // travel of the surfaces that requires the next collection
  bool radii_may_change = false;    // during a run

  EnergyLedger ledger;
  bool keep_ledger = false;
  bool ledger_starts = false;    // with the next step: no ledger has booked the one before
  bool after_setup = false;      // whether the last force call was a set-up's
  std::vector<class ComputeGranEepaEnergyAtom *> atom_losses;    // that sum losses by atom
  double power = 0.0;           // of the surfaces on this rank's particles, at the last force call
  bool needs_setup = false;     // a new platen, on which no force call has computed the reaction
  double platen_force = 0.0;    // on the particles along its axis, at the last force call
  double platen_shear_power = 0.0;    // of its sliding surface on the particles, at that call

  std::unique_ptr<const ContactEngine> engine;    // of the law
  StepRequest request;                            // of the present force call

  void require_walls_in_the_box() const;
  bool loaded() const { return motion_args.drive == eepa::WallDrive::load; }
  /// Changes to another motion and keeps position, contacts and the velocity of a platen.
  void change_motion(const eepa::MotionArguments &next);
  void require_variables(const eepa::MotionArguments &motion) const;
  void require_limits(const eepa::LoadArguments &load, double place) const;
  void require_equal_style(const char *what, const std::string &variable) const;
  void evaluate_motion();
  double evaluate(const char *what, const eepa::Quantity &quantity);
  double evaluate_load();
  void place_surfaces();
  bool motion_is_bounded() const;
  void collect_candidates();
  void sum_forces();
  /// The largest stable time step of particles on the wall. Collective.
  double contact_time_step();
  /// The largest stable time step of the platen on its present contacts.
  double platen_time_step() const;
  void check_platen();
  void book(int i, const eepa::Dissipation &);
  std::string style_name() const;
  void warn_of_rotation();
  void check_time_step();
  void complain(const std::string &message);
  void stop_at_overlap(int i, int surface, double overlap) const;
  /// Contacts of a particle with all surfaces, and with one.
  void meet(int i);
  void meet(int i, int surface, bool member);
  double *history_of(int i, int surface) const;
  void tabulate(int i, const eepa::Body<double> &, const eepa::WallPoint<double> &,
                const ContactOutcome &);

  // restart files, fix_wall_gran_eepa_restart.cpp
  std::vector<double> restart_state() const;
  void require_same_wall(const std::vector<double> &state) const;
  void take_up_motion(const std::vector<double> &state);
};

}    // namespace LAMMPS_NS

#endif
#endif
