/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifdef PAIR_CLASS
// clang-format off
PairStyle(gran/eepa,PairGranEepa);
// clang-format on
#else

#ifndef LMP_PAIR_GRAN_EEPA_H
#define LMP_PAIR_GRAN_EEPA_H

#include "pair.h"

#include "atom_losses.h"
#include "coefficient_classes.h"
#include "contact_engine.h"
#include "contact_masses.h"
#include "contact_slice.h"
#include "energy_ledger.h"
#include "particle_sizes.h"

#include <eepa/coefficients.h>
#include <eepa_commands/commands.h>

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Results of compute gran/eepa/contacts, summed over ranks.
struct ContactCensus {
  double contacts = 0.0, loading = 0.0, unloading = 0.0, adhesive = 0.0, sliding = 0.0;
  double ends = 0.0;    ///< sum over the particles of the group of their numbers of contacts
  double max_overlap_ratio = 0.0;
  double mean_overlap_ratio = 0.0;
};

/// pair_style gran/eepa: finds contacts, gathers their bodies, calls the kernel's law, stores
/// states in the neighbour-history fix and scatters the forces. It contains no physics.
class PairGranEepa : public Pair {
 public:
  PairGranEepa(class LAMMPS *);
  ~PairGranEepa() override;
  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void setup() override;
  void reset_dt() override;
  double single(int, int, int, int, double, double, double, double &) override;

  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  void write_data(FILE *) override;
  void write_data_all(FILE *) override;

  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  double memory_usage() override;
  // virtual up to LAMMPS 2025 and removed after it, so without `override`
#if defined(__clang__)
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Winconsistent-missing-override"
#endif
  virtual double atom2cut(int);
  virtual double radii2cut(double, double);
#if defined(__clang__)
#pragma clang diagnostic pop
#endif

  /// Counts the contacts with a partner in the group. Collective.
  ContactCensus census(int groupbit);
  /// The largest stable time step over all contacts that could form, those of announced particles
  /// included. Collective.
  TimeStepBound largest_time_step(const std::vector<AnnouncedParticles> &announced = {});
  /// This rank's energies; all zero unless a compute gran/eepa/energy existed at the last init.
  const EnergyLedger &energy_ledger() const
  {
    return ledger;
  }

  bool has_warned_of_rotation() const
  {
    return rotation_warned;
  }

 protected:
  /// Quantities of single() beside the force, in the order of p1, p2, ... The tangential force
  /// comes first as in all of LAMMPS's granular styles; compute fabric reads p4.
  enum SingleQuantity {
    TANGENTIAL_X,    ///< tangential force on i
    TANGENTIAL_Y,
    TANGENTIAL_Z,
    TANGENTIAL,         ///< its magnitude
    BRANCH,             ///< 1 loading, 2 unloading, 3 adhesive
    OVERLAP,            ///< delta
    MAX_OVERLAP,        ///< delta_max
    PLASTIC_OVERLAP,    ///< delta_p
    SLIP,               ///< 1 at the friction bound
    HYSTERETIC,         ///< f_hys
    FRICTION_BOUND,     ///< largest value of TANGENTIAL
    ENERGY_NORMAL,      ///< recoverable energies
    ENERGY_TANGENTIAL,
    ENERGY_ROLLING,
    ROLLING_TORQUE_X,    ///< rolling torque on i
    ROLLING_TORQUE_Y,
    ROLLING_TORQUE_Z,
    TWISTING_TORQUE,    ///< along the unit vector that points at i
    ENERGY_TWISTING,
    N_SINGLE
  };

  eepa::StyleArguments style;
  std::vector<eepa::Parameters> parameters;                    // as given or mixed, (ntypes+1)^2
  std::vector<eepa::Coefficients> coefficients;                // resolved, (ntypes+1)^2
  CoefficientClasses classes;                                  // different ones among them
  eepa::RollingModel rolling = eepa::RollingModel::none;       // the model of all pairs of types
  eepa::TwistingModel twisting = eepa::TwistingModel::none;    // likewise
  ContactMasses masses;
  double dt = 0.0;

  class ContactHistory *fix_history = nullptr;
  std::string history_id;    // ID of fix_history, also before it replaces its place holder
  std::vector<double> max_radius_dynamic, max_radius_frozen;    // by type
  bool plateau_warned = false, narrow_box_warned = false;
  bool time_step_warned = false;    // in this run
  bool particles_come = false;      // whether a fix inserts particles
  bigint checked_particles = 0;     // number of particles when the time step was checked
  bool rotation_warned = false, heat_warned = false, rerun_warned = false;
  bool instructions_told = false;

  EnergyLedger ledger;
  bool keep_ledger = false;
  bool ledger_starts = false;    // with the next step: no ledger has booked the one before
  AtomLosses atom_losses;        // of this force call
  bool keep_atom_losses = false;

  std::unique_ptr<const ContactEngine> engine;    // of the law, made once a run

  // of the present force call
  ParticleArrays particles;
  ForceArrays forces;
  StepRequest request;
  bool in_lanes = false;    // only forces are requested
  std::vector<ContactSlice> slices;

  int pair_index(int itype, int jtype) const
  {
    return itype * (ntypes_allocated + 1) + jtype;
  }
  int ntypes_allocated = 0;
  void allocate();
  void init_history();
  void init_radii();
  double largest_partner(int type) const;
  double allowed_radius(int type) const;
  void check_time_step();
  void check_newcomers();
  virtual void check_radii();
  void warn_of_narrow_box();
  void make_engine();
  void warn_of_fixes();
  int history_size() const;
  void warn(const eepa::Words &);
  int read_style(FILE *fp);
  void read_numbers(double *numbers, std::size_t count, FILE *fp);
  void warn_of_data_file() const;
  int find_history(int i, int j, const double *&values, double &sign) const;
  void require_their_distance(int i, int j, double rsq) const;
  eepa::Body<double> lone_body(int i) const;
  void set_quantities(const eepa::Contact &, const ContactReport &);

  /// Data that a variant of this style may keep elsewhere than in LAMMPS's arrays on the host.
  enum class HostData {
    SIZES,       ///< radii, masses, types and groups of particles
    MOTION,      ///< and positions, velocities and IDs
    CONTACTS     ///< and statuses and histories of contacts
  };
  /// Makes the data on the host those of the last force call, before the host reads them.
  virtual void bring_to_host(HostData) {}
  virtual class ContactHistory *make_history(int values);

  ParticleArrays particle_arrays();
  bool bonds_weaken_contacts() const;
  void begin_force_call();
  void end_force_call();
  /// Evaluates the contacts of all slices of the neighbour list.
  virtual void work_through_list();
  void work_through(ContactSlice &);
  void open_contact(ContactSlice &, int i, int slot);
  void evaluate_block(ContactSlice &, int count);
  void evaluate_scalar(ContactSlice &, const FoundContact &);
  void book_opening(ContactSlice &, int i, int neighbor, const double *history) const;
  double share_of_pair(int j) const;
  void hand_over_atom_losses();
  [[noreturn]] void stop_at_overlap(int i, int j) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
