#include "runs/level_contender.hpp"

#include "runs/level_ways.hpp"
#include "runs/technique_parts.hpp"

#include <paperproof/controller.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

class LevelContender final : public Contender {
 public:
  LevelContender(const TechniqueEntry& technique, const Scene& scene, const Scenery& scenery, const Planning& planning)
      : level_(scenery.as_run()),
        controller_(level_, rules_for(technique, scene, planning.knobs)),
        scratch_(controller_.make_scratch()),
        header_(header_of(technique, ScalarKind::binary64, scenery, scene, planning)) {
    header_.plan.reset();  // it leaves nothing out
    header_.turning.assign(scene.movers.size(), true);
    scratch_.notes_turned = true;
    place_at_start(*this, scene);
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    TraceStep& record = records.front();
    const CharacterState before = state_;
    step_unrecorded(input);
    write_report(report_, state_, Sides::as_said, record);
    record.movers.assign(input.movers.begin(), input.movers.end());
    record.vertex_ways = ways_in_level(header_.scenery, Controller::turned(scratch_), motions_);
    record.requested += carried(before, record.vertex_ways);
    refuse_unusable(report_.status, report_.move.refusal);
  }

  void step_unrecorded(const StepInput& input) override {
    motions_.clear();
    for (std::size_t i = 0; i < input.movers.size(); ++i)
      motions_.push_back({input.movers[i].from, input.movers[i].to, input.turns[i].from, input.turns[i].to});
    controller_.step(state_, input.players.front(),
                     {.gravity = input.gravity, .dt = input.dt, .movers = motions_, .up = input.up}, scratch_, report_);
  }

  [[nodiscard]] Pose pose(std::size_t) const override { return pose_of(state_); }

  void place(const Pose& pose, std::size_t) override { state_ = state_at(pose); }
  void launch(const Vec2d& velocity, std::size_t) override { state_.velocity = velocity; }

 private:
  /// What the ground adds to the displacement [m].
  [[nodiscard]] Vec2d carried(const CharacterState& before, std::span<const VertexWay> ways) const {
    if (before.ride.ground == Ride::none) return Vec2d::Zero();
    const VertexWay* ground = find_way(ways, before.ride.ground);
    // A circle that turns carries like a conveyor, and its centre does not tell.
    const bool is_circle = header_.scenery.colliders[before.ride.ground].shape == ColliderDef::Shape::circle;
    return ground == nullptr || is_circle ? Vec2d(before.ride.velocity * header_.dt) : carried_along(*ground);
  }

  Level level_;
  Controller controller_;
  Scratch scratch_;
  TraceHeader header_;
  CharacterState state_;
  StepReport report_;
  std::vector<MoverMotion> motions_;  ///< Of the present step.
};

}  // namespace

std::unique_ptr<Contender> make_level_contender(const TechniqueEntry& octagon_sweep, const Scene& scene,
                                                const Scenery& scenery, const Planning& planning) {
  if (!scene.others.empty())
    throw NotApplicable(fmt::format("octagon_sweep knows one character where something turns, and here are {}",
                                    character_count(scene)));
  for (ColliderIndex i = 0; i < scene.ids.size(); ++i)
    if (const ColliderDef& def = scene.scenery.colliders[i]; def.one_way && def.mover != no_mover)
      throw NotApplicable("octagon_sweep is for one-way colliders that stand where something turns, and \"" +
                          scene.ids[i] + "\" moves");
  for (const KnobSetting& knob : planning.knobs)
    if (knob.name != "jump_rules" && has_knob(octagon_sweep.name, knob.name))
      throw NotApplicable("octagon_sweep has no knob " + knob.name + " where something turns");
  return std::make_unique<LevelContender>(octagon_sweep, scene, scenery, planning);
}

}  // namespace paperproof::compare
