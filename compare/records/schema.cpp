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

bool is_of_type(const Json& value, const Json& type) {
  if (type.is_array()) return std::ranges::any_of(type, [&](const Json& one) { return is_of_type(value, one); });
  const auto& word = type.get_ref<const std::string&>();  // comparing JSON with a text would copy the text
  if (word == "object") return value.is_object();
  if (word == "array") return value.is_array();
  if (word == "string") return value.is_string();
  if (word == "boolean") return value.is_boolean();
  if (word == "number") return value.is_number();
  return is_whole(value);
}

const std::map<std::string, std::string>& type_words() {
  static const std::map<std::string, std::string> words{{"object", "an object"}, {"array", "a list"},
                                                        {"string", "a text"},    {"boolean", "true or false"},
                                                        {"number", "a number"},  {"integer", "a whole number"}};
  return words;
}

std::string words_of_type(const Json& type) {
  if (!type.is_array()) return type_words().at(type.get<std::string>());
  std::vector<std::string> words;
  for (const Json& one : type) words.push_back(type_words().at(one.get<std::string>()));
  return one_of_words(words);
}

const std::set<std::string>& known_keywords() {
  static const std::set<std::string> keywords{
      "$schema",  "title",    "description",      "default",   "$defs",       "$ref",       "type",
      "enum",     "const",    "minimum",          "maximum",   "pattern",     "items",      "additionalProperties",
      "required", "minItems", "maxItems",         "minLength", "uniqueItems", "properties", "exclusiveMinimum",
      "oneOf",    "not",      "dependentRequired"};
  return keywords;
}

/// Asks for nothing.
const Json nothing = Json::object();
const Json unlimited;

const Json& part_of(const Json& schema, const char* keyword, const Json& otherwise) {
  const auto found = schema.find(keyword);
  return found == schema.end() ? otherwise : *found;
}

/// Says what a number must be; empty where it is that. A limit may be `unlimited`.
std::string range_missed(const Json& number, const Json& least, const Json& above, const Json& most) {
  const bool is_within =
      (least.is_null() || number >= least) && (above.is_null() || number > above) && (most.is_null() || number <= most);
  if (is_within) return {};
  if (!above.is_null())
    return fmt::format("more than {}{}", above.dump(), most.is_null() ? "" : ", at most " + most.dump());
  if (most.is_null()) return least.dump() + " or more";
  if (least.is_null()) return "at most " + most.dump();
  return least == most ? least.dump() : fmt::format("{} to {}", least.dump(), most.dump());
}

}  // namespace

Schema::Schema(std::string_view text) : root_(Json::parse(text)) { prepare(root_); }

void Schema::prepare(const Json& schema) {
  for (const auto& [keyword, value] : schema.items()) {
    if (!known_keywords().contains(keyword)) throw std::logic_error("a schema asks by an unknown keyword: " + keyword);
    for (const Json& type : keyword == "type" ? value.is_array() ? value : Json{value} : Json::array())
      if (!type_words().contains(type.get<std::string>()))
        throw std::logic_error("a schema asks for an unknown type: " + value.dump());
    if (keyword == "not" && !schema.contains("title")) throw std::logic_error("a schema does not say what it asks");
    if (keyword == "not") prepare(value);
    for (const Json& alternative : keyword == "oneOf" ? value : Json::array())
      if (prepare(alternative); !resolved(alternative).contains("required") && resolved(alternative)["type"] != "array")
        throw std::logic_error("the alternatives of a schema are told apart by the first key that they require");
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
  Fault found = fault_of(value, definition.empty() ? root_ : root_.at("$defs").at(definition));
  if (found && !found->starts_with('/')) found->insert(0, "/");
  return found;
}

std::optional<std::string> Schema::fault_of(const Json& value, const Json& referring) const {
  const Json& schema = resolved(referring);
  if (schema.empty()) return std::nullopt;
  const auto expected = [&](const std::string& what) {
    return fmt::format(": expected {}, not {}", what, shown_value(value));
  };
  const auto titled = [&](const std::string& otherwise) { return expected(schema.value("title", otherwise)); };
  const auto limit = [&](const char* keyword) -> const Json& { return part_of(schema, keyword, unlimited); };
  if (schema.contains("type") && !is_of_type(value, schema["type"])) return expected(words_of_type(schema["type"]));
  if (schema.contains("const") && value != schema["const"]) return expected(schema["const"].dump());
  if (schema.contains("enum") && std::ranges::find(schema["enum"], value) == schema["enum"].end()) {
    std::vector<std::string> allowed;
    for (const Json& one : schema["enum"]) allowed.push_back(one == "" ? one.dump() : one.get<std::string>());
    return expected(one_of_words(allowed));
  }
  if (value.is_number()) {
    const std::string range = range_missed(value, limit("minimum"), limit("exclusiveMinimum"), limit("maximum"));
    if (!range.empty()) return expected(range);
  }
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    const auto pattern = schema.value("pattern", "");
    if (!pattern.empty() && !std::regex_search(text, patterns_.at(pattern))) return titled("a text like " + pattern);
    if (text.size() < schema.value("minLength", std::size_t{0})) return titled("a longer text");
  }
  if (schema.contains("not") && !fault_of(value, schema["not"])) return titled("");
  if (schema.contains("oneOf"))
    if (Fault found = fault_of_alternatives(value, schema["oneOf"])) return found;
  if (value.is_object()) return fault_of_object(value, schema);
  return value.is_array() ? fault_of_list(value, schema) : std::nullopt;
}

std::optional<std::string> Schema::fault_of_alternatives(const Json& value, const Json& alternatives) const {
  std::vector<std::string> keys;
  std::vector<std::string> here;
  const Json* chosen = nullptr;
  for (const Json& alternative : alternatives) {
    const bool is_list = !resolved(alternative).contains("required");
    if (is_list && value.is_array()) return fault_of(value, alternative);
    keys.push_back(is_list ? "a list" : resolved(alternative)["required"][0]);
    if (is_list || !value.contains(keys.back())) continue;
    here.push_back(keys.back());
    chosen = &alternative;
  }
  if (here.size() == 1) return fault_of(value, *chosen);
  return fmt::format(": expected exactly one of {}; here {}", fmt::join(keys, ", "),
                     here.empty() ? "is none" : fmt::format("are {}", fmt::join(here, ", ")));
}

std::optional<std::string> Schema::fault_of_object(const Json& value, const Json& schema) const {
  const auto at = [](const std::string& key, const std::string& says) { return (Pointer() / key).to_string() + says; };
  const Json& properties = part_of(schema, "properties", nothing);
  const Json& others = part_of(schema, "additionalProperties", nothing);
  const bool closed = others == false;
  for (auto member = value.begin(); closed && member != value.end(); ++member) {
    const std::string& key = member.key();
    if (properties.contains(key)) continue;
    std::vector<std::string> keys;
    for (const auto& [name, asks] : properties.items()) keys.push_back(name);
    const std::string near = did_you_mean(key, keys);
    return at(key, ": unknown key" + (near.empty() ? "; expected one of " + one_of_words(keys) : near));
  }
  for (const Json& key : part_of(schema, "required", nothing))
    if (!value.contains(key.get_ref<const std::string&>())) return at(key, ": expected this key, which is missing");
  for (const auto& [key, needed] : part_of(schema, "dependentRequired", nothing).items())
    if (value.contains(key) &&
        !std::ranges::all_of(needed, [&](const Json& other) { return value.contains(other.get<std::string>()); }))
      return at(key, fmt::format(": expected only beside {}", needed[0].get<std::string>()));
  for (auto member = value.begin(); member != value.end(); ++member) {
    const auto known = properties.find(member.key());
    if (Fault found = fault_of(*member, known == properties.end() ? others : *known)) return at(member.key(), *found);
  }
  return std::nullopt;
}

std::optional<std::string> Schema::fault_of_list(const Json& value, const Json& schema) const {
  const std::string count = range_missed(value.size(), part_of(schema, "minItems", unlimited), unlimited,
                                         part_of(schema, "maxItems", unlimited));
  if (!count.empty()) return fmt::format(": expected {} entries, not {}", count, value.size());
  const bool unique = schema.value("uniqueItems", false);
  const Json& items = part_of(schema, "items", nothing);
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto before = value.begin() + static_cast<std::ptrdiff_t>(i);
    if (unique && std::find(value.begin(), before, value[i]) != before)
      return fmt::format("/{}: expected another entry than those before, not {}", i, shown_value(value[i]));
    if (Fault found = fault_of(value[i], items)) return fmt::format("/{}{}", i, *found);
  }
  return std::nullopt;
}

}  // namespace paperproof::compare
