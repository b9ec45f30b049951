// SPDX-License-Identifier: GPL-2.0-only
#include "contact_engine.h"

#include "contact_lanes.h"
#include "wall_lanes.h"

#include <eepa/dispatch.h>
#include <eepa/step.h>

namespace LAMMPS_NS {

namespace {

  template <class ContactLaw> class ContactEngineOf final : public ContactEngine {
    using Layout = typename ContactLaw::Layout;

   public:
    int lanes() const override
    {
#ifdef EEPA_HAS_LANES
      return static_cast<int>(eepa::Lanes::size());
#else
      return 0;
#endif
    }

    int evaluate_lanes([[maybe_unused]] const CoefficientClasses &classes,
                       [[maybe_unused]] double time_step,
                       [[maybe_unused]] const ParticleArrays &particles,
                       [[maybe_unused]] const ForceArrays &forces,
                       [[maybe_unused]] const FoundContact *found, [[maybe_unused]] int count,
                       [[maybe_unused]] ContactSlice &slice) const override
    {
#ifdef EEPA_HAS_LANES
      return classes.all_the_same() ? evaluate_all(SameCoefficients(classes), time_step, particles,
                                                   forces, found, count, slice)
                                    : evaluate_all(OwnCoefficients(classes), time_step, particles,
                                                   forces, found, count, slice);
#else
      return 0;
#endif
    }

    void evaluate_wall_lanes([[maybe_unused]] const eepa::Coefficients &c,
                             [[maybe_unused]] double time_step,
                             [[maybe_unused]] const WallContact *contacts,
                             [[maybe_unused]] ContactOutcome *outcomes) const override
    {
#ifdef EEPA_HAS_LANES
      WallLanes(contacts).evaluate<ContactLaw>(c, time_step, outcomes);
#endif
    }

    ContactOutcome evaluate(const eepa::Coefficients &c, const StepRequest &request,
                            const eepa::Contact &contact, bool first, double *values) const override
    {
      return eepa::step_contact<ContactLaw>(c, request, contact, first, values);
    }

    eepa::Dissipation open(const eepa::Coefficients &c, const StepRequest &request,
                           const eepa::Contact &contact, const double *values) const override
    {
      return eepa::open_contact<ContactLaw>(c, request, contact, values);
    }

    ContactReport report(const eepa::Coefficients &c, const eepa::Contact &contact,
                         const double *values, double sign) const override
    {
      eepa::History history;
      if (values) {
        history = eepa::load_history<Layout>(values);
        // the twist has the same sign seen from i and from j
        history.tangential_spring *= sign;
        history.rolling_spring *= sign;
      }
      // energies are those of the springs after the last step: an evaluation with the velocities of
      // the end of the step could let a sliding contact slip once more
      const eepa::History stored = history;
      ContactReport report;
      report.response = ContactLaw::evaluate(c, contact, 0.0, history);
      if constexpr (!ContactLaw::has_rolling) report.response.rolling_torque.setZero();
      if constexpr (!ContactLaw::has_twisting) report.response.twisting_torque = 0.0;
      report.max_overlap = history.max_overlap;
      report.plastic_overlap = ContactLaw::Normal::plastic_overlap(
          c, ContactLaw::scale_of(c, contact), history.max_overlap);
      report.energy =
          ContactLaw::stored_energy(c, contact, stored.max_overlap > 0.0 ? stored : history);
      return report;
    }

    int history_size() const override
    {
      return Layout::size;
    }

#ifdef EEPA_HAS_LANES
   private:
    /// evaluate_lanes() for one source of coefficients. Each source has a function to itself:
    /// inlined into one, they would share its registers, and both would be slower.
    /// \tparam CoefficientSource  SameCoefficients or OwnCoefficients
    template <class CoefficientSource>
    [[gnu::noinline]] static int evaluate_all(const CoefficientSource &given, double time_step,
                                              const ParticleArrays &particles,
                                              const ForceArrays &forces, const FoundContact *found,
                                              int count, ContactSlice &slice)
    {
      const CoefficientSource source =
          given;    // local copies, which no store of a force can alias
      const ParticleArrays p = particles;
      const ForceArrays f = forces;
      int n = 0;
      for (; n + ContactLanes::width <= count; n += ContactLanes::width)
        ContactLanes(found + n).evaluate<ContactLaw>(source, time_step, p, f, slice);
      return n;
    }
#endif
  };

}    // namespace

}    // namespace LAMMPS_NS

// Another name where this file is compiled for one more instruction set.
#ifndef EEPA_MAKE_ENGINE
#define EEPA_MAKE_ENGINE eepa_make_engine
#endif

const LAMMPS_NS::ContactEngine *EEPA_MAKE_ENGINE(const eepa::LawSettings &settings,
                                                 eepa::RollingModel rolling,
                                                 eepa::TwistingModel twisting)
{
  return eepa::with_law(settings, rolling, twisting,
                        [](auto law) -> const LAMMPS_NS::ContactEngine * {
                          return new LAMMPS_NS::ContactEngineOf<decltype(law)>();
                        });
}
