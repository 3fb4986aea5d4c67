#include "records/trace_reader.hpp"

#include "records/input_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace paperproof::compare {
namespace {

using nlohmann::json;

/// What a value should have been; `TraceReader` adds file and line.
class Unexpected : public std::runtime_error {
 public:
  Unexpected(const std::string& where, std::string_view expected)
      : std::runtime_error(fmt::format("{}: expected {}", where.empty() ? "/" : where, expected)) {}
};

/// A value with its place in the line, as a JSON pointer.
class Value {
 public:
  Value(const json& value, std::string where) : value_(&value), where_(std::move(where)) {}

  [[noreturn]] void refuse(std::string_view expected) const { throw Unexpected(where_, expected); }

  [[nodiscard]] double number() const {
    if (!value_->is_number()) refuse("a number");
    const double number = value_->get<double>();
    if (!std::isfinite(number)) refuse("a finite number");
    return number;
  }
  [[nodiscard]] double number_from(double least) const {
    const double given = number();
    if (!(given >= least)) refuse(fmt::format("a number from {} on", least));
    return given;
  }
  [[nodiscard]] double share() const {
    const double given = number();
    if (!(given >= 0 && given <= 1)) refuse("a number from 0 to 1");
    return given;
  }
  /// @param end one more than the largest.
  [[nodiscard]] std::size_t index(std::size_t end) const {
    if (!value_->is_number_unsigned() || value_->get<std::size_t>() >= end)
      refuse(fmt::format("a whole number from 0 to {}", end - 1));
    return value_->get<std::size_t>();
  }
  /// A whole number that an `int` holds.
  [[nodiscard]] int count_from(int least) const {
    constexpr int most = std::numeric_limits<int>::max();
    if (!value_->is_number_unsigned() || value_->get<std::uint64_t>() < static_cast<std::uint64_t>(least) ||
        value_->get<std::uint64_t>() > std::uint64_t{most})
      refuse(fmt::format("a whole number from {} to {}", least, most));
    return value_->get<int>();
  }
  [[nodiscard]] bool flag() const {
    if (!value_->is_boolean()) refuse("true or false");
    return value_->get<bool>();
  }
  [[nodiscard]] std::string text() const {
    if (!value_->is_string()) refuse("a text");
    return value_->get<std::string>();
  }
  [[nodiscard]] Vec2d point() const {
    const std::vector<Value> items = list(2, 2);
    return {items[0].number(), items[1].number()};
  }
  [[nodiscard]] std::vector<Vec2d> points(std::size_t least) const {
    std::vector<Vec2d> items;
    for (const Value& point : list(least)) items.push_back(point.point());
    return items;
  }
  [[nodiscard]] std::vector<Value> list(std::size_t least = 0, std::size_t most = std::size_t(-1)) const {
    if (!value_->is_array() || value_->size() < least || value_->size() > most)
      refuse(most == least ? fmt::format("a list of {}", least)
             : least > 0   ? fmt::format("a list of {} or more", least)
                           : "a list");
    std::vector<Value> items;
    for (std::size_t i = 0; i < value_->size(); ++i) items.emplace_back((*value_)[i], fmt::format("{}/{}", where_, i));
    return items;
  }

  [[nodiscard]] Value require(const char* key) const {
    std::optional<Value> found = find(key);
    if (!found) throw Unexpected(where_ + "/" + key, "this key");
    return *found;
  }
  [[nodiscard]] std::optional<Value> find(const char* key) const {
    if (!value_->is_object()) refuse("an object");
    known_.push_back(key);
    return value_->contains(key) ? std::optional(at(key)) : std::nullopt;
  }
  /// An object must have no other keys than those that were asked for: one that is misspelt says nothing.
  void end() const {
    if (!value_->is_object()) refuse("an object");
    for (const auto& [key, value] : value_->items())
      if (std::find(known_.begin(), known_.end(), key) == known_.end()) at(key).refuse("no such key");
  }
  [[nodiscard]] bool is_object() const { return value_->is_object(); }
  /// Every key with its value.
  [[nodiscard]] std::vector<std::pair<std::string, Value>> entries() const {
    if (!value_->is_object()) refuse("an object");
    std::vector<std::pair<std::string, Value>> items;
    for (const auto& [key, value] : value_->items()) items.emplace_back(key, at(key));
    return items;
  }
  /// One of some words. @param words with what they mean.
  template <class T>
  [[nodiscard]] T one_of(std::initializer_list<std::pair<std::string_view, T>> words) const {
    const std::string word = text();
    std::string items;
    for (const auto& [name, meaning] : words) {
      if (name == word) return meaning;
      items += (items.empty() ? "" : ", ") + std::string(name);
    }
    refuse("one of " + items);
  }
  [[nodiscard]] bool is_set(const char* key) const {
    const std::optional<Value> value = find(key);
    return value && value->flag();
  }

 private:
  [[nodiscard]] Value at(const std::string& key) const { return {(*value_)[key], where_ + "/" + key}; }

  const json* value_;
  std::string where_;
  mutable std::vector<std::string_view> known_;  ///< Keys that were asked for.
};

ColliderIndex index_of(const Value& id, const std::vector<std::string>& ids) {
  const auto found = std::find(ids.begin(), ids.end(), id.text());
  if (found == ids.end()) id.refuse("the id of a collider");
  return static_cast<ColliderIndex>(found - ids.begin());
}

std::vector<ColliderIndex> colliders_in(const std::optional<Value>& list, const std::vector<std::string>& ids) {
  std::vector<ColliderIndex> items;
  if (!list) return items;
  for (const Value& id : list->list()) items.push_back(index_of(id, ids));
  return items;
}

ColliderDef read_collider(const Value& at) {
  ColliderDef def;
  const std::optional<Value> polygon = at.find("polygon");
  const std::optional<Value> chain = at.find("chain");
  const std::optional<Value> circle = at.find("circle");
  const std::optional<Value> holes = at.find("holes");
  if (polygon.has_value() + chain.has_value() + circle.has_value() != 1) at.refuse("one of polygon, chain and circle");
  if (polygon) {
    def.points = polygon->points(3);
    if (holes)
      for (const Value& hole : holes->list()) def.holes.push_back(hole.points(3));
  } else if (chain) {
    def.shape = ColliderDef::Shape::chain;
    def.points = chain->points(2);
  } else {
    const std::vector<Value> numbers = circle->list(3, 3);
    def.shape = ColliderDef::Shape::circle;
    def.points = {{numbers[0].number(), numbers[1].number()}};
    def.radius = numbers[2].number_from(0);
  }
  if (const auto normal = at.find("one_way")) def.one_way = normal->point();
  def.sensor = at.is_set("sensor");
  if (const auto speed = at.find("surface_speed")) def.surface_speed = speed->number();
  at.end();
  return def;
}

CharacterDef read_limits(const Value& at) {
  for (const char* key : {"walk_speed", "acceleration", "jump_speed"}) static_cast<void>(at.require(key));
  CharacterDef def;
  for (const auto& [key, limit] : {std::pair{"walk_speed", &def.walk_speed},
                                   {"acceleration", &def.acceleration},
                                   {"jump_speed", &def.jump_speed},
                                   {"coyote_time", &def.coyote_time},
                                   {"jump_cut", &def.jump_cut},
                                   {"max_climb_degrees", &def.max_climb_degrees},
                                   {"snap", &def.snap},
                                   {"step_height", &def.step_height},
                                   {"wall_reach", &def.wall_reach}})
    if (const auto value = at.find(key)) *limit = value->number_from(0);
  for (const auto& [key, limit] : {std::pair{"air_acceleration", &def.air_acceleration},
                                   {"jump_buffer", &def.jump_buffer},
                                   {"max_fall_speed", &def.max_fall_speed}})
    if (const auto value = at.find(key)) *limit = value->number_from(0);
  def.no_jump_toward_wall = at.is_set("no_jump_toward_wall");
  def.side_hit_ends_rise = at.is_set("side_hit_ends_rise");
  at.end();
  return def;
}

MoverScript read_script(const Value& at, const std::vector<std::string>& ids) {
  MoverScript script;
  script.colliders = colliders_in(at.require("colliders"), ids);
  if (script.colliders.empty()) at.require("colliders").refuse("a collider");
  for (const Value& waypoint : at.require("path").list(1)) {
    script.path.push_back({waypoint.require("t").number(), waypoint.require("at").point()});
    waypoint.end();
  }
  using Loop = MoverScript::Loop;
  script.loop =
      at.require("loop").one_of<Loop>({{"once", Loop::once}, {"loop", Loop::loop}, {"ping_pong", Loop::ping_pong}});
  if (const auto turns = at.find("turns"))
    for (const Value& turn : turns->list(1)) {
      script.turns.push_back({turn.require("t").number(), turn.require("at").number()});
      turn.end();
    }
  script.body = at.is_set("body");
  at.end();
  const auto ascend = [](const auto& entries) {
    return std::adjacent_find(entries.begin(), entries.end(),
                              [](const auto& a, const auto& b) { return !(a.time < b.time); }) == entries.end();
  };
  if (!ascend(script.path)) at.require("path").refuse("times that ascend");
  if (!ascend(script.turns)) at.require("turns").refuse("times that ascend");
  return script;
}

Vec2d read_up(const Value& at) {
  const Vec2d up = at.point();
  if (!(std::abs(up.norm() - 1) <= 1e-9)) at.refuse("a vector of length 1");
  return up;
}

/// The colliders, and which mover each goes with.
void read_scenery(const Value& at, TraceHeader& header) {
  for (const Value& collider : at.require("colliders").list()) {
    const std::string id = collider.require("id").text();
    if (std::find(header.ids.begin(), header.ids.end(), id) != header.ids.end())
      collider.require("id").refuse("an id of its own");
    header.ids.push_back(id);
    header.scenery.colliders.push_back(read_collider(collider));
  }
  const std::optional<Value> movers = at.find("movers");
  if (!movers) return;
  for (const Value& mover : movers->list()) {
    header.scripts.push_back(read_script(mover, header.ids));
    const auto number = static_cast<MoverIndex>(header.scripts.size() - 1);
    for (const ColliderIndex collider : header.scripts.back().colliders) {
      MoverIndex& own = header.scenery.colliders[collider].mover;
      if (own != no_mover) mover.refuse("colliders that no other mover has");
      own = number;
    }
    header.turning.push_back(!header.scripts.back().turns.empty());
  }
  if (std::find(header.turning.begin(), header.turning.end(), true) == header.turning.end()) header.turning.clear();
}

/// What a plan left out is only shown, and yet a misspelt key says nothing.
void check_plan(const Value& at) {
  if (const auto broad_phase = at.find("broad_phase")) static_cast<void>(broad_phase->text());
  for (const Value& omission : at.require("omitted").list()) {
    for (const char* key : {"stage", "reason"}) static_cast<void>(omission.require(key).text());
    omission.end();
  }
  at.end();
}

TraceHeader read_header(const Value& at) {
  if (at.require("paperproof_trace").number() != 1) at.require("paperproof_trace").refuse("1");
  TraceHeader header;
  header.scene = at.require("scene").text();
  header.contender = at.require("contender").text();
  header.scalar = at.require("scalar").one_of<std::string>({{"double", "double"}, {"float", "float"}});
  if (const auto knob = at.find("knob")) header.knob = knob->text();
  header.mode = at.require("mode").one_of<std::string>({{"free", "free"}, {"lockstep", "lockstep"}});
  header.dt = at.require("dt").number_from(0);
  if (const auto steps = at.find("steps")) header.steps = steps->count_from(1);
  if (const auto degrees = at.find("max_climb_degrees")) static_cast<void>(degrees->number());
  header.points = at.require("points").points(3);
  if (header.points.size() > CharacterShape::max_points) at.require("points").refuse("3 to 8 points");
  header.gravity = at.require("gravity").point();
  header.up = read_up(at.require("up"));
  header.character = read_limits(at.require("character"));
  for (const Value& start : at.require("starts").list(1)) {
    header.starts.push_back({start.require("position").point(), start.require("velocity").point()});
    start.end();
  }
  header.characters = header.starts.size();
  const auto characters = at.find("characters");
  if ((characters ? static_cast<std::size_t>(characters->count_from(2)) : 1) != header.characters)
    at.require("starts").refuse("one start for each of the `characters`");
  if (const auto box = at.find("respawn_box")) {
    const std::vector<Value> corners = box->list(2, 2);
    header.respawn_box = {corners[0].point(), corners[1].point()};
  }
  if (const auto substeps = at.find("substeps")) header.substeps = substeps->count_from(2);
  read_scenery(at, header);
  for (const Value& name : at.require("guarantees").list()) {
    const std::optional<Clause> clause = clause_named(name.text());
    if (!clause) name.refuse("the name of a clause");
    header.guarantees.push_back(*clause);
  }
  if (const auto version = at.find("box2d")) header.box2d = version->text();
  if (const auto plan = at.find("plan")) check_plan(*plan);
  if (const auto tolerances = at.find("tolerances"))
    for (const auto& [name, value] : tolerances->entries()) header.tolerances.push_back({name, value.number()});
  at.end();
  return header;
}

Side read_side(const Value& at) {
  return at.one_of<Side>({{"top", Side::top}, {"bottom", Side::bottom}, {"left", Side::left}, {"right", Side::right}});
}

std::optional<TraceRide> read_ride(const std::optional<Value>& at, const TraceHeader& header) {
  if (!at) return std::nullopt;
  TraceRide ride{.velocity = at->require("velocity").point()};
  if (const auto character = at->find("character"))
    ride.character = static_cast<CharacterIndex>(character->index(header.characters));
  else
    ride.collider = index_of(at->require("collider"), header.ids);
  at->end();
  return ride;
}

TraceState read_state(const Value& at, const TraceHeader& header) {
  TraceState state{.velocity = at.require("velocity").point(),
                   .grounded = at.is_set("grounded"),
                   .jumping = at.is_set("jumping"),
                   .jump_held = at.is_set("jump_held"),
                   .jump_pending = at.is_set("jump_pending"),
                   .ride = read_ride(at.find("ride"), header)};
  at.end();
  return state;
}

VertexWay read_way(const Value& at, ColliderIndex collider, const ColliderDef& def) {
  std::size_t count = def.points.size();
  for (const std::vector<Vec2d>& hole : def.holes) count += hole.size();
  VertexWay way{.collider = collider, .instants = {}, .vertices = {}};
  for (const Value& instant : at.require("k").list(2)) way.instants.push_back(instant.share());
  if (way.instants.front() != 0 || way.instants.back() != 1 ||
      !std::is_sorted(way.instants.begin(), way.instants.end()))
    at.require("k").refuse("fractions that ascend from 0 to 1");
  for (const Value& vertices : at.require("vertices").list(way.instants.size(), way.instants.size())) {
    way.vertices.push_back(vertices.points(count));
    if (way.vertices.back().size() != count) vertices.refuse(fmt::format("{} points", count));
  }
  return way;
}

/// Where everything is that moves: what goes along with one mover goes as far.
void read_movers(const Value& at, const TraceHeader& header, TraceStep& step) {
  step.movers.resize(header.scripts.size());
  std::set<ColliderIndex> seen;
  std::set<MoverIndex> known;
  for (const auto& [id, motion] : at.entries()) {
    const auto found = std::find(header.ids.begin(), header.ids.end(), id);
    const auto collider = static_cast<ColliderIndex>(found - header.ids.begin());
    const MoverIndex mover = found == header.ids.end() ? no_mover : header.scenery.colliders[collider].mover;
    if (mover == no_mover) motion.refuse("a collider that moves");
    seen.insert(collider);
    std::optional<Value> offset = motion;
    if (motion.is_object()) {
      if (header.turning.empty()) motion.refuse("two offsets");
      step.vertex_ways.push_back(read_way(motion, collider, header.scenery.colliders[collider]));
      offset = motion.find("offset");
      motion.end();
    }
    MoverMotion own{Vec2d::Zero(), Vec2d::Zero()};
    if (offset) {
      const std::vector<Value> ends = offset->list(2, 2);
      own = {ends[0].point(), ends[1].point()};
    }
    const MoverMotion& other = step.movers[mover];
    if (!known.insert(mover).second && (other.from != own.from || other.to != own.to))
      motion.refuse("the offset of what goes along with it");
    step.movers[mover] = own;
  }
  std::sort(step.vertex_ways.begin(), step.vertex_ways.end(),
            [](const VertexWay& a, const VertexWay& b) { return a.collider < b.collider; });
  for (ColliderIndex i = 0; i < header.ids.size(); ++i)
    if (header.scenery.colliders[i].mover != no_mover && !seen.contains(i))
      at.refuse("the motion of \"" + header.ids[i] + "\"");
}

void read_events(const Value& at, const TraceHeader& header, TraceStep& step) {
  if (const auto met = at.find("met"))
    for (const Value& one : met->list()) {
      CrowdContact contact;
      contact.other = static_cast<CharacterIndex>(one.require("character").index(header.characters));
      contact.normal = one.require("normal").point();
      contact.fraction = one.require("fraction").share();
      contact.side = read_side(one.require("side"));
      one.end();
      step.met.push_back(contact);
    }
  if (const auto sensors = at.find("sensors"))
    for (const Value& one : sensors->list()) {
      using Change = SensorEvent::Change;
      step.sensors.push_back({index_of(one.require("id"), header.ids),
                              one.require("change").one_of<Change>({{"enter", Change::enter}, {"exit", Change::exit}}),
                              one.require("fraction").share()});
      one.end();
    }
  for (const Value& one : at.require("contacts").list()) {
    step.contacts.push_back({.collider = index_of(one.require("collider"), header.ids),
                             .point = one.require("point").point(),
                             .normal = one.require("normal").point(),
                             .fraction = one.require("fraction").share(),
                             .separation = one.require("separation").number(),
                             .side = read_side(one.require("side"))});
    one.end();
  }
  step.crushed = colliders_in(at.find("crush"), header.ids);
  step.dropped_through = colliders_in(at.find("drop"), header.ids);
}

Input read_input(const Value& at) {
  Input input{.move = {}, .jump = at.is_set("jump"), .drop = at.is_set("drop")};
  if (const auto move = at.find("move")) input.move = move->number();
  at.end();
  return input;
}

/// @param path_exact as the record says.
TraceStep read_step(const Value& at, const TraceHeader& header, bool& path_exact) {
  TraceStep step;
  step.step = at.require("step").count_from(0);
  if (const auto dt = at.find("dt")) step.dt = dt->number();
  if (const auto character = at.find("character"))
    step.character = static_cast<CharacterIndex>(character->index(header.characters));
  step.input = read_input(at.require("input"));
  if (const auto reason = at.find("refused")) {
    step.refused = reason->text();
    if (step.refused.empty()) reason->refuse("a reason");
    at.end();
    return step;
  }
  if (const auto exact = at.find("path_exact")) path_exact = exact->flag();
  if (const auto turn = at.find("turn")) step.turn = static_cast<CharacterIndex>(turn->index(header.characters));
  for (const Value& corner : at.require("path").list(1)) {
    const std::vector<Value> numbers = corner.list(3, 3);
    step.path.push_back({{numbers[0].number(), numbers[1].number()}, numbers[2].share()});
  }
  if (const auto up = at.find("up")) step.up = read_up(*up);
  if (const auto gravity = at.find("gravity")) step.gravity = gravity->point();
  step.requested = at.require("requested").point();
  step.steered = at.require("steered").number();
  step.start_overlap = colliders_in(at.require("start_overlap"), header.ids);
  std::sort(step.start_overlap.begin(), step.start_overlap.end());
  if (const auto others = at.find("start_overlap_characters"))
    for (const Value& other : others->list())
      step.start_overlap_characters.push_back(static_cast<CharacterIndex>(other.index(header.characters)));
  std::sort(step.start_overlap_characters.begin(), step.start_overlap_characters.end());
  step.velocity = at.require("velocity").point();
  step.grounded = at.require("grounded").flag();
  step.jumping = at.is_set("jumping");
  step.ride = read_ride(at.find("ride"), header);
  if (const auto velocity = at.find("ground_velocity")) step.ground_velocity = velocity->point();
  read_movers(at.require("movers"), header, step);
  read_events(at, header, step);
  if (const auto remainder = at.find("remainder")) step.remainder = remainder->point();
  step.respawn = at.is_set("respawn");
  if (const auto from = at.find("from")) step.from = read_state(*from, header);
  step.stuck = at.is_set("stuck");
  step.dropped = at.is_set("dropped");
  step.capped = at.is_set("capped");
  at.end();
  return step;
}

}  // namespace

TraceReader::TraceReader(const std::string& path) : path_(path) {
  if (const std::string why = why_not_regular(path); !why.empty()) throw InvalidTrace(path + ": " + why);
  stream_.open(path, std::ios::binary);
  std::string line;
  if (!stream_ || !read_line(line)) throw InvalidTrace(path + ": expected a trace");
  const json object = json::parse(line, nullptr, false);
  if (!object.is_object() || !object.contains("paperproof_trace"))
    refuse("expected the header of a trace, with \"paperproof_trace\": 1");
  try {
    header_ = read_header({object, ""});
  } catch (const Unexpected& unexpected) {
    refuse(unexpected.what());
  }
}

std::optional<TraceStep> TraceReader::next() {
  std::string line;
  if (!read_line(line)) return std::nullopt;
  const json object = json::parse(line, nullptr, false);
  if (!object.is_object()) refuse("expected a record");
  try {
    bool path_exact = true;
    TraceStep step = read_step({object, ""}, header_, path_exact);
    // All of one run: the first says whether positions are exact.
    if (line_ == 2) header_.path_exact = path_exact;
    return step;
  } catch (const Unexpected& unexpected) {
    const auto step = object.find("step");
    const bool is_numbered = step != object.end() && step->is_number_unsigned();
    refuse(is_numbered ? fmt::format("step {}: {}", step->get<std::uint64_t>(), unexpected.what())
                       : std::string(unexpected.what()));
  }
}

bool TraceReader::read_line(std::string& line) {
  line.clear();
  for (int c = stream_.get(); c != std::ifstream::traits_type::eof(); c = stream_.get()) {
    if (c == '\n') {
      ++line_;
      return true;
    }
    line += static_cast<char>(c);
    if (line.size() > longest_line) refuse(fmt::format("expected lines of at most {} bytes", longest_line));
  }
  if (line.empty()) return false;
  ++line_;
  refuse("expected the line to end: the file is cut short");
}

void TraceReader::refuse(const std::string& what) const {
  throw InvalidTrace(fmt::format("{}:{}: {}", path_, line_, what));
}

}  // namespace paperproof::compare
