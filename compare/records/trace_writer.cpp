#include "records/trace_writer.hpp"

#include "records/collider_json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

std::string dumped(const ordered_json& value) {
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

ordered_json plan_json(const std::optional<LevelPlan>& plan) {
  ordered_json object = ordered_json::object();
  if (plan) object["broad_phase"] = name_of(plan->search);
  object["omitted"] = ordered_json::array();
  if (plan)
    for (const Omission& omission : plan->omitted)
      object["omitted"].push_back({{"stage", omission.stage}, {"reason", omission.reason}});
  return object;
}

ordered_json limits_json(const CharacterDef& character) {
  ordered_json object;
  object["walk_speed"] = character.walk_speed;
  object["acceleration"] = character.acceleration;
  if (character.air_acceleration) object["air_acceleration"] = *character.air_acceleration;
  object["jump_speed"] = character.jump_speed;
  object["coyote_time"] = character.coyote_time;
  if (character.jump_buffer) object["jump_buffer"] = *character.jump_buffer;
  object["jump_cut"] = character.jump_cut;
  if (character.max_fall_speed) object["max_fall_speed"] = *character.max_fall_speed;
  object["max_climb_degrees"] = character.max_climb_degrees;
  object["snap"] = character.snap;
  object["step_height"] = character.step_height;
  object["no_jump_toward_wall"] = character.no_jump_toward_wall;
  object["wall_reach"] = character.wall_reach;
  object["side_hit_ends_rise"] = character.side_hit_ends_rise;
  return object;
}

ordered_json script_json(const MoverScript& script, const std::vector<std::string>& ids) {
  ordered_json object{{"colliders", ordered_json::array()}, {"path", ordered_json::array()}};
  for (const ColliderIndex collider : script.colliders) object["colliders"].push_back(ids[collider]);
  for (const MoverScript::Waypoint& waypoint : script.path)
    object["path"].push_back({{"t", waypoint.time}, {"at", point_json(waypoint.at)}});
  object["loop"] = name_of(script.loop);
  for (const MoverScript::Turn& turn : script.turns) object["turns"].push_back({{"t", turn.time}, {"at", turn.at}});
  if (script.body) object["body"] = true;
  return object;
}

/// What was wanted, and what is promised.
void add_terms(const TraceHeader& header, ordered_json& object) {
  object["gravity"] = point_json(header.gravity);
  object["up"] = point_json(header.up);
  object["character"] = limits_json(header.character);
  object["starts"] = ordered_json::array();
  for (const TraceStart& start : header.starts)
    object["starts"].push_back({{"position", point_json(start.position)}, {"velocity", point_json(start.velocity)}});
  if (const auto& box = header.respawn_box) object["respawn_box"] = {point_json(box->lower), point_json(box->upper)};
  for (const MoverScript& script : header.scripts) object["movers"].push_back(script_json(script, header.ids));
  if (header.substeps > 1) object["substeps"] = header.substeps;
  object["guarantees"] = ordered_json::array();
  for (const Clause clause : header.guarantees) object["guarantees"].push_back(name_of(clause));
}

using Buffer = fmt::memory_buffer;

/// The shortest digits that read back to the same bits; a negative zero keeps its sign in every reader.
void put(Buffer& out, double value) {
  if (value == 0 && std::signbit(value))
    fmt::format_to(std::back_inserter(out), "-0.0");
  else
    fmt::format_to(std::back_inserter(out), "{}", value);
}

void put(Buffer& out, const Vec2d& v) {
  out.push_back('[');
  put(out, v.x());
  out.push_back(',');
  put(out, v.y());
  out.push_back(']');
}

void put_text(Buffer& out, std::string_view text);

void put_flags(Buffer& out, std::initializer_list<std::pair<std::string_view, bool>> flags) {
  for (const auto& [name, set] : flags)
    if (set) fmt::format_to(std::back_inserter(out), ",\"{}\":true", name);
}

void put_text(Buffer& out, std::string_view text) { out.append(text.data(), text.data() + text.size()); }

void put_path(Buffer& out, const std::vector<PathPoint>& path) {
  put_text(out, "\"path\":[");
  for (std::size_t i = 0; i < path.size(); ++i) {
    put_text(out, i == 0 ? "[" : ",[");
    put(out, path[i].position.x());
    out.push_back(',');
    put(out, path[i].position.y());
    out.push_back(',');
    put(out, path[i].fraction);
    out.push_back(']');
  }
  out.push_back(']');
}

void put_contact(Buffer& out, const Contact& contact, const std::vector<std::string>& ids) {
  put_text(out, "{\"collider\":");
  put_text(out, ids[contact.collider]);
  put_text(out, ",\"point\":");
  put(out, contact.point);
  put_text(out, ",\"normal\":");
  put(out, contact.normal);
  put_text(out, ",\"fraction\":");
  put(out, contact.fraction);
  put_text(out, ",\"separation\":");
  put(out, contact.separation);
  fmt::format_to(std::back_inserter(out), ",\"side\":\"{}\"}}", name_of(contact.side));
}

void put_met(Buffer& out, const std::vector<CrowdContact>& met) {
  put_text(out, ",\"met\":[");
  for (std::size_t i = 0; i < met.size(); ++i) {
    fmt::format_to(std::back_inserter(out), "{}{{\"character\":{},\"normal\":", i == 0 ? "" : ",", met[i].other);
    put(out, met[i].normal);
    put_text(out, ",\"fraction\":");
    put(out, met[i].fraction);
    fmt::format_to(std::back_inserter(out), ",\"side\":\"{}\"}}", name_of(met[i].side));
  }
  out.push_back(']');
}

template <class Items, class Put>
void put_list(Buffer& out, const Items& items, const Put& put_one) {
  out.push_back('[');
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) out.push_back(',');
    put_one(items[i]);
  }
  out.push_back(']');
}

/// Where a mover is when the step begins and ends.
void put_motion(Buffer& out, const MoverMotion& motion) {
  put_list(out, std::array{motion.from, motion.to}, [&](const Vec2d& offset) { put(out, offset); });
}

/// @param motion of its mover.
void put_way(Buffer& out, const VertexWay& way, const MoverMotion& motion) {
  put_text(out, "{\"k\":");
  put_list(out, way.instants, [&](double instant) { put(out, instant); });
  put_text(out, ",\"vertices\":");
  put_list(out, way.vertices, [&](const std::vector<Vec2d>& vertices) {
    put_list(out, vertices, [&](const Vec2d& vertex) { put(out, vertex); });
  });
  if (!motion.from.isZero(0) || !motion.to.isZero(0)) {
    put_text(out, ",\"offset\":");
    put_motion(out, motion);
  }
  out.push_back('}');
}

void put_ids(Buffer& out, const std::vector<ColliderIndex>& colliders, const std::vector<std::string>& ids) {
  put_list(out, colliders, [&](ColliderIndex collider) { put_text(out, ids[collider]); });
}

void put_sensors(Buffer& out, const std::vector<SensorEvent>& events, const std::vector<std::string>& ids) {
  put_text(out, ",\"sensors\":[");
  for (std::size_t i = 0; i < events.size(); ++i) {
    const bool enters = events[i].change == SensorEvent::Change::enter;
    put_text(out, i == 0 ? "{\"id\":" : ",{\"id\":");
    put_text(out, ids[events[i].sensor]);
    put_text(out, enters ? ",\"change\":\"enter\",\"fraction\":" : ",\"change\":\"exit\",\"fraction\":");
    put(out, events[i].fraction);
    out.push_back('}');
  }
  out.push_back(']');
}

void put_input(Buffer& out, const Input& input) {
  put_text(out, ",\"input\":{");
  std::string_view comma;
  if (input.move) {
    put_text(out, "\"move\":");
    put(out, *input.move);
    comma = ",";
  }
  for (const auto& [name, set] : {std::pair{"jump", input.jump}, {"drop", input.drop}}) {
    if (!set) continue;
    fmt::format_to(std::back_inserter(out), "{}\"{}\":true", comma, name);
    comma = ",";
  }
  out.push_back('}');
}

void put_ride(Buffer& out, const std::optional<TraceRide>& ride, const std::vector<std::string>& ids) {
  if (!ride) return;
  if (ride->character) {
    fmt::format_to(std::back_inserter(out), ",\"ride\":{{\"character\":{}", *ride->character);
  } else {
    put_text(out, ",\"ride\":{\"collider\":");
    put_text(out, ids[ride->collider]);
  }
  put_text(out, ",\"velocity\":");
  put(out, ride->velocity);
  out.push_back('}');
}

void put_state(Buffer& out, const TraceState& state, const std::vector<std::string>& ids) {
  put_text(out, ",\"from\":{\"velocity\":");
  put(out, state.velocity);
  put_flags(out, {{"grounded", state.grounded},
                  {"jumping", state.jumping},
                  {"jump_held", state.jump_held},
                  {"jump_pending", state.jump_pending}});
  put_ride(out, state.ride, ids);
  out.push_back('}');
}

}  // namespace

std::string trace_path(const std::string& stem, std::string scene, const std::string& contender,
                       std::string_view scalar) {
  for (char& c : scene)
    if (c == '/' || c == '\\' || c == '\0') c = '_';
  return fmt::format("{}.{}.{}.{}.jsonl", stem, scene, contender, scalar);
}

std::string twin_stem(const std::string& stem, std::string_view contender) {
  return fmt::format("{}.twin_of_{}", stem, contender);
}

ordered_json trace_header_json(const TraceHeader& header) {
  ordered_json object;
  object["paperproof_trace"] = 1;
  object["scene"] = header.scene;
  object["contender"] = header.contender;
  object["scalar"] = header.scalar;
  if (!header.knob.empty()) object["knob"] = header.knob;
  object["mode"] = header.mode;
  object["dt"] = header.dt;
  if (header.steps) object["steps"] = *header.steps;
  if (header.characters > 1) object["characters"] = header.characters;
  object["points"] = points_json(header.points);
  object["max_climb_degrees"] = header.character.max_climb_degrees;
  add_terms(header, object);
  object["colliders"] = ordered_json::array();
  for (std::size_t i = 0; i < header.ids.size(); ++i)
    object["colliders"].push_back(collider_json(header.ids[i], header.scenery.colliders[i]));
  if (!header.box2d.empty()) object["box2d"] = header.box2d;
  object["plan"] = plan_json(header.plan);
  for (const NamedTolerance& tolerance : header.tolerances) object["tolerances"][tolerance.name] = tolerance.metres;
  return object;
}

TraceLines::TraceLines(const TraceHeader& header) : path_exact_(header.path_exact), several_(header.characters > 1) {
  const std::vector<ColliderDef>& colliders = header.scenery.colliders;
  for (ColliderIndex i = 0; i < colliders.size(); ++i) {
    if (colliders[i].mover != no_mover) moving_.push_back({i, colliders[i].mover});
  }
  for (const std::string& id : header.ids) ids_.push_back(dumped(id));
}

std::string TraceLines::line_of(const TraceStep& step) const {
  Buffer out;
  fmt::format_to(std::back_inserter(out), "{{\"step\":{},", step.step);
  if (step.dt) {
    put_text(out, "\"dt\":");
    put(out, *step.dt);
    out.push_back(',');
  }
  if (several_) fmt::format_to(std::back_inserter(out), "\"character\":{},", step.character);
  if (!step.refused.empty()) {
    put_text(out, "\"refused\":");
    put_text(out, dumped(step.refused));
    put_input(out, step.input);
    put_text(out, "}\n");
    return fmt::to_string(out);
  }
  if (step.turn) fmt::format_to(std::back_inserter(out), "\"turn\":{},", *step.turn);
  put_path(out, step.path);
  if (!path_exact_) put_text(out, ",\"path_exact\":false");
  put_input(out, step.input);
  for (const auto& [key, own] : {std::pair{",\"up\":", step.up}, {",\"gravity\":", step.gravity}}) {
    if (!own) continue;
    put_text(out, key);
    put(out, *own);
  }
  put_text(out, ",\"requested\":");
  put(out, step.requested);
  put_text(out, ",\"steered\":");
  put(out, step.steered);
  put_text(out, ",\"velocity\":");
  put(out, step.velocity);
  fmt::format_to(std::back_inserter(out), ",\"grounded\":{},\"jumping\":{}", step.grounded, step.jumping);
  put_ride(out, step.ride, ids_);
  if (!step.ground_velocity.isZero(0)) {
    put_text(out, ",\"ground_velocity\":");
    put(out, step.ground_velocity);
  }
  put_text(out, ",\"start_overlap\":");
  put_ids(out, step.start_overlap, ids_);
  if (!step.start_overlap_characters.empty())
    fmt::format_to(std::back_inserter(out), ",\"start_overlap_characters\":[{}]",
                   fmt::join(step.start_overlap_characters, ","));
  put_text(out, ",\"movers\":{");
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    if (i > 0) out.push_back(',');
    put_text(out, ids_[moving_[i].collider]);
    out.push_back(':');
    if (const VertexWay* way = find_way(step.vertex_ways, moving_[i].collider))
      put_way(out, *way, step.movers[moving_[i].mover]);
    else
      put_motion(out, step.movers[moving_[i].mover]);
  }
  put_text(out, "},\"contacts\":[");
  for (std::size_t i = 0; i < step.contacts.size(); ++i) {
    if (i > 0) out.push_back(',');
    put_contact(out, step.contacts[i], ids_);
  }
  out.push_back(']');
  if (!step.met.empty()) put_met(out, step.met);
  if (!step.crushed.empty()) {
    put_text(out, ",\"crush\":");
    put_ids(out, step.crushed, ids_);
  }
  if (!step.dropped_through.empty()) {
    put_text(out, ",\"drop\":");
    put_ids(out, step.dropped_through, ids_);
  }
  if (!step.sensors.empty()) put_sensors(out, step.sensors, ids_);
  if (!step.remainder.isZero(0)) {
    put_text(out, ",\"remainder\":");
    put(out, step.remainder);
  }
  put_flags(out,
            {{"respawn", step.respawn}, {"stuck", step.stuck}, {"dropped", step.dropped}, {"capped", step.capped}});
  if (step.from) put_state(out, *step.from, ids_);
  put_text(out, "}\n");
  return fmt::to_string(out);
}

TraceWriter::TraceWriter(const std::string& path, const TraceHeader& header) : file_(path), lines_(header) {
  file_.write(dumped(trace_header_json(header)) + '\n');
}

}  // namespace paperproof::compare
