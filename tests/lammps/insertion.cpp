// SPDX-License-Identifier: GPL-2.0-only

// Particles that are inserted and deleted in mid-run: a new particle has no history, wherever it is
// inserted, and the remaining ones keep theirs. On 1, 2 and 4 ranks.

#include "packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace eepa_test;

namespace {

constexpr const char *coefficients = "1e4 4e4 5e3 -1 0.5 restitution 0.7 rolling sds 1e3 1 0.1";

/// A packing on two walls that has loaded and unloaded.
void open(Simulation &simulation, const std::string &newton)
{
  Packing packing;
  packing.side = 5;
  packing.speed = 2.0;
  simulation.open_box(packing.half() + 0.5, 1, "f f f", newton);
  simulation.create(packing.spheres());
  const std::string wall = exact(packing.half());
  simulation(std::string("pair_style gran/eepa linear\npair_coeff * * ") + coefficients +
             "\nfix integrate all nve/sphere\ntimestep 2e-4");
  for (const std::string plane : {"xplane", "yplane", "zplane"})
    simulation("fix " + plane + " all wall/gran/eepa linear coeff " + coefficients + " wall " +
               plane + " -" + wall + " " + wall + " contacts");
  simulation.watch_contacts();
}

typedef std::map<std::pair<int, int>, PairContact> Contacts;
Contacts by_pair(const Simulation &simulation)
{
  Contacts found;
  for (const auto &c : simulation.contacts()) found.insert({std::minmax(c.i, c.j), c});
  return found;
}

class ParallelReplacement : public testing::TestWithParam<const char *> {};

// Every third particle is deleted and a new one is inserted at its position.
TEST_P(ParallelReplacement, GivesVirginContactsAndKeepsTheOthers)
{
  Simulation simulation;
  open(simulation, GetParam());
  simulation.run(150);
  simulation.run(0);
  const auto before = simulation.particles();
  const auto contacts_before = by_pair(simulation);
  int worn = 0;
  for (const auto &[ids, c] : contacts_before) worn += c.max_overlap() > 1.01 * c.overlap();
  EXPECT_GT(worn, 50);
  std::map<int, std::vector<double>> walls_before;
  for (const auto &p : before) walls_before[p.id] = simulation.fix_row("xplane", p.id);

  simulation("group gone id 1:125:3\ndelete_atoms group gone compress no");
  std::map<int, int> place;    // of a new particle: the one that was there
  int id = 125;
  for (const auto &p : before) {
    if (p.id % 3 != 1) continue;
    const std::string x = exact(p.x.x()) + " " + exact(p.x.y()) + " " + exact(p.x.z());
    simulation("create_atoms 1 single " + x + " units box");
    place[++id] = p.id;
  }
  simulation("group new id > 125\nset group new diameter 1\nset group new density " +
             exact(unit_density));
  simulation.run(0);
  int virgin = 0, kept = 0;
  for (const auto &[ids, c] : by_pair(simulation)) {
    const bool fresh = ids.second > 125;
    if (fresh) {
      EXPECT_EQ(c.max_overlap(), c.overlap()) << ids.first << " " << ids.second;
      EXPECT_EQ(c.branch(), 1.0);
      EXPECT_EQ(c.p[12], 0.0);    // tangential and rolling spring
      EXPECT_EQ(c.p[13], 0.0);
      virgin++;
    } else {
      const auto &old = contacts_before.at(ids);
      EXPECT_EQ(c.max_overlap(), old.max_overlap());
      EXPECT_EQ(c.p[12], old.p[12]);
      EXPECT_EQ(c.p[13], old.p[13]);
      kept++;
    }
  }
  EXPECT_GT(virgin, 50);
  EXPECT_GT(kept, 50);
  int at_wall = 0, walls_worn = 0;
  for (const auto &p : simulation.particles()) {
    const auto row = simulation.fix_row("xplane", p.id);
    ASSERT_EQ(row.size(), 11u);
    if (p.id > 125 && row[0] > 0.0) {
      EXPECT_EQ(row[8], row[7]);    // delta_max and delta
      EXPECT_EQ(row[9], 1.0);
      const auto &old = walls_before.at(place.at(p.id));
      walls_worn += old[0] > 0.0 && old[8] > 1.01 * old[7];
      at_wall++;
    } else if (p.id <= 125) {
      EXPECT_EQ(row[8], walls_before.at(p.id)[8]);
    }
  }
  EXPECT_GT(at_wall, 3);
  EXPECT_GT(walls_worn, 1);
  simulation.run(50);
  EXPECT_EQ(simulation.particles().size(), 125u);
}
INSTANTIATE_TEST_SUITE_P(Newton, ParallelReplacement, testing::Values("on", "off"));

// A new particle with a used ID does not get the history of the particle that had it before.
TEST_P(ParallelReplacement, OfTheLastIdGivesAVirginContact)
{
  Simulation simulation;
  open(simulation, GetParam());
  simulation.run(150);
  simulation.run(0);
  const Vec3 x = simulation.particle(125).x;
  int worn = 0;
  for (const auto &[ids, c] : by_pair(simulation))
    worn += ids.second == 125 && c.max_overlap() > 1.01 * c.overlap();
  EXPECT_GT(worn, 0);
  simulation("group gone id 125\ndelete_atoms group gone compress no\ncreate_atoms 1 single " +
             exact(x.x()) + " " + exact(x.y()) + " " + exact(x.z()) +
             " units box\ngroup new id 125\nset group new diameter 1\nset group new density " +
             exact(unit_density));
  simulation.run(0);
  int virgin = 0, kept = 0;
  for (const auto &[ids, c] : by_pair(simulation)) {
    if (ids.second == 125) {
      EXPECT_EQ(c.max_overlap(), c.overlap());
      EXPECT_EQ(c.p[12], 0.0);
      virgin++;
    } else {
      kept += c.max_overlap() > 1.01 * c.overlap();
    }
  }
  EXPECT_GT(virgin, 0);
  EXPECT_GT(kept, 50);
}

// LAMMPS renumbers the rest by default, and keeps histories by ID: they would go to other
// particles.
TEST_P(ParallelReplacement, RenumberedIdsAreRefused)
{
  constexpr const char *message = "pair_style gran/eepa: atom IDs were renumbered while there were "
                                  "contacts.*use delete_atoms with compress no";
  for (const char *renumber : {"group gone id 7\ndelete_atoms group gone",
                               "reset_atoms id sort yes\ndelete_atoms group all compress yes",
                               "reset_atoms id sort yes"}) {
    Simulation simulation;
    open(simulation, GetParam());
    simulation.run(150);
    simulation(renumber);
    if (simulation.particles().empty())
      EXPECT_EQ(error_of(simulation, "run 0"), "");    // no particle has a history
    else
      EXPECT_TRUE(refuses(simulation, "run 0", message)) << renumber;
  }
  const ScratchFile file(".restart");
  Simulation simulation, restarted;
  open(simulation, GetParam());
  simulation.run(150);
  simulation("write_restart " + file.name());
  restarted("read_restart " + file.name() +
            "\ncomm_modify vel yes\nneighbor 0.1 bin\nfix integrate all nve/sphere\n"
            "group gone id 7\ndelete_atoms group gone");
  EXPECT_TRUE(refuses(restarted, "run 0",
                      "atoms were deleted, or given other IDs, after read_restart and before the "
                      "first run.*put run 0 before that command"));
}

// The pair's histories would be found under the new IDs all the same, in one order or the other.
TEST(Insertion, SeesRenumberingThatLeavesPairsOfIds)
{
  constexpr const char *message = "atom IDs were renumbered while there were contacts";
  // the two of the contact change their IDs
  const std::string start = std::string("pair_style gran/eepa linear\npair_coeff * * ") +
      coefficients + "\nfix integrate all nve/sphere\ntimestep 2e-4\nrun 60 post no\n";
  Simulation swapped;
  swapped.open_box(3.0);
  swapped.create({{Vec3(0.49, 0, 0), Vec3(-1, 0, 0)}, {Vec3(-0.49, 0, 0), Vec3(1, 0, 0)}});
  swapped(start);
  EXPECT_TRUE(refuses(swapped, "reset_atoms id sort yes\nrun 0", message));
  // the particles before them are deleted, and they move up
  Simulation moved_up;
  moved_up.open_box(3.0);
  moved_up.create({{Vec3(0, 2, 0)}, {Vec3(0, -2, 0)}, {Vec3(-0.49, 0, 0)}, {Vec3(0.49, 0, 0)}});
  moved_up(start);
  EXPECT_TRUE(refuses(moved_up, "group far id 1 2\ndelete_atoms group far\nrun 0", message));
}

// Spheres that touch to rounding, across a boundary on one side only.
TEST(Insertion, TakesNoContactOfRoundingForRenumbering)
{
  Simulation simulation;
  simulation.open_box(5.0, 1, "p p p", "off");
  simulation("lattice sc 1.0 origin 0.05 0.05 0.05\ncreate_atoms 1 box\n"
             "set group all diameter 1 density 1\npair_style gran/eepa linear\npair_coeff * * " +
             std::string(coefficients) + "\nfix integrate all nve/sphere\ntimestep 1e-5");
  EXPECT_EQ(error_of(simulation, "run 1\nrun 1"), "");
}

// In one step of a run a particle is deleted and another is inserted with its ID at its position.
class ParallelReusedId : public testing::TestWithParam<const char *> {};

TEST_P(ParallelReusedId, HasNoHistory)
{
  // on either side of its partner; on several ranks z = 0 separates the two
  for (const double side : {-1.0, 1.0}) {
    Simulation simulation;
    simulation.open_box(3.0, 1, "f f f", GetParam());
    simulation.create({{Vec3(0, 0, -0.47 * side)}, {Vec3(0, 0, 0.5 * side)}});
    simulation.set_velocity(2, Vec3(0, 0.5, -1.5 * side));
    simulation("group moving id 2\npair_style gran/eepa linear\npair_coeff * * " +
               std::string(coefficients) + "\nfix integrate all nve/sphere\ntimestep 2e-4");
    simulation.watch_contacts();
    simulation.run(60);
    simulation("velocity all set 0 0 0");
    simulation.run(0);
    const double before = simulation.contacts().at(0).max_overlap();
    const std::string at = exact(0.5 * side), to = exact(0.51 * side);
    simulation(std::string("region there block -0.5 0.5 -0.5 0.5 ") +
               (side > 0 ? "0.2 0.9" : "-0.9 -0.2") +
               "\nregion spot block -0.005 0.005 -0.005 0.005 " +
               (side > 0 ? at + " " + to : to + " " + at) +
               "\nfix goes moving evaporate 1 1 there 123\n"
               "fix comes all deposit 1 1 1000 777 region spot units box");
    simulation.run(1);
    ASSERT_EQ(simulation.particles().size(), 2u);
    const auto contacts = simulation.contacts();
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].j + contacts[0].i, 3);
    EXPECT_GT(before, 1.2 * contacts[0].overlap());
    EXPECT_LT(contacts[0].max_overlap(), 1.001 * contacts[0].overlap());
  }
}
INSTANTIATE_TEST_SUITE_P(Newton, ParallelReusedId, testing::Values("on", "off"));

// Particles that are inserted and deleted during a run: their number is right, values are finite,
// each history belongs to its contact, and other numbers of ranks give the same.
class ParallelInsertion : public testing::TestWithParam<const char *> {
 protected:
  static std::vector<Particle> rain(MPI_Comm comm, const std::string &newton,
                                    const std::string &inserting, int *highest)
  {
    Simulation simulation(comm);
    simulation.open_box(3.0, 1, "p p f", newton);
    Packing packing;
    packing.side = 4;
    packing.spacing = 1.2;
    packing.speed = 1.0;
    auto spheres = packing.spheres();
    for (auto &s : spheres) s.x.z() -= 0.6;
    simulation.create(spheres);
    simulation(std::string("pair_style gran/eepa linear\npair_coeff * * ") + coefficients +
               "\nfix integrate all nve/sphere\nfix gravity all gravity 30 vector 0 0 -1\n"
               "timestep 5e-4\nfix floor all wall/gran/eepa linear coeff " +
               coefficients + " wall zplane -3 3 contacts\n" + inserting);
    simulation.watch_contacts();
    *highest = 0;
    for (int k = 0; k < 4; k++) {
      simulation.run(200);
      for (const auto &p : simulation.particles()) {
        *highest = std::max(*highest, p.id);
        EXPECT_TRUE(p.x.allFinite() && p.v.allFinite() && p.omega.allFinite());
      }
      for (const auto &c : simulation.contacts())
        EXPECT_GE(c.max_overlap(), c.overlap() * (1 - 1e-12));
    }
    EXPECT_GT(simulation.contacts().size(), 10u);
    return simulation.particles();
  }
  void same_on_all_ranks(const std::string &inserting, int least)
  {
    int highest = 0, again = 0;
    const auto a = rain(MPI_COMM_SELF, "on", inserting, &highest);
    const auto b = rain(MPI_COMM_WORLD, GetParam(), inserting, &again);
    EXPECT_EQ(highest, again);
    EXPECT_GE(highest, least);
    EXPECT_LT(difference(a, b), 1e-8);
  }
};

TEST_P(ParallelInsertion, FixPour)
{
  same_on_all_ranks("region slab block -2.9 2.9 -2.9 2.9 1.2 2.9\n"
                    "fix pour all pour 40 1 4767 region slab diam one 1.0 dens 1.9098593171027443 "
                    "1.9098593171027443 vol 0.3 60",
                    84);
}

TEST_P(ParallelInsertion, FixDeposit)
{
  same_on_all_ranks(
      "region slab block -2.9 2.9 -2.9 2.9 1.8 2.4\n"
      "fix deposit all deposit 30 1 20 4767 region slab near 1.05 attempt 200 vz -2 -1 "
      "units box",
      80);
}

// Fix evaporate chooses atoms by rank, so that no two runs are compared. Wall and pair histories of
// the remaining particles must move along when deleted ones leave their slots in the arrays.
TEST_P(ParallelInsertion, FixEvaporateAndDeposit)
{
  int highest = 0;
  const auto end =
      rain(MPI_COMM_WORLD, GetParam(),
           "region low block -3 3 -3 3 -3 -1\nregion slab block -2.9 2.9 -2.9 2.9 1.8 2.4\n"
           "fix evaporate all evaporate 40 2 low 49892\n"
           "fix deposit all deposit 40 1 15 4767 region slab near 1.05 attempt 200 vz -2 -1 units "
           "box",
           &highest);
  EXPECT_GT(highest, 80);
  EXPECT_LT(end.size(), static_cast<std::size_t>(highest));
  std::set<int> ids;
  for (const auto &p : end) ids.insert(p.id);
  EXPECT_EQ(ids.size(), end.size());
}

// A fix that is defined before the pair style deletes and inserts particles before histories are
// taken from the neighbour list, which holds local indices. By then other particles have these
// indices, and new particles those of ghosts.
TEST_P(ParallelInsertion, ByFixesBeforeThePairStyle)
{
  const std::string evaporate = "fix evaporate all evaporate 20 3 everywhere 49892\n";
  const std::string deposit = "fix deposit all deposit 15 1 20 4767 region everywhere near 0.8 "
                              "attempt 200 units box\n";
  const struct {
    std::string before, after;
  } orders[] = {{"", evaporate + deposit}, {evaporate, deposit}, {evaporate + deposit, ""}};
  std::vector<Particle> first;
  for (const auto &order : orders) {
    Packing packing;
    packing.side = 5;
    packing.speed = 2.0;
    Simulation simulation;
    simulation.open_box(packing.half(), 1, "p p p", GetParam());
    simulation.create(packing.spheres());
    simulation("region everywhere block EDGE EDGE EDGE EDGE EDGE EDGE\n" + order.before +
               "pair_style gran/eepa linear\npair_coeff * * " + coefficients +
               "\nfix integrate all nve/sphere\ntimestep 2e-4\n" + order.after);
    simulation.run(400);
    const auto end = simulation.particles();
    if (first.empty()) first = end;
    EXPECT_LT(end.size(), 110u);
    EXPECT_GT(end.back().id, 125);
    EXPECT_EQ(difference(first, end), 0.0) << order.before;
  }
}
INSTANTIATE_TEST_SUITE_P(Newton, ParallelInsertion, testing::Values("on", "off"));

// Without particles of the kind that pour brings, the neighbour cutoff must reach for them.
TEST(Insertion, OfTheFirstParticlesIsSeen)
{
  Simulation simulation;
  simulation.open_box(3.0, 1, "p p f");
  simulation(std::string("pair_style gran/eepa linear\npair_coeff * * ") + coefficients +
             "\nfix integrate all nve/sphere\nfix gravity all gravity 30 vector 0 0 -1\n"
             "timestep 5e-4\nfix floor all wall/gran/eepa linear coeff " +
             coefficients +
             " wall zplane -3 NULL\nregion slab block -2.9 2.9 -2.9 2.9 1.2 2.9\n"
             "fix pour all pour 60 1 4767 region slab diam one 1.0 dens 1.9098593171027443 "
             "1.9098593171027443 vol 0.3 60");
  simulation.watch_contacts();
  simulation.run(1200);
  EXPECT_EQ(simulation.particles().size(), 60u);
  const auto contacts = simulation.contacts();
  EXPECT_GT(contacts.size(), 30u);
  for (const auto &c : contacts) EXPECT_LT(c.overlap(), 0.2);
}

}    // namespace
