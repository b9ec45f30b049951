// SPDX-License-Identifier: GPL-2.0-only

// Features of LAMMPS combined with the pair style: newton, types and mixing, exclusions, frozen and
// rigid particles, hybrid.

#include "packing.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eepa_test;

namespace {

constexpr const char *cohesive = "pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -1 0.5 "
                                 "restitution 0.8 rolling sds 1e3 "
                                 "1 0.1";

std::vector<Particle> run_packing(const Packing &packing, const std::string &pair, int steps,
                                  const std::string &newton = "on")
{
  Simulation simulation;
  simulation.open_box(packing.half(), packing.types, "p p p", newton);
  simulation.create(packing.spheres());
  simulation(pair + "\nfix integrate all nve/sphere\ntimestep 2e-4");
  simulation.run(steps);
  return simulation.particles();
}

TEST(Newton, OnAndOffGiveTheSameMotion)
{
  Packing packing;
  packing.polydisperse = true;
  EXPECT_LT(difference(run_packing(packing, cohesive, 300, "on"),
                       run_packing(packing, cohesive, 300, "off")),
            1e-10);
}

// Two types whose cross coefficients are mixed, against explicit coefficients by the documented
// rules: stiffnesses and dashpots in series, f0, mu, mu_r and e geometrically.
double series(double a, double b)
{
  return 2.0 * a * b / (a + b);
}

TEST(Mixing, IsTheDocumentedOne)
{
  Packing packing;
  packing.types = 2;
  const std::string own = "pair_style gran/eepa linear\n"
                          "pair_coeff 1 1 1e4 2e4 5e3 -1 0.5 restitution 0.9 rolling constant 0.1\n"
                          "pair_coeff 2 2 3e4 8e4 9e3 -4 0.2 kt 5e3 restitution 0.4 rolling "
                          "constant 0.4\n";
  const std::string cross = "pair_coeff 1 2 " + exact(series(1e4, 3e4)) + " " +
      exact(series(2e4, 8e4)) + " " + exact(series(5e3, 9e3)) + " -2 " + exact(std::sqrt(0.1)) +
      " kt " + exact(series(2.0 / 7.0 * 1e4, 5e3)) + " restitution 0.6 rolling constant 0.2";
  const auto mixed = run_packing(packing, own, 300);
  EXPECT_LT(difference(mixed, run_packing(packing, own + cross, 300)), 1e-10);
  // the result differs from that of either type alone
  EXPECT_GT(difference(mixed, run_packing(packing, own + "pair_coeff 1 2 1e4 2e4 5e3 -1 0.5", 300)),
            1e-3);
}

TEST(Mixing, OfViscousDampingIsInSeries)
{
  Packing packing;
  packing.types = 2;
  const std::string own = "pair_style gran/eepa plateau\n"
                          "pair_coeff 1 1 1e4 2e4 5e3 0 0.5 viscous 2 1\n"
                          "pair_coeff 2 2 1e4 2e4 5e3 0 0.5 viscous 6 4\n";
  EXPECT_LT(difference(run_packing(packing, own, 200),
                       run_packing(packing,
                                   own + "pair_coeff 1 2 1e4 2e4 5e3 0 0.5 kt " +
                                       exact(2.0 / 7.0 * 1e4) + " viscous 3 1.6",
                                   200)),
            1e-10);
}

TEST(PairCoeff, WithAWildcardIsThatOfEachPair)
{
  Packing packing;
  packing.types = 3;
  std::string each = "pair_style gran/eepa linear";
  for (const char *pair : {"1 1", "1 2", "1 3", "2 2", "2 3", "3 3"})
    each += std::string("\npair_coeff ") + pair + " 1e4 2e4 5e3 -1 0.5";
  const std::string all = "pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -1 0.5";
  EXPECT_EQ(difference(run_packing(packing, each, 100), run_packing(packing, all, 100)), 0.0);
}

TEST(Exclusion, LetsParticlesPassThroughEachOther)
{
  Simulation simulation;
  simulation.open_box(3.0, 2);
  simulation.create({{Vec3(-0.6, 0, 0), Vec3(1, 0, 0)},
                     {Vec3(0.6, 0, 0), Vec3(-1, 0, 0), Vec3::Zero(), 0.5, unit_density, 2}});
  simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 0 0 0.5\n"
             "neigh_modify exclude type 1 2\nfix integrate all nve/sphere\ntimestep 1e-3");
  simulation.run(1500);
  EXPECT_EQ(simulation.particle(1).v.x(), 1.0);
  EXPECT_NEAR(simulation.particle(1).x.x(), 0.9, 1e-12);
}

// rerun does without part of the set-up of a run.
TEST(Rerun, HasTheForcesOfVirginContacts)
{
  const ScratchFile dump(".dump"), log(".log");
  Packing packing;
  packing.types = 2;
  const auto open = [&](Simulation &simulation) {
    simulation.open_box(packing.half(), 2);
    simulation.create(packing.spheres());
    simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 -1 0.5\n"
               "pair_coeff 1 2 2e4 2e4 0 -2 0.5");
  };
  Simulation set_up, again(MPI_COMM_WORLD, log.name());
  open(set_up);
  set_up("run 0 post no\nwrite_dump all custom " + dump.name() +
         " id x y z modify format float %.17g");
  open(again);
  again("rerun " + dump.name() + " dump x y z");
  double largest = 0.0;
  for (int id = 1; id <= 216; id++) {
    EXPECT_NEAR((set_up.particle(id).f - again.particle(id).f).norm(), 0.0, 1e-9) << id;
    largest = std::max(largest, again.particle(id).f.norm());
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(largest, 10.0);
  again("log none");
  EXPECT_NE(log.text().find("rerun takes every contact for a new one"), std::string::npos);
}

// m* against a frozen partner is the mass of the moving particle: only then does the dashpot give
// e.
TEST(Freeze, EffectiveMassIsTheMovingPartners)
{
  for (const char *newton : {"on", "off"}) {
    Simulation simulation;
    simulation.open_box(3.0, 1, "f f f", newton);
    simulation.create({{Vec3(0, 0, 0)}, {Vec3(1 + 1e-9, 0, 0), Vec3(-1, 0, 0)}});
    simulation("pair_style gran/eepa linear\npair_coeff 1 1 1e4 1e4 0 0 0 restitution 0.5\n"
               "group still id 1\nfix freeze still freeze\nfix integrate all nve/sphere\n"
               "timestep 1e-6");
    simulation.run(50000);
    EXPECT_NEAR(simulation.particle(2).v.x(), 0.5, 1e-3);
    EXPECT_EQ(simulation.particle(1).v.norm(), 0.0);
  }
}

// compute pair/local, too, takes the mass of the moving particle.
TEST(Freeze, SingleHasTheForceOfTheRun)
{
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(0.98, 0, 0), Vec3(-1, 0, 0)}});
  simulation("pair_style gran/eepa linear\npair_coeff 1 1 1e4 1e4 0 0 0 restitution 0.5\n"
             "group still id 1\nfix freeze still freeze\nfix integrate all nve/sphere\n"
             "timestep 1e-6");
  simulation.watch_contacts();
  simulation("run 0 post no");
  const double force = simulation.particle(2).f.x();
  EXPECT_GT(force, 1e4 * 0.02 + 1.0);    // the dashpot
  EXPECT_NEAR(simulation.contacts().at(0).normal_force, force, 1e-9);
}

// A rigid dumbbell of mass 2 hits a sphere of mass 1 along its axis: m* = 2/3, and the final
// relative velocity is e times the initial one.
TEST(Rigid, EffectiveMassIsTheBodys)
{
  for (const char *newton : {"on", "off"}) {
    Simulation simulation;
    simulation.open_box(4.0, 1, "f f f", newton);
    simulation.create({{Vec3(-2.1, 0, 0), Vec3(1, 0, 0)},
                       {Vec3(-1 - 1e-9, 0, 0), Vec3(1, 0, 0)},
                       {Vec3(0, 0, 0), Vec3(0, 0, 0)}});
    simulation("pair_style gran/eepa linear\npair_coeff 1 1 1e4 1e4 0 0 0 restitution 0.5\n"
               "group body id 1 2\ngroup free id 3\nfix body body rigid single\n"
               "fix integrate free nve/sphere\ntimestep 1e-6");
    simulation.run(50000);
    const auto p = simulation.particles();
    EXPECT_NEAR(p[2].v.x() - p[1].v.x(), 0.5, 1e-3);
    EXPECT_NEAR(2.0 * p[1].v.x() + p[2].v.x(), 2.0, 1e-9);    // momentum
  }
}

TEST(Rigid, EffectiveMassIsTheBodysAtAWall)
{
  Simulation simulation;
  simulation.open_box(4.0);
  simulation.create({{Vec3(0, 0, 1.7), Vec3(0, 0, -1)},
                     {Vec3(0, 0, 0.5 + 1e-9), Vec3(0, 0, -1)},
                     {Vec3(3, 3, 3)}});
  simulation("pair_style zero 1.0\npair_coeff * *\ngroup body id 1 2\ngroup free id 3\n"
             "fix body body rigid single\nfix integrate free nve/sphere\ntimestep 1e-6\n"
             "fix wall all wall/gran/eepa linear coeff 1e4 1e4 0 0 0 restitution 0.5 wall zplane 0 "
             "NULL");
  simulation.run(60000);
  EXPECT_NEAR(simulation.particle(2).v.z(), 0.5, 1e-3);
}

// The time step is checked against the mass of the body, 2, at the start of each run: its
// particles alone would allow 1e-3.
TEST(Rigid, TimeStepIsCheckedAgainstTheBody)
{
  Simulation simulation;
  simulation.open_box(4.0);
  Sphere heavy = {Vec3(0, 2, 0)};
  heavy.density = 4.0 * unit_density;
  simulation.create({{Vec3(-0.55, 0, 0)}, {Vec3(0.55, 0, 0)}, heavy});
  simulation("pair_style gran/eepa linear dtcheck error\npair_coeff 1 1 1e4 4e4 0 0 0\n"
             "group body id 1 2\nfix body body rigid single\n"
             "fix wall all wall/gran/eepa linear dtcheck error coeff 1e4 4e4 0 0 0 wall zplane -3 "
             "NULL\ntimestep 1.3e-3");
  simulation.run(1);
  simulation.run(1);
  EXPECT_TRUE(refuses(simulation, "timestep 1.5e-3\nrun 1", "is larger than 0.00141421"));
}

TEST(Hybrid, IsTheSameAsAlone)
{
  Packing packing;
  const auto alone = run_packing(packing, cohesive, 200);
  const std::string coefficients = " 1e4 2e4 5e3 -1 0.5 restitution 0.8 rolling sds 1e3 1 0.1";
  EXPECT_LT(difference(alone,
                       run_packing(packing,
                                   "pair_style hybrid gran/eepa linear\npair_coeff * * gran/eepa" +
                                       coefficients,
                                   200)),
            1e-12);
  EXPECT_LT(difference(alone,
                       run_packing(packing,
                                   "pair_style hybrid/overlay gran/eepa linear zero 1.0\n"
                                   "pair_coeff * * gran/eepa" +
                                       coefficients + "\npair_coeff * * zero",
                                   200)),
            1e-12);
}

// Two laws in one run, each for its own types, against one run for each law.
TEST(Hybrid, TakesBothLawsAtOnce)
{
  const auto pair = [](double x, int type) {
    return std::vector<Sphere>{
        {Vec3(x, -0.55, 0), Vec3(0, 1, 0), Vec3::Zero(), 0.5, unit_density, type},
        {Vec3(x, 0.55, 0), Vec3(0, -1, 0), Vec3::Zero(), 0.5, unit_density, type}};
  };
  auto run = [&](const std::string &style, const std::vector<Sphere> &spheres, int id) {
    Simulation simulation;
    simulation.open_box(4.0, 2);
    simulation.create(spheres);
    simulation(style +
               "\nfix integrate all nve/sphere\ntimestep 1e-4\ncompute n all "
               "gran/eepa/contacts\ncompute dt all gran/eepa/dt");
    simulation.run(680);    // they unload
    EXPECT_EQ(simulation.compute_vector("n")[0], 0.5 * static_cast<double>(spheres.size()));
    EXPECT_GT(simulation.compute("dt"), 0.0);
    return simulation.particle(id).f.y();
  };
  auto both = pair(-1.0, 1);
  for (const auto &sphere : pair(1.0, 2)) both.push_back(sphere);
  const std::string hybrid = "pair_style hybrid gran/eepa linear gran/eepa plateau\n"
                             "pair_coeff 1 1 gran/eepa 1 1e4 3e4 5e3 -1 0\n"
                             "pair_coeff 1 2 gran/eepa 1 1e4 3e4 5e3 -1 0\n"
                             "pair_coeff 2 2 gran/eepa 2 1e4 3e4 5e3 -1 0";
  const double linear =
      run("pair_style gran/eepa linear\npair_coeff * * 1e4 3e4 5e3 -1 0", pair(-1.0, 1), 1);
  const double plateau =
      run("pair_style gran/eepa plateau\npair_coeff * * 1e4 3e4 5e3 -1 0", pair(1.0, 2), 1);
  EXPECT_GT(std::fabs(linear - plateau), 1.0);
  EXPECT_NEAR(run(hybrid, both, 1), linear, 1e-9);
  EXPECT_NEAR(run(hybrid, both, 3), plateau, 1e-9);
}

// The stiffness depends on the types, not on the IDs or on the order in the neighbour list.
TEST(Types, EachPairHasItsOwnCoefficients)
{
  Simulation simulation;
  simulation.open_box(4.0, 2);
  simulation.create({{Vec3(-2, 0, 0)},
                     {Vec3(-1.01, 0, 0), Vec3::Zero(), Vec3::Zero(), 0.5, unit_density, 2},
                     {Vec3(0, 1, 0), Vec3::Zero(), Vec3::Zero(), 0.5, unit_density, 2},
                     {Vec3(0.99, 1, 0), Vec3::Zero(), Vec3::Zero(), 0.5, unit_density, 2},
                     {Vec3(2.5, 0, 0)},
                     {Vec3(2.5, 0.99, 0)}});
  simulation("pair_style gran/eepa linear\npair_coeff 1 1 1e4 1e4 0 0 0\n"
             "pair_coeff 1 2 2e4 2e4 0 -3 0\npair_coeff 2 2 4e4 4e4 0 0 0\n"
             "fix integrate all nve/sphere\ntimestep 1e-4");
  simulation.run(0);
  const auto p = simulation.particles();
  EXPECT_NEAR(p[0].f.x(), -(2e4 * 0.01 - 3.0), 1e-8);
  EXPECT_NEAR(p[1].f.x(), 2e4 * 0.01 - 3.0, 1e-8);
  EXPECT_NEAR(p[2].f.x(), -4e4 * 0.01, 1e-8);
  EXPECT_NEAR(p[4].f.y(), -1e4 * 0.01, 1e-8);
}

/// Runs a packing of particles of one type and of five.
/// \param line  the coefficients of a type, by its number; 0 is the only one of one type
/// \return how far apart particles are after it
template <class Line> double difference_of_types(const Line &line, const std::string &newton)
{
  Packing packing;
  packing.types = 5;
  packing.side = 7;
  packing.polydisperse = true;
  const std::string style = "pair_style gran/eepa linear\n";
  std::string many = style;
  for (int type = 1; type <= packing.types; type++)
    many += "pair_coeff " + std::to_string(type) + " " + std::to_string(type) + line(type) + "\n";
  return difference(run_packing(packing, style + "pair_coeff * *" + line(0), 100, newton),
                    run_packing(packing, many, 100, newton));
}

// Five types whose frictions differ in the twelfth digit have fifteen sets of coefficients. The
// particles move as those of one type.
TEST(Types, ManyTypesMoveAsOneOfNearlyTheSameCoefficients)
{
  const auto line = [](int type) {
    return " 1e4 2e4 5e3 -1 " + exact(0.5 + 1e-12 * type) + " restitution 0.8 rolling constant 0.1";
  };
  for (const char *newton : {"on", "off"}) {
    EXPECT_LT(difference_of_types(line, newton), 1e-8) << newton;
    EXPECT_GT(difference_of_types(line, newton), 0.0) << "the types had the same coefficients";
  }
}

// Types do not change the order in which forces are added. Friction that no contact reaches makes
// the coefficients different and the forces the same: not one bit differs.
TEST(Types, ManyTypesHaveTheBitsOfOneWhereTheirForcesAreTheSame)
{
  const auto line = [](int type) {
    return " 1e4 1e4 0 0 " + exact(1e6 * (1 + type)) + " restitution 0.8";
  };
  for (const char *newton : {"on", "off"})
    EXPECT_EQ(difference_of_types(line, newton), 0.0) << newton;
}

// Two particles that touch through two images have one history, which LAMMPS keeps by ID.
TEST(NarrowBox, WarnsOfABoxThatIsNarrowerThanTwoDiameters)
{
  for (const double half : {0.99, 1.0}) {
    const ScratchFile log(".log");
    Simulation simulation(MPI_COMM_WORLD, log.name());
    simulation.open_box(half, 1, "f p f");
    simulation.create({{Vec3(0, 0, 0)}});
    simulation("pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 5e3 0 0.3\n"
               "fix integrate all nve/sphere\ntimestep 1e-4\nrun 0\nrun 0\nlog none");
    const std::string text = log.text(), warning = "the box is 1.98 wide along y, less than two";
    const auto at = text.find(warning);
    EXPECT_EQ(at != std::string::npos, half < 1.0) << text;
    if (at != std::string::npos) {    // once
      EXPECT_EQ(text.find(warning, at + 1), std::string::npos);
    }
  }
}

}    // namespace
