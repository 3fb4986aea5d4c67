/// What an edit of a level costs, beside one of a Box2D world.
#pragma once

namespace paperproof::benchmarks {

/// Registers them with Google Benchmark.
void register_edit_benchmarks();

}  // namespace paperproof::benchmarks
