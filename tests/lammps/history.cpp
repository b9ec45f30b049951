// SPDX-License-Identifier: GPL-2.0-only

// When a contact's history changes, and when it must not.

#include "packing.h"

#include "atom.h"
#include "force.h"
#include "lammps.h"
#include "pair.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

constexpr double k1 = 1e4, k2 = 4e4, k_adh = 5e3;

/// Two spheres along x: the first held, the second carried by carry().
class TwoSpheres : public testing::Test {
 protected:
  Simulation simulation;

  void open(const std::string &style, double overlap)
  {
    simulation.open_box(4.0);
    simulation.create({{Vec3(0, 0, 0)}, {Vec3(1.0 - overlap, 0, 0)}});
    simulation("pair_style gran/eepa " + style +
               "\npair_coeff 1 1 1e4 4e4 5e3 0 0.5\ntimestep 1e-5\ngroup second id 2");
    simulation.watch_contacts();
  }
  void carry(const Vec3 &distance)
  {
    const Vec3 v = distance / (1000 * 1e-5);
    simulation("fix carry second move linear " + exact(v.x()) + " " + exact(v.y()) + " " +
               exact(v.z()));
    simulation.run(1000);
    simulation("unfix carry");
  }
  double force() { return simulation.particle(2).f.x(); }
};

TEST_F(TwoSpheres, FollowTheLinearLawAlongAPath)
{
  open("linear", 0.0);
  carry(Vec3(-0.02, 0, 0));
  EXPECT_NEAR(force(), k1 * 0.02, 1e-6);
  carry(Vec3(0.004, 0, 0));
  EXPECT_NEAR(force(), k2 * (0.016 - 0.75 * 0.02), 1e-6);
  carry(Vec3(0.006, 0, 0));    // past delta_p = 0.015 to the adhesive branch
  EXPECT_NEAR(force(), -k_adh * 0.01, 1e-6);
  carry(Vec3(-0.002, 0, 0));    // reloads on the k2 line through (0.01, -k_adh 0.01)
  EXPECT_NEAR(force(), k2 * (0.012 - (1.0 + k_adh / k2) * 0.01), 1e-6);
  carry(Vec3(-0.012, 0, 0));    // and loads on
  EXPECT_NEAR(force(), k1 * 0.024, 1e-6);
}

TEST_F(TwoSpheres, FollowThePlateauLawAlongAPath)
{
  open("plateau", 0.0);
  carry(Vec3(-0.02, 0, 0));
  EXPECT_NEAR(force(), k1 * 0.02, 1e-6);
  // k2 = 4 k1: delta_p = 0.005; the loading line holds down to delta_max/3
  carry(Vec3(0.01, 0, 0));
  EXPECT_NEAR(force(), k1 * 0.01, 1e-6);
  carry(Vec3(0.004, 0, 0));
  EXPECT_NEAR(force(), k2 * (0.006 - 0.005), 1e-6);
  carry(Vec3(0.003, 0, 0));
  EXPECT_NEAR(force(), -k_adh * 0.005, 1e-6);
  carry(Vec3(0.002, 0, 0));
  EXPECT_NEAR(force(), -k_adh * 0.005, 1e-6);
  // unloading follows the same line back: delta_max did not change
  carry(Vec3(-0.005, 0, 0));
  EXPECT_NEAR(force(), k2 * (0.006 - 0.005), 1e-6);
}

// plateau keeps delta_max until the contact opens, linear has lowered it to 0 by then: with the old
// delta_max = 0.02 the force at an overlap of 0.004 would be -k_adh delta_p = -25.
TEST_F(TwoSpheres, HaveAVirginContactAfterTheyParted)
{
  open("plateau", 0.0);
  carry(Vec3(-0.02, 0.001, 0));
  carry(Vec3(0.016, 0, 0));
  EXPECT_LT(force(), -24.0);
  carry(Vec3(0.014, 0, 0));
  EXPECT_TRUE(simulation.contacts().empty());
  carry(Vec3(-0.014, -0.001, 0));
  ASSERT_EQ(simulation.contacts().size(), 1u);
  const PairContact contact = simulation.contacts()[0];
  EXPECT_EQ(contact.max_overlap(), contact.overlap());
  EXPECT_EQ(contact.branch(), 1.0);
  EXPECT_NEAR(contact.normal_force, k1 * contact.overlap(), 1e-9);
}

// All between two rebuilds of the neighbour list, which would delete the history of separate pairs
// anyway.
TEST_F(TwoSpheres, HaveAVirginContactAfterAnOpeningWithinOneRun)
{
  open("plateau", 0.0);
  // x = 1 - 0.024 sin(2 pi t/T): in to 0.024, as far out, and in again to 0.004 just after T
  simulation("fix carry second move wiggle -0.024 0 0 0.01");
  simulation.run(1027);
  const double overlap = 0.024 * std::sin(2.0 * pi * 0.027);
  EXPECT_NEAR(force(), k1 * overlap, 1e-6);
}

TEST_F(TwoSpheres, HaveAVirginContactAfterTheyWerePlacedApart)
{
  open("plateau", 0.0);
  carry(Vec3(-0.02, 0, 0));
  simulation("displace_atoms second move 0.03 0 0\nrun 0 post no\n"
             "displace_atoms second move -0.014 0 0\nrun 0 post no");
  EXPECT_NEAR(force(), k1 * 0.004, 1e-9);
}

TEST_F(TwoSpheres, KeepTheirHistoryWhenPlacedWithinTheContact)
{
  open("linear", 0.0);
  carry(Vec3(-0.02, 0, 0));
  simulation("displace_atoms second move 0.004 0 0\nrun 0 post no");
  EXPECT_NEAR(force(), k2 * (0.016 - 0.75 * 0.02), 1e-6);
}

TEST_F(TwoSpheres, AreNotWoundUpBySetUpCalls)
{
  open("linear", 0.01);
  // relative surface velocity in the tangent plane, which a real step would wind the spring by
  simulation.set_velocity(2, Vec3(0, 3, 0), Vec3(0, 0, 5));
  for (int k = 0; k < 3; k++) {
    simulation("run 0 post no");
    EXPECT_EQ(simulation.particle(2).f.y(), 0.0);
    EXPECT_EQ(simulation.contacts()[0].tangential().norm(), 0.0);
  }
  // set-ups leave no largest overlap behind either
  simulation("displace_atoms second move 0.005 0 0\nrun 0 post no");
  EXPECT_NEAR(force(), k1 * 0.005, 1e-9);
}

TEST_F(TwoSpheres, LoseTheHistoryOfADeletedPartner)
{
  open("linear", 0.0);
  simulation.create({{Vec3(0, 2, 0)}});
  carry(Vec3(-0.02, 0, 0));
  // LAMMPS keeps histories by ID, so the replacement must have a new ID
  simulation("delete_atoms group second compress no");
  simulation.create({{Vec3(0.99, 0, 0)}});
  simulation("run 0 post no");
  EXPECT_EQ(simulation.particles().back().id, 4);
  EXPECT_NEAR(simulation.particle(4).f.x(), k1 * 0.01, 1e-9);
}

// single() gives the force of the run, with the sign for the particle that it is asked about.
TEST_F(TwoSpheres, SingleShowsTheForcesOfTheRun)
{
  open("linear", 0.01);
  simulation("fix integrate all nve/sphere");
  simulation.set_velocity(2, Vec3(0.1, 0.5, -0.2), Vec3(1, 2, 3));
  simulation.run(50);
  const auto contacts = simulation.contacts();
  ASSERT_EQ(contacts.size(), 1u);
  const PairContact &c = contacts[0];
  const Particle i = simulation.particle(c.i), j = simulation.particle(c.j);
  const Vec3 normal = (i.x - j.x).normalized();
  EXPECT_LT((c.normal_force * normal + c.tangential() - i.f).norm(), 1e-9);
  EXPECT_NEAR(c.overlap(), 1.0 - (i.x - j.x).norm(), 1e-15);
  EXPECT_NEAR(c.plastic_overlap(), 0.75 * c.max_overlap(), 1e-15);
  EXPECT_NEAR(c.tangential().dot(normal), 0.0, 1e-12);
  EXPECT_NEAR(c.p[3], c.tangential().norm(), 1e-12);
  // the bound of the contract: mu (f_hys + k_adh delta - f0)
  EXPECT_NEAR(c.p[10], 0.5 * (c.p[9] + k_adh * c.overlap()), 1e-9);
  EXPECT_LE(c.p[3], c.p[10] * (1.0 + 1e-12));
  EXPECT_GT(c.p[3], 0.0);
}

// With the two particles exchanged, the springs and the forces on "i" have the other sign.
TEST_F(TwoSpheres, SingleIsTheOppositeFromTheOtherSide)
{
  open("linear", 0.01);
  simulation("fix integrate all nve/sphere\npair_coeff 1 1 1e4 4e4 5e3 0 0.5 rolling sds 1e3 1 0.1 "
             "twisting marshall");
  simulation.set_velocity(2, Vec3(0.1, 0.5, -0.2), Vec3(1, 2, 3));
  simulation.run(50);
  auto *pair = simulation.lammps()->force->pair;
  const auto *atom = simulation.lammps()->atom;
  const Vec3 offset = Vec3(atom->x[0]) - Vec3(atom->x[1]);
  double force;
  pair->single(0, 1, 1, 1, offset.squaredNorm(), 1.0, 1.0, force);
  const std::vector<double> one(pair->svector, pair->svector + pair->single_extra);
  const double energy = pair->single(1, 0, 1, 1, offset.squaredNorm(), 1.0, 1.0, force);
  EXPECT_NEAR(energy, one[11] + one[12] + one[13] + one[18], 1e-12);
  for (int k = 0; k < pair->single_extra; k++) {
    const bool vector = k < 3 || (k >= 14 && k <= 16);
    EXPECT_NEAR(pair->svector[k], vector ? -one[k] : one[k], 1e-12 * std::fabs(one[k])) << k;
  }
  EXPECT_GT(one[12], 0.0);
  EXPECT_GT(one[13], 0.0);
  EXPECT_NE(one[17], 0.0);    // a twist is the same from both sides
  EXPECT_GT(one[18], 0.0);
}

// A second set-up call changes no force, and the history that the compute sees stays to the bit.
TEST(SetUp, LeavesHistoryAndForcesAlone)
{
  for (const char *newton : {"on", "off"}) {
    Packing packing;
    Simulation simulation;
    simulation.open_box(packing.half(), 1, "p p p", newton);
    simulation.create(packing.spheres());
    simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -1 0.3 restitution 0.8 "
               "rolling sds 1e3 1 0.1\nfix integrate all nve/sphere\ntimestep 2e-4");
    simulation.watch_contacts();
    simulation.run(200);
    simulation("run 0 post no");
    const auto first = simulation.particles();
    const auto history = simulation.contacts();
    simulation("run 0 post no");
    const auto second = simulation.particles();
    const auto later = simulation.contacts();
    // the order of neighbours may change with the list: sums of forces to rounding
    EXPECT_LT(difference(first, second), 1e-13);
    ASSERT_EQ(history.size(), later.size());
    EXPECT_GT(history.size(), 400u);
    for (std::size_t k = 0; k < history.size(); k++)
      EXPECT_EQ(history[k].max_overlap(), later[k].max_overlap());
  }
}

// Without forces that depend on velocity a set-up call repeats the force of the last step, so
// that a run in two pieces is the run in one.
TEST(SetUp, InTheMiddleOfARunChangesNothingWithoutDashpots)
{
  for (const char *law : {"linear", "plateau", "linear exponent 1.5"}) {
    std::vector<Particle> end[2];
    for (int pieces = 1; pieces <= 2; pieces++) {
      Packing packing;
      Simulation simulation;
      simulation.open_box(packing.half(), 1, "p p p");
      simulation.create(packing.spheres());
      simulation(std::string("pair_style gran/eepa ") + law +
                 "\npair_coeff * * 1e4 2e4 5e3 -1 0.3 kt 3e3\nfix integrate all nve/sphere\n"
                 "timestep 2e-4");
      for (int k = 0; k < pieces; k++) simulation.run(200 / pieces);
      end[pieces - 1] = simulation.particles();
    }
    // 1e-9: rounding where an adhesive contact is on the adhesive branch and its reloading line at
    // once
    EXPECT_LT(difference(end[0], end[1]), 1e-9) << law;
  }
}

// Contacts keep their history through reneighbouring, exchange and sorting: a short skin that
// rebuilds at every step against a long one that never does.
TEST(Neighbours, RebuiltAtEveryStepOrNeverGiveTheSameMotion)
{
  std::vector<Particle> end[2];
  for (int which = 0; which < 2; which++) {
    Packing packing;
    Simulation simulation;
    simulation.open_box(packing.half(), 1, "p p p");
    simulation.create(packing.spheres());
    simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -1 0.3 restitution 0.8\n"
               "fix integrate all nve/sphere\ntimestep 2e-4");
    simulation(which ? "neighbor 0.05 bin\nneigh_modify every 1 delay 0 check no\n"
                       "atom_modify sort 10 0.9"
                     : "neighbor 0.4 bin");
    simulation.run(200);
    end[which] = simulation.particles();
  }
  EXPECT_LT(difference(end[0], end[1]), 1e-10);
}

}    // namespace
