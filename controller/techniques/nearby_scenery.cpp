#include "techniques/nearby_scenery.hpp"

#include <cmath>
#include <limits>

namespace paperproof {
namespace {

template <class Scalar>
Scalar cross(const Vec2<Scalar>& a, const Vec2<Scalar>& b) noexcept {
  return a.x() * b.y() - a.y() * b.x();
}

template <class Scalar>
bool holds(const Box2<Scalar>& box, const Vec2<Scalar>& point) noexcept {
  return box.lower.x() <= point.x() && point.x() <= box.upper.x() && box.lower.y() <= point.y() &&
         point.y() <= box.upper.y();
}

/// The right-hand normal of an edge: outwards, as pieces run counter-clockwise.
template <class Scalar>
Vec2<Scalar> outward(const Vec2<Scalar>& edge) noexcept {
  const Scalar length = std::sqrt(edge.x() * edge.x() + edge.y() * edge.y());
  return {edge.y() / length, -edge.x() / length};
}

/// The edge of a convex outline that ends at vertex `i`, by its start and direction.
template <class Scalar>
struct Edge {
  Vec2<Scalar> start;
  Vec2<Scalar> along;

  Edge(std::span<const Vec2<Scalar>> outline, std::size_t i) noexcept
      : start(outline[i == 0 ? outline.size() - 1 : i - 1]), along(outline[i] - start) {}

  /// Positive strictly inside, by the signed area that a point spans with the edge [m²].
  [[nodiscard]] Scalar inside(const Vec2<Scalar>& point) const noexcept {
    const Vec2<Scalar> from_start = point - start;
    return cross(along, from_start);
  }
};

enum class Place : std::uint8_t { outside, edge, inside };

/// `along` is valid for `Place::edge`: the direction of the edge whose open middle holds the point.
template <class Scalar>
Place place_in(std::span<const Vec2<Scalar>> outline, const Vec2<Scalar>& point, Vec2<Scalar>& along) noexcept {
  Place place = Place::inside;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Edge<Scalar> edge(outline, i);
    const Scalar inside = edge.inside(point);
    if (inside < 0) return Place::outside;
    if (inside > 0) continue;
    if (place == Place::edge) return Place::outside;  // on two edges: a corner
    place = Place::edge;
    along = edge.along;
  }
  return place;
}

/// Two edges that hold the same point, each with its piece on the left, are a seam.
template <class Scalar>
bool run_against(const Vec2<Scalar>& along, const Vec2<Scalar>& other) noexcept {
  return cross(along, other) == 0 && along.dot(other) < 0;
}

/// The edges that hold a point, one per piece.
template <class Scalar>
class Seams {
 public:
  [[nodiscard]] bool close_with(const Vec2<Scalar>& along) noexcept {
    for (const Vec2<Scalar>& other : edges_) {
      if (run_against(along, other)) return true;
    }
    edges_.push_back(along);
    return false;
  }

 private:
  FixedVector<Vec2<Scalar>, 4> edges_;
};

/// When a moving point is inside a convex outline.
template <class Scalar>
struct Stay {
  enum class Kind : std::uint8_t {
    never,
    inside,
    along_left,   ///< It only runs along an edge, with the piece on its left. Two such pieces, left and right, make a
    along_right,  ///< seam, and the point is in the solid while both last.
  };
  Kind kind = Kind::inside;
  Scalar enter = -std::numeric_limits<Scalar>::infinity();  ///< Negative infinity: inside from the start.
  Scalar leave = std::numeric_limits<Scalar>::infinity();
  std::size_t edge = 0;  ///< Entered through the one that ends at this vertex.
};

template <class Scalar>
Stay<Scalar> stay_in(std::span<const Vec2<Scalar>> outline, const Vec2<Scalar>& from,
                     const Vec2<Scalar>& displacement) noexcept {
  using Kind = typename Stay<Scalar>::Kind;
  Stay<Scalar> stay;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Edge<Scalar> edge(outline, i);
    const Scalar inside = edge.inside(from);
    const Scalar gain = cross(edge.along, displacement);
    if (inside <= 0 && gain < 0) return {.kind = Kind::never};
    if (gain == 0) {
      if (inside < 0) return {.kind = Kind::never};
      if (inside == 0) stay.kind = edge.along.dot(displacement) > 0 ? Kind::along_left : Kind::along_right;
    } else if (gain > 0) {
      if (inside <= 0 && -inside / gain > stay.enter) {
        stay.enter = -inside / gain;
        stay.edge = i;
      }
    } else {
      stay.leave = std::min(stay.leave, inside / -gain);
    }
  }
  const Scalar begin = std::max(Scalar(0), stay.enter);
  if (!(begin < stay.leave) || !(begin < 1)) stay.kind = Kind::never;
  return stay;
}

/// Stays along edges, waiting for their counterpart on the other side.
template <class Scalar>
class SeamStays {
 public:
  /// @return when the point is first in a seam that `stay` closes; at least 1 where there is none.
  [[nodiscard]] Scalar close_with(const Stay<Scalar>& stay) noexcept {
    Scalar first = 1;
    for (const Stay<Scalar>& other : stays_) {
      const Scalar begin = std::max({Scalar(0), stay.enter, other.enter});
      if (other.kind != stay.kind && begin < std::min(stay.leave, other.leave)) first = std::min(first, begin);
    }
    stays_.push_back(stay);
    return first;
  }

 private:
  FixedVector<Stay<Scalar>, 16> stays_;
};

}  // namespace

template <class Scalar>
std::optional<PieceIndex> NearbyScenery<Scalar>::containing(const Vec2<Scalar>& point) const noexcept {
  Seams<Scalar> seams;
  for (const PieceIndex piece : pieces_) {
    if (is_chain(piece) || !holds(scenery_->box(piece), point)) continue;
    Vec2<Scalar> along{Vec2<Scalar>::Zero()};
    const Place place = place_in<Scalar>(scenery_->vertices_of(piece), point, along);
    if (place == Place::inside) return piece;
    if (place == Place::edge && (seams.close_with(along) || is_seam(point, along))) return piece;
  }
  return std::nullopt;
}

/// Another object's edge runs along this one where the point is.
template <class Scalar>
bool NearbyScenery<Scalar>::is_seam(const Vec2<Scalar>& point, const Vec2<Scalar>& along) const noexcept {
  return std::any_of(around_.begin(), around_.end(), [&](PieceIndex piece) {
    if (is_chain(piece) || !holds(scenery_->box(piece), point)) return false;
    Vec2<Scalar> other{Vec2<Scalar>::Zero()};
    return place_in<Scalar>(scenery_->vertices_of(piece), point, other) == Place::edge && run_against(along, other);
  });
}

template <class Scalar>
NearbyScenery<Scalar> NearbyScenery<Scalar>::object_at_front(std::span<const PieceIndex> rest) const noexcept {
  const auto collider_of = [this](PieceIndex piece) { return scenery_->pieces()[piece].collider; };
  const auto end = std::find_if(rest.begin(), rest.end(),
                                [&](PieceIndex piece) { return collider_of(piece) != collider_of(rest.front()); });
  NearbyScenery object(*scenery_, rest.first(static_cast<std::size_t>(end - rest.begin())));
  object.around_ = pieces_;
  return object;
}

template <class Scalar>
bool NearbyScenery<Scalar>::crosses(PieceIndex piece, const Vec2<Scalar>& from, const Vec2<Scalar>& to) const noexcept {
  const PieceVertices<Scalar> ends = scenery_->vertices_of(piece);
  const Edge<Scalar> segment(ends, 1);
  const Scalar before = segment.inside(from);  // positive on the left, where a one-way segment's normal points
  const Scalar after = segment.inside(to);
  if (scenery_->pieces()[piece].one_way) {
    if (before < 0 || after >= 0) return false;
  } else if (before == 0 || (before > 0 ? after > 0 : after < 0)) {
    return false;
  }
  const Vec2<Scalar> motion = to - from;
  const Vec2<Scalar> to_first = ends[0] - from;
  const Vec2<Scalar> to_second = ends[1] - from;
  const Scalar first = cross(motion, to_first);
  const Scalar second = cross(motion, to_second);
  return (first <= 0 && second >= 0) || (first >= 0 && second <= 0);
}

template <class Scalar>
std::optional<PieceIndex> NearbyScenery<Scalar>::crossed(const Vec2<Scalar>& from,
                                                         const Vec2<Scalar>& to) const noexcept {
  for (const PieceIndex piece : pieces_) {
    if (is_chain(piece) && crosses(piece, from, to)) return piece;
  }
  return std::nullopt;
}

template <class Scalar>
PointHit<Scalar> NearbyScenery<Scalar>::crossing(PieceIndex piece, const Vec2<Scalar>& from,
                                                 const Vec2<Scalar>& to) const noexcept {
  const PieceVertices<Scalar> ends = scenery_->vertices_of(piece);
  const Edge<Scalar> segment(ends, 1);
  const Scalar before = segment.inside(from);
  const Scalar after = segment.inside(to);
  PointHit<Scalar> hit{.piece = piece};
  hit.fraction = before / (before - after);
  hit.point = from + (to - from) * hit.fraction;
  const Vec2<Scalar> right = outward(segment.along);
  hit.normal = after < before ? Vec2<Scalar>(-right) : right;
  return hit;
}

template <class Scalar>
PointHit<Scalar> NearbyScenery<Scalar>::way_out(PieceIndex piece, const Vec2<Scalar>& point,
                                                const Vec2<Scalar>& direction) const noexcept {
  const PieceVertices<Scalar> outline = scenery_->vertices_of(piece);
  Scalar nearest = std::numeric_limits<Scalar>::infinity();
  PointHit<Scalar> hit{.piece = piece, .point = point};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Edge<Scalar> edge(outline, i);
    const Scalar gain = cross(edge.along, direction);
    if (!(gain < 0) || edge.inside(point) / -gain >= nearest) continue;
    nearest = edge.inside(point) / -gain;
    hit.point = point + direction * nearest;
    hit.normal = outward(edge.along);
  }
  return hit;
}

template <class Scalar>
std::optional<PointHit<Scalar>> NearbyScenery<Scalar>::first_entry(const Vec2<Scalar>& from,
                                                                   const Vec2<Scalar>& displacement) const noexcept {
  using Kind = typename Stay<Scalar>::Kind;
  const Vec2<Scalar> to = from + displacement;
  SeamStays<Scalar> seams;
  std::optional<PointHit<Scalar>> first;
  const auto take = [&first](const PointHit<Scalar>& hit) {
    if (!first || hit.fraction < first->fraction) first = hit;
  };
  for (const PieceIndex piece : pieces_) {
    if (is_chain(piece)) {
      if (crosses(piece, from, to)) take(crossing(piece, from, to));
      continue;
    }
    const PieceVertices<Scalar> outline = scenery_->vertices_of(piece);
    const Stay<Scalar> stay = stay_in<Scalar>(outline, from, displacement);
    if (stay.kind == Kind::never) continue;
    const Scalar fraction = stay.kind == Kind::inside ? std::max(Scalar(0), stay.enter) : seams.close_with(stay);
    if (!(fraction < 1)) continue;
    if (stay.enter < 0) {
      PointHit<Scalar> hit = way_out(piece, from, -displacement);
      hit.fraction = fraction;
      take(hit);
    } else {
      take({piece, from + displacement * fraction, outward(Edge<Scalar>(outline, stay.edge).along), fraction});
    }
  }
  return first;
}

template class NearbyScenery<float>;
template class NearbyScenery<double>;

}  // namespace paperproof
