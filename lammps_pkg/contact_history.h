/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifndef LMP_CONTACT_HISTORY_H
#define LMP_CONTACT_HISTORY_H

#include "fix_neigh_history.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// LAMMPS's neighbour-history fix, which this package's pair styles keep their contacts with.
///
/// During a run histories stand beside the neighbour list, between runs with the particles, as
/// lists of partners by ID. What this one adds to LAMMPS's is that it knows
/// - which of the two is newer. LAMMPS's fix makes the lists of partners of the neighbour list
///   whenever a restart file is written, but the command `write_restart` has given particles and
///   ghosts other places by then: contacts across a periodic or a processor boundary would get the
///   IDs of strangers;
/// - whose the lists are: each has the ID that its particle had when the list was made.
class ContactHistory : public FixNeighHistory {
 public:
  /// Makes one in the place of the fix of the ID `place_holder`, in LAMMPS's list of fixes.
  /// \param values  of a contact
  /// \param contacts_of  the pair style whose neighbour list it stands beside
  static ContactHistory *replace(LAMMPS *, const std::string &place_holder, const std::string &id,
                                 int values, class Pair *contacts_of);

  /// To be called before histories beside the neighbour list change, which are then the newer
  /// ones. An error where the list is older than a command that gave particles other places.
  void force_is_computed();

  /// Gives histories to the particles where an error ended the run before LAMMPS did, which only a
  /// program survives that uses LAMMPS as a library. To be called first in an init. Collective.
  void end_interrupted_run();

  /// Whether particles with contacts have the IDs that they had at the end of the last run, or
  /// when the restart file was written. Collective.
  bool ids_are_kept() const;

  void init() override;
  void pre_exchange() override;
  void post_neighbor() override;
  void post_run() override;

  double memory_usage() override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  void write_restart(FILE *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

 private:
  ContactHistory(LAMMPS *, int, char **);
  static Fix *make(LAMMPS *, int, char **);
  void keep_partners_in_new_pages();
  void forget_partners_with_new_ids();
  void reserve_exchange();

  std::vector<tagint> owner;          // ID of the particle that a list of partners is of, 0: new
  bool partners_are_newest = true;    // and not what stands beside the neighbour list
  bool list_is_old = true;            // particles may have moved to other places since
};

}    // namespace LAMMPS_NS

#endif
