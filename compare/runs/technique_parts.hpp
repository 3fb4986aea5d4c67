/// What the contestants have in common that run our controller: scenery, header, and how a report becomes a record;
/// and, with the twin, how a state becomes a pose.
#pragma once

#include "runs/contestant.hpp"

#include <paperproof/controller.hpp>

#include <type_traits>

namespace paperproof::compare {

/// `Scenery<double>` is shared by all contestants of a scene; one in float brings its own, rounded.
template <class Scalar>
class OwnScenery {
 public:
  explicit OwnScenery(const Scenery<double>& shared) : own_(shared.as_run()) {}
  [[nodiscard]] const Scenery<Scalar>& get() const noexcept { return own_; }

 private:
  Scenery<Scalar> own_;
};
template <>
class OwnScenery<double> {
 public:
  explicit OwnScenery(const Scenery<double>& shared) : shared_(shared) {}
  [[nodiscard]] const Scenery<double>& get() const noexcept { return shared_; }

 private:
  const Scenery<double>& shared_;
};

/// @throws NotApplicable for a technique that would have to draw a picture coarser than it is, or pixel_tile where it
///   would see only the part of the scenery that is in a file of tiles, or with other pixels than those of the file.
[[nodiscard]] TechniqueDef definition_of(TechniqueKind kind, const Scene& scene, const Plan& plan,
                                         std::span<const KnobSetting> knobs);

/// The article's jumping rules belong to the article's techniques; for octagon_sweep they are the scene's choice.
[[nodiscard]] CharacterDef rules_for(TechniqueKind kind, CharacterDef character);

template <class Scalar>
[[nodiscard]] TraceHeader header_of(TechniqueKind kind, const Scenery<Scalar>& scenery, const Scene& scene,
                                    const Plan& plan, std::span<const KnobSetting> knobs);

/// Fills what a step report and the state after it say; not `movers`. `requested` is as the controller has it: relative
/// to what carries the character.
template <class Scalar>
void write_report(const StepReport<Scalar>& report, const CharacterState<Scalar>& state, TraceStep& record);

/// @throws StepRefused for a motion that is too far, std::runtime_error for one that is not finite.
void refuse_unusable(StepStatus status);

template <class Scalar>
[[nodiscard]] Pose pose_of(const CharacterState<Scalar>& state);

/// A new story begins there.
template <class Scalar>
[[nodiscard]] CharacterState<Scalar> state_at(const Pose& pose);

}  // namespace paperproof::compare
