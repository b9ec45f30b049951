// SPDX-License-Identifier: GPL-2.0-only
#include "contact_masses.h"

#include "error.h"
#include "fix.h"
#include "modify.h"
#include "neighbor.h"

using namespace LAMMPS_NS;

void ContactMasses::init(const char *command)
{
  const auto freezes = modify->get_fix_by_style("^freeze");
  if (freezes.size() > 1)
    error->all(FLERR, "{}: {} fix freeze commands are active, one is allowed", command,
               freezes.size());
  freeze_groupbit_ = freezes.empty() ? 0 : freezes.front()->groupbit;

  fix_rigid_ = nullptr;
  body_mass_.clear();    // atoms may have come, gone and changed places since the last run
  for (auto *fix : modify->get_fix_list()) {
    if (!fix->rigid_flag) continue;
    if (fix_rigid_)
      error->all(FLERR, "{}: fix rigid {} and {} are both active, one is allowed", command,
                 fix_rigid_->id, fix->id);
    fix_rigid_ = fix;
  }
}

void ContactMasses::collect_bodies()
{
  int dim;
  const auto *body = static_cast<int *>(fix_rigid_->extract("body", dim));
  const auto *total = static_cast<double *>(fix_rigid_->extract("masstotal", dim));
  body_mass_.assign(atom->nmax, 0.0);
  for (int i = 0; i < atom->nlocal; i++)
    if (body[i] >= 0) body_mass_[i] = total[body[i]];
}

const double *ContactMasses::masses()
{
  if (!fix_rigid_ && !freeze_groupbit_) return atom->rmass;

  // which atoms are held or in a body changes with the neighbour list; the masses of others may
  // at any step
  const int nall = atom->nlocal + atom->nghost;
  if (neighbor->ago == 0 || static_cast<int>(mass_.size()) != nall) {
    not_their_own_.clear();
    for (int i = 0; i < nall; i++)
      if (mass(i) != atom->rmass[i]) not_their_own_.push_back(i);
  }
  mass_.assign(atom->rmass, atom->rmass + nall);
  for (const int i : not_their_own_) mass_[i] = mass(i);
  return mass_.data();
}

double ContactMasses::memory_usage() const
{
  return static_cast<double>((mass_.capacity() + body_mass_.capacity()) * sizeof(double) +
                             not_their_own_.capacity() * sizeof(int));
}
