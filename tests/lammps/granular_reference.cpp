// SPDX-License-Identifier: GPL-2.0-only

// Against LAMMPS's own `pair_style granular` where the physics is the same: linear spring and
// dashpot (k2 = k1, k_adh = f0 = 0), linear_history friction, rolling sds. LAMMPS winds its springs
// with one lever arm (the whole radius) and computes torques with another; this project uses R -
// delta/2 for both. So the two differ by O(delta/R), which scales with k^-1/2.

#include "packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace eepa_test;

namespace {

struct Model {
  const char *name;
  double mu;
  bool dashpot;    ///< in the contact; LAMMPS's friction bound contains it, this project's does not
  const char *rolling;    ///< "" or the mu_r of sds
  bool rolling_dashpot;
  double speed;    ///< of approach of each
  Vec3 shift, spin;
};

/// An oblique collision of two spheres of mass 1: velocities and spins at the end.
std::vector<Particle> collide(const Model &model, double k, bool own)
{
  const double mu = model.mu, kt = 2.0 / 7.0 * k, bn = model.dashpot ? 0.04 * std::sqrt(k) : 0.0,
               bt = model.dashpot ? 0.02 * std::sqrt(k) : 0.0, kr = 0.3 * k,
               gr = model.rolling_dashpot ? 0.01 * std::sqrt(k) : 0.0;
  const bool rolling = *model.rolling;
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({{Vec3(-0.5005, 0, 0), Vec3(model.speed, 0, 0) + model.shift, model.spin},
                     {Vec3(0.5005, 0, 0), Vec3(-model.speed, 0, 0), Vec3::Zero()}});
  if (own) {
    simulation(
        "pair_style gran/eepa linear\npair_coeff * * " + exact(k) + " " + exact(k) + " 0 0 " +
        exact(mu) + " kt " + exact(kt) + " viscous " + exact(bn) + " " + exact(bt) +
        (rolling ? " rolling sds " + exact(kr) + " " + exact(gr) + " " + model.rolling : ""));
  } else {
    // damping velocity: the normal coefficient is B itself, the tangential one a multiple of it
    simulation(
        "pair_style granular\npair_coeff * * hooke " + exact(k) + " " + exact(bn) +
        " damping velocity tangential linear_history " + exact(kt) + " " +
        exact(model.dashpot ? bt / bn : 0.0) + " " + exact(mu) +
        (rolling ? " rolling sds " + exact(kr) + " " + exact(gr) + " " + model.rolling : ""));
  }
  // a contact lasts pi sqrt(m*/k); 4000 steps for approach and contact
  const double contact = pi * std::sqrt(0.5 / k) + 0.001 / (2.0 * model.speed);
  simulation("fix integrate all nve/sphere\ntimestep " + exact(contact / 3000.0));
  simulation.run(3600);
  return simulation.particles();
}

/// Largest difference of velocities and of surface speeds through spin.
double deviation(const std::vector<Particle> &a, const std::vector<Particle> &b)
{
  double worst = 0.0;
  for (std::size_t k = 0; k < a.size(); k++)
    worst = std::max({worst, (a[k].v - b[k].v).norm(), 0.5 * (a[k].omega - b[k].omega).norm()});
  return worst;
}

class GranularCollision : public testing::TestWithParam<Model> {};

// Stiffer by 100 the overlap is a tenth, and so is the deviation.
TEST_P(GranularCollision, IsThatOfLammpsUpToTheLeverArm)
{
  const Model &model = GetParam();
  double by_stiffness[3];
  for (int n = 0; n < 3; n++) {
    const double k = 1e4 * std::pow(100.0, n);
    const auto reference = collide(model, k, false), own = collide(model, k, true);
    EXPECT_GT((reference[0].v - Vec3(model.speed, 0, 0) - model.shift).norm(),
              0.5);    // the spheres did collide
    by_stiffness[n] = deviation(reference, own);
    const double overlap = 2.0 * model.speed * std::sqrt(0.5 / k);
    EXPECT_LT(by_stiffness[n], 2.0 * overlap / 0.5) << k;
  }
  std::printf("%s: %.1e %.1e %.1e\n", model.name, by_stiffness[0], by_stiffness[1],
              by_stiffness[2]);
  // to the accuracy of the time integration, which differs between the two only by the arms
  EXPECT_LT(by_stiffness[1], 0.2 * by_stiffness[0] + 1e-9);
  EXPECT_LT(by_stiffness[2], 0.2 * by_stiffness[1] + 1e-9);
}
const Model models[] = {
    {"sliding", 0.4, false, "", false, 1.0, Vec3(0, 4, 1), Vec3::Zero()},
    {"sticking", 0.4, false, "", false, 1.0, Vec3(0, 0.3, 0.2), Vec3(0, 0.1, 0)},
    {"damped", 1e9, true, "", false, 1.0, Vec3(0, 0.6, 0), Vec3(0, 0, 1)},
    {"rolling", 0.4, false, "0.1", false, 1.0, Vec3(0, 0.3, 0), Vec3(0, 1, 3)},
    {"rolling_damped", 0.4, false, "0.1", true, 1.0, Vec3(0, 0.3, 0), Vec3(0, 1, 3)},
};
INSTANTIATE_TEST_SUITE_P(Models, GranularCollision, testing::ValuesIn(models),
                         [](const auto &info) {
                           return std::string(info.param.name);
                         });

// Central collisions do not depend on the arms: the same motion to rounding.
TEST(GranularReference, CentralCollisionIsTheSameToRounding)
{
  const Model model = {"central", 0.4, true, "", false, 1.0, Vec3::Zero(), Vec3::Zero()};
  EXPECT_LT(deviation(collide(model, 1e4, false), collide(model, 1e4, true)), 1e-12);
}

// A packing without friction does not depend on the arms either.
TEST(GranularReference, FrictionlessPackingMovesAlike)
{
  Packing packing;
  packing.polydisperse = true;
  std::vector<Particle> end[2];
  for (const bool own : {false, true}) {
    Simulation simulation;
    simulation.open_box(packing.half(), 1, "p p p");
    simulation.create(packing.spheres());
    simulation(own ? "pair_style gran/eepa linear\npair_coeff * * 1e4 1e4 0 0 0 viscous 4 0"
                   : "pair_style granular\npair_coeff * * hooke 1e4 4 damping velocity tangential "
                     "linear_history 0 0 0");
    simulation("fix integrate all nve/sphere\ntimestep 5e-4");
    simulation.run(300);
    end[own] = simulation.particles();
  }
  EXPECT_LT(difference(end[0], end[1]), 1e-9);
}

/* ---------------------------------------------------------------------- prescribed motion */

// Two spheres of radius 0.5 and 0.3 that overlap by 0.01, with prescribed motion, so that forces
// can be compared step by step without the effect of the arms: LAMMPS winds springs with R omega,
// this project with a omega, a = R - delta/2; both compute torques with a.
class PrescribedMotion : public testing::Test {
 protected:
  static constexpr double overlap = 0.01, radii[2] = {0.5, 0.3};
  Simulation reference, own;
  double worst = 0.0, largest = 0.0;
  int sticking = 0, slipping = 0;

  void open(const std::string &granular, const std::string &eepa)
  {
    for (auto *simulation : {&reference, &own}) {
      simulation->open_box(3.0);
      Sphere one, other;
      other.x = (radii[0] + radii[1] - overlap) * Vec3(0.6, 0.0, 0.8);
      other.radius = radii[1];
      simulation->create({one, other});
      (*simulation)(simulation == &own ? "pair_style gran/eepa linear\npair_coeff * * " + eepa
                                       : "pair_style granular\npair_coeff * * " + granular);
      (*simulation)("timestep 1e-3");
    }
    own.watch_contacts();
  }
  /// Spins that give the same surface velocities in both.
  void spin(const Vec3 &first, Vec3 second)
  {
    // without a mean spin about the normal, with which springs turn here and not in LAMMPS's
    const Vec3 normal(0.6, 0.0, 0.8);
    const double arms[] = {radii[0] / (radii[0] - 0.5 * overlap),
                           radii[1] / (radii[1] - 0.5 * overlap)};
    second -= (arms[0] * first + arms[1] * second).dot(normal) / arms[1] * normal;
    reference.set_velocity(1, Vec3::Zero(), first);
    reference.set_velocity(2, Vec3::Zero(), second);
    own.set_velocity(1, Vec3::Zero(), arms[0] * first);
    own.set_velocity(2, Vec3::Zero(), arms[1] * second);
  }
  void compare(int steps)
  {
    reference("run " + std::to_string(steps) + " pre no post no");
    own("run " + std::to_string(steps) + " pre no post no");
    const auto a = reference.particles(), b = own.particles();
    for (std::size_t k = 0; k < 2; k++) {
      largest = std::max({largest, a[k].f.norm(), a[k].torque.norm()});
      worst = std::max({worst, (a[k].f - b[k].f).norm(), (a[k].torque - b[k].torque).norm()});
    }
  }
  void count_slip() { (own.contacts().at(0).slip() != 0.0 ? slipping : sticking)++; }
  void expect_same(const char *what)
  {
    EXPECT_GT(largest, 1.0);
    EXPECT_LT(worst, 1e-12 * largest);
    std::printf("%s: %.1e of the largest force\n", what, worst / largest);
  }
};

// One sphere is led around the other on an ellipse: sticking, sliding, reversals, a turning normal,
// an overlap that comes and goes.
TEST_F(PrescribedMotion, SlidingByTranslation)
{
  open("hooke 1e4 0 damping velocity tangential linear_history 3e3 0 0.4",
       "1e4 1e4 0 0 0.4 kt 3e3 viscous 0 0");
  for (auto *simulation : {&reference, &own}) {
    (*simulation)("variable x equal 0\nvariable y equal 0.05*sin(20*step*dt)\nvariable vy equal "
                  "cos(20*step*dt)\n"
                  "variable z equal 0.002*(1-cos(30*step*dt))\n"
                  "variable vz equal 0.06*sin(30*step*dt)\ngroup led id 2\n"
                  "fix lead led move variable v_x v_y v_z v_x v_vy v_vz");
    simulation->run(0);
  }
  for (int k = 0; k < 100; k++) {
    compare(7);
    count_slip();
  }
  EXPECT_GT(sticking, 10);
  EXPECT_GT(slipping, 10);
  expect_same("sliding by translation");
}

TEST_F(PrescribedMotion, SlidingBySpinWithDashpots)
{
  open("hooke 1e4 20 damping velocity tangential linear_history 3e3 0.5 0.4",
       "1e4 1e4 0 0 0.4 kt 3e3 viscous 20 10");
  const Vec3 spins[] = {Vec3(0.2, 1.5, -0.5), Vec3(-0.4, -2.5, 0.2), Vec3(2.0, 0.3, 0.4),
                        Vec3(0.0, 0.1, 0.0)};
  for (const Vec3 &omega : spins) {
    spin(omega, -0.5 * omega + Vec3(0.1, 0.2, 0.3));
    reference.run(0);
    own.run(0);
    for (int k = 0; k < 20; k++) {
      compare(2);
      count_slip();
    }
  }
  EXPECT_GT(sticking, 10);
  EXPECT_GT(slipping, 10);
  expect_same("sliding by spin");
}

// Rolling springs are wound by R* (omega_i - omega_j) in both: no arm, and the same spins.
TEST_F(PrescribedMotion, RollingSds)
{
  open("hooke 1e4 20 damping velocity tangential linear_history 3e3 0 0 rolling sds 2e3 5 0.1",
       "1e4 1e4 0 0 0 kt 3e3 viscous 20 0 rolling sds 2e3 5 0.1");
  double least = 1e9, most = 0.0;
  const Vec3 spins[] = {Vec3(0.5, 2.0, -0.7), Vec3(-1.5, -2.0, 0.2), Vec3(2.0, 0.3, 1.0),
                        Vec3(0.0, 0.1, 0.1)};
  for (const Vec3 &omega : spins) {
    // twisting against each other only, as in spin()
    const Vec3 normal(0.6, 0.0, 0.8);
    Vec3 other = Vec3(0.3, -0.2, 0.4) - 0.6 * omega;
    other -= (omega + other).dot(normal) * normal;
    for (auto *simulation : {&reference, &own}) {
      simulation->set_velocity(1, Vec3::Zero(), omega);
      simulation->set_velocity(2, Vec3::Zero(), other);
      simulation->run(0);
    }
    for (int k = 0; k < 30; k++) {
      compare(1);
      const double torque = own.particle(1).torque.norm();
      least = std::min(least, torque);
      most = std::max(most, torque);
    }
  }
  // the bound mu_r N R* is reached, but not always
  const double bound = 0.1 * 1e4 * overlap * 0.15 / 0.8;
  EXPECT_NEAR(most, bound, 1e-9);
  EXPECT_LT(least, 0.5 * bound);
  expect_same("rolling sds");
}

}    // namespace
