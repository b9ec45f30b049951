// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_STEP_H
#define EEPA_STEP_H

#include "contact_law.h"
#include "dissipation.h"
#include "history.h"
#include "status.h"

namespace eepa {

// What a driver does with one contact in a force call, from its row of history and back to it.

/// What a force call requests for each contact.
struct StepRequest {
  double time_step = 0.0;       ///< step to the present positions; 0 in a set-up [time]
  bool advance = false;         ///< keep the new state; a set-up does not change states
  bool wants_energy = false;    ///< compute StoredEnergy
  bool wants_losses = false;    ///< compute Dissipation of the step
  bool booked = true;           ///< whether the step before was booked: see dissipation_of_step()

  /// The request of a force call.
  /// \param in_step  in a time step, else in a set-up
  EEPA_FUNCTION static StepRequest of_call(bool in_step, double dt, bool keep_ledger,
                                           bool ledger_starts)
  {
    return {in_step ? dt : 0.0, in_step, keep_ledger, keep_ledger && in_step, !ledger_starts};
  }
};

/// Result of a force call for one contact.
struct ContactOutcome {
  Wrench<double> wrench;
  int status;             ///< see ContactStatus
  double max_overlap;     ///< delta_max after the call [length]
  StoredEnergy energy;    ///< if requested
  Dissipation lost;       ///< if requested
};

/// The most that a caller ever requests; code for more is left out.
enum class Wanted { forces, energies, losses };

/// Evaluates a contact and keeps its new state where the request says so.
/// \param contact  overlap > 0
/// \param first  whether the contact formed in this step
/// \param[in,out] row  ContactLaw::history_size values, see history.h
template <class ContactLaw, Wanted most = Wanted::losses, class Row>
EEPA_FUNCTION ContactOutcome step_contact(const Coefficients &c, const StepRequest &request,
                                          const Contact &contact, [[maybe_unused]] bool first,
                                          Row row)
{
  using Layout = typename ContactLaw::Layout;
  History history = load_history<Layout>(row);
  [[maybe_unused]] const History before = history;
  const Response response = ContactLaw::evaluate(c, contact, request.time_step, history);
  if (request.advance) store_history<Layout>(history, row);

  ContactOutcome outcome;
  outcome.wrench = ContactLaw::wrench(response, contact);
  outcome.status = ContactStatus::of(response);
  outcome.max_overlap = history.max_overlap;
  if constexpr (most != Wanted::forces)
    if (request.wants_energy) outcome.energy = ContactLaw::stored_energy(c, contact, history);
  if constexpr (most == Wanted::losses)
    if (request.wants_losses)
      outcome.lost = dissipation_of_step<ContactLaw>(c, contact, response, request.time_step, first,
                                                     before, history, request.booked);
  return outcome;
}

/// Energy dissipated by a contact that has opened or was taken away.
/// \param row  its state after its last step
template <class ContactLaw, class Row>
EEPA_FUNCTION Dissipation open_contact(const Coefficients &c, const StepRequest &request,
                                       const Contact &contact, Row row)
{
  return dissipation_of_opening<ContactLaw>(c, contact, request.time_step,
                                            load_history<typename ContactLaw::Layout>(row),
                                            request.booked);
}

}    // namespace eepa

#endif
