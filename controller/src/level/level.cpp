#include <paperproof/level.hpp>

#include "geometry/rings.hpp"
#include "level/poses.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace paperproof {
namespace {

/// An id is a slot and a generation.
constexpr std::uint32_t slot_bits = 24;
constexpr std::uint32_t slot_mask = (std::uint32_t{1} << slot_bits) - 1;
constexpr std::uint32_t last_generation = ~std::uint32_t{0} >> slot_bits;

/// Movers are counted from 0: one with a large number would take memory for all before it.
constexpr MoverIndex most_movers = 65'536;

/// Largest coordinate of a pose [m], and largest angle [rad].
constexpr double largest_pose = 1e6;

std::int32_t cell_at(double coordinate, int grid) noexcept {
  return static_cast<std::int32_t>(std::floor(std::ldexp(coordinate, -grid)));
}

/// A convex polygon like most, which needs no closer look.
bool is_plain(const ColliderDef& def) {
  const auto usual = [](double value) { return value == 0 || (std::abs(value) >= 1e-80 && std::abs(value) <= 1e6); };
  return def.shape == ColliderDef::Shape::polygon && def.holes.empty() && !def.one_way && def.surface_speed == 0 &&
         def.radius == 0 &&
         std::all_of(def.points.begin(), def.points.end(),
                     [&](const Vec2d& point) { return usual(point.x()) && usual(point.y()); }) &&
         geometry::is_convex(def.points);
}

/// Checks a collider as a scenery does, alone.
void check(const ColliderDef& def) {
  if (def.mover != no_mover && def.mover >= most_movers)
    throw InvalidScenery(0, "the mover of a collider in a level must be below 65,536");
  if (is_plain(def)) return;
  SceneryDef alone{{def}};
  if (def.mover != no_mover) alone.colliders[0].mover = 0;
  const Scenery checked(alone);
}

bool by_id(const NearCollider& a, const NearCollider& b) noexcept { return a.id < b.id; }

bool is_usable(const Pose& pose) noexcept {
  // Written so that NaN is not.
  return std::abs(pose.position.x()) <= largest_pose && std::abs(pose.position.y()) <= largest_pose &&
         std::abs(pose.angle) <= largest_pose;
}

}  // namespace

std::size_t Level::CellHash::operator()(const Cell& cell) const noexcept {
  const auto word = [](std::int32_t value) { return std::uint64_t{static_cast<std::uint32_t>(value)}; };
  std::uint64_t hash = (word(cell.x) << 32U | word(cell.y)) + word(cell.grid) * 0x9e3779b97f4a7c15;
  hash = (hash ^ hash >> 30U) * 0xbf58476d1ce4e5b9;  // the finalizer of splitmix64
  return static_cast<std::size_t>((hash ^ hash >> 27U) * 0x94d049bb133111eb);
}

Level::Edit& Level::Edit::renew() noexcept {
  static std::atomic<std::uint64_t> edits{0};
  number = ++edits;
  return *this;
}

Level::Level(const SceneryDef& def) {
  slots_.reserve(def.colliders.size());
  for (std::size_t i = 0; i < def.colliders.size(); ++i) {
    try {
      add(def.colliders[i]);
    } catch (const InvalidScenery& refused) {
      throw InvalidScenery(static_cast<ColliderIndex>(i), refused.what());
    }
  }
}

const Level::Slot* Level::slot_of(ColliderIndex id) const noexcept {
  const std::uint32_t index = id & slot_mask;
  if (index >= slots_.size()) return nullptr;
  const Slot& slot = slots_[index];
  return slot.is_used && slot.generation == id >> slot_bits ? &slot : nullptr;
}

int Level::grid_of(const Box2& box) noexcept {
  const double size = (box.upper - box.lower).maxCoeff();
  int exponent = 0;
  std::frexp(size, &exponent);  // size < 2^exponent
  return std::clamp(exponent, 0, static_cast<int>(grid_count) - 1);
}

template <class Visit>
void Level::for_each_cell(const Box2& box, int grid, const Visit& visit) {
  const std::int32_t right = cell_at(box.upper.x(), grid);
  const std::int32_t top = cell_at(box.upper.y(), grid);
  for (std::int32_t x = cell_at(box.lower.x(), grid); x <= right; ++x)
    for (std::int32_t y = cell_at(box.lower.y(), grid); y <= top; ++y) visit(Cell{x, y, grid});
}

void Level::place(ColliderIndex id, Slot& slot, const ColliderDef& def) {
  slot.def = def;
  slot.box = Box2::around(def.points).inflated(def.radius);
  slot.version = last_edit_.renew().number;
  if (def.mover != no_mover) {
    if (def.mover >= movers_.size()) movers_.resize(def.mover + 1);
    movers_[def.mover].push_back(id);
    return;
  }
  const int grid = grid_of(slot.box);
  ++in_grid_[static_cast<std::size_t>(grid)];
  for_each_cell(slot.box, grid, [&](const Cell& cell) { cells_[cell].push_back(id); });
}

void Level::displace(ColliderIndex id, Slot& slot) {
  const auto erase_from = [id](std::vector<ColliderIndex>& ids) {
    std::swap(*std::find(ids.begin(), ids.end(), id), ids.back());
    ids.pop_back();
  };
  if (slot.def.mover != no_mover) return erase_from(movers_[slot.def.mover]);
  const int grid = grid_of(slot.box);
  --in_grid_[static_cast<std::size_t>(grid)];
  for_each_cell(slot.box, grid, [&](const Cell& cell) {
    const auto found = cells_.find(cell);
    erase_from(found->second);
    if (found->second.empty()) cells_.erase(found);
  });
}

ColliderIndex Level::add(const ColliderDef& def) {
  check(def);
  if (unused_.empty()) {
    if (slots_.size() == slot_mask) throw std::length_error("a level has room for 2^24 - 1 colliders");
    slots_.emplace_back();
    unused_.push_back(static_cast<std::uint32_t>(slots_.size() - 1));
  }
  const std::uint32_t index = unused_.back();
  unused_.pop_back();
  Slot& slot = slots_[index];
  slot.is_used = true;
  ++size_;
  const ColliderIndex id = slot.generation << slot_bits | index;
  place(id, slot, def);
  return id;
}

bool Level::replace(ColliderIndex id, const ColliderDef& def) {
  if (slot_of(id) == nullptr) return false;
  check(def);
  Slot& slot = slots_[id & slot_mask];
  displace(id, slot);
  place(id, slot, def);
  return true;
}

bool Level::remove(ColliderIndex id) {
  if (slot_of(id) == nullptr) return false;
  Slot& slot = slots_[id & slot_mask];
  displace(id, slot);
  slot.def = {};
  slot.is_used = false;
  --size_;
  last_edit_.renew();
  // A slot of the last generation is never used again: its next id would be that of the first.
  if (slot.generation++ < last_generation) unused_.push_back(id & slot_mask);
  return true;
}

const ColliderDef* Level::find(ColliderIndex id) const noexcept {
  const Slot* slot = slot_of(id);
  return slot == nullptr ? nullptr : &slot->def;
}

void Level::find_standing(const Box2& box, std::vector<NearCollider>& found) const {
  const auto add = [&](ColliderIndex id) {
    const Slot& slot = slots_[id & slot_mask];
    if (slot.box.overlaps(box)) found.push_back({id, slot.version, &slot.def});
  };
  for (std::size_t grid = 0; grid < grid_count; ++grid) {
    if (in_grid_[grid] == 0) continue;
    const Vec2d cells = (box.upper - box.lower) * std::ldexp(1.0, -static_cast<int>(grid)) + Vec2d(2, 2);
    if (cells.x() * cells.y() > static_cast<double>(cells_.size())) {
      for (const auto& [cell, ids] : cells_)
        if (cell.grid == static_cast<int>(grid)) std::for_each(ids.begin(), ids.end(), add);
      continue;
    }
    for_each_cell(box, static_cast<int>(grid), [&](const Cell& cell) {
      const auto ids = cells_.find(cell);
      if (ids != cells_.end()) std::for_each(ids->second.begin(), ids->second.end(), add);
    });
  }
}

void Level::find_moving(const Box2& box, std::span<const PoseMotion> movers, std::vector<NearCollider>& found) const {
  for (MoverIndex mover = 0; mover < movers_.size(); ++mover)
    for (const ColliderIndex id : movers_[mover]) {
      const Slot& slot = slots_[id & slot_mask];
      if (level::swept_box(slot.def.points, movers[mover]).inflated(slot.def.radius).overlaps(box))
        found.push_back({id, slot.version, &slot.def, mover, movers[mover]});
    }
}

bool LevelController::accepts(const LevelContext& context) const noexcept {
  return context.movers.size() >= level_->mover_count() &&
         std::all_of(context.movers.begin(), context.movers.end(),
                     [](const PoseMotion& motion) { return is_usable(motion.from) && is_usable(motion.to); });
}

LocalController::Find LevelController::finder(const LevelContext& context) {
  // So small that a std::function holds it without memory of its own.
  return [this, &context](const Box2& box, std::vector<NearCollider>& found) {
    if (last_edit_ != level_->last_edit() || !(read_.lower == box.lower && read_.upper == box.upper)) {
      standing_.clear();
      level_->find_standing(box, standing_);
      std::sort(standing_.begin(), standing_.end(), by_id);
      read_ = box;
      last_edit_ = level_->last_edit();
    }
    found.insert(found.end(), standing_.begin(), standing_.end());
    level_->find_moving(box, context.movers, found);
  };
}

StepStatus LevelController::step(CharacterState& state, const Input& input, const LevelContext& context,
                                 StepReport& report) {
  if (!accepts(context)) return report.status = StepStatus::invalid_input;
  return local_.step(state, input,
                     {.gravity = context.gravity, .dt = context.dt, .filter = context.filter, .up = context.up},
                     finder(context), report);
}

StepStatus LevelController::move(CharacterState& state, const Vec2d& displacement, const LevelContext& context,
                                 StepReport& report) {
  if (!accepts(context)) return report.status = StepStatus::invalid_input;
  return local_.move(state, displacement,
                     {.gravity = context.gravity, .dt = context.dt, .filter = context.filter, .up = context.up},
                     finder(context), report);
}

std::optional<std::size_t> LevelController::overlaps(const Vec2d& position, const LevelContext& context) {
  if (!accepts(context)) return std::nullopt;
  return local_.overlaps(position, {.dt = 1, .filter = context.filter, .up = context.up}, finder(context));
}

}  // namespace paperproof
