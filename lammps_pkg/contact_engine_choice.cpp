// SPDX-License-Identifier: GPL-2.0-only

// Chooses the instruction set of the engines, where a build has several. This file is compiled for
// the least of them.

#include "contact_engine.h"

#include "error.h"
#include "lammps.h"

#include <cstdlib>
#include <string>

#ifdef EEPA_HAS_X86_64_V3
#include <cpuid.h>
#endif

using namespace LAMMPS_NS;

namespace {

struct InstructionSet {
  const char *name;
  bool (*runs_here)();
  decltype(eepa_make_engine) *make_engine;
};

#ifdef EEPA_HAS_X86_64_V3
bool machine_runs_x86_64_v3()
{
  // __builtin_cpu_supports() also asks whether the system saves the wide registers. Clang 14 knows
  // neither the name x86-64-v3 nor the last three of its parts.
  unsigned eax, ebx, ecx, edx, extended;
  if (!__get_cpuid(1, &eax, &ebx, &ecx, &edx)) return false;
  if (!__get_cpuid(0x80000001, &eax, &ebx, &extended, &edx)) return false;
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
      __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma") && (ecx & bit_F16C) &&
      (ecx & bit_MOVBE) && (extended & bit_LZCNT);
}
#endif

/// The best one first.
const InstructionSet instruction_sets[] = {
#ifdef EEPA_HAS_X86_64_V3
    {"x86-64-v3", machine_runs_x86_64_v3, eepa_make_engine_x86_64_v3},
#endif
    {"baseline",
     [] {
       return true;
     },
     eepa_make_engine},
};
constexpr int count = sizeof(instruction_sets) / sizeof(InstructionSet);

// An error of one rank: ranks on other machines may have another environment and another processor.
const InstructionSet &choose(LAMMPS *lmp)
{
  const char *named = std::getenv("EEPA_LOOPS");
  if (!named || !*named) {
    const InstructionSet *set = instruction_sets;
    while (!set->runs_here()) set++;
    return *set;
  }
  std::string known;
  for (const auto &set : instruction_sets) {
    known += (known.empty() ? "" : " or ") + std::string(set.name);
    if (count == 1 || std::string(named) != set.name) continue;
    if (!set.runs_here())
      lmp->error->one(FLERR, "environment variable EEPA_LOOPS={}: this processor does not run it",
                      named);
    return set;
  }
  if (count == 1)
    lmp->error->one(FLERR,
                    "environment variable EEPA_LOOPS={} is not allowed: only a build with "
                    "EEPA_ARCH=dispatch has several instruction sets to choose from",
                    named);
  lmp->error->one(FLERR, "environment variable EEPA_LOOPS={} is unknown: it must be {}", named,
                  known);
  std::abort();    // error->one does not return
}

}    // namespace

std::unique_ptr<const ContactEngine>
LAMMPS_NS::make_contact_engine(LAMMPS *lmp, const eepa::LawSettings &settings,
                               eepa::RollingModel rolling, eepa::TwistingModel twisting)
{
  return std::unique_ptr<const ContactEngine>(choose(lmp).make_engine(settings, rolling, twisting));
}

const char *LAMMPS_NS::chosen_instruction_set(LAMMPS *lmp)
{
  return count > 1 ? choose(lmp).name : nullptr;
}
