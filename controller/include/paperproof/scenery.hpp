/// The scenery around a character: polygons, chains and circles, cut once into convex pieces.
#pragma once

#include <paperproof/types.hpp>

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace paperproof {

/// The rule of Box2D's `b2Filter`, with more bits.
struct Filter {
  std::uint32_t category = 1;              ///< Its own kinds, one bit each.
  std::uint32_t mask = ~std::uint32_t{0};  ///< The kinds that it collides with.
  std::int32_t group = 0;                  ///< See `collide`.

  friend bool operator==(const Filter&, const Filter&) = default;
};

/// Two of one group collide if the group is positive, and do not if it is negative. Otherwise, or in group zero, they
/// collide if the mask of each has a bit of the category of the other.
[[nodiscard]] constexpr bool collide(const Filter& a, const Filter& b) noexcept {
  if (a.group == b.group && a.group != 0) return a.group > 0;
  return (a.mask & b.category) != 0 && (b.mask & a.category) != 0;
}

/// One polygon, one chain or one circle, in world metres, y up.
///
/// A polygon may be concave, have any number of vertices and either winding, and have holes. A chain is a polyline of
/// zero thickness; it blocks from both sides unless `one_way` is given. A circle is solid, and exactly round.
struct ColliderDef {
  enum class Shape : std::uint8_t { polygon, chain, circle };

  Shape shape = Shape::polygon;
  /// Outer ring (not closed: the first vertex is not repeated), polyline, or the centre alone.
  std::vector<Vec2d> points;
  std::vector<std::vector<Vec2d>> holes{};  ///< Polygons only; each strictly inside the outer ring.
  /// A chain blocks a character that begins a move above it, which is the side that this vector points to. A segment
  /// that runs along this vector blocks nothing. Abutting chains with the same `one_way`, filter and mover are one
  /// surface, extended straight beyond its ends.
  /// A polygon blocks as one-way chains do, which are made of its outer edges that face where this vector points: see
  /// `one_way_lines`. Nothing else of it blocks, so a character jumps up through a platform and lands on its top.
  std::optional<Vec2d> one_way{};
  /// The mover that moves this collider; `points` and `one_way` then hold while the mover's offset and angle are zero.
  MoverIndex mover = no_mover;
  /// Blocks nothing: the controller reports when the character enters and leaves it. Not with `one_way`.
  bool sensor = false;
  /// A conveyor: it carries a character that stands on it along the surface, to the right for a positive speed [m/s].
  double surface_speed = 0;
  /// Which characters it is there for: see `StepContext::filter`. Seams vanish only between colliders of equal filters.
  Filter filter{};
  double radius = 0;  ///< Of a circle, and of nothing else [m].
};

/// The chains of a collider that has a `one_way`. A chain is its own only line. Of a polygon they are the edges of its
/// outer ring whose outward normal has a positive product with `one_way` (decided exactly); edges that follow each
/// other are one line.
[[nodiscard]] std::vector<std::vector<Vec2d>> one_way_lines(const ColliderDef& def);

/// All colliders, standing or moving.
struct SceneryDef {
  std::vector<ColliderDef> colliders;
};

/// A collider that cannot be used; `what()` gives the reason in words that a level designer understands.
class InvalidScenery : public std::invalid_argument {
 public:
  InvalidScenery(ColliderIndex collider, const std::string& reason)
      : std::invalid_argument(reason), collider_(collider) {}
  /// Which entry of `SceneryDef::colliders`.
  [[nodiscard]] ColliderIndex collider() const noexcept { return collider_; }

 private:
  ColliderIndex collider_;
};

/// The properties of a collider, apart from its points.
struct ColliderInfo {
  ColliderDef::Shape shape = ColliderDef::Shape::polygon;
  bool sensor = false;
  MoverIndex mover = no_mover;
  double surface_speed = 0;  ///< [m/s]
  Filter filter{};
  std::optional<Vec2d> one_way{};
  friend bool operator==(const ColliderInfo&, const ColliderInfo&) = default;
};

/// A convex part of a collider. Polygons: counter-clockwise vertices, strictly convex, 3 to 32, taken from the
/// collider's own vertices. Chains, and polygons that are one-way: the 2 end points of a segment, zero thickness; for a
/// one-way segment in the order that has its blocking normal on the left. Circles: the centre alone.
struct PieceInfo {
  static constexpr std::uint8_t no_rectangle = 4;

  ColliderIndex collider = 0;
  MoverIndex mover = no_mover;     ///< Of its collider.
  std::uint32_t first_vertex = 0;  ///< Not for rectangles: where the vertices are stored.
  std::uint8_t vertex_count = 0;
  /// The first vertex of an upright rectangle, counted counter-clockwise from the lower left one: only its box is
  /// stored.
  std::uint8_t rectangle_corner = no_rectangle;
  bool one_way = false;
  bool sensor = false;

  [[nodiscard]] bool is_rectangle() const noexcept { return rectangle_corner != no_rectangle; }
  [[nodiscard]] bool is_circle() const noexcept { return vertex_count == 1; }
};

struct Circle {
  Vec2d centre;   ///< [m]
  double radius;  ///< [m]
};

/// The vertices of a piece, as a range. They are stored in the scenery, which must outlive this range. The vertices of
/// a rectangle are stored in the range itself, so a span of them must not outlive the range.
class PieceVertices {
 public:
  // NOLINTNEXTLINE(*-explicit-*): a span of vertices is one of their two forms
  PieceVertices(std::span<const Vec2d> stored) noexcept : stored_(stored.data()), size_(stored.size()) {}
  PieceVertices(const Box2& box, std::size_t first_corner) noexcept : stored_(nullptr), size_(4) {
    const auto at = [&](std::size_t corner) -> Vec2d& { return corners_[(corner - first_corner) % 4]; };
    at(0) = box.lower;
    at(1) = {box.upper.x(), box.lower.y()};
    at(2) = box.upper;
    at(3) = {box.lower.x(), box.upper.y()};
  }

  [[nodiscard]] const Vec2d* data() const noexcept { return stored_ != nullptr ? stored_ : corners_.data(); }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] const Vec2d* begin() const noexcept { return data(); }
  [[nodiscard]] const Vec2d* end() const noexcept { return data() + size_; }
  [[nodiscard]] const Vec2d& operator[](std::size_t i) const noexcept { return data()[i]; }

 private:
  const Vec2d* stored_;  ///< Null: they are in `corners_`.
  std::size_t size_;
  std::array<Vec2d, 4> corners_;
};

/// Some consecutive pieces.
struct PieceRange {
  PieceIndex first = 0;
  PieceIndex end = 0;  ///< One past the last.
  [[nodiscard]] std::size_t size() const noexcept { return end - first; }
};

/// Finds pieces by boxes. There are grids with squares of 1 m, 2 m, 4 m, 0.5 m and so on. A piece is in the finest grid
/// whose squares are larger than the piece. So it meets four squares at most.
class PieceGrid {
 public:
  void add(PieceIndex piece, const Box2& box);
  /// @param box as it was added with.
  void remove(PieceIndex piece, const Box2& box);
  /// Appends the pieces whose boxes meet `box`, in no order. @param boxes of all pieces.
  void find(const Box2& box, std::span<const Box2> boxes, std::vector<PieceIndex>& found) const;
  /// Makes `whole` as small as it can be, after a piece with this box was removed. @param boxes of all pieces.
  void shrink(const Box2& removed, std::span<const Box2> boxes);
  /// Around all pieces, and perhaps around some that were removed; where there was none it meets no box [m].
  [[nodiscard]] const Box2& whole() const noexcept { return whole_; }

 private:
  static constexpr std::uint32_t no_link = ~std::uint32_t{0};
  struct Link {
    PieceIndex piece;
    std::uint32_t next;
  };
  struct Cell {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::uint32_t first = no_link;  ///< Of its pieces, in `links_`.
    bool is_used = false;
  };
  /// One grid. Its cells are in a hash table.
  struct Layer {
    [[nodiscard]] std::size_t index_of(std::int32_t x, std::int32_t y) const noexcept;
    void grow();
    void erase(std::size_t index);

    double cells_per_metre;
    std::size_t used;
    std::vector<Cell> cells;
  };

  Layer& layer_for(const Box2& box);

  std::vector<Layer> layers_;
  std::vector<Link> links_;
  std::uint32_t unused_ = no_link;  ///< Links of no cell, as a list.
  Box2 whole_ = Box2::nowhere();
};

/// Ranges of a vector that are used no more, to be used again.
class FreeRanges {
 public:
  void give(std::uint32_t first, std::uint32_t size) {
    if (size > 0) of_size_[size].push_back(first);
  }
  /// @return the first element of a range of that size.
  [[nodiscard]] std::optional<std::uint32_t> take(std::uint32_t size);

 private:
  std::map<std::uint32_t, std::vector<std::uint32_t>> of_size_;
};

/// How many colliders there are of a kind that a step need not ask for where there is none.
struct SceneryCounts {
  std::size_t sensors = 0;
  std::size_t one_way = 0;
  std::size_t conveyors = 0;
  std::size_t filtered = 0;  ///< With a filter.
  std::size_t circles = 0;
  std::size_t moving_pieces = 0;  ///< Solid pieces with a mover.
};

/// A change of a level.
struct Edit {
  PieceRange pieces;  ///< That came or went.
  Box2 box;           ///< Around them [m].
  MoverIndex mover = no_mover;
  bool one_way = false;
};

/// The last edits of one level. A level that is assigned to another replaces all that this one was.
class EditLog {
 public:
  EditLog() = default;
  EditLog(const EditLog&) = default;
  EditLog(EditLog&& from) noexcept : count_(from.count_), edits_(std::move(from.edits_)) { from.forget(count_); }
  EditLog& operator=(const EditLog& from) noexcept { return forget(from.count()), *this; }
  EditLog& operator=(EditLog&& from) noexcept { return forget(from.count()), from.forget(count()), *this; }
  ~EditLog() = default;

  void add(const Edit& edit);
  /// How many there were.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// Those after the first `known` ones; nothing where some of them are forgotten.
  [[nodiscard]] std::optional<std::span<const Edit>> since(std::uint64_t known) const noexcept;

 private:
  void forget(std::uint64_t other) noexcept;

  std::uint64_t count_ = 0;
  std::vector<Edit> edits_;  ///< The last of them.
};

/// Not thread-safe while it is edited. Otherwise any number of threads may read it. A `Controller` follows edits from
/// its next step on. A technique of the article keeps to the scenery as it was when it was made.
class Scenery {
 public:
  /// Takes magnitudes below 1e-90 m for zero (their products would underflow), checks every collider and cuts polygons
  /// into convex pieces.
  /// @throws InvalidScenery on: fewer than 3 (polygon) or 2 (chain) points, a coordinate that is not finite or beyond
  ///   2e6 m, repeated neighbouring points, zero area, a ring that crosses or touches itself or another ring of its
  ///   polygon, a hole that is not inside, a `one_way` that is zero or not finite, a sensor that is one-way, a
  ///   `surface_speed` that is not finite, a `mover` that is not below 65,536; a circle that is
  ///   one-way or has more or fewer than one point, a radius of a circle that is not above zero or beyond 2e6 m, a
  ///   radius of anything else.
  explicit Scenery(const SceneryDef& def);
  Scenery() : Scenery(SceneryDef{}) {}

  /// Adds a collider. Without edits the ids are 0, 1, 2 and so on; the id of one that was removed never names another.
  /// @param def its `mover` may be any number below 65,536, or `its_character`.
  /// @throws InvalidScenery; std::length_error for more than 2^24 - 1 colliders. Nothing changed then.
  ColliderIndex add(const ColliderDef& def);
  /// Gives a collider another definition. It keeps its id, so a character keeps riding on it.
  /// @return false if there is no collider of this id. @throws InvalidScenery as `add`.
  bool replace(ColliderIndex id, const ColliderDef& def);
  /// A character that stands on it falls in the next step. @return false if there is no collider of this id.
  bool remove(ColliderIndex id);
  [[nodiscard]] bool has(ColliderIndex id) const noexcept;
  /// The definition of a collider as it runs, if it is there.
  [[nodiscard]] std::optional<ColliderDef> find(ColliderIndex id) const;
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] const EditLog& edits() const noexcept { return edits_; }
  [[nodiscard]] const SceneryCounts& counts() const noexcept { return counts_; }

  /// Without edits, pieces stand in this order: the solid ones that do not move, the solid ones of mover 0, of mover 1,
  /// …; then the sensors, by mover, and last those that do not move.
  [[nodiscard]] std::span<const PieceInfo> pieces() const noexcept { return pieces_; }
  [[nodiscard]] PieceVertices vertices_of(PieceIndex piece) const noexcept {
    const PieceInfo& info = pieces_[piece];
    if (info.is_rectangle()) return {boxes_[piece], info.rectangle_corner};
    return std::span(vertices_).subspan(info.first_vertex, info.vertex_count);
  }
  /// Of a piece that is one.
  [[nodiscard]] Circle circle(PieceIndex piece) const noexcept {
    const Vec2d* stored = vertices_.data() + pieces_[piece].first_vertex;
    return {stored[0], stored[1].x()};
  }
  /// One more than the highest index of a mover that moves a collider.
  [[nodiscard]] std::size_t mover_count() const noexcept { return moving_.size(); }

  /// Solid pieces and sensors, apart, of one mover or of what stands still.
  struct Group {
    PieceGrid solids;
    PieceGrid sensors;
  };
  /// @param mover below `mover_count()`, or `no_mover`; `its_character` moves nothing here.
  [[nodiscard]] const Group& group_of(MoverIndex mover) const noexcept {
    static const Group nothing;
    return mover == no_mover ? standing_ : mover == its_character ? nothing : moving_[mover];
  }

  /// The order in which a step looks at pieces. Shapes and places of the colliders decide it, so that levels that are
  /// alike give the same bits, whatever was added first. The pieces of one collider follow each other.
  [[nodiscard]] bool comes_before(PieceIndex a, PieceIndex b) const noexcept;

  /// Smallest box around a piece; for a piece of a mover, at offset zero [m].
  [[nodiscard]] const Box2& box(PieceIndex piece) const noexcept { return boxes_[piece]; }
  [[nodiscard]] std::span<const Box2> boxes() const noexcept { return boxes_; }

  /// Colliders have slots; the slot of one that was removed is free for another.
  [[nodiscard]] std::size_t collider_count() const noexcept { return colliders_.size(); }
  [[nodiscard]] static std::uint32_t slot_of(ColliderIndex id) noexcept { return id & slot_mask; }
  /// @param collider that is there.
  [[nodiscard]] const ColliderInfo& collider(ColliderIndex collider) const noexcept {
    return kinds_[colliders_[slot_of(collider)].kind].info;
  }
  /// The pieces of a collider are consecutive. A one-way chain may have none.
  [[nodiscard]] PieceRange pieces_of(ColliderIndex collider) const noexcept;

  /// The definition as it runs, which an exact judge reads. Each call builds it anew from the stored data.
  [[nodiscard]] SceneryDef as_run() const;
  [[nodiscard]] ColliderDef as_run(ColliderIndex collider) const;

 private:
  /// Points of a collider that are not those of one piece.
  struct Shape {
    std::vector<Vec2d> points;
    std::vector<std::vector<Vec2d>> holes;
  };
  /// Where the points of a collider are: they are the vertices of its only piece, or those from the last to the first,
  /// or in `shapes_`.
  enum class Points : std::uint8_t { of_piece, of_piece_backwards, own };
  /// The data from which a collider's definition is rebuilt.
  struct Collider {
    std::uint32_t kind = 0;  ///< Into `kinds_`.
    PieceIndex first_piece = 0;
    Points points = Points::of_piece;
    std::uint8_t generation = 0;
    bool is_used = false;
  };
  /// What colliders that are alike have in common.
  struct Kind {
    ColliderInfo info;
    std::size_t users = 0;
  };
  static constexpr std::uint32_t slot_bits = 24;
  static constexpr std::uint32_t slot_mask = (std::uint32_t{1} << slot_bits) - 1;
  static constexpr std::uint32_t last_generation = ~std::uint32_t{0} >> slot_bits;

  void place(ColliderIndex id, const ColliderDef& accepted, PieceIndex first_cut);
  void displace(ColliderIndex id);
  void tally(ColliderIndex id, int change) noexcept;
  void log(ColliderIndex id);
  [[nodiscard]] PieceIndex cut(ColliderIndex id, const ColliderDef& def, ColliderDef& accepted);
  [[nodiscard]] PieceGrid* grid_of(PieceIndex piece);
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> vertices_of(PieceRange pieces) const noexcept;
  void move_vertices(PieceRange pieces);
  [[nodiscard]] std::uint32_t kind_of(const ColliderInfo& info);
  [[nodiscard]] Points points_of(ColliderIndex collider, const ColliderDef& accepted) const;

  std::deque<Kind> kinds_;
  std::vector<std::uint32_t> free_kinds_;
  std::uint32_t last_kind_ = 0;
  std::vector<Collider> colliders_;
  std::vector<std::uint32_t> free_slots_;
  std::unordered_map<std::uint32_t, Shape> shapes_;  ///< By slot.
  std::vector<PieceInfo> pieces_;
  std::vector<Box2> boxes_;
  FreeRanges free_pieces_;
  std::vector<Vec2d> vertices_;  ///< Of all pieces that are not rectangles; after a centre (radius, 0).
  FreeRanges free_vertices_;
  Group standing_;
  std::vector<Group> moving_;
  std::size_t size_ = 0;
  SceneryCounts counts_;
  EditLog edits_;
};

/// A scenery that is edited between steps: tiles that break, doors, bridges. To add, replace or remove a collider takes
/// about a microsecond, however large the level is.
using Level = Scenery;

}  // namespace paperproof
