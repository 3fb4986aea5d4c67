#include "step/octagon_sweep.hpp"

#include "broad_phase/most_at_once.hpp"
#include "step/query.hpp"
#include "step/solve.hpp"

#include <paperproof/scenery_facts.hpp>

#include <cmath>
#include <numbers>
#include <type_traits>

namespace paperproof {
namespace {

using namespace octagon_sweep;

/// Each impact is a corner of the path; the start, the end, a start that is put right and a snap are corners too.
constexpr int most_iterations = static_cast<int>(MoveResult<double>::max_corners) - 4;

template <class Scalar>
Settings<Scalar> settings_for(const SweepDef& def, const CharacterDef& character) {
  const double limit = character.max_climb_degrees * std::numbers::pi / 180;
  const Vec2d extent = character.shape.box().upper - character.shape.box().lower;
  return {
      .walkable_cosine = character.walkable_cosine<Scalar>(),
      .walkable_tangent = static_cast<Scalar>(std::tan(limit)),
      .snap = static_cast<Scalar>(character.snap),
      .step_height = static_cast<Scalar>(character.step_height),
      .max_fall_speed = static_cast<Scalar>(character.max_fall_speed.value_or(std::numeric_limits<double>::infinity())),
      .look_ahead = static_cast<Scalar>(look_ahead_share * std::max(extent.x(), extent.y())),
      .iterations = def.iterations};
}

template <class Scalar>
class OctagonSweep final : public SweepInParts<Scalar> {
 public:
  OctagonSweep(const SweepDef& def, const Scenery<Scalar>& scenery, const CharacterDef& character)
      : tree_(scenery.static_boxes(), def.search),
        mover_phases_(def.search, scenery),
        // Every piece asks for its neighbours once: without a tree that takes the square of their number.
        space_(scenery, character.shape,
               def.search == PieceSearch::tree ? tree_
                                               : *std::make_unique<broad_phase::Tree<Scalar>>(scenery.static_boxes()),
               mover_phases_),
        settings_(settings_for<Scalar>(def, character)),
        touched_at_once_(broad_phase::most_at_once<Scalar>(scenery.static_boxes(), space_.touched_size())),
        has_conveyors_(has_conveyors(scenery)),
        solve_(solver_for<Scalar>(space_.lanes(), false)),
        solve_turned_(solver_for<Scalar>(space_.lanes(), true)) {}

  [[nodiscard]] Scratch<Scalar> make_scratch() const override {
    Scratch<Scalar> scratch;
    scratch.solids.pieces = PieceBuffer(space_.scenery().sensor_pieces().first);
    scratch.own = std::make_unique<StepMemory<Scalar>>(space_, touched_at_once_, settings_.iterations);
    return scratch;
  }

  void move_part(Part part, const StepRequest<Scalar>& request, Scratch<Scalar>& scratch,
                 MoveResult<Scalar>& result) const noexcept override {
    result.clear();
    if (!in_range(request) || request.movers.size() != mover_phases_.size() ||
        (!request.movers.empty() && !(request.dt > 0)))
      return refuse(request, result);
    const Neighbourhood<Scalar> neighbourhood(space_, tree_, settings_.look_ahead, request.filter, scratch);
    const bool rides = request.ride.ground != Ride<Scalar>::none;
    MoversInStep<Scalar> movers{mover_phases_, request.movers, request.dt, 0, has_conveyors_ || rides};
    if (!request.movers.empty() && (part == Part::stay || comes_near_a_mover(request))) movers.look_at_all();
    const Solve<Scalar> solve = request.up.is_turned() ? solve_turned_ : solve_;
    solve(space_, settings_, neighbourhood, movers, part, request, result);
  }

  [[nodiscard]] std::optional<Contact<Scalar>> cast(const StepRequest<Scalar>& at,
                                                    Scratch<Scalar>& scratch) const noexcept override {
    return ask(at, scratch, [&](Surroundings<Scalar>& around, auto lanes) {
      return octagon_sweep::cast<lanes>(around, at.position, at.displacement);
    });
  }
  [[nodiscard]] std::size_t overlaps(const StepRequest<Scalar>& at, Scratch<Scalar>& scratch,
                                     std::span<ColliderIndex> found) const noexcept override {
    return ask(at, scratch, [&](Surroundings<Scalar>& around, auto lanes) {
      return octagon_sweep::overlaps<lanes>(around, at.position, found);
    });
  }
  [[nodiscard]] std::size_t contacts_at(const StepRequest<Scalar>& at, Scalar within, Scratch<Scalar>& scratch,
                                        std::span<Contact<Scalar>> found) const noexcept override {
    return ask(at, scratch, [&](Surroundings<Scalar>& around, auto lanes) {
      return octagon_sweep::contacts_at<lanes>(around, at.position, within, found);
    });
  }

 private:
  template <class Question>
  [[nodiscard]] auto ask(const StepRequest<Scalar>& at, Scratch<Scalar>& scratch,
                         const Question& question) const noexcept {
    Surroundings<Scalar> around{
        space_, {space_, tree_, settings_.look_ahead, at.filter, scratch}, mover_phases_, at.movers, at.filter, at.up};
    const auto answer = space_.lanes() == 8 ? question(around, std::integral_constant<std::size_t, 8>{})
                                            : question(around, std::integral_constant<std::size_t, 12>{});
    around.neighbourhood.forget();  // a wide question would make the next steps slow
    return answer;
  }
  [[nodiscard]] static bool in_range(const StepRequest<Scalar>& request) noexcept {
    constexpr Scalar range = Tolerances<Scalar>{}.range;
    // Written so that NaN is out of range, and by component: see `wanted_velocity`.
    const auto within = [](Scalar value) { return std::abs(value) <= range; };
    return within(request.position.x()) && within(request.position.y()) &&
           within(request.position.x() + request.displacement.x()) &&
           within(request.position.y() + request.displacement.y());
  }

  static void refuse(const StepRequest<Scalar>& request, MoveResult<Scalar>& result) noexcept {
    result.status = MoveStatus::out_of_range;
    result.position = request.position;
    result.velocity = request.velocity + request.ride.velocity;
    result.ride = request.ride;
    result.path.push_back({request.position, 0});
    result.path.push_back({request.position, 1});
  }

  /// Whether a mover may come near the character during the step. A step that no mover pushes ends no further away than
  /// its displacement is long, and the snap.
  [[nodiscard]] bool comes_near_a_mover(const StepRequest<Scalar>& request) const noexcept {
    if (request.ride.ground != Ride<Scalar>::none || request.crushed) return true;
    const Vec2<Scalar>& at = request.position;
    const Scalar reach =
        request.displacement.cwiseAbs().sum() + settings_.snap + settings_.step_height + 2 * Tolerances<Scalar>{}.look;
    const Box2<Scalar> touched = space_.touched_from(Box2<Scalar>{at, at}.inflated(reach));
    for (MoverIndex mover = 0; mover < mover_phases_.size(); ++mover) {
      const Box2<Scalar>& whole = mover_phases_.whole(mover);
      const MoverMotion<Scalar>& motion = request.movers[mover];
      if (touched.overlaps(
              {whole.lower + motion.from.cwiseMin(motion.to), whole.upper + motion.from.cwiseMax(motion.to)}))
        return true;
    }
    return false;
  }

  broad_phase::Tree<Scalar> tree_;
  MoverPhases<Scalar> mover_phases_;
  ConfigurationSpace<Scalar> space_;
  Settings<Scalar> settings_;
  std::size_t touched_at_once_;
  bool has_conveyors_;
  Solve<Scalar> solve_;         ///< For upright characters,
  Solve<Scalar> solve_turned_;  ///< and for others.
};

}  // namespace

template <class Scalar>
std::unique_ptr<SweepInParts<Scalar>> octagon_sweep::make_sweep_in_parts(const SweepDef& def,
                                                                         const Scenery<Scalar>& scenery,
                                                                         const CharacterDef& character) {
  character.validate();
  if (def.iterations < 1 || def.iterations > most_iterations)
    throw std::invalid_argument("sweep_iterations: must be from 1 to " + std::to_string(most_iterations) + ", not " +
                                std::to_string(def.iterations));
  return std::make_unique<OctagonSweep<Scalar>>(def, scenery, character);
}

template std::unique_ptr<SweepInParts<float>> octagon_sweep::make_sweep_in_parts(const SweepDef&, const Scenery<float>&,
                                                                                 const CharacterDef&);
template std::unique_ptr<SweepInParts<double>> octagon_sweep::make_sweep_in_parts(const SweepDef&,
                                                                                  const Scenery<double>&,
                                                                                  const CharacterDef&);

}  // namespace paperproof
