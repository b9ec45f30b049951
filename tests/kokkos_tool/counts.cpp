// SPDX-License-Identifier: GPL-2.0-only

// A library for Kokkos's tool interface, which Kokkos loads where the environment has its path as KOKKOS_TOOLS_LIBS. It
// counts what tests ask about. On a host's back end host and device share their memory, so that only Kokkos itself can say
// what would have been copied.

#include "counts.h"

#include <cstdint>
#include <cstring>
#include <map>
#include <string>

namespace {
std::map<std::string, unsigned long long> counts[EEPA_N_COUNTS];

void add(EepaCount count, const char *name, unsigned long long more)
{
  counts[count][name] += more;
}
}    // namespace

extern "C" {

struct Kokkos_Profiling_SpaceHandle {
  char name[64];
};

unsigned long long eepa_counted(EepaCount count, const char *name)
{
  unsigned long long sum = 0;
  for (const auto &[key, number] : counts[count])
    if (key.find(name) != std::string::npos) sum += number;
  return sum;
}

void eepa_reset_counts()
{
  for (auto &count : counts) count.clear();
}

void kokkosp_begin_parallel_for(const char *name, std::uint32_t, std::uint64_t *)
{
  add(EEPA_KERNELS, name, 1);
}
void kokkosp_begin_parallel_reduce(const char *name, std::uint32_t, std::uint64_t *)
{
  add(EEPA_KERNELS, name, 1);
}
void kokkosp_begin_parallel_scan(const char *name, std::uint32_t, std::uint64_t *)
{
  add(EEPA_KERNELS, name, 1);
}
void kokkosp_push_profile_region(const char *name)
{
  add(EEPA_REGIONS, name, 1);
}
void kokkosp_begin_deep_copy(Kokkos_Profiling_SpaceHandle to_space, const char *to, const void *,
                             Kokkos_Profiling_SpaceHandle from_space, const char *from,
                             const void *, std::uint64_t bytes)
{
  for (const char *number : {"Scalar", "(none)"})
    if (std::strcmp(from, number) == 0) return;    // a view is filled
  if (std::strcmp(from, to) == 0) return;          // it gets larger memory
  const bool within = std::strcmp(to_space.name, from_space.name) == 0;
  if (within && std::strncmp(to_space.name, "Host", 4) != 0) return;
  add(EEPA_COPIED_BYTES, to, bytes);
}

}    // extern "C"
