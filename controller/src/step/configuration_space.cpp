#include "step/configuration_space.hpp"

#include <paperproof/tolerances.hpp>

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

/// The least n·q of some points.
template <class Points>
double least_along(const Points& points, const Vec2d& n) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& q : points) least = std::min(least, n.x() * q.x() + n.y() * q.y());
  return least;
}

Vec2d unit_normal_right_of(const Vec2d& edge) {
  const double length = std::sqrt(edge.x() * edge.x() + edge.y() * edge.y());
  return {edge.y() / length, -edge.x() / length};
}

}  // namespace

struct ConfigurationSpace::CoverSearch {
  /// For each axis, how far in the order of pieces the one was that covered such a facet last: in a level of tiles the
  /// next facet is mostly covered by the one that is as far.
  std::array<PieceIndex, max_axes> guesses{};
  /// For each shared axis, how a rectangle lay to the one that covered such a facet last. Not a number: none did.
  std::array<Placement, max_shared> known;
  /// What may cover a facet of the present piece, with its sides along the box directions.
  struct Near {
    PieceIndex piece;
    Eigen::Array4d sides;
  };
  std::vector<Near> near;
  std::vector<Interval> covered;  ///< Of the present facet.

  CoverSearch() {
    const Vec2 nowhere = Vec2::Constant(std::numeric_limits<Real>::quiet_NaN());
    known.fill({nowhere, nowhere, nowhere});
  }

  /// Which share of the present facet nothing covers.
  [[nodiscard]] double open_share() {
    std::sort(covered.begin(), covered.end(), [](const Interval& a, const Interval& b) { return a.from < b.from; });
    double open = 0;
    double reached = 0;
    for (const Interval& part : covered) {
      open += std::max(0.0, part.from - reached);
      reached = std::max(reached, part.to);
    }
    return open + std::max(0.0, 1 - reached);
  }
};

ConfigurationSpace::ConfigurationSpace(const Scenery& scenery, const CharacterShape& shape,
                                       const broad_phase::Tree& tree, const MoverPhases& mover_phases)
    : scenery_(scenery), surfaces_(scenery, shape) {
  for (const Vec2d& point : shape.hull()) hull_.push_back(Vec2(point));
  hull_box_ = {Vec2(shape.box().lower), Vec2(shape.box().upper)};
  const std::span<const ColliderInfo> kinds = scenery.collider_kinds();
  filters_differ_ = std::any_of(kinds.begin(), kinds.end(),
                                [&](const ColliderInfo& kind) { return kind.filter != kinds.front().filter; });
  facet_noise_ = least_noise;
  for (const Box2& box : scenery.boxes()) {
    const Real furthest = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    facet_noise_ = std::max(facet_noise_, noise_in_ulps * static_cast<double>(furthest) *
                                              static_cast<double>(std::numeric_limits<Real>::epsilon()));
  }

  build_shared_axes();

  const std::size_t count = scenery.pieces().size();
  info_.reserve(count);
  for (PieceIndex piece = 0; piece < count; ++piece) build_obstacle(piece);
  shared_offsets_.shrink_to_fit();
  own_axes_.shrink_to_fit();
  build_covered(tree, mover_phases);
}

void ConfigurationSpace::build_shared_axes() {
  const auto add = [this](const Vec2d& normal) {
    const Vec2 n = normal.cast<Real>();
    for (std::size_t k = 0; k < shared_count_; ++k)
      if (shared_x_[k] == n.x() && shared_y_[k] == n.y()) return;
    shared_x_[shared_count_] = n.x();
    shared_y_[shared_count_++] = n.y();
  };
  // Box directions first: they tell most misses (see kept_by_box).
  add({0, 1});
  add({1, 0});
  add({-1, 0});
  add({0, -1});
  for (std::size_t k = 0; k < hull_.size(); ++k) {
    const Vec2d edge = hull_[(k + 1) % hull_.size()] - hull_[k];
    add(-unit_normal_right_of(edge));
  }
  lanes_ = shared_count_ <= 8 ? 8 : max_shared;
  for (std::size_t k = 0; k < max_shared; ++k) {
    const std::size_t pair = k / 2;
    const std::size_t half = k % 2;
    // An unused lane is "inside" for ever: never the largest separation, never left.
    shared_low_[pair][half] = -static_cast<double>(std::numeric_limits<Real>::max() / 4);
    if (k >= shared_count_) continue;
    shared_low_[pair][half] = least_along(hull_, {shared_x_[k], shared_y_[k]});
    rightward_[pair][half] = std::max(shared_x_[k], Real(0));
    leftward_[pair][half] = std::min(shared_x_[k], Real(0));
    upward_[pair][half] = std::max(shared_y_[k], Real(0));
    downward_[pair][half] = std::min(shared_y_[k], Real(0));
    shared_faces_[k] = face_along({shared_x_[k], shared_y_[k]});
    hull_faces_[k] = face_of(hull_, {-shared_x_[k], -shared_y_[k]});
  }
}

OctagonFace ConfigurationSpace::face_along(const Vec2& n) const noexcept {
  constexpr Real flat = tolerances.hit;  // points this close to the lowest belong to the face
  OctagonFace face{std::numeric_limits<Real>::infinity(), 0, 0};
  for (const Vec2d& o : hull_) {
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

Real ConfigurationSpace::support_offset(PieceIndex piece, const Vec2d& normal) const noexcept {
  const double radius = scenery_.pieces()[piece].is_circle() ? scenery_.circle(piece).radius : 0;
  return static_cast<Real>(radius - least_along(scenery_.vertices_of(piece), -normal) - least_along(hull_, normal));
}

void ConfigurationSpace::build_obstacle(PieceIndex piece) {
  const std::span<const PieceInfo> pieces = scenery_.pieces();
  const PieceInfo& source = pieces[piece];
  ObstacleInfo info;
  info.first_own = static_cast<std::uint32_t>(own_axes_.size());
  // The normals of a rectangle are all shared.
  if (!source.is_rectangle()) build_own_axes(piece, info);
  if (source.one_way) {
    info.surface = surfaces_.of(piece);
    info.bent_surface = !surfaces_.is_straight(info.surface);
  }
  const auto same = [&](PieceIndex other) { return pieces[other].collider == source.collider; };
  info.whole_collider = !(piece > 0 && same(piece - 1)) && !(piece + 1 < pieces.size() && same(piece + 1));
  info_.push_back(info);
}

/// And the offsets along shared axes that do not follow from the piece's box.
void ConfigurationSpace::build_own_axes(PieceIndex piece, ObstacleInfo& info) {
  const PieceInfo& source = scenery_.pieces()[piece];
  const PieceVertices vertices = scenery_.vertices_of(piece);
  info.first_offset = static_cast<std::uint32_t>(shared_offsets_.size());
  for (std::size_t k = 4; k < lanes_; ++k)
    shared_offsets_.push_back(k < shared_count_ ? support_offset(piece, {shared_x_[k], shared_y_[k]})
                                                : static_cast<Real>(-low(k)));
  const auto axis_of = [&](const Vec2d& normal) -> std::size_t {
    const Vec2 n = normal.cast<Real>();
    for (std::size_t k = 0; k < shared_count_; ++k)
      if (shared_x_[k] == n.x() && shared_y_[k] == n.y()) return k;
    own_axes_.push_back({n, support_offset(piece, n.cast<double>()), face_along(n)});
    return lanes_ + info.own_count++;
  };
  if (source.is_circle()) {
    info.surface = ObstacleInfo::round;
    const Vec2 up{0, 1};
    own_axes_.push_back({up, support_offset(piece, {0, 1}), face_along(up)});
    info.own_count = 1;
    return;
  }
  for (std::size_t j = 0; j < vertices.size(); ++j) {
    const Vec2d edge = vertices[(j + 1) % vertices.size()] - vertices[j];
    const std::size_t axis = axis_of(unit_normal_right_of(edge));
    // The blocking normal of a one-way segment v0 v1 is on its left: the right-hand normal of the way back.
    if (source.one_way && j == 1) info.one_way_axis = static_cast<std::uint8_t>(axis);
  }
}

/// Of the points that reach furthest along a normal, the first and the last across it.
template <class Points>
ConfigurationSpace::Interval ConfigurationSpace::face_of(const Points& points, const Vec2d& normal) const noexcept {
  const Vec2d along{-normal.y(), normal.x()};
  const double least = -least_along(points, -normal) - facet_noise_;
  Interval range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vec2d& point : points) {
    if (normal.dot(point) < least) continue;
    range.from = std::min(range.from, along.dot(point));
    range.to = std::max(range.to, along.dot(point));
  }
  return range;
}

/// The same for a rectangle, of which a normal alone tells the corner; both on a side that it is upright to.
ConfigurationSpace::Interval ConfigurationSpace::face_of_rectangle(const Box2& box,
                                                                   const Vec2d& normal) const noexcept {
  const Vec2d& lower = box.lower;
  const Vec2d& upper = box.upper;
  const auto clear = [&](Eigen::Index i) { return std::abs(normal[i]) * (upper[i] - lower[i]) > facet_noise_; };
  const auto ends = [&](Eigen::Index i) -> std::pair<double, double> {
    if (!clear(i)) return {lower[i], upper[i]};
    return normal[i] > 0 ? std::pair(upper[i], upper[i]) : std::pair(lower[i], lower[i]);
  };
  const auto [left, right] = ends(0);
  const auto [low, high] = ends(1);
  const double x = -normal.y();
  const double y = normal.x();
  return {std::min(x * left, x * right) + std::min(y * low, y * high),
          std::max(x * left, x * right) + std::max(y * low, y * high)};
}

ConfigurationSpace::Facet ConfigurationSpace::facet(PieceIndex piece, std::size_t axis) const noexcept {
  const Vec2d n = normal(piece, axis).cast<double>();
  const Vec2d along{-n.y(), n.x()};
  const Interval of_piece = info_[piece].first_offset == ObstacleInfo::rectangle
                                ? face_of_rectangle(scenery_.box(piece), n)
                                : face_of(scenery_.vertices_of(piece), n);
  const Interval of_hull = axis < lanes_ ? hull_faces_[axis] : face_of(hull_, Vec2d(-n));
  // Number by number: what is put into a vector so and read from it as a whole waits for the memory.
  const auto base = static_cast<double>(offset(piece, axis));
  const auto point = [&](double place) -> Vec2d {
    return {n.x() * base + along.x() * place, n.y() * base + along.y() * place};
  };
  const double from = of_piece.from + of_hull.from;
  const double to = of_piece.to + of_hull.to;
  return {.axis = axis, .from = point(from), .to = point(to), .along = along, .length = to - from};
}

/// A one-way segment hides nothing from a solid: it may be passed. From another it hides what it abuts as a part of one
/// surface, or along one line: who is not above the one is not above the other.
bool ConfigurationSpace::may_cover(PieceIndex covering, PieceIndex piece) const noexcept {
  if (!have_equal_filters(covering, piece)) return false;
  const std::uint8_t a = info_[covering].one_way_axis;
  const std::uint8_t b = info_[piece].one_way_axis;
  if (a == ObstacleInfo::not_one_way || b == ObstacleInfo::not_one_way) [[likely]]
    return a == b;
  if (info_[covering].surface == info_[piece].surface) return true;
  if (info_[covering].bent_surface || info_[piece].bent_surface) return false;
  return normal(covering, a) == normal(piece, b) &&
         std::abs(static_cast<double>(offset(covering, a) - offset(piece, b))) <= facet_noise_;
}

/// An axis that bevels a corner has no facet but the corner itself. It is covered by what has the corner, too, and
/// reaches further along the normal: then that is nearer to whoever comes from there.
bool ConfigurationSpace::is_covered_corner(PieceIndex piece, std::size_t axis, const Vec2d& corner,
                                           std::span<const PieceIndex> neighbours) const noexcept {
  const Vec2d n = normal(piece, axis).cast<double>();
  return std::any_of(neighbours.begin(), neighbours.end(), [&](PieceIndex other) {
    if (other == piece || !may_cover(other, piece)) return false;
    for (std::size_t k = 0; k < axis_count(other); ++k) {
      if (k >= shared_count_ && k < lanes_) continue;
      const double out = normal(other, k).cast<double>().dot(corner) - static_cast<double>(offset(other, k));
      if (out > facet_noise_) return false;
    }
    return !is_circle(other) && static_cast<double>(support_offset(other, n)) > n.dot(corner) + facet_noise_;
  });
}

/// Whatever can cover a facet of a piece meets this box.
Box2 ConfigurationSpace::around(PieceIndex piece) const noexcept {
  const Vec2 reach = hull_box_.upper - hull_box_.lower;
  return {scenery_.box(piece).lower - reach, scenery_.box(piece).upper + reach};
}

/// Only what keeps its place relative to a piece can cover its facets: the pieces that go with the same mover, or none.
void ConfigurationSpace::build_covered(const broad_phase::Tree& tree, const MoverPhases& mover_phases) {
  const Vec2 reach = hull_box_.upper - hull_box_.lower;
  CoverSearch search;
  std::vector<PieceIndex> found(scenery_.pieces().size());
  // Pieces that follow each other mostly stand side by side: one query answers for the next three as well.
  constexpr Real pieces_ahead = 3;
  Box2 asked{reach, -reach};
  std::size_t count = 0;
  const auto standing = [&](PieceIndex piece) -> std::span<const PieceIndex> {
    const Box2 wanted = around(piece);
    if (!asked.contains(wanted)) {
      const Vec2 stride = scenery_.box(piece).lower - scenery_.box(piece > 0 ? piece - 1 : piece).lower;
      const Vec2 ahead = (stride * pieces_ahead).cwiseMax(-2 * reach).cwiseMin(2 * reach);
      asked = wanted.merged({wanted.lower + ahead, wanted.upper + ahead});
      count = tree.query(asked, found);
    }
    return {found.data(), count};
  };
  for (PieceIndex piece = 0; piece < scenery_.static_pieces().end; ++piece)
    if (!is_circle(piece)) build_covered(piece, scenery_.static_pieces(), standing, search);
  for (MoverIndex mover = 0; mover < mover_phases.size(); ++mover) {
    const auto of_mover = [&](PieceIndex piece) { return mover_phases.query(mover, around(piece), found); };
    const PieceRange pieces = scenery_.pieces_of_mover(mover);
    for (PieceIndex piece = pieces.first; piece < pieces.end; ++piece)
      if (!is_circle(piece)) build_covered(piece, pieces, of_mover, search);
  }
}

/// @param neighbours asked for what is near, only where a guess at what covers a facet fails.
template <class Neighbours>
void ConfigurationSpace::build_covered(PieceIndex piece, PieceRange together, const Neighbours& neighbours,
                                       CoverSearch& search) {
  std::span<const PieceIndex> found;  // at least the piece itself, once it was asked for
  for (std::size_t axis = 0; axis < axis_count(piece); ++axis) {
    if (axis < lanes_ && axis >= shared_count_) continue;
    const PieceIndex guess = piece + search.guesses[axis];
    const bool may_guess = guess != piece && guess >= together.first && guess < together.end;
    const bool rectangles = may_guess && info_[piece].first_offset == ObstacleInfo::rectangle &&
                            info_[guess].first_offset == ObstacleInfo::rectangle;
    if (rectangles && placement(piece, guess) == search.known[axis] && have_equal_filters(piece, guess)) {
      set_covered(piece, axis, 0);
      continue;
    }
    const Facet f = facet(piece, axis);
    if (may_guess && may_cover(guess, piece) && lies_in(f, guess)) {
      set_covered(piece, axis, 0);
      if (rectangles) search.known[axis] = placement(piece, guess);
      continue;
    }
    if (found.empty()) {
      found = neighbours(piece);
      find_near(piece, found, search);
    }
    if (f.length > open_enough)
      set_covered(piece, axis, open_part(piece, f, search));
    else if (is_covered_corner(piece, axis, f.from, found))
      set_covered(piece, axis, 0);
  }
}

void ConfigurationSpace::set_covered(PieceIndex piece, std::size_t axis, double open) noexcept {
  const bool covered = open <= open_enough;
  const bool hidden = open <= hidden_enough;
  if (axis >= lanes_) {
    OwnAxis& own = own_axes_[info_[piece].first_own + axis - lanes_];
    own.covered = covered;
    own.hidden = hidden;
    return;
  }
  ObstacleInfo& info = info_[piece];
  info.covered = static_cast<std::uint16_t>(info.covered | unsigned{covered} << axis);
  info.hidden = static_cast<std::uint16_t>(info.hidden | unsigned{hidden} << axis);
}

/// Whether so little of a facet is outside of one other obstacle that it is hidden. Its own axes are not looked at: a
/// piece that has some gives no answer.
bool ConfigurationSpace::lies_in(const Facet& facet, PieceIndex other) const noexcept {
  if (facet.length <= open_enough || info_[other].own_count > 0) return false;
  const double left_out = hidden_enough / 4;  // at either end
  const Vec2d from = facet.from + facet.along * left_out;
  const Vec2d to = facet.to - facet.along * left_out;
  for (std::size_t group = 0; group < lanes_ / 4; ++group) {
    const Eigen::Array4d x = shared_x(group).cast<double>();
    const Eigen::Array4d y = shared_y(group).cast<double>();
    const Eigen::Array4d furthest = (x * from.x() + y * from.y()).max(x * to.x() + y * to.y());
    if (!((furthest - offsets(other, group).cast<double>()).maxCoeff() + facet_noise_ < 0)) return false;
  }
  return true;
}

ConfigurationSpace::Placement ConfigurationSpace::placement(PieceIndex piece, PieceIndex other) const noexcept {
  const Box2& box = scenery_.box(piece);
  const Box2& beside = scenery_.box(other);
  return {box.upper - box.lower, beside.lower - box.lower, beside.upper - box.lower};
}

void ConfigurationSpace::find_near(PieceIndex piece, std::span<const PieceIndex> found, CoverSearch& search) const {
  const Box2 near = around(piece);
  search.near.clear();
  for (const PieceIndex other : found)
    if (other != piece && near.overlaps(scenery_.box(other)) && may_cover(other, piece))
      search.near.push_back({other, box_offsets(other).cast<double>()});
}

/// How much of a facet is in no other obstacle [m].
double ConfigurationSpace::open_part(PieceIndex piece, const Facet& facet, CoverSearch& search) const {
  search.covered.clear();
  const Eigen::Array4d nearest{
      std::min(facet.from.y(), facet.to.y()) + facet_noise_, std::min(facet.from.x(), facet.to.x()) + facet_noise_,
      facet_noise_ - std::max(facet.from.x(), facet.to.x()), facet_noise_ - std::max(facet.from.y(), facet.to.y())};
  for (const auto& [other, sides] : search.near) {
    // Most are apart along a box direction.
    if ((nearest - sides).maxCoeff() >= 0 || is_circle(other)) continue;
    const Interval part = inside(facet, other);
    if (!(part.from < part.to)) continue;
    if ((part.from + (1 - part.to)) * facet.length <= hidden_enough) {
      search.guesses[facet.axis] = other - piece;
      return 0;
    }
    search.covered.push_back(part);
  }
  return search.open_share() * facet.length;
}

/// Which part of a facet is in another obstacle; empty where none is.
ConfigurationSpace::Interval ConfigurationSpace::inside(const Facet& facet, PieceIndex other) const noexcept {
  Interval inside{0, 1};
  const double span_x = facet.to.x() - facet.from.x();
  const double span_y = facet.to.y() - facet.from.y();
  const auto cut = [&](double x, double y, double offset) {
    const double start = x * facet.from.x() + y * facet.from.y() - offset + facet_noise_;
    const double rate = x * span_x + y * span_y;
    // Inside where start + rate t < 0.
    if (rate > 0)
      inside.to = std::min(inside.to, -start / rate);
    else if (rate < 0)
      inside.from = std::max(inside.from, -start / rate);
    else if (start >= 0)
      inside.to = -1;
    return inside.from < inside.to;
  };
  Four four;
  for (std::size_t k = 0; k < shared_count_; ++k) {
    if (k % 4 == 0) four = offsets(other, k / 4);
    if (!cut(shared_x_[k], shared_y_[k], four[static_cast<Eigen::Index>(k % 4)])) return inside;
  }
  for (const OwnAxis& own : own_axes(other))
    if (!cut(own.normal.x(), own.normal.y(), own.offset)) return inside;
  return inside;
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
