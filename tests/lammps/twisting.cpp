// SPDX-License-Identifier: GPL-2.0-only

// Twisting: a sphere that spins on a plane against closed forms, and against LAMMPS's own
// `twisting marshall`.

#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace eepa_test;

namespace {

constexpr double radius = 0.5, mass = 1.0, inertia = 0.4 * mass * radius * radius;
constexpr double k = 1e4, kt = 4e3, weight = 20.0;

/// A sphere in equilibrium on the plane z = 0 that spins about z.
void spin_on_plane(Simulation &simulation, const std::string &wall, double omega, double time_step,
                   const Vec3 &more = Vec3::Zero())
{
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, radius - weight / k), Vec3::Zero(), Vec3(0, 0, omega) + more}});
  simulation("pair_style zero 1.0\npair_coeff * *\nfix integrate all nve/sphere\n"
             "fix weight all gravity " +
             exact(weight / mass) + " vector 0 0 -1\ntimestep " + exact(time_step) + "\n" + wall);
}

std::string own_wall(double mu, const std::string &damping = "")
{
  return "fix floor all wall/gran/eepa linear coeff 1e4 1e4 0 0 " + exact(mu) + " kt 4e3 " +
      damping + " twisting marshall wall zplane 0 NULL";
}

const double contact_radius = std::sqrt(radius * weight / k);

// The torque 2/3 mu a N stops the sphere in I omega/torque, at an angle of I omega^2/(2 torque);
// then the spring oscillates with the energy that it stores.
TEST(Twisting, SpinningSphereIsStoppedByTheBoundTorque)
{
  const double mu = 0.3, omega = 5.0, torque = 2.0 / 3.0 * mu * contact_radius * weight;
  const double stop = inertia * omega / torque;
  const double stiffness = 0.5 * kt * contact_radius * contact_radius;
  const int half = 20000;
  const double dt = 0.5 * stop / half;
  Simulation simulation;
  spin_on_plane(simulation, own_wall(mu), omega, dt);
  simulation("compute e all gran/eepa/energy\n"
             "fix way all ave/time 1 1 1 c_e[10] c_e[11] mode scalar");
  // until the bound is reached the spring acts and not the slider
  const double wound = torque / stiffness;
  simulation.run(half);
  Particle p = simulation.particle(1);
  // of first order in the angle that winds the spring, while the torque is smaller
  const double late = 0.5 * wound / omega * torque / inertia;
  EXPECT_NEAR(p.omega.z(), 0.5 * omega + late, 0.1 * late);
  EXPECT_EQ(p.omega.x(), 0.0);
  EXPECT_NEAR(p.x.z(), radius - weight / k, 1e-12);
  auto e = simulation.compute_vector("e");
  ASSERT_EQ(e.size(), 11u);
  EXPECT_NEAR(e[9], 0.5 * torque * wound, 1e-9);
  EXPECT_NEAR(0.5 * inertia * (omega * omega - p.omega.squaredNorm()), e[9] + e[10], 1e-6);
  EXPECT_EQ(e[7], 0.0);
  // after the stop the kinetic energy never exceeds that of the spring
  simulation.run(half + 1000);
  const double swinging = 0.5 * torque * wound;
  double latest = 0.0;
  for (int n = 0; n < 20; n++) {
    simulation.run(777);
    const double spin = 0.5 * inertia * simulation.particle(1).omega.squaredNorm();
    e = simulation.compute_vector("e");
    EXPECT_NEAR(spin + e[9], swinging, 1e-3 * swinging);
    latest = std::max(latest, spin);
  }
  EXPECT_GT(latest, 0.1 * swinging);
  EXPECT_NEAR(e[10], 0.5 * inertia * omega * omega - swinging, 1e-3 * swinging);
}

TEST(Twisting, SpinsForEverWithoutIt)
{
  Simulation simulation;
  spin_on_plane(simulation,
                "fix floor all wall/gran/eepa linear coeff 1e4 1e4 0 0 0.3 rolling sds 1e3 1 0.1 "
                "wall zplane 0 NULL",
                5.0, 1e-4);
  simulation.run(5000);
  EXPECT_EQ(simulation.particle(1).omega.z(), 5.0);
}

// omega = sqrt(k_t a^2/2 / I); with the dashpot of B_t a^2/2 it decays in 4 I/(B_t a^2)
TEST(Twisting, SmallTwistsSwingAtTheirFrequencyAndDieAway)
{
  const double a2 = contact_radius * contact_radius, swing = std::sqrt(0.5 * kt * a2 / inertia);
  const double period = 2.0 * pi / swing;
  Simulation free, damped;
  spin_on_plane(free, own_wall(1e6), 0.01, period / 4000);
  free.run(1000);
  EXPECT_NEAR(free.particle(1).omega.z(), 0.0, 2e-5);
  free.run(1000);
  EXPECT_NEAR(free.particle(1).omega.z(), -0.01, 1e-7);
  free.run(2000);
  EXPECT_NEAR(free.particle(1).omega.z(), 0.01, 1e-7);

  const double B = 6.0, decay = 0.25 * B * a2 / inertia,
               slow = std::sqrt(swing * swing - decay * decay);
  spin_on_plane(damped, own_wall(1e6, "viscous 0 6"), 0.01, 2.0 * pi / slow / 4000);
  damped.run(4000);
  EXPECT_NEAR(damped.particle(1).omega.z(), 0.01 * std::exp(-decay * 2.0 * pi / slow), 2e-6);
}

/// omega_z in the course of a sphere's twist against a plane.
std::vector<double> course(const std::string &wall, double omega, int parts)
{
  Simulation simulation;
  spin_on_plane(simulation, wall, omega, 1e-4);
  std::vector<double> spins;
  for (int n = 0; n < parts; n++) {
    simulation.run(100);
    spins.push_back(simulation.particle(1).omega.z());
  }
  return spins;
}

// Pure twist has no lever arm, so it agrees with LAMMPS's to rounding, with and without dashpot, as
// long as nothing slides. LAMMPS's bound contains the normal dashpot, which has no force here.
TEST(Twisting, IsLammpsMarshallWhileItSticks)
{
  for (const bool dashpot : {false, true}) {
    const auto own = course(own_wall(1e6, dashpot ? "viscous 10 6" : "viscous 10 0"), 0.3, 60);
    const auto reference =
        course("fix floor all wall/gran granular hooke 1e4 10 damping velocity tangential "
               "linear_history 4e3 " +
                   std::string(dashpot ? "0.6" : "0") + " 1e6 twisting marshall zplane 0 NULL",
               0.3, 60);
    double least = 1.0;
    for (std::size_t n = 0; n < own.size(); n++) {
      EXPECT_NEAR(own[n], reference[n], 1e-10) << n;
      least = std::min(least, own[n]);
    }
    EXPECT_LT(least, -0.1);
  }
}

// While it slides both have the bound against the spin. At the end LAMMPS takes the sign of the
// spin, and this law that of the torque, which are the same for a sphere that comes to rest.
TEST(Twisting, IsLammpsMarshallWhileItSlides)
{
  const auto own = course(own_wall(0.3), 5.0, 60);
  const auto reference =
      course("fix floor all wall/gran granular hooke 1e4 0 damping velocity "
             "tangential linear_history 4e3 0 0.3 twisting marshall zplane 0 NULL",
             5.0, 60);
  for (std::size_t n = 0; n < own.size(); n++) EXPECT_NEAR(own[n], reference[n], 1e-9) << n;
  EXPECT_LT(own.back(), 4.5);
}

/// Two spheres whose centres do not move, so that they only twist; returns their spins.
std::vector<double> twist_pair(const std::string &pair, const std::string &swap, int steps = 400)
{
  Simulation simulation;
  simulation.open_box(3.0);
  const Sphere one{Vec3(-0.49, 0, 0), Vec3::Zero(), Vec3(4, 0, 0)};
  const Sphere two{Vec3(0.29, 0, 0), Vec3::Zero(), Vec3(-1, 0, 0), 0.3};
  simulation.create(swap.empty() ? std::vector<Sphere>{one, two} : std::vector<Sphere>{two, one});
  simulation(pair + "\nfix integrate all nve/sphere\nfix hold all setforce 0 0 0\ntimestep 1e-4");
  simulation.run(steps);
  std::vector<double> spins;
  for (const Particle &p : simulation.particles()) spins.push_back(p.omega.x());
  if (!swap.empty()) std::swap(spins[0], spins[1]);
  return spins;
}

TEST(Twisting, OfTwoSpheresIsLammpsMarshallAndConservesSpin)
{
  const std::string own = "pair_style gran/eepa linear\npair_coeff * * 1e4 1e4 0 0 ",
                    reference = "pair_style granular\npair_coeff * * hooke 1e4 10 damping velocity "
                                "tangential linear_history 4e3 0.6 ";
  for (const char *mu : {"1e6", "0.3"}) {
    const auto a = twist_pair(own + mu + " kt 4e3 viscous 10 6 twisting marshall", "");
    const auto b = twist_pair(reference + mu + " twisting marshall", "");
    const auto swapped = twist_pair(own + mu + " kt 4e3 viscous 10 6 twisting marshall", "swap");
    for (int n = 0; n < 2; n++) {
      EXPECT_NEAR(a[n], b[n], 1e-9) << mu;
      EXPECT_EQ(a[n], swapped[n]) << mu;
    }
    const double I1 = 0.4 * 1.0 * 0.25, I2 = 0.4 * std::pow(0.6, 3) * 0.09;
    EXPECT_NEAR(I1 * a[0] + I2 * a[1], I1 * 4.0 - I2, 1e-12);
    EXPECT_LT(std::fabs(a[0] - a[1]), 4.9);
  }
}

// A restart in the middle of a twist changes no bit, at a pair and at a wall.
TEST(Restart, KeepsATwistToTheBit)
{
  const ScratchFile file(".restart");
  const std::string styles =
      "fix integrate all nve/sphere\nfix weight all gravity 20 vector 0 0 -1\ntimestep 1e-4\n" +
      own_wall(0.3);
  Simulation original, restarted;
  original.open_box(3.0);
  original.create({{Vec3(0, 0, 0.496), Vec3::Zero(), Vec3(0, 0, 3)},
                   {Vec3(0, 0, 1.494), Vec3::Zero(), Vec3(0, 0, -3)}});
  original("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 0 0 0.3 twisting marshall\n" +
           styles);
  original.run(150);
  original("write_restart " + file.name());
  restarted("read_restart " + file.name() + "\ncomm_modify vel yes\nneighbor 0.1 bin" + "\n" +
            styles);
  original.run(200);
  restarted.run(200);
  const auto a = original.particles(), b = restarted.particles();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); n++) {
    EXPECT_EQ(a[n].omega, b[n].omega);
    EXPECT_EQ(a[n].torque, b[n].torque);
    EXPECT_GT(std::fabs(a[n].torque.z()), 0.0);
  }
}

}    // namespace
