/// The solids as the oracle keeps them: boundaries as edges, uncut, in two trees of boxes for each mover. A disc has no
/// edges: each is asked by itself.
#pragma once

#include "oracle/box_tree.hpp"
#include "oracle/one_way.hpp"
#include "oracle/predicates.hpp"
#include "oracle/way.hpp"

#include <paperproof/scenery.hpp>

#include <atomic>
#include <optional>
#include <span>
#include <vector>

namespace paperproof::compare::detail {

/// A boundary edge of a polygon, its interior on the left, or a segment of a chain; of what is one-way with its
/// blocking normal on the left (segments that block nothing are not kept).
struct Edge {
  Vec2d a;
  Vec2d b;
  ColliderIndex collider = 0;
  static constexpr std::uint32_t no_surface = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t surface = no_surface;  ///< Of a one-way segment, into `World::surfaces()`.
};

enum class Kind : std::uint8_t { polygon, two_sided, one_way, disc };

struct Solid {
  Kind kind = Kind::polygon;
  std::uint32_t group = 0;  ///< Into `World::groups()`.
  std::uint32_t first_edge = 0;
  std::uint32_t edge_count = 0;
  int unit = 0;  ///< Lowest bit of its vertices, or of centre and radius.
  Box2 box;
};

/// What goes along with one mover, or stands: its frame is the one where that mover's offset is zero. Sensors are kept
/// apart from solids, so that no question about solids finds one.
struct Group {
  MoverIndex mover = no_mover;
  bool sensor = false;
  std::vector<ColliderIndex> colliders;
  Box2 box;
  BoxTree edge_tree;
  BoxTree solid_tree;
};

/// The octagon counter-clockwise and without repeated points.
/// @throws std::invalid_argument for one without area, or with more than 16 points.
[[nodiscard]] std::vector<Vec2d> normalised(std::vector<Vec2d> points);

/// Everything that does not change from question to question. Immutable, apart from the counter.
class World {
 public:
  World(const SceneryDef& scenery, std::vector<Vec2d> points);

  [[nodiscard]] const SceneryDef& scenery() const noexcept { return scenery_; }
  [[nodiscard]] std::span<const Vec2d> points() const noexcept { return points_; }
  [[nodiscard]] const Box2& points_box() const noexcept { return points_box_; }
  [[nodiscard]] std::span<const Edge> edges() const noexcept { return edges_; }
  [[nodiscard]] std::span<const Edge> edges_of(ColliderIndex collider) const noexcept {
    return std::span(edges_).subspan(solids_[collider].first_edge, solids_[collider].edge_count);
  }
  [[nodiscard]] std::span<const Solid> solids() const noexcept { return solids_; }
  [[nodiscard]] std::span<const Group> groups() const noexcept { return groups_; }
  [[nodiscard]] std::span<const Surface> surfaces() const noexcept { return surfaces_; }
  /// One more than the highest mover that a collider goes along with.
  [[nodiscard]] std::size_t mover_count() const noexcept { return mover_count_; }
  [[nodiscard]] const Group& group_of(ColliderIndex collider) const noexcept {
    return groups_[solids_[collider].group];
  }
  /// A point strictly inside the octagon, relative to its position.
  [[nodiscard]] const Vec2d& witness() const noexcept { return witness_; }
  /// Encloses all that the octagon touches on the way.
  [[nodiscard]] Box2 box_of(const Way& way) const noexcept;
  /// The unit in which everything about this way and this solid is an integer.
  [[nodiscard]] int unit_of(const Way& way, ColliderIndex collider) const noexcept {
    return std::min({solids_[collider].unit, points_unit_, way.unit()});
  }
  [[nodiscard]] int unit_of(const Way& way, const Surface& surface) const noexcept {
    return std::min({surface.unit, points_unit_, way.unit()});
  }

  void count_exact() const noexcept { exact_decisions_.fetch_add(1, std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t exact_decisions() const noexcept {
    return exact_decisions_.load(std::memory_order_relaxed);
  }

 private:
  void add_polygon(ColliderIndex index);
  void add_disc(ColliderIndex index);
  void add_chain(ColliderIndex index);
  void add_one_way(ColliderIndex index);
  void add_edge(ColliderIndex index, const Vec2d& a, const Vec2d& b);
  [[nodiscard]] std::uint32_t find_group(const ColliderDef& def);
  void build_trees(Group& group) const;

  SceneryDef scenery_;
  std::vector<Vec2d> points_;
  Vec2d witness_{Vec2d::Zero()};
  Box2 points_box_;
  int points_unit_ = 0;
  std::vector<Edge> edges_;
  std::vector<Solid> solids_;
  std::vector<Group> groups_;
  SurfaceFinder surface_finder_;
  std::vector<Surface> surfaces_;
  std::size_t mover_count_ = 0;
  mutable std::atomic<std::uint64_t> exact_decisions_{0};
};

/// The last double in [0, 1) at which something is not yet so that is so from some moment on, 1 included.
template <class Question>
[[nodiscard]] double last_before(const Question& is_so) {
  double before = 0;
  double after = 1;
  for (;;) {
    const double middle = before + (after - before) / 2;
    if (!(before < middle && middle < after)) return before;
    (is_so(middle) ? after : before) = middle;
  }
}

/// Twice the signed area of a ring: positive when it runs counter-clockwise. Exact.
[[nodiscard]] Sign winding(std::span<const Vec2d> ring);

/// The sign of (end - start) × (to - from), exact.
[[nodiscard]] Sign side(const Vec2d& start, const Vec2d& end, const Vec2d& from, const Vec2d& to);
/// The sign of the turn a → b → c, exact.
[[nodiscard]] inline Sign turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) { return side(a, b, a, c); }

/// The octagon and its way in one kind of number.
template <class Number>
struct Frame {
  Convert<Number> number;
  Point<Number> from;
  Point<Number> way;
  Octagon<Number> octagon;
  Hull<Number> hull{};  ///< Of the way, where asked for,
  bool known = false;   ///< and known.
  [[nodiscard]] Point<Number> at(const Vec2d& v) const { return convert(number, v) - from; }
};
template <class Number>
[[nodiscard]] Frame<Number> make_frame(const World& world, const Way& way, int unit) {
  const Convert<Number> number{unit};
  return {number, way.from.in(number), way.displacement(number), convert_octagon(number, world.points())};
}

/// What of one group the octagon meets on a way in that group's frame. Lives for one question.
class Passage {
 public:
  Passage(const World& world, const Group& group, const Way& way);

  /// The edges (indices into `World::edges()`, ascending) that the open octagon meets on the way; one-way segments only
  /// where they block.
  [[nodiscard]] std::vector<std::uint32_t> entered_edges() const;
  [[nodiscard]] std::vector<std::uint32_t> entered_edges(ColliderIndex collider) const;
  /// The edges of one collider among edges that are sorted.
  [[nodiscard]] std::span<const std::uint32_t> of_collider(std::span<const std::uint32_t> edges,
                                                           ColliderIndex collider) const;
  /// The colliders that the open octagon meets, ascending.
  [[nodiscard]] std::vector<ColliderIndex> met() const;
  [[nodiscard]] bool meets(ColliderIndex collider) const;
  /// The discs that the open octagon meets, ascending.
  [[nodiscard]] std::vector<ColliderIndex> met_discs() const;
  /// Whether a disc is met on a first part of the way, exactly.
  /// @param until fraction of the way.
  [[nodiscard]] bool meets_disc(ColliderIndex disc, double until) const;

 private:
  /// With the hull.
  template <class Number>
  [[nodiscard]] Frame<Number> frame(int unit) const;
  /// @param question asked of the frame in doubles, and in integers of a unit where those do not know.
  template <class Question>
  [[nodiscard]] bool decide(int unit, const Question& question) const;
  template <class Number>
  [[nodiscard]] Answer enters(const Frame<Number>& frame, const Edge& edge) const;
  template <class Number>
  [[nodiscard]] Answer above(const Frame<Number>& frame, const Surface& surface) const;
  template <class Number>
  [[nodiscard]] Answer inside(const Frame<Number>& frame, ColliderIndex collider) const;
  [[nodiscard]] std::vector<std::uint32_t> entered(const std::vector<std::uint32_t>& candidates) const;
  [[nodiscard]] bool inside(ColliderIndex collider) const;
  [[nodiscard]] bool enters_disc(ColliderIndex disc) const;
  template <class Number>
  [[nodiscard]] Answer enters_disc(const Frame<Number>& frame, ColliderIndex disc) const;
  /// Whether the way begins above a surface.
  [[nodiscard]] bool above(std::uint32_t surface) const;

  const World& world_;
  const Group& group_;
  Way way_;
  Box2 box_;
  Frame<Approximate> quick_;
  mutable std::optional<std::pair<std::uint32_t, bool>> known_above_;  ///< The surface asked about last.
};

}  // namespace paperproof::compare::detail
