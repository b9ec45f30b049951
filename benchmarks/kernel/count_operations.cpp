// SPDX-License-Identifier: GPL-2.0-only

// Floating-point operations of the contact law, counted while it runs: the kernel is a template on
// the scalar type, and here that type counts. Writes CSV.

#include "counted.h"
#include "sample_contacts.h"

#include <cstdio>

int main()
{
  using namespace eepa_bench;
  constexpr std::size_t contacts = 4096;
  std::printf("law,branch,rolling,additions,multiplications,divisions,roots,powers,comparisons\n");
  for (const Choice &choice : all_choices()) {
    for (Kind kind : all_kinds) {
      eepa::with_law(choice.settings, choice.parameters, [&](auto law) {
        using ContactLaw = decltype(law);
        auto packs = pack<Counted>(make_samples<ContactLaw>(choice, kind, contacts));
        const eepa::Coefficients c = eepa::resolve(choice.parameters, choice.settings);
        Counted::count = Operations();
        for (auto &[contact, history] : packs) {
          const auto response = ContactLaw::evaluate(c, contact, time_step, history);
          // assigned, because Eigen evaluates an expression only then
          [[maybe_unused]] const eepa::Wrench<Counted> wrench =
              ContactLaw::wrench(response, contact);
        }
        const Operations &n = Counted::count;
        constexpr double per = 1.0 / contacts;
        std::printf("%s,%s,%s,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f\n", choice.law.c_str(), name_of(kind),
                    choice.rolling.c_str(), per * n.additions, per * n.multiplications,
                    per * n.divisions, per * n.roots, per * n.powers, per * n.comparisons);
      });
    }
  }
  return 0;
}
