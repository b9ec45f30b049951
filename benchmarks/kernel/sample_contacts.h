// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_SAMPLE_CONTACTS_H
#define EEPA_SAMPLE_CONTACTS_H

// Contacts like those in a packing of a cohesive powder, each on one branch, for the programs that
// time the law and count its operations.

#include <eepa/dispatch.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace eepa_bench {

using eepa::Vec3;

/// Kinds of contacts of one run.
enum class Kind { loading, unloading, adhesive, sliding, mixed };
constexpr Kind all_kinds[] = {Kind::loading, Kind::unloading, Kind::adhesive, Kind::sliding,
                              Kind::mixed};

inline const char *name_of(Kind kind)
{
  switch (kind) {
    case Kind::loading:
      return "loading";
    case Kind::unloading:
      return "unloading";
    case Kind::adhesive:
      return "adhesive";
    case Kind::sliding:
      return "sliding";
    case Kind::mixed:
      break;
  }
  return "mixed";
}

/// A law with its coefficients.
struct Choice {
  eepa::LawSettings settings;
  eepa::Parameters parameters;
  std::string law, rolling;
  std::string name(Kind kind) const { return law + "/" + name_of(kind) + "/" + rolling; }
};

/// Every law with every rolling model: a powder of 1 mm, as in examples/scale_collapse.
inline std::vector<Choice> all_choices()
{
  std::vector<Choice> choices;
  for (int law = 0; law < 3; law++) {
    for (int rolling = 0; rolling < 3; rolling++) {
      Choice choice;
      choice.law = law == 0 ? "plateau" : law == 1 ? "linear" : "linear 1.5";
      choice.rolling = rolling == 0 ? "none" : rolling == 1 ? "constant" : "sds";
      auto &s = choice.settings;
      s.law = law == 0 ? eepa::Law::plateau : eepa::Law::linear;
      s.exponent = law == 2 ? 1.5 : 1.0;
      s.scaled = true;
      s.reference_diameter = 1.0e-3;
      auto &p = choice.parameters;
      // of force/length^1.5 so that an overlap of 1% has the same force
      const double unit = law == 2 ? 1.0 / 3.1622776601683794e-3 : 1.0;
      p.k1 = 5.0e3 * unit;
      p.k2 = 1.0e4 * unit;
      p.k_adh = 5.0e3 * unit;
      p.f0 = -1.0e-4;
      p.mu = 0.5;
      p.kt_given = true;
      p.kt = 2.0 / 7.0 * 5.0e3;
      p.restitution = 0.3;
      p.rolling = rolling == 0 ? eepa::RollingModel::none
          : rolling == 1       ? eepa::RollingModel::constant
                               : eepa::RollingModel::sds;
      p.mu_r = rolling == 1 ? 1.0e-3 : 1.0e-2;
      if (rolling == 2) {
        p.kr = 1.0e3;
        p.rolling_viscous = 1.0e-3;
      }
      choices.push_back(choice);
    }
  }
  return choices;
}

/// Reproducible numbers in [0, 1) (Knuth's 64-bit linear congruence).
class Numbers {
 public:
  double operator()()
  {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 11) * 0x1p-53;
  }
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  Vec3 in_cube()
  {
    const double x = between(-1.0, 1.0), y = between(-1.0, 1.0), z = between(-1.0, 1.0);
    return Vec3(x, y, z);
  }

 private:
  std::uint64_t state = 20250204;
};

/// A contact and its state.
struct Sample {
  eepa::Contact contact;
  eepa::History history;
};

constexpr double time_step = 1.8e-6;

/// Contacts of a kind that stay of that kind in any number of evaluations: only contacts that slide
/// (and with sds roll at their bound) have a velocity that winds their springs.
template <class ContactLaw>
std::vector<Sample> make_samples(const Choice &choice, Kind kind, std::size_t count)
{
  Numbers random;
  const eepa::Coefficients c = eepa::resolve(choice.parameters, choice.settings);
  std::vector<Sample> samples(count);
  for (Sample &sample : samples) {
    Kind own = kind;
    if (kind == Kind::mixed) {    // shares as in the dense compression, about
      const double which = random();
      own = which < 0.6  ? Kind::loading
          : which < 0.85 ? Kind::unloading
          : which < 0.9  ? Kind::adhesive
                         : Kind::sliding;
    }
    eepa::Contact &contact = sample.contact;
    const double radius = random.between(0.4e-3, 0.6e-3), other = random.between(0.4e-3, 0.6e-3);
    contact.size = radius + other;
    contact.overlap = contact.size * random.between(0.002, 0.02);
    contact.effective_mass =
        2000.0 * 4.18879 * eepa::effective_mass(radius * radius * radius, other * other * other);
    contact.effective_radius = eepa::effective_radius(radius, other);
    Vec3 normal = random.in_cube() + Vec3(0.1, 0.2, 0.3);
    contact.normal = normal / std::sqrt(normal.squaredNorm());
    Vec3 tangent = contact.normal.cross(Vec3(0.3, -0.5, 0.8) + random.in_cube());
    tangent = tangent / std::sqrt(tangent.squaredNorm());
    const bool slides = own == Kind::sliding;
    contact.velocity = slides ? Vec3(0.05 * tangent) : Vec3(-1e-3 * random() * contact.normal);
    contact.arm_i = radius - 0.5 * contact.overlap;
    contact.arm_j = other - 0.5 * contact.overlap;
    contact.spin = 1e-3 * random() * contact.normal;
    contact.angular_velocity = random.between(1.0, 20.0) *
        (slides || !ContactLaw::Rolling::has_spring ? tangent : contact.normal);
    contact.turn = 1e-5 * tangent;
    contact.twist = 1e-5 * random();

    eepa::History &history = sample.history;
    history.max_overlap = own == Kind::unloading ? contact.overlap / 0.7
        : own == Kind::adhesive                  ? contact.overlap / 0.2
                                                 : 0.9 * contact.overlap;
    eepa::History trial = history;
    const eepa::Response response = ContactLaw::evaluate(c, contact, 0.0, trial);
    const auto stretch = (slides ? 2.0 : 0.2) * response.friction_bound /
        (eepa::contact_scale(c, contact.size).stiffness() * c.kt);
    history.tangential_spring = stretch * tangent;
    history.rolling_spring = 1e-9 * contact.normal.cross(random.in_cube());
  }
  return samples;
}

/// Number of contacts in one Real of the kernel.
template <class Real> constexpr std::size_t width = 1;
#ifdef EEPA_HAS_LANES
template <> constexpr std::size_t width<eepa::Lanes> = eepa::Lanes::size();
#endif

template <class Real> void set_lane(Real &number, std::size_t lane, double value)
{
  if constexpr (width<Real> == 1)
    number = value;
  else
    number[lane] = value;
}
template <class Real>
void set_lane(eepa::Vector3<Real> &vector, std::size_t lane, const Vec3 &value)
{
  for (int k = 0; k < 3; k++) set_lane(vector[k], lane, value[k]);
}

/// As many contacts side by side as a Real has.
template <class Real> struct Pack {
  eepa::ContactOf<Real> contact;
  eepa::HistoryOf<Real> history;
};

/// The contacts converted to another Real; those that do not fill a pack are left out.
template <class Real> std::vector<Pack<Real>> pack(const std::vector<Sample> &samples)
{
  std::vector<Pack<Real>> packs(samples.size() / width<Real>);
  for (std::size_t k = 0; k < packs.size() * width<Real>; k++) {
    const std::size_t lane = k % width<Real>;
    const eepa::Contact &from = samples[k].contact;
    eepa::ContactOf<Real> &to = packs[k / width<Real>].contact;
    set_lane(to.normal, lane, from.normal);
    set_lane(to.overlap, lane, from.overlap);
    set_lane(to.size, lane, from.size);
    set_lane(to.effective_mass, lane, from.effective_mass);
    set_lane(to.effective_radius, lane, from.effective_radius);
    set_lane(to.velocity, lane, from.velocity);
    set_lane(to.arm_i, lane, from.arm_i);
    set_lane(to.arm_j, lane, from.arm_j);
    set_lane(to.spin, lane, from.spin);
    set_lane(to.angular_velocity, lane, from.angular_velocity);
    set_lane(to.turn, lane, from.turn);
    set_lane(to.twist, lane, from.twist);
    const eepa::History &old = samples[k].history;
    eepa::HistoryOf<Real> &history = packs[k / width<Real>].history;
    set_lane(history.max_overlap, lane, old.max_overlap);
    set_lane(history.tangential_spring, lane, old.tangential_spring);
    set_lane(history.rolling_spring, lane, old.rolling_spring);
    set_lane(history.twisting_spring, lane, old.twisting_spring);
  }
  return packs;
}

}    // namespace eepa_bench

#endif
