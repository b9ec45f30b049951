// SPDX-License-Identifier: GPL-2.0-only select(), any(), min, max and pow for a double and in each
// lane, and conversion between a driver's rows and lanes. Every lane has different numbers, and
// every row has neighbours that must not change.

#include "support.h"

#ifdef EEPA_HAS_LANES

namespace lane_rows_test {
using namespace eepa_test;

constexpr int width = static_cast<int>(Lanes::size());

/// first, first + step, ...
Lanes numbers(double first, double step = 1.0)
{
  return Lanes([&](auto lane) {
    return first + step * static_cast<double>(lane);
  });
}

/// A mask that holds in one lane; in none where there is no such lane.
Lanes::mask_type only(int lane)
{
  return numbers(0.0) == Lanes(static_cast<double>(lane));
}

/// A row for each lane, not in the order of the lanes, with other rows between them; all numbers
/// differ.
class Memory {
 public:
  static constexpr int stride = 11, first = 2;
  Memory()
  {
    for (std::size_t k = 0; k < values.size(); k++) values[k] = 0.5 + static_cast<double>(k);
    for (int lane = 0; lane < width; lane++) at[lane] = values.data() + offset(lane);
    for (int lane = 0; lane < width; lane++) read[lane] = at[lane];
  }
  Memory(const Memory &) = delete;
  static int offset(int lane) { return first + stride * ((lane + 1) % width); }
  double operator()(int lane, int k) const { return values[offset(lane) + k]; }

  /// Expects that nothing but the first `length` numbers of each row has changed.
  void expect_neighbours(int length) const
  {
    const Memory fresh;
    std::vector<double> inside = fresh.values;
    for (int lane = 0; lane < width; lane++)
      std::copy_n(at[lane], length, inside.begin() + offset(lane));
    EXPECT_EQ(values, inside);
  }

  std::vector<double> values = std::vector<double>(stride * width + first);
  LanePointers<double> at;
  LanePointers<const double> read;
};

TEST(Real, SelectTakesEachLaneFromItsSide)
{
  const Lanes a = numbers(1.0), b = numbers(-1.0, -1.0);
  const Vector3<Lanes> u(a, 10.0 * a, 100.0 * a), v(b, 10.0 * b, 100.0 * b);
  for (int chosen = 0; chosen < width; chosen++) {
    const Lanes one = select(only(chosen), a, b);
    const Vector3<Lanes> three = select(only(chosen), u, v);
    for (int lane = 0; lane < width; lane++) {
      const double sign = lane == chosen ? 1.0 : -1.0;
      EXPECT_EQ(one[lane], sign * (1.0 + lane));
      EXPECT_EQ(three[0][lane], sign * (1.0 + lane));
      EXPECT_EQ(three[1][lane], sign * (1.0 + lane) * 10.0);
      EXPECT_EQ(three[2][lane], sign * (1.0 + lane) * 100.0);
    }
  }
  EXPECT_EQ(select(true, 1.0, 2.0), 1.0);
  EXPECT_EQ(select(false, 1.0, 2.0), 2.0);
}

TEST(Real, AnyHoldsWhereOneLaneDoes)
{
  for (int lane = 0; lane < width; lane++) EXPECT_TRUE(any(only(lane)));
  EXPECT_FALSE(any(only(width)));
  EXPECT_TRUE(any(!only(width)));
  EXPECT_TRUE(any(true));
  EXPECT_FALSE(any(false));
}

TEST(Real, SmallerLargerAndPowersOfEachLane)
{
  // they cross: the first lanes have a below b, the last ones b below a
  const Lanes a = numbers(1.0), b = numbers(0.5 + width, -1.0);
  const Lanes low = eepa::min(a, b), high = eepa::max(a, b), power = eepa::pow(a, 1.3);
  for (int lane = 0; lane < width; lane++) {
    const double x = 1.0 + lane, y = 0.5 + width - lane;
    EXPECT_EQ(low[lane], std::min(x, y));
    EXPECT_EQ(high[lane], std::max(x, y));
    EXPECT_EQ(eepa::min(x, y), std::min(x, y));
    EXPECT_EQ(eepa::max(x, y), std::max(x, y));
    EXPECT_EQ(power[lane], std::pow(x, 1.3));
    EXPECT_EQ(eepa::pow(x, 1.3), std::pow(x, 1.3));
  }
}

TEST(LaneRows, GatherTheNumbersOfTheirLane)
{
  const Memory memory;
  const Lanes one = gather_numbers(memory.read);
  const Vector3<Lanes> three = gather_rows(memory.read);
  const std::array<Lanes, 4> four = gather_rows_of_4(memory.at);
  for (int lane = 0; lane < width; lane++) {
    EXPECT_EQ(one[lane], memory(lane, 0));
    for (int k = 0; k < 3; k++) EXPECT_EQ(three[k][lane], memory(lane, k)) << lane << " " << k;
    for (int k = 0; k < 4; k++) EXPECT_EQ(four[k][lane], memory(lane, k)) << lane << " " << k;
  }
}

TEST(LaneRows, ScatterIntoTheRowOfTheirLaneAlone)
{
  Memory memory;
  const std::array<Lanes, 4> column = {numbers(100.0), numbers(200.0), numbers(300.0),
                                       numbers(400.0)};
  scatter_rows_of_4(column, memory.at);
  for (int lane = 0; lane < width; lane++)
    for (int k = 0; k < 4; k++)
      EXPECT_EQ(memory(lane, k), 100.0 * (k + 1) + lane) << lane << " " << k;
  memory.expect_neighbours(4);
}

TEST(LaneRows, EachOperationKeepsToItsRow)
{
  const LaneRows rows(Vector3<Lanes>(numbers(100.0), numbers(200.0), numbers(300.0)));
  const Memory before;
  Memory sum, difference, stored;
  for (int lane = 0; lane < width; lane++) {
    rows.add_to(sum.at[lane], lane);
    rows.subtract_from(difference.at[lane], lane);
    rows.store(stored.at[lane], lane);
    for (int k = 0; k < 3; k++) {
      const double own = 100.0 * (k + 1) + lane;
      EXPECT_EQ(sum(lane, k), before(lane, k) + own) << lane << " " << k;
      EXPECT_EQ(difference(lane, k), before(lane, k) - own) << lane << " " << k;
      EXPECT_EQ(stored(lane, k), own) << lane << " " << k;
      EXPECT_EQ(rows[lane][k], own) << lane << " " << k;
    }
  }
  for (const Memory *memory : {&sum, &difference, &stored}) memory->expect_neighbours(3);
}

TEST(LaneRows, AddSubtractAndStoreTheRowOfTheirLane)
{
  const LaneRows rows(Vector3<Lanes>(numbers(1.0), numbers(10.0), numbers(100.0)));
  for (int l = 0; l < width; l++) {
    double row[5] = {1.0, 2.0, 3.0, 4.0, 5.0};
    rows.add_to(row, l);
    rows.subtract_from(row + 1, l);
    EXPECT_EQ(row[0], 2.0 + l);
    EXPECT_EQ(row[1], 2.0 + 10.0 + l - (1.0 + l));
    EXPECT_EQ(row[2], 3.0 + 100.0 + l - (10.0 + l));
    EXPECT_EQ(row[3], 4.0 - (100.0 + l));
    EXPECT_EQ(row[4], 5.0);
    EXPECT_EQ(rows[l], Vec3(1.0 + l, 10.0 + l, 100.0 + l));
  }
}

// a row as LAMMPS leaves it when i and j change places: every sign changed
template <class Layout> void expect_history_of_each_lane(double sign)
{
  Memory memory;
  for (double &value : memory.values) value *= sign;
  const HistoryOf<Lanes> loaded = load_history<Layout>(memory.at);
  for (int lane = 0; lane < width; lane++) {
    EXPECT_EQ(loaded.max_overlap[lane], std::fabs(memory(lane, MAX_OVERLAP)));
    for (int k = 0; k < 3; k++) {
      EXPECT_EQ(loaded.tangential_spring[k][lane], memory(lane, TANGENTIAL_SPRING + k));
      EXPECT_EQ(loaded.rolling_spring[k][lane],
                Layout::rolling ? memory(lane, ROLLING_SPRING + k) : 0.0);
    }
    // a twist does not change its sign with i and j
    EXPECT_EQ(loaded.twisting_spring[lane],
              Layout::twisting ? sign * memory(lane, Layout::twisting_spring) : 0.0);
  }
}

TEST(LaneHistory, IsReadWithTheMagnitudeOfTheOverlap)
{
  for (const double sign : {1.0, -1.0}) {
    expect_history_of_each_lane<HistoryLayout<false, false>>(sign);
    expect_history_of_each_lane<HistoryLayout<false, true>>(sign);
    expect_history_of_each_lane<HistoryLayout<true, false>>(sign);
    expect_history_of_each_lane<HistoryLayout<true, true>>(sign);
  }
}

template <class Layout> void expect_stored_history_of_each_lane()
{
  HistoryOf<Lanes> history;
  history.max_overlap = numbers(100.0);
  history.tangential_spring = Vector3<Lanes>(numbers(200.0), numbers(300.0), numbers(400.0));
  history.rolling_spring = Vector3<Lanes>(numbers(500.0), numbers(600.0), numbers(700.0));
  history.twisting_spring = numbers(Layout::rolling ? 800.0 : 500.0);
  Memory memory;
  store_history<Layout>(history, memory.at);
  const int size = Layout::size;
  for (int lane = 0; lane < width; lane++)
    for (int k = 0; k < size; k++)
      EXPECT_EQ(memory(lane, k), 100.0 * (k + 1) + lane) << lane << " " << k;
  memory.expect_neighbours(size);
}

TEST(LaneHistory, IsStoredInTheRowOfItsLaneAlone)
{
  expect_stored_history_of_each_lane<HistoryLayout<false, false>>();
  expect_stored_history_of_each_lane<HistoryLayout<false, true>>();
  expect_stored_history_of_each_lane<HistoryLayout<true, false>>();
  expect_stored_history_of_each_lane<HistoryLayout<true, true>>();
}

}    // namespace lane_rows_test

#endif
