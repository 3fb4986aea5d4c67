#include "techniques/nearby_scenery.hpp"

#include <cmath>
#include <limits>

namespace paperproof {
namespace {

double cross(const Vec2d& a, const Vec2d& b) noexcept { return a.x() * b.y() - a.y() * b.x(); }

/// The right-hand normal of an edge: outwards, as pieces run counter-clockwise.
Vec2d outward(const Vec2d& edge) noexcept {
  const double length = std::sqrt(edge.x() * edge.x() + edge.y() * edge.y());
  return {edge.y() / length, -edge.x() / length};
}

/// The edge of a convex outline that ends at vertex `i`, by its start and direction.
struct Edge {
  Vec2d start;
  Vec2d along;

  Edge(std::span<const Vec2d> outline, std::size_t i) noexcept
      : start(outline[i == 0 ? outline.size() - 1 : i - 1]), along(outline[i] - start) {}

  /// Positive strictly inside, by the signed area that a point spans with the edge [m²].
  [[nodiscard]] double inside(const Vec2d& point) const noexcept {
    const Vec2d from_start = point - start;
    return cross(along, from_start);
  }
};

enum class Place : std::uint8_t { outside, edge, inside };

/// `along` is valid for `Place::edge`: the direction of the edge whose open middle holds the point.
Place place_in(std::span<const Vec2d> outline, const Vec2d& point, Vec2d& along) noexcept {
  Place place = Place::inside;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Edge edge(outline, i);
    const double inside = edge.inside(point);
    if (inside < 0) return Place::outside;
    if (inside > 0) continue;
    if (place == Place::edge) return Place::outside;  // on two edges: a corner
    place = Place::edge;
    along = edge.along;
  }
  return place;
}

/// Two edges that hold the same point, each with its piece on the left, are a seam.
bool run_against(const Vec2d& along, const Vec2d& other) noexcept {
  return cross(along, other) == 0 && along.dot(other) < 0;
}

/// When a moving point is inside a convex outline.
struct Stay {
  enum class Kind : std::uint8_t {
    never,
    inside,
    along_left,   ///< It only runs along an edge, with the piece on its left. Two such pieces, left and right, make a
    along_right,  ///< seam, and the point is in the solid while both last.
  };
  Kind kind = Kind::inside;
  double enter = -std::numeric_limits<double>::infinity();  ///< Negative infinity: inside from the start.
  double leave = std::numeric_limits<double>::infinity();
  std::size_t edge = 0;  ///< Entered through the one that ends at this vertex.
};

Stay stay_in(std::span<const Vec2d> outline, const Vec2d& from, const Vec2d& displacement) noexcept {
  using Kind = typename Stay::Kind;
  Stay stay;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Edge edge(outline, i);
    const double inside = edge.inside(from);
    const double gain = cross(edge.along, displacement);
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
  const double begin = std::max(0.0, stay.enter);
  if (!(begin < stay.leave) || !(begin < 1)) stay.kind = Kind::never;
  return stay;
}

}  // namespace

std::optional<PieceIndex> NearbyScenery::containing(const Vec2d& point) const noexcept {
  FixedVector<Vec2d, 4> edges;  // that hold the point, one per piece
  for (const PieceIndex piece : pieces_) {
    if (is_chain(piece) || !scenery_->box(piece).contains({point, point})) continue;
    Vec2d along{Vec2d::Zero()};
    const Place place = place_in(scenery_->vertices_of(piece), point, along);
    if (place == Place::inside) return piece;
    if (place == Place::outside) continue;
    const auto closes = [&](const Vec2d& other) { return run_against(along, other); };
    if (std::ranges::any_of(edges, closes) || is_seam(point, along)) return piece;
    edges.push_back(along);
  }
  return std::nullopt;
}

/// Another object's edge runs along this one where the point is.
bool NearbyScenery::is_seam(const Vec2d& point, const Vec2d& along) const noexcept {
  return std::any_of(around_.begin(), around_.end(), [&](PieceIndex piece) {
    if (is_chain(piece) || !scenery_->box(piece).contains({point, point})) return false;
    Vec2d other{Vec2d::Zero()};
    return place_in(scenery_->vertices_of(piece), point, other) == Place::edge && run_against(along, other);
  });
}

NearbyScenery NearbyScenery::object_at_front(std::span<const PieceIndex> rest) const noexcept {
  const auto collider_of = [this](PieceIndex piece) { return scenery_->pieces()[piece].collider; };
  const auto end = std::find_if(rest.begin(), rest.end(),
                                [&](PieceIndex piece) { return collider_of(piece) != collider_of(rest.front()); });
  NearbyScenery object(*scenery_, rest.first(static_cast<std::size_t>(end - rest.begin())));
  object.around_ = pieces_;
  return object;
}

bool NearbyScenery::crosses(PieceIndex piece, const Vec2d& from, const Vec2d& to) const noexcept {
  const PieceVertices ends = scenery_->vertices_of(piece);
  const Edge segment(ends, 1);
  const double before = segment.inside(from);  // positive on the left, where a one-way segment's normal points
  const double after = segment.inside(to);
  if (scenery_->pieces()[piece].one_way) {
    if (before < 0 || after >= 0) return false;
  } else if (before == 0 || (before > 0 ? after > 0 : after < 0)) {
    return false;
  }
  const Vec2d motion = to - from;
  const Vec2d to_first = ends[0] - from;
  const Vec2d to_second = ends[1] - from;
  const double first = cross(motion, to_first);
  const double second = cross(motion, to_second);
  return (first <= 0 && second >= 0) || (first >= 0 && second <= 0);
}

std::optional<PieceIndex> NearbyScenery::crossed(const Vec2d& from, const Vec2d& to) const noexcept {
  for (const PieceIndex piece : pieces_) {
    if (is_chain(piece) && crosses(piece, from, to)) return piece;
  }
  return std::nullopt;
}

PointHit NearbyScenery::crossing(PieceIndex piece, const Vec2d& from, const Vec2d& to) const noexcept {
  const PieceVertices ends = scenery_->vertices_of(piece);
  const Edge segment(ends, 1);
  const double before = segment.inside(from);
  const double after = segment.inside(to);
  PointHit hit{.piece = piece};
  hit.fraction = before / (before - after);
  hit.point = from + (to - from) * hit.fraction;
  const Vec2d right = outward(segment.along);
  hit.normal = after < before ? Vec2d(-right) : right;
  return hit;
}

PointHit NearbyScenery::way_out(PieceIndex piece, const Vec2d& point, const Vec2d& direction) const noexcept {
  const PieceVertices outline = scenery_->vertices_of(piece);
  double nearest = std::numeric_limits<double>::infinity();
  PointHit hit{.piece = piece, .point = point};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Edge edge(outline, i);
    const double gain = cross(edge.along, direction);
    if (!(gain < 0) || edge.inside(point) / -gain >= nearest) continue;
    nearest = edge.inside(point) / -gain;
    hit.point = point + direction * nearest;
    hit.normal = outward(edge.along);
  }
  return hit;
}

std::optional<PointHit> NearbyScenery::first_entry(const Vec2d& from, const Vec2d& displacement) const noexcept {
  using Kind = typename Stay::Kind;
  const Vec2d to = from + displacement;
  FixedVector<Stay, 16> seams;  // stays along edges, waiting for their counterpart on the other side
  std::optional<PointHit> first;
  const auto take = [&first](const PointHit& hit) {
    if (!first || hit.fraction < first->fraction) first = hit;
  };
  for (const PieceIndex piece : pieces_) {
    if (is_chain(piece)) {
      if (crosses(piece, from, to)) take(crossing(piece, from, to));
      continue;
    }
    const PieceVertices outline = scenery_->vertices_of(piece);
    const Stay stay = stay_in(outline, from, displacement);
    if (stay.kind == Kind::never) continue;
    double fraction = stay.kind == Kind::inside ? std::max(0.0, stay.enter) : 1;
    if (stay.kind != Kind::inside) {
      for (const Stay& other : seams) {
        const double begin = std::max({0.0, stay.enter, other.enter});
        if (other.kind != stay.kind && begin < std::min(stay.leave, other.leave)) fraction = std::min(fraction, begin);
      }
      seams.push_back(stay);
    }
    if (!(fraction < 1)) continue;
    if (stay.enter < 0) {
      PointHit hit = way_out(piece, from, -displacement);
      hit.fraction = fraction;
      take(hit);
    } else {
      take({piece, from + displacement * fraction, outward(Edge(outline, stay.edge).along), fraction});
    }
  }
  return first;
}

}  // namespace paperproof
