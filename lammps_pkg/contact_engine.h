// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_ENGINE_H
#define LMP_EEPA_CONTACT_ENGINE_H

#include "coefficient_classes.h"
#include "contact_slice.h"
#include "particle_arrays.h"

#include <eepa/coefficients.h>
#include <eepa/contact_law.h>
#include <eepa/dissipation.h>
#include <eepa/step.h>

#include <memory>

namespace LAMMPS_NS {

class LAMMPS;

using eepa::ContactOutcome;
using eepa::StepRequest;

/// A contact of a particle and a wall that goes on from the step before.
struct WallContact {
  eepa::Body<double> body;
  eepa::WallPoint<double> wall;    ///< overlap > 0
  double *history;                 ///< history_size() values
};

/// State and forces of a contact, queried between two steps.
struct ContactReport {
  eepa::Response response;                ///< torques that the law does not have are 0
  double max_overlap, plastic_overlap;    ///< [length]
  eepa::StoredEnergy energy;
};

/// Everything about contacts that depends on the law. The pair style, its threaded variant and each
/// wall hold one engine, made when the law that the user chose is known; their own code is the same
/// for all laws.
///
/// There are two kinds of evaluation. Those in lanes take several contacts, in steps that need forces
/// and at walls energies. The scalar one takes any single contact and computes what is requested.
class ContactEngine {
 public:
  virtual ~ContactEngine() = default;

  /// How many contacts are evaluated side by side; 0 where there are no lanes.
  virtual int lanes() const = 0;

  /// Evaluates contacts side by side and adds their forces.
  /// \param found  `count` contacts
  /// \return how many were evaluated: the first ones, as many as fill the lanes
  virtual int evaluate_lanes(const CoefficientClasses &classes, double time_step,
                             const ParticleArrays &particles, const ForceArrays &forces,
                             const FoundContact *found, int count, ContactSlice &slice) const = 0;

  /// Evaluates contacts with a wall side by side, the same as evaluate() in a step without losses, and
  /// stores their new states.
  /// \param contacts  lanes() of them
  /// \param[out] outcomes  as many; the status is not set
  virtual void evaluate_wall_lanes(const eepa::Coefficients &c, double time_step,
                                   const WallContact *contacts, ContactOutcome *outcomes) const = 0;

  /// \param contact  overlap > 0
  /// \param first  whether the contact formed in this step
  /// \param[in,out] history  history_size() values
  virtual ContactOutcome evaluate(const eepa::Coefficients &c, const StepRequest &request,
                                  const eepa::Contact &contact, bool first,
                                  double *history) const = 0;

  /// Energy dissipated by a contact that has opened or was taken away.
  virtual eepa::Dissipation open(const eepa::Coefficients &c, const StepRequest &request,
                                 const eepa::Contact &contact, const double *history) const = 0;

  /// Evaluates a contact without a change of its state.
  /// \param history  of the contact, or nullptr where it has none
  /// \param sign  -1 where the history is stored for the exchanged pair, j and i
  virtual ContactReport report(const eepa::Coefficients &c, const eepa::Contact &contact,
                               const double *history, double sign) const = 0;

  /// Number of values of a contact's history.
  virtual int history_size() const = 0;
};

/// Makes the engine of the chosen law.
std::unique_ptr<const ContactEngine> make_contact_engine(LAMMPS *lmp,
                                                         const eepa::LawSettings &settings,
                                                         eepa::RollingModel rolling,
                                                         eepa::TwistingModel twisting);

/// The instruction set of the engines that make_contact_engine() makes; nullptr in a build that has
/// no choice.
const char *chosen_instruction_set(LAMMPS *lmp);

}    // namespace LAMMPS_NS

// Engines compiled for one instruction set each. With EEPA_ARCH=dispatch contact_engine.cpp is compiled
// for several. Their code is kept apart; what both sides of a call see is in this header.
extern "C" {
/// For the instruction set of all other code.
const LAMMPS_NS::ContactEngine *eepa_make_engine(const eepa::LawSettings &settings,
                                                 eepa::RollingModel rolling,
                                                 eepa::TwistingModel twisting);
const LAMMPS_NS::ContactEngine *eepa_make_engine_x86_64_v3(const eepa::LawSettings &settings,
                                                           eepa::RollingModel rolling,
                                                           eepa::TwistingModel twisting);
}

namespace LAMMPS_NS::detail {
// Eigen aligns its types of 2, 4, ... numbers as the instruction set likes it. Types that cross this
// interface contain no such type, so their layout is the same for all instruction sets.
template <class... Shared>
constexpr bool one_layout = ((alignof(Shared) <= alignof(double)) && ...);
static_assert(
    one_layout<eepa::LawSettings, eepa::Coefficients, CoefficientClasses, StepRequest,
               ParticleArrays, ForceArrays, FoundContact, DeferredForce, DeferredLoss, ContactSlice,
               WallContact, eepa::Contact, ContactOutcome, eepa::Dissipation, ContactReport>,
    "shared types have the layout of all instruction sets");
}    // namespace LAMMPS_NS::detail

#endif
