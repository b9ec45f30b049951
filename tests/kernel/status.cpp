// SPDX-License-Identifier: GPL-2.0-only
// The integer beside each neighbour: 0 where there is no contact, else its branch and whether it slides.

#include "support.h"

#include <set>

namespace status_test {
using namespace eepa_test;

Response response(Branch branch, bool sliding)
{
  Response r{};
  r.branch = branch;
  r.sliding = sliding;
  return r;
}

TEST(Status, TellsBranchAndSlidingOfAContact)
{
  std::set<int> different;
  for (const Branch branch : {Branch::loading, Branch::unloading, Branch::adhesive}) {
    for (const bool sliding : {false, true}) {
      const int status = ContactStatus::of(response(branch, sliding));
      // LAMMPS asks whether it is 0, and sets `touching` itself
      EXPECT_EQ(status & ContactStatus::touching, ContactStatus::touching);
      EXPECT_EQ(ContactStatus::branch(status), branch);
      EXPECT_EQ(ContactStatus::slides(status), sliding);
      different.insert(status);
    }
  }
  EXPECT_EQ(different.size(), 6u);
  EXPECT_FALSE(ContactStatus::slides(ContactStatus::touching));
  EXPECT_EQ(ContactStatus::none, 0);
  EXPECT_EQ(ContactStatus::touching, 1);    // what LAMMPS's fix writes
}

#ifdef EEPA_HAS_LANES
TEST(Status, OfEveryLaneIsThatOfTheContactAlone)
{
  constexpr int width = static_cast<int>(Lanes::size());
  const Branch branches[] = {Branch::adhesive, Branch::loading, Branch::unloading};
  for (int turn = 0; turn < 6; turn++) {
    const auto branch = [&](int l) {
      return branches[(l + turn) % 3];
    };
    const auto slides = [&](int l) {
      return (l + turn) % 2 == 1;
    };
    ResponseOf<Lanes> r;
    r.branch = Lanes([&](auto l) {
      return static_cast<double>(static_cast<int>(branch(l)));
    });
    r.sliding = Lanes([&](auto l) {
                  return slides(l) ? 1.0 : 0.0;
                }) > 0.0;
    std::vector<int> status(width + 2, -7);
    LanePointers<int> at;
    for (int l = 0; l < width; l++) at[l] = &status[1 + (l + 1) % width];
    ContactStatus::store(r, at);
    for (int l = 0; l < width; l++)
      EXPECT_EQ(*at[l], ContactStatus::of(response(branch(l), slides(l)))) << turn << " " << l;
    EXPECT_EQ(status.front(), -7);
    EXPECT_EQ(status.back(), -7);
  }
}
#endif

}    // namespace status_test
