// SPDX-License-Identifier: GPL-2.0-only

// One program for every number of ranks: MPI starts once, rank 0 reports, and the other ranks print
// only their failures.

#include "library.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>

namespace {
class FailuresOfOneRank : public testing::EmptyTestEventListener {
 public:
  explicit FailuresOfOneRank(int rank) : rank_(rank) {}
  void OnTestStart(const testing::TestInfo &test) override { test_ = &test; }
  void OnTestPartResult(const testing::TestPartResult &result) override
  {
    if (!result.failed()) return;
    // to ask GoogleTest which test this is would wait for a lock that it holds while it calls
    std::fprintf(stderr, "rank %d: %s.%s: %s:%d: %s\n", rank_,
                 test_ ? test_->test_suite_name() : "?", test_ ? test_->name() : "?",
                 result.file_name() ? result.file_name() : "?", result.line_number(),
                 result.message());
  }

 private:
  int rank_;
  const testing::TestInfo *test_ = nullptr;
};
}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  auto &listeners = testing::UnitTest::GetInstance()->listeners();
  if (rank != 0) {
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FailuresOfOneRank(rank));
  }
  const int mine = RUN_ALL_TESTS();
  int worst;
  MPI_Allreduce(&mine, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  lammps_kokkos_finalize();    // nothing where KOKKOS was not in use
  MPI_Finalize();
  return worst;
}
