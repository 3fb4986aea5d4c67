/// Several characters that are in each other's way.
#pragma once

#include <paperproof/controller.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace paperproof {

/// Position of a character in a list of several.
using CharacterIndex = std::uint32_t;

/// Another character was in the way: what a `Contact` with its body says.
struct CrowdContact {
  CharacterIndex other = 0;
  Vec2d normal{Vec2d::Zero()};  ///< Unit, from the other towards this one.
  double fraction = 0;          ///< Time of impact as a fraction of the step, in [0, 1].
  Side side = Side::bottom;     ///< Of this character.
};

/// The body of a character, for the others: a collider of its shape. Add one to the level for each character. It is
/// there only in `step_together`, which puts it where the character is.
/// @param filter for whom it is there.
[[nodiscard]] ColliderDef body_of(const CharacterDef& character, const Filter& filter = {});

/// One of several characters.
struct Companion {
  const Controller* controller = nullptr;  ///< All are of one level. Any number may share one.
  CharacterState* state = nullptr;
  Input input{};
  ColliderIndex body = no_collider;  ///< Its own in the level: see `body_of`.
  Scratch* scratch = nullptr;        ///< Made by the controller. Those that share the controller may share one.
  StepReport* report = nullptr;      ///< Contacts name the bodies of others as they name any collider.
  std::size_t turn = 0;              ///< Written: its place in the order of this step, from 0.
  /// Written: the bodies of the others that went, in its turn, along their ways of this step. All others stood.
  std::vector<ColliderIndex> moving{};
};

/// One of several characters that take turns: what `take_turns` asks of it. `step_together` needs none of a game.
class TurnTaker {
 public:
  /// Another one in its turn: where it stands, or how it goes.
  struct Other {
    std::size_t who;
    MoverMotion motion;
  };

  virtual ~TurnTaker() = default;
  [[nodiscard]] virtual const Controller& controller() const = 0;
  [[nodiscard]] virtual CharacterState& state() = 0;
  [[nodiscard]] virtual StepReport& report() = 0;
  /// Of all positions that its step may lead to, what the character covers there [m].
  [[nodiscard]] virtual Box2 reach() const = 0;
  /// Whether a collider that it met is the body of another.
  [[nodiscard]] virtual bool is_body_of(ColliderIndex collider, std::size_t other) const = 0;
  /// Makes its step from its state.
  /// @param others those that are there. @param is_taken without input and gravity: it goes only as movers take it.
  virtual void step(std::span<const Other> others, bool is_taken) = 0;
};

/// Memory of `step_together`, one per thread. It carries nothing from step to step.
struct TogetherScratch {
  std::unique_ptr<OwnMemory> own;
};

/// One step of several characters that block, carry and push each other. Each makes the step that `Controller` makes.
/// They take turns:
///
/// 1. While one goes the others stand, but for rule 3: those that went before it where they ended, those that go after
///    it where they began. So two that do not overlap at the beginning of a step do not overlap at its end, and do not
///    pass through each other.
/// 2. They go in the order of their bodies' ids, with these exceptions. A character goes before another if it is in its
///    way. A carrier goes before its rider, unless the rider is in its way, as on a lift that rises. Of several that
///    wait for each other the last one goes first, and stops at the others.
/// 3. To its rider a character is a mover, which goes straight and evenly from where it began to where it ended, and
///    carries. To another one it is such a mover, and pushes, if it went before and came no nearer: along one of the
///    directions in which the two began farthest apart. Else it stands where it ended. Where a way among such
///    characters would lead through one of them as it stands, or one of them would crush, they all stand.
/// 4. A rider that goes first is carried by the way that its carrier would go without it. One that a mover presses
///    pushes those in its way: they go first, as far as movers alone would take the one that is pressed. If they have
///    no room, the mover crushes that one, at the moment when they leave it none: room that they would leave later is
///    not used. No character crushes another. None that walks or falls pushes one.
/// 5. Where one that was to carry or push then goes another way than those saw, as others push or hold it, all go
///    again, and see it go by that way; from the fourth time on it stands for them.
/// 6. When all have gone a rider takes over the velocity with which its carrier ends, unless that went from under it.
///
/// A character that meets no other makes the same step as alone, bit for bit. One whose step is refused stands where it
/// is, and its report says why. The order of `companions` does not matter, only that of the ids.
///
/// Cost: one sorting finds who is near whom. A step is made again where another is in the way.
/// @param companions each with its own state, body and report.
/// @param context the filter of each; its movers are those of the level.
void step_together(std::span<Companion> companions, const StepContext& context, TogetherScratch& scratch);

/// The turns of `step_together`, for steps that are made in another way.
/// @param all in the order in which they go where none is in the way of another. @param up of all.
/// @return for each its place in the order of this step, from 0; valid until the next call.
std::span<const std::size_t> take_turns(std::span<TurnTaker* const> all, const Vec2d& up, TogetherScratch& scratch);

}  // namespace paperproof
