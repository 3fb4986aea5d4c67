/// Contenders that are processes of their own.
#include "compare/command_workplace.hpp"

namespace paperproof::compare {
namespace {

using Peer = CommandTest;
const bool table = table_tests<CommandTest>("peers.json", keys_of_calls, check_call);

using nlohmann::json;

constexpr const char* alone = " --contender octagon_sweep --no-reference --no-timing ";

std::string command_of(const std::string& script) {
  return " --peer 'python3 " PAPERPROOF_SOURCE_DIR "/" + script + "' ";
}

/// The row of the last contender.
json last_row(const Finished& finished) { return json::parse(finished.out).at("rows").back(); }

TEST_F(Peer, that_says_what_box2d_did_is_judged_like_it) {
  for (const char* scene : {"thin_platform", "lift_up", "lift_sideways", "skier_no_snap", "conveyor", "jump_into_wall",
                            "jump_beside_wall", "jump_into_corner"}) {
    const std::string run = std::string("compare ") + scene + " --json ";
    const json box2d = last_row(runs(run + "--contender box2d --no-reference --no-timing --trace t"));
    const json peer = last_row(
        runs(run + alone + command_of(std::string("tests/compare/parrot.py t.") + scene + ".box2d.float.jsonl")));
    EXPECT_FALSE(holds(peer.value("reason", ""), "another motion")) << peer["reason"];
    EXPECT_EQ(peer["engine"], "parrot 1");
    EXPECT_EQ(peer["ns_per_step_own_clock"], 1000);
    for (const char* key : {"verdict", "reason", "scalar", "steps", "tunnels", "steps_ending_inside", "contact_steps",
                            "first_contact_step", "colliders_touched", "hanging_steps", "event_sequence", "answer_ok"})
      EXPECT_EQ(peer.value(key, json{}), box2d.value(key, json{})) << scene << ' ' << key;
  }
}

TEST_F(Peer, that_stops_at_nothing_passes_paper_wherever_it_runs_and_its_command_says_so_again) {
  const Finished swept = runs("sweep paper --vary speed=10,100 --contender octagon_sweep --quiet --rows r.jsonl" +
                              command_of("compare/peers/straight.py"));
  int passed = 0;
  for (const json& row : json_lines(written("r.jsonl"))) {
    if (row.value("contender", "") != "straight") continue;
    ++passed;
    EXPECT_EQ(row["verdict"], "tunnels");
    const std::string again = row["command"].get<std::string>().substr(std::string("paperproof ").size());
    const json same = last_row(place.run(again + " --json --no-timing"));
    EXPECT_EQ(same["case"], row["case"]);
    EXPECT_EQ(same["first_tunnel"], row["first_tunnel"]);
  }
  EXPECT_EQ(passed, 2);
}

TEST_F(Peer, has_a_slope_of_its_error_and_no_time) {
  const Finished told =
      runs("work-precision flight --contender octagon_sweep --rows r.jsonl" + command_of("compare/peers/straight.py"));
  std::map<std::string, double> slopes;
  for (const json& row : json_lines(written("r.jsonl")))
    if (row.contains("slope") && row.value("curve", "") == "dt_s")
      slopes[row["contender"]] = row["slope"].get<double>();
  EXPECT_NEAR(slopes.at("straight"), slopes.at("octagon_sweep"), 0.01) << "both fly by the law";
  EXPECT_TRUE(holds(told.out, "peers are not timed, and on none"));
}

/// Descriptor 9 is open as long as anything runs that the peer started.
TEST_F(Peer, ends_with_all_that_it_started_however_the_command_ends) {
  place.write("stays.sh", "sleep 99; exit\n");
  const auto expect_end = [&](const std::string& end, const std::string& call) {
    const std::string line = "{ timeout --foreground -s " + end + " 1 '" PAPERPROOF_COMMAND "' " + call;
    EXPECT_EQ(place.shell(line + " --no-reference --peer 'sh stays.sh' 9>&1 >/dev/null 2>&1; } | timeout 20 cat"), 0)
        << end;
  };
  for (const char* end : {"INT", "TERM", "HUP", "KILL"})
    expect_end(end, "compare thin_platform --contender octagon_sweep");
  expect_end("KILL", "sweep paper --vary speed=10,20 --contender octagon_sweep --jobs 2");
}

}  // namespace
}  // namespace paperproof::compare
