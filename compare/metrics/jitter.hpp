/// Jitter as numbers: each a pure function of positions at equal times.
#pragma once

#include "records/row.hpp"
#include "records/trace.hpp"

#include <deque>
#include <optional>
#include <span>
#include <vector>

namespace paperproof::compare {

/// How often the velocity changes its sign, per 1,000 steps. Moves of at most 1e-12 m are none: they neither have a
/// sign nor end one. Zero for fewer than three positions.
[[nodiscard]] double sign_changes(std::span<const double> positions);

/// The share of power at more than half of the highest frequency there is (half a cycle per step), after the straight
/// line that fits best is taken out: 1 for a flutter from step to step, near 0 for a drift or a slow wave. The discrete
/// Fourier transform, without a window. Nothing where the rest is below 1e-12 m (RMS), or for fewer than eight
/// positions.
[[nodiscard]] std::optional<double> upper_band_share(std::span<const double> positions);

/// Logarithm of the dimensionless jerk, negative as usual, so that smoother is larger (Balasubramanian,
/// Melendez-Calderon and Burdet 2012, "A robust and sensitive metric for quantifying movement smoothness"): -ln(T³ / v²
/// ∫ |jerk|² dt), with the duration T and the largest speed v. The jerk is the third difference of the positions. It
/// does not change with the unit of length or time. Nothing without motion or without jerk.
/// @param dt between two positions [s].
[[nodiscard]] std::optional<double> log_dimensionless_jerk(std::span<const Vec2d> positions, double dt);

/// What a character's motion is like, step by step. Memory does not grow with the number of steps.
/// - `log_dimensionless_jerk` of the last 4,096 positions since it was put somewhere.
/// - `seam_hop_share`, `seam_hop_m`: between two steps that walk over level ground (grounded, on a normal of exactly
///   (0, 1) that stands still, with the same wanted motion) the largest change of the horizontal velocity as a share of
///   the wanted one, and of the height [m]. Seams of flat tiles show here. How the height settles after a fall is no
///   hop: where it comes to rest at all, changes count from then on.
class Smoothness {
 public:
  explicit Smoothness(const SceneryDef& scenery);
  void add(const TraceStep& step, double dt);
  void write(Row& row) const;

 private:
  struct Walk {
    double wanted = 0;
    double way = 0;
    double height = 0;
  };

  std::vector<bool> stands_;  ///< By collider.
  std::deque<Vec2d> positions_;
  double dt_ = 0;
  std::optional<Walk> last_;
  std::optional<double> hop_share_;
  std::optional<double> hop_;
  bool rested_ = false;  ///< The height was the same for a step.
};

}  // namespace paperproof::compare
