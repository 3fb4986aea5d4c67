/// Times the loading of a level of 100 to 1,000,000 pieces and a step in it, and counts the bytes that it keeps.
#pragma once

namespace paperproof::benchmarks {

void register_setup_benchmarks();

}  // namespace paperproof::benchmarks
