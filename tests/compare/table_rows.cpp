#include "compare/table.hpp"
#include "compare/table_file.hpp"

#include "records/collider_json.hpp"
#include "scenes/formula.hpp"
#include "scenes/write_json.hpp"

#include <cmath>

namespace paperproof::compare {
namespace {

/// A word of `let` as text.
std::string word_in(const Json& word) {
  if (word.is_number()) return word.dump();
  if (!word.is_object()) return text_in(word);
  std::string text;
  for (int i = 0; i < word.at("times"); ++i) text += word.at("of").get<std::string>();
  return text;
}

void fill(Json& value, const Json& words) {
  if (value.is_string()) value = filled(value.get<std::string>(), words);
  if (value.is_structured())
    for (Json& part : value) fill(part, words);
}

/// What `more` says besides `common`, without lists of tests and rows.
Json merged(Json common, Json more) {
  for (const char* list : {"tests", "rows"}) more.erase(list);
  common.update(more, true);
  return common;
}

/// As far as numbers go, within a distance.
void expect_equal(const Json& found, const Json& expected, double within, const std::string& path) {
  if (expected.is_number() && found.is_number()) {
    EXPECT_LE(std::abs(found.get<double>() - expected.get<double>()), within) << path << " is " << found;
    return;
  }
  if (!expected.is_array() || found.size() != expected.size()) {
    EXPECT_EQ(found, expected) << path;
    return;
  }
  for (std::size_t i = 0; i < expected.size(); ++i)
    expect_equal(found[i], expected[i], within, path + "/" + std::to_string(i));
}

/// The scene as a file has it, and what a file has not.
Json seen_in(const Scene& scene) {
  Json seen = scene_json(scene);
  seen["respawn"] =
      scene.respawn_box ? Json{point_json(scene.respawn_box->lower), point_json(scene.respawn_box->upper)} : Json();
  return seen;
}

}  // namespace

std::string filled(std::string text, const Json& words) {
  for (std::size_t at = 0; (at = text.find('{', at)) != std::string::npos;) {
    const std::size_t length = text.find('}', at) - at;
    const auto word = words.find(text.substr(at + 1, length - 1));
    if (word == words.end())
      ++at;
    else
      text.replace(at, length + 1, word_in(*word));
  }
  return text;
}

Json filled(Json row) {
  fill(row, Json(object_in(row, "let")));
  return row;
}

std::string text_in(const Json& text) {
  if (text.is_string()) return text;
  std::string lines;
  for (const Json& line : text) lines += line.get<std::string>() + '\n';
  return lines.substr(0, lines.size() - 1);
}

const Json& object_in(const Json& row, const char* key) {
  static const Json nothing = Json::object();
  return row.contains(key) ? row.at(key) : nothing;
}

std::vector<TableDef> tests_in(const std::string& file) {
  std::vector<TableDef> tests;
  const Json table = read_table(file);
  const Json of_table = merged(Json::object(), table);
  for (const Json& test : table.at("tests")) {
    const std::string name = test.at("name");
    const std::size_t dot = name.find('.');
    tests.push_back({name.substr(0, dot), name.substr(dot + 1), {}});
    const Json of_test = merged(of_table, test);
    for (const Json& row : test.at("rows")) tests.back().rows.push_back({row, merged(of_test, row)});
  }
  return tests;
}

void check_scene_file(const SceneFiles& files, const Json& row) {
  for (const auto& [name, text] : object_in(row, "beside").items()) files.write(name, quoted(text_in(text)));
  std::string text =
      row.contains("text") ? quoted(text_in(row["text"])) : read_file(tables + std::string(row["text_of"]), "");
  for (const auto& [from, to] : object_in(row, "change").items()) text = with(text, quoted(from), quoted(text_in(to)));
  const std::string name = row.at("file");
  if (row.contains("says")) {
    EXPECT_TRUE(begins(quoted(files.complaint(name, text)), quoted(row["says"])));
    return;
  }
  const Scene scene = files.load(name, text);
  EXPECT_EQ(Json(scene.notes), row.value("notes", Json::array()));
  if (row.contains("solids")) {
    EXPECT_EQ(solids_of(scene), row["solids"]);
  }
  const Json seen = seen_in(scene);
  Values numbers = constants();
  for (const auto& [word, number] : object_in(row, "let").items())
    if (number.is_number()) numbers[word] = number;
  for (const auto& [path, expected] : object_in(row, "is").items()) {
    const Json::json_pointer place("/" + path);
    expect_equal(seen.contains(place) ? seen.at(place) : Json(), computed(expected, numbers), row.value("within", 0.0),
                 path);
  }
}

void check_scene_file_alone(const Json& row) { check_scene_file(SceneFiles(), row); }

}  // namespace paperproof::compare
