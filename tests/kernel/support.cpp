// SPDX-License-Identifier: GPL-2.0-only
#include "support.h"

namespace eepa_test {

Outcome evaluate(const Material &m, const Bodies &b, double time_step, History &history)
{
  return with_law(m.law, m.p, [&](auto law) {
    using Law = decltype(law);
    const Coefficients c = resolve(m.p, m.law);
    const Contact contact = b.contact(time_step);
    const History before = history;
    Outcome out;
    static_cast<Response &>(out) =
        Law::evaluate(c, contact, time_step, history);
    if (!Law::has_rolling) out.rolling_torque.setZero();
    if (!Law::has_twisting) out.twisting_torque = 0.0;
    static_cast<Wrench<double> &>(out) = Law::wrench(out, contact);
    out.energy = Law::stored_energy(c, contact, history);
    out.lost = dissipation_of_step<Law>(c, contact, out, time_step, before.max_overlap == 0.0,
                                        before, history);
    return out;
  });
}

}    // namespace eepa_test
