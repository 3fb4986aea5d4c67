/// The swept step, and the questions that it answers.
#pragma once

#include <paperproof/report.hpp>
#include <paperproof/step_context.hpp>
#include <paperproof/tolerances.hpp>
#include <paperproof/up_frame.hpp>

#include "piece_finder.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <span>

namespace paperproof::octagon_sweep {

/// How far a step takes a character that did not want to go [m].
struct Limits {
  double push = Tolerances{}.push;                       ///< So much farther than what pushes it, or crushed it before.
  double out = std::numeric_limits<double>::infinity();  ///< Out of anything else that it begins in.
};

/// What is around a character in a step or a question.
struct Around {
  Moving moving{};                         ///< With a motion for each mover of the scenery.
  const ColliderFilter* filter = nullptr;  ///< Null: all colliders are there.
  UpFrame up{};                            ///< See `StepContext::up`.
  Limits limits{};
};

/// What a step wants, and what it knows of the steps before.
struct StepRequest {
  /// As the step begins; its velocity is not read. It is `grounded` if the last step ended on the ground, and this one
  /// does not begin with a jump. If it rides, `displacement` and `velocity` are relative to the
  /// ground that carries it, and the step adds the motion of that ground.
  const CharacterState& state;
  Vec2d displacement;  ///< The wanted displacement [m].
  Vec2d velocity;      ///< The velocity behind the displacement [m/s].
  double dt;           ///< [s]
  const Around& around;
  double steered = 0;  ///< The part of `velocity` across up that this step's steering added [m/s].
  bool drop = false;   ///< One-way chains do not block: see `Input::drop`.
  /// Duration of one more step [s]: a motion leaves ground if it goes away from it by more than `Tolerances::touch` in
  /// that time. Zero in a step that begins with a jump: it leaves ground at any speed.
  double next_dt = dt;
};

/// Const and shareable between threads; each thread brings its scratch. No call throws, and each allocates as
/// `Controller::reserve` says.
class SweepInParts {
 public:
  virtual ~SweepInParts() = default;

  [[nodiscard]] virtual Scratch make_scratch() const = 0;
  /// See `Controller::reserve`.
  virtual void reserve(const Box2& positions, Scratch& scratch) const = 0;

  /// @param scratch made by this sweep, which is not checked here.
  virtual void move(const StepRequest& request, Scratch& scratch, MoveResult& result) const = 0;

  /// See `paperproof::find_passed`.
  virtual void find_passed(const Around& around, std::span<const PathPoint> path, Scratch& scratch,
                           std::vector<ColliderIndex>& passed) const = 0;

  // See the calls of these names in `Controller`.
  [[nodiscard]] virtual std::optional<Contact> cast(const Vec2d& position, const Vec2d& displacement,
                                                    const Around& around, Scratch& scratch) const = 0;
  [[nodiscard]] virtual std::size_t overlaps(const Vec2d& position, const Around& around, Scratch& scratch,
                                             std::span<ColliderIndex> found) const = 0;
  [[nodiscard]] virtual std::size_t contacts_at(const Vec2d& position, double within, const Around& around,
                                                Scratch& scratch, std::span<Contact> found) const = 0;
};

/// For one scenery and one character. `scenery` must outlive it.
/// @throws std::invalid_argument for iterations out of range; InvalidCharacter for an impossible character.
namespace in_double {
[[nodiscard]] std::unique_ptr<SweepInParts> make_sweep(const SweepDef& def, const Scenery& scenery,
                                                       const CharacterDef& character);
}
/// The same sources, compiled once more.
namespace in_float {
[[nodiscard]] std::unique_ptr<SweepInParts> make_sweep(const SweepDef& def, const Scenery& scenery,
                                                       const CharacterDef& character);
}

}  // namespace paperproof::octagon_sweep
