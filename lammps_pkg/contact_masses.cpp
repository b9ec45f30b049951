// SPDX-License-Identifier: GPL-2.0-only
#include "contact_masses.h"

#include "error.h"
#include "fix.h"
#include "group.h"
#include "modify.h"
#include "neighbor.h"

#include <cstring>

using namespace LAMMPS_NS;

void ContactMasses::init(const char *command)
{
  const auto freezes = modify->get_fix_by_style("^freeze");
  if (freezes.size() > 1)
    error->all(FLERR,
               "{}: fix {} freeze and fix {} freeze are active, and LAMMPS allows one: use one fix "
               "freeze for the union of both, as in 'group frozen union {} {}'",
               command, freezes[0]->id, freezes[1]->id, group->names[freezes[0]->igroup],
               group->names[freezes[1]->igroup]);
  freeze_groupbit_ = freezes.empty() ? 0 : freezes.front()->groupbit;

  fixes_rigid_.clear();
  body_mass_.clear();    // local indices of atoms may have changed since the last run
  body_.clear();
  for (auto *fix : modify->get_fix_list()) {
    if (!fix->rigid_flag) continue;
    if (utils::strmatch(fix->style, "^poems"))
      error->all(FLERR,
                 "{} can not be used with fix {} {}, which does not tell the masses of its bodies",
                 command, fix->id, fix->style);
    fixes_rigid_.push_back(fix);
  }
}

void ContactMasses::collect_bodies()
{
  body_mass_.assign(atom->nmax, 0.0);
  body_.assign(atom->nmax, 0.0);
  for (std::size_t k = 0; k < fixes_rigid_.size(); k++)
    collect_bodies_of(fixes_rigid_[k], static_cast<double>(k));
}

void ContactMasses::collect_bodies_of(Fix *fix, double which)
{
  int dim;
  const auto *body = static_cast<int *>(fix->extract("body", dim));
  const auto *total = static_cast<double *>(fix->extract("masstotal", dim));
  if (!body || !total) return;    // a rank without bodies
  // fix rigid/small numbers bodies on each processor separately; the first number that it sends to
  // another processor is unique: the ID of the particle that represents the body
  const bool small = std::strstr(fix->style, "/small") != nullptr;
  constexpr int longest = 1024;    // what LAMMPS reserves for a fix without a maxexchange
  std::vector<double> packed(small ? longest : 0);
  const double count = static_cast<double>(fixes_rigid_.size());
  for (int i = 0; i < atom->nlocal; i++) {
    if (body[i] < 0) continue;
    body_mass_[i] = total[body[i]];
    double number = body[i] + 1.0;
    if (small) {
      fix->pack_exchange(i, packed.data());
      number = static_cast<double>(static_cast<tagint>(ubuf(packed[0]).i));
    }
    body_[i] = number * count + which;
  }
}

int ContactMasses::pack_bodies(int n, const int *atoms, double *buf) const
{
  for (int k = 0; k < n; k++) {
    buf[2 * k] = body_mass_[atoms[k]];
    buf[2 * k + 1] = body_[atoms[k]];
  }
  return 2 * n;
}

void ContactMasses::unpack_bodies(int n, int first, const double *buf)
{
  for (int k = 0; k < n; k++) {
    body_mass_[first + k] = buf[2 * k];
    body_[first + k] = buf[2 * k + 1];
  }
}

const double *ContactMasses::masses()
{
  if (!holds_some()) return atom->rmass;

  // the set of atoms that are frozen or in a body changes only with the neighbour list, the masses
  // of the others at any step
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
  return static_cast<double>((mass_.capacity() + body_mass_.capacity() + body_.capacity()) *
                                 sizeof(double) +
                             not_their_own_.capacity() * sizeof(int));
}
