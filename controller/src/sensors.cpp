#include "sensors.hpp"

#include <paperproof/tolerances.hpp>

#include <type_traits>
#include <utility>

#include "geometry/overlap_time.hpp"

namespace paperproof {
namespace {

using geometry::OverlapTime;

/// Fractions of a segment that count as one instant. Zero: rounding parts the pieces of one sensor where the character
/// grazes the corner that they share. Large: short visits are joined.
template <class Scalar>
inline constexpr Scalar one_instant = std::is_same_v<Scalar, float> ? Scalar(1e-5) : Scalar(1e-12);

/// Sorted in. A full vector keeps the earliest.
template <class Scalar, std::size_t capacity>
void add_in_order(const SensorEvent<Scalar>& event, FixedVector<SensorEvent<Scalar>, capacity>& events) noexcept {
  if (!events.push_back(event)) {
    if (!(event.fraction < events.back().fraction)) return;
    events.back() = event;
  }
  for (std::size_t i = events.size() - 1; i > 0 && event.fraction < events[i - 1].fraction; --i)
    std::swap(events[i], events[i - 1]);
}

/// The stays of a character in the pieces of one sensor during one segment, joined where they overlap. They are worked
/// out anew each time, so that any number of pieces needs no memory.
template <class Scalar>
class Stays {
 public:
  Stays(const Scenery<Scalar>& scenery, PieceRange pieces, std::span<const Vec2<Scalar>> outline,
        const Vec2<Scalar>& from, const Vec2<Scalar>& to, const Box2<Scalar>& box) noexcept
      : scenery_(&scenery), pieces_(pieces), outline_(outline), from_(from), to_(to), box_(box) {}

  /// The first that begins later than `time`; empty where there is none.
  [[nodiscard]] OverlapTime<Scalar> after(Scalar time) const noexcept {
    OverlapTime<Scalar> first{.begin = OverlapTime<Scalar>::after, .end = OverlapTime<Scalar>::before};
    for_each([&](const OverlapTime<Scalar>& stay) {
      if (stay.begin > time && stay.begin < first.begin) first = stay;
    });
    while (first.any() && extend(first)) {
    }
    return first;
  }

 private:
  template <class Look>
  void for_each(const Look& look) const noexcept {
    for (PieceIndex piece = pieces_.first; piece < pieces_.end; ++piece) {
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
  PieceRange pieces_;
  std::span<const Vec2<Scalar>> outline_;
  Vec2<Scalar> from_;
  Vec2<Scalar> to_;
  Box2<Scalar> box_;
};

}  // namespace

template <class Scalar>
Sensors<Scalar>::Sensors(const Scenery<Scalar>& scenery, const CharacterShape& shape)
    : scenery_(&scenery), box_{shape.box().lower.cast<Scalar>(), shape.box().upper.cast<Scalar>()} {
  for (const Vec2d& corner : shape.hull()) outline_.push_back(corner.cast<Scalar>());
  const PieceRange pieces = scenery.sensor_pieces();
  for (PieceIndex piece = pieces.first; piece < pieces.end; ++piece) {
    const PieceInfo& info = scenery.pieces()[piece];
    if (sensors_.empty() || sensors_.back().collider != info.collider) {
      sensors_.push_back({info.collider, info.mover, {piece, piece}, scenery.box(piece)});
    }
    sensors_.back().pieces.end = piece + 1;
    sensors_.back().box = sensors_.back().box.merged(scenery.box(piece));
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
  // A little larger, so that rounding here cannot hide what the separations see.
  const Box2<Scalar> exact{segment.from.cwiseMin(segment.to) + box_.lower,
                           segment.from.cwiseMax(segment.to) + box_.upper};
  segment.box = exact.inflated(Tolerances<Scalar>{}.look);
  return segment;
}

template <class Scalar>
void Sensors<Scalar>::observe(std::span<const PathPoint<Scalar>> path, std::span<const MoverMotion<Scalar>> movers,
                              Events& events) const noexcept {
  for (const Sensor& sensor : sensors_) {
    const MoverMotion<Scalar> motion = sensor.mover == no_mover ? MoverMotion<Scalar>{} : movers[sensor.mover];
    for (std::size_t i = 1; i < path.size(); ++i) {
      const PathPoint<Scalar>& begin = path[i - 1];
      const PathPoint<Scalar>& end = path[i];
      const Segment segment = seen_from(motion.at(begin.fraction), motion.at(end.fraction), begin, end);
      if (segment.box.overlaps(sensor.box)) observe(sensor, segment, events);
    }
  }
}

template <class Scalar>
void Sensors<Scalar>::observe(const Sensor& sensor, const Segment& segment, Events& events) const noexcept {
  using Change = typename SensorEvent<Scalar>::Change;
  using Time = OverlapTime<Scalar>;
  const Stays<Scalar> stays(*scenery_, sensor.pieces, {outline_.begin(), outline_.end()}, segment.from, segment.to,
                            segment.box);
  for (Time stay = stays.after(Time::before - 1); stay.any(); stay = stays.after(stay.end)) {
    if (stay.begin != Time::before)
      add_in_order({sensor.collider, Change::enter, segment.fraction(stay.begin)}, events);
    if (stay.end == Time::after) return;
    add_in_order({sensor.collider, Change::exit, segment.fraction(stay.end)}, events);
  }
}

template class Sensors<float>;
template class Sensors<double>;

}  // namespace paperproof
