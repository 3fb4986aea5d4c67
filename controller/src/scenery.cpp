#include <paperproof/scenery.hpp>

#include <algorithm>
#include <tuple>
#include <utility>

#include "collider_pieces.hpp"

namespace paperproof {
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
  if (edits_.size() == most) edits_.erase(edits_.begin(), edits_.begin() + most / 2);
  edits_.push_back(edit);
  ++count_;
}

std::optional<std::span<const Edit>> EditLog::since(std::uint64_t known) const noexcept {
  const std::uint64_t first = count_ - edits_.size();
  if (known < first || known > count_) return std::nullopt;
  return std::span(edits_).subspan(static_cast<std::size_t>(known - first));
}

/// From now on whoever knows this log, or the other one, is behind.
void EditLog::forget(std::uint64_t other) noexcept {
  count_ = std::max(count_, other) + 1;
  edits_.clear();
}

Scenery::Scenery(const SceneryDef& def) {
  colliders_.resize(def.colliders.size());
  pieces_.reserve(def.colliders.size());
  boxes_.reserve(def.colliders.size());
  // Standing colliders, moving ones by mover, and sensors likewise; colliders of one kind keep their order.
  ColliderDef accepted;
  const auto add = [&](ColliderIndex i) { place(i, accepted, cut(i, def.colliders[i], accepted)); };
  const auto role = [&](ColliderIndex i) { return std::pair(def.colliders[i].sensor, def.colliders[i].mover); };
  std::vector<ColliderIndex> others;
  for (ColliderIndex i = 0; i < colliders_.size(); ++i)
    role(i) == std::pair(false, no_mover) ? add(i) : others.push_back(i);
  std::ranges::stable_sort(others, [&](ColliderIndex a, ColliderIndex b) { return role(a) < role(b); });
  for (const ColliderIndex i : others) add(i);
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
    cut_into_pieces(def, accepted, {pieces_, vertices_, boxes_});
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
                           .filter = accepted.filter,
                           .one_way = accepted.one_way});
  ++kinds_[collider.kind].users;
  collider.points = points_of(id, accepted);
  if (collider.points == Points::own) shapes_[slot_of(id)] = {accepted.points, accepted.holes};
  if (accepted.mover < its_character && accepted.mover >= moving_.size())
    moving_.resize(accepted.mover + std::size_t{1});
  for (PieceIndex piece = range.first; piece < range.end; ++piece)
    if (PieceGrid* grid = grid_of(piece)) grid->add(piece, boxes_[piece]);
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
    PieceGrid* grid = grid_of(piece);
    if (grid == nullptr) continue;
    grid->remove(piece, boxes_[piece]);
    // The standing pieces of a level are many, and nobody asks for the box around them.
    if (pieces_[piece].mover != no_mover) grid->shrink(boxes_[piece], boxes_);
  }
  const auto [first_vertex, vertices] = vertices_of(range);
  free_vertices_.give(first_vertex, vertices);
  std::fill_n(pieces_.begin() + range.first, range.size(), PieceInfo{.collider = no_collider});
  free_pieces_.give(range.first, static_cast<std::uint32_t>(range.size()));
  Collider& collider = colliders_[slot_of(id)];
  if (collider.points == Points::own) shapes_.erase(slot_of(id));
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
  Box2 box = Box2::nowhere();
  for (PieceIndex piece = range.first; piece < range.end; ++piece) box = box.merged(boxes_[piece]);
  edits_.add({range, box, info.mover, info.one_way.has_value()});
}

/// Null for the body of a character: no grid finds it.
PieceGrid* Scenery::grid_of(PieceIndex piece) {
  const PieceInfo& info = pieces_[piece];
  if (info.mover == its_character) return nullptr;
  Group& group = info.mover == no_mover ? standing_ : moving_[info.mover];
  return info.sensor ? &group.sensors : &group.solids;
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
Scenery::Points Scenery::points_of(ColliderIndex collider, const ColliderDef& def) const {
  const PieceRange range = pieces_of(collider);
  if (range.size() != 1 || !def.holes.empty()) return Points::own;
  const PieceVertices vertices = vertices_of(range.first);
  if (std::equal(vertices.begin(), vertices.end(), def.points.begin(), def.points.end())) return Points::of_piece;
  const bool backwards = std::equal(vertices.begin(), vertices.end(), def.points.rbegin(), def.points.rend());
  return backwards ? Points::of_piece_backwards : Points::own;
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
                  .filter = info.filter};
  if (kept.points == Points::own) {
    const Shape& shape = shapes_.at(slot_of(collider));
    def.points = shape.points;
    def.holes = shape.holes;
    return def;
  }
  const PieceVertices vertices = vertices_of(kept.first_piece);
  def.points.assign(vertices.begin(), vertices.end());
  if (kept.points == Points::of_piece_backwards) std::reverse(def.points.begin(), def.points.end());
  if (info.shape == ColliderDef::Shape::circle) def.radius = circle(kept.first_piece).radius;
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
