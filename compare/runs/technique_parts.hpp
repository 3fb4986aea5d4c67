/// What the contenders have in common that run our controller: scenery, header, and how a report becomes a record;
/// and, with the twin, how a state becomes a pose.
#pragma once

#include "runs/contender.hpp"

#include <paperproof/techniques.hpp>

namespace paperproof::compare {

/// The nearest number of the type that runs.
[[nodiscard]] double as_run(double value, ScalarKind scalar) noexcept;
[[nodiscard]] Vec2d as_run(const Vec2d& value, ScalarKind scalar) noexcept;
[[nodiscard]] SceneryDef as_run(SceneryDef scenery, ScalarKind scalar);

/// @throws NotApplicable for a technique that would have to draw a picture coarser than it is, or pixel_tile with
///   other pixels than those of the scene's tiles.
[[nodiscard]] TechniqueDef definition_of(const TechniqueEntry& technique, const Scene& scene, const Planning& planning);

/// The scene's character with the jumping rules in force. The knob `jump_rules` comes first, then the scene's own word,
/// then what is usual: on for the article's techniques, off for octagon_sweep.
[[nodiscard]] CharacterDef rules_for(const TechniqueEntry& technique, const Scene& scene,
                                     std::span<const KnobSetting> knobs = {});
/// The same for a twin, which has no such knob: the scene's own word, or off.
[[nodiscard]] CharacterDef rules_for_twin(const Scene& scene);

/// `jump_rules` as rows have it: 1 where both rules are in force, 0 for none, 0.5 for one of them.
[[nodiscard]] double jump_rules_in_force(const CharacterDef& character);

/// Which movers turn, by mover; empty where none does: `TraceHeader::turning`.
[[nodiscard]] std::vector<bool> turning_movers(const Scene& scene);

/// What a trace says of the scene: what is wanted, where characters begin, and where movers are.
/// @param character with the jumping rules in force.
void add_terms(const Scene& scene, const CharacterDef& character, TraceHeader& header);

[[nodiscard]] TraceHeader header_of(const TechniqueEntry& technique, ScalarKind scalar, const Scenery& scenery,
                                    const Scene& scene, const Planning& planning);

/// On which side of the character a contact is: the sides of the article's techniques are those that they search, and
/// a trace has those that their normals say.
enum class Sides : std::uint8_t { as_said, of_normals };
[[nodiscard]] inline Sides sides_of(const TechniqueEntry& technique) {
  return technique.name == "octagon_sweep" ? Sides::as_said : Sides::of_normals;
}

/// Of the state in which a step ends: velocity, `grounded`, `jumping` and the ride.
void write_state(const CharacterState& state, TraceStep& record);

/// Fills what a step report and the state after it say; not `movers`. `requested` is as the controller has it: relative
/// to what carries the character.
void write_report(const StepReport& report, const CharacterState& state, Sides sides, TraceStep& record);

/// @param refusal the technique's own reason, where it refused.
/// @throws StepRefused for a motion that is too far, std::runtime_error for one that is not finite.
void refuse_unusable(StepStatus status, std::string_view refusal = {});

[[nodiscard]] Pose pose_of(const CharacterState& state);

/// A new story begins there, without a ride.
[[nodiscard]] CharacterState state_at(const Pose& pose, ScalarKind scalar = ScalarKind::binary64);

}  // namespace paperproof::compare
