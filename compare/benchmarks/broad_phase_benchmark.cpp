#include "broad_phase_benchmark.hpp"

#include <paperproof/broad_phase.hpp>

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>

namespace paperproof::benchmarks {
namespace {

/// The scales at which the two kinds are compared; beyond the last `all_pairs` takes milliseconds.
constexpr std::array<std::size_t, 5> piece_counts{10, 100, 1'000, 10'000, 100'000};
constexpr std::uint64_t query_seed = 1;

/// Tiles of 1 m, every other place of a square level.
struct Tiles {
  explicit Tiles(std::size_t count) : side(std::ceil(std::sqrt(2.0 * static_cast<double>(count)))) {
    for (std::size_t i = 0; i < count; ++i) {
      const double place = 2.0 * static_cast<double>(i);
      const Vec2d corner{std::fmod(place, side), std::floor(place / side)};
      boxes.push_back({corner, corner + Vec2d(1, 1)});
    }
  }
  double side;  ///< [m]
  std::vector<Box2> boxes;
};

/// The article's character, a quarter of its height around it.
std::vector<Box2> random_queries(double side) {
  std::mt19937_64 random(query_seed);
  std::uniform_real_distribution<double> place(0, side);
  std::vector<Box2> queries;
  for (int i = 0; i < 1024; ++i) {
    const Vec2d centre{place(random), place(random)};
    const Vec2d half{20.0 / 64 + 10.0 / 32, 40.0 / 64 + 10.0 / 32};
    queries.push_back({centre - half, centre + half});
  }
  return queries;
}

void broad_phase_benchmark(benchmark::State& state, BroadPhaseKind kind, std::size_t count) {
  const Tiles tiles(count);
  const auto broad_phase = make_broad_phase(kind, tiles.boxes);
  const std::vector<Box2> queries = random_queries(tiles.side);
  std::vector<PieceIndex> found(count);
  std::size_t next = 0;
  std::size_t total = 0;
  for ([[maybe_unused]] auto _ : state) {
    const std::size_t here = broad_phase->query(queries[next], found);
    benchmark::DoNotOptimize(found.data());
    total += here;
    next = (next + 1) % queries.size();
  }
  state.counters["found"] = static_cast<double>(total) / static_cast<double>(state.iterations());
}

}  // namespace

void register_broad_phase_benchmarks() {
  for (const auto& [name, kind] : {std::pair("all_pairs", BroadPhaseKind::all_pairs),
                                   {"buckets", BroadPhaseKind::buckets},
                                   {"tree", BroadPhaseKind::tree}}) {
    for (const std::size_t count : piece_counts) {
      const std::string full = std::string("broad_phase/") + name + "/" + std::to_string(count);
      const auto body = [kind = kind, count](benchmark::State& state) { broad_phase_benchmark(state, kind, count); };
      benchmark::RegisterBenchmark(full.c_str(), body)->MinTime(0.05);
    }
  }
}

}  // namespace paperproof::benchmarks
