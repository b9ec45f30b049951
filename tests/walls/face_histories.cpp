// SPDX-License-Identifier: GPL-2.0-only

// Histories of particles with a wall against a map of lists, through all that LAMMPS does with particles.

#include "support.h"

#include <eepa_walls/face_histories.h>

#include <map>
#include <numeric>

namespace face_histories_test {
using namespace eepa_walls_test;

constexpr int particles = 40;

FaceHistory contact(Random &random)
{
  FaceHistory made;
  made.face = random.below(1000);
  made.distance = random.between(0, 1);
  made.values[max_history_size - 1] = random.between(0, 1);
  return made;
}

void expect_same(const FaceHistories &histories,
                 const std::map<int, std::vector<FaceHistory>> &expected)
{
  for (int i = 0; i < particles; ++i) {
    const auto found = expected.find(i);
    const std::size_t size = found == expected.end() ? 0 : found->second.size();
    ASSERT_EQ(histories.has_some(i), size > 0) << i;
    const FaceHistories::List &list = histories.list(i);
    ASSERT_EQ(list.size(), size) << i;
    ASSERT_EQ(list.empty(), size == 0) << i;
    for (std::size_t k = 0; k < size; ++k) {
      EXPECT_EQ(list[k].face, found->second[k].face);
      EXPECT_EQ(list[k].distance, found->second[k].distance);
      EXPECT_EQ(list[k].values, found->second[k].values);
    }
  }
}

TEST(FaceHistories, AreThoseOfAMapOfLists)
{
  Random random(12);
  FaceHistories histories;
  histories.grow(particles);
  std::map<int, std::vector<FaceHistory>> expected;
  std::vector<int> all(particles);
  std::iota(all.begin(), all.end(), 0);
  int longest = 0;
  for (int n = 0; n < 20000; ++n) {
    const int i = random.below(particles), j = random.below(particles);
    switch (random.below(6)) {
      case 0:
      case 1:
      case 2: {
        if (expected[i].size() > 5) break;
        const FaceHistory made = contact(random);
        histories.mutable_list(i).push_back(made);
        expected[i].push_back(made);
        longest = std::max(longest, static_cast<int>(expected[i].size()));
        break;
      }
      case 3: {    // one of its contacts opens
        if (expected[i].empty()) break;
        const std::size_t gone = random.below(static_cast<int>(expected[i].size()));
        auto &list = histories.mutable_list(i);
        for (std::size_t k = gone; k + 1 < list.size(); ++k) list[k] = list[k + 1];
        list.truncate(list.size() - 1);
        histories.release(i);
        expected[i].erase(expected[i].begin() + static_cast<std::ptrdiff_t>(gone));
        break;
      }
      case 4:
        if (n % 2 == 0) {
          histories.clear(i);
          expected[i].clear();
        } else {
          histories.copy(i, j);
          const auto copied = expected[i];
          expected[j] = copied;
        }
        break;
      default: {    // all but one, which is gone
        random.shuffle(all);
        expected[all.back()].clear();
        histories.arrange({all.begin(), all.end() - 1});
      }
    }
    if (n % 50 == 0) expect_same(histories, expected);
  }
  expect_same(histories, expected);
  EXPECT_EQ(longest, 6);
}

// Contacts wait for others to be evaluated with, and are pointed to meanwhile.
TEST(FaceHistories, StayWhereTheyAreAfterTheyWereArranged)
{
  Random random(13);
  FaceHistories histories;
  histories.grow(particles);
  std::vector<int> asked;
  for (int i = particles - 1; i >= 0; i -= 2) asked.push_back(i);
  for (const int i : {3, 17, 31}) histories.mutable_list(i).push_back(contact(random));
  histories.arrange(asked);
  // in the order asked for
  EXPECT_EQ(&histories.list(31) + 1, &histories.list(17));
  EXPECT_EQ(&histories.list(17) + 1, &histories.list(3));
  const FaceHistory *first = &histories.list(17)[0];
  for (const int i : asked) histories.mutable_list(i).push_back(contact(random));
  EXPECT_EQ(first, &histories.list(17)[0]);
  EXPECT_EQ(histories.list(17).size(), 2u);
}

}    // namespace face_histories_test
