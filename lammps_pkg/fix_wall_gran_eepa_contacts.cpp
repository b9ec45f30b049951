// SPDX-License-Identifier: GPL-2.0-only

// The histories of FixWallGranEepa's particles: as they migrate and in restart files.
//
// A restart file has for each particle {length, values of a history, contacts n, n times {face, normal,
// distance, history}}, where length counts itself. Format 3 had no normal and no distance; the
// length tells.

#include "fix_wall_gran_eepa.h"

#include <eepa/history.h>
#include <eepa_commands/restart_numbers.h>

#include "atom.h"
#include "error.h"
#include "memory.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;

void FixWallGranEepa::grow_arrays(int nmax)
{
  histories.grow(nmax);
  if (contact_table)
    memory->grow(array_atom, nmax, static_cast<int>(N_ATOM), "wall/gran/eepa:array_atom");
}

void FixWallGranEepa::copy_arrays(int i, int j, int /*delflag*/)
{
  histories.copy(i, j);
  particles_are_moved = true;
  if (contact_table) std::copy_n(array_atom[i], static_cast<int>(N_ATOM), array_atom[j]);
}

void FixWallGranEepa::set_arrays(int i)
{
  histories.clear(i);
  particles_are_moved = true;
  if (contact_table) std::fill_n(array_atom[i], static_cast<int>(N_ATOM), 0.0);
}

/// Tells LAMMPS how much a particle with so many contacts takes when it migrates.
void FixWallGranEepa::allow_for(std::size_t contacts)
{
  maxexchange = std::max(maxexchange, 1 + static_cast<int>(contacts) * packed_size());
}

int FixWallGranEepa::pack_exchange(int i, double *buf)
{
  const auto &list = histories.list(i);
  int n = 0;
  buf[n++] = static_cast<double>(list.size());
  for (std::size_t k = 0; k < list.size(); k++) n += pack(list[k], buf + n);
  return n;
}

int FixWallGranEepa::unpack_exchange(int i, double *buf)
{
  histories.clear(i);
  particles_are_moved = true;
  const int contacts = static_cast<int>(buf[0]);
  int n = 1;
  for (int k = 0; k < contacts; k++) {
    histories.mutable_list(i).push_back(unpack(buf + n));
    n += packed_size();
  }
  allow_for(contacts);
  if (contact_table) std::fill_n(array_atom[i], static_cast<int>(N_ATOM), 0.0);
  return n;
}

/// A contact's face, place and history as numbers.
int FixWallGranEepa::pack(const eepa::FaceHistory &contact, double *buf) const
{
  int n = 0;
  buf[n++] = contact.face;
  for (int k = 0; k < 3; k++) buf[n++] = contact.normal[k];
  buf[n++] = contact.distance;
  for (int k = 0; k < history_size; k++) buf[n++] = contact.values[k];
  return n;
}

eepa::FaceHistory FixWallGranEepa::unpack(const double *buf) const
{
  eepa::FaceHistory contact;
  contact.face = static_cast<int>(*buf++);
  for (int k = 0; k < 3; k++) contact.normal[k] = *buf++;
  contact.distance = *buf++;
  std::copy_n(buf, history_size, contact.values.begin());
  return contact;
}

/* ---------------------------------------------------------------------- restart files */

int FixWallGranEepa::maxsize_restart()
{
  return 3 + most_contacts * packed_size();
}

int FixWallGranEepa::size_restart(int i)
{
  return 3 + static_cast<int>(histories.list(i).size()) * packed_size();
}

int FixWallGranEepa::pack_restart(int i, double *buf)
{
  const auto &list = histories.list(i);
  int n = 3;
  for (std::size_t k = 0; k < list.size(); k++) n += pack(list[k], buf + n);
  buf[0] = n;    // first, because other fixes skip over it
  buf[1] = history_size;
  buf[2] = static_cast<double>(list.size());
  return n;
}

void FixWallGranEepa::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  const auto refuse = [this, i](const char *name, double value) {
    error->one(FLERR,
               "fix {} wall/gran/eepa: the restart file is damaged at atom {}: {} of its contacts "
               "with the wall = {}",
               id, atom->tag[i], name, value);
  };
  // number of values that all fixes together have for one atom
  const double end = atom->nextra_store;
  double start = 0.0;
  for (int k = 0; k <= nth; k++) {
    const double length = start < end ? extra[static_cast<int>(start)] : 0.0;
    if (!eepa::is_count(length, 1.0, end - start)) refuse("length", length);
    if (k < nth) start += length;
  }
  const double *entry = extra + static_cast<int>(start);
  if (entry[0] < 3.0) refuse("length", entry[0]);
  if (entry[1] != history_size)
    error->one(
        FLERR,
        "fix {} wall/gran/eepa: the restart file has {} values a contact at atom {} and the "
        "fix needs {}: rolling sds and twisting can not be switched on or off with a restart",
        id, entry[1], atom->tag[i], history_size);
  const double contacts = entry[2];
  constexpr double most = 1e6;
  if (!eepa::is_count(contacts, 0.0, most)) refuse("number", contacts);
  const bool has_place = entry[0] == 3.0 + contacts * packed_size();
  if (!has_place && entry[0] != 3.0 + contacts * (1 + history_size)) refuse("length", entry[0]);

  histories.clear(i);
  particles_are_moved = true;
  const int size = has_place ? packed_size() : 1 + history_size;
  for (int c = 0; c < static_cast<int>(contacts); c++) {
    const double *from = entry + 3 + static_cast<std::ptrdiff_t>(c) * size;
    if (!eepa::is_count(from[0], 0.0, std::numeric_limits<int>::max()) ||
        !shape->has_face(static_cast<int>(from[0])))
      refuse("face", from[0]);
    for (int k = 1; k < size; k++)
      if (!std::isfinite(from[k])) refuse("history", from[k]);
    eepa::FaceHistory contact;
    if (has_place) {
      contact = unpack(from);
    } else {
      contact.face = static_cast<int>(from[0]);
      std::copy_n(from + 1, history_size, contact.values.begin());
    }
    if (contact.values[eepa::MAX_OVERLAP] <= 0.0)
      refuse("delta_max", contact.values[eepa::MAX_OVERLAP]);
    histories.mutable_list(i).push_back(contact);
  }
  allow_for(histories.list(i).size());
}
