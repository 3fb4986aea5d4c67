/// What a step solver is compiled for.
#pragma once

#include <cstddef>

namespace paperproof::octagon_sweep {

/// Shared axes per piece, and which stages exist. A template argument: a stage that is left out is no code.
struct Variant {
  std::size_t lanes = 8;
  bool movers = true;
  bool one_way = true;
  bool slopes = true;  ///< Pieces may have axes of their own.
};

}  // namespace paperproof::octagon_sweep
