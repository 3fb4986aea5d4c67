/// What a character does that should do nothing.
#pragma once

#include "records/row.hpp"
#include "records/trace.hpp"

#include <deque>
#include <optional>
#include <vector>

namespace paperproof::compare {

/// Jitter at rest. A rest is a maximal run of at least 60 steps that want no horizontal motion, begins and ends with a
/// grounded step, and has no gap longer than `longest_gap` between two of them: a character that hops on its floor
/// rests, and that is its jitter. (A jump is a longer gap. Without gaps a technique that is grounded in every fourth
/// step never rests, and has no number.) The first `settling_steps` are not measured. The last rest of a run counts.
/// A character on a mover rests relative to it: the mover's motion is taken out of the wanted one and of the positions.
/// - `rest_peak_to_peak_m`: the larger of the ranges of x and of y over the ends of the steps [m].
/// - `rest_rms_m`: root mean square distance from the mean position [m].
/// - `rest_sign_changes`, `rest_upper_band`: see metrics/jitter.hpp; the larger of x and y, over the last 512 steps.
/// - `contact_toggles`: changes of the set of reported sides between successive steps, per 1,000 steps.
class Rest {
 public:
  /// Without a grounded step [s]: the fall of 1.6 px under 10 m/s², of 4.8 px under 30. Shorter: a technique that
  /// pushes out by a unit and falls back never rests. Longer: low jumps would be jitter.
  static constexpr double longest_gap = 0.1;

  /// Not measured [steps]. Shorter: a landing is jitter. Longer: short rests have no number.
  static constexpr int settling_steps = 30;

  explicit Rest(const SceneryDef& scenery);
  /// @param dt of the step [s].
  void add(const TraceStep& step, double dt);
  /// Leaves the row alone where nothing rested.
  void write(Row& row) const;

 private:
  struct Phase {
    int steps = 0;
    int measured = 0;
    int toggles = 0;
    MoverIndex ground = no_mover;
    unsigned sides = 0;
    Vec2d origin{Vec2d::Zero()};  ///< First measured position: sums of offsets from it do not lose digits.
    Box2 range;
    Vec2d sum{Vec2d::Zero()};
    double squares = 0;
    std::deque<Vec2d> latest{};  ///< Offsets of the last steps, oldest first.
  };
  /// A step in the air that belongs to the rest if a grounded one comes soon.
  struct Airborne {
    Vec2d position{Vec2d::Zero()};
    unsigned sides = 0;
  };
  /// What the first contact at the feet goes along with.
  [[nodiscard]] MoverIndex carrying(const TraceStep& step) const;
  void count(const Vec2d& position, unsigned sides);
  void measure(const Vec2d& position, unsigned sides);
  void end(MoverIndex ground);

  std::vector<MoverIndex> mover_of_;  ///< By collider.
  Phase now_;
  std::vector<Airborne> gap_;  ///< Since the last grounded step of the present rest.
  double gap_lasts_ = 0;       ///< [s]
  std::optional<Phase> last_;
};

/// The set of sides of some contacts, one bit each.
template <class Contacts>
[[nodiscard]] unsigned sides_of(const Contacts& contacts) noexcept {
  unsigned sides = 0;
  for (const auto& contact : contacts) sides |= 1U << static_cast<unsigned>(contact.side);
  return sides;
}

}  // namespace paperproof::compare
