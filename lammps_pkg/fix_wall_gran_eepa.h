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

#include <eepa/coefficients.h>
#include <eepa_commands/wall_commands.h>
#include <eepa_walls/candidates.h>
#include <eepa_walls/face_histories.h>
#include <eepa_walls/placement.h>
#include <eepa_walls/shape.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// fix wall/gran/eepa: walls whose contacts obey the same law as those of particles. A particle has
/// a history with each face of the wall that it touches.
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
  void end_of_step() override;
  void reset_dt() override;
  int modify_param(int, char **) override;
  double compute_scalar() override;
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
  /// Number of contacts at the last force call. Collective.
  double contacts() { return compute_vector(CONTACTS); }
  /// This rank's energies; all zero unless a compute gran/eepa/energy existed at the last init.
  const EnergyLedger &energy_ledger() const { return ledger; }

 protected:
  /// the global vector
  enum {
    FORCE_X,    ///< force of the particles on the wall, all faces together
    FORCE_Y,
    FORCE_Z,
    POSITION,    ///< of the first plane along its normal; displacement of a loaded region or mesh
    VELOCITY,
    CONTACTS,
    FIRST_FORCE_X,    ///< force on the first plane (lo, or the only one), or on any other shape
    FIRST_FORCE_Y,
    FIRST_FORCE_Z,
    SECOND_FORCE_X,    ///< force on the second plane (hi next to lo), else 0
    SECOND_FORCE_Y,
    SECOND_FORCE_Z,
    LOAD_FORCE,    ///< force of `load`, along its axis
    LOAD_KINETIC_ENERGY,
    LOAD_WORK,          ///< work of LOAD_FORCE so far, kinetic energy gained by changes of drive
    LOAD_DISSIPATED,    ///< loss by the platen's damping, limits and changes of drive so far
    TORQUE_X,           ///< moment of the particles on the wall about the point of `about`
    TORQUE_Y,
    TORQUE_Z,
    ANGLE,               ///< turned by `rotate` so far
    ANGULAR_VELOCITY,    ///< about the axis of `rotate`
    DISPLACEMENT_X,      ///< since the wall was made, without rotation
    DISPLACEMENT_Y,
    DISPLACEMENT_Z,
    N_VECTOR
  };
  /// the per-atom table that keyword `contacts` asks for
  enum {
    ATOM_CONTACTS,    ///< number of faces in contact
    ATOM_FORCE_X,     ///< force on the particle, all faces together
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
  /// of the last force call, this rank's part
  struct Sums {
    double force[2][3];    ///< on the first and the second plane
    double moment[3];
    double contacts;
  };

  eepa::StyleArguments style;
  eepa::Parameters parameters;
  eepa::Coefficients coefficients;
  ContactMasses masses;

  eepa::WallShape typed_shape;
  std::unique_ptr<eepa::Shape> shape;
  class RegionShape *region_shape = nullptr;    // the shape, where it is a region
  eepa::Placement placement;

  double initial_position = 0.0;        // of the first plane without displacement
  eepa::MotionArguments motion_args;    // as typed last
  WallMotion motion;
  double sliding = 0.0;           // velocity of a surface by `shear`, as evaluated last
  double surface_speed = 0.0;     // of a cylinder's surface about its axis
  double angular_speed = 0.0;     // of `rotate`, as evaluated last
  double angle_before = 0.0;      // turned by rotations before the present one
  double rotation_reach = 0.0;    // largest distance of the surface from the axis of rotation
  Platen platen;
  double load_now = 0.0;          // external force at the last force call
  double load_stiffness = 0.0;    // largest stiffness of a contact with the platen, on all ranks
  bool platen_warned = false, rotation_warned = false, time_step_warned = false;
  bool device_warned = false;
  bigint checked_particles = 0;    // number of particles when the time step was checked

  double dt = 0.0;
  int history_size;    // number of values of one contact's history
  eepa::FaceHistories histories;
  int most_contacts = 0;    // of a particle on any rank, when a restart file was written last
  bool contact_table = false;
  Sums sums;
  std::array<double, 3> about;    // point of the torque
  double elastic_energy = 0.0;    // of this rank's contacts at the last force call
  std::array<double, N_VECTOR> output_vector;
  bool output_is_summed = true;                   // whether output_vector has the sums of all ranks
  std::unique_ptr<class FaceLoads> face_loads;    // of `faces`

  eepa::Candidates candidates;    // all that can touch a face before the next collection
  struct Visit {
    int candidate, pieces;    // how many of its pieces, the nearest ones
  };
  std::vector<Visit>
      visits;    // of the candidates, those that may be in contact in this force call
  double collected_margin = 0.0;    // by which a particle may move before the next collection
  std::vector<eepa::Vec3>
      places;    // of all atoms then, where neighbour lists do not bound their motion
  eepa::Placement collected_at;        // the placement at the last collection
  bool rotation_is_new = false;        // since the last collection
  bool particles_are_moved = false;    // to other places in memory since the last collection
  double travel_left = 0.0;            // travel of the surface that requires the next collection
  bool radii_may_change = false;       // during a run

  // of the particle in turn
  std::vector<eepa::SurfacePoint> found;    // its contacts
  std::vector<int> history_of_found;        // their places in its list of histories, or -1
  std::vector<char> is_matched;             // whether a history has a contact in `found`

  struct Touch {
    int particle;
    eepa::SurfacePoint point;
    eepa::FaceHistory *history;
  };
  bool may_wait = false;    // whether contacts of this force call wait until they fill the lanes
  std::vector<Touch> waiting;
  std::vector<WallContact> waiting_contacts;    // the same ones
  std::vector<ContactOutcome> waiting_outcomes;

  EnergyLedger ledger;
  bool keep_ledger = false;
  bool ledger_starts = false;    // with the next step: no ledger has booked the one before
  bool after_setup = false;      // whether the last force call was a set-up's
  std::vector<class ComputeGranEepaEnergyAtom *> atom_losses;    // that sum losses by atom
  double power = 0.0;           // of the wall on this rank's particles, at the last force call
  bool needs_setup = false;     // a new platen, on which no force call has computed the reaction
  double platen_force = 0.0;    // on the particles along its axis, at the last force call
  double other_power = 0.0;     // of its sliding or turning on the particles, at that call

  std::unique_ptr<const ContactEngine> engine;    // of the law
  StepRequest request;                            // of the present force call

  void make_shape();
  class Region *find_region() const;
  void require_walls_in_the_box() const;
  std::string style_name() const;
  void warn_of_rotation();
  virtual void warn_of_device();
  void check_time_step();
  void complain(const std::string &message);
  // what a variant asks LAMMPS for before this class reads particles
  virtual void bring_sizes_to_host() {}
  virtual void bring_all_to_host() {}
  /// The largest stable time step of particles on the wall. Collective.
  double contact_time_step();
  /// The largest stable time step of the platen on its present contacts.
  double platen_time_step() const;
  void check_platen();

  // motion, fix_wall_gran_eepa_motion.cpp
  bool loaded() const { return motion_args.drive == eepa::WallDrive::load; }
  int load_axis() const { return motion_args.load.axis; }
  /// Coordinate that a platen along this axis moves.
  double initial_along(int axis) const;
  double position() const;
  double normal_velocity() const;
  /// Changes to another motion and keeps position, contacts and the velocity of a platen.
  /// \param rotation_goes_on  about the axis where it is now, which need not be the point given
  void change_motion(const eepa::MotionArguments &next, bool rotation_goes_on = false);
  void begin_rotation();
  void measure_rotation();
  void require_variables(const eepa::MotionArguments &motion) const;
  void require_limits(const eepa::LoadArguments &load, double place) const;
  void require_equal_style(const char *what, const std::string &variable) const;
  void evaluate_motion();
  double evaluate(const char *what, const eepa::Quantity &quantity);
  double evaluate_load();
  void place_wall();

  // which particles are looked at, fix_wall_gran_eepa_candidates.cpp
  bool candidates_stay() const;
  bool lists_bound_motion() const;
  bool candidates_are_old() const;
  bool particles_are_elsewhere() const;
  bool atoms_may_be_far() const;
  double margin_of_candidates();
  bool surface_stays() const;
  double travelled() const;
  void collect_candidates();
  bool must_be_met(std::size_t candidate, int &pieces);
  void meet_candidates();
  void prefetch_place(int i) const;
  void prefetch(const Visit &visit) const;

  // force call, fix_wall_gran_eepa_force.cpp
  virtual void add_contacts();
  void sum_forces();
  void book(int i, const eepa::Dissipation &);
  bool books_setup() const;
  void meet(const Visit &visit);
  void match(int i, const eepa::Vec3 &centre);
  eepa::WallPoint<double> touched_wall(int i, const eepa::Body<double> &, const eepa::Vec3 &centre,
                                       const eepa::SurfacePoint &) const;
  void wait_for_others(const eepa::Body<double> &, const eepa::WallPoint<double> &, const Touch &);
  void evaluate_waiting();
  void evaluate(const eepa::Body<double> &, const eepa::WallPoint<double> &, const Touch &);
  void finish(const Touch &, const eepa::Body<double> &, const eepa::WallPoint<double> &,
              const ContactOutcome &);
  void part(int i, const eepa::Body<double> &, const eepa::Vec3 &centre, const eepa::FaceHistory &,
            bool member);
  bool got_through(const eepa::Body<double> &, const eepa::FaceHistory &) const;
  void part_after_setup(int candidate, const eepa::Body<double> &, const eepa::Vec3 &centre);
  eepa::WallPoint<double> wall_point(const eepa::SurfacePoint &, const eepa::Body<double> &,
                                     const eepa::Vec3 &centre) const;
  void tabulate(int i, const eepa::Body<double> &, const eepa::WallPoint<double> &,
                const ContactOutcome &);
  /// Of the fix's group; group 0 is all.
  bool is_member(int i) const { return igroup == 0 || (atom->mask[i] & groupbit); }
  eepa::Body<double> body_of(int candidate) const;
  void require_slow(int i) const;
  void stop_at_overlap(int i, int face, double overlap) const;
  void stop_behind_wall(int i) const;

  void allow_for(std::size_t contacts);
  // contacts as numbers: face, normal, distance, history
  int packed_size() const { return 5 + history_size; }
  int pack(const eepa::FaceHistory &contact, double *buf) const;
  eepa::FaceHistory unpack(const double *buf) const;

  // restart files, fix_wall_gran_eepa_restart.cpp
  std::vector<double> restart_state() const;
  void require_same_wall(const std::vector<double> &state) const;
  void take_up_motion(const std::vector<double> &state);
};

}    // namespace LAMMPS_NS

#endif
#endif
