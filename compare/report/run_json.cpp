#include "report/run_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace paperproof::compare {
namespace {

constexpr double parts_of_one = 10'000;  ///< Fractions and normals are shown to four decimals.

std::int64_t in_parts(double number) { return std::isfinite(number) ? std::llround(number * parts_of_one) : 0; }

/// How far the edge between two vertices is turned when a step begins, and when it ends [rad].
/// @param ring as defined.
std::pair<double, double> angles_of(const std::vector<Vec2d>& ring, const VertexWay& way) {
  const auto turn = [](const Vec2d& a, const Vec2d& b) { return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)); };
  const auto edge = [](const std::vector<Vec2d>& vertices) -> Vec2d { return vertices[1] - vertices[0]; };
  const double from = turn(edge(ring), edge(way.vertices.front()));
  double to = from;
  for (std::size_t k = 1; k < way.vertices.size(); ++k) to += turn(edge(way.vertices[k - 1]), edge(way.vertices[k]));
  return {from, to};
}

/// Writes the steps of one run, column by column.
class Columns {
 public:
  Columns(const TraceHeader& header, const Quantum& quantum) : header_(header), quantum_(quantum) {}

  void add(const TraceStep& step) {
    steps_.add(step.step - last_step_);
    last_step_ = step.step;
    add_flags(step);
    add_path(step.path);
    add_velocity(step.velocity);
    add_contacts(step.contacts);
    add_met(step.met);
    add_remainder(step.remainder);
    add_colliders(overlaps_, step.start_overlap);
    add_colliders(crushed_, step.crushed);
    add_colliders(dropped_through_, step.dropped_through);
    add_movers(step.movers);
    add_turns(step);
    ++count_;
  }

  void write(JsonObject& run) && {
    run.put("step", std::move(steps_).take()).put("flags", json_string(flags_)).put("path", std::move(path_).take());
    run.put("velocity", std::move(velocity_).take()).put("contacts", std::move(contacts_).take());
    run.put("kinds", std::move(kinds_).take()).put("start_overlap", std::move(overlaps_).take());
    if (!met_.empty()) run.put("met", std::move(met_).take());
    if (!remainders_.empty()) run.put("remainder", std::move(remainders_).take());
    if (!crushed_.empty()) run.put("crush", std::move(crushed_).take());
    if (!dropped_through_.empty()) run.put("drop", std::move(dropped_through_).take());
    if (!places_.empty()) run.put("movers", std::move(movers_).take());
    if (turns_any_) run.put("turns", std::move(turns_).take());
  }

 private:
  using Kind = std::array<std::int64_t, 4>;
  /// Where a mover ended a step, and how it got there.
  struct Place {
    DisplayPoint at;
    DisplayPoint way;
  };

  void add_flags(const TraceStep& step) {
    const int bits = (step.grounded ? 1 : 0) | (step.jumping ? 2 : 0) | (step.respawn ? 4 : 0) | (step.stuck ? 8 : 0) |
                     (step.dropped ? 16 : 0) | (step.capped ? 32 : 0);
    flags_ += static_cast<char>('0' + bits);
  }

  void add_corner(const DisplayPoint& corner) {
    path_.add(corner.x - position_.x).add(corner.y - position_.y);
    position_ = corner;
  }

  void add_path(const std::vector<PathPoint>& path) {
    if (path.empty()) {
      path_.add(-1);
    } else if (path.size() == 2 && quantum_.round(path.front().position) == position_) {
      path_.add(0);
      add_corner(quantum_.round(path.back().position));
    } else {
      path_.add(static_cast<std::int64_t>(path.size()));
      for (const PathPoint& corner : path) {
        add_corner(quantum_.round(corner.position));
        path_.add(in_parts(corner.fraction));
      }
    }
  }

  void add_velocity(const Vec2d& velocity) {
    const DisplayPoint now{quantum_.round(velocity.x() / 10), quantum_.round(velocity.y() / 10)};
    velocity_.add(now.x - last_velocity_.x).add(now.y - last_velocity_.y);
    last_velocity_ = now;
  }

  std::size_t index_of(const Kind& kind) {
    const auto [entry, is_new] = known_kinds_.try_emplace(kind, known_kinds_.size());
    if (is_new) {
      for (const std::int64_t number : kind) kinds_.add(number);
      last_points_.push_back({});
    }
    return entry->second;
  }

  void add_contacts(const std::vector<Contact>& contacts) {
    contacts_.add(static_cast<std::int64_t>(contacts.size()));
    for (const Contact& contact : contacts) {
      const std::size_t kind = index_of({contact.collider, static_cast<std::int64_t>(contact.side),
                                         in_parts(contact.normal.x()), in_parts(contact.normal.y())});
      const DisplayPoint point = quantum_.round(contact.point);
      const DisplayPoint relative{point.x - position_.x, point.y - position_.y};
      DisplayPoint& last = last_points_[kind];
      contacts_.add(static_cast<std::int64_t>(kind)).add(relative.x - last.x).add(relative.y - last.y);
      contacts_.add(in_parts(contact.fraction)).add_short(contact.separation);
      last = relative;
    }
  }

  void add_met(const std::vector<CrowdContact>& met) {
    if (met.empty()) return;
    JsonArray list;
    for (const CrowdContact& contact : met) {
      list.add(contact.other).add(static_cast<std::int64_t>(contact.side));
      list.add(in_parts(contact.normal.x())).add(in_parts(contact.normal.y())).add(in_parts(contact.fraction));
    }
    met_.put(std::to_string(count_), std::move(list).take());
  }

  void add_remainder(const Vec2d& remainder) {
    if (remainder.isZero(0)) return;
    JsonArray pair;
    pair.add(quantum_.round(remainder.x())).add(quantum_.round(remainder.y()));
    remainders_.put(std::to_string(count_), std::move(pair).take());
  }

  void add_colliders(JsonObject& of_steps, const std::vector<ColliderIndex>& colliders) const {
    if (colliders.empty()) return;
    JsonArray list;
    for (const ColliderIndex collider : colliders) list.add(collider);
    of_steps.put(std::to_string(count_), std::move(list).take());
  }

  /// At a steady speed all numbers are 0 or, where it is no whole number of units, 1.
  void add_movers(const std::vector<MoverMotion>& movers) {
    if (count_ == 0) places_.resize(movers.size());
    const std::size_t known = std::min(places_.size(), movers.size());
    bool jumped = false;
    for (std::size_t i = 0; i < known; ++i) jumped = jumped || !(quantum_.round(movers[i].from) == places_[i].at);
    if (!places_.empty()) movers_.add(jumped ? 1 : 0);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      Place& place = places_[i];
      const DisplayPoint from = i < known ? quantum_.round(movers[i].from) : place.at;
      const DisplayPoint to = i < known ? quantum_.round(movers[i].to) : place.at;
      if (jumped) movers_.add(from.x - place.at.x).add(from.y - place.at.y);
      const DisplayPoint way{to.x - from.x, to.y - from.y};
      movers_.add(way.x - place.way.x).add(way.y - place.way.y);
      place = {to, way};
    }
  }

  /// What turns is drawn as it would be if it did so evenly: as far as the vertices of one of its colliders say.
  void add_turns(const TraceStep& step) {
    if (step.vertex_ways.empty()) return;
    turns_any_ = true;
    std::vector<std::pair<double, double>> angles(step.movers.size());
    for (const VertexWay& way : step.vertex_ways) {
      const ColliderDef& def = header_.scenery.colliders[way.collider];
      if (def.points.size() > 1) angles[def.mover] = angles_of(def.points, way);
    }
    for (const auto& [from, to] : angles) turns_.add(in_parts(from)).add(in_parts(to));
  }

  const TraceHeader& header_;
  const Quantum& quantum_;
  JsonArray steps_, path_, velocity_, contacts_, kinds_, movers_, turns_;
  bool turns_any_ = false;
  std::string flags_;
  JsonObject overlaps_, crushed_, dropped_through_, met_, remainders_;
  std::vector<Place> places_;
  std::map<Kind, std::size_t> known_kinds_;
  std::vector<DisplayPoint> last_points_;
  DisplayPoint position_, last_velocity_;
  std::int64_t last_step_ = 0;
  std::size_t count_ = 0;
};

bool is_finite(const TraceStep& step) {
  const auto moves = [](const MoverMotion& mover) { return mover.from.allFinite() && mover.to.allFinite(); };
  return step.velocity.allFinite() && step.remainder.allFinite() &&
         std::all_of(step.movers.begin(), step.movers.end(), moves) &&
         std::all_of(step.path.begin(), step.path.end(),
                     [](const PathPoint& corner) { return corner.position.allFinite(); });
}

/// Up to the first step on which a character is not.
std::size_t finite_steps(const ReportRun& run) {
  std::size_t count = 0;
  const auto all_finite = [&run](std::size_t i) {
    return is_finite(run.steps[i]) &&
           std::all_of(run.others.begin(), run.others.end(), [i](const auto& steps) { return is_finite(steps[i]); });
  };
  while (count < run.steps.size() && all_finite(count)) ++count;
  return count;
}

std::string_view word_for(ReportEvent::Kind kind) {
  switch (kind) {
    case ReportEvent::Kind::tunnel:
      return "tunnel";
    case ReportEvent::Kind::corner_cut:
      return "corner cut";
    case ReportEvent::Kind::inside:
      return "inside";
    case ReportEvent::Kind::one_way:
      return "one-way broken";
    case ReportEvent::Kind::crush:
      return "crush";
    case ReportEvent::Kind::drop:
      return "drop";
    case ReportEvent::Kind::sensor:
      return "sensor";
    case ReportEvent::Kind::note:
      return "note";
  }
  return "note";
}

std::string events_json(const std::vector<ReportEvent>& events) {
  JsonArray list;
  for (const ReportEvent& event : events) {
    JsonArray one;
    one.add(event.step).add_raw(json_string(word_for(event.kind))).add_raw(json_string(event.words));
    if (event.character != 0 || event.collider) one.add(event.character);
    if (event.collider) one.add(*event.collider);
    list.add_raw(std::move(one).take());
  }
  return std::move(list).take();
}

std::string hull_json(const std::vector<Vec2d>& points, const Quantum& quantum) {
  JsonArray hull;
  for (const Vec2d& point : points) hull.add(quantum.round(point.x())).add(quantum.round(point.y()));
  return std::move(hull).take();
}

void write_header(JsonObject& object, const ReportRun& run, const Quantum& quantum) {
  const TraceHeader& header = run.header;
  JsonArray omitted;
  if (header.plan)
    for (const Omission& omission : header.plan->omitted)
      omitted.add_raw(json_string(std::string(omission.stage) + ": " + std::string(omission.reason)));
  object.put("contender", json_string(header.contender)).put("scalar", json_string(header.scalar));
  if (!header.knob.empty()) object.put("knob", json_string(header.knob));
  object.put("mode", json_string(header.mode)).put("dt", short_number(header.dt, 6));
  object.put("box2d", json_string(header.box2d)).put("path_exact", header.path_exact ? "true" : "false");
  object.put("plan_omitted", std::move(omitted).take()).put("every", run.every);
  object.put("hull", hull_json(header.points, quantum)).put("events", events_json(run.events));
}

}  // namespace

std::string run_json(const ReportRun& run, std::size_t scenery, const Quantum& quantum) {
  JsonObject object;
  write_header(object, run, quantum);
  object.put("scenery", static_cast<std::int64_t>(scenery));
  const std::size_t shown = finite_steps(run);
  if (shown < run.steps.size()) object.put("not_finite_from", run.steps[shown].step);
  const auto write_columns = [&](const std::vector<TraceStep>& steps, JsonObject& into) {
    Columns columns(run.header, quantum);
    for (std::size_t i = 0; i < shown; ++i) columns.add(steps[i]);
    std::move(columns).write(into);
  };
  write_columns(run.steps, object);
  if (run.others.empty()) return std::move(object).take();
  JsonArray others;
  for (const std::vector<TraceStep>& steps : run.others) {
    JsonObject other;
    write_columns(steps, other);
    others.add_raw(std::move(other).take());
  }
  object.put("others", std::move(others).take());
  return std::move(object).take();
}

std::string plain_contacts_json(const std::vector<Contact>& contacts, const Quantum& quantum) {
  JsonArray list;
  for (const Contact& contact : contacts) {
    JsonArray numbers;
    numbers.add(contact.collider).add(static_cast<std::int64_t>(contact.side));
    numbers.add(quantum.round(contact.point.x())).add(quantum.round(contact.point.y()));
    numbers.add(in_parts(contact.normal.x())).add(in_parts(contact.normal.y()));
    numbers.add(in_parts(contact.fraction)).add_short(contact.separation);
    list.add_raw(std::move(numbers).take());
  }
  return std::move(list).take();
}

}  // namespace paperproof::compare
