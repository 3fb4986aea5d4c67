#include "step/octagon_sweep.hpp"

#include "broad_phase/most_at_once.hpp"
#include "step/query.hpp"
#include "step/step_solve.hpp"

#include <paperproof/scenery_facts.hpp>

#include <cmath>
#include <numbers>
#include <type_traits>

namespace paperproof {
namespace {

using namespace octagon_sweep;

/// Each impact is a corner of the path; the start, the end, a start that is put right and a snap are corners too.
constexpr int most_iterations = static_cast<int>(MoveResult::max_corners) - 4;

Settings settings_for(const SweepDef& def, const CharacterDef& character) {
  const double limit = character.max_climb_degrees * std::numbers::pi / 180;
  const Vec2d extent = character.shape.box().upper - character.shape.box().lower;
  return {
      .walkable_cosine = static_cast<Real>(character.walkable_cosine(given_tolerances.climb)),
      .walkable_tangent = static_cast<Real>(std::tan(limit)),
      .snap = static_cast<Real>(character.snap),
      .step_height = static_cast<Real>(character.step_height),
      .max_fall_speed = static_cast<Real>(character.max_fall_speed.value_or(std::numeric_limits<double>::infinity())),
      .look_ahead = static_cast<Real>(look_ahead_share * std::max(extent.x(), extent.y())),
      .iterations = def.iterations};
}

class OctagonSweep final : public SweepInParts {
 public:
  OctagonSweep(const SweepDef& def, const Scenery& scenery, const CharacterDef& character)
      : tree_(scenery.static_boxes(), def.search),
        mover_phases_(def.search, scenery),
        // Every piece asks for its neighbours once: without a tree that takes the square of their number.
        space_(scenery, character.shape,
               def.search == PieceSearch::tree ? tree_ : *std::make_unique<broad_phase::Tree>(scenery.static_boxes()),
               mover_phases_),
        settings_(settings_for(def, character)),
        touched_at_once_(broad_phase::most_at_once(scenery.static_boxes(), space_.touched_size())),
        has_conveyors_(has_conveyors(scenery)) {}

  [[nodiscard]] Scratch make_scratch() const override {
    Scratch scratch;
    scratch.solids.pieces = PieceBuffer(space_.scenery().sensor_pieces().first);
    scratch.own = std::make_unique<StepMemory>(space_, touched_at_once_, settings_.iterations);
    return scratch;
  }

  void move_part(Part part, const StepRequest& request, Scratch& scratch, MoveResult& result) const noexcept override {
    result.clear();
    if (!in_range(request) || request.movers.size() != mover_phases_.size() ||
        (!request.movers.empty() && !(request.dt > 0)))
      return refuse(request, result);
    const Neighbourhood neighbourhood(space_, tree_, settings_.look_ahead, request.filter, scratch);
    const bool rides = request.ride.ground != Ride::none;
    MoversInStep movers{mover_phases_, request.movers, request.dt, 0, has_conveyors_ || rides};
    if (!request.movers.empty() && (part == Part::stay || comes_near_a_mover(request))) movers.look_at_all();
    Step step(space_, settings_, neighbourhood, movers, request.up, result);
    solve(step, part, request);
  }

  template <class Question>
  [[nodiscard]] auto ask(const StepRequest& at, Scratch& scratch, const Question& question) const noexcept {
    Surroundings around{
        space_, {space_, tree_, settings_.look_ahead, at.filter, scratch}, mover_phases_, at.movers, at.filter, at.up};
    const auto answer = question(around);
    around.neighbourhood.forget();  // a wide question would make the next steps slow
    return answer;
  }

  [[nodiscard]] std::optional<Contact> cast(const StepRequest& at, Scratch& scratch) const noexcept override {
    return ask(at, scratch,
               [&](Surroundings& around) { return octagon_sweep::cast(around, at.position, at.displacement); });
  }
  [[nodiscard]] std::size_t overlaps(const StepRequest& at, Scratch& scratch,
                                     std::span<ColliderIndex> found) const noexcept override {
    return ask(at, scratch, [&](Surroundings& around) { return octagon_sweep::overlaps(around, at.position, found); });
  }
  [[nodiscard]] std::size_t contacts_at(const StepRequest& at, double within, Scratch& scratch,
                                        std::span<Contact> found) const noexcept override {
    return ask(at, scratch,
               [&](Surroundings& around) { return octagon_sweep::contacts_at(around, at.position, within, found); });
  }

 private:
  [[nodiscard]] static bool in_range(const StepRequest& request) noexcept {
    constexpr Real range = tolerances.range;
    // Written so that NaN is out of range, and by component: see `wanted_velocity`.
    const auto within = [](Real value) { return std::abs(value) <= range; };
    return within(request.position.x()) && within(request.position.y()) &&
           within(request.position.x() + request.displacement.x()) &&
           within(request.position.y() + request.displacement.y());
  }

  static void refuse(const StepRequest& request, MoveResult& result) noexcept {
    result.status = MoveStatus::out_of_range;
    result.position = request.position;
    result.velocity = request.velocity + request.ride.velocity;
    result.ride = request.ride;
    result.path.push_back({request.position, 0});
    result.path.push_back({request.position, 1});
  }

  /// Whether a mover may come near the character during the step. A step that no mover pushes ends no further away than
  /// its displacement is long, and the snap.
  [[nodiscard]] bool comes_near_a_mover(const StepRequest& request) const noexcept {
    if (request.ride.ground != Ride::none || request.crushed) return true;
    const Vec2& at = request.position;
    const Real reach =
        request.displacement.cwiseAbs().sum() + settings_.snap + settings_.step_height + 2 * tolerances.look;
    const Box2 touched = space_.touched_from(Box2{at, at}.inflated(reach));
    for (MoverIndex mover = 0; mover < mover_phases_.size(); ++mover) {
      const Box2& whole = mover_phases_.whole(mover);
      const MoverMotion& motion = request.movers[mover];
      if (touched.overlaps(
              {whole.lower + motion.from.cwiseMin(motion.to), whole.upper + motion.from.cwiseMax(motion.to)}))
        return true;
    }
    return false;
  }

  broad_phase::Tree tree_;
  MoverPhases mover_phases_;
  ConfigurationSpace space_;
  Settings settings_;
  std::size_t touched_at_once_;
  bool has_conveyors_;
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
