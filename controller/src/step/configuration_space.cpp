#include "step/configuration_space.hpp"

#include "geometry/vectors.hpp"

#include <cmath>
#include <limits>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {
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

using geometry::least_along;
using geometry::normal_of;

/// Of the points that reach furthest along a normal, the first and the last across it.
/// @param noise that counts as equally far [m].
template <class Points>
Interval face_of(const Points& points, const Vec2d& normal, double noise) {
  const Vec2d along{-normal.y(), normal.x()};
  const double least = -least_along(points, -normal) - noise;
  Interval range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vec2d& point : points) {
    if (normal.dot(point) < least) continue;
    range.from = std::min(range.from, along.dot(point));
    range.to = std::max(range.to, along.dot(point));
  }
  return range;
}

}  // namespace

SharedAxes::SharedAxes(const CharacterShape& shape) : box(shape.box()) {
  for (const Vec2d& point : shape.hull()) points.push_back(Vec2(point));
  const auto add = [this](const Vec2d& normal) {
    const Vec2 n = normal.cast<Real>();
    for (std::size_t k = 0; k < count; ++k)
      if (x[k] == n.x() && y[k] == n.y()) return;
    x[count] = n.x();
    y[count++] = n.y();
  };
  // Box directions first: they tell most misses (see kept_by_box).
  add({0, 1});
  add({1, 0});
  add({-1, 0});
  add({0, -1});
  for (std::size_t k = 0; k < points.size(); ++k) add(normal_of(points[(k + 1) % points.size()] - points[k]));
  lanes = count <= 8 ? 8 : most;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2 n{x[k], y[k]};
    low[k] = least_along(points, n.cast<double>());
    faces[k] = face_along(n);
    hull_faces[k] = face_of(points, Vec2d(-n.cast<double>()), least_noise);
  }
}

OctagonFace SharedAxes::face_along(const Vec2& n) const {
  constexpr Real flat = tolerances.hit;  // points this close to the lowest belong to the face
  OctagonFace face{std::numeric_limits<Real>::infinity(), 0, 0};
  for (const Vec2d& o : points) {
    const Real height = n.x() * o.x() + n.y() * o.y();
    const Real place = n.x() * o.y() - n.y() * o.x();
    if (height < face.low - flat) face = {height, place, place};
    if (height > face.low + flat) continue;
    face.low = std::min(face.low, height);
    face.from = std::min(face.from, place);
    face.to = std::max(face.to, place);
  }
  return face;
}

ConfigurationSpace::ConfigurationSpace(const CharacterShape& shape, const PieceFinder& solids)
    : solids_(solids),
      shape_(shape),
      surfaces_(solids.scenery(), shape),
      axes_(shape),
      edit_(solids.scenery().edits().count()),
      index_of_(solids.scenery().pieces().size()) {}

void ConfigurationSpace::follow_edits() {
  const auto edits = scenery().edits().since(edit_);
  edit_ = scenery().edits().count();
  index_of_.resize(scenery().pieces().size());
  if (!edits || std::any_of(edits->begin(), edits->end(), [](const Edit& edit) { return edit.one_way; }))
    return drop_all();
  for (const Edit& edit : *edits) {
    for (PieceIndex piece = edit.pieces.first; piece < edit.pieces.end; ++piece) drop(piece);
    neighbours_.clear();
    // What has an angle may be near along any direction.
    const Vec2d near = edit.mover == no_mover ? reach() : Vec2d::Constant(reach().norm());
    if (edit.mover == no_mover || edit.mover < scenery().mover_count())
      solids_.find(edit.mover, {edit.box.lower - near, edit.box.upper + near}, neighbours_);
    for (const PieceIndex piece : neighbours_) drop(piece);
  }
}

void ConfigurationSpace::drop(PieceIndex source) {
  PieceIndex& index = index_of_[source];
  if (index == 0) return;
  free_obstacles_.push_back(index - 1);
  index = 0;
}

/// One-way chains may be joined otherwise.
void ConfigurationSpace::drop_all() {
  surfaces_ = OneWaySurfaces(scenery(), shape_);
  turned_surfaces_.clear();
  std::ranges::fill(index_of_, 0);
  obstacles_.clear();
  free_obstacles_.clear();
}

/// Of the one-way segments of a mover that has this angle, or of all others.
const OneWaySurfaces& ConfigurationSpace::surfaces_of(MoverIndex mover, double angle) {
  if (angle == 0) return surfaces_;
  const auto known = turned_surfaces_.find(mover);
  if (known != turned_surfaces_.end() && known->second.angle == angle) return known->second.surfaces;
  TurnedSurfaces now{angle, OneWaySurfaces(scenery(), shape_, mover, angle)};
  return turned_surfaces_.insert_or_assign(mover, std::move(now)).first->second.surfaces;
}

Real ConfigurationSpace::support_offset(const Obstacle& of, const Vec2d& normal) const {
  const double radius = of.source.is_circle() ? scenery().circle(of.piece).radius : 0;
  return static_cast<Real>(radius - least_along(vertices_of(of), -normal) - least_along(hull(), normal));
}

void ConfigurationSpace::prepare(std::span<PieceIndex> pieces, MoverIndex mover, double angle) {
  for (PieceIndex& piece : pieces) {
    piece = make(piece, angle);
    obstacles_[piece].source.mover = mover;
    if (!obstacles_[piece].knows_its_seams) find_seams(piece);
  }
}

/// Makes the obstacle of a piece, unless it is there with the same angle. @return its index.
PieceIndex ConfigurationSpace::make(PieceIndex source, double angle) {
  PieceIndex& index = index_of_[source];
  if (index == 0) {
    if (free_obstacles_.empty()) {
      free_obstacles_.push_back(static_cast<PieceIndex>(obstacles_.size()));
      obstacles_.emplace_back();
    }
    index = free_obstacles_.back() + 1;
    free_obstacles_.pop_back();
  } else if (obstacles_[index - 1].angle == angle) {
    return index - 1;
  }
  fill(obstacles_[index - 1], source, angle);
  return index - 1;
}

/// @param obstacle a free one, or that of the piece at another angle.
void ConfigurationSpace::fill(Obstacle& obstacle, PieceIndex source, double angle) {
  const std::span<const PieceInfo> pieces = scenery().pieces();
  const PieceInfo& info = pieces[source];
  const auto same = [&](PieceIndex other) { return pieces[other].collider == info.collider; };
  obstacle = {.offsets = {},
              .box = scenery().box(source),
              .source = info,
              .collider = &scenery().collider(info.collider),
              .piece = source,
              .own = std::move(obstacle.own),
              .angle = angle,
              .turned = std::move(obstacle.turned)};
  obstacle.whole_collider = !(source > 0 && same(source - 1)) && !(source + 1 < pieces.size() && same(source + 1));
  obstacle.turned.clear();
  obstacle.own.clear();
  if (info.mover != no_mover) {
    obstacle.turned.reserve(info.vertex_count);
    obstacle.own.reserve(info.vertex_count);
  }
  if (angle != 0) {
    const PieceVertices vertices = scenery().vertices_of(source);
    geometry::place({vertices.begin(), vertices.end()}, {.angle = angle}, obstacle.turned);
    obstacle.box = Box2::around(obstacle.turned);
    if (info.is_circle()) obstacle.box = obstacle.box.inflated(scenery().circle(source).radius);
    obstacle.source.rectangle_corner = PieceInfo::no_rectangle;
  }
  if (info.one_way) {
    obstacle.surfaces = &surfaces_of(info.mover, angle);
    obstacle.surface = obstacle.surfaces->of(source);
    obstacle.bent_surface = !obstacle.surfaces->is_straight(obstacle.surface);
  }
  find_axes(obstacle);
}

void ConfigurationSpace::find_axes(Obstacle& obstacle) {
  const PieceInfo& source = obstacle.source;
  const Vec2d& lower = obstacle.box.lower;
  const Vec2d& upper = obstacle.box.upper;
  // An unused lane is "inside" for ever: never the largest separation, never left.
  obstacle.offsets.all.fill(std::numeric_limits<Real>::max() / 4);
  for (std::size_t k = 0; k < axes_.count; ++k) {
    // Furthest along a normal is, of a rectangle, the corner on its side.
    const double x = axes_.x[k];
    const double y = axes_.y[k];
    const double furthest = (std::max(x, 0.0) * upper.x() + std::min(x, 0.0) * lower.x()) +
                            (std::max(y, 0.0) * upper.y() + std::min(y, 0.0) * lower.y());
    obstacle.offsets.all[k] =
        k < 4 || source.is_rectangle() ? static_cast<Real>(furthest - axes_.low[k]) : support_offset(obstacle, {x, y});
  }
  if (source.is_rectangle()) return;  // its normals are all shared
  const auto add = [&](const Vec2& n) {
    obstacle.own.push_back({n, support_offset(obstacle, n.cast<double>()), face_along(n)});
    return axes_.lanes + obstacle.own.size() - 1;
  };
  const auto axis_of = [&](const Vec2d& normal) -> std::size_t {
    const Vec2 n = normal.cast<Real>();
    for (std::size_t k = 0; k < axes_.count; ++k)
      if (axes_.x[k] == n.x() && axes_.y[k] == n.y()) return k;
    return add(n);
  };
  if (source.is_circle()) return void(add({0, 1}));
  const PieceVertices vertices = vertices_of(obstacle);
  for (std::size_t j = 0; j < vertices.size(); ++j) {
    const Vec2d edge = vertices[(j + 1) % vertices.size()] - vertices[j];
    const std::size_t axis = axis_of(-normal_of(edge));
    // The blocking normal of a one-way segment v0 v1 is on its left: the right-hand normal of the way back.
    if (source.one_way && j == 1) obstacle.one_way_axis = static_cast<std::uint8_t>(axis);
  }
}

/// Only what keeps its place relative to a piece can cover its facets: the pieces that go with the same mover, or none.
void ConfigurationSpace::find_seams(PieceIndex piece) {
  obstacles_[piece].knows_its_seams = true;
  if (is_circle(piece)) return;
  // Whatever can cover a facet meets this box.
  const Box2 around{info(piece).box.lower - reach(), info(piece).box.upper + reach()};
  const double furthest = std::max(around.lower.cwiseAbs().maxCoeff(), around.upper.cwiseAbs().maxCoeff());
  const double noise = std::max(least_noise, noise_in_ulps * furthest * double{std::numeric_limits<Real>::epsilon()});
  neighbours_.clear();
  const double angle = info(piece).angle;
  const MoverIndex mover = scenery().pieces()[info(piece).piece].mover;
  solids_.find(mover, angle == 0 ? around : geometry::Turn(-angle)(around), neighbours_);
  // A circle covers nothing, and may go by itself: at another angle.
  std::erase_if(neighbours_, [&](PieceIndex other) { return scenery().pieces()[other].is_circle(); });
  for (PieceIndex& other : neighbours_) other = make(other, angle);
  std::erase_if(neighbours_, [&](PieceIndex other) { return other == piece || !may_cover(other, piece, noise); });
  if (neighbours_.empty()) return;
  for (std::size_t axis = 0; axis < axis_count(piece); ++axis) {
    if (is_unused(axis)) continue;
    const Facet here = facet(piece, axis, noise);
    const bool is_corner = here.length <= open_enough;
    if (is_corner && !is_covered_corner(piece, here)) continue;
    const double open = is_corner ? 0 : open_part(here);
    obstacles_[piece].covered |= std::uint64_t{open <= open_enough} << axis;
    obstacles_[piece].hidden |= std::uint64_t{open <= hidden_enough} << axis;
  }
}

ConfigurationSpace::Facet ConfigurationSpace::facet(PieceIndex piece, std::size_t axis, double noise) const {
  const Vec2d n = normal(piece, axis).cast<double>();
  const Interval of_piece = face_of(vertices_of(piece), n, noise);
  const Interval of_hull = axis < axes_.lanes ? axes_.hull_faces[axis] : face_of(hull(), Vec2d(-n), least_noise);
  const auto base = static_cast<double>(offset(piece, axis));
  const auto point = [&](double place) -> Vec2d { return n * base + Vec2d(-n.y(), n.x()) * place; };
  const double from = of_piece.from + of_hull.from;
  const double to = of_piece.to + of_hull.to;
  return {.axis = axis, .from = point(from), .to = point(to), .length = to - from, .noise = noise};
}

/// A one-way segment hides nothing from a solid: it may be passed. From another it hides what it abuts as a part of one
/// surface, or along one line: who is not above the one is not above the other. A piece that is not there for some
/// characters hides nothing of one that is.
bool ConfigurationSpace::may_cover(PieceIndex covering, PieceIndex piece, double noise) const {
  const Obstacle& one = info(covering);
  const Obstacle& other = info(piece);
  if (one.collider->filter != other.collider->filter) return false;
  if (!one.is_one_way() || !other.is_one_way()) return one.one_way_axis == other.one_way_axis;
  if (one.surface == other.surface) return true;
  if (one.bent_surface || other.bent_surface) return false;
  return normal(covering, one.one_way_axis) == normal(piece, other.one_way_axis) &&
         std::abs(static_cast<double>(offset(covering, one.one_way_axis) - offset(piece, other.one_way_axis))) <= noise;
}

/// An axis that bevels a corner has no facet but the corner itself. It is covered by what has the corner, too, and
/// reaches further along the normal: then that is nearer to whoever comes from there.
bool ConfigurationSpace::is_covered_corner(PieceIndex piece, const Facet& corner) const {
  const Vec2d n = normal(piece, corner.axis).cast<double>();
  return std::ranges::any_of(neighbours_, [&](PieceIndex other) {
    for (std::size_t k = 0; k < axis_count(other); ++k) {
      if (is_unused(k)) continue;
      const double out = normal(other, k).cast<double>().dot(corner.from) - static_cast<double>(offset(other, k));
      if (out > corner.noise) return false;
    }
    return static_cast<double>(support_offset(info(other), n)) > n.dot(corner.from) + corner.noise;
  });
}

/// How much of a facet is in no other obstacle [m].
double ConfigurationSpace::open_part(const Facet& facet) {
  inside_.clear();
  for (const PieceIndex other : neighbours_) {
    const Interval part = inside(facet, other);
    if (part.from < part.to) inside_.push_back(part);
  }
  std::ranges::sort(inside_, {}, &Interval::from);
  double open = 0;
  double reached = 0;
  for (const Interval& part : inside_) {
    open += std::max(0.0, part.from - reached);
    reached = std::max(reached, part.to);
  }
  return (open + std::max(0.0, 1 - reached)) * facet.length;
}

/// Which part of a facet is in another obstacle; empty where none is.
Interval ConfigurationSpace::inside(const Facet& facet, PieceIndex other) const {
  Interval inside{0, 1};
  const Vec2d span = facet.to - facet.from;
  for (std::size_t k = 0; k < axis_count(other); ++k) {
    if (is_unused(k)) continue;
    const Vec2d n = normal(other, k).cast<double>();
    const double start = n.dot(facet.from) - static_cast<double>(offset(other, k)) + facet.noise;
    const double rate = n.dot(span);
    // Inside where start + rate t < 0.
    if (rate > 0)
      inside.to = std::min(inside.to, -start / rate);
    else if (rate < 0)
      inside.from = std::max(inside.from, -start / rate);
    else if (start >= 0)
      return {1, 0};
    if (!(inside.from < inside.to)) return inside;
  }
  return inside;
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
