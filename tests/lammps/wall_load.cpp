// SPDX-License-Identifier: GPL-2.0-only

// A platen driven by a force: motion against closed forms of velocity Verlet, rest under a load,
// stops, energy, ranks, restart, and time step.

#include "packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace eepa_test;

namespace {

constexpr int FORCE_Z = 3, POSITION = 4, VELOCITY = 5, CONTACTS = 6;
constexpr int LOAD_FORCE = 13, LOAD_KINETIC_ENERGY = 14, LOAD_WORK = 15, LOAD_DISSIPATED = 16;

/// A box with particles that touch only walls.
void open(Simulation &simulation, const std::vector<Sphere> &spheres, double time_step)
{
  simulation.open_box(5.0);
  simulation.create(spheres);
  simulation("pair_style zero 1.0\npair_coeff * *\ntimestep " + exact(time_step));
}

/// A platen far above a particle that is not integrated.
void open_free(Simulation &simulation, double time_step, const std::string &load,
               const std::string &plane = "zplane NULL 3")
{
  open(simulation, {{Vec3(0, 0, 0)}}, time_step);
  simulation("fix top all wall/gran/eepa linear coeff 1e4 1e4 0 0 0 wall " + plane + " load " +
             load);
}

/* ---------------------------------------------------------------------- free fall */

struct Fall {
  const char *plane, *load;
  double start, acceleration;
};

class FreeFall : public testing::TestWithParam<Fall> {};

// Velocity Verlet is exact for a constant force, and with powers of 2 so is its arithmetic. Set-ups
// between runs leave no trace.
TEST_P(FreeFall, IsExact)
{
  const Fall fall = GetParam();
  const double dt = 1.0 / 1024.0;
  Simulation simulation;
  open_free(simulation, dt, fall.load, fall.plane);
  simulation("variable push equal 6\nvariable area equal 1.5");
  int steps = 0;
  for (const int more : {0, 100, 0, 1, 155}) {
    simulation.run(more);
    steps += more;
    const double t = steps * dt, way = 0.5 * fall.acceleration * t * t;
    EXPECT_EQ(simulation.fix("top", POSITION), fall.start + way);
    EXPECT_EQ(simulation.fix("top", VELOCITY), fall.acceleration * t);
    EXPECT_EQ(simulation.fix("top", LOAD_FORCE), 2.0 * fall.acceleration);
    EXPECT_EQ(simulation.fix("top", LOAD_WORK), 2.0 * fall.acceleration * way);
    EXPECT_EQ(simulation.fix("top", LOAD_KINETIC_ENERGY), simulation.fix("top", LOAD_WORK));
    EXPECT_EQ(simulation.fix("top", LOAD_DISSIPATED), 0.0);
  }
}
// a pressure acts towards the particles, a force along the axis
const Fall falls[] = {
    {"zplane NULL 3", "-6 mass 2", 3.0, -3.0},
    {"zplane NULL 3", "pressure 4 area 1.5 mass 2", 3.0, -3.0},
    {"zplane -3 NULL", "pressure 4 area v_area mass 2", -3.0, 3.0},
    {"xplane -3 NULL", "v_push mass 2 contacts", -3.0, 3.0},
    {"yplane NULL 2", "-6 limits NULL 2.5 damping 0 mass 2", 2.0, -3.0},
};
INSTANTIATE_TEST_SUITE_P(Loads, FreeFall, testing::ValuesIn(falls));

// v = F/c (1 - exp(-c t/m)) at every step, for any damping; the displacement to second order.
TEST(DampedFall, ReachesItsTerminalVelocity)
{
  const double force = -6.0, mass = 2.0;
  for (const double damping : {1e-9, 0.5, 40.0, 1e5}) {
    double error[2];
    for (const int fine : {0, 1}) {
      const double dt = 1e-3 / (1 + fine), time = 0.5;
      Simulation simulation;
      open_free(simulation, dt, "-6 mass 2 damping " + exact(damping));
      simulation.run(static_cast<int>(std::lround(time / dt)));
      const double decay = -std::expm1(-damping * time / mass);
      const double velocity = force / damping * decay;
      EXPECT_NEAR(simulation.fix("top", VELOCITY), velocity, 1e-12 * std::fabs(velocity));
      if (damping > 1.0) { EXPECT_NEAR(velocity, force / damping, 1e-3 * std::fabs(velocity)); }
      const double way = force / damping * (time - mass / damping * decay);
      error[fine] = damping < 1.0 ? 0.0 : simulation.fix("top", POSITION) - 3.0 - way;
      // the external work is in the platen's motion and in the damping
      const double work = simulation.fix("top", LOAD_WORK);
      const double stored = simulation.fix("top", LOAD_KINETIC_ENERGY);
      EXPECT_NEAR(work, force * (simulation.fix("top", POSITION) - 3.0), 1e-10);
      EXPECT_NEAR(simulation.fix("top", LOAD_DISSIPATED), work - stored, 2e-3 * work) << damping;
      if (damping == 0.5) { EXPECT_GT(simulation.fix("top", LOAD_DISSIPATED), 0.05 * work); }
    }
    if (damping == 40.0) {
      EXPECT_LT(std::fabs(error[0]), 1e-3 * 1e-3);
      EXPECT_NEAR(error[0] / error[1], 4.0, 0.1);
    }
  }
}

// A ramp: the force at the end of each step, halved over two steps. With F = -alpha m t exactly
// v = -alpha t^2/2 and x = -alpha dt^3 N (N^2 - 1)/6.
TEST(RampedPressure, IsTakenAtTheEndOfEachStep)
{
  const double dt = 1e-3, alpha = 0.5 * 8.0 * 3.0 / 2.0;
  Simulation simulation;
  open_free(simulation, dt, "pressure v_p area v_a mass 2");
  simulation("variable p equal 8*step*dt\nvariable a equal 0.5*3");
  double n = 0.0;
  for (const int more : {1, 1, 300, 98}) {
    simulation.run(more);
    n += more;
    EXPECT_NEAR(simulation.fix("top", LOAD_FORCE), -2.0 * alpha * n * dt, 1e-13);
    EXPECT_NEAR(simulation.fix("top", VELOCITY), -alpha * n * n * dt * dt / 2.0, 1e-13);
    EXPECT_NEAR(simulation.fix("top", POSITION), 3.0 - alpha * dt * dt * dt * n * (n * n - 1) / 6.0,
                1e-13);
  }
}

/* ---------------------------------------------------------------------- on a spring */

struct Spring {
  const char *name, *axis, *load;
};
class Oscillation : public testing::TestWithParam<Spring> {};

// Velocity Verlet's own solution of m x'' = -k x from rest is A cos(n theta), cos theta = 1 - (w
// dt)^2/2. The spring is a contact with a held sphere, or a load variable that reads the platen's
// position from this fix.
TEST_P(Oscillation, IsVerletsOwn)
{
  const double stiffness = 1e4, mass = 2.0, dt = 1e-3, amplitude = 0.005;
  Simulation simulation;
  const std::string axis = GetParam().axis;
  Vec3 x = Vec3::Zero();
  x[axis[0] - 'x'] = 0.01;
  open(simulation, {{x}}, dt);
  const bool by_contact = std::string(GetParam().name) != "variable";
  const double centre = by_contact ? 0.5 : 2.0;    // at an overlap of 0.01, where 100 hold it
  simulation("variable spring equal -1e4*(f_top[4]-2)\n"
             "fix top all wall/gran/eepa linear coeff 1e4 1e4 0 0 0 wall " +
             axis + "plane NULL " + exact(centre + amplitude) + " load " + GetParam().load);
  const double omega = std::sqrt(stiffness / mass);
  const double theta = std::acos(1.0 - 0.5 * omega * omega * dt * dt);
  for (int n = 0; n <= 1000; n += 37) {
    if (n == 0)
      simulation.run(0);
    else
      simulation("run 37 pre no post no");
    EXPECT_NEAR(simulation.fix("top", POSITION), centre + amplitude * std::cos(n * theta), 1e-12);
    EXPECT_NEAR(simulation.fix("top", VELOCITY),
                -amplitude * std::sin(theta) / dt * std::sin(n * theta), 1e-10);
    EXPECT_EQ(simulation.fix("top", CONTACTS), by_contact ? 1.0 : 0.0);
  }
  const double period = 2.0 * pi * dt / theta;
  EXPECT_NEAR(period, 2.0 * pi * std::sqrt(mass / stiffness), 1e-3 * period);
}
const Spring springs[] = {{"contact_x", "x", "-100 mass 2"},
                          {"contact_y", "y", "-100 mass 2"},
                          {"contact_z", "z", "-100 mass 2"},
                          {"variable", "z", "v_spring mass 2"}};
INSTANTIATE_TEST_SUITE_P(Springs, Oscillation, testing::ValuesIn(springs), [](const auto &info) {
  return std::string(info.param.name);
});

// A platen that meets a free sphere: momentum is kept to rounding, and the restitution is that of
// the linear spring-dashpot with their reduced mass.
TEST(Collision, IsThatOfABodyOfItsMass)
{
  const double dt = 1e-5, mass = 3.0, k = 1e4, b = 20.0;
  Simulation simulation;
  open(simulation, {{Vec3(0, 0, 0)}}, dt);
  simulation("fix integrate all nve/sphere\nvariable push equal -3000*(step<100)\n"
             "fix top all wall/gran/eepa linear coeff 1e4 1e4 0 0 0 viscous 20 0 wall zplane NULL "
             "0.501 load v_push mass 3");
  simulation.run(100);    // the force acts half in step 100
  const double before = simulation.fix("top", VELOCITY);
  EXPECT_EQ(simulation.fix("top", LOAD_FORCE), 0.0);
  EXPECT_EQ(simulation.fix("top", CONTACTS), 0.0);
  EXPECT_NEAR(before, -1000.0 * 99.5 * dt, 1e-12);
  simulation.run(6000);
  EXPECT_EQ(simulation.fix("top", CONTACTS), 0.0);
  const double platen = simulation.fix("top", VELOCITY), sphere = simulation.particle(1).v.z();
  EXPECT_NEAR(mass * platen + sphere, mass * before, 1e-12);
  const double reduced = mass / (mass + 1.0), beta = 0.5 * b / reduced;
  const double restitution = std::exp(-pi * beta / std::sqrt(k / reduced - beta * beta));
  EXPECT_NEAR((platen - sphere) / -before, restitution, 2e-3);
  EXPECT_NEAR(restitution, 0.7, 0.05);
}

/* ---------------------------------------------------------------------- at rest */

struct Column {
  const char *load, *plane;
  double sign;    ///< of z, upside down for a platen that pushes up
};
class ColumnUnderLoad : public testing::TestWithParam<Column> {};

// Each contact carries the platen's force and the weight of all above it.
TEST_P(ColumnUnderLoad, RestsAtItsAnalyticOverlaps)
{
  const Column &column = GetParam();
  const double k = 1e5, k_wall = 4e4, gravity = 10.0, force = 200.0;
  const double radii[] = {0.5, 0.4, 0.45, 0.35, 0.3};
  std::vector<Sphere> spheres;
  double height = 0.0, weight = 0.0;
  for (const double radius : radii) {
    Sphere sphere;
    sphere.radius = radius;
    sphere.x.z() = column.sign * (height + radius);
    height += 2.0 * radius;
    weight += gravity * mass_of(sphere);
    spheres.push_back(sphere);
  }
  Simulation simulation;
  simulation.open_box(5.0);
  simulation.create(spheres);
  const std::string floor = column.sign > 0 ? "0 NULL" : "NULL 0";
  simulation(
      "pair_style gran/eepa linear\npair_coeff * * 1e5 1e5 0 0 0.3 restitution 0.1\n"
      "timestep 2e-4\nfix integrate all nve/sphere\n"
      "fix gravity all gravity 10 vector 0 0 " +
      exact(-column.sign) +
      "\nfix floor all wall/gran/eepa linear coeff 4e4 4e4 0 0 0.3 restitution 0.1 wall zplane " +
      floor + "\nvariable area equal 0.25\nvariable p equal 800\nvariable push equal 200*" +
      exact(-column.sign) +
      "\nfix top all wall/gran/eepa linear coeff 4e4 4e4 0 0 0.3 restitution 0.1 wall zplane " +
      column.plane + " load " + column.load + " mass 2 damping 100");
  simulation.run(20000);
  auto p = simulation.particles();
  double expected = 0.0, carried = force + weight;
  for (std::size_t i = 0; i < p.size(); i++) {
    expected += p[i].radius - carried / (i == 0 ? k_wall : k);
    if (i > 0) expected += p[i - 1].radius;
    EXPECT_NEAR(column.sign * p[i].x.z(), expected, 1e-12) << i;
    EXPECT_LT(p[i].v.norm(), 1e-10);
    carried -= gravity * p[i].mass;
  }
  expected += p.back().radius - force / k_wall;
  EXPECT_NEAR(column.sign * simulation.fix("top", POSITION), expected, 1e-12);
  EXPECT_NEAR(column.sign * simulation.fix("top", FORCE_Z), force, 1e-8);
  EXPECT_NEAR(column.sign * simulation.fix("floor", FORCE_Z), -force - weight, 1e-8);
  EXPECT_NEAR(column.sign * simulation.fix("top", LOAD_FORCE), -force, 1e-12);
  EXPECT_EQ(simulation.fix("top", CONTACTS), 1.0);
}
const Column columns[] = {
    {"-200", "NULL 4", 1.0},
    {"v_push", "NULL 4.01", 1.0},
    {"pressure v_p area v_area", "NULL 4", 1.0},
    {"pressure 800 area 0.25", "-4 NULL", -1.0},
};
INSTANTIATE_TEST_SUITE_P(Loads, ColumnUnderLoad, testing::ValuesIn(columns));

/* ---------------------------------------------------------------------- limits of travel */

TEST(Limits, StopThePlatenAndLetItGoWhenTheForceTurns)
{
  const double dt = 1.0 / 1024.0;
  Simulation simulation;
  open_free(simulation, dt, "v_push mass 2 limits 2.9 3.1");
  const auto push = [&](double force) {
    simulation("variable push equal " + exact(force));
  };
  push(-6.0);
  simulation.run(1024);    // the platen is at its stop after sqrt(0.2/3) = 0.26
  EXPECT_EQ(simulation.fix("top", POSITION), 2.9);
  EXPECT_EQ(simulation.fix("top", VELOCITY), 0.0);
  EXPECT_EQ(simulation.fix("top", LOAD_FORCE), -6.0);
  EXPECT_NEAR(simulation.fix("top", LOAD_WORK), 0.6, 1e-13);
  EXPECT_NEAR(simulation.fix("top", LOAD_DISSIPATED), 0.6, 1e-13);
  push(6.0);
  simulation.run(128);
  EXPECT_NEAR(simulation.fix("top", POSITION), 2.9 + 1.5 / 64.0, 1e-14);
  EXPECT_NEAR(simulation.fix("top", VELOCITY), 3.0 / 8.0, 1e-14);
  simulation.run(1000);
  EXPECT_EQ(simulation.fix("top", POSITION), 3.1);
  EXPECT_EQ(simulation.fix("top", VELOCITY), 0.0);
  EXPECT_NEAR(simulation.fix("top", LOAD_WORK), 0.6 + 1.2, 1e-12);
  EXPECT_NEAR(simulation.fix("top", LOAD_DISSIPATED), 0.6 + 1.2, 1e-12);
  push(-6.0);
  simulation.run(128);
  EXPECT_NEAR(simulation.fix("top", POSITION), 3.1 - 1.5 / 64.0, 1e-14);
}

TEST(Limits, MayBeOpenOnOneSide)
{
  for (const char *limits : {"NULL 3", "3 NULL", "3 3", "NULL NULL"}) {
    Simulation simulation;
    open_free(simulation, 1e-3, std::string("-6 mass 2 limits ") + limits);
    simulation.run(100);
    if (limits[0] == '3')
      EXPECT_EQ(simulation.fix("top", POSITION), 3.0) << limits;
    else
      EXPECT_NEAR(simulation.fix("top", POSITION), 3.0 - 1.5 * 0.01, 1e-12) << limits;
  }
}

// A platen at its stop is lifted by particles from below only when their force exceeds the load.
TEST(Limits, HoldAgainstThePlatenOnly)
{
  Simulation simulation;
  open(simulation, {{Vec3(0, 0, 0)}}, 1e-4);
  simulation("fix carry all move linear 0 0 0.1\n"
             "fix top all wall/gran/eepa linear coeff 1e4 1e4 0 0 0 wall zplane NULL 0.5 load -50 "
             "mass 0.1 damping 50 limits 0.5 NULL");
  simulation.run(490);    // overlap 0.0049, 49 of 50
  EXPECT_EQ(simulation.fix("top", POSITION), 0.5);
  EXPECT_NEAR(simulation.fix("top", FORCE_Z), 49.0, 1e-9);
  simulation.run(1510);    // 0.02 - 0.005, and the lag by damping: c v/k
  EXPECT_NEAR(simulation.fix("top", POSITION), 0.515 - 50.0 * 0.1 / 1e4, 1e-6);
}

/* ---------------------------------------------------------------------- energy */

// A packing on a floor between walls, pressed by a platen whose force rises and falls.
void open_pressed(Simulation &simulation, const std::string &load, double dt,
                  const std::string &walls = "")
{
  Packing packing;
  packing.side = 5;
  packing.spacing = 1.0;
  packing.jitter = 0.01;
  packing.speed = 0.0;    // see LedgerStart
  const std::string half = exact(packing.half());
  const std::string coefficients = "1e4 2e4 5e3 -1 0.3 restitution 0.7 rolling sds 2e3 1 0.1";
  const std::string wall = " all wall/gran/eepa linear coeff " + coefficients + " wall ";
  simulation.open_box(packing.half() + 1.0, 1, "f f f");
  simulation.create(packing.spheres());
  simulation("pair_style gran/eepa linear\npair_coeff * * " + coefficients +
             "\nfix integrate all nve/sphere\nfix gravity all gravity 10 vector 0 0 -1\ntimestep " +
             exact(dt) + "\nvariable push equal -1500*(1-cos(40*step*dt))-100");
  simulation("fix sides" + wall + "xplane -" + half + " " + half);
  simulation("fix ends" + wall + "yplane -" + half + " " + half);
  simulation("fix floor" + wall + "zplane -" + half + " NULL");
  simulation("fix top" + wall + "zplane NULL " + half + " load " + load + walls);
}

// Verlet turns (f_n + f_n+1)/2 times the displacement into kinetic energy, except for the change of
// dt^2/(8 m) f^2 over a step, which does not accumulate. So to rounding
//   kinetic + work on the particles - work of the load - dt^2/(8 m) (F + R)^2 = constant.
// Losses by damping and at a stop are booked; with them the sum holds to second order.
TEST(PlatenEnergy, IsKeptToRounding)
{
  const double dt = 2e-4, mass = 20.0;
  Simulation simulation;
  open_pressed(simulation, "v_push mass 20", dt);
  simulation("compute ledger all gran/eepa/energy");
  simulation.run(0);
  double start = 0.0, most = 0.0, travel = 0.0;
  for (int step = 0; step <= 1500; step++) {
    if (step) simulation("run 1 pre no post no");
    const double net = simulation.fix("top", LOAD_FORCE) + simulation.fix("top", FORCE_Z);
    const double sum = simulation.fix("top", LOAD_KINETIC_ENERGY) +
        simulation.compute_vector("ledger")[8] - simulation.fix("top", LOAD_WORK) -
        dt * dt / (8.0 * mass) * net * net;
    if (step == 0) start = sum;
    EXPECT_NEAR(sum, start, 1e-10) << step;
    most = std::max(most, simulation.fix("top", LOAD_KINETIC_ENERGY));
    travel = std::max(travel, std::fabs(simulation.fix("top", POSITION) - 2.5));
  }
  EXPECT_GT(most, 1.0);
  EXPECT_GT(travel, 0.1);
  EXPECT_GT(std::fabs(simulation.fix("top", LOAD_WORK)), 50.0);
}

struct Pressing {
  const char *name, *load;
};
class PressedPacking : public testing::TestWithParam<Pressing> {};

// Particles, contacts, gravity, platen, load, damping and stops together: the error falls with the
// time step.
TEST_P(PressedPacking, KeepsTheSumOfAllEnergies)
{
  double missed[2], put_in = 0.0;
  for (const int fine : {0, 1}) {
    Simulation simulation;
    open_pressed(simulation, GetParam().load, 2e-4 / (1 + fine));
    simulation("compute ledger all gran/eepa/energy");
    double start = 0.0;
    missed[fine] = 0.0;
    for (int k = 0; k <= 150; k++) {
      if (k)
        simulation(fine ? "run 20 pre no post no" : "run 10 pre no post no");
      else
        simulation.run(0);
      const auto e = simulation.compute_vector("ledger");
      double sum = std::accumulate(e.begin(), e.begin() + 8, 0.0);
      for (const auto &p : simulation.particles())
        sum += p.kinetic_energy() + 10.0 * p.mass * p.x.z();
      sum += simulation.fix("top", LOAD_KINETIC_ENERGY) + simulation.fix("top", LOAD_DISSIPATED) -
          simulation.fix("top", LOAD_WORK);
      if (k == 0) start = sum;
      missed[fine] = std::max(missed[fine], std::fabs(sum - start));
      put_in = std::max(put_in, simulation.fix("top", LOAD_WORK));
    }
    if (std::string(GetParam().name) != "free") {
      EXPECT_GT(simulation.fix("top", LOAD_DISSIPATED), 0.05 * put_in);
    }
  }
  std::printf("%s: missed %.2e and %.2e of %.4g put in\n", GetParam().name, missed[0] / put_in,
              missed[1] / put_in, put_in);
  EXPECT_GT(put_in, 100.0);
  EXPECT_LT(missed[0], 1e-3 * put_in);
  EXPECT_LT(missed[1], 0.65 * missed[0]);
}
const Pressing pressings[] = {{"free", "v_push mass 20"},
                              {"damped", "v_push mass 20 damping 200"},
                              {"stopped", "v_push mass 20 limits 2.43 2.6"}};
INSTANTIATE_TEST_SUITE_P(Loads, PressedPacking, testing::ValuesIn(pressings), [](const auto &info) {
  return std::string(info.param.name);
});

/* ---------------------------------------------------------------------- ranks and restart */

TEST(ParallelLoad, MovesTheSamePlatenOnAllRanks)
{
  Simulation alone(MPI_COMM_SELF), together;
  for (auto *simulation : {&alone, &together}) {
    open_pressed(*simulation, "v_push mass 20 damping 10", 2e-4, " contacts");
    simulation->run(500);
    simulation->run(100);
  }
  EXPECT_LT(difference(alone.particles(), together.particles()), 1e-9);
  for (int k = 1; k <= LOAD_DISSIPATED; k++) {
    const double value = alone.fix("top", k), mine = together.fix("top", k);
    EXPECT_NEAR(mine, value, 1e-8 * std::max(1.0, std::fabs(value))) << k;
    // to the bit: platens that differed between ranks would tear the packing apart
    double first = mine;
    MPI_Bcast(&first, 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    EXPECT_EQ(mine, first) << k;
  }
  EXPECT_GT(alone.fix("top", CONTACTS), 15.0);
}

constexpr const char *restarted_box =
    "comm_modify vel yes\nneighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\n"
    "thermo 1000000\n";

// A run that is stopped and continued has the same bits.
TEST(LoadRestart, GoesOnToTheBit)
{
  const ScratchFile file(".restart");
  const std::string wall = "fix top all wall/gran/eepa linear coeff 1e4 4e4 5e3 -1 0.5 restitution "
                           "0.8 wall zplane NULL 0.99 load v_push mass 3 damping 2 limits 0.9 1.2",
                    rest = "fix integrate all nve/sphere\ntimestep 1e-4\nvariable push equal "
                           "-200*(1-cos(100*step*dt))\nfix gravity all gravity 10 vector 0 0 -1\n"
                           "fix floor all wall/gran/eepa linear coeff 1e4 4e4 5e3 -1 0.5 "
                           "restitution 0.8 wall zplane 0 NULL\n" +
      wall;
  Simulation original, restarted;
  original("atom_modify sort 0 0.0");
  original.open_box(4.0);
  std::vector<Sphere> spheres;
  for (int k = 0; k < 5; k++)
    spheres.push_back({Vec3(1.2 * k - 2.4, 0, 0.49), Vec3(0.5, 0.3, -0.2 * k), Vec3(1, 2, 3)});
  original.create(spheres);
  original("pair_style zero 1.0\npair_coeff * *\n" + rest);
  original.run(333);
  original("write_restart " + file.name());
  restarted("atom_modify sort 0 0.0\nread_restart " + file.name() + "\n" + restarted_box + rest);
  for (const int steps : {0, 500}) {
    original.run(steps);
    restarted.run(steps);
    for (int k = 1; k <= LOAD_DISSIPATED; k++)
      EXPECT_EQ(original.fix("top", k), restarted.fix("top", k)) << k << " at " << steps;
    const auto a = original.particles(), b = restarted.particles();
    for (std::size_t k = 0; k < a.size(); k++) {
      EXPECT_EQ(a[k].x, b[k].x);
      EXPECT_EQ(a[k].v, b[k].v);
      EXPECT_EQ(a[k].omega, b[k].omega);
    }
    EXPECT_NE(original.fix("top", VELOCITY), 0.0);
    EXPECT_NE(original.fix("top", POSITION), 0.99);
    EXPECT_NE(original.fix("top", LOAD_DISSIPATED), 0.0);
    EXPECT_EQ(original.fix("top", CONTACTS), 5.0);
  }
}

/* ---------------------------------------------------------------------- time step */

// Four spheres under a platen: 0.2 sqrt(M/(4 k)) is that of a particle of mass 1 for M = 4.
class PlatenTimeStep : public testing::Test {
 protected:
  static constexpr double limit_of_particles = 0.2 * 0.01;    // sqrt(1/1e4)
  static void open_four(Simulation &simulation, const std::string &check, double mass,
                        double height, double dt)
  {
    open(simulation,
         {{Vec3(-2, 0, 0)}, {Vec3(2, 0, 0)}, {Vec3(0, -2, 0)}, {Vec3(0, 2, 0)}, {Vec3(0, 0, -2)}},
         dt);
    simulation("fix top all wall/gran/eepa linear dtcheck " + check +
               " coeff 1e4 1e4 0 0 0 wall zplane NULL " + exact(height) + " load -1 mass " +
               exact(mass) + "\ncompute dt all gran/eepa/dt");
  }
};

TEST_F(PlatenTimeStep, IsThatOfAMassOnAllItsContacts)
{
  for (const double mass : {0.01, 0.25, 4.0, 100.0}) {
    Simulation simulation;
    open_four(simulation, "off", mass, 0.499, 1e-6);
    simulation.run(0);
    EXPECT_EQ(simulation.fix("top", CONTACTS), 4.0);
    EXPECT_NEAR(simulation.compute("dt"), std::min(limit_of_particles, 0.2 * std::sqrt(mass / 4e4)),
                1e-15);
  }
}

TEST_F(PlatenTimeStep, IsCheckedAtTheStart)
{
  const std::string message = "fix top wall/gran/eepa: timestep 0.0015 is larger than 0.001 = 0.2 "
                              "sqrt\\(m/\\(n k_max\\)\\) of the platen of mass m = 1 on its n = 4 "
                              "contacts";
  Simulation light, heavy;
  open_four(light, "error", 1.0, 0.499, 1.5e-3);
  EXPECT_TRUE(refuses(light, "run 0", message));
  open_four(heavy, "error", 4.0, 0.499, 1.5e-3);
  EXPECT_EQ(error_of(heavy, "run 0 post no"), "");
}

TEST_F(PlatenTimeStep, IsCheckedWhenContactsForm)
{
  Simulation simulation;
  open_four(simulation, "error", 1.0, 0.501, 1.5e-3);
  EXPECT_EQ(error_of(simulation, "run 0 post no"), "");
  EXPECT_TRUE(refuses(simulation, "run 1000 post no", "timestep 0.0015 is larger than 0.001"));
}

TEST_F(PlatenTimeStep, IsWarnedOfOnceARun)
{
  const ScratchFile log(".log");
  {
    Simulation simulation(MPI_COMM_WORLD, log.name());
    open_four(simulation, "warn", 1.0, 0.499, 1.5e-3);
    simulation.run(10);
  }
  const std::string text = log.text(), words = "of the platen of mass";
  std::size_t count = 0;
  for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) count++;
  EXPECT_EQ(count, 1u);
}

/* ---------------------------------------------------------------------- mistakes */

struct Mistake {
  const char *lines, *regex;
};
class LoadMistake : public testing::TestWithParam<Mistake> {};

TEST_P(LoadMistake, IsNamed)
{
  Simulation simulation;
  open(simulation, {{Vec3(0, 0, 0)}}, 1e-4);
  simulation("variable peratom atom x\nvariable text string hello\nvariable zero equal 0\n"
             "variable huge equal exp(1000)\nvariable falling equal 2-step");
  EXPECT_TRUE(refuses(simulation,
                      std::string("fix w all wall/gran/eepa linear coeff 1e4 2e4 0 0 0 wall ") +
                          GetParam().lines,
                      std::string("fix w wall/gran/eepa: ") + GetParam().regex));
}
const Mistake load_mistakes[] = {
    {"zplane -3 3 load 5 mass 1", "load is not allowed with wall lo hi: it needs one plane alone"},
    {"zcylinder 4 load 5 mass 1",
     "load is not allowed with wall zcylinder: it needs one plane alone"},
    {"zplane NULL 3 load", "missing value: load force"},
    {"zplane NULL 3 load mass 1", "load force = mass is not a finite number"},
    {"zplane NULL 3 load nan mass 1", "load force = nan is not a finite number"},
    {"zplane NULL 3 load v_ mass 1", "load force = v_ names no variable"},
    {"zplane NULL 3 load 5", "load: missing keyword mass"},
    {"zplane NULL 3 load 5 contacts", "load: missing keyword mass"},
    {"zplane NULL 3 load 5 mass", "missing value: load mass"},
    {"zplane NULL 3 load 5 mass 0", "load mass = 0 is not allowed: it must be > 0"},
    {"zplane NULL 3 load 5 mass -2", "load mass = -2 is not allowed: it must be > 0"},
    {"zplane NULL 3 load 5 mass nan", "load mass = nan is not a finite number"},
    {"zplane NULL 3 load 5 mass v_zero", "load mass = v_zero is not a finite number"},
    {"zplane NULL 3 load 5 mass 1 mass 2", "keyword mass is given twice"},
    {"zplane NULL 3 load 5 mass 1 damping -1", "load damping = -1 is not allowed: it must be >= 0"},
    {"zplane NULL 3 load 5 mass 1 damping inf", "load damping = inf is not a finite number"},
    {"zplane NULL 3 load 5 mass 1 limits 4 2",
     "load limits lo = 4 is not allowed: it must be <= hi = 2"},
    {"zplane NULL 3 load 5 mass 1 limits 4", "missing value: load limits hi"},
    {"zplane NULL 3 load 5 mass 1 limits x 4", "load limits lo = x is not a finite number"},
    {"zplane NULL 3 load 5 mass 1 limits 1 2\nrun 0",
     "load limits 1 to 2 are not allowed: the plane is at 3, outside of them"},
    {"zplane NULL 3 load 5 mass 1 area 2", "load area is allowed with load pressure only"},
    {"zplane NULL 3 load pressure 5 mass 1", "load pressure: missing keyword area"},
    {"zplane NULL 3 load pressure 5 area 0 mass 1", "load area = 0 is not allowed: it must be > 0"},
    {"zplane NULL 3 load pressure x area 1 mass 1", "load pressure = x is not a finite number"},
    {"zplane NULL 3 load 5 mass 1 dampen 2",
     "load keyword 'dampen' is unknown: it must be mass, area, damping or limits"},
    {"zplane NULL 3 load 5 mass 1 velocity 0 0 1",
     "only one of velocity, wiggle, shear, load and rotate is allowed"},
    {"zplane NULL 3 load 5 mass 1 load 5 mass 1",
     "only one of velocity, wiggle, shear, load and rotate is allowed"},
    {"zplane NULL 3 wiggle z 1 1 load 5 mass 1",
     "only one of velocity, wiggle, shear, load and rotate is allowed"},
    {"zplane NULL 3 load 5 mass 1 shear z 1",
     "shear dimension z is not allowed: it must lie in the plane"},
    {"zplane NULL 3 load 5 mass 1 shear x v_none\nrun 0", "shear variable none does not exist"},
    {"zplane NULL 3 load v_none mass 1\nrun 0", "load force variable none does not exist"},
    {"zplane NULL 3 load pressure v_none area 1 mass 1\nrun 0",
     "load pressure variable none does not exist"},
    {"zplane NULL 3 load pressure 1 area v_none mass 1\nrun 0",
     "load area variable none does not exist"},
    {"zplane NULL 3 load v_peratom mass 1\nrun 0",
     "load force variable peratom is not allowed: it must be equal-style"},
    {"zplane NULL 3 load v_text mass 1\nrun 0",
     "load force variable text is not allowed: it must be equal-style"},
    {"zplane NULL 3 load v_huge mass 1\nrun 0",
     "load force variable huge = inf at step 0 is not finite"},
    {"zplane NULL 3 load pressure 1 area v_zero mass 1\nrun 0",
     "load area variable zero = 0.* at step 0 is not allowed: it must be > 0"},
    {"zplane NULL 3 load pressure 1 area v_falling mass 1\nrun 5",
     "load area variable falling = 0.* at step 2 is not allowed: it must be > 0"},
};
INSTANTIATE_TEST_SUITE_P(Lines, LoadMistake, testing::ValuesIn(load_mistakes));

}    // namespace
