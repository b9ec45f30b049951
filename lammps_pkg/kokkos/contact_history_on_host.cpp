// SPDX-License-Identifier: GPL-2.0-only
#include "contact_history_on_host.h"

using namespace LAMMPS_NS;

void ContactHistoryOnHost::copy_arrays(int i, int j, int delflag)
{
  change_partners_on_host();
  ContactHistory::copy_arrays(i, j, delflag);
}

void ContactHistoryOnHost::set_arrays(int i)
{
  change_partners_on_host();
  ContactHistory::set_arrays(i);
}

int ContactHistoryOnHost::pack_exchange(int i, double *buf)
{
  bring_partners_to_host();
  return ContactHistory::pack_exchange(i, buf);
}

int ContactHistoryOnHost::unpack_exchange(int i, double *buf)
{
  change_partners_on_host();
  return ContactHistory::unpack_exchange(i, buf);
}

int ContactHistoryOnHost::pack_restart(int i, double *buf)
{
  bring_partners_to_host();
  return ContactHistory::pack_restart(i, buf);
}

void ContactHistoryOnHost::unpack_restart(int i, int nth)
{
  change_partners_on_host();
  ContactHistory::unpack_restart(i, nth);
}

int ContactHistoryOnHost::size_restart(int i)
{
  bring_partners_to_host();
  return ContactHistory::size_restart(i);
}

int ContactHistoryOnHost::maxsize_restart()
{
  bring_partners_to_host();
  return ContactHistory::maxsize_restart();
}
