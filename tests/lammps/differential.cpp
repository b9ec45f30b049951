// SPDX-License-Identifier: GPL-2.0-only

// Random scripts, each run with changes that must not matter: on one rank and on all, with threads,
// another skin, newton off, more set-ups, a restart after every run, and twice. On 1, 2 and 4
// ranks.
//
//   EEPA_RANDOM_SCRIPTS="FIRST COUNT"   other seeds than 11 to 18: tests/hardening.sh differential

#include "random_script.h"

#include "lammps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <sstream>

using namespace eepa_test;

namespace {

// Differences by rounding grow to 1e-12 in these scripts; histories that a set-up changes make 1e-5
// and more.
constexpr double tolerance = 1e-9;

/// How a script is run.
struct Way {
  std::string name;
  MPI_Comm comm = MPI_COMM_WORLD;
  std::string newton = "on";
  double skin = 0.1;
  int threads = 0;          ///< 0: gran/eepa itself
  bool restarts = false;    ///< a restart after every run, alternately by one rank and by all
  bool setups = false;      ///< an additional set-up before every run
};

struct Result {
  std::vector<Particle> particles;
  std::vector<double>
      sums;    ///< forces on walls; number, largest overlaps and energies of contacts
};

class ScriptRun {
 public:
  /// \param mesh  file of its triangles
  ScriptRun(const RandomScript &script, const Way &way, const std::string &mesh) :
      script_(script), way_(way), fixes_(script.fixes)
  {
    if (!script.triangles.empty()) fixes_ = with(fixes_, "MESH", mesh);
    begin(way.comm);
    const std::string side = exact(-script.half - 0.5) + " " + exact(script.half + 0.5) + " ";
    std::string box;
    for (const std::size_t axis : {0, 2, 4})
      box += script.boundary[axis] == 'p' ? exact(-script.half) + " " + exact(script.half) + " "
                                          : side;
    now()("units si\natom_style sphere\natom_modify map array\nboundary " + script.boundary +
          "\nregion box block " + box + "\ncreate_box 2 box");
    now().create(script.spheres);
    now()(script.pair);
    settings();
  }

  Result result()
  {
    for (std::size_t k = 0; k < script_.stages.size(); k++) {
      const auto &stage = script_.stages[k];
      if (way_.setups) now().run(0);
      now().run(stage.steps);
      if (k + 1 == script_.stages.size()) break;
      now()(stage.then);
      if (way_.restarts) restart(k % 2 == 0 ? MPI_COMM_SELF : MPI_COMM_WORLD);
    }
    Result found{now().particles(), {}};
    for (const auto &wall : script_.walls) {
      const Vec3 force = now().wall_force(wall);
      found.sums.insert(found.sums.end(), force.data(), force.data() + 3);
    }
    double overlaps = 0.0, energy = 0.0;
    const auto contacts = now().contacts();
    for (const auto &c : contacts) {
      overlaps += c.max_overlap();
      energy += c.energy;
    }
    found.sums.insert(found.sums.end(), {static_cast<double>(contacts.size()), overlaps, energy});
    return found;
  }

 private:
  const RandomScript &script_;
  const Way &way_;
  std::string fixes_;
  std::unique_ptr<Simulation> simulation_;
  Simulation &now() { return *simulation_; }

  void begin(MPI_Comm comm)
  {
    simulation_ = std::make_unique<Simulation>(comm);
    if (way_.threads) now()("package omp " + std::to_string(way_.threads) + "\nsuffix omp");
    now()("newton " + way_.newton);
  }

  /// Commands of which neither the box nor a restart file keeps the effect.
  void settings()
  {
    now()("comm_modify vel yes\nneighbor " + exact(way_.skin) +
          " bin\nneigh_modify every 1 delay 0 check yes\n"
          "thermo 1000000\ntimestep 2e-4\n" +
          fixes_ + "fix integrate all nve/sphere");
    now().watch_contacts();
  }

  /// One rank reads what all ranks wrote: every rank does so for itself.
  void restart(MPI_Comm next)
  {
    const ScratchFile file(".restart");
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (now().comm() == MPI_COMM_WORLD || rank == 0) now()("write_restart " + file.name());
    MPI_Barrier(MPI_COMM_WORLD);
    begin(next);
    now()("read_restart " + file.name());
    settings();
    MPI_Barrier(MPI_COMM_WORLD);
  }
};

double difference(const Result &a, const Result &b)
{
  double worst = difference(a.particles, b.particles);
  double largest = 1.0;
  for (const double value : a.sums) largest = std::max(largest, std::abs(value));
  for (std::size_t k = 0; k < a.sums.size(); k++)
    worst = std::max(worst, std::abs(a.sums[k] - b.sums[k]) / largest);
  return std::isnan(worst) ? 1.0 : worst;
}

TEST(ParallelRandomScripts, GiveTheSameInEveryWay)
{
  int ranks, rank;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  unsigned first = 17, count = static_cast<unsigned>(std::max(2, 8 / ranks));
  const char *wanted = std::getenv("EEPA_RANDOM_SCRIPTS");
  if (wanted) std::istringstream(wanted) >> first >> count;
  std::vector<Way> ways(6);
  ways[0].name = std::to_string(ranks) + " ranks";
  ways[1].name = "newton off, another skin";
  ways[1].newton = "off";
  ways[1].skin = 0.23;
  ways[2].name = "threads";
  ways[2].threads = 2;
  ways[3].name = "restarts";
  ways[3].restarts = true;
  ways[4].name = "restarts with threads";
  ways[4].restarts = true;
  ways[4].threads = 3;
  ways[5].name = "set-ups";
  ways[5].setups = true;
  Way alone;
  alone.comm = MPI_COMM_SELF;

  double worst = 0.0;
  bool walls_move = false;
  for (unsigned seed = first; seed < first + count; seed++) {
    const RandomScript script(seed);
    walls_move = walls_move || script.walls_move;
    const ScratchFile mesh(".stl");
    if (!script.triangles.empty()) write_stl(mesh.name(), script.triangles);
    const auto result_of = [&](const Way &way) {
      return ScriptRun(script, way, mesh.name()).result();
    };
    SCOPED_TRACE("script " + std::to_string(seed) + "\n" + script.text());
    try {
      const Result expected = result_of(alone);
      for (const auto &way : ways) {
        const double found = difference(expected, result_of(way));
        EXPECT_LT(found, tolerance) << way.name;
        worst = std::max(worst, found);
      }
      const Way &way = ways[seed % 3];
      EXPECT_EQ(difference(result_of(way), result_of(way)), 0.0) << "twice: " << way.name;
    } catch (const std::exception &e) {
      ADD_FAILURE() << e.what();
    }
  }
  // a wall that has moved has to go through a restart
  EXPECT_TRUE(walls_move || wanted) << "no wall moves in these scripts: choose another first seed";
  if (rank == 0)
    std::printf("%u random scripts, %zu ways, worst %.1e\n", count, ways.size(), worst);
}

}    // namespace
