/// What a character does that should do nothing.
#pragma once

#include "records/row.hpp"
#include "records/trace.hpp"

#include <optional>
#include <vector>

namespace paperproof::compare {

/// Jitter at rest. A rest is a maximal run of at least 60 steps that end grounded and want no horizontal motion; the
/// first 30 are for settling and are not measured. The last rest of a run counts. Who stands on a mover rests relative
/// to it: its motion is taken out of the wanted one and of the positions.
/// - `rest_peak_to_peak_m`: the larger of the ranges of x and of y over the ends of the steps [m].
/// - `rest_rms_m`: root mean square distance from the mean position [m].
/// - `rest_sign_changes`, `rest_upper_band`: see metrics/jitter.hpp; the larger of x and y, over the last 512 steps.
/// - `contact_toggles`: changes of the set of reported sides between successive steps, per 1,000 steps.
class Rest {
 public:
  explicit Rest(const SceneryDef& scenery);
  void add(const TraceStep& step);
  /// Leaves the row alone where nothing rested.
  void write(Row& row) const;

 private:
  struct Phase {
    int steps = 0;
    int measured = 0;
    int toggles = 0;
    MoverIndex ground = no_mover;
    std::uint8_t sides = 0;
    Vec2d origin{Vec2d::Zero()};  ///< First measured position: sums of offsets from it do not lose digits.
    Box2<double> range;
    Vec2d sum{Vec2d::Zero()};
    double squares = 0;
    std::vector<double> xs{};  ///< Offsets of the last steps, oldest first.
    std::vector<double> ys{};
  };
  /// What the first contact at the feet goes along with.
  [[nodiscard]] MoverIndex carrying(const TraceStep& step) const;
  void measure(const Vec2d& position, std::uint8_t sides);

  std::vector<MoverIndex> mover_of_;  ///< By collider.
  Phase now_;
  std::optional<Phase> last_;
};

/// The set of sides of some contacts, one bit each.
template <class Contacts>
[[nodiscard]] std::uint8_t sides_of(const Contacts& contacts) noexcept {
  unsigned sides = 0;
  for (const auto& contact : contacts) sides |= 1U << static_cast<unsigned>(contact.side);
  return static_cast<std::uint8_t>(sides);
}

}  // namespace paperproof::compare
