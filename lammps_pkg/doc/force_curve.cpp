// SPDX-License-Identifier: GPL-2.0-only

// Force against overlap of one contact, from the kernel itself; make_figures.py compiles it.
//
//   force_curve plateau|linear|luding n k1 k2 k_adh f0 mu depth < overlaps > table
//
// One line for each overlap: overlap, f_hys, branch (1 loading, 2 unloading, 3 adhesive),
// delta_max, friction bound, stored normal energy.

#include <eepa/eepa.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

int main(int argc, char **argv)
{
  if (argc != 9) {
    std::fprintf(
        stderr, "force_curve plateau|linear|luding n k1 k2 k_adh f0 mu depth < overlaps > table\n");
    return 1;
  }
  eepa::LawSettings settings;
  settings.law = std::strcmp(argv[1], "plateau") == 0 ? eepa::Law::plateau
      : std::strcmp(argv[1], "luding") == 0           ? eepa::Law::luding
                                                      : eepa::Law::linear;
  settings.exponent = std::atof(argv[2]);
  eepa::Parameters p;
  p.k1 = std::atof(argv[3]);
  p.k2 = std::atof(argv[4]);
  p.k_adh = std::atof(argv[5]);
  p.f0 = std::atof(argv[6]);
  p.mu = std::atof(argv[7]);
  p.depth = std::atof(argv[8]);
  p.kt_given = true;
  const eepa::Coefficients c = eepa::resolve(p, settings);

  eepa::with_law(settings, p, [&](auto law) {
    using ContactLaw = decltype(law);
    eepa::Contact contact;
    contact.normal = eepa::Vec3::UnitX();
    contact.size = 1.0;
    contact.effective_mass = 1.0;
    contact.effective_radius = 0.25;
    contact.velocity = contact.spin = contact.angular_velocity = contact.turn = eepa::Vec3::Zero();
    contact.arm_i = contact.arm_j = 0.5;
    contact.twist = 0.0;
    eepa::History history;
    while (std::scanf("%lf", &contact.overlap) == 1) {
      const auto response = ContactLaw::evaluate(c, contact, 0.0, history);
      const auto energy = ContactLaw::stored_energy(c, contact, history);
      std::printf("%.10g %.10g %d %.10g %.10g %.10g\n", contact.overlap, response.hysteretic_force,
                  static_cast<int>(response.branch), history.max_overlap, response.friction_bound,
                  energy.normal);
    }
  });
  return 0;
}
