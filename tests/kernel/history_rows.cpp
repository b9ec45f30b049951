// SPDX-License-Identifier: GPL-2.0-only

// A history has the same values in every kind of row that a driver may use.

#include <eepa/history.h>

#include <gtest/gtest.h>

#include <vector>

namespace history_rows_test {
using namespace eepa;

template <class Layout> History filled()
{
  History history;
  history.max_overlap = 0.5;
  history.tangential_spring = Vec3(1.0, -2.0, 3.0);
  if (Layout::rolling) history.rolling_spring = Vec3(-4.0, 5.0, 6.0);
  if (Layout::twisting) history.twisting_spring = -7.0;
  return history;
}

void expect_same(const History &a, const History &b)
{
  EXPECT_EQ(a.max_overlap, b.max_overlap);
  EXPECT_EQ(a.tangential_spring, b.tangential_spring);
  EXPECT_EQ(a.rolling_spring, b.rolling_spring);
  EXPECT_EQ(a.twisting_spring, b.twisting_spring);
}

template <class Layout> class HistoryRows : public testing::Test {
};
using Layouts = testing::Types<HistoryLayout<false, false>, HistoryLayout<true, false>,
                               HistoryLayout<false, true>, HistoryLayout<true, true>>;
TYPED_TEST_SUITE(HistoryRows, Layouts, );

TYPED_TEST(HistoryRows, EveryKindOfRowGivesBackWhatItGot)
{
  const History history = filled<TypeParam>();
  constexpr int size = TypeParam::size, contacts = 5, mine = 3;
  constexpr double untouched = 99.0;

  std::vector<double> raw(size + 1, untouched);
  store_history<TypeParam>(history, raw.data());
  expect_same(load_history<TypeParam>(static_cast<const double *>(raw.data())), history);
  EXPECT_EQ(raw[size], untouched);

  std::vector<double> views(size * contacts, untouched);
  const StridedRow<double> strided = {views.data() + mine, contacts};
  store_history<TypeParam>(history, strided);
  expect_same(load_history<TypeParam>(strided), history);

  constexpr int quads_of_one = size > 4 ? 2 : 1;
  std::vector<Quad> quads(quads_of_one * contacts,
                          Quad{{untouched, untouched, untouched, untouched}});
  const QuadRow<Quad> quad = {quads.data() + mine, contacts};
  store_history<TypeParam>(history, quad);
  expect_same(load_history<TypeParam>(QuadRow<const Quad>{quad.first, quad.stride}), history);

  // each value is at its HistoryIndex, and values of other rows are unchanged
  for (int k = 0; k < size; k++) {
    EXPECT_EQ(strided[k], raw[k]) << k;
    EXPECT_EQ(quad[k], raw[k]) << k;
  }
  for (int other = 0; other < contacts; other++) {
    if (other == mine) continue;
    for (int k = 0; k < size; k++) {
      EXPECT_EQ(views[k * contacts + other], untouched);
      EXPECT_EQ(quads[k / 4 * contacts + other].value[k % 4], untouched);
    }
  }
}

TYPED_TEST(HistoryRows, SignsThatLammpsTurnedAreReadAlike)
{
  const History history = filled<TypeParam>();
  std::vector<double> views(TypeParam::size);
  const StridedRow<double> row = {views.data(), 1};
  store_history<TypeParam>(history, row);
  for (double &value : views) value = -value;
  const History turned = load_history<TypeParam>(row);
  EXPECT_EQ(turned.max_overlap, history.max_overlap);
  EXPECT_EQ(turned.tangential_spring, -history.tangential_spring);
  EXPECT_EQ(turned.rolling_spring, -history.rolling_spring);
  EXPECT_EQ(turned.twisting_spring, history.twisting_spring);
}

}    // namespace history_rows_test
