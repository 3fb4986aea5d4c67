#include "records/trace_reader.hpp"

#include "contains.hpp"
#include "embedded.hpp"
#include "records/collider_json.hpp"
#include "records/input_file.hpp"
#include "records/schema.hpp"
#include "records/trace_fields.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace paperproof::compare {
namespace {

using namespace detail;
using nlohmann::ordered_json;

/// What a value should have been, and where it stands, as a JSON pointer.
struct Unexpected {
  std::string words;
  std::string where{};

  [[nodiscard]] std::string what() const { return fmt::format("{}: {}", where.empty() ? "/" : where, words); }
};

/// @param where from the value that is read, as a JSON pointer; empty: that value.
[[noreturn]] void refuse(const std::string& expected, const std::string& where = "") {
  throw Unexpected{"expected " + expected, where};
}

/// What `look` refuses stands behind a key, or is the entry of a list.
template <class Key, class Look>
void behind(const Key& key, const Look& look) {
  try {
    look();
  } catch (Unexpected& unexpected) {
    unexpected.where.insert(0, fmt::format("/{}", key));
    throw;
  }
}

/// Reads the fields of an object that holds to the schema: see trace_fields.hpp. Refuses what a schema cannot say.
class FieldReader {
 public:
  /// @param header that is known so far.
  FieldReader(const ordered_json& object, const TraceHeader& header) : object_(object), header_(header) {}

  [[nodiscard]] std::size_t characters() const { return header_.characters; }

  template <class T>
  void must(const char* key, T&& value) const {
    if (const auto found = object_.find(key); found != object_.end()) behind(key, [&] { take(*found, value); });
  }
  template <class T>
  void may(const char* key, T&& value) const {
    must(key, value);
  }
  template <class T>
  void when(bool /*so*/, const char* key, T&& value) const {
    must(key, value);
  }
  /// They are read before the rest, which names them.
  static void colliders(TraceHeader& /*header*/) {}
  void movers(TraceStep& step) const {
    if (const auto found = object_.find("movers"); found != object_.end())
      behind("movers", [&] { take_movers(*found, step); });
  }

 private:
  template <class T>
  requires std::is_arithmetic_v<T> || std::same_as<T, std::string>
  static void take(const ordered_json& json, T& value) { json.get_to(value); }
  /// @param words that the schema lets stand there.
  template <class Name>
  static void take_word(const ordered_json& json, Name& name, std::initializer_list<Name> words) {
    for (const Name word : words)
      if (name_of(word) == json.get_ref<const std::string&>()) name = word;
  }
  static void take(const ordered_json& json, Side& side) {
    take_word(json, side, {Side::top, Side::bottom, Side::left, Side::right});
  }
  static void take(const ordered_json& json, SensorEvent::Change& change) {
    take_word(json, change, {SensorEvent::Change::enter, SensorEvent::Change::exit});
  }
  static void take(const ordered_json& json, MoverScript::Loop& loop) {
    using Loop = MoverScript::Loop;
    take_word(json, loop, {Loop::once, Loop::loop, Loop::ping_pong});
  }
  static void take(const ordered_json& json, Clause& clause) { clause = clause_named(json.get<std::string>()).value(); }
  static void take(const ordered_json& json, Vec2d& point) { point = point_of(json); }
  static void take(const ordered_json& json, Box2& box) { box = {point_of(json[0]), point_of(json[1])}; }
  static void take(const ordered_json& json, MoverMotion& motion) { motion = {point_of(json[0]), point_of(json[1])}; }
  static void take(const ordered_json& json, PathPoint& at) {
    at = {point_of(json), json[2].get<double>()};
    if (!(at.fraction >= 0 && at.fraction <= 1)) behind(2, [] { refuse("a number from 0 to 1"); });
  }
  /// It is only shown.
  static void take(const ordered_json& /*json*/, LevelPlan& /*plan*/) {}
  static void take(const ordered_json& json, std::vector<NamedTolerance>& tolerances) {
    for (const auto& [name, metres] : json.items()) tolerances.push_back({name, metres.get<double>()});
  }
  template <class T>
  void take(const ordered_json& json, std::optional<T>& value) const {
    take(json, value.emplace());
  }
  template <class T>
  void take(const ordered_json& json, std::vector<T>& list) const {
    for (std::size_t i = 0; i < json.size(); ++i) behind(i, [&] { take(json[i], list.emplace_back()); });
  }

  void take(const ordered_json& json, Colliders<ColliderIndex> collider) const {
    const auto found = std::ranges::find(header_.ids, json.get_ref<const std::string&>());
    if (found == header_.ids.end()) refuse("the id of a collider");
    collider.of = static_cast<ColliderIndex>(found - header_.ids.begin());
  }
  void take(const ordered_json& json, Characters<CharacterIndex> character) const {
    if (json.get<double>() < 0 || json.get<double>() >= static_cast<double>(header_.characters))
      refuse(fmt::format("a whole number from 0 to {}", header_.characters - 1));
    json.get_to(character.of);
  }
  void take(const ordered_json& json, Characters<std::optional<CharacterIndex>> character) const {
    take(json, Characters{character.of.emplace()});
  }
  template <template <class> class Kind>
  void take(const ordered_json& json, Kind<std::vector<std::uint32_t>> some) const {
    for (std::size_t i = 0; i < json.size(); ++i) behind(i, [&] { take(json[i], Kind{some.of.emplace_back()}); });
  }

  void take_movers(const ordered_json& json, TraceStep& step) const;
  void take_way(const ordered_json& json, ColliderIndex collider, TraceStep& step) const;

  template <class T>
  requires requires(FieldReader& io, T& object) { detail::fields(io, object); }
  void take(const ordered_json& json, T& object) const {
    FieldReader io(json, header_);
    detail::fields(io, object);
  }

  const ordered_json& object_;
  const TraceHeader& header_;
};

void FieldReader::take_way(const ordered_json& json, ColliderIndex collider, TraceStep& step) const {
  const ColliderDef& def = header_.scenery.colliders[collider];
  std::size_t count = def.points.size();
  for (const std::vector<Vec2d>& hole : def.holes) count += hole.size();
  VertexWay way{.collider = collider, .instants = json["k"], .vertices = {}};
  take(json["vertices"], way.vertices);
  if (way.instants.front() != 0 || way.instants.back() != 1 || !std::ranges::is_sorted(way.instants))
    refuse("fractions that ascend from 0 to 1", "/k");
  if (way.vertices.size() != way.instants.size()) refuse(fmt::format("a list of {}", way.instants.size()), "/vertices");
  for (std::size_t i = 0; i < way.vertices.size(); ++i)
    if (way.vertices[i].size() != count) refuse(fmt::format("{} points", count), fmt::format("/vertices/{}", i));
  step.vertex_ways.push_back(std::move(way));
}

/// What goes along with one mover goes as far.
void FieldReader::take_movers(const ordered_json& json, TraceStep& step) const {
  step.movers.resize(header_.scripts.size());
  std::set<ColliderIndex> seen;
  std::set<MoverIndex> known;
  for (const auto& [id, motion] : json.items())
    behind(id, [&, &id = id, &motion = motion] {
      const auto found = std::ranges::find(header_.ids, id);
      const auto collider = static_cast<ColliderIndex>(found - header_.ids.begin());
      const MoverIndex mover = found == header_.ids.end() ? no_mover : header_.scenery.colliders[collider].mover;
      if (mover == no_mover) refuse("a collider that moves");
      seen.insert(collider);
      MoverMotion own{Vec2d::Zero(), Vec2d::Zero()};
      if (motion.is_array()) {
        take(motion, own);
      } else {
        if (header_.turning.empty()) refuse("two offsets");
        take_way(motion, collider, step);
        FieldReader(motion, header_).may("offset", own);
      }
      const MoverMotion& other = step.movers[mover];
      if (!known.insert(mover).second && !same_motion(other, own)) refuse("the offset of what goes along with it");
      step.movers[mover] = own;
    });
  std::ranges::sort(step.vertex_ways, {}, &VertexWay::collider);
  for (ColliderIndex i = 0; i < header_.ids.size(); ++i)
    if (header_.scenery.colliders[i].mover != no_mover && !seen.contains(i))
      refuse("the motion of \"" + header_.ids[i] + "\"");
}

void check_up(const Vec2d& up) {
  if (!(std::abs(up.norm() - 1) <= 1e-9)) refuse("a vector of length 1", "/up");
}

void read_colliders(const ordered_json& colliders, TraceHeader& header) {
  std::set<std::string> seen;
  const auto there = [&](const char* key) { return fmt::format("/colliders/{}/{}", header.ids.size(), key); };
  for (const ordered_json& collider : colliders) {
    const std::string id = collider["id"];
    if (!seen.insert(id).second) refuse("an id of its own", there("id"));
    header.scenery.colliders.push_back(collider_of(collider));
    if (header.scenery.colliders.back().radius < 0) refuse("a radius from 0 on", there("circle"));
    header.ids.push_back(id);
  }
}

/// Which mover each collider goes with, and whether scripts are in order.
void settle_movers(TraceHeader& header) {
  const auto ascend = [](const auto& entries) {
    return std::ranges::adjacent_find(entries, [](const auto& a, const auto& b) { return !(a.time < b.time); }) ==
           entries.end();
  };
  for (MoverIndex mover = 0; mover < header.scripts.size(); ++mover) {
    const MoverScript& script = header.scripts[mover];
    const std::string there = fmt::format("/movers/{}", mover);
    if (!ascend(script.path)) refuse("times that ascend", there + "/path");
    if (!ascend(script.turns)) refuse("times that ascend", there + "/turns");
    for (const ColliderIndex collider : script.colliders) {
      MoverIndex& own = header.scenery.colliders[collider].mover;
      if (own != no_mover) refuse("colliders that no other mover has", there);
      own = mover;
    }
    header.turning.push_back(!script.turns.empty());
  }
  if (!contains(header.turning, true)) header.turning.clear();
}

/// What does not hold to the schema is refused. @param definition in it.
void hold_to_schema(const ordered_json& object, const std::string& definition) {
  static const Schema schema(trace_schema.front().text);
  if (const std::optional<std::string> fault = schema.fault(object, definition)) {
    const std::size_t colon = fault->find(": ");
    throw Unexpected{fault->substr(colon + 2), fault->substr(0, colon)};
  }
}

TraceHeader header_of(const ordered_json& object) {
  hold_to_schema(object, "header");
  TraceHeader header;
  read_colliders(object["colliders"], header);
  FieldReader io(object, header);
  detail::fields(io, header);
  if (header.starts.size() != header.characters) refuse("one start for each of the `characters`", "/starts");
  check_up(header.up);
  settle_movers(header);
  return header;
}

TraceStep step_of(const ordered_json& object, const TraceHeader& header, bool& path_exact) {
  hold_to_schema(object, "step");
  TraceStep step;
  std::optional<bool> exact;
  FieldReader io(object, header);
  detail::fields(io, step, exact);
  path_exact = exact.value_or(true);
  if (step.up) check_up(*step.up);
  std::ranges::sort(step.start_overlap);
  std::ranges::sort(step.start_overlap_characters);
  return step;
}

}  // namespace

TraceReader::TraceReader(const std::string& path) : path_(path) {
  if (const std::string why = why_not_regular(path); !why.empty()) throw InvalidTrace(path + ": " + why);
  stream_.open(path, std::ios::binary);
  std::string line;
  if (!stream_ || !read_line(line)) throw InvalidTrace(path + ": expected a trace");
  const auto object = ordered_json::parse(line, nullptr, false);
  if (!object.is_object() || !object.contains("paperproof_trace"))
    refuse("expected the header of a trace, with \"paperproof_trace\": 1");
  try {
    header_ = header_of(object);
  } catch (const Unexpected& unexpected) {
    refuse(unexpected.what());
  }
}

std::optional<TraceStep> TraceReader::next() {
  std::string line;
  if (!read_line(line)) return std::nullopt;
  const auto object = ordered_json::parse(line, nullptr, false);
  if (!object.is_object()) refuse("expected a record");
  try {
    bool path_exact = true;
    TraceStep step = step_of(object, header_, path_exact);
    // All of one run: the first says whether positions are exact.
    if (line_ == 2) header_.path_exact = path_exact;
    return step;
  } catch (const Unexpected& unexpected) {
    const auto step = object.find("step");
    const bool is_numbered = step != object.end() && step->is_number_unsigned();
    refuse(is_numbered ? fmt::format("step {}: {}", step->get<std::uint64_t>(), unexpected.what()) : unexpected.what());
  }
}

bool TraceReader::read_line(std::string& line) {
  line.clear();
  std::streambuf& from = *stream_.rdbuf();
  constexpr int no_more = std::ifstream::traits_type::eof();
  for (int c = from.sbumpc(); c != no_more; c = from.sbumpc()) {
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
