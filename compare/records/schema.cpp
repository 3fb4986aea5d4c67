#include "records/schema.hpp"

#include "near_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

namespace paperproof::compare {
namespace {

using Json = nlohmann::ordered_json;

/// As it stands in a file, shortened.
std::string shown_value(const Json& value) {
  constexpr std::size_t longest = 60;
  return shortened(value.dump(-1, ' ', false, Json::error_handler_t::replace), longest);
}

bool is_whole(const Json& value) {
  if (value.is_number_integer()) return true;
  // Beyond this every double is whole, and no count is meant.
  constexpr double largest = 9007199254740992;
  return value.is_number_float() && std::abs(value.get<double>()) <= largest &&
         std::floor(value.get<double>()) == value.get<double>();
}

bool is_of_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "number") return value.is_number();
  return is_whole(value);
}

const std::map<std::string, std::string>& type_words() {
  static const std::map<std::string, std::string> words{{"object", "an object"}, {"array", "a list"},
                                                        {"string", "a text"},    {"boolean", "true or false"},
                                                        {"number", "a number"},  {"integer", "a whole number"}};
  return words;
}

const std::set<std::string>& known_keywords() {
  static const std::set<std::string> keywords{
      "$schema", "title", "description",          "$defs",    "$ref",     "type",     "enum",      "const", "minimum",
      "pattern", "items", "additionalProperties", "required", "minItems", "maxItems", "properties"};
  return keywords;
}

/// Asks for nothing.
const Json nothing = Json::object();

const Json& part_of(const Json& schema, const char* keyword, const Json& otherwise) {
  const auto found = schema.find(keyword);
  return found == schema.end() ? otherwise : *found;
}

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

}  // namespace

Schema::Schema(std::string_view text) : root_(Json::parse(text)) { prepare(root_); }

void Schema::prepare(const Json& schema) {
  for (const auto& [keyword, value] : schema.items()) {
    if (!known_keywords().contains(keyword)) throw std::logic_error("a schema asks by an unknown keyword: " + keyword);
    if (keyword == "type" && !type_words().contains(value.get<std::string>()))
      throw std::logic_error("a schema asks for an unknown type: " + value.dump());
    if (keyword == "pattern") patterns_.emplace(value.get<std::string>(), value.get<std::string>());
    if (keyword == "properties" || keyword == "$defs")
      for (const auto& [name, inner] : value.items()) prepare(inner);
    if ((keyword == "items" || keyword == "additionalProperties") && value.is_object()) prepare(value);
    if (keyword == "$ref") static_cast<void>(resolved(schema));
  }
}

const Json& Schema::resolved(const Json& schema) const {
  if (!schema.contains("$ref")) return schema;
  return root_.at(Pointer(schema["$ref"].get<std::string>().substr(1)));  // behind the #
}

std::optional<std::string> Schema::fault(const Json& value, const std::string& definition) const {
  return fault_of(value, definition.empty() ? root_ : root_.at("$defs").at(definition), Pointer());
}

std::optional<std::string> Schema::fault_of(const Json& value, const Json& referring, const Pointer& at) const {
  const Json& schema = resolved(referring);
  const auto expected = [&](const std::string& what) {
    return fmt::format("{}: expected {}, not {}", at.empty() ? "/" : at.to_string(), what, shown_value(value));
  };
  if (schema.contains("type")) {
    const auto type = schema["type"].get<std::string>();
    if (!is_of_type(value, type)) return expected(type_words().at(type));
  }
  if (schema.contains("const") && value != schema["const"]) return expected(schema["const"].dump());
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) {
    std::vector<std::string> allowed;
    for (const Json& one : schema["enum"]) allowed.push_back(one == "" ? one.dump() : one.get<std::string>());
    return expected(one_of_words(allowed));
  }
  if (schema.contains("minimum") && value.is_number() && value < schema["minimum"])
    return expected(schema["minimum"].dump() + " or more");
  if (schema.contains("pattern") && value.is_string()) {
    const auto pattern = schema["pattern"].get<std::string>();
    if (!std::regex_search(value.get_ref<const std::string&>(), patterns_.at(pattern)))
      return expected("a text like " + pattern);
  }
  if (value.is_object()) return fault_of_object(value, schema, at);
  return value.is_array() ? fault_of_list(value, schema, at) : std::nullopt;
}

std::optional<std::string> Schema::fault_of_object(const Json& value, const Json& schema, const Pointer& at) const {
  for (const Json& key : part_of(schema, "required", nothing))
    if (!value.contains(key.get_ref<const std::string&>()))
      return fmt::format("{}: expected this key, which is missing", (at / key.get<std::string>()).to_string());
  const Json& properties = part_of(schema, "properties", nothing);
  const Json& others = part_of(schema, "additionalProperties", nothing);
  for (const auto& [key, inner] : value.items()) {
    const auto known = properties.find(key);
    if (known == properties.end() && others == false)
      return fmt::format("{}: unknown key{}", (at / key).to_string(), did_you_mean(key, keys_of(properties)));
    if (Fault found = fault_of(inner, known == properties.end() ? others : *known, at / key)) return found;
  }
  return std::nullopt;
}

std::optional<std::string> Schema::fault_of_list(const Json& value, const Json& schema, const Pointer& at) const {
  const auto fewest = schema.value("minItems", std::size_t{0});
  const auto most = schema.value("maxItems", value.size());
  if (value.size() < fewest || value.size() > most)
    return fmt::format("{}: expected {} to {} entries, not {}", at.to_string(), fewest, most, value.size());
  if (!schema.contains("items")) return std::nullopt;
  for (std::size_t i = 0; i < value.size(); ++i)
    if (Fault found = fault_of(value[i], schema["items"], at / i)) return found;
  return std::nullopt;
}

}  // namespace paperproof::compare
