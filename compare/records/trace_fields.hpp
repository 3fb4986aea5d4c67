/// What a trace has of each thing, key by key. The writer and the reader go through the same lists.
///
/// `io.must(key, value)` is always written, `io.may(key, value)` where it says something, and `io.when(so, key, value)`
/// where that is so. A reader takes what is there: the schema has said what must be. `io.colliders` and `io.movers` are
/// what there is, in a header, and how everything goes that moves, in a step.
#pragma once

#include "records/trace.hpp"

#include <concepts>
#include <type_traits>

namespace paperproof::compare::detail {

/// A `T` that is written, or one that is read.
template <class One, class T>
concept A = std::same_as<std::remove_const_t<One>, T>;

/// A collider, or several: they stand by their ids.
template <class T>
struct Colliders {
  T& of;
};
template <class T>
Colliders(T&) -> Colliders<T>;

/// A character, or several: they stand by their numbers.
template <class T>
struct Characters {
  T& of;
};
template <class T>
Characters(T&) -> Characters<T>;

void fields(auto& io, A<Contact> auto& contact) {
  io.must("collider", Colliders{contact.collider});
  io.must("point", contact.point);
  io.must("normal", contact.normal);
  io.must("fraction", contact.fraction);
  io.must("separation", contact.separation);
  io.must("side", contact.side);
}

void fields(auto& io, A<CrowdContact> auto& contact) {
  io.must("character", Characters{contact.other});
  io.must("normal", contact.normal);
  io.must("fraction", contact.fraction);
  io.must("side", contact.side);
}

void fields(auto& io, A<SensorEvent> auto& event) {
  io.must("id", Colliders{event.sensor});
  io.must("change", event.change);
  io.must("fraction", event.fraction);
}

void fields(auto& io, A<Input> auto& input) {
  io.may("move", input.move);
  io.may("jump", input.jump);
  io.may("drop", input.drop);
}

void fields(auto& io, A<TraceRide> auto& ride) {
  io.may("character", Characters{ride.character});
  io.when(!ride.character, "collider", Colliders{ride.collider});
  io.must("velocity", ride.velocity);
}

void fields(auto& io, A<TraceState> auto& state) {
  io.must("velocity", state.velocity);
  io.may("grounded", state.grounded);
  io.may("jumping", state.jumping);
  io.may("jump_held", state.jump_held);
  io.may("jump_pending", state.jump_pending);
  io.may("ride", state.ride);
}

/// @param exact none: its path has all corners, as most have.
void fields(auto& io, A<TraceStep> auto& step, A<std::optional<bool>> auto& exact) {
  io.must("step", step.step);
  io.may("dt", step.dt);
  io.when(io.characters() > 1, "character", Characters{step.character});
  io.may("refused", step.refused);
  io.when(!step.refused.empty(), "input", step.input);
  if (!step.refused.empty()) return;
  io.may("turn", Characters{step.turn});
  io.may("moving", Characters{step.moving});
  io.must("path", step.path);
  io.may("path_exact", exact);
  io.must("input", step.input);
  io.may("up", step.up);
  io.may("gravity", step.gravity);
  io.must("requested", step.requested);
  io.must("steered", step.steered);
  io.must("velocity", step.velocity);
  io.must("grounded", step.grounded);
  io.must("jumping", step.jumping);
  io.may("ride", step.ride);
  io.may("ground_velocity", step.ground_velocity);
  io.must("start_overlap", Colliders{step.start_overlap});
  io.may("start_overlap_characters", Characters{step.start_overlap_characters});
  io.movers(step);
  io.must("contacts", step.contacts);
  io.may("met", step.met);
  io.may("crush", Colliders{step.crushed});
  io.may("drop", Colliders{step.dropped_through});
  io.may("sensors", step.sensors);
  io.may("remainder", step.remainder);
  io.may("respawn", step.respawn);
  io.may("stuck", step.stuck);
  io.may("dropped", step.dropped);
  io.may("capped", step.capped);
  io.may("from", step.from);
}

void fields(auto& io, A<CharacterDef> auto& character) {
  io.must("walk_speed", character.walk_speed);
  io.must("acceleration", character.acceleration);
  io.may("air_acceleration", character.air_acceleration);
  io.must("jump_speed", character.jump_speed);
  io.must("coyote_time", character.coyote_time);
  io.may("jump_buffer", character.jump_buffer);
  io.must("jump_cut", character.jump_cut);
  io.may("max_fall_speed", character.max_fall_speed);
  io.must("max_climb_degrees", character.max_climb_degrees);
  io.must("snap", character.snap);
  io.must("step_height", character.step_height);
  io.must("no_jump_toward_wall", character.no_jump_toward_wall);
  io.must("wall_reach", character.wall_reach);
  io.must("side_hit_ends_rise", character.side_hit_ends_rise);
}

void fields(auto& io, A<TraceStart> auto& start) {
  io.must("position", start.position);
  io.must("velocity", start.velocity);
}

template <class One>
requires A<One, MoverScript::Waypoint> || A<One, MoverScript::Turn>
void fields(auto& io, One& entry) {
  io.must("t", entry.time);
  io.must("at", entry.at);
}

void fields(auto& io, A<MoverScript> auto& script) {
  io.must("colliders", Colliders{script.colliders});
  io.must("path", script.path);
  io.must("loop", script.loop);
  io.may("turns", script.turns);
  io.may("body", script.body);
}

void fields(auto& io, A<Omission> auto& omission) {
  io.must("stage", omission.stage);
  io.must("reason", omission.reason);
}

void fields(auto& io, A<LevelPlan> auto& plan) {
  io.must("broad_phase", plan.search);
  io.must("omitted", plan.omitted);
}

void fields(auto& io, A<TraceHeader> auto& header) {
  int version = 1;
  double climb = header.character.max_climb_degrees;  // only shown: `character` has it
  io.must("paperproof_trace", version);
  io.must("scene", header.scene);
  io.must("contender", header.contender);
  io.must("scalar", header.scalar);
  io.may("knob", header.knob);
  io.must("mode", header.mode);
  io.must("dt", header.dt);
  io.may("steps", header.steps);
  io.when(header.characters > 1, "characters", header.characters);
  io.must("points", header.points);
  io.must("max_climb_degrees", climb);
  io.must("gravity", header.gravity);
  io.must("up", header.up);
  io.must("character", header.character);
  io.must("starts", header.starts);
  io.may("respawn_box", header.respawn_box);
  io.colliders(header);
  io.may("movers", header.scripts);
  io.when(header.substeps > 1, "substeps", header.substeps);
  io.must("guarantees", header.guarantees);
  io.may("box2d", header.box2d);
  io.may("plan", header.plan);
  io.may("tolerances", header.tolerances);
}

}  // namespace paperproof::compare::detail
