// SPDX-License-Identifier: GPL-2.0-only
// Histories that go with their particles.

#include "contact_history.h"

using namespace LAMMPS_NS;

/// LAMMPS's fix does not count particles that came from other processors.
void ContactHistory::reserve_exchange()
{
  maxexchange = (dnum + 1) * maxpartner + exchange_head;
}

void ContactHistory::grow_arrays(int nmax)
{
  FixNeighHistory::grow_arrays(nmax);
  owner.resize(nmax, 0);
  place_in_list.resize(nmax, -1);
}

void ContactHistory::copy_arrays(int i, int j, int delflag)
{
  FixNeighHistory::copy_arrays(i, j, delflag);
  leave_places();
  owner[j] = owner[i];
  place_in_list[j] = place_in_list[i];
}

void ContactHistory::set_arrays(int i)
{
  FixNeighHistory::set_arrays(i);
  leave_places();
  owner[i] = 0;
  place_in_list[i] = -1;
}

int ContactHistory::pack_border(int n, int *particles, double *buf)
{
  for (int k = 0; k < n; k++) buf[k] = ubuf(owner[particles[k]]).d;
  return n;
}

int ContactHistory::unpack_border(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++) owner[first + k] = static_cast<tagint>(ubuf(buf[k]).i);
  return n;
}

int ContactHistory::pack_exchange(int i, double *buf)
{
  const int m = FixNeighHistory::pack_exchange(i, buf);
  buf[m] = ubuf(owner[i]).d;
  return m + 1;
}

int ContactHistory::unpack_exchange(int i, double *buf)
{
  const int m = FixNeighHistory::unpack_exchange(i, buf);
  owner[i] = static_cast<tagint>(ubuf(buf[m]).i);
  leave_places();
  place_in_list[i] = -1;
  reserve_exchange();
  return m + 1;
}
