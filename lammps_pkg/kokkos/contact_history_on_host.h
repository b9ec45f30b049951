// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_HISTORY_ON_HOST_H
#define LMP_EEPA_CONTACT_HISTORY_ON_HOST_H

#include "contact_history.h"

namespace LAMMPS_NS {

/// What LAMMPS asks of ContactHistory on the host, a particle at a time: the lists of partners are brought there first.
class ContactHistoryOnHost : public ContactHistory {
 public:
  using ContactHistory::ContactHistory;

  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

 protected:
  /// Brings the lists of partners to the host, where they change next.
  virtual void change_partners_on_host() = 0;
};

}    // namespace LAMMPS_NS

#endif
