#include "step/configuration_space.hpp"

#include <paperproof/tolerances.hpp>

#include <cmath>
#include <limits>

namespace paperproof::octagon_sweep {
namespace {

/// Smallest rounding noise when facets are compared while building [m]. Zero: flush tiles would not cover each other's
/// edges. Large: facets that a narrow gap leaves open would count as covered. It decides normals only, never safety.
constexpr double least_noise = 1e-9;
/// The noise grows with the coordinates: an offset is the sum of a few products of their size.
constexpr double noise_in_ulps = 16;
/// A facet is covered when no more than this of it is open [m]: less than any motion can aim at.
constexpr double open_enough = 1e-6;
/// A facet is hidden when no more of it is open than what counts as closed [m].
constexpr double hidden_enough = 2e-7;

Vec2d unit_normal_right_of(const Vec2d& edge) {
  const double length = std::sqrt(edge.x() * edge.x() + edge.y() * edge.y());
  return {edge.y() / length, -edge.x() / length};
}

/// Part of a facet, as parameters in [0, 1].
struct Interval {
  double from;
  double to;
};

double open_share(std::vector<Interval>& covered) {
  std::sort(covered.begin(), covered.end(), [](const Interval& a, const Interval& b) { return a.from < b.from; });
  double open = 0;
  double reached = 0;
  for (const Interval& part : covered) {
    open += std::max(0.0, part.from - reached);
    reached = std::max(reached, part.to);
  }
  return open + std::max(0.0, 1 - reached);
}

}  // namespace

template <class Scalar>
ConfigurationSpace<Scalar>::ConfigurationSpace(const Scenery<Scalar>& scenery, const CharacterShape& shape,
                                               const BroadPhase<Scalar>& broad_phase,
                                               const MoverPhases<Scalar>& mover_phases)
    : scenery_(scenery), surfaces_(scenery, shape) {
  for (const Vec2d& point : shape.hull()) hull_.push_back(point.cast<Scalar>());
  hull_box_ = {shape.box().lower.cast<Scalar>(), shape.box().upper.cast<Scalar>()};
  build_shared_axes();
  facet_noise_ = least_noise;
  for (const Box2<Scalar>& box : scenery.boxes()) {
    const Scalar furthest = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    facet_noise_ = std::max(facet_noise_, noise_in_ulps * static_cast<double>(furthest) *
                                              static_cast<double>(std::numeric_limits<Scalar>::epsilon()));
  }

  const std::size_t count = scenery.pieces().size();
  shared_offsets_.reserve(count * lanes_);
  info_.reserve(count);
  for (PieceIndex piece = 0; piece < count; ++piece) build_obstacle(piece);

  // Only what keeps its place relative to a piece can cover its facets: the pieces that go with the same mover, or
  // none.
  const Vec2<Scalar> reach = hull_box_.upper - hull_box_.lower;
  std::vector<PieceIndex> neighbours(count);
  const auto around = [&](PieceIndex piece) -> Box2<Scalar> {
    return {scenery.box(piece).lower - reach, scenery.box(piece).upper + reach};
  };
  for (PieceIndex piece = 0; piece < scenery.static_pieces().end; ++piece) {
    const std::size_t found = broad_phase.query(around(piece), neighbours);
    build_covered(piece, {neighbours.data(), found});
  }
  for (MoverIndex mover = 0; mover < mover_phases.size(); ++mover) {
    const PieceRange pieces = scenery.pieces_of_mover(mover);
    for (PieceIndex piece = pieces.first; piece < pieces.end; ++piece)
      build_covered(piece, mover_phases.query(mover, around(piece), neighbours));
  }
}

template <class Scalar>
bool ConfigurationSpace<Scalar>::has_own_axes() const noexcept {
  const auto blocking = std::span(info_).first(scenery_.sensor_pieces().first);
  return std::any_of(blocking.begin(), blocking.end(), [](const ObstacleInfo& info) { return info.own_count > 0; });
}

template <class Scalar>
void ConfigurationSpace<Scalar>::build_shared_axes() {
  const auto add = [this](const Vec2d& normal) {
    const Vec2<Scalar> n = normal.cast<Scalar>();
    for (std::size_t k = 0; k < shared_count_; ++k)
      if (shared_x_[k] == n.x() && shared_y_[k] == n.y()) return;
    shared_x_[shared_count_] = n.x();
    shared_y_[shared_count_++] = n.y();
  };
  // Box directions first: they tell most misses (see clear_of_box).
  add({0, 1});
  add({1, 0});
  add({-1, 0});
  add({0, -1});
  for (std::size_t k = 0; k < hull_.size(); ++k) {
    const Vec2d edge = (hull_[(k + 1) % hull_.size()] - hull_[k]).template cast<double>();
    add(-unit_normal_right_of(edge));
  }
  lanes_ = shared_count_ <= 8 ? 8 : max_shared;
  for (std::size_t k = 0; k < shared_count_; ++k) shared_faces_[k] = face_along({shared_x_[k], shared_y_[k]});
}

template <class Scalar>
OctagonFace<Scalar> ConfigurationSpace<Scalar>::face_along(const Vec2<Scalar>& n) const noexcept {
  constexpr Scalar flat = Tolerances<Scalar>{}.hit;  // points this close to the lowest belong to the face
  OctagonFace<Scalar> face{std::numeric_limits<Scalar>::infinity(), 0, 0};
  for (const Vec2<Scalar>& o : hull_) {
    const Scalar height = n.x() * o.x() + n.y() * o.y();
    const Scalar place = n.x() * o.y() - n.y() * o.x();
    if (height < face.low - flat) face = {height, place, place};
    if (height > face.low + flat) continue;
    face.low = std::min(face.low, height);
    face.from = std::min(face.from, place);
    face.to = std::max(face.to, place);
  }
  return face;
}

template <class Scalar>
Scalar ConfigurationSpace<Scalar>::support_offset(PieceIndex piece, const Vec2d& normal) const noexcept {
  double furthest = -std::numeric_limits<double>::infinity();
  for (const Vec2<Scalar>& v : scenery_.vertices_of(piece))
    furthest = std::max(furthest, normal.x() * static_cast<double>(v.x()) + normal.y() * static_cast<double>(v.y()));
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec2<Scalar>& o : hull_)
    nearest = std::min(nearest, normal.x() * static_cast<double>(o.x()) + normal.y() * static_cast<double>(o.y()));
  return static_cast<Scalar>(furthest - nearest);
}

template <class Scalar>
void ConfigurationSpace<Scalar>::build_obstacle(PieceIndex piece) {
  ObstacleInfo info;
  info.first_own = static_cast<std::uint32_t>(own_axes_.size());
  const PieceInfo& source = scenery_.pieces()[piece];
  const std::span<const Vec2<Scalar>> vertices = scenery_.vertices_of(piece);
  for (std::size_t k = 0; k < lanes_; ++k) {
    const bool used = k < shared_count_;
    const Vec2d normal{static_cast<double>(shared_x_[k]), static_cast<double>(shared_y_[k])};
    // An unused lane is "inside" for ever: never the largest separation, never left.
    shared_offsets_.push_back(used ? support_offset(piece, normal) : std::numeric_limits<Scalar>::max() / 4);
  }
  const auto axis_of = [&](const Vec2d& normal) -> std::size_t {
    const Vec2<Scalar> n = normal.template cast<Scalar>();
    for (std::size_t k = 0; k < shared_count_; ++k)
      if (shared_x_[k] == n.x() && shared_y_[k] == n.y()) return k;
    own_axes_.push_back({n, support_offset(piece, n.template cast<double>()), face_along(n)});
    return lanes_ + info.own_count++;
  };
  if (lanes_ + vertices.size() > max_axes)
    throw InvalidScenery(source.collider, "a convex piece has more than " + std::to_string(max_axes - lanes_) +
                                              " vertices; split the polygon");
  for (std::size_t j = 0; j < vertices.size(); ++j) {
    const Vec2d edge = (vertices[(j + 1) % vertices.size()] - vertices[j]).template cast<double>();
    const std::size_t axis = axis_of(unit_normal_right_of(edge));
    // The blocking normal of a one-way segment v0 v1 is on its left: the right-hand normal of the way back.
    if (source.one_way && j == 1) info.one_way_axis = static_cast<std::uint8_t>(axis);
  }
  if (source.one_way) {
    info.surface = surfaces_.of(piece);
    info.bent_surface = !surfaces_.is_straight(info.surface);
  }
  const std::span<const PieceInfo> pieces = scenery_.pieces();
  const auto same = [&](PieceIndex other) { return pieces[other].collider == source.collider; };
  info.whole_collider = !(piece > 0 && same(piece - 1)) && !(piece + 1 < pieces.size() && same(piece + 1));
  info_.push_back(info);
}

template <class Scalar>
typename ConfigurationSpace<Scalar>::Facet ConfigurationSpace<Scalar>::facet(PieceIndex piece,
                                                                             std::size_t axis) const noexcept {
  const Vec2d n = normal(piece, axis).template cast<double>();
  const Vec2d along{-n.y(), n.x()};
  // Of the points that reach furthest along n, the first and the last along the facet.
  const auto extremes = [&](std::span<const Vec2<Scalar>> points, double sign) {
    double best = -std::numeric_limits<double>::infinity();
    for (const Vec2<Scalar>& q : points) best = std::max(best, sign * n.dot(q.template cast<double>()));
    Interval range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Vec2<Scalar>& q : points) {
      const Vec2d point = q.template cast<double>();
      if (sign * n.dot(point) < best - facet_noise_) continue;
      range.from = std::min(range.from, sign * along.dot(point));
      range.to = std::max(range.to, sign * along.dot(point));
    }
    return range;
  };
  const Interval of_piece = extremes(scenery_.vertices_of(piece), 1);
  const Interval of_hull = extremes(hull(), -1);
  const Vec2d base = n * static_cast<double>(offset(piece, axis));
  return {base + along * (of_piece.from + of_hull.from), base + along * (of_piece.to + of_hull.to)};
}

/// A one-way segment hides nothing from a solid: it may be passed. From another it hides what it abuts as a part of one
/// surface, or along one line: who is not above the one is not above the other.
template <class Scalar>
bool ConfigurationSpace<Scalar>::may_cover(PieceIndex covering, PieceIndex piece) const noexcept {
  const std::uint8_t a = info_[covering].one_way_axis;
  const std::uint8_t b = info_[piece].one_way_axis;
  if (a == ObstacleInfo::not_one_way || b == ObstacleInfo::not_one_way) return a == b;
  if (info_[covering].surface == info_[piece].surface) return true;
  if (info_[covering].bent_surface || info_[piece].bent_surface) return false;
  return normal(covering, a) == normal(piece, b) &&
         std::abs(static_cast<double>(offset(covering, a) - offset(piece, b))) <= facet_noise_;
}

/// An axis that bevels a corner has no facet but the corner itself. It is covered by what has the corner, too, and
/// reaches further along the normal: then that is nearer to whoever comes from there.
template <class Scalar>
bool ConfigurationSpace<Scalar>::is_covered_corner(PieceIndex piece, std::size_t axis, const Vec2d& corner,
                                                   std::span<const PieceIndex> neighbours) const noexcept {
  const Vec2d n = normal(piece, axis).template cast<double>();
  return std::any_of(neighbours.begin(), neighbours.end(), [&](PieceIndex other) {
    if (other == piece || !may_cover(other, piece)) return false;
    for (std::size_t k = 0; k < axis_count(other); ++k) {
      if (k >= shared_count_ && k < lanes_) continue;
      const double out = normal(other, k).template cast<double>().dot(corner) - static_cast<double>(offset(other, k));
      if (out > facet_noise_) return false;
    }
    return static_cast<double>(support_offset(other, n)) > n.dot(corner) + facet_noise_;
  });
}

template <class Scalar>
void ConfigurationSpace<Scalar>::build_covered(PieceIndex piece, std::span<const PieceIndex> neighbours) {
  std::vector<Interval> covered;
  for (std::size_t axis = 0; axis < axis_count(piece); ++axis) {
    if (axis < lanes_ && axis >= shared_count_) continue;
    const Facet f = facet(piece, axis);
    const Vec2d span = f.to - f.from;
    const double length = std::sqrt(span.dot(span));
    if (length <= open_enough) {
      if (is_covered_corner(piece, axis, f.from, neighbours)) {
        info_[piece].covered |= std::uint64_t{1} << axis;
        info_[piece].hidden |= std::uint64_t{1} << axis;
      }
      continue;
    }
    covered.clear();
    for (const PieceIndex other : neighbours) {
      if (other == piece || !may_cover(other, piece)) continue;
      Interval inside{0, 1};
      for (std::size_t k = 0; k < axis_count(other) && inside.from < inside.to; ++k) {
        if (k < lanes_ && k >= shared_count_) continue;
        const Vec2d n = normal(other, k).template cast<double>();
        const double start = n.dot(f.from) - static_cast<double>(offset(other, k)) + facet_noise_;
        const double rate = n.dot(span);
        // Inside where start + rate t < 0.
        if (rate > 0)
          inside.to = std::min(inside.to, -start / rate);
        else if (rate < 0)
          inside.from = std::max(inside.from, -start / rate);
        else if (start >= 0)
          inside.to = -1;
      }
      if (inside.from < inside.to) covered.push_back(inside);
      if (inside.from == 0 && inside.to == 1) break;  // nothing is left to be covered
    }
    if (covered.empty()) continue;
    const double open = open_share(covered) * length;
    if (open <= open_enough) info_[piece].covered |= std::uint64_t{1} << axis;
    if (open <= hidden_enough) info_[piece].hidden |= std::uint64_t{1} << axis;
  }
}

template class ConfigurationSpace<float>;
template class ConfigurationSpace<double>;

}  // namespace paperproof::octagon_sweep
