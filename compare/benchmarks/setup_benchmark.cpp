#include "setup_benchmark.hpp"

#include "level.hpp"

#include <paperproof/controller.hpp>

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>

namespace paperproof::benchmarks {
namespace {

/// The bytes that the process has allocated now, untouched ones included.
std::size_t allocated() noexcept {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The parts of a set-up, the least of all rounds.
class Parts {
 public:
  explicit Parts(benchmark::State& state) : state_(state) {}

  /// @return what `make` made; its time and memory are noted.
  template <class Make>
  auto measured(const std::string& name, const Make& make) {
    const std::size_t before = allocated();
    const auto begin = std::chrono::steady_clock::now();
    auto made = make();
    const double seconds = seconds_since(begin);
    sum_ += seconds;
    note(name + "_ms", seconds * 1e3);
    const auto bytes = static_cast<double>(allocated() - before) / static_cast<double>(state_.range(0));
    bytes_ += bytes;
    state_.counters[name + "_bytes"] = bytes;
    return made;
  }
  void end_round() {
    note("all_ms", sum_ * 1e3);
    state_.SetIterationTime(sum_);
    state_.counters["all_bytes"] = bytes_;
    sum_ = bytes_ = 0;
  }

 private:
  void note(const std::string& name, double milliseconds) {
    const auto known = state_.counters.find(name);
    if (known == state_.counters.end())
      state_.counters[name] = milliseconds;
    else
      known->second.value = std::min(known->second.value, milliseconds);
  }

  benchmark::State& state_;
  double sum_ = 0;    ///< [s]
  double bytes_ = 0;  ///< Per piece.
};

void set_up(benchmark::State& state) {
  const Level level = make_level(state.range(0));
  Parts parts(state);
  for ([[maybe_unused]] auto _ : state) {
    const auto scenery = parts.measured("scenery", [&] { return std::make_unique<Scenery>(level.scenery); });
    const auto controller =
        parts.measured("controller", [&] { return std::make_unique<Controller>(*scenery, CharacterDef{}); });
    const auto scratch = parts.measured("scratch", [&] { return controller->make_scratch(); });
    parts.end_round();
  }
}

/// The tree of the fixtures included, which the first step would build.
void set_up_box2d(benchmark::State& state) {
  const Level level = make_level(state.range(0));
  Parts parts(state);
  for ([[maybe_unused]] auto _ : state) {
    const auto world = parts.measured("world", [&] { return make_box2d_level(level); });
    parts.end_round();
  }
}

void register_for_sizes(const char* name, void (*body)(benchmark::State&)) {
  benchmark::RegisterBenchmark(name, body)
      ->RangeMultiplier(10)
      ->Range(100, 1'000'000)
      ->Iterations(5)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_setup_benchmarks() {
  register_for_sizes("table/setup/octagon_sweep", set_up);
  register_for_sizes("table/setup/box2d", set_up_box2d);
}

}  // namespace paperproof::benchmarks
