// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_MASSES_H
#define LMP_EEPA_CONTACT_MASSES_H

#include "atom.h"
#include "pointers.h"

#include <limits>
#include <vector>

namespace LAMMPS_NS {

class Fix;

/// The mass that each particle brings to a contact: its own, that of its rigid body, or
/// infinity where fix freeze holds it. One for the pair style and each wall.
class ContactMasses : protected Pointers {
 public:
  explicit ContactMasses(LAMMPS *lmp) : Pointers(lmp) {}

  /// Looks up fix freeze and fix rigid; LAMMPS errors if there are several of either.
  void init(const char *command);

  /// Masses of owned atoms, and of ghosts once body masses were sent to them; call each step.
  /// \return nlocal + nghost masses, valid until the next call
  const double *masses();

  /// That of one of them, for those who need few.
  double mass(int i) const
  {
    if (atom->mask[i] & freeze_groupbit_) return std::numeric_limits<double>::infinity();
    // fix rigid's are not there before the first force call
    const bool body = fix_rigid_ && !body_mass_.empty() && body_mass_[i] > 0.0;
    return body ? body_mass_[i] : atom->rmass[i];
  }

  /// Whether ghosts need the body masses that pack() and unpack() carry.
  bool has_bodies() const { return fix_rigid_ != nullptr; }
  /// Takes body masses of owned atoms from fix rigid, after each reneighbouring.
  void collect_bodies();
  double &body_mass(int i) { return body_mass_[i]; }

  int freeze_groupbit() const { return freeze_groupbit_; }
  double memory_usage() const;

 private:
  Fix *fix_rigid_ = nullptr;
  int freeze_groupbit_ = 0;
  std::vector<double> body_mass_;    // 0 for a particle in no body
  std::vector<int> not_their_own_;    // atoms that are held or in a body
  std::vector<double> mass_;
};

}    // namespace LAMMPS_NS

#endif
