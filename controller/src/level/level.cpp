#include <paperproof/level.hpp>

#include "level/poses.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof {
namespace {

/// Largest coordinate of a pose [m], and largest angle [rad].
constexpr double largest_pose = 1e6;

bool is_usable(const Pose& pose) noexcept {
  // Written so that NaN is not.
  return std::abs(pose.position.x()) <= largest_pose && std::abs(pose.position.y()) <= largest_pose &&
         std::abs(pose.angle) <= largest_pose;
}

}  // namespace

bool LevelController::accepts(const LevelContext& context) const noexcept {
  return context.movers.size() >= level_->mover_count() &&
         std::all_of(context.movers.begin(), context.movers.end(),
                     [](const PoseMotion& motion) { return is_usable(motion.from) && is_usable(motion.to); });
}

/// Appends the colliders of one mover, or those that stand, that come into a box.
void LevelController::find(MoverIndex mover, const PoseMotion& motion, const Box2& box,
                           std::vector<NearCollider>& found) {
  const Level::Group& group = level_->group_of(mover);
  pieces_.clear();
  for (const PieceGrid* grid : {&group.solids, &group.sensors})
    grid->find(mover == no_mover ? box : grid->whole(), level_->boxes(), pieces_);
  for (const PieceIndex piece : pieces_) {
    const ColliderIndex id = level_->pieces()[piece].collider;
    const std::uint64_t version = level_->version_of(id);
    Known& known = known_[id];
    if (known.version != version) known = {version, level_->as_run(id)};
    const bool comes =
        mover == no_mover || level::swept_box(known.def.points, motion).inflated(known.def.radius).overlaps(box);
    if (comes) found.push_back({id, version, &known.def, mover, motion});
  }
}

LocalController::Find LevelController::finder(const LevelContext& context) {
  // So small that a std::function holds it without memory of its own.
  return [this, &context](const Box2& box, std::vector<NearCollider>& found) {
    if (last_edit_ != level_->edits().count() || !(read_.lower == box.lower && read_.upper == box.upper)) {
      if (known_.size() > 4 * standing_.size() + 64) known_.clear();
      standing_.clear();
      find(no_mover, {}, box, standing_);
      read_ = box;
      last_edit_ = level_->edits().count();
    }
    found.insert(found.end(), standing_.begin(), standing_.end());
    for (MoverIndex mover = 0; mover < level_->mover_count(); ++mover) find(mover, context.movers[mover], box, found);
  };
}

StepContext LevelController::context_without_movers(const LevelContext& context) const noexcept {
  return {.gravity = context.gravity, .dt = context.dt, .filter = context.filter, .up = context.up};
}

StepContext LevelController::straight_context(const LevelContext& context) {
  motions_.clear();
  for (const PoseMotion& motion : context.movers.first(level_->mover_count()))
    motions_.push_back({motion.from.position, motion.to.position});
  StepContext result = context_without_movers(context);
  result.movers = motions_;
  return result;
}

bool LevelController::goes_straight(const LevelContext& context) noexcept {
  return std::none_of(context.movers.begin(), context.movers.end(),
                      [](const PoseMotion& motion) { return motion.from.angle != 0 || motion.to.angle != 0; });
}

StepStatus LevelController::step(CharacterState& state, const Input& input, const LevelContext& context,
                                 StepReport& report) {
  if (!accepts(context)) return report.status = StepStatus::invalid_input;
  went_straight_ = goes_straight(context);
  if (went_straight_) return straight_.step(state, input, straight_context(context), scratch_, report);
  return local_.step(state, input, context_without_movers(context), finder(context), report);
}

StepStatus LevelController::move(CharacterState& state, const Vec2d& displacement, const LevelContext& context,
                                 StepReport& report) {
  if (!accepts(context)) return report.status = StepStatus::invalid_input;
  went_straight_ = goes_straight(context);
  if (went_straight_) return straight_.move(state, displacement, straight_context(context), scratch_, report);
  return local_.move(state, displacement, context_without_movers(context), finder(context), report);
}

std::optional<std::size_t> LevelController::overlaps(const Vec2d& position, const LevelContext& context) {
  if (!accepts(context)) return std::nullopt;
  if (goes_straight(context)) return straight_.overlaps(position, straight_context(context), scratch_);
  StepContext here = context_without_movers(context);
  here.dt = 1;
  return local_.overlaps(position, here, finder(context));
}

}  // namespace paperproof
