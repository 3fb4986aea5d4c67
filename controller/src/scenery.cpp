#include <paperproof/scenery.hpp>
#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>

#include "geometry/convex_pieces.hpp"
#include "geometry/exact.hpp"

namespace paperproof {
namespace {

/// A reason to refuse a collider; the constructor of `Scenery` adds the index of the collider.
class Refused : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// @param name called only if the point is refused: a level has hundreds of thousands of points.
template <class Name>
Vec2d accepted_point(const Vec2d& point, const Name& name) {
  const double range = Tolerances{}.range;
  // Written so that NaN fails.
  if (!(std::abs(point.x()) <= range && std::abs(point.y()) <= range)) {
    throw Refused(name() + " has a coordinate that is not a finite number of at most 2e6 m");
  }
  return {geometry::without_traces(point.x()), geometry::without_traces(point.y())};
}

/// The definition as it runs, in memory that is used for one collider after the other.
void copy_accepted(const ColliderDef& def, ColliderDef& result) {
  result = def;
  for (std::size_t i = 0; i < def.points.size(); ++i)
    result.points[i] = accepted_point(def.points[i], [&] { return "point " + std::to_string(i); });
  for (std::size_t hole = 0; hole < def.holes.size(); ++hole)
    for (std::size_t i = 0; i < def.holes[hole].size(); ++i)
      result.holes[hole][i] = accepted_point(
          def.holes[hole][i], [&] { return "point " + std::to_string(i) + " of hole " + std::to_string(hole); });
  if (def.one_way) result.one_way = accepted_point(*def.one_way, [] { return std::string("one_way"); });
  if (def.radius != 0) result.radius = geometry::without_traces(def.radius);
}

void check_chain(const ColliderDef& chain) {
  if (!chain.holes.empty()) throw Refused("a chain cannot have holes");
  if (chain.points.size() < 2) {
    throw Refused("a chain needs at least 2 points, it has " + std::to_string(chain.points.size()));
  }
  for (std::size_t i = 1; i < chain.points.size(); ++i) {
    if (chain.points[i] == chain.points[i - 1]) {
      throw Refused("the chain has the same point twice in a row: points " + std::to_string(i - 1) + " and " +
                    std::to_string(i) + " (counted from 0) are both " + geometry::text_of(chain.points[i]));
    }
  }
}

void check_circle(const ColliderDef& circle) {
  if (!circle.holes.empty()) throw Refused("a circle cannot have holes");
  if (circle.points.size() != 1)
    throw Refused("a circle needs exactly 1 point, its centre; it has " + std::to_string(circle.points.size()));
  if (circle.one_way) throw Refused("a circle cannot be one-way: give a chain or a polygon the shape of its top");
  // Written so that NaN fails.
  if (!(circle.radius > 0 && circle.radius <= Tolerances{}.range))
    throw Refused("the radius of a circle must be above 0 and at most 2e6 m, not " + std::to_string(circle.radius));
}

/// Most vertices of a convex piece. Few: a round shape becomes many pieces. Many: a character near it tests edges that
/// are far away, and a technique may have room for only a few dozen vertices.
constexpr std::size_t max_piece_vertices = 32;

struct Segment {
  Vec2d from;
  Vec2d to;
};

/// The segment, directed so that `one_way` points to its left, the side of its blocking normal; nothing if `one_way`
/// points along the segment.
std::optional<Segment> blocking_segment(const Segment& segment, const Vec2d& one_way) {
  const int side = geometry::orientation_sign_of_offset(segment.from, segment.to, segment.from, one_way);
  if (side == 0) return std::nullopt;
  return side > 0 ? segment : Segment{segment.to, segment.from};
}

/// Four corners of a box, one after the other, either way round.
bool is_upright_rectangle(std::span<const Vec2d> ring) {
  if (ring.size() != 4 || ring[0].x() == ring[2].x() || ring[0].y() == ring[2].y()) return false;
  const auto upright = [&](std::size_t i, std::size_t j) { return ring[i].x() == ring[j].x(); };
  const auto level = [&](std::size_t i, std::size_t j) { return ring[i].y() == ring[j].y(); };
  return (level(0, 1) && upright(1, 2) && level(2, 3) && upright(3, 0)) ||
         (upright(0, 1) && level(1, 2) && upright(2, 3) && level(3, 0));
}

/// Index of a corner of the box, counter-clockwise from the lower left one.
std::uint8_t corner_of(const Box2& box, const Vec2d& corner) {
  const bool right = corner.x() == box.upper.x();
  return corner.y() == box.lower.y() ? (right ? 1 : 0) : (right ? 2 : 3);
}

/// The collected pieces of all colliders.
struct Pieces {
  std::vector<PieceInfo>& infos;
  std::vector<Vec2d>& vertices;
  std::vector<Box2>& boxes;

  void add(ColliderIndex collider, const ColliderDef& def, std::span<const Vec2d> outline) {
    PieceInfo info{.collider = collider,
                   .mover = def.mover,
                   .first_vertex = static_cast<std::uint32_t>(vertices.size()),
                   .vertex_count = static_cast<std::uint8_t>(outline.size()),
                   .one_way = def.one_way.has_value(),
                   .sensor = def.sensor};
    const Box2 box = Box2::around(outline);
    boxes.push_back(box);
    if (is_upright_rectangle(outline))
      info.rectangle_corner = corner_of(box, outline[0]);
    else
      vertices.insert(vertices.end(), outline.begin(), outline.end());
    infos.push_back(info);
  }

  /// A ring with more vertices than a piece may have becomes a fan of parts that share the first vertex.
  void add_convex(ColliderIndex collider, const ColliderDef& def, std::span<const Vec2d> ring) {
    if (ring.size() <= max_piece_vertices) return add(collider, def, ring);
    std::vector<Vec2d> part;
    for (std::size_t next = 1; next + 1 < ring.size();) {
      const std::size_t count = std::min(max_piece_vertices - 1, ring.size() - next);
      part.assign(1, ring.front());
      part.insert(part.end(), ring.begin() + static_cast<std::ptrdiff_t>(next),
                  ring.begin() + static_cast<std::ptrdiff_t>(next + count));
      add(collider, def, part);
      next += count - 1;
    }
  }

  void add(ColliderIndex collider, const ColliderDef& def) {
    if (def.one_way && *def.one_way == Vec2d::Zero()) throw Refused("one_way is zero: it must point somewhere");
    switch (def.shape) {
      case ColliderDef::Shape::polygon:
        return add_polygon(collider, def);
      case ColliderDef::Shape::chain:
        return add_chain(collider, def);
      case ColliderDef::Shape::circle:
        return add_circle(collider, def);
    }
  }

  void add_circle(ColliderIndex collider, const ColliderDef& def) {
    check_circle(def);
    add(collider, def, def.points);
    const double radius = def.radius;
    boxes.back() = boxes.back().inflated(radius);
    vertices.push_back({radius, 0});
  }

  void add_polygon(ColliderIndex collider, const ColliderDef& def) {
    if (!def.one_way && def.holes.empty() && is_upright_rectangle(def.points)) return add_rectangle(collider, def);
    const geometry::ConvexPieces convex = geometry::cut_into_convex_pieces(def.points, def.holes);
    if (def.one_way) return add_one_way(collider, def);
    std::span<const Vec2d> rest = convex.vertices;
    for (const std::uint32_t size : convex.sizes) {
      add_convex(collider, def, rest.first(size));
      rest = rest.subspan(size);
    }
  }

  /// Rectangles are most of a level.
  void add_rectangle(ColliderIndex collider, const ColliderDef& def) {
    std::array<Vec2d, 4> outline{def.points[0], def.points[1], def.points[2], def.points[3]};
    if (geometry::winding(outline) < 0) std::reverse(outline.begin(), outline.end());
    add(collider, def, outline);
  }

  void add_chain(ColliderIndex collider, const ColliderDef& def) {
    check_chain(def);
    if (def.one_way) return add_one_way(collider, def);
    for (std::size_t i = 1; i < def.points.size(); ++i)
      add(collider, def, std::array{def.points[i - 1], def.points[i]});
  }

  void add_one_way(ColliderIndex collider, const ColliderDef& def) {
    for (const std::vector<Vec2d>& line : one_way_lines(def))
      for (std::size_t i = 1; i < line.size(); ++i)
        if (const auto segment = blocking_segment({line[i - 1], line[i]}, *def.one_way))
          add(collider, def, std::array{segment->from, segment->to});
  }
};

/// Movers are counted from 0: one with a large number would take memory for all before it.
constexpr MoverIndex most_movers = 65'536;

void check_role(const ColliderDef& def) {
  if (def.mover != no_mover && def.mover >= most_movers)
    throw Refused("the mover of a collider must be below 65,536, not " + std::to_string(def.mover));
  if (!std::isfinite(def.surface_speed)) throw Refused("surface_speed is not a finite number");
  if (def.sensor && def.one_way) throw Refused("a sensor cannot be one-way");
  if (def.radius != 0 && def.shape != ColliderDef::Shape::circle) throw Refused("only a circle has a radius");
}

}  // namespace

std::vector<std::vector<Vec2d>> one_way_lines(const ColliderDef& def) {
  if (def.shape == ColliderDef::Shape::chain) return {def.points};
  const std::vector<Vec2d>& ring = def.points;
  const int outside = -geometry::winding(ring);  // 1 where it is on the left of the edges
  const auto blocks = [&](std::size_t i) {
    return geometry::orientation_sign_of_offset(ring[i], ring[(i + 1) % ring.size()], ring[i], *def.one_way) == outside;
  };
  // Not all edges of a ring face one way: it is read from one that does not.
  std::size_t first = 0;
  while (first < ring.size() && blocks(first)) ++first;
  std::vector<std::vector<Vec2d>> lines;
  bool goes_on = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const std::size_t i = (first + k) % ring.size();
    const bool is_part = blocks(i);
    if (is_part && !goes_on) lines.push_back({ring[i]});
    if (is_part) lines.back().push_back(ring[(i + 1) % ring.size()]);
    goes_on = is_part;
  }
  return lines;
}

std::optional<std::uint32_t> FreeRanges::take(std::uint32_t size) {
  const auto found = of_size_.find(size);
  if (found == of_size_.end()) return std::nullopt;
  const std::uint32_t first = found->second.back();
  found->second.pop_back();
  if (found->second.empty()) of_size_.erase(found);
  return first;
}

void EditLog::add(const Edit& edit) {
  constexpr std::size_t most = 256;  // whoever is further behind begins anew
  if (edits_.size() == most) {
    first_ += most / 2;
    edits_.erase(edits_.begin(), edits_.begin() + most / 2);
  }
  edits_.push_back(edit);
}

std::optional<std::span<const Edit>> EditLog::since(std::uint64_t known) const noexcept {
  if (known < first_ || known > count()) return std::nullopt;
  return std::span(edits_).subspan(static_cast<std::size_t>(known - first_));
}

/// From now on whoever knows this log, or the other one, is behind.
void EditLog::forget(std::uint64_t other) noexcept {
  first_ = std::max(count(), other) + 1;
  edits_.clear();
}

Scenery::Scenery(const SceneryDef& def) {
  colliders_.resize(def.colliders.size());
  pieces_.reserve(def.colliders.size());
  boxes_.reserve(def.colliders.size());
  // Standing colliders, moving ones by mover, and sensors likewise; colliders of one kind keep their order.
  std::vector<ColliderIndex> order(colliders_.size());
  std::iota(order.begin(), order.end(), 0);
  const auto role = [&](ColliderIndex i) { return std::pair(def.colliders[i].sensor, def.colliders[i].mover); };
  const auto others = std::stable_partition(order.begin(), order.end(),
                                            [&](ColliderIndex i) { return role(i) == std::pair(false, no_mover); });
  std::stable_sort(others, order.end(), [&](ColliderIndex a, ColliderIndex b) { return role(a) < role(b); });
  ColliderDef accepted;
  for (const ColliderIndex i : order) {
    const PieceIndex first = cut(i, def.colliders[i], accepted);
    place(i, accepted, first);
  }
  pieces_.shrink_to_fit();
  boxes_.shrink_to_fit();
  vertices_.shrink_to_fit();
  edits_ = {};
}

/// Cuts a collider into pieces after all others; they are nobody's yet. @return the first of them.
PieceIndex Scenery::cut(ColliderIndex id, const ColliderDef& def, ColliderDef& accepted) {
  const std::size_t pieces = pieces_.size();
  const std::size_t vertices = vertices_.size();
  try {
    check_role(def);
    copy_accepted(def, accepted);
    Pieces{pieces_, vertices_, boxes_}.add(no_collider, accepted);
  } catch (...) {
    pieces_.resize(pieces);
    boxes_.resize(pieces);
    vertices_.resize(vertices);
    try {
      throw;
    } catch (const std::invalid_argument& refused) {
      throw InvalidScenery(slot_of(id), refused.what());
    }
  }
  return static_cast<PieceIndex>(pieces);
}

/// Gives a collider the pieces that were cut last. They move to where others have left room.
void Scenery::place(ColliderIndex id, const ColliderDef& accepted, PieceIndex first_cut) {
  const auto count = static_cast<PieceIndex>(pieces_.size()) - first_cut;
  PieceRange range{first_cut, first_cut + count};
  if (const std::optional<std::uint32_t> free = free_pieces_.take(count); free && count > 0) {
    range = {*free, *free + count};
    std::copy_n(pieces_.begin() + first_cut, count, pieces_.begin() + range.first);
    std::copy_n(boxes_.begin() + first_cut, count, boxes_.begin() + range.first);
    pieces_.resize(first_cut);
    boxes_.resize(first_cut);
  }
  for (PieceIndex piece = range.first; piece < range.end; ++piece) pieces_[piece].collider = id;
  move_vertices(range);
  Collider& collider = colliders_[slot_of(id)];
  collider.first_piece = range.first;
  collider.is_used = true;
  collider.kind = kind_of({.shape = accepted.shape,
                           .sensor = accepted.sensor,
                           .mover = accepted.mover,
                           .surface_speed = accepted.surface_speed,
                           .carries = accepted.carries,
                           .filter = accepted.filter,
                           .one_way = accepted.one_way});
  ++kinds_[collider.kind].users;
  collider.shape = shape_of(id, accepted);
  if (accepted.mover != no_mover && accepted.mover >= moving_.size()) moving_.resize(accepted.mover + std::size_t{1});
  for (PieceIndex piece = range.first; piece < range.end; ++piece) grid_of(piece).add(piece, boxes_[piece]);
  tally(id, +1);
}

/// Which vertices the pieces of one collider have: those of its first piece that has some, and all after them.
std::pair<std::uint32_t, std::uint32_t> Scenery::vertices_of(PieceRange pieces) const noexcept {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  for (PieceIndex piece = pieces.end; piece-- > pieces.first;) {
    const PieceInfo& info = pieces_[piece];
    if (info.is_rectangle()) continue;
    first = info.first_vertex;
    count += info.is_circle() ? 2 : info.vertex_count;
  }
  return {first, count};
}

/// Moves the vertices that were cut last to where others have left room.
void Scenery::move_vertices(PieceRange pieces) {
  const auto [first, count] = vertices_of(pieces);
  const std::optional<std::uint32_t> free = free_vertices_.take(count);
  if (!free) return;
  std::copy_n(vertices_.begin() + first, count, vertices_.begin() + *free);
  vertices_.resize(first);
  for (PieceIndex piece = pieces.first; piece < pieces.end; ++piece) pieces_[piece].first_vertex += *free - first;
}

/// Takes the pieces of a collider out.
void Scenery::displace(ColliderIndex id) {
  log(id);
  tally(id, -1);
  const PieceRange range = pieces_of(id);
  for (PieceIndex piece = range.first; piece < range.end; ++piece) {
    grid_of(piece).remove(piece, boxes_[piece]);
    // The standing pieces of a level are many, and nobody asks for the box around them.
    if (pieces_[piece].mover != no_mover) grid_of(piece).shrink(boxes_[piece], boxes_);
  }
  const auto [first_vertex, vertices] = vertices_of(range);
  free_vertices_.give(first_vertex, vertices);
  std::fill_n(pieces_.begin() + range.first, range.size(), PieceInfo{.collider = no_collider});
  free_pieces_.give(range.first, static_cast<std::uint32_t>(range.size()));
  Collider& collider = colliders_[slot_of(id)];
  if (collider.shape < Collider::piece_backwards) {
    shapes_[collider.shape] = {};
    free_shapes_.push_back(collider.shape);
  }
  if (--kinds_[collider.kind].users == 0) free_kinds_.push_back(collider.kind);
  collider.is_used = false;
}

/// Counts a collider that has come, or goes.
void Scenery::tally(ColliderIndex id, int change) noexcept {
  const ColliderInfo& info = collider(id);
  const auto add = [change](std::size_t& count, std::size_t by) { count = change > 0 ? count + by : count - by; };
  add(size_, 1);
  add(counts_.sensors, info.sensor);
  add(counts_.one_way, info.one_way.has_value());
  add(counts_.conveyors, !info.sensor && info.surface_speed != 0);
  add(counts_.filtered, info.filter != Filter{});
  add(counts_.circles, info.shape == ColliderDef::Shape::circle);
  add(counts_.moving_pieces, info.mover != no_mover && !info.sensor ? pieces_of(id).size() : 0);
}

/// Logs that a collider has come, or goes.
void Scenery::log(ColliderIndex id) {
  const PieceRange range = pieces_of(id);
  const ColliderInfo& info = collider(id);
  Box2 box;
  if (range.size() > 0) box = boxes_[range.first];
  for (PieceIndex piece = range.first; piece < range.end; ++piece) box = box.merged(boxes_[piece]);
  edits_.add({range, box, info.mover, info.one_way.has_value()});
}

PieceGrid& Scenery::grid_of(PieceIndex piece) {
  const PieceInfo& info = pieces_[piece];
  Group& group = info.mover == no_mover ? standing_ : moving_[info.mover];
  return info.sensor ? group.sensors : group.solids;
}

/// Of colliders that follow each other most are of one kind.
std::uint32_t Scenery::kind_of(const ColliderInfo& info) {
  constexpr std::ptrdiff_t looked_through = 64;
  const auto is_it = [&](const Kind& kind) { return kind.users > 0 && kind.info == info; };
  if (last_kind_ < kinds_.size() && is_it(kinds_[last_kind_])) return last_kind_;
  const auto end = kinds_.begin() + std::min(looked_through, std::ssize(kinds_));
  const auto found = std::find_if(kinds_.begin(), end, is_it);
  if (found != end) return last_kind_ = static_cast<std::uint32_t>(found - kinds_.begin());
  if (free_kinds_.empty()) {
    free_kinds_.push_back(static_cast<std::uint32_t>(kinds_.size()));
    kinds_.emplace_back();
  }
  last_kind_ = free_kinds_.back();
  free_kinds_.pop_back();
  kinds_[last_kind_].info = info;
  return last_kind_;
}

bool Scenery::has(ColliderIndex id) const noexcept {
  const std::uint32_t slot = slot_of(id);
  return slot < colliders_.size() && colliders_[slot].is_used && colliders_[slot].generation == id >> slot_bits;
}

std::optional<ColliderDef> Scenery::find(ColliderIndex id) const {
  return has(id) ? std::optional(as_run(id)) : std::nullopt;
}

ColliderIndex Scenery::add(const ColliderDef& def) {
  if (free_slots_.empty()) {
    if (colliders_.size() == slot_mask) throw std::length_error("a level has room for 2^24 - 1 colliders");
    free_slots_.push_back(static_cast<std::uint32_t>(colliders_.size()));
    colliders_.emplace_back();
  }
  const std::uint32_t slot = free_slots_.back();
  const ColliderIndex id = std::uint32_t{colliders_[slot].generation} << slot_bits | slot;
  ColliderDef accepted;
  place(id, accepted, cut(id, def, accepted));
  log(id);
  free_slots_.pop_back();
  return id;
}

bool Scenery::replace(ColliderIndex id, const ColliderDef& def) {
  if (!has(id)) return false;
  ColliderDef accepted;
  const PieceIndex first_cut = cut(id, def, accepted);
  displace(id);
  place(id, accepted, first_cut);
  log(id);
  return true;
}

bool Scenery::remove(ColliderIndex id) {
  if (!has(id)) return false;
  displace(id);
  // A slot of the last generation is never used again: its next id would be that of the first.
  if (colliders_[slot_of(id)].generation++ < last_generation) free_slots_.push_back(slot_of(id));
  return true;
}

/// Decides how the points of a collider are stored, once its pieces exist.
std::uint32_t Scenery::shape_of(ColliderIndex collider, const ColliderDef& def) {
  if (const PieceRange range = pieces_of(collider); range.size() == 1 && def.holes.empty()) {
    const PieceVertices vertices = vertices_of(range.first);
    if (std::equal(vertices.begin(), vertices.end(), def.points.begin(), def.points.end())) return Collider::piece;
    if (std::equal(vertices.begin(), vertices.end(), def.points.rbegin(), def.points.rend()))
      return Collider::piece_backwards;
  }
  if (free_shapes_.empty()) {
    free_shapes_.push_back(static_cast<std::uint32_t>(shapes_.size()));
    shapes_.emplace_back();
  }
  const std::uint32_t shape = free_shapes_.back();
  free_shapes_.pop_back();
  shapes_[shape] = {def.points, def.holes};
  return shape;
}

PieceRange Scenery::pieces_of(ColliderIndex collider) const noexcept {
  const PieceIndex first = colliders_[slot_of(collider)].first_piece;
  PieceRange range{first, first};
  while (range.end < pieces_.size() && pieces_[range.end].collider == collider) ++range.end;
  return range;
}

bool Scenery::comes_before(PieceIndex a, PieceIndex b) const noexcept {
  const ColliderIndex one = pieces_[a].collider;
  const ColliderIndex other = pieces_[b].collider;
  if (one == other) return a < b;
  const Box2& first = boxes_[colliders_[slot_of(one)].first_piece];
  const Box2& second = boxes_[colliders_[slot_of(other)].first_piece];
  const auto key = [](const Box2& box) {
    return std::tuple(box.lower.x(), box.lower.y(), box.upper.x(), box.upper.y());
  };
  if (key(first) != key(second)) return key(first) < key(second);
  const PieceVertices points = vertices_of(colliders_[slot_of(one)].first_piece);
  const PieceVertices others = vertices_of(colliders_[slot_of(other)].first_piece);
  const auto is_less = [](const Vec2d& p, const Vec2d& q) { return std::pair(p.x(), p.y()) < std::pair(q.x(), q.y()); };
  if (!std::equal(points.begin(), points.end(), others.begin(), others.end()))
    return std::lexicographical_compare(points.begin(), points.end(), others.begin(), others.end(), is_less);
  const double speed = collider(one).surface_speed;
  const double other_speed = collider(other).surface_speed;
  return speed != other_speed ? speed < other_speed : one < other;
}

ColliderDef Scenery::as_run(ColliderIndex collider) const {
  const Collider& kept = colliders_[slot_of(collider)];
  const ColliderInfo& info = kinds_[kept.kind].info;
  ColliderDef def{.shape = info.shape,
                  .points = {},
                  .one_way = info.one_way,
                  .mover = info.mover,
                  .sensor = info.sensor,
                  .surface_speed = info.surface_speed,
                  .carries = info.carries,
                  .filter = info.filter};
  if (kept.shape == Collider::piece || kept.shape == Collider::piece_backwards) {
    const PieceVertices vertices = vertices_of(kept.first_piece);
    def.points.assign(vertices.begin(), vertices.end());
    if (kept.shape == Collider::piece_backwards) std::reverse(def.points.begin(), def.points.end());
    if (info.shape == ColliderDef::Shape::circle) def.radius = circle(kept.first_piece).radius;
    return def;
  }
  def.points = shapes_[kept.shape].points;
  def.holes = shapes_[kept.shape].holes;
  return def;
}

SceneryDef Scenery::as_run() const {
  SceneryDef def;
  def.colliders.reserve(colliders_.size());
  for (std::uint32_t slot = 0; slot < colliders_.size(); ++slot)
    if (colliders_[slot].is_used)
      def.colliders.push_back(as_run(std::uint32_t{colliders_[slot].generation} << slot_bits | slot));
  return def;
}

}  // namespace paperproof
