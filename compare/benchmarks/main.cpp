// Times the controller beside Box2D, as planned beside full, its set-up, its edits, and the broad phases. Takes the
// options of Google Benchmark:
//   --benchmark_filter=table            the table of controller/README.md; table.py writes it, and its picture
//   --benchmark_filter=step/tiles       some of them
//   --benchmark_out=FILE.json           keep the figures
#include "broad_phase_benchmark.hpp"
#include "edit_benchmark.hpp"
#include "plan_benchmark.hpp"
#include "setup_benchmark.hpp"
#include "step_benchmark.hpp"
#include "table_benchmark.hpp"

#include <benchmark/benchmark.h>

#include <exception>
#include <iostream>

int main(int argc, char** argv) try {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  paperproof::benchmarks::register_step_benchmarks();
  paperproof::benchmarks::register_plan_benchmarks();
  paperproof::benchmarks::register_broad_phase_benchmarks();
  paperproof::benchmarks::register_table_benchmarks();
  paperproof::benchmarks::register_setup_benchmarks();
  paperproof::benchmarks::register_edit_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
