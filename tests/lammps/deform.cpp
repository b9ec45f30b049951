// SPDX-License-Identifier: GPL-2.0-only

// A box that fix deform shears: tangential springs must follow the motion of the box.

#include "simulation.h"

#include <gtest/gtest.h>

using namespace eepa_test;

namespace {

// Two spheres one above the other in a box that is sheared along x at the rate 1 for 0.01 s; no
// force moves them.
PairContact sheared(const std::string &remap)
{
  Simulation simulation(MPI_COMM_SELF);
  simulation("units si\natom_style sphere\natom_modify map array\ncomm_modify vel yes\n"
             "boundary p p p\nregion box prism -3 3 -3 3 -3 3 0 0 0\ncreate_box 1 box\n"
             "pair_style gran/eepa linear\npair_coeff * * 1e4 1e4 0 0 10\ntimestep 1e-4");
  simulation.create({{{0, -0.495, 0}}, {{0, 0.495, 0}}});
  simulation("velocity all ramp vx -3 3 y -3 3 units box\nfix integrate all nve/noforce\n"
             "fix shear all deform 1 xy erate 1 remap " +
             remap);
  simulation.watch_contacts();
  if (remap == "x") simulation("velocity all set 0 0 0");
  simulation.run(100);
  return simulation.contacts().at(0);
}

// With the velocities of the box the spring is wound by the displacement of the surfaces.
TEST(DeformedBox, WindsTheTangentialSpringByVelocities)
{
  const double way = 0.01 * 0.99;
  EXPECT_NEAR(sheared("v").tangential().norm(), 2.0 / 7.0 * 1e4 * way,
              1e-3 * 2.0 / 7.0 * 1e4 * way);
}

// With remap x the spring is not wound, as the documentation warns.
TEST(DeformedBox, ThatMovesParticlesItselfWindsNoSpring)
{
  const PairContact contact = sheared("x");
  EXPECT_EQ(contact.tangential().norm(), 0.0);
  EXPECT_GT(contact.overlap(), 0.0);
  EXPECT_LT(contact.overlap(), 0.01);    // it was moved
}

}    // namespace
