/// What is compared: anything that takes a character through a workload.
#pragma once

#include "workload.hpp"

#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof::benchmarks {

class Subject {
 public:
  virtual ~Subject() = default;
  /// Back to the start of the workload; not timed.
  virtual void restart() = 0;
  /// All steps of the workload, without a record of them.
  virtual void run() = 0;
  /// Where the character is [m].
  [[nodiscard]] virtual Vec2d position() const = 0;
};

/// The controller alone, by default with octagon_sweep and every stage: intent, gravity, move and contacts.
[[nodiscard]] std::unique_ptr<Subject> make_controller(const Workload& workload, const SweepDef& technique = {});

/// The controller with any technique and the knobs that `paperproof compare` gives it; one virtual call more.
/// @throws compare::NotApplicable where the technique cannot express the level.
[[nodiscard]] std::unique_ptr<Subject> make_contender(const Workload& workload, std::string_view kind);

enum class Box2dScenery { chain_loops, pieces };

/// Box2D alone: a `b2World` that is given the velocities which the twin wants, formed beforehand. It neither reads
/// contacts nor decides about jumps, as a game would have to: all of its time is `SetLinearVelocity` and `Step`.
/// @throws std::logic_error if it does not arrive where the twin does.
[[nodiscard]] std::unique_ptr<Subject> make_bare_box2d(const Workload& workload, Box2dScenery scenery);

/// The twin as `paperproof compare` runs it, with its listener and its list of contacts.
[[nodiscard]] std::unique_ptr<Subject> make_recorded_box2d(const Workload& workload, Box2dScenery scenery);

}  // namespace paperproof::benchmarks
