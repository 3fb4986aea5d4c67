#include "step/octagon_sweep.hpp"

#include "broad_phase/most_at_once.hpp"
#include "step/solvers.hpp"

#include <paperproof/scenery_facts.hpp>

#include <cmath>
#include <numbers>

namespace paperproof {
namespace {

using namespace octagon_sweep;

/// Each impact is a corner of the path; the start, the end, a start that is put right and a snap are corners too.
constexpr int most_iterations = static_cast<int>(MoveResult<double>::max_corners) - 4;

template <class Scalar>
Settings<Scalar> settings_for(const SweepDef& def, ColliderIndex first_companion, const CharacterDef& character) {
  const double limit = character.max_climb_degrees * std::numbers::pi / 180;
  const Vec2d extent = character.shape.box().upper - character.shape.box().lower;
  return {
      .walkable_cosine = character.walkable_cosine<Scalar>(),
      .walkable_tangent = static_cast<Scalar>(std::tan(limit)),
      .snap = static_cast<Scalar>(character.snap),
      .max_fall_speed = static_cast<Scalar>(character.max_fall_speed.value_or(std::numeric_limits<double>::infinity())),
      .look_ahead = static_cast<Scalar>(look_ahead_share * std::max(extent.x(), extent.y())),
      .iterations = def.iterations,
      .first_companion = first_companion};
}

void refuse_omission(bool unsafe, const char* stage, const char* reason) {
  if (unsafe) throw std::invalid_argument("stages: " + std::string(stage) + " cannot be left out: " + reason);
}

template <class Scalar>
void check(const Stages& stages, const Scenery<Scalar>& scenery, const ConfigurationSpace<Scalar>& space) {
  refuse_omission(!stages.movers && scenery.mover_count() > 0, "movers", "something moves");
  refuse_omission(!stages.movers && has_conveyors(scenery), "movers", "there is a conveyor");
  refuse_omission(!stages.one_way && has_one_way_chains(scenery), "one_way", "there is a one-way chain");
  refuse_omission(!stages.slopes && space.has_own_axes(), "slopes",
                  "there is an edge that is parallel to no side of the character or of its box");
}

/// Among scenery that stands still.
template <class Scalar>
class OctagonSweep : public Technique<Scalar> {
 public:
  OctagonSweep(const SweepDef& def, const Scenery<Scalar>& scenery, const CharacterDef& character,
               ColliderIndex first_companion)
      : broad_phase_(make_broad_phase<Scalar>(def.broad_phase, scenery.static_boxes())),
        mover_phases_(def.broad_phase, scenery),
        // Every piece asks for its neighbours once, which would take all_pairs the square of their number.
        space_(scenery, character.shape,
               def.broad_phase == BroadPhaseKind::all_pairs
                   ? *make_broad_phase<Scalar>(BroadPhaseKind::tree, scenery.static_boxes())
                   : *broad_phase_,
               mover_phases_),
        settings_(settings_for<Scalar>(def, first_companion, character)),
        touched_at_once_(broad_phase::most_at_once<Scalar>(scenery.static_boxes(), space_.touched_size())),
        solve_(still_solver<Scalar>(
            {.lanes = space_.lanes(), .movers = false, .one_way = def.stages.one_way, .slopes = def.stages.slopes})) {
    check(def.stages, scenery, space_);
  }

  [[nodiscard]] std::string_view name() const noexcept override { return "octagon_sweep"; }

  [[nodiscard]] Scratch<Scalar> make_scratch() const override {
    Scratch<Scalar> scratch;
    scratch.solids.pieces.resize(broad_phase_->size());
    scratch.own = std::make_unique<StepMemory<Scalar>>(space_, touched_at_once_, settings_.iterations);
    return scratch;
  }

  void move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
            MoveResult<Scalar>& result) const noexcept override {
    result.clear();
    if (in_range(request))
      solve_(space_, settings_, neighbourhood(scratch), request, result);
    else
      refuse(request, result);
  }

 protected:
  [[nodiscard]] Neighbourhood<Scalar> neighbourhood(Scratch<Scalar>& scratch) const noexcept {
    return {space_, *broad_phase_, settings_.look_ahead, scratch};
  }

  [[nodiscard]] static bool in_range(const MoveRequest<Scalar>& request) noexcept {
    constexpr Scalar range = Tolerances<Scalar>{}.range;
    // Written so that NaN is out of range, and by component: see `wanted_velocity`.
    const auto within = [](Scalar value) { return std::abs(value) <= range; };
    return within(request.position.x()) && within(request.position.y()) &&
           within(request.position.x() + request.displacement.x()) &&
           within(request.position.y() + request.displacement.y());
  }

  static void refuse(const MoveRequest<Scalar>& request, MoveResult<Scalar>& result) noexcept {
    result.status = MoveStatus::out_of_range;
    result.position = request.position;
    result.velocity = request.velocity + request.ride.velocity;
    result.ride = request.ride;
    result.path.push_back({request.position, 0});
    result.path.push_back({request.position, 1});
  }

  std::unique_ptr<BroadPhase<Scalar>> broad_phase_;
  MoverPhases<Scalar> mover_phases_;
  ConfigurationSpace<Scalar> space_;
  Settings<Scalar> settings_;
  std::size_t touched_at_once_;
  SolveStill<Scalar> solve_;
};

/// Among movers and conveyors.
template <class Scalar>
class OctagonSweepAmongMovers final : public OctagonSweep<Scalar> {
 public:
  OctagonSweepAmongMovers(const SweepDef& def, const Scenery<Scalar>& scenery, const CharacterDef& character,
                          ColliderIndex first_companion)
      : OctagonSweep<Scalar>(def, scenery, character, first_companion),
        solve_moving_(moving_solver<Scalar>(this->space_.lanes())),
        has_conveyors_(has_conveyors(scenery)) {}

  [[nodiscard]] Scratch<Scalar> make_scratch() const override {
    Scratch<Scalar> scratch = OctagonSweep<Scalar>::make_scratch();
    scratch.own =
        std::make_unique<MoverMemory<Scalar>>(this->space_, this->touched_at_once_, this->settings_.iterations);
    return scratch;
  }

  /// A step that keeps away from everything that moves is one without movers, and costs no more.
  void move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
            MoveResult<Scalar>& result) const noexcept override {
    result.clear();
    if (!this->in_range(request) || request.movers.size() != mover_phases().size() ||
        (!request.movers.empty() && !(request.dt > 0)))
      return this->refuse(request, result);
    const Neighbourhood<Scalar> neighbourhood = this->neighbourhood(scratch);
    const bool rides = request.ride.ground != Ride<Scalar>::none;
    const bool needs_no_mover = !rides && !request.stays;
    if (needs_no_mover && request.movers.empty() && !has_conveyors_)
      return this->solve_(this->space_, this->settings_, neighbourhood, request, result);
    if (needs_no_mover && keeps_away({request.position, request.position}, request)) {
      this->solve_(this->space_, this->settings_, neighbourhood, request, result);
      if (keeps_away(looked_at(request, result.path), request) && !meets_conveyor(result)) return;
      result.clear();
    }
    auto& memory = static_cast<MoverMemory<Scalar>&>(*scratch.own);
    const Surroundings<Scalar> surroundings{mover_phases(), request.movers, request.dt, memory};
    solve_moving_(this->space_, this->settings_, neighbourhood, surroundings, request, result);
  }

 private:
  [[nodiscard]] const MoverPhases<Scalar>& mover_phases() const noexcept { return this->mover_phases_; }

  /// The positions on the way, and if it left a solid those from where the side was seen to which it did.
  template <class Path>
  [[nodiscard]] static Box2<Scalar> looked_at(const MoveRequest<Scalar>& request, const Path& path) noexcept {
    Box2<Scalar> box{path[0].position, path[0].position};
    for (const PathPoint<Scalar>& corner : path) box = box.merged({corner.position, corner.position});
    const bool at_once = path.size() > 1 && path[1].fraction == 0;
    if (at_once && request.has_last_free) box = box.merged({request.last_free, request.last_free});
    return box;
  }

  /// Whether no mover comes near a character that is anywhere in a box, during the whole step.
  [[nodiscard]] bool keeps_away(const Box2<Scalar>& positions, const MoveRequest<Scalar>& request) const noexcept {
    if (request.movers.empty()) return true;
    const Box2<Scalar> touched = this->space_.touched_from(positions.inflated(Tolerances<Scalar>{}.look));
    for (MoverIndex mover = 0; mover < mover_phases().size(); ++mover) {
      const Box2<Scalar>& whole = mover_phases().whole(mover);
      const MoverMotion<Scalar>& motion = request.movers[mover];
      const Box2<Scalar> swept{whole.lower + motion.from.cwiseMin(motion.to),
                               whole.upper + motion.from.cwiseMax(motion.to)};
      if (touched.overlaps(swept)) return false;
    }
    return true;
  }

  [[nodiscard]] bool meets_conveyor(const MoveResult<Scalar>& result) const noexcept {
    if (!has_conveyors_) return false;
    return std::any_of(result.contacts.begin(), result.contacts.end(), [&](const Contact<Scalar>& contact) {
      return this->space_.scenery().collider(contact.collider).surface_speed != 0;
    });
  }

  SolveMoving<Scalar> solve_moving_;
  bool has_conveyors_;
};

}  // namespace

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make_sweep_among_companions(const SweepDef& def, const Scenery<Scalar>& scenery,
                                                               const CharacterDef& character,
                                                               ColliderIndex first_companion) {
  character.validate();
  if (def.iterations < 1 || def.iterations > most_iterations)
    throw std::invalid_argument("sweep_iterations: must be from 1 to " + std::to_string(most_iterations) + ", not " +
                                std::to_string(def.iterations));
  // A conveyor or a mover is needed for anything but a step without movers.
  if (def.stages.movers && (scenery.mover_count() > 0 || has_conveyors(scenery)))
    return std::make_unique<OctagonSweepAmongMovers<Scalar>>(def, scenery, character, first_companion);
  return std::make_unique<OctagonSweep<Scalar>>(def, scenery, character, first_companion);
}

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make_octagon_sweep(const SweepDef& def, const Scenery<Scalar>& scenery,
                                                      const CharacterDef& character) {
  return make_sweep_among_companions(def, scenery, character, ~ColliderIndex{0});
}

#define PAPERPROOF_INSTANTIATE(Scalar)                                                                             \
  template std::unique_ptr<Technique<Scalar>> make_octagon_sweep(const SweepDef&, const Scenery<Scalar>&,          \
                                                                 const CharacterDef&);                             \
  template std::unique_ptr<Technique<Scalar>> make_sweep_among_companions(const SweepDef&, const Scenery<Scalar>&, \
                                                                          const CharacterDef&, ColliderIndex)
PAPERPROOF_INSTANTIATE(float);
PAPERPROOF_INSTANTIATE(double);
#undef PAPERPROOF_INSTANTIATE

}  // namespace paperproof
