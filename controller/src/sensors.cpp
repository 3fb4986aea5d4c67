#include "sensors.hpp"

#include <paperproof/tolerances.hpp>

#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/overlap_time.hpp"

namespace paperproof {
namespace {

using geometry::OverlapTime;

/// Fractions of a segment that count as one instant. Zero: rounding parts the pieces of one sensor where the character
/// grazes the corner that they share. Large: short visits are joined.
template <class Scalar>
inline constexpr Scalar one_instant = std::is_same_v<Scalar, float> ? Scalar(1e-5) : Scalar(1e-12);

/// How deep an overlap is that no rounding can hide, this far from the origin [m]. Zero: a character that grazes would
/// count as inside. Large: more than needed is calculated for each.
template <class Scalar>
Scalar beyond_rounding(Scalar furthest) {
  return Tolerances<Scalar>{}.look + 64 * std::numeric_limits<Scalar>::epsilon() * furthest;
}

/// Sorted in, whichever sensor was looked at first. A full vector keeps the earliest.
template <class Scalar, std::size_t capacity>
void add_in_order(const SensorEvent<Scalar>& event, FixedVector<SensorEvent<Scalar>, capacity>& events) noexcept {
  const auto comes_before = [&event](const SensorEvent<Scalar>& other) {
    return event.fraction < other.fraction || (event.fraction == other.fraction && event.sensor < other.sensor);
  };
  if (!events.push_back(event)) {
    if (!comes_before(events.back())) return;
    events.back() = event;
  }
  for (std::size_t i = events.size() - 1; i > 0 && comes_before(events[i - 1]); --i)
    std::swap(events[i], events[i - 1]);
}

/// The stays of a character in the pieces of one sensor during one segment, joined where they overlap. They are worked
/// out anew each time, so that any number of pieces needs no memory.
template <class Scalar>
class Stays {
 public:
  Stays(const Scenery<Scalar>& scenery, std::span<const PieceIndex> pieces, std::span<const Vec2<Scalar>> outline,
        const Vec2<Scalar>& from, const Vec2<Scalar>& to, const Box2<Scalar>& box) noexcept
      : scenery_(&scenery), pieces_(pieces), outline_(outline), from_(from), to_(to), box_(box) {}

  /// The first that begins later than `time`; empty where there is none.
  [[nodiscard]] OverlapTime<Scalar> after(Scalar time) const noexcept {
    OverlapTime<Scalar> first{.begin = OverlapTime<Scalar>::after, .end = OverlapTime<Scalar>::before};
    for_each([&](const OverlapTime<Scalar>& stay) {
      if (stay.begin > time && stay.begin < first.begin) first = stay;
    });
    while (pieces_.size() > 1 && first.any() && first.end != OverlapTime<Scalar>::after && extend(first)) {
    }
    return first;
  }

 private:
  template <class Look>
  void for_each(const Look& look) const noexcept {
    for (const PieceIndex piece : pieces_) {
      if (!scenery_->box(piece).overlaps(box_)) continue;
      const OverlapTime<Scalar> stay = geometry::overlap_time(outline_, scenery_->vertices_of(piece), from_, to_);
      if (stay.any()) look(stay);
    }
  }

  /// By what goes on where it ends. @return whether anything did.
  [[nodiscard]] bool extend(OverlapTime<Scalar>& stay) const noexcept {
    const Scalar end = stay.end;
    for_each([&](const OverlapTime<Scalar>& next) {
      if (next.begin <= end + one_instant<Scalar>) stay.end = std::max(stay.end, next.end);
    });
    return stay.end > end;
  }

  const Scenery<Scalar>* scenery_;
  std::span<const PieceIndex> pieces_;
  std::span<const Vec2<Scalar>> outline_;
  Vec2<Scalar> from_;
  Vec2<Scalar> to_;
  Box2<Scalar> box_;
};

std::vector<PieceIndex> all_of(PieceRange range) {
  std::vector<PieceIndex> pieces(range.size());
  std::iota(pieces.begin(), pieces.end(), range.first);
  return pieces;
}

}  // namespace

template <class Scalar>
Sensors<Scalar>::Sensors(const Scenery<Scalar>& scenery, const CharacterShape& shape)
    : scenery_(&scenery),
      finder_(scenery, shape, all_of(scenery.sensor_pieces())),
      box_{shape.box().lower.cast<Scalar>(), shape.box().upper.cast<Scalar>()} {
  for (const Vec2d& corner : shape.hull()) outline_.push_back(corner.cast<Scalar>());
  well_inside_.reserve(scenery.sensor_pieces().size());
  for (const PieceIndex piece : all_of(scenery.sensor_pieces())) {
    const Box2<Scalar>& box = scenery.box(piece);
    const Scalar furthest = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    well_inside_.push_back(geometry::deep_overlap<Scalar>({outline_.begin(), outline_.end()},
                                                          scenery.vertices_of(piece), beyond_rounding(furthest)));
  }
}

template <class Scalar>
typename Sensors<Scalar>::Segment Sensors<Scalar>::seen_from(const Vec2<Scalar>& offset_at_begin,
                                                             const Vec2<Scalar>& offset_at_end,
                                                             const PathPoint<Scalar>& begin,
                                                             const PathPoint<Scalar>& end) const noexcept {
  Segment segment;
  segment.from = begin.position - offset_at_begin;
  segment.to = end.position - offset_at_end;
  segment.begin = begin.fraction;
  segment.end = end.fraction;
  segment.positions = {segment.from.cwiseMin(segment.to), segment.from.cwiseMax(segment.to)};
  // A little larger, so that rounding here cannot hide what the separations see.
  const Box2<Scalar> exact{segment.positions.lower + box_.lower, segment.positions.upper + box_.upper};
  segment.box = exact.inflated(Tolerances<Scalar>{}.look);
  return segment;
}

template <class Scalar>
void Sensors<Scalar>::observe(std::span<const PathPoint<Scalar>> path, std::span<const MoverMotion<Scalar>> movers,
                              Candidates<Scalar>& candidates, Events& events) const noexcept {
  finder_.along(path, movers, candidates, [&](std::span<const PieceIndex> near, const MoverMotion<Scalar>& motion) {
    for (std::size_t i = 1; i < path.size(); ++i) {
      const PathPoint<Scalar>& begin = path[i - 1];
      const PathPoint<Scalar>& end = path[i];
      const Segment segment = seen_from(motion.at(begin.fraction), motion.at(end.fraction), begin, end);
      // Who stays in one place, as the sensor sees it, enters and leaves nothing.
      if (segment.from != segment.to) observe(near, segment, events);
    }
  });
}

/// Pieces of one sensor stand side by side.
template <class Scalar>
void Sensors<Scalar>::observe(std::span<const PieceIndex> near, const Segment& segment, Events& events) const noexcept {
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (!scenery_->box(near[i]).overlaps(segment.box)) continue;
    const std::size_t first = i;
    const ColliderIndex sensor = scenery_->pieces()[near[i]].collider;
    while (i + 1 < near.size() && scenery_->pieces()[near[i + 1]].collider == sensor) ++i;
    observe(sensor, near.subspan(first, i + 1 - first), segment, events);
  }
}

template <class Scalar>
void Sensors<Scalar>::observe(ColliderIndex sensor, std::span<const PieceIndex> pieces, const Segment& segment,
                              Events& events) const noexcept {
  using Change = typename SensorEvent<Scalar>::Change;
  using Time = OverlapTime<Scalar>;
  // Nearly all who are in a sensor are well inside.
  const auto stays_inside = [&](PieceIndex piece) {
    return well_inside_[piece - scenery_->sensor_pieces().first].contains(segment.positions);
  };
  if (std::any_of(pieces.begin(), pieces.end(), stays_inside)) return;
  const Stays<Scalar> stays(*scenery_, pieces, {outline_.begin(), outline_.end()}, segment.from, segment.to,
                            segment.box);
  for (Time stay = stays.after(Time::before - 1); stay.any(); stay = stays.after(stay.end)) {
    if (stay.begin != Time::before) add_in_order({sensor, Change::enter, segment.fraction(stay.begin)}, events);
    if (stay.end == Time::after) return;
    add_in_order({sensor, Change::exit, segment.fraction(stay.end)}, events);
    if (pieces.size() == 1) return;  // convex: it is left once
  }
}

template class Sensors<float>;
template class Sensors<double>;

}  // namespace paperproof
