/// The replay in a report: traces, line for line, and which steps are left out.
#include "compare/report_pages.hpp"
#include "records/trace_writer.hpp"
#include "report/replay.hpp"

#include <set>
#include <sstream>

namespace paperproof::compare {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class ReplayTest : public ReportTest {
 protected:
  /// As TraceWriter writes it.
  [[nodiscard]] std::string trace_of(const ReportRun& run) const {
    TraceWriter writer(files.path("trace.jsonl"), run.header);
    for (std::size_t i = 0; i < run.steps.size(); ++i) {
      writer.write(run.steps[i]);
      for (const std::vector<TraceStep>& steps : run.others) writer.write(steps[i]);
    }
    writer.commit();
    return content(files.path("trace.jsonl"));
  }
};

TEST_F(ReplayTest, has_traces_whose_colliders_stand_apart_and_once) {
  ReportScene scene = walk_of(5);
  scene.runs.push_back(pair_of(3).runs[0]);
  scene.runs.push_back(scene.runs[0]);
  scene.runs[2].header.scenery.colliders[0].points[0].x() -= 1e-9;
  std::vector<std::string> colliders;
  std::vector<std::string> traces;
  for (const std::string& line : lines_of(replay_lines(scene, 0))) {
    const json object = json::parse(line);
    if (object.is_array())
      colliders.push_back(line);
    else if (object.contains("paperproof_trace"))
      traces.push_back(with(line, "\"colliders\":" + object["colliders"].dump(),
                            "\"colliders\":" + colliders.at(object["colliders"])) +
                       '\n');
    else if (!traces.empty())
      traces.back() += line + '\n';
  }
  EXPECT_EQ(colliders.size(), 2U);
  ASSERT_EQ(traces.size(), 3U);
  for (std::size_t i = 0; i < traces.size(); ++i) EXPECT_EQ(traces[i], trace_of(scene.runs[i])) << i;
}

TEST_F(ReplayTest, notes_what_no_trace_says) {
  ReportScene scene = walk_of(5);
  scene.dt_list = {1.0 / 64, 31.0 / 1024};
  scene.runs[0].every = 3;
  scene.runs[0].events = {{2, ReportEvent::Kind::tunnel, "through", 0, 1},
                          {3, ReportEvent::Kind::note, "aside"},
                          {4, ReportEvent::Kind::clipped, "cut", 1}};
  Disagreement disagreement;
  disagreement.step = 3;
  disagreement.statements = {{0, scene.runs[0].steps[3]}, {1, scene.runs[0].steps[3]}};
  disagreement.who_is_right = "Nobody.";
  scene.disagreements.assign(9, disagreement);
  const std::vector<std::string> lines = lines_of(replay_lines(scene, 4));
  json expected = json::parse(R"({"dt_list": [0.015625, 0.0302734375], "disagreements_in_all": 9, "runs": [{"every": 3,
    "events": [{"step": 2, "kind": "tunnel", "words": "through", "collider": "tile_1"},
               {"step": 3, "kind": "note", "words": "aside"},
               {"step": 4, "kind": "clipped", "words": "cut", "character": 1}]}]})");
  // Of a side without a replay nothing can be drawn.
  const json statement{{"run", 0}, {"record", json::parse(lines.at(3 + 3))}};
  expected["disagreements"] =
      json::array_t(4, {{"step", 3}, {"who_is_right", "Nobody."}, {"statements", json::array({statement})}});
  EXPECT_EQ(json::parse(lines[0]), expected);
}

TEST_F(ReplayTest, is_packed_and_a_step_takes_less_than_sixty_bytes) {
  constexpr int steps = 1200;
  const std::string text = replay_lines(walk_of(steps), 0);
  EXPECT_EQ(unpacked(packed(text)), text);
  for (const char* few : {"", "a", "ab", "abc"}) EXPECT_EQ(unpacked(packed(few)), few);
  const std::size_t half = page(report_of(walk_of(steps / 2))).size();
  EXPECT_LT(page(report_of(walk_of(steps))).size() - half, 60U * steps / 2);
}

TEST_F(ReplayTest, the_step_of_a_disagreement_survives_thinning) {
  ReportScene scene = walk_of(1000);
  scene.disagreements.resize(1);
  scene.disagreements[0].step = 777;
  std::set<int> kept;
  for (const std::string& line :
       lines_of(unpacked(element(page(report_of(scene), {.max_replay_steps = 50}), "replay-0").dump())))
    if (line.starts_with("{\"step\"")) kept.insert(json::parse(line)["step"].get<int>());
  EXPECT_LE(kept.size(), 50U);
  for (const int step : {776, 777, 778}) EXPECT_TRUE(kept.contains(step)) << step;
}

TEST(ThinForReplay, keeps_ends_events_and_first_contact_within_the_limit) {
  for (const int steps : {5, 8, 9, 100, 1200, 1201, 3600}) {
    for (const int limit : {8, 20, 60, 1200}) {
      ReportRun run = walk_of(steps).runs[0];
      for (TraceStep& step : run.steps)
        if (step.step < steps / 2) step.contacts.clear();
      run.events = {{steps / 3, ReportEvent::Kind::tunnel, ""}};
      thin_for_replay(run, limit);
      std::set<int> kept;
      for (const TraceStep& step : run.steps) kept.insert(step.step);
      const auto room = static_cast<std::size_t>(std::min(steps, limit));
      EXPECT_LE(kept.size(), room);
      EXPECT_GE(kept.size(), room / 3) << steps << " to " << limit;
      EXPECT_TRUE(kept.contains(0) && kept.contains(steps - 1));
      if (limit < 20) continue;  // half of less than 20 has no room for two events with their neighbours
      EXPECT_TRUE(kept.contains(steps / 3)) << steps << " to " << limit;
      EXPECT_TRUE(kept.contains(steps / 2)) << steps << " to " << limit;
    }
  }
}

TEST(ThinForReplay, says_how_many_steps_one_stands_for_and_keeps_the_same_of_every_character) {
  ReportRun run = pair_of(1000).runs[0];
  thin_for_replay(run, 1000);
  EXPECT_EQ(run.steps.size(), 1000U);
  EXPECT_EQ(run.every, 1);
  thin_for_replay(run, 100);
  EXPECT_GE(run.every, 10);
  EXPECT_LE(run.every, 20);
  thin_for_replay(run, 50);
  EXPECT_GE(run.every, 20) << "thinning twice multiplies";
  ASSERT_EQ(run.others[0].size(), run.steps.size());
  for (std::size_t i = 0; i < run.steps.size(); ++i) EXPECT_EQ(run.others[0][i].step, run.steps[i].step);
}

TEST(ThinForReplay, leaves_the_beginning_whole_up_to_what_matters_if_that_is_near) {
  const auto whole = [](int event) {
    ReportRun run = walk_of(1000).runs[0];
    run.events = {{event, ReportEvent::Kind::tunnel, ""}};
    thin_for_replay(run, 100);
    int count = 0;
    while (run.steps[static_cast<std::size_t>(count)].step == count) ++count;
    return count;
  };
  EXPECT_EQ(whole(3), 25) << "a quarter";
  EXPECT_EQ(whole(40), 42) << "with the step after it";
  EXPECT_EQ(whole(48), 50) << "a half";
  EXPECT_EQ(whole(900), 25);
}

TEST(CutToExcerpt, leaves_the_step_that_matters_and_those_around_it) {
  const auto ends_of = [](const std::vector<ReportEvent>& events, int around) {
    ReportRun run = pair_of(100).runs[0];
    for (TraceStep& step : run.steps)
      if (step.step < 30) step.contacts.clear();
    run.others[0].front().contacts.clear();
    run.events = events;
    cut_to_excerpt(run, around);
    EXPECT_EQ(run.others[0].size(), run.steps.size());
    for (const ReportEvent& event : run.events) EXPECT_LE(std::abs(event.step - run.steps[0].step), 2 * around);
    return std::pair(run.steps.front().step, run.steps.back().step);
  };
  using Kind = ReportEvent::Kind;
  EXPECT_EQ(ends_of({}, 4), std::pair(26, 34)) << "the first contact";
  EXPECT_EQ(ends_of({{50, Kind::inside, ""}, {70, Kind::tunnel, ""}, {90, Kind::tunnel, ""}}, 4), std::pair(66, 74));
  EXPECT_EQ(ends_of({{20, Kind::note, ""}, {50, Kind::inside, ""}}, 3), std::pair(47, 53));
  EXPECT_EQ(ends_of({{1, Kind::inside, ""}}, 4), std::pair(0, 5));
}

TEST(OptionsFor, many_runs_share_the_room) {
  EXPECT_EQ(options_for(1).max_replay_steps, ReportOptions{}.max_replay_steps);
  EXPECT_EQ(options_for(0).max_replay_steps, ReportOptions{}.max_replay_steps);
  const std::size_t runs = 221 * 8;
  const auto per_run = static_cast<std::size_t>(options_for(runs).max_replay_steps);
  EXPECT_LE(per_run * runs, 500'000U);
  EXPECT_GT((per_run + 1) * runs, 500'000U);
  EXPECT_EQ(options_for(1'000'000).max_replay_steps, 60);
}

}  // namespace
}  // namespace paperproof::compare
