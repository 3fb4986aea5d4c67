#include "step/octagon_sweep.hpp"

#include "one_way_chains.hpp"
#include "step/query.hpp"
#include "step/step_solve.hpp"
#include "step_parts.hpp"

#include <paperproof/scenery.hpp>

#include <cmath>
#include <numbers>

namespace paperproof {
namespace {

using namespace octagon_sweep;

/// Each impact is a corner of the path; the start, the end, a start that is put right and a snap are corners too.
constexpr int most_iterations = static_cast<int>(MoveResult::max_corners) - 4;

Settings settings_for(const SweepDef& def, const CharacterDef& character) {
  const double limit = character.max_climb_degrees * std::numbers::pi / 180;
  return {
      .walkable_cosine = static_cast<Real>(character.walkable_cosine(given_tolerances.climb)),
      .walkable_tangent = static_cast<Real>(std::tan(limit)),
      .snap = static_cast<Real>(character.snap),
      .step_height = static_cast<Real>(character.step_height),
      .max_fall_speed = static_cast<Real>(character.max_fall_speed.value_or(std::numeric_limits<double>::infinity())),
      .iterations = def.iterations};
}

/// What is found around a character beyond its shape [m]: a sweep looks beyond the end of a motion, and the rounding of
/// an offset moves a piece.
constexpr double found_around = 2 * given_tolerances.look + given_tolerances.touch;

class OctagonSweep final : public SweepInParts {
 public:
  OctagonSweep(const SweepDef& def, const Scenery& scenery, const CharacterDef& character)
      : finder_(scenery, PieceFinder::Kind::solids, character.shape.box().inflated(found_around), def.search),
        shape_(character.shape),
        settings_(settings_for(def, character)) {}

  [[nodiscard]] Scratch make_scratch() const override {
    Scratch scratch;
    scratch.own = std::make_unique<StepMemory>(shape_, finder_);
    return scratch;
  }

  void reserve(const Box2& positions, Scratch& scratch) const override {
    auto& memory = static_cast<StepMemory&>(*scratch.own);
    memory.reserve();
    Nearby(finder_, scratch.solids, nullptr, nullptr, &memory).reserve(positions);
  }

  void move(const StepRequest& request, Scratch& scratch, MoveResult& result) const override {
    result.clear();
    const Moving& moving = request.around.moving;
    const CharacterState& state = request.state;
    // Written so that NaN is out of range, and by component: see `desired_velocity`.
    const auto within = [](Real value) { return std::abs(value) <= tolerances.range; };
    const Vec2d& position = request.state.position;
    if (!(within(position.x()) && within(position.y()) && within(position.x() + request.displacement.x()) &&
          within(position.y() + request.displacement.y())))
      return step_parts::refuse(StepStatus::out_of_range, position, request.velocity + state.ride.velocity, state.ride,
                                result);
    auto& memory = static_cast<StepMemory&>(*scratch.own);
    const bool looks_at_movers = !moving.motions.empty() && comes_near_a_mover(request, memory.space);
    const bool rides = state.ride.ground != Ride::none;
    Step step(
        request, settings_,
        {finder_, scratch.solids, looks_at_movers ? &moving : nullptr, request.around.filter, &memory},
        {moving, static_cast<Real>(request.dt), finder_.scenery().counts().conveyors > 0 || rides || looks_at_movers},
        memory, result);
    solve(step);
  }

  void find_passed(const Around& around, std::span<const PathPoint> path, Scratch& scratch,
                   std::vector<ColliderIndex>& passed) const override {
    auto& memory = static_cast<StepMemory&>(*scratch.own);
    const auto segment_of = [&](PieceIndex piece) -> std::optional<OneWaySegment> {
      const Obstacle& obstacle = memory.space.info(piece);
      if (!obstacle.is_one_way()) return std::nullopt;
      const PieceVertices ends = memory.space.vertices_of(piece);
      return OneWaySegment{obstacle.source.collider, {ends[0], ends[1]}, obstacle.surfaces, obstacle.surface};
    };
    const Nearby near(finder_, scratch.solids, &around.moving, around.filter, &memory);
    paperproof::find_passed(shape_, path, around.moving, near, segment_of, passed);
  }

  template <class Question>
  [[nodiscard]] auto ask(const Around& around, Scratch& scratch, const Question& question) const {
    auto& memory = static_cast<StepMemory&>(*scratch.own);
    Surroundings surroundings{around, memory.space, {finder_, scratch.solids, &around.moving, around.filter, &memory}};
    const Box2 before = scratch.solids.box;
    const auto answer = question(surroundings);
    // A wide question would make the next steps slow.
    if (before.lower != scratch.solids.box.lower || before.upper != scratch.solids.box.upper)
      surroundings.near.forget();
    return answer;
  }

  [[nodiscard]] std::optional<Contact> cast(const Vec2d& position, const Vec2d& displacement, const Around& around,
                                            Scratch& scratch) const override {
    return ask(around, scratch, [&](Surroundings& here) { return octagon_sweep::cast(here, position, displacement); });
  }
  [[nodiscard]] std::size_t overlaps(const Vec2d& position, const Around& around, Scratch& scratch,
                                     std::span<ColliderIndex> found) const override {
    return ask(around, scratch, [&](Surroundings& here) { return octagon_sweep::overlaps(here, position, found); });
  }
  [[nodiscard]] std::size_t contacts_at(const Vec2d& position, double within, const Around& around, Scratch& scratch,
                                        std::span<Contact> found) const override {
    return ask(around, scratch,
               [&](Surroundings& here) { return octagon_sweep::contacts_at(here, position, within, found); });
  }

 private:
  /// Whether a mover may come near the character during the step. A step that no mover pushes ends no further away than
  /// its displacement is long, and the snap.
  [[nodiscard]] bool comes_near_a_mover(const StepRequest& request, const ConfigurationSpace& space) const {
    if (request.state.ride.ground != Ride::none || request.state.crushed) return true;
    const Vec2d& at = request.state.position;
    const Real reach =
        request.displacement.cwiseAbs().sum() + settings_.snap + settings_.step_height + 2 * tolerances.look;
    return finder_.any_comes_into(space.touched_from(Box2{at, at}.inflated(reach)), request.around.moving);
  }

  PieceFinder finder_;
  CharacterShape shape_;
  Settings settings_;
};

}  // namespace

std::unique_ptr<SweepInParts> octagon_sweep::PAPERPROOF_REAL::make_sweep(const SweepDef& def, const Scenery& scenery,
                                                                         const CharacterDef& character) {
  character.validate();
  if (def.iterations < 1 || def.iterations > most_iterations)
    throw std::invalid_argument("sweep_iterations: must be from 1 to " + std::to_string(most_iterations) + ", not " +
                                std::to_string(def.iterations));
  return std::make_unique<OctagonSweep>(def, scenery, character);
}

}  // namespace paperproof
