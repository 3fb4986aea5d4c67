/// The command as a user runs it: exit status, what it says, which files it writes.
#include "compare/command_workplace.hpp"

namespace paperproof::compare {

void check_call(const Json& row) {
  const Workplace place;
  const auto list = [&](const char* key) { return row.value(key, std::vector<std::string>()); };
  for (const auto& [name, text] : object_in(row, "files").items()) place.write(name, quoted(text_in(text)));
  for (const std::string& call : list("before")) ASSERT_EQ(place.run(call).status, 0) << call;
  ASSERT_EQ(place.shell(row.value("first", "true")), 0);
  for (const std::string& call : list("calls")) {
    const Finished finished = place.run(call);
    EXPECT_EQ(finished.status, row.value("status", 0)) << call << "\n" << finished.err;
    for (const std::string& part : list("out")) EXPECT_TRUE(holds(finished.out, part)) << call;
    for (const std::string& part : list("not_out")) EXPECT_FALSE(holds(finished.out, part)) << call;
    EXPECT_TRUE(holds(finished.err, row.value("says", ""))) << call;
    if (row.contains("err")) {
      EXPECT_EQ(finished.err, row["err"]) << call;
    }
    if (!row.contains("row") && !row.contains("reason") && !row.contains("not_reason")) continue;
    const Json last = Json::parse(finished.out).at("rows").back();
    for (const auto& [key, value] : object_in(row, "row").items()) EXPECT_EQ(last.value(key, Json()), value) << last;
    const std::string reason = quoted(last.value("reason", ""));
    EXPECT_TRUE(holds(reason, quoted(row.value("reason", "")))) << last;
    if (row.contains("not_reason")) {
      EXPECT_FALSE(holds(reason, row["not_reason"].get<std::string>()));
    }
  }
}

namespace {

using Command = CommandTest;

const bool calls = table_tests<CommandTest>("calls.json", keys_of_calls, check_call);

TEST_F(Command, check_says_who_will_run_and_why_the_others_do_not) {
  // The same as `compare` finds, for each contender.
  const std::string turning =
      R"(], "movers": [ { "id": "arm", "polygon": [[6,0],[8,0],[8,1],[6,1]], "path": [ { "t": 0, "at": [0,0] } ], "angle": [ { "t": 0, "at": 0 }, { "t": 1, "at": 1 } ] } ],
         "characters": [ { "position": [2, 3] } ] })";
  place.write("company.json", with(good_scene, "]\n}", turning));
  const Finished checked = runs("check company.json");
  EXPECT_TRUE(holds(checked.out, "contenders run; octagon_sweep does not, so that status 0 guarantees nothing\n"));
  std::size_t running = 0;
  const nlohmann::json rows = nlohmann::json::parse(runs("compare company.json --no-timing --json").out);
  for (const nlohmann::json& row : rows.at("rows")) {
    const bool can_run = row.at("verdict") != "not_applicable";
    running += can_run;
    const std::string no = "  not " + row.at("contender").get<std::string>() + ": " + row.value("reason", "") + "\n";
    EXPECT_TRUE(can_run || holds(checked.out, no)) << no;
  }
  EXPECT_TRUE(holds(checked.out, "  compare    " + std::to_string(running) + " of 13 contenders run"));
}

}  // namespace
}  // namespace paperproof::compare
