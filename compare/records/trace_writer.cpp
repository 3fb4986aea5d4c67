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

ordered_json plan_json(const std::optional<Plan>& plan) {
  ordered_json object = ordered_json::object();
  if (plan) object["broad_phase"] = paperproof::name_of(plan->broad_phase);
  object["omitted"] = ordered_json::array();
  if (plan)
    for (const Omission& omission : plan->omitted)
      object["omitted"].push_back({{"stage", paperproof::name_of(omission.stage)}, {"reason", omission.reason}});
  return object;
}

ordered_json header_json(const TraceHeader& header) {
  ordered_json object;
  object["paperproof_trace"] = 1;
  object["scene"] = header.scene;
  object["contender"] = header.contender;
  object["scalar"] = header.scalar;
  if (!header.knob.empty()) object["knob"] = header.knob;
  object["mode"] = header.mode;
  object["dt"] = header.dt;
  if (header.characters > 1) object["characters"] = header.characters;
  object["points"] = points_json(header.points);
  if (!std::isnan(header.max_climb_degrees)) object["max_climb_degrees"] = header.max_climb_degrees;
  object["colliders"] = ordered_json::array();
  for (std::size_t i = 0; i < header.ids.size(); ++i)
    object["colliders"].push_back(collider_json(header.ids[i], header.scenery.colliders[i]));
  if (!header.box2d.empty()) object["box2d"] = header.box2d;
  object["plan"] = plan_json(header.plan);
  for (const NamedTolerance& tolerance : header.tolerances) object["tolerances"][tolerance.name] = tolerance.metres;
  return object;
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

void put_text(Buffer& out, std::string_view text) { out.append(text.data(), text.data() + text.size()); }

void put_path(Buffer& out, const std::vector<PathPoint<double>>& path) {
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

void put_contact(Buffer& out, const Contact<double>& contact, const std::vector<std::string>& ids) {
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

void put_met(Buffer& out, const std::vector<CrowdContact<double>>& met) {
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
void put_motion(Buffer& out, const MoverMotion<double>& motion) {
  put_list(out, std::array{motion.from, motion.to}, [&](const Vec2d& offset) { put(out, offset); });
}

void put_way(Buffer& out, const VertexWay& way) {
  put_text(out, "{\"k\":");
  put_list(out, way.instants, [&](double instant) { put(out, instant); });
  put_text(out, ",\"vertices\":");
  put_list(out, way.vertices, [&](const std::vector<Vec2d>& vertices) {
    put_list(out, vertices, [&](const Vec2d& vertex) { put(out, vertex); });
  });
  out.push_back('}');
}

void put_ids(Buffer& out, const std::vector<ColliderIndex>& colliders, const std::vector<std::string>& ids) {
  put_list(out, colliders, [&](ColliderIndex collider) { put_text(out, ids[collider]); });
}

void put_sensors(Buffer& out, const std::vector<SensorEvent<double>>& events, const std::vector<std::string>& ids) {
  put_text(out, ",\"sensors\":[");
  for (std::size_t i = 0; i < events.size(); ++i) {
    const bool enters = events[i].change == SensorEvent<double>::Change::enter;
    put_text(out, i == 0 ? "{\"id\":" : ",{\"id\":");
    put_text(out, ids[events[i].sensor]);
    put_text(out, enters ? ",\"change\":\"enter\",\"fraction\":" : ",\"change\":\"exit\",\"fraction\":");
    put(out, events[i].fraction);
    out.push_back('}');
  }
  out.push_back(']');
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

TraceWriter::TraceWriter(const std::string& path, const TraceHeader& header)
    : file_(path), path_exact_(header.path_exact), several_(header.characters > 1) {
  const std::vector<ColliderDef>& colliders = header.scenery.colliders;
  for (ColliderIndex i = 0; i < colliders.size(); ++i) {
    if (colliders[i].mover != no_mover) moving_.push_back({i, colliders[i].mover});
  }
  for (const std::string& id : header.ids)
    ids_.push_back(ordered_json(id).dump(-1, ' ', false, ordered_json::error_handler_t::replace));
  file_.write(header_json(header).dump(-1, ' ', false, ordered_json::error_handler_t::replace) + '\n');
}

void TraceWriter::write(const TraceStep& step) {
  Buffer out;
  fmt::format_to(std::back_inserter(out), "{{\"step\":{},", step.step);
  if (step.dt) {
    put_text(out, "\"dt\":");
    put(out, *step.dt);
    out.push_back(',');
  }
  if (several_) fmt::format_to(std::back_inserter(out), "\"character\":{},", step.character);
  put_path(out, step.path);
  if (!path_exact_) put_text(out, ",\"path_exact\":false");
  put_text(out, ",\"requested\":");
  put(out, step.requested);
  put_text(out, ",\"steered\":");
  put(out, step.steered);
  put_text(out, ",\"velocity\":");
  put(out, step.velocity);
  fmt::format_to(std::back_inserter(out), ",\"grounded\":{},\"start_overlap\":", step.grounded);
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
      put_way(out, *way);
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
  for (const auto& [name, set] :
       {std::pair{"respawn", step.respawn}, {"stuck", step.stuck}, {"dropped", step.dropped}, {"capped", step.capped}})
    if (set) fmt::format_to(std::back_inserter(out), ",\"{}\":true", name);
  put_text(out, "}\n");
  file_.write({out.data(), out.size()});
}

}  // namespace paperproof::compare
