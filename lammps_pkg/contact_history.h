/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifndef LMP_CONTACT_HISTORY_H
#define LMP_CONTACT_HISTORY_H

#include "fix_neigh_history.h"

#include <string>

namespace LAMMPS_NS {

/// LAMMPS's neighbour-history fix, which this package's pair styles keep their contacts with.
///
/// During a run histories stand beside the neighbour list, between runs with the particles, as
/// lists of partners by ID. LAMMPS's fix makes these lists of the neighbour list whenever a restart
/// file is written, but the command `write_restart` has given particles and ghosts other places
/// by then: contacts across a periodic or a processor boundary would get the IDs of strangers.
/// This one writes the partners that it has where a force was not computed since the run's end.
class ContactHistory : public FixNeighHistory {
 public:
  /// Makes one in the place of the fix of the ID `place_holder`, in LAMMPS's list of fixes.
  /// \param values  of a contact
  /// \param contacts_of  the pair style whose neighbour list it stands beside
  static ContactHistory *replace(LAMMPS *, const std::string &place_holder, const std::string &id,
                                 int values, class Pair *contacts_of);

  /// Histories beside the neighbour list are newer than those with the particles.
  void force_is_computed() { partners_are_newest = false; }

  void post_run() override;
  void write_restart(FILE *) override;

  /// Forgets partners that have no contacts themselves: they were deleted, or are new particles
  /// with an old ID. To be called between runs. Collective.
  /// \return whether each of two partners has the other one's ID then: if not, IDs were given
  ///     anew to particles in contact
  bool keep_mutual_partners();

 private:
  using FixNeighHistory::FixNeighHistory;
  static Fix *make(LAMMPS *, int, char **);
  bool partners_are_mutual() const;
  bool partners_are_newest = true;
};

}    // namespace LAMMPS_NS

#endif
