/// Contenders that are processes of their own.
#include "compare/command_workplace.hpp"

namespace paperproof::compare {
namespace {

using Peer = CommandTest;
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

TEST_F(Peer, that_does_not_play_by_the_rules_has_a_row_that_says_why_and_never_a_status) {
  const std::string greets = R"(echo "{\"name\":\"p\",\"version\":\"1\"}"; read scene; read step; )";
  const auto answers = [&](const std::string& path) {
    return greets + R"(echo "{\"characters\":[{\"path\":)" + path + R"(}]}")";
  };
  struct Line {
    std::string command, scene, verdict, words;
  };
  for (const Line& line : {
           Line{"no_such_program", "thin_platform", "failed",
                "ended with status 127: peer.sh: 1: no_such_program: not found"},
           {greets + "sleep 30", "thin_platform", "failed", "step 0: the peer says nothing for 10 s"},
           {"echo hello", "thin_platform", "failed", "the peer's greeting:1:1: expected JSON"},
           {greets + "echo Loading", "thin_platform", "failed", "last read: 'L'; it says \"Loading\""},
           {R"(echo "{\"refuses\":\"\"}")", "thin_platform", "failed", "/refuses: expected a longer text"},
           {"cat", "thin_platform", "failed", "/: expected exactly one of name, refuses, characters"},
           {"kill -SEGV $$", "thin_platform", "failed", "ended with status 139: Segmentation fault"},
           {R"(echo "{\"name\":\"p\",\"version\":\"1\",\"points\":[[0,0],[1,0],[0,0]]}")", "thin_platform", "failed",
            "point 2 of the character repeats point 0"},
           {R"(echo "{\"refuses\":\"no papers\"}")", "thin_platform", "not_applicable", "no papers"},
           {greets, "lift_up", "not_applicable", "p 1 does not say that it can: movers"},
           {greets, "thin_platform", "failed", "step 0: the peer ended with status 0"},
           {answers("[[0,1e999,1]]"), "thin_platform", "failed",
            "the peer's answer:1: /characters/0/path/0/1: expected a finite number"},
           {answers("[[0,0,0.5],[0,0,0.2]]"), "thin_platform", "failed",
            "do not ascend from above 0: 0.2 comes after 0.5"},
           {answers("[[0,0,0.5]]"), "thin_platform", "failed", "does not end at 1"},
           {answers("[[0,9,0],[0,0,1]]"), "thin_platform", "failed", "do not ascend from above 0: 0 comes after 0"},
           {answers("[]"), "thin_platform", "failed", "/characters/0/path: expected 1 or more"},
           {answers(R"([[0,0,1]]},{\"path\":[[0,0,1]])"), "thin_platform", "failed",
            "the peer answers for 2 characters, not for 1"},
           {answers(R"([[0,0,1]],\"contacts\":[{\"collider\":\"paper\",\"normal\":[0,5]}])"), "thin_platform", "failed",
            "a normal of the peer is no unit vector: [0,5]"},
           {answers(R"([[0,0,1]],\"ground\":{\"collider\":\"moon\"})"), "thin_platform", "failed",
            "names a collider that there is not: moon"},
       }) {
    place.write("peer.sh", line.command + "\n");
    const json row = last_row(runs("compare " + line.scene + alone + "--json --peer 'sh peer.sh'"));
    EXPECT_EQ(row["verdict"], line.verdict) << line.command;
    EXPECT_TRUE(holds(row["reason"].get<std::string>(), line.words)) << row["reason"];
  }
  for (const char* refused : {"octagon_sweep=cat", "=cat", "Cat", ""})
    EXPECT_EQ(place.run("compare thin_platform --peer '" + std::string(refused) + "'").status, 2) << refused;
}

TEST_F(Peer, is_refused_only_what_it_would_have_to_do_something_about) {
  place.write("stands.sh", R"(read scene; echo "{\"name\":\"p\",\"version\":\"1\",\"can\":[$1]}"
while read step; do echo "{\"characters\":[{\"path\":[[0,0.7,1]]}]}"; done)");
  const auto run = [&](const std::string& scene, const std::string& can) {
    return last_row(runs("compare " + scene + alone + "--json --peer 'sh stands.sh " + can + "'"));
  };
  const json sensed = run("sensor_gate", "");
  EXPECT_NE(sensed["verdict"], "not_applicable") << "what is no solid needs nothing";
  EXPECT_FALSE(sensed.contains("sensor_errors"));
  EXPECT_NE(run("stack_1", R"(\"movers\")")["verdict"], "not_applicable") << "bodies do not turn";
  EXPECT_EQ(run("rotating_paper", R"(\"movers\")")["reason"], "p 1 does not say that it can: turning");
  const Finished several = runs("compare thin_platform lift_up" + std::string(alone) + "--peer 'sh stands.sh'");
  EXPECT_TRUE(holds(several.out, "stands in lift_up: p 1 does not say that it can: movers\n"));
}

TEST_F(Peer, is_asked_when_it_meets_something_only_where_it_names_contacts) {
  runs("compare thin_platform --contender octagon_sweep --no-reference --no-timing --trace t");
  const auto row_without = [&](const std::string& what) {
    const std::string file = "tests/compare/parrot.py t.thin_platform.octagon_sweep.double.jsonl ";
    return last_row(runs("compare thin_platform --json" + std::string(alone) + command_of(file + what)));
  };
  EXPECT_EQ(row_without("")["verdict"], "holds");
  EXPECT_EQ(row_without("contacts")["verdict"], "holds");
  EXPECT_EQ(row_without("fraction")["reason"], "step 4: a contact of the peer has no fraction, and its way is exact");
}

TEST_F(Peer, whose_ground_is_too_far_hears_how_near_it_must_be) {
  place.write("hovers.py", R"(import json, sys
sys.stdin.readline()
print(json.dumps({"name": "p", "version": "1", "skin": 0.01, "path_exact": sys.argv[1] == "exact"}), flush=True)
for step in sys.stdin:
    print(json.dumps({"characters": [{"path": [[0, 0.625 + float(sys.argv[2]), 1]], "velocity": [0, 0],
                                      "grounded": True}]}), flush=True))");
  const auto reason_at = [&](const std::string& how) {
    return last_row(runs("compare rest --json --peer 'python3 hovers.py " + how + "'" + alone)).value("reason", "");
  };
  EXPECT_FALSE(holds(reason_at("exact 0.0099"), "nothing under it"));
  EXPECT_TRUE(holds(reason_at("exact 0.0101"), "says it is grounded with nothing under it within 0.01 m on"));
  EXPECT_FALSE(holds(reason_at("sampled 0.0199"), "nothing under it"));
  EXPECT_TRUE(holds(reason_at("sampled 0.0201"), "says it is grounded with nothing under it within 0.02 m on"));
}

TEST_F(Peer, that_fails_is_told_with_its_reason_wherever_it_runs) {
  place.write("fails.py", R"(import json, sys
sys.stdin.readline()
print(json.dumps({"name": "p", "version": "1", "can": ["movers"]}), flush=True)
sys.stdin.readline()
print(json.dumps({"characters": [{"path": [[0, 9, 1]]}]}), flush=True)
sys.exit("no more"))");
  const std::string peer = " --contender octagon_sweep --rows r.jsonl --peer 'python3 fails.py'";
  const auto told = [&](const std::string& run, const std::string& words) {
    const Finished finished = runs(run + peer);
    EXPECT_TRUE(holds(finished.out, words)) << finished.out;
    return finished.out;
  };
  const std::string why = ": step 1: the peer ended with status 1: no more";
  const std::string swept = told("sweep paper --vary speed=10,20", "fails failed in 2 runs" + why);
  EXPECT_TRUE(holds(swept, " failed "));
  told("work-precision flight", "fails failed in 6 runs" + why);
  for (const json& row : json_lines(written("r.jsonl")))
    EXPECT_TRUE(row.value("contender", "") != "fails" || !row.contains("error_max_m")) << row;
}

TEST_F(Peer, may_not_answer_before_it_is_asked) {
  place.write("twice.sh", R"(echo '{"name":"p","version":"1"}'; read scene
while read step; do for line in 1 2; do echo '{"characters":[{"path":[[0,9,1]]}]}'; done; done)");
  const json row = last_row(runs("compare thin_platform --json --peer 'sh twice.sh'" + std::string(alone)));
  EXPECT_TRUE(holds(row["reason"].get<std::string>(), ": the peer answers before it is asked")) << row["reason"];
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

TEST_F(Peer, may_greet_later_than_a_case_may_take) {
  place.write("late.sh", R"(sleep 1.5; echo '{"refuses":"it is late"}')");
  runs("sweep paper --contender octagon_sweep --limit 1 --quiet --rows r.jsonl --peer 'sh late.sh'");
  EXPECT_EQ(json_lines(written("r.jsonl")).back()["reason"], "it is late");
}

/// Descriptor 9 is open as long as anything runs that the peer started.
TEST_F(Peer, ends_with_all_that_it_started_however_the_command_ends) {
  place.write("stays.sh", "sleep 99; exit\n");
  const std::string peer = " --no-reference --peer 'sh stays.sh' 9>&1 >/dev/null 2>&1; } | timeout 20 cat #";
  const auto ended_by = [&](const std::string& end) { return "{ timeout --foreground -s " + end + " 1"; };
  const std::string compare = "compare thin_platform --contender octagon_sweep";
  for (const char* end : {"INT", "TERM", "HUP", "KILL"})
    EXPECT_EQ(place.run(compare + peer, ended_by(end)).status, 0) << end;
  const std::string sweep = "sweep paper --vary speed=10,20 --contender octagon_sweep --jobs 2";
  EXPECT_EQ(place.run(sweep + peer, ended_by("KILL")).status, 0);
}

TEST_F(Peer, that_keeps_its_skin_exactly_touches) {
  place.write("stands.py", R"(import json, sys
sys.stdin.readline()
print(json.dumps({"name": "p", "version": "1", "skin": 0.01, "path_exact": True}), flush=True)
for step in sys.stdin:
    print(json.dumps({"characters": [{"path": [[0, float(sys.argv[1]), 1]], "velocity": [0, 0], "grounded": True}]}),
          flush=True))");
  ASSERT_GT(0.635 - 0.625, 0.01) << "by its last bit";
  for (const auto& [height, hangs] : {std::pair{"0.635", false}, {"0.63500001", true}})
    EXPECT_EQ(last_row(runs("compare rest --json --peer 'python3 stands.py " + std::string(height) + "'" +
                            alone))["hanging_steps"] > 0,
              hangs);
}

}  // namespace
}  // namespace paperproof::compare
