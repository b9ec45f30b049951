/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifndef LMP_CONTACT_HISTORY_H
#define LMP_CONTACT_HISTORY_H

#include "fix_neigh_history.h"

#include <eepa/parameters.h>

#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// LAMMPS's neighbour-history fix, in which this package's pair styles keep their contacts.
///
/// During a run histories are kept beside the neighbour list; between runs they are kept with the
/// particles, as lists of partners by ID. This fix adds to LAMMPS's that it knows
/// - which of the two copies is newer. LAMMPS's fix makes the lists of partners from the neighbour
///   list whenever a restart file is written. The command `write_restart` has given particles and
///   ghosts other local indices by then, so contacts across a periodic or a processor boundary
///   would get the IDs of other particles;
/// - which particle an index of the neighbour list means, also after a fix that runs before this
///   one has deleted or inserted particles;
/// - which particle a list of partners belongs to: each list has the ID that its particle had when
///   the list was made;
/// - whether the histories of a restart file fit: each list of partners has its particle's ID and
///   the number of values a contact, and both are checked before the list is read.
class ContactHistory : public FixNeighHistory {
 public:
  /// Replaces the place holder in LAMMPS's list of fixes by a new ContactHistory, with the
  /// histories that a restart file has for its ID. Histories that do not fit are an error; the
  /// place holder then stays, so that a program can try again with other coefficients. Collective.
  /// \param values  number of values of a contact
  /// \param contacts_of  the pair style whose contacts are kept
  /// \param creator  of this class or one derived from it
  static ContactHistory *make(LAMMPS *, const std::string &id, int values, class Pair *contacts_of,
                              Fix *(*creator)(LAMMPS *, int, char **) = &ContactHistory::create);
  /// The ID of the fix that reserves a place in the list of fixes until make().
  static std::string place_holder(const std::string &id) { return id + "_DUMMY"; }

  ~ContactHistory() override;

  /// Marks the histories beside the neighbour list as the newer ones; to be called before they
  /// change. An error where a command has given particles other indices since the list was made.
  void force_is_computed();

  /// Stores the histories with the particles where an error ended the last run before LAMMPS did
  /// so; only a program that uses LAMMPS as a library goes on after that. To be called first in an
  /// init. Collective.
  void end_interrupted_run();

  /// Whether particles with contacts have the IDs that they had at the end of the last run, or
  /// when the restart file was written. Collective.
  bool ids_are_kept();

  /// Sets the law that uses the histories, and warns where another law made them. To be called in
  /// an init. Collective.
  void go_on_with(const eepa::LawSettings &);

  /// Sets whether radii change in mid-run: neighbour lists are then rebuilt as soon as displacement
  /// plus growth of a particle reaches half the skin. To be called in an init.
  void watch_radii(bool);

  /// Local indices of the particles that are new in the present neighbour list: those that a fix
  /// inserted in mid-run, and all in a first run. Valid as long as the list.
  const std::vector<int> &newcomers() const { return new_here; }

  int setmask() override;
  /// Sets whether a contact that has opened when a neighbour list is made is kept until the next
  /// force call, as the energy ledger needs. LAMMPS's fix keeps it for pair styles with
  /// beyond_contact, but compute fabric and compute rattlers/atom refuse such a style.
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

 protected:
  /// \param with_borders  whether ghosts get `owner` when they are made
  ContactHistory(LAMMPS *, int, char **, bool with_borders = true);
  bool watches_radii() const { return radii_change; }
  /// Whether all particles are where they were when the list was made.
  bool nobody_has_moved() const { return in_place && atom_count_is_listed(); }
  void forget_partners_with_new_ids();
  /// Marks the histories beside the neighbour list as those of the present particles.
  void list_is_made();
  void warn_of_lost_histories(bigint stored);
  /// Tells LAMMPS the most numbers that a particle takes along.
  void reserve_exchange();

  /// Makes the lists of partners on the host the newest ones, for a variant that may keep them elsewhere.
  virtual void bring_partners_to_host() {}

  // ID of the particle that a list of partners belongs to, 0 for a new particle; ghosts too
  std::vector<tagint> owner;
  std::vector<tagint> list_ids;    // IDs of particles and ghosts, by their index in the list
  std::vector<int> new_here;       // see newcomers()
  bool list_is_old = true;         // particles may have got other indices since it was made
  bool just_restarted = false;     // no neighbour list was made since a restart file was read
  bool parting_contacts = false;
  // what a particle takes along beside its partners: their number, and `owner`
  int exchange_head = 2;

 private:
  static Fix *create(LAMMPS *, int, char **);
  void keep_partners_in_new_pages();
  bool atom_count_is_listed() const;
  void follow_particles();
  void leave_places();
  int place_of(int i) const;
  void remember_sizes();
  double box_moved() const;
  std::string what_does_not_fit() const;

  /// Numbers that a restart file has for a particle after LAMMPS's own.
  enum RestartTail {
    TAIL_ID,        ///< ID of the particle when the file was written
    TAIL_OWNER,     ///< as `owner`
    TAIL_VALUES,    ///< number of values of a contact
    TAIL_SIZE
  };
  /// Histories of a restart file that do not fit, on this rank; all 0 where all fit.
  struct Misfit {
    int values = 0;     ///< number of values of a contact, where it differs
    int moved = 0;      ///< number of lists that belong to other particles
    int damaged = 0;    ///< number of lists with impossible numbers
  };

  bool in_place = true;              // all particles; place_in_list is not made then
  std::vector<int> place_in_list;    // index of a particle when the list was made, -1: new
  bool radii_change = false;
  std::vector<double> listed_radius;    // when the list was made; kept where radii change
  std::vector<std::array<double, 3>> listed_position;    // likewise
  std::array<double, 6> listed_box{};                    // likewise, lower and upper corner
  bool partners_are_newest = true;    // the lists of partners, not the neighbour list's histories

  eepa::LawSettings made_by;    // the law of the last run, where there was one
  bool law_is_known = false;
  Misfit misfit;
};

}    // namespace LAMMPS_NS

#endif
