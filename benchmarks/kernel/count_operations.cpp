// SPDX-License-Identifier: GPL-2.0-only

// Floating-point operations of the contact law, counted while it runs: the kernel's own headers
// are compiled with a number that keeps count in place of double. What they do, and nothing that
// was written down beside them, is what is counted. Writes CSV.

#include "counted.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#define double eepa_bench::Counted
#define Vector3d Matrix<eepa_bench::Counted, 3, 1>
#include "sample_contacts.h"
#undef double
#undef Vector3d

int main()
{
  using namespace eepa_bench;
  constexpr std::size_t contacts = 4096;
  std::printf("law,branch,rolling,additions,multiplications,divisions,roots,powers,comparisons\n");
  for (const Choice &choice : all_choices()) {
    for (Kind kind : all_kinds) {
      eepa::with_law(choice.settings, choice.parameters.rolling, [&](auto law) {
        using ContactLaw = decltype(law);
        auto samples = make_samples<ContactLaw>(choice, kind, contacts);
        const eepa::Coefficients c = eepa::resolve(choice.parameters, choice.settings);
        Counted::count = Operations();
        for (Sample &sample : samples) {
          const eepa::Response response =
              ContactLaw::evaluate(c, false, sample.contact, time_step, sample.history);
          [[maybe_unused]] const Vec3 force = ContactLaw::force_on_i(response, sample.contact);
          [[maybe_unused]] const Vec3 moment =
              ContactLaw::tangential_moment(response, sample.contact);
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
