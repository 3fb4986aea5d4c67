/// How long a level takes to load, what it keeps in memory, and what a step in it costs, from 100 pieces to a million.
#pragma once

namespace paperproof::benchmarks {

void register_setup_benchmarks();

}  // namespace paperproof::benchmarks
