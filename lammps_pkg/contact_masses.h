// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_MASSES_H
#define LMP_EEPA_CONTACT_MASSES_H

#include "atom.h"
#include "pointers.h"

#include <limits>
#include <vector>

namespace LAMMPS_NS {

class Fix;

/// Mass of each particle in a contact: its own, that of its rigid body, or infinity where fix
/// freeze holds it. The pair style and each wall have their own object.
class ContactMasses : protected Pointers {
 public:
  explicit ContactMasses(LAMMPS *lmp) : Pointers(lmp) {}

  /// Looks up fix freeze and every fix rigid. Two fix freeze are an error, as in LAMMPS itself.
  void init(const char *command);

  /// Masses of owned atoms, and of ghosts once body masses were sent to them; call each step.
  /// \return nlocal + nghost masses, valid until the next call
  const double *masses();

  /// Mass of one atom, for callers that need few.
  double mass(int i) const
  {
    if (freeze_groupbit_ != 0 && (atom->mask[i] & freeze_groupbit_))
      return std::numeric_limits<double>::infinity();
    // masses of rigid bodies are not known before the first force call
    const bool body = !fixes_rigid_.empty() && !body_mass_.empty() && body_mass_[i] > 0.0;
    return body ? body_mass_[i] : atom->rmass[i];
  }

  /// Whether two particles can not move each other: both are frozen, or in the same rigid body.
  bool hold_together(int i, int j) const
  {
    if (atom->mask[i] & atom->mask[j] & freeze_groupbit_) return true;
    return !body_.empty() && body_[i] != 0.0 && body_[i] == body_[j];
  }
  /// Whether there can be such a pair.
  bool holds_some() const { return freeze_groupbit_ != 0 || has_bodies(); }

  /// Whether ghosts need the bodies that pack_bodies() and unpack_bodies() carry.
  bool has_bodies() const { return !fixes_rigid_.empty(); }
  /// Takes the bodies of owned atoms from the fixes rigid, after each reneighbouring.
  void collect_bodies();
  int pack_bodies(int n, const int *atoms, double *buf) const;    ///< 2 numbers an atom
  void unpack_bodies(int n, int first, const double *buf);

  /// Of each atom, its body's mass and number; 0 for an atom in no body.
  const std::vector<double> &body_masses() const { return body_mass_; }
  const std::vector<double> &bodies() const { return body_; }

  int freeze_groupbit() const { return freeze_groupbit_; }
  double memory_usage() const;

 private:
  void collect_bodies_of(Fix *, double which);

  std::vector<Fix *> fixes_rigid_;
  int freeze_groupbit_ = 0;
  std::vector<double> body_mass_;     // 0 for a particle in no body
  std::vector<double> body_;          // unique number of a body over all fixes; 0 as above
  std::vector<int> not_their_own_;    // atoms that are frozen or in a body
  std::vector<double> mass_;
};

}    // namespace LAMMPS_NS

#endif
