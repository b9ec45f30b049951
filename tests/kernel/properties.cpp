// SPDX-License-Identifier: GPL-2.0-only
// Properties that hold anywhere in the parameter space: stiffness over 12 decades, restitution 0 to
// 1, n from 1 to 2, size ratios to 100, every law, every rolling model, walls, scaling.

#include "support.h"

namespace properties_test {
using namespace eepa_test;

TEST(Properties, GeneratedMaterialsAreValid)
{
  Random random(91);
  for (int k = 0; k < 2000; k++) {
    const Material m = any_material(random);
    ASSERT_TRUE(validate(m.law).errors.empty());
    const Findings found = validate(m.p, m.law);
    ASSERT_TRUE(found.errors.empty()) << found.errors[0];
  }
}

/// delta* of `luding`
double limit_of(const Material &m, const Bodies &b)
{
  const Contact contact = b.contact();
  Scale scale;
  scale.effective_radius = contact.effective_radius;
  return LudingLaw::limit_overlap(resolve(m.p, m.law), scale);
}

TEST(Properties, FiniteAndBoundedByCoulomb)
{
  Random random(92);
  int branches[4] = {}, sliding = 0;
  for (int k = 0; k < 3000; k++) {
    const Material m = any_material(random);
    Bodies b = any_bodies(random);
    b.u = random.direction();
    History history;
    for (int step = 0; step < 20; step++) {
      any_motion(random, b);
      // up to half of the smaller radius, down to 0
      b.overlap = std::min(b.R_i, b.R_j) * random.decades(-9.0, -0.3);
      const double before = history.max_overlap;
      const Outcome out = evaluate(m, b, random.decades(-9.0, -5.0), history);
      branches[int(out.branch)]++;
      sliding += out.sliding;
      ASSERT_TRUE(out.force.allFinite() && out.torque_i.allFinite() && out.torque_j.allFinite());
      ASSERT_TRUE(history.tangential_spring.allFinite() && history.rolling_spring.allFinite());
      ASSERT_TRUE(std::isfinite(out.energy.total()) && std::isfinite(out.lost.total()));
      ASSERT_GE(out.friction_bound, 0.0);
      ASSERT_LE(out.tangential_force.norm(), out.friction_bound * (1.0 + 1e-14));
      ASSERT_NEAR(out.tangential_force.dot(b.u), 0.0, 1e-9 * out.tangential_force.norm());
      // never below the present overlap, or the limit of `luding`; only loading raises it, and all
      // but `plateau` lower it by adhesion
      const double least = m.law.law == Law::luding ? std::min(b.overlap, limit_of(m, b))
                                                    : b.overlap;
      ASSERT_GE(history.max_overlap, least);
      if (out.branch == Branch::unloading) { ASSERT_EQ(history.max_overlap, before); }
      if (out.branch == Branch::adhesive) {
        ASSERT_LE(history.max_overlap, before * (1.0 + 1e-14));
        if (m.law.law == Law::plateau) { ASSERT_EQ(history.max_overlap, before); }
      }
      if (b.overlap >= before) {
        ASSERT_EQ(out.branch, Branch::loading);
        ASSERT_EQ(history.max_overlap, least);
      }
      const double limit = m.law.limit_damping ? std::min(out.hysteretic_force, 0.0) : -infinity;
      ASSERT_GE(out.normal_force, limit);
      ASSERT_GE(out.lost.normal_dashpot, 0.0);
      if (m.law.law != Law::plateau) { ASSERT_GE(out.lost.hysteresis, 0.0); }
      if (m.p.rolling == RollingModel::sds) {
        ASSERT_LE(out.rolling_torque.norm(),
                  (1.0 + 1e-12) * m.p.mu_r * std::fabs(out.hysteretic_force) *
                      effective_radius(b.R_i, b.R_j));
      }
    }
  }
  EXPECT_GT(branches[1], 1000);
  EXPECT_GT(branches[2], 1000);
  EXPECT_GT(branches[3], 1000);
  EXPECT_GT(sliding, 1000);
}

// a dashpot dissipates energy in every state of the other parts
TEST(Properties, DashpotsOpposeTheMotion)
{
  Random random(93);
  for (int k = 0; k < 2000; k++) {
    const Material m = any_material(random);
    Bodies b = any_bodies(random);
    any_motion(random, b);
    b.overlap = 0.01 * std::min(b.R_i, b.R_j);
    const Outcome out = evaluate(m, b);
    ASSERT_LE((out.normal_force - out.hysteretic_force) * (b.v_i - b.v_j).dot(b.u), 0.0);
    // the spring is empty: the tangential force is that of the dashpot
    const Contact c = b.contact();
    ASSERT_LE(out.tangential_force.dot(tangential_velocity(c, c.velocity.dot(c.normal))), 0.0);
  }
}

// `linear` is continuous everywhere, `plateau` everywhere but at its plateau, where it steps by f0
TEST(Properties, ContinuousWherePromised)
{
  Random random(94);
  for (int k = 0; k < 1000; k++) {
    const Material m = any_material(random);
    const double size = random.decades(-4.0, -2.0), top = 0.05 * size;
    NormalPath path(m, size);
    path.to(top);
    double x = top, force = path.at(top).force;
    Branch branch = Branch::loading;
    const double f0 = contact_scale(resolve(m.p, m.law), size).force() * m.p.f0;
    const double range = std::fabs(force - f0) * (1.0 + m.p.k2 / m.p.k1 + m.p.k_adh / m.p.k1);
    const int steps = 300;
    for (int i = 1; i < 2 * steps; i++) {
      const double next = top * std::fabs(1.0 - double(i) / steps);
      if (next == 0.0) continue;
      const NormalForce f = path.to(next);
      double jump = f.force - force;
      if (m.law.law == Law::plateau) {
        if (branch != Branch::adhesive && f.branch == Branch::adhesive) jump += f0;
        if (branch == Branch::adhesive && f.branch != Branch::adhesive) jump -= f0;
      }
      ASSERT_LE(std::fabs(jump), 3.0 * m.law.exponent * range / steps)
          << "law " << int(m.law.law) << " k2/k1 " << m.p.k2 / m.p.k1 << " i " << i;
      branch = f.branch;
      force = f.force;
      x = next;
    }
    ASSERT_GT(x, 0.0);
  }
}

// the force is a function of overlap and history, so a longer step along the same branch ends in
// the same force
TEST(Properties, LongAndShortStridesEndAlike)
{
  Random random(95);
  for (int k = 0; k < 500; k++) {
    const Material m = any_material(random);
    const double size = 1e-3;
    NormalPath fine(m, size), coarse(m, size);
    double x = 0.0;
    for (int leg = 0; leg < 8; leg++) {
      const double target = 0.05 * size * random.uniform(0.001, 1.0);
      for (int i = 1; i <= 40; i++) fine.to(x + (target - x) * i / 40.0);
      fine.to(target);
      const NormalForce a = fine.to(target), b = coarse.to(target);
      const double scale = std::fabs(a.force) + std::fabs(b.force) +
          contact_scale(resolve(m.p, m.law), size).stiffness() * m.p.k2 * 1e-4 *
              std::pow(5e-5, m.law.exponent);
      ASSERT_NEAR(a.force, b.force, 1e-10 * scale);
      x = target;
    }
  }
}

// every law, exponent and rolling model has a compile-time policy of its own
TEST(Properties, DispatchPicksThePolicies)
{
  for (int k = 0; k < law_count; k++) {
    const Law law = static_cast<Law>(k);
    for (double n : {1.0, 1.5}) {
      for (RollingModel model : {RollingModel::none, RollingModel::constant, RollingModel::sds})
        for (TwistingModel twisting : {TwistingModel::none, TwistingModel::marshall}) {
          LawSettings settings;
          settings.law = law;
          settings.exponent = entry_of(law).has_exponent ? n : 1.0;
          const bool right = with_law(settings, model, twisting, [&](auto picked) {
            using Picked = decltype(picked);
            return Picked::Normal::law == law && Picked::Rolling::model == model &&
                Picked::Normal::Exponent::is_unit == (settings.exponent == 1.0) &&
                Picked::Twisting::model == twisting &&
                Picked::history_size ==
                (model == RollingModel::sds ? 7 : 4) + (twisting == TwistingModel::none ? 0 : 1);
          });
          EXPECT_TRUE(right);
        }
    }
  }
}
}    // namespace properties_test
