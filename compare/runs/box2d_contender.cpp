#include "runs/contender_kinds.hpp"

#include "contains.hpp"
#include "runs/engine_intent.hpp"
#include "runs/technique_parts.hpp"
#include "runs/vertex_ways.hpp"
#include "scenes/step_times.hpp"

#include <algorithm>

namespace paperproof::compare {
namespace {

/// Which of the world's steps it is that a step of the scene consists of.
struct SubstepOf {
  int number;
  int count;
  [[nodiscard]] double fraction(double of_substep) const {
    return count == 1 ? of_substep : (number + of_substep) / count;
  }
};

/// Adds those that are not there yet, with their fractions of the whole step.
template <class Event, class Same>
void add_events(const std::vector<Event>& events, const SubstepOf& of, std::vector<Event>& all, const Same& same) {
  for (Event event : events) {
    event.fraction = of.fraction(event.fraction);
    if (std::ranges::none_of(all, [&](const Event& known) { return same(known, event); })) all.push_back(event);
  }
}

void add_substep(const box2d::TwinStep& twin, const SubstepOf& of, const TraceHeader& header, TraceStep& record) {
  for (std::size_t i = of.number == 0 ? 0 : 1; i < twin.path.size(); ++i)  // it begins where the one before ended
    record.path.push_back({twin.path[i].position, of.fraction(twin.path[i].fraction)});
  add_events(twin.contacts, of, record.contacts,
             [](const auto& a, const auto& b) { return a.collider == b.collider && a.side == b.side; });
  add_events(twin.met, of, record.met,
             [](const auto& a, const auto& b) { return a.other == b.other && a.side == b.side; });
  add_events(twin.sensors, of, record.sensors, [](const auto&, const auto&) { return false; });
  for (const ColliderIndex passed : twin.dropped_through)
    if (!contains(record.dropped_through, passed)) record.dropped_through.push_back(passed);
  std::ranges::sort(record.dropped_through);
  if (of.number == 0) record.movers = twin.movers;
  for (std::size_t k = 0; k < twin.movers.size(); ++k) {
    record.movers[k].to = twin.movers[k].to;
    record.movers[k].to_angle = twin.movers[k].to_angle;
  }
  add_ways(header, twin.movers, {of.fraction(0), of.fraction(1)}, record.vertex_ways);
  record.capped = record.capped || twin.capped;
}

class Box2dContender final : public Contender {
 public:
  Box2dContender(const TwinDef& def, const Scene& scene, const Scenery& scenery, std::span<const KnobSetting> knobs)
      : substeps_(def.substeps),
        world_(scenery, scene.character, starts_of(scene), def.world),
        twins_(character_count(scene)),
        wishes_(character_count(scene)) {
    if (!(StepTimes(scene).shortest() / substeps_ >= box2d::least_step))
      throw box2d::InvalidDefinition("Box2D takes no steps shorter than 1e-9 s");
    header_.scene = scene.name;
    header_.contender = def.world.mode == box2d::SceneryMode::pieces ? "box2d_pieces" : "box2d";
    header_.knob = turned_knobs(knobs, header_.contender);
    header_.scalar = name_of(ScalarKind::binary32);
    header_.dt = scene.dt;
    header_.characters = character_count(scene);
    header_.points = world_.points_as_run();
    add_terms(scene, rules_for_twin(scene), header_);
    header_.substeps = substeps_;
    header_.scenery = world_.as_run();
    header_.ids = scene.ids;
    header_.box2d = box2d::box2d_version();
    header_.tolerances = {{"rest_gap", box2d::rest_gap},
                          {"touch_gap", box2d::touch_gap},
                          {"max_travel_per_step", box2d::max_travel_per_step}};
    header_.path_exact = false;
    note_turning(scene);
    place_at_start(*this, scene);
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    for (TraceStep& record : records) clear(record);
    for (int substep = 0; substep < substeps_; ++substep) {
      const std::span<const box2d::TwinStep> steps = advance(part_of(input, substep));
      for (std::size_t k = 0; k < twins_.size(); ++k) {
        const SubstepOf of{substep, substeps_};
        add_substep(steps[k], of, header_, records[k]);
        records[k].requested += wishes_[k].velocity * dt_;
        records[k].steered += twins_[k].steered * dt_;
        write_state(twins_[k].state, records[k]);  // with what carries it from now on
      }
    }
  }

  void step_unrecorded(const StepInput& input) override {
    for (int substep = 0; substep < substeps_; ++substep) advance(part_of(input, substep));
  }

  bool keep_wishes(bool keep) override {
    if (keep) kept_.clear();
    keeps_ = keep;
    return true;
  }

  void step_bare(const StepInput& input, std::size_t k) override {
    const std::size_t count = twins_.size();
    for (int substep = 0; substep < substeps_; ++substep) {
      const StepInput part = part_of(input, substep);
      const std::size_t wish = (k * static_cast<std::size_t>(substeps_) + static_cast<std::size_t>(substep)) * count;
      world_.step_bare(std::span(kept_).subspan(wish, count), part.dt, part.movers);
    }
  }

  [[nodiscard]] Pose pose(std::size_t character) const override {
    return pose_of(twins_[character], world_.position(character));
  }

  void place(const Pose& pose, std::size_t character) override {
    twins_[character] = character_at(pose);
    world_.place(pose.position, pose.state.velocity, character);
  }

 private:
  static std::vector<Vec2d> starts_of(const Scene& scene) {
    std::vector<Vec2d> starts;
    for (std::size_t k = 0; k < character_count(scene); ++k) starts.push_back(start_of(scene, k).position);
    return starts;
  }

  /// A one-way chain that turns would hold on another side in every step: Box2D is not asked to.
  void note_turning(const Scene& scene) {
    header_.turning = turning_movers(scene);
    for (ColliderIndex i = 0; i < scene.ids.size() && !header_.turning.empty(); ++i) {
      const ColliderDef& collider = scene.scenery.colliders[i];
      if (collider.one_way && collider.mover != no_mover && header_.turning[collider.mover])
        throw NotApplicable(header_.contender + " is for one-way chains that do not turn, and \"" + scene.ids[i] +
                            "\" does");
    }
  }

  /// A substep's share of a step. What is returned holds until the next call.
  StepInput part_of(const StepInput& whole, int substep) {
    if (substeps_ == 1) return whole;
    part_movers_.clear();
    for (const MoverMotion& mover : whole.movers)
      part_movers_.push_back({between(mover.from, mover.to, substep), between(mover.from, mover.to, substep + 1),
                              between(mover.from_angle, mover.to_angle, substep),
                              between(mover.from_angle, mover.to_angle, substep + 1)});
    return {whole.dt / substeps_, whole.players, part_movers_, whole.gravity, whole.up};
  }
  /// Where a motion is when so many substeps are done.
  template <class Place>
  [[nodiscard]] Place between(const Place& from, const Place& to, int substeps) const {
    if (substeps == substeps_) return to;
    return from + (to - from) * (static_cast<double>(substeps) / substeps_);
  }

  /// One step of the world.
  std::span<const box2d::TwinStep> advance(const StepInput& input) {
    if (input.up != Vec2d::UnitY()) throw StepRefused("Box2D's twin stands upright, and the run ends there");
    dt_ = input.dt;
    for (std::size_t k = 0; k < twins_.size(); ++k)
      wishes_[k] = {intent_.wanted(twins_[k], world_.position(k), input.players[k], input), input.players[k].drop};
    if (keeps_) kept_.insert(kept_.end(), wishes_.begin(), wishes_.end());
    const std::span<const box2d::TwinStep> steps = step_world(input.movers);
    for (std::size_t k = 0; k < twins_.size(); ++k) {
      const box2d::TwinStep& step = steps[k];
      StepInput ran = input;
      ran.movers = step.movers;  // what carries it goes as Box2D had it, in float
      EngineStep ended{.velocity = step.velocity, .grounded = step.grounded};
      if (step.ground) ended.ground = EngineGround{step.ground->collider, step.ground->normal};
      intent_.take_over(ended, ran, step.contacts, twins_[k]);
    }
    return steps;
  }

  std::span<const box2d::TwinStep> step_world(std::span<const MoverMotion> movers) {
    try {
      return world_.step_all(wishes_, dt_, movers);
    } catch (const box2d::InvalidDefinition& reason) {
      throw StepRefused(std::string(reason.what()) + ": beyond what Box2D is given, and the run ends there");
    }
  }

  int substeps_;
  double dt_ = 0;  ///< Of the present step of the world.
  box2d::ReferenceWorld world_;
  TraceHeader header_;
  EngineIntent intent_{header_};
  std::vector<EngineCharacter> twins_;
  std::vector<MoverMotion> part_movers_;  ///< See `part_of`.
  std::vector<box2d::TwinWish> wishes_;   ///< Of the present step.
  std::vector<box2d::TwinWish> kept_;     ///< Of all steps since they are kept.
  bool keeps_ = false;
};

}  // namespace

std::unique_ptr<Contender> make_box2d_contender(box2d::SceneryMode mode, const Scene& scene, const Scenery& scenery,
                                                std::span<const KnobSetting> knobs) {
  TwinDef def{.world = {.mode = mode}};
  turn_knobs(knobs, def);
  return std::make_unique<Box2dContender>(def, scene, scenery, knobs);
}

}  // namespace paperproof::compare
