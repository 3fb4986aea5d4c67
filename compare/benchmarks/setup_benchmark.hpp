/// Times the loading of a level of 100 to 1,000,000 pieces, and counts the bytes that it keeps.
#pragma once

namespace paperproof::benchmarks {

/// Registers `table/setup/WHO/PIECES`. Counters: `NAME_ms` and `NAME_bytes` (for each piece) of every part, and of all.
void register_setup_benchmarks();

}  // namespace paperproof::benchmarks
