#include "records/trace_writer.hpp"

#include "records/collider_json.hpp"
#include "records/trace_fields.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <iterator>

namespace paperproof::compare {
namespace {

using namespace detail;
using nlohmann::ordered_json;

std::string dumped(const ordered_json& value) {
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// Whether a field is written that may be left out.
template <class T>
bool says_something(const T& value) {
  if constexpr (requires { value.of; })
    return says_something(value.of);
  else if constexpr (requires { value.isZero(0); })
    return !value.isZero(0);
  else if constexpr (requires { value.empty(); })
    return !value.empty();
  else
    return static_cast<bool>(value);
}

using Buffer = fmt::memory_buffer;

/// Writes fields behind each other: see trace_fields.hpp.
class FieldWriter {
 public:
  /// An object with its fields in a line. @param colliders of the header, as JSON.
  template <class Put>
  static std::string line(const Put& put_fields, const TraceLines& lines, std::string_view colliders = {}) {
    Buffer out;
    FieldWriter(out, lines, colliders).put_object(put_fields);
    out.push_back('\n');
    return fmt::to_string(out);
  }

  [[nodiscard]] std::size_t characters() const { return lines_.characters(); }

  template <class T>
  void must(std::string_view key, const T& value) {
    must_text(key, "");
    put(value);
  }
  template <class T>
  void may(std::string_view key, const T& value) {
    if (says_something(value)) must(key, value);
  }
  template <class T>
  void when(bool so, std::string_view key, const T& value) {
    if (so) must(key, value);
  }
  void colliders(const TraceHeader& /*header*/) { must_text("colliders", colliders_); }
  void movers(const TraceStep& step) {
    must_text("movers", "");
    put_object([&](FieldWriter& io) {
      for (const TraceLines::Moving& moving : lines_.moving())
        io.put_motion(moving, find_way(step.vertex_ways, moving.collider), step.movers[moving.mover]);
    });
  }

 private:
  FieldWriter(Buffer& out, const TraceLines& lines, std::string_view colliders)
      : out_(out), lines_(lines), colliders_(colliders) {}

  void must_text(std::string_view key, std::string_view json) {
    next();
    fmt::format_to(std::back_inserter(out_), "\"{}\":{}", key, json);
  }
  void next() {
    if (!is_first_) out_.push_back(',');
    is_first_ = false;
  }
  void put_text(std::string_view text) { out_.append(text.data(), text.data() + text.size()); }
  template <class Items, class As = std::identity>
  void put_list(const Items& items, As as = {}) {
    out_.push_back('[');
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (i > 0) out_.push_back(',');
      put(as(items[i]));
    }
    out_.push_back(']');
  }

  void put(bool value) { put_text(value ? "true" : "false"); }
  template <std::integral Number>
  void put(Number value) {
    fmt::format_to(std::back_inserter(out_), "{}", value);
  }
  /// The shortest digits that read back to the same bits; a negative zero keeps its sign in every reader.
  void put(double value) {
    if (value == 0 && std::signbit(value))
      put_text("-0.0");
    else
      fmt::format_to(std::back_inserter(out_), "{}", value);
  }
  void put(std::string_view text) { put_text(dumped(text)); }
  void put(const std::string& text) { put(std::string_view(text)); }
  template <class Name>
  requires std::is_enum_v<Name>
  void put(Name name) { fmt::format_to(std::back_inserter(out_), "\"{}\"", name_of(name)); }
  void put(const Vec2d& v) { put_list(std::array{v.x(), v.y()}); }
  void put(const PathPoint& at) { put_list(std::array{at.position.x(), at.position.y(), at.fraction}); }
  void put(const Box2& box) { put_list(std::array{box.lower, box.upper}); }
  void put(const MoverMotion& motion) { put_list(std::array{motion.from, motion.to}); }
  template <class T>
  void put(const std::optional<T>& value) {
    put(*value);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    put_list(list);
  }
  void put(const std::vector<NamedTolerance>& tolerances) {
    put_object([&](FieldWriter& io) {
      for (const NamedTolerance& tolerance : tolerances) io.must(tolerance.name, tolerance.metres);
    });
  }

  void put(Colliders<const ColliderIndex> collider) { put_text(lines_.id(collider.of)); }
  void put(Colliders<const std::vector<ColliderIndex>> colliders) {
    put_list(colliders.of, [](const ColliderIndex& collider) { return Colliders{collider}; });
  }
  template <class T>
  void put(const Characters<T>& characters) {
    put(characters.of);
  }

  /// @param way null where it does not turn.
  void put_motion(const TraceLines::Moving& moving, const VertexWay* way, const MoverMotion& motion) {
    next();
    put(Colliders{moving.collider});
    out_.push_back(':');
    if (way == nullptr) return put(motion);
    put_object([&](FieldWriter& io) {
      io.must("k", way->instants);
      io.must("vertices", way->vertices);
      io.when(!motion.from.isZero(0) || !motion.to.isZero(0), "offset", motion);
    });
  }

  template <class T>
  requires std::is_class_v<T>
  void put(const T& object) {
    put_object([&](FieldWriter& io) { detail::fields(io, object); });
  }
  template <class Put>
  void put_object(const Put& put_fields) {
    out_.push_back('{');
    FieldWriter inner(out_, lines_, colliders_);
    put_fields(inner);
    out_.push_back('}');
  }

  Buffer& out_;
  const TraceLines& lines_;
  std::string_view colliders_;
  bool is_first_ = true;
};

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

std::string colliders_in_json(const TraceHeader& header) {
  ordered_json colliders = ordered_json::array();
  for (std::size_t i = 0; i < header.ids.size(); ++i)
    colliders.push_back(collider_json(header.ids[i], header.scenery.colliders[i]));
  return dumped(colliders);
}

ordered_json trace_header_json(const TraceHeader& header) {
  return ordered_json::parse(TraceLines(header).header_line(header, colliders_in_json(header)));
}

TraceLines::TraceLines(const TraceHeader& header) : characters_(header.characters) {
  if (!header.path_exact) exact_ = false;
  const std::vector<ColliderDef>& colliders = header.scenery.colliders;
  for (ColliderIndex i = 0; i < colliders.size(); ++i)
    if (colliders[i].mover != no_mover) moving_.push_back({i, colliders[i].mover});
  for (const std::string& id : header.ids) ids_.push_back(dumped(id));
}

std::string TraceLines::header_line(const TraceHeader& header, std::string_view colliders) const {
  return FieldWriter::line([&](FieldWriter& io) { detail::fields(io, header); }, *this, colliders);
}

std::string TraceLines::line_of(const TraceStep& step) const {
  return FieldWriter::line([&](FieldWriter& io) { detail::fields(io, step, exact_); }, *this);
}

TraceWriter::TraceWriter(const std::string& path, const TraceHeader& header) : file_(path), lines_(header) {
  file_.write(lines_.header_line(header, colliders_in_json(header)));
}

}  // namespace paperproof::compare
