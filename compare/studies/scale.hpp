/// What a step costs among more and more pieces, with the grid that finds the near ones and without.
#pragma once

#include <paperproof/step_context.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace paperproof::compare {

/// One search among one number of pieces.
struct ScalePoint {
  PieceSearch search = PieceSearch::grid;
  std::size_t pieces = 0;
  int steps = 0;               ///< Of one run.
  double build_ms = 0;         ///< Once per level, everything that the technique prepares included.
  double ns_per_step_min = 0;  ///< Of 9 runs after a warm-up; the two take turns, so that a disturbance meets all.
  double ns_per_step_median = 0;
  double ns_per_step_max = 0;
  bool same_bits = true;  ///< Every position is that of `one_by_one`, bit for bit.
};

inline constexpr std::array scale_searches{PieceSearch::one_by_one, PieceSearch::grid};
inline constexpr std::size_t tiles_per_floor = 100;
/// A million takes 0.8 GB, so that few machines have room for more; and a floor of these is within the range in which
/// the controller keeps its promises.
inline constexpr std::size_t most_tiles = 10'000'000;

/// Floors of 100 tiles of 1 m, 8 m above one another, on the middle one of which the character walks and jumps at
/// random with octagon_sweep in double: what is near stays the same, only the level around it grows.
/// @param counts pieces of each level, in multiples of 100, at most `most_tiles`.
/// @param progress called with the share that is done; may be empty.
/// @throws std::invalid_argument for a count that is not one of these. Not for tests of speed: machines are
///   shared.
[[nodiscard]] std::vector<ScalePoint> study_scale(const std::vector<std::size_t>& counts,
                                                  const std::function<void(double)>& progress);

/// How many times as much a step costs among the most pieces as among the fewest.
[[nodiscard]] double growth(const std::vector<ScalePoint>& points, PieceSearch search);

}  // namespace paperproof::compare
