#include "oracle/rotation.hpp"

#include "oracle/interval.hpp"

#include <cmath>
#include <stdexcept>

namespace paperproof::compare {
namespace {

using detail::Interval;

constexpr double largest_angle = 1e6;
/// Parts of the step that are too close to tell before the search gives up: where the two slide along each other all of
/// them are.
constexpr int most_grazing = 4096;

struct IntervalPoint {
  Interval x;
  Interval y;

  explicit IntervalPoint(const Vec2d& v) : x(v.x()), y(v.y()) {}
  IntervalPoint(const Interval& a, const Interval& b) : x(a), y(b) {}
  friend IntervalPoint operator+(const IntervalPoint& a, const IntervalPoint& b) { return {a.x + b.x, a.y + b.y}; }
  friend IntervalPoint operator-(const IntervalPoint& a, const IntervalPoint& b) { return {a.x - b.x, a.y - b.y}; }
  friend IntervalPoint operator*(const Interval& s, const IntervalPoint& a) { return {s * a.x, s * a.y}; }
};

Interval cross(const IntervalPoint& a, const IntervalPoint& b) { return a.x * b.y - a.y * b.x; }

/// Both bodies at all moments between two fractions.
class Moments {
 public:
  Moments(const MovingOctagon& octagon, const TurningPiece& piece, const Interval& time)
      : octagon_(octagon), piece_(piece), turn_(detail::sine_cosine(between(piece.from, piece.to, time))) {
    const IntervalPoint from(piece.motion.from);
    const IntervalPoint offset = from + time * (IntervalPoint(piece.motion.to) - from);
    to_pivot_ = IntervalPoint(piece.pivot) + offset - IntervalPoint(octagon.position) -
                time * IntervalPoint(octagon.displacement);
  }

  /// One edge normal separates the two at every moment.
  [[nodiscard]] bool certainly_free() const {
    return any_axis([](const Interval& side) { return side.low >= 0; });
  }
  /// No edge normal separates the two at any moment.
  [[nodiscard]] bool certainly_overlapping() const {
    return !any_axis([](const Interval& side) { return !(side.high < 0); });
  }

 private:
  static Interval between(double from, double to, const Interval& time) {
    return Interval(from) + time * (Interval(to) - Interval(from));
  }
  [[nodiscard]] std::size_t size() const { return piece_.points.size(); }
  /// From the pivot to a point of the piece, not turned.
  [[nodiscard]] IntervalPoint arm(std::size_t i) const {
    return IntervalPoint(piece_.points[i % size()]) - IntervalPoint(piece_.pivot);
  }
  [[nodiscard]] IntervalPoint turned(const IntervalPoint& v) const {
    return {turn_.cosine * v.x - turn_.sine * v.y, turn_.sine * v.x + turn_.cosine * v.y};
  }
  [[nodiscard]] IntervalPoint turned_back(const IntervalPoint& v) const {
    return {turn_.cosine * v.x + turn_.sine * v.y, turn_.cosine * v.y - turn_.sine * v.x};
  }

  /// Whether there is an axis all of whose points pass the test: `test` gets how far each point of the one is outside
  /// an edge of the other, times the length of the edge.
  template <class Test>
  [[nodiscard]] bool any_axis(const Test& test) const {
    const std::size_t corners = octagon_.points.size();
    for (std::size_t k = 0; k < corners; ++k) {
      const IntervalPoint corner(octagon_.points[k]);
      const IntervalPoint edge = IntervalPoint(octagon_.points[(k + 1) % corners]) - corner;
      bool all = true;
      for (std::size_t i = 0; all && i < size(); ++i) {
        all = test(-cross(edge, to_pivot_ + turned(arm(i)) - corner));
      }
      if (all) return true;
    }
    for (std::size_t i = 0; i < size(); ++i) {
      const IntervalPoint edge = arm(i + 1) - arm(i);
      bool all = true;
      for (std::size_t k = 0; all && k < corners; ++k) {
        all = test(-cross(edge, turned_back(IntervalPoint(octagon_.points[k]) - to_pivot_) - arm(i)));
      }
      if (all) return true;
    }
    return false;
  }

  const MovingOctagon& octagon_;
  const TurningPiece& piece_;
  detail::SineCosine turn_;
  IntervalPoint to_pivot_{Vec2d::Zero()};  ///< From the octagon's position.
};

/// Goes through the step from its beginning, halving what is not certainly free.
class Search {
 public:
  Search(const MovingOctagon& octagon, const TurningPiece& piece, double width)
      : octagon_(octagon), piece_(piece), width_(width) {}

  /// @returns true when the answer is known.
  [[nodiscard]] bool look(double low, double high) {
    if (Moments(octagon_, piece_, {low, high}).certainly_free()) return found_.kind == RotationTouch::Kind::grazes;
    const double middle = low + (high - low) / 2;
    if (high - low > width_ && middle > low && middle < high) return look(low, middle) || look(middle, high);
    if (found_.kind == RotationTouch::Kind::none) found_ = {RotationTouch::Kind::grazes, low, high};
    found_.high = high;
    if (++looked_at_ > most_grazing) return true;
    if (Moments(octagon_, piece_, {high, high}).certainly_overlapping()) found_.kind = RotationTouch::Kind::touches;
    return found_.kind == RotationTouch::Kind::touches;
  }
  [[nodiscard]] const RotationTouch& found() const { return found_; }

 private:
  const MovingOctagon& octagon_;
  const TurningPiece& piece_;
  double width_;
  int looked_at_ = 0;  ///< Parts that are too close to tell.
  RotationTouch found_;
};

}  // namespace

RotationTouch first_touch(const MovingOctagon& octagon, const TurningPiece& piece, double width) {
  if (!(width > 0)) throw std::invalid_argument("the width must be above zero");
  if (!(std::abs(piece.from) <= largest_angle && std::abs(piece.to) <= largest_angle)) {
    throw std::invalid_argument("the angles must be finite and within a million");
  }
  if (Moments(octagon, piece, {0, 0}).certainly_overlapping()) return {RotationTouch::Kind::touches, 0, 0};
  Search search(octagon, piece, width);
  (void)search.look(0, 1);
  return search.found();
}

}  // namespace paperproof::compare
