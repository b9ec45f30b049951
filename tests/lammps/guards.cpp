// SPDX-License-Identifier: GPL-2.0-only

// Settings that the styles can not work with are refused by name. Held particles, several rigid
// bodies and announced particles give the right values.

#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

constexpr const char *law = "pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 0 0 0\n";

void start(Simulation &simulation, double distance = 1.5)
{
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(distance, 0, 0)}});
  simulation(std::string(law) + "fix integrate all nve/sphere\ntimestep 1e-5");
}

TEST(ForcesOnceAStep, OtherIntegratorsAndCommandsAreNamed)
{
  Simulation simulation;
  start(simulation);
  EXPECT_TRUE(refuses(simulation, "minimize 0 0 1 1", "gran/eepa can not be used with minimize: "));
  EXPECT_TRUE(
      refuses(simulation, "fix n all numdiff 1 1e-6\nrun 1",
              "gran/eepa can not be used with fix n numdiff, which calls the forces itself"));
  simulation(
      "unfix n\ncompute v all pressure NULL virial\ncompute b all born/matrix numdiff 1e-6 v");
  EXPECT_TRUE(refuses(simulation, "run 1",
                      "gran/eepa can not be used with compute b born/matrix, which calls"));
  simulation("uncompute b");
  EXPECT_TRUE(refuses(simulation, "run_style respa 2 4 pair 1\nrun 1",
                      "gran/eepa can not be used with run_style respa: it must be verlet"));
  EXPECT_EQ(simulation.thermo("step"), 0.0);
  simulation("run_style verlet");
  simulation.run(1);
}

TEST(ForcesOnceAStep, TheWallSaysItToo)
{
  Simulation simulation;
  start(simulation);
  simulation("pair_style zero 1.0\npair_coeff * *\n"
             "fix w all wall/gran/eepa linear coeff 1e4 2e4 0 0 0 wall xplane -2 NULL");
  EXPECT_TRUE(refuses(simulation, "minimize 0 0 1 1",
                      "fix w wall/gran/eepa can not be used with minimize: "));
  EXPECT_TRUE(refuses(simulation, "run_style respa 2 4\nrun 1",
                      "fix w wall/gran/eepa can not be used with run_style respa"));
}

/// What two runs of `lines` after the start write to the log.
std::string log_of(const std::string &lines)
{
  const ScratchFile log(".log");
  {
    Simulation simulation(MPI_COMM_WORLD, log.name());
    simulation.open_box(3.0);
    simulation.create({{Vec3(0, 0, 0)}, {Vec3(1.5, 0, 0)}});
    simulation(lines + "\ntimestep 1e-5\nrun 1 post no\nrun 1 post no");
  }
  return log.text();
}

int count(const std::string &text, const std::string &words)
{
  int found = 0;
  for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) found++;
  return found;
}

// Once, whatever the number of runs, walls and pair styles.
TEST(Advice, OnRotationIsGivenWhereFrictionCanNotTurn)
{
  const std::string wall =
      "\nfix w all wall/gran/eepa linear coeff 1e4 2e4 0 0 0.5 wall xplane -2 2";
  const std::string smooth = "pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 0 0 0";
  const std::string rough = "pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 0 0 0.5";
  const std::string advice = "never turns them, and friction with mu = 0.5";
  EXPECT_EQ(count(log_of(rough + wall + "\nfix i all nve"), advice), 1);
  EXPECT_EQ(count(log_of(rough + "\nfix i all nve/limit 0.1"), advice), 1);
  EXPECT_EQ(count(log_of(smooth + wall + "\nfix i all nve"), advice), 1);
  EXPECT_EQ(count(log_of(smooth + "\nfix i all nve"), advice), 0);
  EXPECT_EQ(count(log_of(rough + wall + "\nfix i all nve/sphere"), advice), 0);
}

TEST(Advice, OnHeatIsGivenWhereNoContactConductsIt)
{
  const std::string heat = "pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 0 0 0\n"
                           "fix i all nve/sphere\n"
                           "fix p all property/atom temperature heatflow ghost yes\n"
                           "fix h all heat/flow constant 1.0";
  EXPECT_EQ(count(log_of(heat), "fix h heat/flow: contacts of gran/eepa conduct no heat"), 1);
}

TEST(TiledCommunication, NeedsNewtonOff)
{
  Simulation on, off;
  start(on);
  EXPECT_TRUE(refuses(on, "comm_style tiled\nrun 1",
                      "pair_style gran/eepa: comm_style tiled needs newton off"));
  off.open_box(3.0, 1, "f f f", "off");
  off.create({{Vec3(0, 0, 0)}, {Vec3(0.99, 0, 0)}});
  off(std::string(law) + "fix integrate all nve/sphere\ntimestep 1e-5\ncomm_style tiled");
  off.run(1);
}

TEST(Units, WithAFactorBetweenForceAndAccelerationAreRefused)
{
  for (const std::string units : {"real", "metal", "electron"}) {
    const std::string box = "units " + units +
        "\natom_style sphere\nboundary f f f\ncomm_modify vel yes\n"
        "region box block 0 1 0 1 0 1\ncreate_box 1 box\n";
    const std::string allowed = ": units " + units + " is not allowed: it must be si, cgs, micro, ";
    Simulation pair, wall, compute;
    EXPECT_TRUE(refuses(pair, box + law + "run 0", "pair_style gran/eepa" + allowed));
    EXPECT_TRUE(refuses(wall,
                        box + "fix w all wall/gran/eepa linear coeff 1 1 0 0 0 wall zplane 0 NULL",
                        "fix w wall/gran/eepa" + allowed));
    EXPECT_TRUE(
        refuses(compute, box + "compute c all gran/eepa/dt", "compute gran/eepa/dt" + allowed));
  }
}

// One problem, with damping, friction and a platen, in five systems of units.
TEST(Units, OneProblemInAllUnitSystems)
{
  struct System {
    const char *name;
    double length, mass, time;    // in metres, kilograms, seconds
  };
  const System systems[] = {{"si", 1, 1, 1},
                            {"cgs", 1e-2, 1e-3, 1},
                            {"micro", 1e-6, 1e-15, 1e-6},
                            {"nano", 1e-9, 1e-21, 1e-9},
                            {"lj", 1, 1, 1}};
  std::vector<double> first;
  for (const System &u : systems) {
    const double stiffness = u.mass / (u.time * u.time), force = stiffness * u.length;
    const auto length = [&u](double x) {
      return exact(x / u.length);
    };
    const std::string coefficients = exact(5e3 / stiffness) + " " + exact(1e4 / stiffness) + " " +
        exact(5e3 / stiffness) + " " + exact(-1e-4 / force) + " 0.5 restitution 0.4";
    Simulation simulation;
    simulation(std::string("units ") + u.name +
               "\natom_style sphere\nboundary f f f\ncomm_modify vel yes\nregion box block 0 " +
               length(4e-3) + " 0 " + length(4e-3) + " 0 " + length(4e-3) +
               " units box\ncreate_box 1 box\ncreate_atoms 1 single " + length(2e-3) + " " +
               length(2e-3) + " " + length(0.5e-3) + " units box\ncreate_atoms 1 single " +
               length(2.2e-3) + " " + length(2e-3) + " " + length(1.46e-3) +
               " units box\nset group all diameter " + length(1e-3) + " density " +
               exact(2000 / (u.mass / std::pow(u.length, 3))) + "\nneighbor " + length(2e-4) +
               " bin\npair_style gran/eepa linear\npair_coeff * * " + coefficients +
               "\nfix floor all wall/gran/eepa linear coeff " + coefficients +
               " wall zplane 0 NULL\nfix top all wall/gran/eepa linear coeff " + coefficients +
               " wall zplane NULL " + length(1.97e-3) + " load " + exact(-1e-3 / force) + " mass " +
               exact(1e-5 / u.mass) +
               "\ncompute dt all gran/eepa/dt\nfix integrate all nve/sphere\ntimestep " +
               exact(1e-6 / u.time));
    simulation.run(3000);
    const Particle p = simulation.particle(2);
    std::vector<double> values = {p.x.x() * u.length,
                                  p.x.z() * u.length,
                                  p.v.x() * u.length / u.time,
                                  p.omega.y() / u.time,
                                  simulation.fix("top", 4) * u.length,
                                  simulation.fix("floor", 3) * force,
                                  simulation.compute("dt") * u.time};
    if (first.empty()) first = values;
    for (std::size_t k = 0; k < values.size(); k++)
      EXPECT_NEAR(values[k], first[k], 1e-8 * std::fabs(first[k])) << u.name << " " << k;
  }
}

// Beads of a floor that overlap by more than a radius do not stop a run and exert no force on each
// other.
TEST(HeldParticles, OfAFloorMayOverlap)
{
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(0.3, 0, 0)}, {Vec3(0, 0, 0.99)}});
  simulation(std::string(law) +
             "group floor id 1 2\ngroup free id 3\nfix freeze floor freeze\n"
             "fix integrate free nve/sphere\ntimestep 1e-5\ncompute census all gran/eepa/contacts");
  simulation.watch_contacts();
  simulation.run(1);
  EXPECT_EQ(simulation.compute_vector("census")[0], 1.0);
  EXPECT_NEAR(simulation.particle(3).f.z(), 100.0, 0.1);
  EXPECT_NEAR(simulation.thermo("pe"), 0.5 * 2e4 * 0.005 * 0.005, 1e-3);
}

// Free particles that overlap as deeply still stop the run.
TEST(HeldParticles, OthersAreNamedWithWhatToType)
{
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(0.3, 0, 0)}, {Vec3(2, 0, 0)}});
  simulation(std::string(law) +
             "group floor id 1\nfix freeze floor freeze\n"
             "fix integrate all nve/sphere\ntimestep 1e-5");
  EXPECT_TRUE(refuses(simulation, "run 1", "atoms 1 and 2|atoms 2 and 1"));
  EXPECT_TRUE(refuses(simulation, "run 1", "neigh_modify exclude"));
}

// Two bodies of two fixes collide head on: m* is that of the bodies, half of 2 m, and their beads,
// which overlap by more than a radius, do not count.
class TwoBodies : public testing::TestWithParam<const char *> {};
TEST_P(TwoBodies, OfTwoFixesBounceWithTheirMasses)
{
  const double e = 0.5;
  Simulation simulation;
  simulation.open_box(5.0);
  simulation.create({{Vec3(-1.4, 0, 0), Vec3(1, 0, 0)},
                     {Vec3(-1.0, 0, 0), Vec3(1, 0, 0)},
                     {Vec3(0.2, 0, 0), Vec3(-1, 0, 0)},
                     {Vec3(0.6, 0, 0), Vec3(-1, 0, 0)}});
  simulation("compute_modify thermo_temp extra/dof -20");    // two bodies have too few for it
  simulation(std::string("pair_style gran/eepa linear\n"
                         "pair_coeff * * 1e4 1e4 0 0 0 restitution 0.5\n"
                         "group left id 1 2\ngroup right id 3 4\n") +
             "variable part atom (id>2)+1\nfix body all property/atom i_body\n"
             "set group left i_body 1\nset group right i_body 2\n" +
             "fix a left " + GetParam() + "\nfix b right " + GetParam() + "\ntimestep 1e-5");
  simulation.run(20000);
  EXPECT_NEAR(simulation.particle(1).v.x(), -e, 2e-3);
  EXPECT_NEAR(simulation.particle(4).v.x(), e, 2e-3);
}
INSTANTIATE_TEST_SUITE_P(ParallelFixes, TwoBodies,
                         testing::Values("rigid single", "rigid/nve custom i_body",
                                         "rigid/small custom i_body"));

// The bound of announced particles is that of the same particles after insertion.
TEST(Announced, ParticlesHaveTheBoundThatTheyWillHave)
{
  const std::string style = "pair_style gran/eepa linear scale 1.0\npair_coeff * * 1e4 2e4 0 0 0\n"
                            "fix w all wall/gran/eepa linear scale 1.0 coeff 1e4 9e4 0 0 0 wall "
                            "zplane -3 NULL\nfix integrate all nve/sphere\ntimestep 1e-5\n";
  Simulation empty, filled;
  empty.open_box(3.0);
  empty(style +
        "compute plain all gran/eepa/dt\n"
        "compute dt all gran/eepa/dt particles 1 0.8 0.8 2 particles 1 1.5 1.5 2");
  empty.run(0);
  filled.open_box(3.0);
  filled.create({{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0), 0.4, 2.0},
                 {Vec3(2, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0), 0.75, 2.0}});
  filled(style + "compute dt all gran/eepa/dt");
  filled.run(0);
  EXPECT_TRUE(std::isinf(empty.compute("plain")));
  EXPECT_DOUBLE_EQ(empty.compute("dt"), filled.compute("dt"));
}

// The time step is checked for particles that are inserted in mid-run when they appear.
TEST(Announced, NewParticlesAreCheckedWhenTheyAppear)
{
  for (const std::string owner : {"pair_style gran/eepa", "fix w wall/gran/eepa"}) {
    const bool pair = owner[0] == 'p';
    Simulation simulation;
    simulation.open_box(3.0);
    simulation(std::string("pair_style gran/eepa linear dtcheck ") + (pair ? "error" : "off") +
               "\npair_coeff * * 1e4 2e4 0 0 0\nfix w all wall/gran/eepa linear dtcheck " +
               (pair ? "off" : "error") +
               " coeff 1e4 2e4 0 0 0 wall zplane -3 NULL\nfix integrate all nve/sphere\n"
               "timestep 1\nregion in block -2 2 -2 2 -2 2\n"
               "fix pour all deposit 3 1 5 12345 region in near 1.1");
    EXPECT_TRUE(refuses(simulation, "run 20", owner + ": timestep 1 is larger than"));
  }
}

}    // namespace
