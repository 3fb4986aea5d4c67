/// Tests whose cases are rows of a table: see tables/README.md.
#pragma once

#include "compare/scene_files.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace paperproof::compare {

using Json = nlohmann::ordered_json;

/// Registers each test of tables/FILE.json. Its rows are checked one by one, with what the test and the file have for
/// all of their rows and with every `{word}` of their texts filled in.
[[nodiscard]] bool table_tests(const std::string& file, void (*check)(const Json& row));

/// A text, or a list of its lines.
[[nodiscard]] std::string text_in(const Json& text);

/// A text with every `{word}` filled in. Words may be made of words.
[[nodiscard]] std::string filled(std::string text, const Json& words);

/// What a row has under a key, else an object without keys.
[[nodiscard]] const Json& object_in(const Json& row, const char* key);

/// What a row says of a file that a scene is read from: that it is refused, or what becomes of it.
void check_scene_file(const SceneFiles& files, const Json& row);
/// The same in a folder of its own.
void check_scene_file_alone(const Json& row);

}  // namespace paperproof::compare
