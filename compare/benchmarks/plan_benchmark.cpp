#include "plan_benchmark.hpp"

#include "subject.hpp"
#include "timed_pass.hpp"

#include "runs/scene_plan.hpp"
#include "scenes/load.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>

namespace paperproof::benchmarks {
namespace {

void plan_benchmark(benchmark::State& state, const Workload& workload) {
  const auto planned = make_controller(workload);
  const auto full = make_controller(workload, {.search = PieceSearch::none});
  timed_pass(*full);
  timed_pass(*planned);
  if (planned->position() != full->position())
    return state.SkipWithError("planned and full end at different positions");
  std::vector<double> planned_times;
  std::vector<double> full_times;
  for ([[maybe_unused]] auto _ : state) {
    full_times.push_back(timed_pass(*full));
    planned_times.push_back(timed_pass(*planned));
    state.SetIterationTime(planned_times.back() * 1e-9);
  }
  const auto steps = static_cast<double>(workload.inputs.size());
  const double least_planned = *std::min_element(planned_times.begin(), planned_times.end());
  const double least_full = *std::min_element(full_times.begin(), full_times.end());
  state.counters["planned_ns"] = least_planned / steps;
  state.counters["full_ns"] = least_full / steps;
  state.counters["ratio"] = least_full / least_planned;
  state.counters["omitted"] = static_cast<double>(compare::plan_of(workload.scenery, {}).omitted.size());
}

}  // namespace

void register_plan_benchmarks() {
  std::vector<std::shared_ptr<const Workload>> workloads = all_workloads();
  for (const char* name : {"article_bullet", "flush_tiles", "skier", "jump_into_wall", "rotated_wall"}) {
    const compare::Scene scene = compare::load_scenes(name).front();
    workloads.push_back(std::make_shared<const Workload>(name, scene, scene.input));
  }
  for (const std::shared_ptr<const Workload>& workload : workloads)
    benchmark::RegisterBenchmark(("plan/" + workload->name).c_str(),
                                 [workload](benchmark::State& state) { plan_benchmark(state, *workload); })
        ->Iterations(passes)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
}

}  // namespace paperproof::benchmarks
