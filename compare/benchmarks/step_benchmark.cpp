#include "step_benchmark.hpp"

#include "subject.hpp"
#include "timed_pass.hpp"

#include "runs/contender.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>

namespace paperproof::benchmarks {
namespace {

using MakeSubject = std::function<std::unique_ptr<Subject>(const Workload&)>;

void step_benchmark(benchmark::State& state, const Workload& workload, const MakeSubject& make) {
  const std::unique_ptr<Subject> subject = make(workload);
  const std::unique_ptr<Subject> box2d = make_bare_box2d(workload, Box2dScenery::chain_loops);
  timed_pass(*subject);
  timed_pass(*box2d);
  std::vector<double> times;
  std::vector<double> box2d_times;
  for ([[maybe_unused]] auto _ : state) {
    box2d_times.push_back(timed_pass(*box2d));
    times.push_back(timed_pass(*subject));
    state.SetIterationTime(times.back() * 1e-9);
  }
  const auto steps = static_cast<double>(workload.inputs.size());
  const auto [least, most] = std::minmax_element(times.begin(), times.end());
  const double least_box2d = *std::min_element(box2d_times.begin(), box2d_times.end());
  state.counters["ns_min"] = *least / steps;
  state.counters["ns_max"] = *most / steps;
  state.counters["box2d_ns"] = least_box2d / steps;
  state.counters["box2d_ratio"] = least_box2d / *least;
  state.counters["pieces"] = static_cast<double>(workload.scenery.pieces().size());
}

struct NamedSubject {
  std::string name;
  MakeSubject make;
};

std::vector<NamedSubject> all_subjects() {
  std::vector<NamedSubject> all;
  for (const std::string_view kind : technique_names())
    if (kind != "octagon_sweep")
      all.push_back({std::string(kind), [kind](const Workload& w) { return make_contender(w, kind); }});
  all.push_back({"octagon_sweep", [](const Workload& w) { return make_controller(w); }});
  const auto add_box2d = [&all](const std::string& name, Box2dScenery scenery) {
    all.push_back({name + "_bare", [scenery](const Workload& w) { return make_bare_box2d(w, scenery); }});
    all.push_back({name + "_recorded", [scenery](const Workload& w) { return make_recorded_box2d(w, scenery); }});
  };
  add_box2d("box2d", Box2dScenery::chain_loops);
  add_box2d("box2d_pieces", Box2dScenery::pieces);
  return all;
}

}  // namespace

void register_step_benchmarks() {
  for (const std::shared_ptr<const Workload>& workload : all_workloads()) {
    for (const NamedSubject& subject : all_subjects()) {
      const std::string name = "step/" + workload->name + "/" + subject.name;
      const auto body = [workload, make = subject.make](benchmark::State& state) {
        try {
          step_benchmark(state, *workload, make);
        } catch (const compare::NotApplicable& reason) {
          state.SkipWithError(reason.what());
        }
      };
      benchmark::RegisterBenchmark(name.c_str(), body)
          ->Iterations(passes)
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond);
    }
  }
}

}  // namespace paperproof::benchmarks
