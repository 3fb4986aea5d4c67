/// Tests whose cases are rows of a table: see tables/README.md.
#pragma once

#include "compare/scene_files.hpp"
#include "support/expected.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace paperproof::compare {

using Json = nlohmann::ordered_json;

struct TableRow {
  Json row;    ///< As it stands in the table.
  Json whole;  ///< With what its test and its file have for all of their rows.
};
/// A test of a table: its suite, its name, its rows.
struct TableDef {
  std::string suite;
  std::string name;
  std::vector<TableRow> rows;
};
[[nodiscard]] std::vector<TableDef> tests_in(const std::string& file);
/// A whole row with every `{word}` of its texts filled in.
[[nodiscard]] Json filled(Json row);

/// Registers each test of tables/FILE, whose rows are checked one by one.
/// @param keys that a row may have beside `name`, `because` and `let`, between blanks.
template <class Fixture = testing::Test>
bool table_tests(const std::string& file, const std::string& keys, void (*check)(const Json& row)) {
  class Test : public Fixture {
   public:
    Test(const std::vector<TableRow>& rows, const std::string& keys, void (*check)(const Json& row))
        : rows_(rows), keys_(" name because let" + keys), check_(check) {}
    void TestBody() override {
      for (const TableRow& row : rows_) {
        SCOPED_TRACE(row.row.dump());
        test::refuse_other_keys(row.whole, keys_, "a row");
        check_(filled(row.whole));
      }
    }

   private:
    std::vector<TableRow> rows_;
    std::string keys_;
    void (*check_)(const Json& row);
  };
  for (const TableDef& def : tests_in(file))
    testing::RegisterTest(def.suite.c_str(), def.name.c_str(), nullptr, nullptr, file.c_str(), 1,
                          [=]() -> Fixture* { return new Test(def.rows, keys, check); });
  return true;
}

/// A text, or a list of its lines.
[[nodiscard]] std::string text_in(const Json& text);

/// A text with every `{word}` filled in. Words may be made of words.
[[nodiscard]] std::string filled(std::string text, const Json& words);

/// What a row has under a key, else an object without keys.
[[nodiscard]] const Json& object_in(const Json& row, const char* key);

/// What a row says of a file that a scene is read from: that it is refused, or what becomes of it.
void check_scene_file(const SceneFiles& files, const Json& row);
inline constexpr const char* keys_of_scene_files = " file text text_of beside change says notes solids is within ";
/// The same in a folder of its own.
void check_scene_file_alone(const Json& row);

}  // namespace paperproof::compare
