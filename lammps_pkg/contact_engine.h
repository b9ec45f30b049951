// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_ENGINE_H
#define LMP_EEPA_CONTACT_ENGINE_H

#include "contact_slice.h"
#include "particle_arrays.h"

#include <eepa/coefficients.h>
#include <eepa/contact_law.h>
#include <eepa/dissipation.h>
#include <eepa/history.h>

#include <memory>

namespace LAMMPS_NS {

/// What a force call asks of each contact.
struct StepRequest {
  double time_step = 0.0;       ///< that led here; 0 in the force call of a set-up [time]
  bool advance = false;         ///< keep the new state; a set-up leaves states as they are
  bool wants_energy = false;    ///< StoredEnergy
  bool wants_losses = false;    ///< Dissipation of the step
  bool booked = true;           ///< whether the step before was booked: see dissipation_of_step()
};

/// What a force call gets of a contact.
struct ContactOutcome {
  eepa::Wrench<double> wrench;
  int status;                   ///< see eepa::ContactStatus
  double max_overlap;           ///< delta_max after the call [length]
  eepa::StoredEnergy energy;    ///< where asked for
  eepa::Dissipation lost;       ///< where asked for
};

/// A contact as somebody looks at it between two steps.
struct ContactReport {
  eepa::Response response;                ///< with 0 for what the law does not have
  double max_overlap, plastic_overlap;    ///< [length]
  eepa::StoredEnergy energy;
};

/// The work on contacts that depends on the law. Pair style, its variant with threads and walls hold
/// one each, made once a run for the law that the user chose; what they do themselves is the same
/// for all laws.
///
/// There are two evaluations. That in lanes takes a block of pairs of particles, in steps that need
/// forces and nothing else. The scalar one takes any single contact and answers what is asked.
class ContactEngine {
 public:
  virtual ~ContactEngine() = default;

  /// Evaluates contacts of one pair of types side by side and adds their forces.
  /// \param found  `count` contacts
  /// \return how many were evaluated: the first ones, as many as fill the lanes
  virtual int evaluate_lanes(const eepa::Coefficients &c, double time_step,
                             const ParticleArrays &particles, const ForceArrays &forces,
                             const FoundContact *found, int count, ContactSlice &slice) const = 0;

  /// \param contact  overlap > 0
  /// \param first  whether the contact formed in this step
  /// \param[in,out] history  history_size() values
  virtual ContactOutcome evaluate(const eepa::Coefficients &c, const StepRequest &request,
                                  const eepa::Contact &contact, bool first,
                                  double *history) const = 0;

  /// What a contact dissipates that has opened, or was taken away.
  virtual eepa::Dissipation open(const eepa::Coefficients &c, const StepRequest &request,
                                 const eepa::Contact &contact, const double *history) const = 0;

  /// Looks at a contact and changes nothing.
  /// \param history  of the contact, or nullptr where it has none
  /// \param sign  -1 where the history is that of the contact seen from j
  virtual ContactReport report(const eepa::Coefficients &c, const eepa::Contact &contact,
                               const double *history, double sign) const = 0;

  /// Values that a contact remembers.
  virtual int history_size() const = 0;
};

/// The engine of the law that was chosen.
std::unique_ptr<const ContactEngine> make_contact_engine(const eepa::LawSettings &settings,
                                                         eepa::RollingModel rolling,
                                                         eepa::TwistingModel twisting);

}    // namespace LAMMPS_NS

#endif
