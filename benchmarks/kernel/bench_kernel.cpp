// SPDX-License-Identifier: GPL-2.0-only

// Time of the contact law alone: ContactLaw::evaluate() and ContactLaw::wrench(), over an array of
// contacts, one by one and side by side in lanes. One benchmark a law, branch and rolling model.

#include "sample_contacts.h"

#include <benchmark/benchmark.h>

#include <string>

namespace {
using namespace eepa_bench;

/// Numbers of contacts: they fit the second-level cache, or exceed any cache.
constexpr std::size_t in_cache = 1024, in_memory = 1 << 19;

/// Shares of the contacts.
struct Census {
  double loading = 0.0, unloading = 0.0, adhesive = 0.0, sliding = 0.0;
};

template <class ContactLaw, class Real>
Census take_census(const eepa::Coefficients &c, std::vector<Pack<Real>> packs)
{
  Census census;
  const double share = 1.0 / static_cast<double>(packs.size() * width<Real>);
  const auto count = [&](eepa::Branch branch, bool sliding) {
    if (branch == eepa::Branch::loading) census.loading += share;
    if (branch == eepa::Branch::unloading) census.unloading += share;
    if (branch == eepa::Branch::adhesive) census.adhesive += share;
    if (sliding) census.sliding += share;
  };
  for (auto &[contact, history] : packs) {
    const auto response = ContactLaw::evaluate(c, contact, time_step, history);
    if constexpr (width<Real> == 1) {
      count(response.branch, response.sliding);
    } else {
      for (std::size_t lane = 0; lane < width<Real>; lane++)
        count(static_cast<eepa::Branch>(static_cast<int>(response.branch[lane])),
              response.sliding[lane]);
    }
  }
  return census;
}

template <class ContactLaw, class Real>
void evaluate_all(benchmark::State &state, const Choice &choice, Kind kind, std::size_t contacts)
{
  auto packs = pack<Real>(make_samples<ContactLaw>(choice, kind, contacts));
  std::vector<eepa::Wrench<Real>> wrenches(packs.size());
  const eepa::Coefficients c = eepa::resolve(choice.parameters, choice.settings);
  for (auto _ : state) {
    for (std::size_t k = 0; k < packs.size(); k++) {
      auto &[contact, history] = packs[k];
      const auto response = ContactLaw::evaluate(c, contact, time_step, history);
      wrenches[k] = ContactLaw::wrench(response, contact);
    }
    benchmark::ClobberMemory();
  }

  // check that contacts are still on the branch that the benchmark names
  const Census found = take_census<ContactLaw>(c, packs);
  constexpr double all = 1.0 - 1e-9;
  const bool as_said = kind == Kind::loading ? found.loading > all && found.sliding == 0.0
      : kind == Kind::unloading              ? found.unloading > all && found.sliding == 0.0
      : kind == Kind::adhesive               ? found.adhesive > all
      : kind == Kind::sliding                ? found.sliding > all
                                             : found.sliding > 0.05 && found.unloading > 0.2;
  if (!as_said) state.SkipWithError("the contacts are not on the branch that was asked for");
  state.counters["contacts"] = static_cast<double>(packs.size() * width<Real>);
  state.counters["loading"] = found.loading;
  state.counters["unloading"] = found.unloading;
  state.counters["adhesive"] = found.adhesive;
  state.counters["sliding"] = found.sliding;
}

template <class Real>
void add(const Choice &choice, Kind kind, std::size_t contacts, const char *place)
{
  eepa::with_law(choice.settings, choice.parameters, [&](auto law) {
    using ContactLaw = decltype(law);
    benchmark::RegisterBenchmark((choice.name(kind) + "/" + place).c_str(),
                                 [choice, kind, contacts](benchmark::State &state) {
                                   evaluate_all<ContactLaw, Real>(state, choice, kind, contacts);
                                 });
  });
}
}    // namespace

int main(int argc, char **argv)
{
  for (const Choice &choice : all_choices()) {
    for (Kind kind : all_kinds) {
      add<double>(choice, kind, in_cache, "one");
#ifdef EEPA_HAS_LANES
      add<eepa::Lanes>(choice, kind, in_cache, "lanes");
#endif
    }
    add<double>(choice, Kind::mixed, in_memory, "one, memory");
#ifdef EEPA_HAS_LANES
    add<eepa::Lanes>(choice, Kind::mixed, in_memory, "lanes, memory");
#endif
  }
#ifdef EEPA_HAS_LANES
  benchmark::AddCustomContext("lanes", std::to_string(width<eepa::Lanes>));
#endif
  benchmark::AddCustomContext("history_doubles",
                              std::to_string(eepa::HistoryLayout<false, false>::size));
  benchmark::AddCustomContext("history_doubles_sds",
                              std::to_string(eepa::HistoryLayout<true, false>::size));
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
