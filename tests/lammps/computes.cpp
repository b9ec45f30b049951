// SPDX-License-Identifier: GPL-2.0-only

// compute gran/eepa/contacts and gran/eepa/dt, the time-step check, pressure and energy.

#include "packing.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace eepa_test;

namespace {

class ContactsByHand : public testing::TestWithParam<const char *> {};

// Against counting the rows of compute pair/local, for all particles and for a group, with newton
// on and off (where two ranks or images could count a contact twice).
TEST_P(ContactsByHand, AgreeWithTheCompute)
{
  Packing packing;
  packing.polydisperse = true;
  packing.types = 2;
  Simulation simulation;
  simulation.open_box(packing.half(), 2, "p p p", GetParam());
  simulation.create(packing.spheres());
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -1 0.3 restitution 0.8\n"
             "fix integrate all nve/sphere\ntimestep 2e-4\ngroup odd type 1\n"
             "compute all all gran/eepa/contacts\ncompute odd odd gran/eepa/contacts");
  simulation.watch_contacts();
  simulation.run(250);

  const auto particles = simulation.particles();
  for (const bool group : {false, true}) {
    double expected[8] = {};
    double members = 0.0, ends = 0.0;
    for (const auto &p : particles) members += !group || p.type == 1;
    for (const auto &contact : simulation.contacts()) {
      const auto &i = particles[contact.i - 1], &j = particles[contact.j - 1];
      const double inside = group ? (i.type == 1) + (j.type == 1) : 2.0;
      if (inside == 0.0) continue;
      const double ratio = contact.overlap() / (i.radius + j.radius);
      expected[0] += 1.0;
      expected[static_cast<int>(contact.branch())] += 1.0;
      expected[4] += contact.slip();
      ends += inside;
      expected[6] = std::max(expected[6], ratio);
      expected[7] += ratio;
    }
    expected[5] = ends / members;
    expected[7] /= expected[0];
    const auto counted = simulation.compute_vector(group ? "odd" : "all");
    ASSERT_EQ(counted.size(), 9u);
    EXPECT_EQ(counted[8], 0.0);    // there are no walls
    for (int k = 0; k < 5; k++)
      EXPECT_EQ(counted[k], expected[k]) << k << (group ? " odd" : " all");
    for (int k = 5; k < 8; k++) EXPECT_NEAR(counted[k], expected[k], 1e-12) << k;
    for (int k = 0; k < 5; k++) EXPECT_GT(counted[k], 0.0) << k;    // every kind occurs
  }
}
INSTANTIATE_TEST_SUITE_P(Newton, ContactsByHand, testing::Values("on", "off"));

// Steps that tally the energy evaluate one contact after the other, other steps several side by
// side. Both record the branch and whether a contact slides: tested in alternation, and all at
// once.
TEST(Contacts, AreTheSameWhetherAStepTalliesOrNot)
{
  constexpr int samples = 6, every = 40;
  const auto counts = [](const std::string &output, const std::string &more_coefficients) {
    Packing packing;
    packing.polydisperse = true;
    packing.types = 2;
    Simulation simulation;
    simulation.open_box(packing.half(), 2, "p p p");
    simulation.create(packing.spheres());
    simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -1 0.3 restitution 0.8\n" +
               more_coefficients +
               "fix integrate all nve/sphere\ntimestep 2e-4\n"
               "compute all all gran/eepa/contacts\nthermo_style custom step pe\n" +
               output);
    const auto counted = [](int k) { return "counted" + std::to_string(k); };
    for (int k = 1; k <= 5; k++)
      simulation("fix " + counted(k) + " all vector " + std::to_string(every) + " c_all[" +
                 std::to_string(k) + "]");
    simulation.run(samples * every + 1);
    std::vector<double> found;
    for (int sample = 2; sample <= samples + 1; sample++)    // the first is of step 0
      for (int k = 1; k <= 5; k++)
        found.push_back(simulation.fix(counted(k), sample));
    return found;
  };
  for (const std::string more : {"", "pair_coeff 1 2 1.5e4 3e4 5e3 -1 0.2 restitution 0.8\n"}) {
    const auto tallied = counts("thermo " + std::to_string(every), more);
    const auto plain = counts("thermo 0", more);
    EXPECT_EQ(tallied, plain) << more;
    std::array<double, 5> sums{};
    for (std::size_t k = 0; k < plain.size(); k++) sums[k % sums.size()] += plain[k];
    EXPECT_GT(sums[0] / samples, 32.0);    // enough contacts to be evaluated side by side
    for (int k = 1; k < 5; k++) EXPECT_GT(sums[k] / samples, 2.0) << k << more;
  }
}

TEST(Contacts, AreNoneWithoutParticles)
{
  Simulation simulation;
  simulation.open_box(2.0);
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 0 0 0\n"
             "compute n all gran/eepa/contacts\ncompute dt all gran/eepa/dt\ntimestep 1e-4");
  simulation.run(1);
  for (const double value : simulation.compute_vector("n")) EXPECT_EQ(value, 0.0);
  EXPECT_TRUE(std::isinf(simulation.compute("dt")));
}

// 0.2 sqrt(m_min/k_max): the lighter partner's mass and the contact's stiffness after scaling.
TEST(TimeStep, IsTheBoundOfTheContract)
{
  Simulation simulation;
  simulation.open_box(4.0, 2);
  const Sphere light{Vec3(0, 0, 0), Vec3::Zero(), Vec3::Zero(), 0.25};
  const Sphere heavy{Vec3(2, 0, 0), Vec3::Zero(), Vec3::Zero(), 0.5, unit_density, 2};
  simulation.create({light, heavy});
  simulation("pair_style gran/eepa linear\npair_coeff 1 1 1e3 2e3 5e3 0 0\n"
             "pair_coeff 1 2 1e4 4e4 1e3 0 0\npair_coeff 2 2 1e4 1e4 0 0 0\n"
             "compute dt all gran/eepa/dt\nfix integrate all nve/sphere\ntimestep 1e-5");
  simulation.run(0);
  EXPECT_NEAR(simulation.compute("dt"), 0.2 * std::sqrt(mass_of(light) / 4e4), 1e-15);
  // with scale 0.3 the contact of 1 and 2 has d = 0.75: k 2.5 times
  simulation("pair_style gran/eepa linear scale 0.3\npair_coeff 1 1 1e3 2e3 5e3 0 0\n"
             "pair_coeff 1 2 1e4 4e4 1e3 0 0\npair_coeff 2 2 1e4 1e4 0 0 0");
  simulation.run(0);
  EXPECT_NEAR(simulation.compute("dt"), 0.2 * std::sqrt(mass_of(light) / 1e5), 1e-15);
  // k_adh counts too, and kt 7/2 times, because it also turns a solid sphere
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e3 2e3 6e4 0 0");
  simulation.run(0);
  EXPECT_NEAR(simulation.compute("dt"), 0.2 * std::sqrt(mass_of(light) / 6e4), 1e-15);
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e3 2e3 0 0 0 kt 7e4");
  simulation.run(0);
  EXPECT_NEAR(simulation.compute("dt"), 0.2 * std::sqrt(mass_of(light) / (3.5 * 7e4)), 1e-15);
  // and a stiffer wall
  simulation("fix wall all wall/gran/eepa linear coeff 1e4 1e6 0 0 0 wall zplane -2 NULL");
  simulation.run(0);
  EXPECT_NEAR(simulation.compute("dt"), 0.2 * std::sqrt(mass_of(light) / 1e6), 1e-15);
}

TEST(TimeStep, CountsTheRollingSpringFiveHalvesFold)
{
  Simulation simulation;
  simulation.open_box(4.0);
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(2, 0, 0)}});
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e3 2e3 0 0 0 rolling sds 8e4 0 0.1\n"
             "compute dt all gran/eepa/dt\nfix integrate all nve/sphere\ntimestep 1e-5\n"
             "run 0 post no");
  EXPECT_NEAR(simulation.compute("dt"), 0.2 * std::sqrt(1.0 / (2.5 * 8e4)), 1e-15);
}

class TimeStepCheck : public testing::Test {
 protected:
  const ScratchFile log{".log"};
  Simulation simulation{MPI_COMM_WORLD, log.name()};

  void open(const std::string &check)
  {
    simulation.open_box(4.0, 2);
    simulation.create(
        {{Vec3(0, 0, 0)}, {Vec3(2, 0, 0), Vec3::Zero(), Vec3::Zero(), 0.5, unit_density, 2}});
    simulation("pair_style gran/eepa linear" + check +
               "\npair_coeff 1 1 1e4 1e4 0 0 0\npair_coeff 1 2 1e4 4e4 0 0 0\n"
               "pair_coeff 2 2 1e4 1e4 0 0 0\nfix integrate all nve/sphere\ntimestep 1.01e-3");
  }
};

// the limit is 0.2 sqrt(1/4e4) = 1e-3
TEST_F(TimeStepCheck, WarnsByDefaultAndNamesLimitAndPair)
{
  open("");
  simulation("run 0 post no");
  EXPECT_NE(
      log.text().find("WARNING: pair_style gran/eepa: timestep 0.00101 is larger than 0.001 = "
                      "0.2 sqrt(m_min/k_max), which the pair of types 1 2 sets"),
      std::string::npos);
}
TEST_F(TimeStepCheck, StopsWhenAsked)
{
  open(" dtcheck error");
  EXPECT_TRUE(refuses(simulation, "run 0 post no",
                      "ERROR: pair_style gran/eepa: timestep 0.00101 is larger than 0.001 = 0.2 "
                      "sqrt\\(m_min/k_max\\), which the pair of types 1 2 sets"));
}
TEST_F(TimeStepCheck, IsSilentWhenOff)
{
  open(" dtcheck off");
  simulation("run 0 post no");
  EXPECT_EQ(log.text().find("WARNING"), std::string::npos);
}
TEST_F(TimeStepCheck, IsSilentBelowTheLimit)
{
  open(" dtcheck error");
  simulation("timestep 0.99e-3\nrun 0 post no");
  EXPECT_EQ(log.text().find("WARNING"), std::string::npos);
}
TEST_F(TimeStepCheck, IsMadeByWallsToo)
{
  open(" dtcheck off");
  simulation(
      "fix w all wall/gran/eepa linear coeff 1e4 4e4 0 0 0 wall zplane -2 NULL\nrun 0 post no");
  EXPECT_NE(log.text().find("fix w wall/gran/eepa: timestep 0.00101 is larger than 0.001"),
            std::string::npos);
  simulation(
      "unfix w\nfix w all wall/gran/eepa linear dtcheck error coeff 1e4 4e4 0 0 0 wall zplane "
      "-2 NULL");
  EXPECT_TRUE(
      refuses(simulation, "run 0 post no", "ERROR: fix w wall/gran/eepa: timestep 0.00101"));
}
TEST_F(TimeStepCheck, PlateauThatUnloadsLateIsToldOnce)
{
  open(" dtcheck off");
  simulation("timestep 1e-5\npair_style gran/eepa plateau\npair_coeff * * 1e4 3e4 0 0 0\n"
             "run 0 post no\nrun 0 post no");
  const std::string text = log.text(), warning = "plateau with k2 = 30000 > 2 k1 = 20000";
  const auto at = text.find(warning);
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(text.find(warning, at + 1), std::string::npos);
}

// A compressed static pair: the stress is f r/V along the line of centres, nothing across.
TEST(Virial, IsForceTimesDistanceOverVolume)
{
  for (const char *newton : {"on", "off"}) {
    Simulation simulation;
    simulation.open_box(2.0, 1, "p p p", newton);
    // across the periodic boundary
    simulation.create({{Vec3(1.7, 0.1, 0)}, {Vec3(-1.7 + 0.36, 0.1, 0)}});
    simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 0 -3 0.5\n"
               "fix integrate all nve/sphere\ntimestep 1e-5\n"
               "compute stress all pressure NULL virial\nthermo_style custom step pxx\nthermo 1");
    simulation("run 0 post no");
    const double distance = 2 * (2.0 - 1.7) + 0.36, overlap = 1.0 - distance;
    const double force = 1e4 * overlap - 3.0;
    const double stress = force * distance / 64.0;
    EXPECT_NEAR(simulation.compute("stress"), stress / 3.0, 1e-12 * stress);
    const auto tensor = simulation.compute_vector("stress");
    EXPECT_NEAR(tensor[0], stress, 1e-12 * stress);
    for (int k = 1; k < 6; k++) EXPECT_NEAR(tensor[k], 0.0, 1e-12 * stress);
  }
}

// With friction: the tangential force's part, r_x f_y, counts too. The tensor is symmetric in
// LAMMPS, so that only xy with x from the first index is seen.
TEST(Virial, HasTheTangentialForce)
{
  Simulation simulation;
  simulation.open_box(2.0, 1, "p p p");
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(0.99, 0, 0), Vec3(0, 1, 0)}});
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 0 0 0.5\n"
             "fix integrate all nve/sphere\ntimestep 1e-5\n"
             "compute stress all pressure NULL virial\nthermo_style custom step pxx\nthermo 50");
  simulation.run(50);
  const auto p = simulation.particles();
  const Vec3 r = p[0].x - p[1].x;
  const auto tensor = simulation.compute_vector("stress");
  EXPECT_GT(std::fabs(p[0].f.y()), 0.1);
  EXPECT_NEAR(tensor[0], r.x() * p[0].f.x() / 64.0, 1e-12);
  EXPECT_NEAR(tensor[3], r.x() * p[0].f.y() / 64.0, 1e-12);
}

// pe is the recoverable energy: an elastic collision keeps ke + pe. 1e-5: (omega dt)^2/8 of
// velocity Verlet at 2e-6 against a half period of 2e-2 is 1e-8, and the tangential spring is
// wound by half-step velocities, one step late.
class ElasticCollision : public testing::TestWithParam<const char *> {};

TEST_P(ElasticCollision, KeepsKineticPlusPotentialEnergy)
{
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create(
      {{Vec3(-0.51, 0, 0), Vec3(1, 0.3, 0), Vec3(0, 0, 1)}, {Vec3(0.51, 0, 0), Vec3(-1, -0.2, 0)}});
  simulation(std::string("pair_style gran/eepa ") + GetParam() +
             "\nfix integrate all nve/sphere\ntimestep 2e-6\n"
             "thermo_style custom step pe\nthermo 500\nthermo_modify norm no");
  simulation.run(500);
  const auto energy = [&] {
    double sum = simulation.thermo("pe");
    for (const auto &p : simulation.particles()) sum += p.kinetic_energy();
    return sum;
  };
  const double before = energy();
  const bool friction = std::string(GetParam()).find("1e9") != std::string::npos;
  double stored = 0.0;
  for (int k = 0; k < 40; k++) {
    simulation.run(500);
    stored = std::max(stored, simulation.thermo("pe"));
    // energy of a tangential spring when the contact opens is lost, by contract
    if (simulation.thermo("pe") == 0.0 && stored > 0.0 && friction) continue;
    EXPECT_NEAR(energy(), before, 1e-5 * before);
  }
  EXPECT_GT(stored, 0.3 * before);
  EXPECT_EQ(simulation.thermo("pe"), 0.0);    // the contact is over
}
INSTANTIATE_TEST_SUITE_P(Springs, ElasticCollision,
                         testing::Values("linear\npair_coeff * * 1e4 1e4 0 0 0",
                                         "linear\npair_coeff * * 1e4 1e4 0 0 1e9 kt 1e3",
                                         "linear exponent 1.5\npair_coeff * * 1e5 1e5 0 0 0 kt 0"));

// On the k2 line energy is k2 (delta - delta_p)^2/2 + f0 delta, from the contract's law.
TEST(PotentialEnergy, IsTheRecoverableOneOfTheUnloadingLine)
{
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(1.0, 0, 0)}});
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 4e4 0 -2 0\ntimestep 1e-5\n"
             "group second id 2\nthermo_style custom step pe\nthermo 1000\nthermo_modify norm no\n"
             "fix carry second move linear -2 0 0");
  simulation.watch_contacts();
  simulation.run(1000);
  simulation("unfix carry\nfix carry second move linear 0.3 0 0");
  simulation.run(1000);
  const PairContact c = simulation.contacts().at(0);
  EXPECT_EQ(c.branch(), 2.0);
  const double expected = 0.5 * 4e4 * std::pow(0.017 - 0.015, 2) - 2.0 * 0.017;
  EXPECT_NEAR(simulation.thermo("pe"), expected, 1e-9);
  EXPECT_NEAR(c.energy, expected, 1e-9);
}

}    // namespace
