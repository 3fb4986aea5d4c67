#include "techniques/octagon_sweep/octagon_sweep.hpp"

#include "techniques/octagon_sweep/step_solver.hpp"

#include <cmath>
#include <numbers>

namespace paperproof {
namespace {

using namespace octagon_sweep;

/// Candidates are collected at most this far ahead of a motion, in multiples of the character's larger extent. Zero:
/// every step asks the broad phase. Large: a fast step looks at pieces it never meets.
constexpr double look_ahead_share = 2;

template <class Scalar>
Settings<Scalar> settings_for(const TechniqueDef& def, const CharacterDef& character) {
  const double limit = character.max_climb_degrees * std::numbers::pi / 180;
  const Vec2d extent = character.shape.box().upper - character.shape.box().lower;
  return {.walkable_cosine = static_cast<Scalar>(std::cos(limit)),
          .walkable_tangent = static_cast<Scalar>(std::tan(limit)),
          .snap = static_cast<Scalar>(character.snap),
          .look_ahead = static_cast<Scalar>(look_ahead_share * std::max(extent.x(), extent.y())),
          .iterations = def.sweep_iterations};
}

template <class Scalar>
class OctagonSweep final : public Technique<Scalar> {
 public:
  OctagonSweep(const TechniqueDef& def, const Scenery<Scalar>& scenery, const CharacterDef& character)
      : broad_phase_(make_broad_phase<Scalar>(def.broad_phase, scenery.static_boxes())),
        space_(scenery, character.shape, *broad_phase_),
        settings_(settings_for<Scalar>(def, character)) {}

  [[nodiscard]] std::string_view name() const noexcept override { return name_of(TechniqueKind::octagon_sweep); }

  [[nodiscard]] Scratch<Scalar> make_scratch() const override {
    Scratch<Scalar> scratch;
    scratch.candidates.resize(broad_phase_->size());
    return scratch;
  }

  void move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
            MoveResult<Scalar>& result) const noexcept override {
    result.clear();
    if (!in_range(request)) {
      result.status = MoveStatus::out_of_range;
      result.position = request.position;
      result.velocity = request.velocity;
      result.path.push_back({request.position, 0});
      result.path.push_back({request.position, 1});
      return;
    }
    const Neighbourhood<Scalar> neighbourhood{space_, *broad_phase_, settings_.look_ahead, scratch};
    if (space_.lanes() == 8)
      StepSolver<8, Scalar>{space_, settings_, neighbourhood, result}.solve(request);
    else
      StepSolver<12, Scalar>{space_, settings_, neighbourhood, result}.solve(request);
  }

 private:
  [[nodiscard]] static bool in_range(const MoveRequest<Scalar>& request) noexcept {
    constexpr Scalar range = Tolerances<Scalar>{}.range;
    const Vec2<Scalar> target = request.position + request.displacement;
    // Written so that NaN is out of range.
    const auto within = [](Scalar value) { return std::abs(value) <= range; };
    return within(request.position.x()) && within(request.position.y()) && within(target.x()) && within(target.y());
  }

  std::unique_ptr<BroadPhase<Scalar>> broad_phase_;
  ConfigurationSpace<Scalar> space_;
  Settings<Scalar> settings_;
};

}  // namespace

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make_octagon_sweep(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                      const CharacterDef& character) {
  return std::make_unique<OctagonSweep<Scalar>>(def, scenery, character);
}

template std::unique_ptr<Technique<float>> make_octagon_sweep(const TechniqueDef&, const Scenery<float>&,
                                                              const CharacterDef&);
template std::unique_ptr<Technique<double>> make_octagon_sweep(const TechniqueDef&, const Scenery<double>&,
                                                               const CharacterDef&);

}  // namespace paperproof
