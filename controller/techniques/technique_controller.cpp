#include <paperproof/scenery.hpp>
#include <paperproof/technique_controller.hpp>

#include "one_way_chains.hpp"
#include "piece_finder.hpp"
#include "sensors.hpp"
#include "step_parts.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace paperproof {
namespace {

using namespace step_parts;

/// Of a step of a crowd that moves by a joint technique.
struct JointMemory final : OwnMemory {
  std::vector<CharacterState> states;  ///< Those handed to the step, as they will be.
  std::vector<MoveRequest> requests;   ///< What each character wants.
  Scratch scratch;
};

}  // namespace

struct TechniqueController::Driver {
  const Scenery& scenery;
  CharacterDef character;
  std::unique_ptr<const Technique> technique;
  PieceFinder solids;
  OneWaySurfaces surfaces;

  Driver(const Scenery& where, const CharacterDef& who, std::unique_ptr<const Technique> how, PieceSearch search)
      : scenery(where),
        character(who),
        technique(std::move(how)),
        solids(where, PieceFinder::Kind::solids, who.shape.box().inflated(Tolerances{}.look), search),
        surfaces(where, who.shape) {
    character.validate();
    if (scenery.counts().filtered > 0)
      throw std::invalid_argument("the technique " + std::string(technique->name()) +
                                  " has no filter, and there is a collider with one");
  }

  /// @param scratch of the technique.
  [[nodiscard]] Scratch completed(Scratch scratch) const {
    scratch.sensors = std::make_unique<Sensors>(scenery, character.shape, solids.search());
    return scratch;
  }

  [[nodiscard]] bool accepts(const CharacterState& state, const Input& input,
                             const StepContext& context) const noexcept {
    return is_upright(context.up) && context.filter == nullptr && context.dt > 0 &&
           context.movers.size() == scenery.mover_count() && !any_angle(context.movers) &&
           finite(state, input, context.gravity, context.dt, context.movers);
  }

  [[nodiscard]] static MoveRequest request_of(const CharacterState& state, const Vec2d& displacement,
                                              const Vec2d& velocity, bool drop, const StepContext& context) noexcept {
    return {.position = state.position,
            .displacement = displacement,
            .velocity = velocity,
            .technique_memory = state.technique_memory,
            .drop = drop,
            .movers = context.movers,
            .dt = context.dt,
            .ride = state.ride};
  }

  /// Turns the intent into a request.
  [[nodiscard]] MoveRequest begin(const Input& input, const StepContext& context, bool wall_ahead,
                                  CharacterState& state, StepReport& report) const noexcept {
    if (state.ride.ground != Ride::none) state.velocity -= state.ride.velocity;
    const auto [velocity, steered] = desired_velocity(character, context.gravity, input, context.dt, state, wall_ahead);
    report.requested = velocity * context.dt;
    report.steered = steered * context.dt;
    return request_of(state, report.requested, velocity, input.drop, context);
  }

  /// Tries a move towards the wall that `move` (not zero) points to, without making it.
  [[nodiscard]] bool has_wall_ahead(const CharacterState& state, double move, const StepContext& context,
                                    Scratch& scratch, MoveResult& tried) const noexcept {
    const auto reach = character.wall_reach;
    const Vec2d there{move < 0 ? -reach : reach, 0};
    technique->move(request_of(state, there, there / context.dt, false, context), scratch, tried);
    return touches(tried, move < 0 ? Side::left : Side::right);
  }

  void find_passed(std::span<const PathPoint> path, const StepContext& context,
                   std::vector<ColliderIndex>& passed) const {
    const auto segment_of = [&](PieceIndex piece) -> std::optional<OneWaySegment> {
      const PieceInfo& info = scenery.pieces()[piece];
      if (!info.one_way) return std::nullopt;
      const PieceVertices ends = scenery.vertices_of(piece);
      return OneWaySegment{info.collider, {ends[0], ends[1]}, &surfaces, surfaces.of(piece)};
    };
    Candidates near;
    const Moving moving{context.movers};
    paperproof::find_passed(character.shape, path, moving, {solids, near, &moving, nullptr}, segment_of, passed);
  }

  /// After the move has filled `report.move`.
  void end(bool drop, const StepContext& context, Scratch& scratch, CharacterState& state,
           StepReport& report) const noexcept {
    const std::span<const PathPoint> path = report.move.path;
    static_cast<Sensors&>(*scratch.sensors).observe(path, {context.movers}, report.sensors);
    if (drop) find_passed(path, context, report.dropped_through);
    adopt(character, context.up, report.move, state);
  }
};

TechniqueController::TechniqueController(Controller sweep) : sweep_(std::move(sweep)) {}

TechniqueController::TechniqueController(const Scenery& scenery, const CharacterDef& character,
                                         std::unique_ptr<const Technique> technique, PieceSearch search)
    : driver_(std::make_shared<const Driver>(scenery, character, std::move(technique), search)) {}

Scratch TechniqueController::make_scratch() const {
  if (sweep_) return sweep_->make_scratch();
  Scratch scratch = driver_->completed(driver_->technique->make_scratch());
  scratch.maker = driver_;
  return scratch;
}

std::size_t TechniqueController::memory_bytes() const noexcept {
  return sweep_ ? 0 : driver_->technique->memory_bytes();
}

StepStatus TechniqueController::step(CharacterState& state, const Input& input, const StepContext& context,
                                     Scratch& scratch, StepReport& report) const noexcept {
  if (sweep_) return sweep_->step(state, input, context, scratch, report);
  report.sensors.clear();
  report.dropped_through.clear();
  if (!is_made_by(driver_, scratch.maker) || !driver_->accepts(state, input, context))
    return report.status = StepStatus::invalid_input;
  const CharacterState before = state;
  const bool wall_ahead = asks_for_wall(driver_->character, input, state) &&
                          driver_->has_wall_ahead(state, *input.move, context, scratch, report.move);
  driver_->technique->move(driver_->begin(input, context, wall_ahead, state, report), scratch, report.move);
  report.status = report.move.status;
  if (is_refused(report.status))
    state = before;
  else
    driver_->end(input.drop, context, scratch, state, report);
  return report.status;
}

TechniqueCrowd::TechniqueCrowd(const Scenery& scenery, const CharacterDef& character,
                               std::unique_ptr<const JointTechnique> technique, PieceSearch search)
    : technique_(technique.get()),
      driver_(std::make_shared<const Driver>(scenery, character, std::move(technique), search)) {}

CrowdScratch TechniqueCrowd::make_scratch(std::size_t most_characters) const {
  auto memory = std::make_unique<JointMemory>();
  memory->states.resize(most_characters);
  memory->requests.resize(most_characters);
  memory->scratch = driver_->completed(technique_->make_joint_scratch(most_characters));
  return {most_characters, std::move(memory), driver_};
}

/// Writes no state before it is certain that no state is refused.
StepStatus TechniqueCrowd::step(std::span<CharacterState> states, std::span<const Input> inputs,
                                const StepContext& context, CrowdScratch& scratch, CrowdReport& report) const noexcept {
  const std::size_t count = states.size();
  if (scratch.most_characters < count || report.members.size() < count || inputs.size() != count ||
      !is_made_by(driver_, scratch.maker))
    return report.status = StepStatus::invalid_input;
  auto& memory = static_cast<JointMemory&>(*scratch.own);
  for (std::size_t i = 0; i < count; ++i) {
    report.members[i].clear(static_cast<CharacterIndex>(i));
    if (!driver_->accepts(states[i], inputs[i], context)) return report.status = StepStatus::invalid_input;
    memory.states[i] = states[i];
    memory.requests[i] = driver_->begin(inputs[i], context, false, memory.states[i], report.members[i].step);
  }
  if (!technique_->move_together(std::span(memory.requests).first(count), memory.scratch, report))
    return report.status = StepStatus::out_of_range;
  for (std::size_t i = 0; i < count; ++i) {
    StepReport& own = report.members[i].step;
    report.members[i].sort_contacts();
    own.status = own.move.status;
    driver_->end(inputs[i].drop, context, memory.scratch, memory.states[i], own);
    states[i] = memory.states[i];
  }
  return report.status = StepStatus::moved;
}

}  // namespace paperproof
