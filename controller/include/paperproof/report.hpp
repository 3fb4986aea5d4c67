/// What a step reports.
#pragma once

#include <paperproof/character.hpp>

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

namespace paperproof {

/// A collider was in the way of the requested motion.
struct Contact {
  ColliderIndex collider = 0;
  Vec2d point{Vec2d::Zero()};   ///< On the obstacle [m].
  Vec2d normal{Vec2d::Zero()};  ///< Unit, from the obstacle towards the character.
  double fraction = 0;          ///< Time of impact as a fraction of the step, in [0, 1].
  double separation = 0;        ///< Gap that is left, along the normal [m]; negative: overlap.
  Side side = Side::bottom;
};

/// The character's open interior came to overlap a sensor (of a chain: its line), or ceased to. Events of one sensor
/// alternate, also over steps, as long as the filter stays the same; a character that begins inside does not enter.
struct SensorEvent {
  enum class Change : std::uint8_t { enter, exit };
  ColliderIndex sensor = 0;
  Change change = Change::enter;
  double fraction = 0;  ///< Of the step, in [0, 1].
};

/// A corner of the path.
struct PathPoint {
  Vec2d position{Vec2d::Zero()};  ///< [m]
  double fraction = 0;            ///< Of the step, in [0, 1].
};

enum class StepStatus : std::uint8_t {
  moved,    ///< The result holds. It may be shorter than requested: see `contacts`.
  dropped,  ///< The result holds, but displacement was left and was dropped: the iterations ran out, or no exact proof
            ///< was found.
  stuck,    ///< The step began inside a solid and still ends inside it.
  crushed,  ///< The result holds, but movers left no free position: see `MoveResult::crushed`.
  out_of_range,  ///< Refused: the step would leave +-2e6 m. Position and velocity are unchanged.
  refused,       ///< Refused by the technique: see `MoveResult::refusal`. Position and velocity are unchanged.
  /// Refused: NaN, infinity, dt <= 0, a mover beyond +-2e6 m or with a speed that is not finite, fewer movers
  /// than the scenery has, an up that is no unit vector, scratch memory that another controller made, a
  /// filter or an up that another technique does not read. Nothing changed at all. A move never says this.
  invalid_input,
};

/// The report of one move. Its vectors grow: a report that is used again allocates no more once it has had the longest.
/// `octagon_sweep` reports everything. Other techniques leave out contacts and corners beyond these numbers.
struct MoveResult {
  static constexpr std::size_t max_corners = 64;
  static constexpr std::size_t max_contacts = 32;

  StepStatus status = StepStatus::moved;
  Vec2d position{Vec2d::Zero()};
  Vec2d velocity{Vec2d::Zero()};
  Vec2d technique_memory{Vec2d::Zero()};  ///< See `CharacterState::technique_memory`.
  bool grounded = false;
  Ground ground;
  std::string_view refusal{};  ///< The reason, in static memory. Valid where the status is `refused`.
  /// From the start (fraction 0) to the end (fraction 1); linear between. A technique that tests only the end of the
  /// move has just these two corners. Impacts bound the number of corners. The character's own motion has at most
  /// `SweepDef::iterations` impacts. Movers may add any number: `octagon_sweep` has room for 4 more corners per moving
  /// piece, and a step that needs more is `dropped`.
  std::vector<PathPoint> path;
  /// Bounded by the facets of all pieces that block.
  std::vector<Contact> contacts;
  Ride ride;  ///< For the next step. `velocity` above is in the world, the ride included.
  /// Colliders of movers that ran into the character when it had no room to give way; each once.
  std::vector<ColliderIndex> crushed;
  Crushers crushers;  ///< See `CharacterState::crushers`.

  /// Makes room for so many corners, contacts and crushers.
  void reserve(std::size_t count) {
    path.reserve(count);
    contacts.reserve(count);
    crushed.reserve(count);
  }
  void clear() noexcept {
    status = StepStatus::moved;
    technique_memory.setZero();
    grounded = false;
    ground.state = GroundState::air;
    path.clear();
    contacts.clear();
    ride = {};
    crushed.clear();
    crushers.clear();
  }
};

/// Whether a step was refused: nothing moved.
[[nodiscard]] inline bool is_refused(StepStatus status) noexcept {
  switch (status) {
    case StepStatus::moved:
    case StepStatus::dropped:
    case StepStatus::stuck:
    case StepStatus::crushed:
      return false;
    case StepStatus::out_of_range:
    case StepStatus::refused:
    case StepStatus::invalid_input:
      break;
  }
  return true;
}

/// The report of one step. `move` is valid unless the status is `invalid_input`.
struct StepReport {
  StepStatus status = StepStatus::moved;
  Vec2d requested{Vec2d::Zero()};  ///< Wanted displacement [m].
  double steered = 0;              ///< The part of `requested` across up that this step's steering added [m].
  MoveResult move;
  std::vector<SensorEvent> sensors;  ///< In order of time: see `SensorEvent`.
  /// One-way chains that the character passed against their normal, or missed by less than a micrometre, in a step
  /// whose input asked to drop. Each chain is listed once, in the order of the indices.
  std::vector<ColliderIndex> dropped_through;

  /// Keeps its memory.
  void clear() noexcept {
    status = StepStatus::moved;
    requested.setZero();
    steered = 0;
    move.clear();
    sensors.clear();
    dropped_through.clear();
  }
  /// Makes room for so many of each.
  void reserve(std::size_t count) {
    move.reserve(count);
    sensors.reserve(count);
    dropped_through.reserve(count);
  }
};

/// What a contact of one step is to the step before.
enum class ContactChange : std::uint8_t { added, persisted, removed };

/// Calls `visit(change, contact)` for each surface of two steps once, with its first contact: those of this step in
/// their order, then those that are `removed`, with their contact of the step before.
/// @param same whether two contacts are with one surface.
template <class AnyContact, class Same, class Visit>
void for_each_change(std::span<const AnyContact> before, std::span<const AnyContact> now, const Same& same,
                     const Visit& visit) {
  const auto is_in = [&](std::span<const AnyContact> contacts, const AnyContact& contact) {
    return std::ranges::any_of(contacts, [&](const AnyContact& other) { return same(other, contact); });
  };
  const auto visit_first_of = [&](std::span<const AnyContact> contacts, const auto& change_of) {
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (!is_in(contacts.first(i), contacts[i])) change_of(contacts[i]);
  };
  visit_first_of(now, [&](const AnyContact& contact) {
    visit(is_in(before, contact) ? ContactChange::persisted : ContactChange::added, contact);
  });
  visit_first_of(before, [&](const AnyContact& contact) {
    if (!is_in(now, contact)) visit(ContactChange::removed, contact);
  });
}

/// The same by collider. In a `Level` a collider that was replaced keeps its id and counts as the same surface; one
/// that was removed does not.
/// @param before the contacts of the step before: a copy of its `move.contacts`. @param now those of this step.
template <class Visit>
void for_each_change(std::span<const Contact> before, std::span<const Contact> now, const Visit& visit) {
  const auto same = [](const Contact& a, const Contact& b) { return a.collider == b.collider; };
  for_each_change(before, now, same, visit);
}

}  // namespace paperproof
