// SPDX-License-Identifier: GPL-2.0-only

// Changes that must not affect the motion of a packing whose contacts cross ranks and periodic
// boundaries. Each test compares two simulations that differ in one thing; deviations are relative
// to the largest component of each quantity (see difference()).

#include "packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numeric>

using namespace eepa_test;

namespace {

constexpr int steps = 200;
constexpr double tolerance = 1e-10;    // rounding, 1e-16, grown by 200 steps of colliding particles

struct Law {
  const char *name, *style, *coefficients;
};
const Law laws[] = {
    {"linear", "linear", "1e4 2e4 5e3 -1 0.5 restitution 0.8"},
    {"twisting", "linear", "1e4 2e4 5e3 -1 0.5 restitution 0.8 twisting marshall"},
    {"plateau", "plateau limit_damping yes", "1e4 2e4 5e3 -1 0.5 viscous 1 1 rolling constant 0.1"},
    {"luding", "luding", "1e4 3e4 5e3 -1 0.5 depth 0.02 restitution 0.8 bound contact"},
    {"exponent", "linear exponent 1.5",
     "1e5 2e5 5e4 -1 0.5 kt 3e3 restitution 0.8 rolling sds 1e3 1 0.1"},
};
std::string pair(const Law &law, const std::string &scale = "")
{
  return std::string("pair_style gran/eepa ") + law.style + scale + "\npair_coeff * * " +
      law.coefficients + "\n";
}

/// How a simulation differs from the plain one.
struct Setting {
  std::string before;    ///< commands before the box
  std::string box = "block";
  std::string newton = "on";
  std::string after;    ///< commands after the particles
  std::string pair;     ///< in place of the plain pair commands
  std::function<void(std::vector<Sphere> &)> change;
  MPI_Comm comm = MPI_COMM_WORLD;
};

Packing the_packing()
{
  Packing packing;
  packing.side = 5;
  packing.polydisperse = true;
  packing.speed = 1.0;
  return packing;
}

void start(Simulation &simulation, const Law &law, const Setting &setting)
{
  const Packing packing = the_packing();
  auto spheres = packing.spheres();
  if (setting.change) setting.change(spheres);
  const std::string half = exact(packing.half()), side = "-" + half + " " + half + " ";
  const bool prism = setting.box == "prism";
  simulation(setting.before + "\nunits si\natom_style sphere\natom_modify map array\nnewton " +
             setting.newton + "\nboundary p p p\nregion box " + setting.box + " " + side + side +
             side + (prism ? "0 0 0" : "") +
             "\ncreate_box 2 box\ncomm_modify vel yes\nneighbor 0.1 bin\n"
             "neigh_modify every 1 delay 0 check yes\nthermo 1000000");
  simulation.create(spheres);
  simulation((setting.pair.empty() ? pair(law) : setting.pair) +
             "\nfix integrate all nve/sphere\ntimestep 2e-4\n" + setting.after);
}

std::vector<Particle> motion(const Law &law, const Setting &setting = Setting())
{
  Simulation simulation(setting.comm);
  start(simulation, law, setting);
  simulation.run(steps);
  return simulation.particles();
}

class ParallelInvariance : public testing::TestWithParam<Law> {
 protected:
  const Law &law = GetParam();

  /// Number of comparisons and worst deviation of each test, over all laws, for tests/README.md.
  static std::map<std::string, std::pair<int, double>> found;
  static void report(double deviation)
  {
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    auto &[count, worst] = found[name.substr(0, name.find('/'))];
    count++;
    worst = std::max(worst, deviation);
  }
  static void TearDownTestSuite()
  {
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    for (const auto &[name, of] : found)
      if (rank == 0)
        std::printf("%s: %d comparisons, worst %.1e\n", name.c_str(), of.first, of.second);
  }
  std::vector<Particle> reference()
  {
    Setting alone;
    alone.comm = MPI_COMM_SELF;
    return motion(law, alone);
  }
  void expect_same(const std::vector<Particle> &a, const std::vector<Particle> &b,
                   const std::string &what)
  {
    const double worst = difference(a, b);
    EXPECT_LT(worst, tolerance) << what;
    EXPECT_EQ(a.size(), 125u);
    report(worst);
  }
};
std::map<std::string, std::pair<int, double>> ParallelInvariance::found;

TEST_P(ParallelInvariance, ProcessorGridsAndNewton)
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const auto expected = reference();
  for (const char *newton : {"on", "off"}) {
    for (int px = 1; px <= ranks; px++) {
      for (int py = 1; px * py <= ranks; py++) {
        if (ranks % (px * py)) continue;
        Setting setting;
        setting.newton = newton;
        setting.before = "processors " + std::to_string(px) + " " + std::to_string(py) + " " +
            std::to_string(ranks / (px * py));
        expect_same(expected, motion(law, setting), setting.before + " " + newton);
      }
    }
  }
}

TEST_P(ParallelInvariance, OrderOfIds)
{
  // the same spheres, created in another order
  const int n = 125;
  std::vector<int> at(n);
  std::iota(at.begin(), at.end(), 0);
  std::mt19937 generator(7);
  for (int k = n - 1; k > 0; k--) std::swap(at[k], at[generator() % (k + 1)]);
  Setting setting;
  setting.change = [&](std::vector<Sphere> &spheres) {
    const auto old = spheres;
    for (int k = 0; k < n; k++) spheres[k] = old[at[k]];
  };
  const auto permuted = motion(law, setting);
  std::vector<Particle> back(n);
  for (int k = 0; k < n; k++) {
    back[at[k]] = permuted[k];
    back[at[k]].id = at[k] + 1;
  }
  expect_same(reference(), back, "permuted");
}

// 1e-9: v dt of 30 adds rounding of 30 ulp a step to positions of 1.
TEST_P(ParallelInvariance, VelocityOfTheFrame)
{
  const Vec3 drift(20, -15, 10);
  Setting setting;
  setting.change = [&](std::vector<Sphere> &spheres) {
    for (auto &s : spheres) s.v += drift;
  };
  auto moved = motion(law, setting);
  for (auto &p : moved) {
    p.v -= drift;
    p.x -= steps * 2e-4 * drift;
  }
  const double worst = difference(reference(), moved);
  EXPECT_LT(worst, 1e-9);
  report(worst);
}

TEST_P(ParallelInvariance, NinetyDegrees)
{
  const auto turn = [](const Vec3 &v) {
    return Vec3(-v.y(), v.x(), v.z());
  };
  const auto swap = [](const Vec3 &v) {
    return Vec3(v.y(), v.z(), v.x());
  };
  for (const bool cyclic : {false, true}) {
    const auto rotate = [&](const Vec3 &v) -> Vec3 {
      return cyclic ? swap(v) : turn(v);
    };
    Setting setting;
    setting.change = [&](std::vector<Sphere> &spheres) {
      for (auto &s : spheres) {
        s.x = rotate(s.x);
        s.v = rotate(s.v);
        s.omega = rotate(s.omega);
      }
    };
    auto expected = reference();
    for (auto &p : expected)
      for (auto *v : {&p.x, &p.v, &p.f, &p.omega, &p.torque}) *v = rotate(*v);
    expect_same(expected, motion(law, setting), cyclic ? "cyclic" : "about z");
  }
}

TEST_P(ParallelInvariance, PlaceInThePeriodicBox)
{
  // by a box length, which wraps to the same position, and by parts of one
  const double length = 2.0 * the_packing().half();
  for (const Vec3 &shift :
       {Vec3(length, -length, 0), Vec3(0.3 * length, 0.5 * length, -0.77 * length)}) {
    Setting setting;
    setting.change = [&](std::vector<Sphere> &spheres) {
      for (auto &s : spheres) {
        s.x += shift;
        for (int k = 0; k < 3; k++) {    // LAMMPS's library would drop those outside
          while (s.x[k] >= 0.5 * length) s.x[k] -= length;
          while (s.x[k] < -0.5 * length) s.x[k] += length;
        }
      }
    };
    auto moved = motion(law, setting);
    const auto expected = reference();
    for (std::size_t p = 0; p < moved.size(); p++)
      for (int k = 0; k < 3; k++) {
        double &x = moved[p].x[k];
        x -= shift[k];
        x += length * std::round((expected[p].x[k] - x) / length);
      }
    expect_same(expected, moved, "shift");
  }
}

TEST_P(ParallelInvariance, NeighborSkinAndRebuilds)
{
  const auto expected = reference();
  for (const char *after :
       {"neighbor 0.02 bin", "neighbor 0.5 bin", "neighbor 0.1 nsq",
        "neigh_modify every 1 delay 0 check no",
        "neighbor 0.3 bin\nneigh_modify every 3 delay 6 check yes",
        "neighbor 0.4 bin\nneigh_modify every 20 delay 0 check no", "atom_modify sort 7 0.6"}) {
    Setting setting;
    setting.after = after;
    expect_same(expected, motion(law, setting), after);
  }
}

TEST_P(ParallelInvariance, Balancing)
{
  const auto expected = reference();
  Simulation simulation;
  Setting setting;
  setting.before = "comm_style brick";
  start(simulation, law, setting);
  simulation.run(70);
  simulation("balance 1.0 shift xyz 10 1.0");
  simulation("run 60 post no");
  simulation("fix balance all balance 10 1.0 shift zx 5 1.0 weight group 1 all 2.0");
  simulation.run(70);
  // the start of each run computes forces from full-step velocities, so the reference has the same
  // breaks
  Setting alone;
  alone.comm = MPI_COMM_SELF;
  Simulation broken(MPI_COMM_SELF);
  start(broken, law, alone);
  for (const int n : {70, 60, 70}) broken.run(n);
  expect_same(broken.particles(), simulation.particles(), "balance");

  // with newton on LAMMPS itself refuses any history of neighbours with comm_style tiled
  setting.before = "";
  setting.newton = "off";
  setting.after = "comm_style tiled\ncomm_modify vel yes\nfix balance all balance 10 1.0 rcb";
  expect_same(expected, motion(law, setting), "fix balance rcb");
}

TEST_P(ParallelInvariance, Hybrid)
{
  const auto expected = reference();
  Setting setting;
  const std::string coefficients = law.coefficients, style = law.style;
  setting.pair =
      "pair_style hybrid gran/eepa " + style + "\npair_coeff * * gran/eepa " + coefficients;
  expect_same(expected, motion(law, setting), "hybrid");
  setting.pair = "pair_style hybrid/overlay zero 1.0 gran/eepa " + style +
      "\npair_coeff * * zero\npair_coeff * * gran/eepa " + coefficients;
  expect_same(expected, motion(law, setting), "hybrid/overlay");
}

TEST_P(ParallelInvariance, TriclinicBoxWithoutTilt)
{
  Setting setting;
  setting.box = "prism";
  expect_same(reference(), motion(law, setting), "prism");
}

// Sheared through its flip, with the images' velocities: the same on one rank and on all.
TEST_P(ParallelInvariance, DeformedTriclinicBox)
{
  const double length = 2.0 * the_packing().half();
  const std::string near_flip = "change_box all xy final " + exact(0.45 * length) + "\n";
  for (const std::string &deform :
       {near_flip + "fix deform all deform 1 xy erate 3 remap v flip yes",
        std::string("fix deform all deform 1 x scale 0.99 yz erate -2 xz vel 1 remap v")}) {
    Setting alone, together;
    alone.box = together.box = "prism";
    alone.comm = MPI_COMM_SELF;
    alone.after = together.after = deform;
    Simulation single(MPI_COMM_SELF);
    start(single, law, alone);
    single.run(steps);
    const auto a = single.particles();
    EXPECT_EQ(single.thermo("xy") < 0.0, deform.find("flip") != std::string::npos);
    for (const char *newton : {"on", "off"}) {
      together.newton = newton;
      expect_same(a, motion(law, together), deform);
    }
    EXPECT_GT(difference(reference(), a), 1e-2);
  }
}

/* ---------------------------------------------------------------------- scaled */

std::vector<Particle> scaled(const Law &law, double s)
{
  const Packing packing = the_packing();
  auto spheres = packing.spheres();
  for (auto &sphere : spheres) {
    sphere.x *= s;
    sphere.radius *= s;
    sphere.omega /= s;
  }
  Simulation simulation;
  simulation.open_box(packing.half() * s, 1, "p p p");
  simulation.create(spheres);
  simulation("neighbor " + exact(0.125 * s) + " bin\n" + pair(law, " scale 0.75") +
             "fix integrate all nve/sphere\ntimestep " + exact(s * 0x1p-12));
  simulation.run(steps);
  auto end = simulation.particles();
  for (auto &p : end) {
    p.x /= s;
    p.omega *= s;
    p.f /= s * s;
    p.torque /= s * s * s;
  }
  return end;
}

// By 2 the arithmetic is the same: see also scale.cpp, which has walls and gravity.
TEST_P(ParallelInvariance, Scale)
{
  const auto plain = scaled(law, 1.0), twice = scaled(law, 2.0), more = scaled(law, 1.7);
  EXPECT_EQ(difference(plain, twice), 0.0);
  const double worst = difference(plain, more);
  EXPECT_LT(worst, tolerance);
  report(worst);
}

INSTANTIATE_TEST_SUITE_P(Laws, ParallelInvariance, testing::ValuesIn(laws), [](const auto &info) {
  return std::string(info.param.name);
});

}    // namespace
