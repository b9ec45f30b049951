// SPDX-License-Identifier: GPL-2.0-only

// Any bytes as a law, its parameters and the life of one contact, through evaluate(). Stiffness
// over 12 decades, restitution 0 to 1, exponent 1 to 2, size ratios to 100, every rolling model.
// libFuzzer calls this; replay.cpp does where there is none.

#include <eepa/eepa.h>
#include <eepa_commands/validation.h>

#include "../random_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <type_traits>

namespace {

using namespace eepa;

#define REQUIRE(condition, value, limit)                                                           \
  do {                                                                                             \
    if (!(condition)) {                                                                            \
      std::fprintf(stderr, "%s:%d: violated: %s (%.17g, %.17g)\n", __FILE__, __LINE__, #condition, \
                   static_cast<double>(value), static_cast<double>(limit));                        \
      std::abort();                                                                                \
    }                                                                                              \
  } while (false)

/// Numbers out of bytes; zeros when they are used up.
class Bytes {
 public:
  Bytes(const std::uint8_t *data, std::size_t size) : data_(data), left_(size) {}
  bool empty() const { return left_ == 0; }
  unsigned next()
  {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  /// in [0, 1], both ends included
  double unit()
  {
    const unsigned high = next();
    return (high * 256 + next()) / 65535.0;
  }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// evenly over decades
  double decades(double low, double high) { return std::pow(10.0, between(low, high)); }
  Vec3 vector(double magnitude)
  {
    const double x = between(-magnitude, magnitude), y = between(-magnitude, magnitude);
    return Vec3(x, y, between(-magnitude, magnitude));
  }

 private:
  const std::uint8_t *data_;
  std::size_t left_;
};

bool finite(const Vec3 &v)
{
  return v.allFinite();
}

template <class ContactLaw>
void live(Bytes &bytes, const Parameters &p, const LawSettings &settings)
{
  using Layout = typename ContactLaw::Layout;
  constexpr bool has_rolling = ContactLaw::has_rolling;
  const Coefficients c = resolve(p, settings);

  const double radius = bytes.decades(-5, 1);
  const bool wall = bytes.next() % 3 == 0;
  const double other_radius = wall ? INFINITY : radius * bytes.decades(-2, 2);
  const double smaller = std::min(radius, other_radius);
  const double density = bytes.decades(0, 4);
  const auto mass = [&](double r) {
    return 4.0 / 3.0 * M_PI * density * r * r * r;
  };

  Contact contact;
  contact.size = wall ? 2.0 * radius : radius + other_radius;
  contact.effective_mass = effective_mass(mass(radius), wall ? INFINITY : mass(other_radius));
  contact.effective_radius = effective_radius(radius, other_radius);
  REQUIRE(contact.effective_mass > 0.0 && contact.effective_mass <= mass(smaller) * (1 + 1e-12),
          contact.effective_mass, mass(smaller));

  // a fraction of the contact's own time, up to ten times too large a step
  const Scale scale = contact_scale(c, contact.size);
  const double time_step =
      std::sqrt(contact.effective_mass / (scale.stiffness() * c.k2)) * bytes.decades(-4, 1);
  const double speed = smaller / time_step * bytes.decades(-8, -1);
  const double reach = smaller * bytes.decades(-6, 0);

  std::array<double, Layout::size> stored{};
  double overlap = 0.0;
  bool first = true;
  for (int step = 0; step < 200 && !bytes.empty(); ++step) {
    contact.normal = bytes.vector(1.0);
    if (!(contact.normal.norm() > 1e-3)) contact.normal = Vec3(0, 0, 1);
    contact.normal.normalize();
    contact.velocity = bytes.vector(speed);
    contact.spin = bytes.vector(speed);
    contact.angular_velocity = bytes.vector(speed / smaller);
    contact.turn = bytes.vector(0.1);
    contact.turn -= contact.turn.dot(contact.normal) * contact.normal;
    contact.twist = 0.1 * bytes.vector(1.0)[0];
    if (bytes.next() % 8 != 0) overlap = reach * bytes.unit();    // else: at rest
    contact.overlap = overlap;
    contact.arm_i = lever_arm(radius, overlap);
    contact.arm_j = wall ? 0.0 : lever_arm(other_radius, overlap);
    if (!(overlap > 0.0)) {
      const History last = load_history<Layout>(stored.data());
      const Dissipation lost = dissipation_of_opening<ContactLaw>(c, contact, time_step, last);
      REQUIRE(std::isfinite(lost.total()), lost.total(), 0);
      stored.fill(0.0);
      first = true;
      continue;
    }
    const History before = load_history<Layout>(stored.data());
    History history = before;
    const Response r = ContactLaw::evaluate(c, contact, time_step, history);

    REQUIRE(std::isfinite(r.normal_force), r.normal_force, 0);
    REQUIRE(std::isfinite(r.hysteretic_force), r.hysteretic_force, 0);
    REQUIRE(finite(r.tangential_force), r.tangential_force.norm(), 0);
    REQUIRE(std::isfinite(history.max_overlap), history.max_overlap, 0);
    REQUIRE(finite(history.tangential_spring), history.tangential_spring.norm(), 0);
    REQUIRE(finite(history.rolling_spring), history.rolling_spring.norm(), 0);
    REQUIRE(std::isfinite(r.friction_bound) && r.friction_bound >= 0.0, r.friction_bound, 0);
    REQUIRE(r.tangential_force.norm() <= r.friction_bound * (1 + 1e-12) + 1e-150,
            r.tangential_force.norm(), r.friction_bound);
    double remembered = overlap;
    if constexpr (ContactLaw::Normal::law == Law::luding)
      remembered =
          std::min(overlap, ContactLaw::Normal::limit_overlap(c, ContactLaw::scale_of(c, contact)));
    REQUIRE(history.max_overlap >= remembered, history.max_overlap, remembered);
    if (settings.limit_damping)
      REQUIRE(r.normal_force >= std::min(r.hysteretic_force, 0.0), r.normal_force,
              r.hysteretic_force);
    if constexpr (has_rolling) {
      REQUIRE(finite(r.rolling_torque), r.rolling_torque.norm(), 0);
      const double limit = p.mu_r * std::fabs(r.hysteretic_force) * contact.effective_radius;
      REQUIRE(r.rolling_torque.norm() <= limit * (1 + 1e-12) + 1e-150, r.rolling_torque.norm(),
              limit);
    }
    const StoredEnergy energy = ContactLaw::stored_energy(c, contact, history);
    REQUIRE(std::isfinite(energy.total()), energy.total(), 0);
    REQUIRE(energy.tangential >= 0.0 && energy.rolling >= 0.0, energy.tangential, energy.rolling);
    if (settings.law != Law::plateau && p.f0 == 0.0)
      REQUIRE(energy.normal >= 0.0, energy.normal, 0);

    // i and j changed places, the stored numbers with their signs turned as LAMMPS does
    Contact swapped = contact;
    swapped.normal = -contact.normal;
    swapped.velocity = -contact.velocity;
    swapped.angular_velocity = -contact.angular_velocity;
    swapped.turn = -contact.turn;
    swapped.twist = -contact.twist;
    std::array<double, Layout::size> turned;
    std::transform(stored.begin(), stored.end(), turned.begin(), [](double x) {
      return -x;
    });
    History other = load_history<Layout>(turned.data());
    const Response o = ContactLaw::evaluate(c, swapped, time_step, other);
    REQUIRE(o.normal_force == r.normal_force, o.normal_force, r.normal_force);
    REQUIRE(o.tangential_force == -r.tangential_force, o.tangential_force.norm(),
            r.tangential_force.norm());
    REQUIRE(o.branch == r.branch && o.sliding == r.sliding, o.sliding, r.sliding);
    if constexpr (has_rolling)
      REQUIRE(o.rolling_torque == -r.rolling_torque, o.rolling_torque.norm(),
              r.rolling_torque.norm());
    if constexpr (ContactLaw::has_twisting) {
      const double limit =
          2.0 / 3.0 * r.friction_bound * std::sqrt(contact.effective_radius * overlap);
      REQUIRE(std::fabs(r.twisting_torque) <= limit * (1 + 1e-12) + 1e-150, r.twisting_torque,
              limit);
      REQUIRE(o.twisting_torque == r.twisting_torque, o.twisting_torque, r.twisting_torque);
    }
    REQUIRE(other.max_overlap == history.max_overlap, other.max_overlap, history.max_overlap);
    REQUIRE(other.tangential_spring == -history.tangential_spring, other.tangential_spring.norm(),
            history.tangential_spring.norm());
    REQUIRE(other.rolling_spring == -history.rolling_spring, other.rolling_spring.norm(),
            history.rolling_spring.norm());
    REQUIRE(other.twisting_spring == history.twisting_spring, other.twisting_spring,
            history.twisting_spring);

    // A slider that jumps by more than its bound's worth in one step is booked by a trapezoid
    // that is negative by up to k displacement^2 / 8.
    const Dissipation lost =
        dissipation_of_step<ContactLaw>(c, contact, r, time_step, first, before, history);
    const double normal_velocity = contact.velocity.dot(contact.normal);
    const double moved = time_step * tangential_velocity(contact, normal_velocity).norm();
    const double rolled = time_step * contact.effective_radius * contact.angular_velocity.norm();
    const double kt = scale.stiffness() * c.kt, kr = scale.stiffness() * c.kr;
    const double round_t = 1e-12 * kt * std::pow(before.tangential_spring.norm() + moved, 2);
    double round_r = 1e-12 * kr * std::pow(before.rolling_spring.norm() + rolled, 2);
    // where the spin is parallel to the normal, what rolls is a rounding error along the normal
    double slope = 1.0;
    if constexpr (!ContactLaw::Normal::Exponent::is_unit)
      slope = ContactLaw::Normal::Exponent::slope(overlap, c, scale);
    const double most_viscous =
        0.4 * std::sqrt(contact.effective_mass * scale.stiffness() * c.k1 * slope) +
        scale.force() * c.rolling_viscous;
    if (time_step > 0.0) round_r += 1e-12 * most_viscous * rolled * rolled / time_step;
    const double round_d = 1e-12 * r.tangential_force.norm() * moved + round_t;
    REQUIRE(std::isfinite(lost.total()), lost.total(), 0);
    REQUIRE(lost.hysteresis >= 0.0, lost.hysteresis, 0);
    REQUIRE(lost.normal_dashpot >=
                -1e-12 * time_step * std::fabs(normal_velocity * r.hysteretic_force),
            lost.normal_dashpot, r.hysteretic_force);
    REQUIRE(lost.tangential_dashpot >= -round_d - kt * moved * moved, lost.tangential_dashpot,
            round_d);
    REQUIRE(lost.sliding >= -round_t - kt * moved * moved, lost.sliding, round_t);
    REQUIRE(lost.rolling >= -round_r - kr * rolled * rolled, lost.rolling, round_r);

    store_history<Layout>(history, stored.data());
    first = false;
  }
}

}    // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  Bytes bytes(data, size);
  LawSettings s;
  Parameters p;
  s.law = static_cast<Law>(bytes.next() % law_count);
  if (entry_of(s.law).has_exponent && bytes.next() % 2 == 0) s.exponent = bytes.between(1.0, 2.0);
  s.limit_damping = bytes.next() % 2 == 0;
  s.scaled = bytes.next() % 2 == 0;
  if (s.scaled) s.reference_diameter = bytes.decades(-5, 1);

  eepa_test::Spread spread{-2.0, 10.0};
  spread.low = -6.0;
  spread.high = 3.0;
  spread.largest_ratio = 10.0;
  spread.ends = 0.25;
  const auto draw = [&bytes] {
    return bytes.unit();
  };
  eepa_test::draw_choices(draw, s, p);
  eepa_test::draw_numbers(draw, spread, s, p);

  const Findings found = validate(s);
  REQUIRE(found.errors.empty(), found.errors.size(), 0);
  const Findings findings = validate(p, s);
  REQUIRE(findings.errors.empty(), findings.errors.size(), 0);
  with_law(s, p, [&](auto law) {
    live<std::decay_t<decltype(law)>>(bytes, p, s);
  });
  return 0;
}
