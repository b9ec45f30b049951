// SPDX-License-Identifier: GPL-2.0-only

// Time of the contact law alone: ContactLaw::evaluate() and what makes forces of its answer, over
// an array of contacts. One benchmark a law, branch and rolling model.

#include "sample_contacts.h"

#include <benchmark/benchmark.h>

#include <string>

namespace {
using namespace eepa_bench;

/// As many contacts as lie in the second-level cache, and many more than any cache holds.
constexpr std::size_t in_cache = 1024, in_memory = 1 << 19;

/// What a driver adds to its particles.
struct Effect {
  Vec3 force, moment, rolling;
};

template <class ContactLaw>
void evaluate_all(benchmark::State &state, const Choice &choice, Kind kind, std::size_t count)
{
  std::vector<Sample> samples = make_samples<ContactLaw>(choice, kind, count);
  std::vector<Effect> effects(samples.size());
  const eepa::Coefficients c = eepa::resolve(choice.parameters, choice.settings);
  for (auto _ : state) {
    for (std::size_t k = 0; k < samples.size(); k++) {
      Sample &sample = samples[k];
      const eepa::Response response =
          ContactLaw::evaluate(c, false, sample.contact, time_step, sample.history);
      effects[k].force = ContactLaw::force_on_i(response, sample.contact);
      effects[k].moment = ContactLaw::tangential_moment(response, sample.contact);
      if constexpr (ContactLaw::has_rolling) effects[k].rolling = response.rolling_torque;
    }
    benchmark::ClobberMemory();
  }

  // whether they were what they are said to be
  double loading = 0, unloading = 0, adhesive = 0, sliding = 0;
  for (Sample &sample : samples) {
    const eepa::Response response =
        ContactLaw::evaluate(c, false, sample.contact, time_step, sample.history);
    loading += response.branch == eepa::Branch::loading;
    unloading += response.branch == eepa::Branch::unloading;
    adhesive += response.branch == eepa::Branch::adhesive;
    sliding += response.sliding;
  }
  const double n = static_cast<double>(samples.size());
  const bool as_said = kind == Kind::loading ? loading == n && sliding == 0
      : kind == Kind::unloading              ? unloading == n && sliding == 0
      : kind == Kind::adhesive               ? adhesive == n
      : kind == Kind::sliding                ? sliding == n
                                             : true;
  if (!as_said) state.SkipWithError("the contacts are not on the branch that was asked for");
  state.counters["contacts"] = n;
  state.counters["loading"] = loading / n;
  state.counters["unloading"] = unloading / n;
  state.counters["adhesive"] = adhesive / n;
  state.counters["sliding"] = sliding / n;
}

void add(const Choice &choice, Kind kind, std::size_t count, const char *place)
{
  eepa::with_law(choice.settings, choice.parameters.rolling, [&](auto law) {
    using ContactLaw = decltype(law);
    benchmark::RegisterBenchmark((choice.name(kind) + "/" + place).c_str(),
                                 [choice, kind, count](benchmark::State &state) {
                                   evaluate_all<ContactLaw>(state, choice, kind, count);
                                 });
  });
}
}    // namespace

int main(int argc, char **argv)
{
  for (const Choice &choice : all_choices())
    for (Kind kind : all_kinds) add(choice, kind, in_cache, "cache");
  for (const Choice &choice : all_choices()) add(choice, Kind::mixed, in_memory, "memory");
  benchmark::AddCustomContext("history_doubles", std::to_string(eepa::SIZE_WITHOUT_ROLLING));
  benchmark::AddCustomContext("history_doubles_sds", std::to_string(eepa::SIZE_WITH_ROLLING));
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
