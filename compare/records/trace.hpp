/// What a run leaves behind: a header and one record per step, in double (every float is one exactly).
#pragma once

#include "records/clause.hpp"
#include "records/mover_script.hpp"
#include "records/vertex_way.hpp"

#include <paperproof/character.hpp>
#include <paperproof/report.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/step_context.hpp>
#include <paperproof/together.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// As a trace has it: `bottom`.
[[nodiscard]] constexpr std::string_view name_of(Side side) noexcept {
  constexpr std::array<std::string_view, 4> names{"top", "bottom", "left", "right"};
  static_assert(names.size() == static_cast<std::size_t>(Side::right) + 1);
  return names[static_cast<std::size_t>(side)];
}

[[nodiscard]] constexpr std::string_view name_of(SensorEvent::Change change) noexcept {
  return change == SensorEvent::Change::enter ? "enter" : "exit";
}

/// A tolerance by its name [m], printed with every result.
struct NamedTolerance {
  std::string name;
  double metres = 0;
};

/// Where and how fast a character begins.
struct TraceStart {
  Vec2d position{Vec2d::Zero()};  ///< [m]
  Vec2d velocity{Vec2d::Zero()};  ///< [m/s]
};

/// What carries a character after a step.
struct TraceRide {
  ColliderIndex collider = 0;     ///< Without meaning where another character carries it.
  Vec2d velocity{Vec2d::Zero()};  ///< Of its surface in this step, conveyor included; of a character its own [m/s].
  std::optional<CharacterIndex> character{};
};

/// The state with which a step begins that does not continue the one before.
struct TraceState {
  Vec2d velocity{Vec2d::Zero()};  ///< [m/s]
  bool grounded = false;
  bool jumping = false;
  bool jump_held = false;
  bool jump_pending = false;
  std::optional<TraceRide> ride{};
};

[[nodiscard]] constexpr std::string_view name_of(PieceSearch search) noexcept {
  constexpr std::array<std::string_view, 3> names{"grid", "one_by_one", "none"};
  static_assert(names.size() == static_cast<std::size_t>(PieceSearch::none) + 1);
  return names[static_cast<std::size_t>(search)];
}

/// Something that a level has no need of, and what follows from that. Both texts are static.
struct Omission {
  std::string_view stage;
  std::string_view reason;
};

/// What a level has no need of. Each of it is left out, and the steps are the same bits.
struct LevelPlan {
  PieceSearch search = PieceSearch::grid;
  std::vector<Omission> omitted{};
};

struct TraceHeader {
  std::string scene;
  std::string contender;
  std::string scalar;          ///< "double" or "float"
  std::string knob;            ///< As in a `Row`.
  std::string mode = "free";   ///< "free" or "lockstep"
  double dt = 0;               ///< [s]; where the steps have lengths of their own it is only shown.
  std::optional<int> steps{};  ///< That the run was to have; none: unknown, as in lockstep, which ends with a twin's.
  std::size_t characters = 1;  ///< Each has one record in every step, in order.
  std::vector<Vec2d> points;   ///< Hull of the character, relative to its position [m], as run.
  /// How the character wants to move, jumping rules in force included. Its shape is `points`.
  CharacterDef character{};
  Vec2d gravity{Vec2d::Zero()};        ///< [m/s²]
  Vec2d up{Vec2d::UnitY()};            ///< Unit vector: the character falls against it.
  std::vector<TraceStart> starts{};    ///< One for each character.
  std::vector<MoverScript> scripts{};  ///< By mover: where the scene says that it is.
  std::optional<Box2> respawn_box{};   ///< Maps only: see `Scene::respawn_box`.
  int substeps = 1;                    ///< Into how many shorter steps the contender divides each.
  std::vector<Clause> guarantees{};    ///< What the contender promises. Empty: nothing.
  SceneryDef scenery;                  ///< As run, world metres.
  /// So many of the last colliders are the bodies of characters, and as many of the last movers theirs: only where a
  /// turn of one of them is judged.
  std::size_t bodies = 0;
  [[nodiscard]] bool is_body(ColliderIndex collider) const { return collider + bodies >= scenery.colliders.size(); }
  std::vector<std::string> ids;   ///< One per collider.
  std::vector<bool> turning;      ///< By mover; empty where none turns.
  std::string box2d;              ///< Version of the Box2D in use.
  std::optional<LevelPlan> plan;  ///< None for Box2D, which has none.
  std::vector<NamedTolerance> tolerances;
  /// Box2D only: `path` holds sampled positions, and cuts under 20 mm are counted apart.
  bool path_exact = true;
};

struct TraceStep {
  int step = 0;
  std::optional<double> dt{};  ///< Its own length [s], where the scene gives each step one.
  CharacterIndex character = 0;
  /// Its place in the order of this step, from 0 on: while one moves the others stand. None: all move at once.
  std::optional<CharacterIndex> turn{};
  /// With `turn`: the others that went along their ways in it. All others stood.
  std::vector<CharacterIndex> moving{};
  Input input{};
  std::optional<Vec2d> up{};       ///< In this step, where it is not the header's.
  std::optional<Vec2d> gravity{};  ///< The same [m/s²].
  std::vector<PathPoint> path;     ///< From the start (fraction 0) to the end (1).
  /// Displacement that was wanted [m], in the world: what carries the character is included.
  Vec2d requested{Vec2d::Zero()};
  double steered = 0;             ///< The part of `requested.x()` that this step's steering added [m].
  Vec2d velocity{Vec2d::Zero()};  ///< At the end [m/s].
  /// From where the way ends to where the character is drawn [m]: see `CharacterState::remainder`.
  Vec2d remainder{Vec2d::Zero()};
  bool grounded = false;
  bool jumping = false;
  std::optional<TraceRide> ride{};
  Vec2d ground_velocity{Vec2d::Zero()};      ///< Of the surface that the character stands on at the end [m/s].
  std::vector<ColliderIndex> start_overlap;  ///< What the octagon overlapped when the step began, exactly.
  std::vector<Contact> contacts;
  std::vector<CharacterIndex> start_overlap_characters;  ///< Which it overlapped when the step began, exactly.
  std::vector<CrowdContact> met;                         ///< Contacts with other characters.
  /// One for each mover of the scenery; of one that turns the offset of the point that it turns about.
  std::vector<MoverMotion> movers;
  std::vector<VertexWay> vertex_ways;  ///< Of each collider that goes with a mover that turns, in order.
  std::vector<ColliderIndex> crushed;  ///< Colliders of movers that left the character no room, as reported.
  std::vector<SensorEvent> sensors;    ///< In order of time, as reported.
  /// One-way chains that were passed against their normal on purpose, as reported: the input asked to drop.
  std::vector<ColliderIndex> dropped_through{};
  bool respawn = false;  ///< The character was put back at the start, or placed elsewhere, before this step.
  std::optional<TraceState> from{};  ///< With `respawn`, where the character does not begin at rest in the air.
  std::string refused{};             ///< Why the step was refused; nothing but the input is valid then.
  bool stuck = false;                ///< The contender reported that it is stuck inside something.
  bool dropped = false;              ///< Displacement was left when the iterations ran out.
  /// The wanted way is longer than the contender's maker documents as the most in a step: 2 m of Box2D.
  bool capped = false;
};

/// Unit vector against which a character falls in a step.
[[nodiscard]] inline Vec2d up_in(const TraceStep& step, const TraceHeader& header) {
  return step.up.value_or(header.up);
}

/// Of a step [m/s²].
[[nodiscard]] inline Vec2d gravity_in(const TraceStep& step, const TraceHeader& header) {
  return step.gravity.value_or(header.gravity);
}

/// Whether two offsets go alike; their angles are not asked for.
[[nodiscard]] inline bool same_motion(const MoverMotion& a, const MoverMotion& b) {
  return a.from == b.from && a.to == b.to;
}

/// Only what Box2D moves is cut short; who promises something, or tells its whole way, has no cap.
[[nodiscard]] inline bool is_capped(const TraceStep& step, const TraceHeader& header) {
  return step.capped && !header.path_exact && header.guarantees.empty();
}

/// How long a step was [s].
[[nodiscard]] inline double length_of(const TraceStep& step, const TraceHeader& header) {
  return step.dt.value_or(header.dt);
}

}  // namespace paperproof::compare
