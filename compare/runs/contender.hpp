/// One side of a comparison: something that moves the characters of a scene, step by step.
#pragma once

#include "records/row.hpp"
#include "records/trace.hpp"
#include "runs/scene_plan.hpp"
#include "scenes/scene.hpp"

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// The names the command takes, in the order of the tables: the techniques, then Box2D, then peers.
[[nodiscard]] std::vector<std::string_view> contender_names();
[[nodiscard]] bool is_reference(std::string_view contender);

enum class ScalarKind : std::uint8_t { binary64, binary32 };
[[nodiscard]] std::string_view name_of(ScalarKind scalar) noexcept;
/// All but `octagon_sweep`: asked for several numbers, they run in the first.
[[nodiscard]] inline bool computes_in_one(std::string_view contender) { return contender != "octagon_sweep"; }

/// What a contender carries from step to step that a twin in lockstep takes over.
struct Pose {
  Vec2d position{Vec2d::Zero()};
  TraceState state{};
  Vec2d ground_normal{Vec2d::UnitY()};  ///< Of the surface that carries it.
};

/// What happens to every contender alike in one step.
struct StepInput {
  double dt = 0;                        ///< [s]
  std::span<const Input> players;       ///< One for each character.
  std::span<const MoverMotion> movers;  ///< One for each mover of the scene.
  Vec2d gravity{Vec2d::Zero()};         ///< [m/s²]
  Vec2d up{Vec2d::UnitY()};             ///< Unit vector.
};

class Contender {
 public:
  virtual ~Contender() = default;
  [[nodiscard]] virtual const TraceHeader& header() const noexcept = 0;
  /// One step. Fills everything of the records, one for each character, but step, character, the overlaps at the start
  /// and respawn. Movers are recorded as they ran: the input's, rounded to what the contender computes in.
  virtual void step(const StepInput& input, std::span<TraceStep> records) = 0;
  /// One step without a record, for timing.
  virtual void step_unrecorded(const StepInput& input) = 0;
  /// From now on, or no longer, what is wanted in each step is kept for `step_bare`.
  /// @return whether this is an engine that can be timed without what the harness does around it.
  virtual bool keep_wishes(bool /*keep*/) { return false; }
  /// The engine's part of the k-th step that was kept: what is wanted is known, and nothing is read.
  virtual void step_bare(const StepInput& /*input*/, std::size_t /*k*/) {}
  [[nodiscard]] virtual Pose pose(std::size_t character = 0) const = 0;
  virtual void place(const Pose& pose, std::size_t character = 0) = 0;
  /// Gives a character another velocity [m/s], and leaves it the rest of its state where it can.
  virtual void launch(const Vec2d& velocity, std::size_t character);
  /// Writes what a program of somebody else's says of itself.
  virtual void write_notes(Row& /*row*/) const {}
  /// What a character would overlap at a place, as the engine's own query has it: ids. Nothing where it has no query.
  /// @param movers where each stands.
  [[nodiscard]] virtual std::optional<std::vector<std::string>> overlapped_at(const Vec2d& /*place*/,
                                                                              std::span<const MoverMotion> /*movers*/) {
    return std::nullopt;
  }
  /// What its own picture of the level takes [bytes]; 0 where it keeps none.
  [[nodiscard]] virtual std::size_t memory_bytes() const { return 0; }
};

/// A contender cannot make a run. The message says why, and the row has the verdict `not_applicable`.
class NotApplicable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A step that the contender is not made for was refused; the steps before it stand.
class StepRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// At rest in the air, but for its velocity.
[[nodiscard]] Pose pose_at(const Start& start);
/// Puts every character where the scene has it begin.
void place_at_start(Contender& contender, const Scene& scene);

/// @param scenery of the scene, in double; must outlive the contender.
/// @param planning of the techniques; Box2D has none.
/// @throws NotApplicable where the contender cannot express the scene; std::exception where it cannot be built.
[[nodiscard]] std::unique_ptr<Contender> make_contender(std::string_view name, ScalarKind scalar, const Scene& scene,
                                                        const Scenery& scenery, const Planning& planning = {});

}  // namespace paperproof::compare
