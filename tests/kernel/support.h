// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TESTS_KERNEL_SUPPORT_H
#define EEPA_TESTS_KERNEL_SUPPORT_H

#include <eepa/eepa.h>
#include <eepa_commands/mixing.h>
#include <eepa_commands/restart_numbers.h>
#include <eepa_commands/validation.h>

#include "../random_parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

// Each test file has a namespace of its own, so that all of them can also be compiled as one.

namespace eepa_test {

using namespace eepa;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Settings and parameters of one kind of contact.
struct Material {
  LawSettings law;
  Parameters p;
};

inline Material material(Law law, double k1, double k2, double k_adh, double f0 = 0.0,
                         double exponent = 1.0)
{
  Material m;
  m.law.law = law;
  m.law.exponent = exponent;
  m.p.k1 = k1;
  m.p.k2 = k2;
  m.p.k_adh = k_adh;
  m.p.f0 = f0;
  m.p.mu = 0.5;
  if (exponent != 1.0) {
    m.p.kt_given = true;
    m.p.kt = 0.3 * k1 * std::pow(1e-5, exponent - 1.0);
  }
  return m;
}

inline void scale_with_diameter(Material &m, double reference)
{
  m.law.scaled = true;
  m.law.reference_diameter = reference;
}

/// Two bodies in contact; R_j and m_j infinite for a wall.
struct Bodies {
  double R_i = 5e-4, R_j = 4e-4, m_i = 1e-6, m_j = 5e-7;
  Vec3 u = Vec3::UnitX();
  double overlap = 1e-5;
  Vec3 v_i = Vec3::Zero(), v_j = Vec3::Zero(), w_i = Vec3::Zero(), w_j = Vec3::Zero();

  bool wall() const { return std::isinf(R_j); }
  double size() const { return wall() ? 2.0 * R_i : R_i + R_j; }
  /// \param time_step  that led here
  Contact contact(double time_step = 0.0) const
  {
    Contact c;
    c.normal = u;
    c.overlap = overlap;
    c.size = size();
    c.effective_mass = effective_mass(m_i, m_j);
    c.effective_radius = effective_radius(R_i, R_j);
    c.velocity = v_i - v_j;
    c.arm_i = arm_i();
    c.arm_j = arm_j();
    c.spin = c.arm_i * w_i;
    if (!wall()) c.spin += c.arm_j * w_j;
    c.angular_velocity = w_i - w_j;
    if (wall())
      c.turn.setZero();
    else
      c.turn = turn_of_pair<double>(u, c.velocity, 1.0 / (R_i + R_j - overlap), time_step);
    c.twist = twist_of_pair<double>(u, w_i + w_j, time_step);
    return c;
  }
  double arm_i() const { return lever_arm(R_i, overlap); }
  double arm_j() const { return wall() ? 0.0 : lever_arm(R_j, overlap); }
};

/// Result of a driver for one contact.
struct Outcome : Response, Wrench<double> {
  StoredEnergy energy;
  Dissipation lost;
};

/// One step of a contact by the law of its material. It is defined in support.cpp, where every law
/// is compiled once.
Outcome evaluate(const Material &m, const Bodies &b, double time_step, History &history);

inline Outcome evaluate(const Material &m, const Bodies &b, double time_step = 0.0)
{
  History history;
  return evaluate(m, b, time_step, history);
}

/// The normal law alone, along a path of overlaps.
class NormalPath {
  template <class Function> auto with(Function &&function) const
  {
    return with_law(m_.law, Parameters(), [&](auto law) {
      return function(typename decltype(law)::Normal{});
    });
  }

 public:
  /// \param radius  R*
  explicit NormalPath(const Material &m, double size = 1.0, double radius = Bodies().R_i) :
      m_(m), c_(resolve(m.p, m.law)), scale_(contact_scale(c_, size))
  {
    scale_.effective_radius = radius;
  }
  NormalForce to(double overlap)
  {
    const NormalForce f = at(overlap);
    max_overlap = f.max_overlap;
    return f;
  }
  /// the same without a change of the history
  NormalForce at(double overlap) const
  {
    return with([&](auto normal) {
      return decltype(normal)::force(c_, scale_, overlap, max_overlap);
    });
  }
  double energy(double overlap) const
  {
    return with([&](auto normal) {
      return decltype(normal)::elastic_energy(c_, scale_, overlap, max_overlap);
    });
  }
  double plastic_overlap() const
  {
    return with([&](auto normal) {
      return decltype(normal)::plastic_overlap(c_, scale_, max_overlap);
    });
  }
  double loss(double before, double after) const
  {
    return with([&](auto normal) {
      return decltype(normal)::loss(c_, scale_, before, after);
    });
  }
  double opening_loss() const
  {
    return with([&](auto normal) {
      return decltype(normal)::opening_loss(c_, scale_, max_overlap);
    });
  }
  double bound(const NormalForce &f) const { return friction_bound(c_, f); }

  double max_overlap = 0.0;

 private:
  Material m_;
  Coefficients c_;
  Scale scale_;
};

/// Relative to the larger of the two, and to `scale` where both may vanish.
inline double deviation(double a, double b, double scale = 0.0)
{
  const double size = std::max({std::fabs(a), std::fabs(b), scale});
  return size > 0.0 ? std::fabs(a - b) / size : 0.0;
}
inline double deviation(const Vec3 &a, const Vec3 &b, double scale = 0.0)
{
  const double size = std::max({a.norm(), b.norm(), scale});
  return size > 0.0 ? (a - b).norm() / size : 0.0;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double lo, double hi)
  {
    // by hand: the standard's distributions differ between libraries
    return lo + (hi - lo) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  double decades(double lo, double hi) { return std::pow(10.0, uniform(lo, hi)); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  Vec3 vector(double size)
  {
    Vec3 v;
    for (int k = 0; k < 3; k++) v[k] = uniform(-size, size);
    return v;
  }
  Vec3 direction()
  {
    while (true) {
      const Vec3 v = vector(1.0);
      const double length = v.norm();
      if (length > 0.1 && length <= 1.0) return v / length;
    }
  }

 private:
  std::mt19937 engine_;
};

/// A material anywhere in the parameter space (stiffness over 12 decades).
inline Material any_material(Random &random)
{
  Spread spread{-3.0, 9.0};
  spread.high = 1.0;
  spread.overlap = 1e-4;
  spread.mass = 1e-8;
  spread.largest_ratio = 1.5;
  Material m;
  m.law.law = static_cast<Law>(static_cast<int>(random.uniform(0.0, law_count)));
  if (entry_of(m.law.law).has_exponent && random.chance(0.5))
    m.law.exponent = random.uniform(1.0, 2.0);
  m.law.limit_damping = random.chance(0.3);
  if (random.chance(0.5)) scale_with_diameter(m, random.decades(-4.0, -2.0));
  const auto draw = [&random] { return random.uniform(0.0, 1.0); };
  draw_choices(draw, m.law, m.p);
  draw_numbers(draw, spread, m.law, m.p);
  return m;
}

/// Two bodies with size ratios to 100, or a wall; velocities and spins at random.
inline Bodies any_bodies(Random &random)
{
  Bodies b;
  b.R_i = random.decades(-4.0, -2.5);
  b.m_i = 8000.0 * std::pow(b.R_i, 3.0);
  if (random.chance(0.2)) {
    b.R_j = b.m_j = infinity;
  } else {
    b.R_j = b.R_i * random.decades(-2.0, 2.0);
    b.m_j = 8000.0 * std::pow(b.R_j, 3.0);
  }
  return b;
}

inline void any_motion(Random &random, Bodies &b)
{
  b.u = (b.u + random.uniform(0.0, 0.5) * random.direction()).normalized();
  b.v_i = random.vector(0.3);
  b.v_j = random.vector(0.3);
  b.w_i = random.vector(random.decades(-1.0, 2.5));
  b.w_j = b.wall() ? Vec3(Vec3::Zero()) : random.vector(random.decades(-1.0, 2.5));
}

}    // namespace eepa_test

#endif
