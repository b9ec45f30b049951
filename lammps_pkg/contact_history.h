/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifndef LMP_CONTACT_HISTORY_H
#define LMP_CONTACT_HISTORY_H

#include "fix_neigh_history.h"

#include <eepa/parameters.h>

#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// LAMMPS's neighbour-history fix, which this package's pair styles keep their contacts with.
///
/// During a run histories stand beside the neighbour list, between runs with the particles, as
/// lists of partners by ID. What this one adds to LAMMPS's is that it knows
/// - which of the two is newer. LAMMPS's fix makes the lists of partners from the neighbour list
///   whenever a restart file is written, but the command `write_restart` has given particles and
///   ghosts other places by then: contacts across a periodic or a processor boundary would get the
///   IDs of strangers;
/// - which particle a place of the neighbour list is, also after a fix that comes before this one
///   has deleted or inserted particles;
/// - which particle a list of partners belongs to: each has the ID that its particle had when the
///   list was made;
/// - what a restart file has: each list of partners says whose it is and how many values a contact
///   has, and is checked before it is read.
class ContactHistory : public FixNeighHistory {
 public:
  /// Makes one in the place of its place holder in LAMMPS's list of fixes, with the histories that
  /// a restart file has for its ID. Where they do not fit, that is an error and the place holder
  /// stays, so that a program can try again with other coefficients. Collective.
  /// \param values  of a contact
  /// \param contacts_of  the pair style whose neighbour list it stands beside
  static ContactHistory *make(LAMMPS *, const std::string &id, int values, class Pair *contacts_of);
  /// The ID of the fix that keeps the place among the fixes until make().
  static std::string place_holder(const std::string &id) { return id + "_DUMMY"; }

  ~ContactHistory() override;

  /// To be called before histories beside the neighbour list change, which are then the newer
  /// ones. An error where the list is older than a command that gave particles other places.
  void force_is_computed();

  /// Gives histories to the particles where an error ended the run before LAMMPS did, which only a
  /// program survives that uses LAMMPS as a library. To be called first in an init. Collective.
  void end_interrupted_run();

  /// Whether particles with contacts have the IDs that they had at the end of the last run, or
  /// when the restart file was written. Collective.
  bool ids_are_kept() const;

  /// The law that goes on with the histories, which another one may have made: a warning.
  /// To be called in an init. Collective.
  void go_on_with(const eepa::LawSettings &);

  /// Whether radii change in mid-run: neighbour lists are then made anew as soon as a particle has
  /// moved and grown by half the skin. To be called in an init.
  void watch_radii(bool);

  /// The particles here that the present neighbour list is the first one of, by local index: those
  /// that a fix inserted in mid-run, and all of a first run. Valid while the list is.
  const std::vector<int> &newcomers() const { return new_here; }

  int setmask() override;
  /// Whether a contact that has parted when a neighbour list is made is kept until the next force
  /// call, which the energy ledger needs. LAMMPS's fix does so where the pair style says that its
  /// forces reach beyond contact, but then compute fabric and rattlers/atom refuse the style.
  void keep_parting_contacts(bool keep) { parting_contacts = keep; }

  void init() override;
  void post_integrate() override;
  void pre_exchange() override;
  void post_neighbor() override;
  void post_run() override;

  double memory_usage() override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_border(int, int *, double *) override;
  int unpack_border(int, int, double *) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

 private:
  ContactHistory(LAMMPS *, int, char **);
  static Fix *create(LAMMPS *, int, char **);
  void keep_partners_in_new_pages();
  void forget_partners_with_new_ids();
  void follow_particles();
  void reserve_exchange();
  void remember_sizes();
  double box_moved() const;
  void warn_of_lost_histories(bigint stored);
  std::string what_does_not_fit() const;

  /// What a restart file has for a particle beside LAMMPS's own numbers, behind them.
  enum RestartTail {
    TAIL_ID,        ///< of the particle when the file was written
    TAIL_OWNER,     ///< as `owner`
    TAIL_VALUES,    ///< of a contact
    TAIL_SIZE
  };
  /// What of a restart file can not be taken up, on this rank; 0 where all can.
  struct Misfit {
    int values = 0;     ///< of a contact, where it is another number
    int moved = 0;      ///< lists of partners of other particles
    int damaged = 0;    ///< lists with impossible numbers
  };

  // ID of the particle that a list of partners belongs to, 0 for a new particle; ghosts too
  std::vector<tagint> owner;
  std::vector<int> place_in_list;    // of a particle when the neighbour list was made, -1: new
  std::vector<tagint> list_ids;      // of particles and ghosts, by their place in the list
  std::vector<int> new_here;         // see newcomers()
  bool radii_change = false;
  std::vector<double> listed_radius;    // where radii change: when the list was made
  std::vector<std::array<double, 3>> listed_position;
  std::array<double, 6> listed_box{};    // its lower and upper corner
  bool parting_contacts = false;
  bool partners_are_newest = true;    // and not what stands beside the neighbour list
  bool list_is_old = true;            // particles may have moved to other places since

  eepa::LawSettings made_by;    // the law of the last run, where there was one
  bool law_is_known = false;
  bool just_restarted = false;    // histories of a restart file were not yet looked for in a list
  Misfit misfit;
};

}    // namespace LAMMPS_NS

#endif
