/// A Case: everything that decides what one run gives. One Case gives one Row.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

struct Case {
  /// A number or word that is set, by the name under which it is typed.
  struct Setting {
    std::string key;
    std::string value;  ///< As it was typed, or the shortest text that reads back to the same number.
  };
  std::string scene;  ///< A built-in scene, a family, or a file.
  std::vector<Setting> parameters;
  std::string contender;
  std::string scalar = "double";
  std::vector<Setting> knobs;
  std::optional<std::uint64_t> seed;  ///< Of random input, instead of the scene's.
  std::optional<int> steps;           ///< Instead of the scene's.
};

/// 16 hexadecimal digits: the same for the same Case on every machine (FNV-1a, 64 bit, of its words).
[[nodiscard]] std::string id_of(const Case& one);

/// What runs it alone: `paperproof compare paper --set speed=40 --contender mask --no-reference`.
[[nodiscard]] std::string command_of(const Case& one);

}  // namespace paperproof::compare
