/// Holds JSON against a JSON Schema that ships.
#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <regex>
#include <string>
#include <string_view>

namespace paperproof::compare {

/// As much of JSON Schema 2020-12 as the project's schemas use. Of `oneOf` the alternatives are told apart by the first
/// key that they require, or one is a list; `not` has a `title`, which says what is asked for instead.
class Schema {
 public:
  /// @throws std::logic_error for a keyword that is not known here: what it asks would not be asked.
  explicit Schema(std::string_view text);

  /// The first fault of `value`, as "/verdict: expected ..."; nothing where it holds.
  /// @param definition a name in `$defs`; empty: the whole schema.
  [[nodiscard]] std::optional<std::string> fault(const nlohmann::ordered_json& value,
                                                 const std::string& definition = "") const;

 private:
  using Json = nlohmann::ordered_json;
  using Pointer = Json::json_pointer;
  using Fault = std::optional<std::string>;

  void prepare(const Json& schema);
  [[nodiscard]] const Json& resolved(const Json& schema) const;
  /// "/key/2: expected ...": from the value on.
  [[nodiscard]] Fault fault_of(const Json& value, const Json& schema) const;
  [[nodiscard]] Fault fault_of_alternatives(const Json& value, const Json& alternatives) const;
  [[nodiscard]] Fault fault_of_object(const Json& value, const Json& schema) const;
  [[nodiscard]] Fault fault_of_list(const Json& value, const Json& schema) const;

  Json root_;
  std::map<std::string, std::regex> patterns_;
};

}  // namespace paperproof::compare
