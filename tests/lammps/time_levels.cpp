// SPDX-License-Identifier: GPL-2.0-only

// A fine grain in the groove between two large spheres of 20 times its radius rolls on both, with
// most of its spin along the normals, and leaves where no force presses it into the groove. A
// spring that is wound with the normal of another time, or that does not turn with the pair about
// the normal, pulls the grain into the groove, so that it stays to 90 degrees, or for ever.

#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

using namespace eepa_test;

namespace {

constexpr double large = 1.0, small = 0.05, start = 0.2, gravity = 1.0;

/// The problem for rigid spheres: one degree of freedom, which rolls until mu N does not suffice
/// and slides from there on.
/// \return angle from the top at which the normal force has fallen to 0 [degrees]
double rigid_grain_leaves_at(double mu)
{
  const double reach = large + small, path = std::sqrt(reach * reach - large * large),
               cosine = path / reach, arm = small * cosine;
  const double spin = 0.4 * small * small / (arm * arm), dt = 1e-5;
  double angle = start, speed = 0.0;
  bool slides = false;
  for (;;) {
    // both normal forces together, over the mass
    const double normal = (gravity * std::cos(angle) - speed * speed / path) / cosine;
    if (normal <= 0.0) return angle * 180.0 / pi;
    const double rolling = gravity * std::sin(angle) * spin / (1.0 + spin);
    slides = slides || rolling > mu * normal;
    speed += dt * (gravity * std::sin(angle) - (slides ? mu * normal : rolling));
    angle += dt * speed / path;
  }
}

double grain_leaves_at(double mu, double stiffness_over_mass, double time_step)
{
  const double mass = std::pow(2.0 * small, 3), k = stiffness_over_mass * mass;
  const double path = std::sqrt(std::pow(large + small, 2) - large * large),
               cosine = path / (large + small);
  // overlap at rest under the weight
  const double overlap = mass * gravity * std::cos(start) / (2.0 * cosine) / k;
  const double there = std::sqrt(std::pow(large + small - overlap, 2) - large * large);
  Simulation simulation;
  simulation.open_box(4.0);
  simulation.create({{Vec3(-large, 0, 0), Vec3::Zero(), Vec3::Zero(), large},
                     {Vec3(large, 0, 0), Vec3::Zero(), Vec3::Zero(), large},
                     {Vec3(0, there * std::sin(start), there * std::cos(start)), Vec3::Zero(),
                      Vec3::Zero(), small}});
  simulation("group grain id 3\npair_style gran/eepa linear\npair_coeff * * " + exact(k) + " " +
             exact(k) + " 0 0 " + exact(mu) +
             "\nneighbor 0.02 bin\nfix integrate grain nve/sphere\nfix weight grain gravity " +
             exact(gravity) + " vector 0 0 -1\ncompute c all gran/eepa/contacts\ntimestep " +
             exact(time_step));
  const int part = static_cast<int>(0.002 / time_step);
  for (double time = 0.0; time < 8.0; time += part * time_step) {
    simulation.run(part);
    if (simulation.compute_vector("c")[0] > 1.0) continue;    // 1: that of the two large ones
    const Vec3 x = simulation.particle(3).x;
    return std::atan2(x.y(), x.z()) * 180.0 / pi;
  }
  return 360.0;
}

TEST(Groove, GrainLeavesWhereARigidOneDoes)
{
  for (const double mu : {0.0, 0.3, 0.5, 1.0}) {
    const double rigid = rigid_grain_leaves_at(mu);
    const double soft = grain_leaves_at(mu, 3e4, 5e-4), stiff = grain_leaves_at(mu, 3e5, 2e-4);
    std::printf("mu %.1f: rigid %.2f, k/m = 3e4 %.2f, 3e5 %.2f degrees\n", mu, rigid, soft, stiff);
    EXPECT_NEAR(soft, rigid, 0.35);
    EXPECT_NEAR(stiff, rigid, 0.2);
  }
}

TEST(Groove, GrainLeavesAtTheSamePlaceWithAnyTimeStep)
{
  const double fine = grain_leaves_at(0.5, 3e4, 1.25e-4);
  for (const double time_step : {1e-3, 5e-4}) {
    // resolution by the steps: 0.002 at a speed of 0.6, over a path of radius 0.32
    EXPECT_NEAR(grain_leaves_at(0.5, 3e4, time_step), fine, 0.25) << time_step;
  }
}

}    // namespace
