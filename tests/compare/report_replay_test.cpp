/// The replay in a report: what comes back from its columns, and what is left out.
#include "compare/report_pages.hpp"

#include <cmath>
#include <limits>
#include <map>

namespace paperproof::compare {
namespace {

struct DecodedStep {
  int step = 0;
  std::vector<Vec2d> corners;
  std::vector<double> fractions;
  Vec2d velocity{Vec2d::Zero()};
  int flags = 0;
  std::vector<Contact<double>> contacts;
};

/// Reads a run back as run_json.hpp describes it, without the writer's code.
class Decoder {
 public:
  Decoder(const json& run, double quantum) : run_(run), quantum_(quantum) {}

  std::vector<DecodedStep> steps() {
    std::vector<DecodedStep> all;
    const std::string flags = run_["flags"];
    int number = 0;
    for (std::size_t i = 0; i < run_["step"].size(); ++i) {
      DecodedStep step;
      number += run_["step"][i].get<int>();
      step.step = number;
      step.flags = flags[i] - '0';
      read_path(step);
      velocity_ += pair("velocity");
      step.velocity = velocity_ * quantum_ * 10;
      read_contacts(step);
      all.push_back(step);
    }
    return all;
  }

 private:
  double next(const char* column) { return run_[column][at_[column]++].get<double>(); }
  Vec2d pair(const char* column) {
    const double x = next(column);
    return {x, next(column)};
  }

  void read_path(DecodedStep& step) {
    const double count = next("path");
    if (count == 0) step.corners.push_back(position_ * quantum_);
    for (double i = 0; i < std::max(count, 1.0) && count >= 0; ++i) {
      position_ += pair("path");
      step.corners.push_back(position_ * quantum_);
      if (count > 0) step.fractions.push_back(next("path") / 10'000);
    }
  }

  void read_contacts(DecodedStep& step) {
    for (double left = next("contacts"); left > 0; --left) {
      const auto kind = static_cast<std::size_t>(next("contacts"));
      relative_.resize(std::max(relative_.size(), kind + 1), Vec2d::Zero());
      relative_[kind] += pair("contacts");
      Contact<double> contact;
      contact.point = (position_ + relative_[kind]) * quantum_;
      contact.fraction = next("contacts") / 10'000;
      contact.separation = next("contacts");
      contact.collider = run_["kinds"][4 * kind].get<ColliderIndex>();
      contact.side = static_cast<Side>(run_["kinds"][4 * kind + 1].get<int>());
      contact.normal = Vec2d(run_["kinds"][4 * kind + 2], run_["kinds"][4 * kind + 3]) / 10'000;
      step.contacts.push_back(contact);
    }
  }

  const json& run_;
  double quantum_;
  std::map<std::string, std::size_t> at_;
  Vec2d position_{Vec2d::Zero()};
  Vec2d velocity_{Vec2d::Zero()};
  std::vector<Vec2d> relative_;
};

void expect_near(const Vec2d& a, const Vec2d& b, double tolerance, int step) {
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance) << "in step " << step;
}

void expect_same_contacts(const std::vector<Contact<double>>& shown, const std::vector<Contact<double>>& real,
                          double half_unit, int step) {
  ASSERT_EQ(shown.size(), real.size()) << "in step " << step;
  for (std::size_t i = 0; i < real.size(); ++i) {
    expect_near(shown[i].point, real[i].point, half_unit, step);
    expect_near(shown[i].normal, real[i].normal, 0.5e-4, step);
    EXPECT_EQ(shown[i].collider, real[i].collider);
    EXPECT_EQ(shown[i].side, real[i].side);
    EXPECT_LE(std::abs(shown[i].fraction - real[i].fraction), 0.5e-4);
    EXPECT_LE(std::abs(shown[i].separation - real[i].separation), 0.5e-2 * std::abs(real[i].separation));
  }
}

/// Half a display unit, and the rounding of a number of this size.
double half_unit(double quantum, double size) {
  return 0.5 * quantum + 8 * size * std::numeric_limits<double>::epsilon();
}

void expect_same_run(const json& shown, const ReportRun& real, double quantum) {
  const std::vector<DecodedStep> steps = Decoder(shown, quantum).steps();
  ASSERT_EQ(steps.size(), real.steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const TraceStep& step = real.steps[i];
    const double half = half_unit(quantum, step.path.back().position.cwiseAbs().maxCoeff());
    EXPECT_EQ(steps[i].step, step.step);
    EXPECT_EQ((steps[i].flags & 1) != 0, step.grounded);
    EXPECT_EQ((steps[i].flags & 2) != 0, step.jumping);
    ASSERT_EQ(steps[i].corners.size(), step.path.size());
    for (std::size_t k = 0; k < step.path.size(); ++k) {
      expect_near(steps[i].corners[k], step.path[k].position, half, step.step);
      if (!steps[i].fractions.empty()) {
        EXPECT_LE(std::abs(steps[i].fractions[k] - step.path[k].fraction), 0.5e-4);
      }
    }
    expect_near(steps[i].velocity, step.velocity, half_unit(quantum * 10, 200), step.step);
    expect_same_contacts(steps[i].contacts, step.contacts, half, step.step);
  }
}

TEST_F(ReportTest, every_step_comes_back_to_half_a_display_unit) {
  const Report report = sample_report();
  const std::string text = page(report);
  for (std::size_t scene = 0; scene < report.scenes.size(); ++scene) {
    const json replay = data(text, "replay-" + std::to_string(scene));
    const double quantum = replay["quantum"];
    EXPECT_LE(quantum, 1.25e-4) << "a ten-thousandth of the character";
    for (std::size_t run = 0; run < report.scenes[scene].runs.size(); ++run) {
      expect_same_run(replay["runs"][run], report.scenes[scene].runs[run], quantum);
    }
  }
}

/// What the column of movers says, as run_json.hpp describes it.
std::vector<std::vector<MoverMotion<double>>> decoded_movers(const json& run, std::size_t movers, double quantum) {
  std::size_t at = 0;
  const auto pair = [&] {
    const double x = run["movers"][at++];
    return Vec2d(x, run["movers"][at++]);
  };
  std::vector<Vec2d> place(movers, Vec2d::Zero());
  std::vector<Vec2d> way(movers, Vec2d::Zero());
  std::vector<std::vector<MoverMotion<double>>> steps(run["step"].size());
  for (auto& step : steps) {
    const bool jumped = run["movers"][at++] == 1;
    for (std::size_t i = 0; i < movers; ++i) {
      if (jumped) place[i] += pair();
      way[i] += pair();
      step.push_back({place[i] * quantum, (place[i] + way[i]) * quantum});
      place[i] += way[i];
    }
  }
  EXPECT_EQ(at, run["movers"].size());
  return steps;
}

TEST_F(ReportTest, movers_come_back_to_half_a_display_unit_also_across_steps_that_were_left_out) {
  ReportScene scene = walk_of(400);
  ReportRun& run = scene.runs[0];
  for (TraceStep& step : run.steps) {
    const auto at = [](int number) { return Vec2d(3 * std::sin(number * 0.05), number * 0.01); };
    step.movers = {{at(step.step), at(step.step + 1)}, {{7, 7}, {7, 7}}};
  }
  run.header.scenery.colliders[0].mover = 1;
  run.header.scenery.colliders[2].mover = 0;
  run.header.scenery.colliders[3].mover = 0;
  run.header.scenery.colliders[1].sensor = true;
  std::erase_if(run.steps, [](const TraceStep& step) { return step.step > 100 && step.step % 7 != 0; });
  const json replay = data(page(report_of(scene)), "replay-0");
  const double quantum = replay["quantum"];
  const auto movers = decoded_movers(replay["runs"][0], 2, quantum);
  ASSERT_EQ(movers.size(), run.steps.size());
  for (std::size_t i = 0; i < movers.size(); ++i) {
    for (std::size_t m = 0; m < 2; ++m) {
      expect_near(movers[i][m].from, run.steps[i].movers[m].from, half_unit(quantum, 10), run.steps[i].step);
      expect_near(movers[i][m].to, run.steps[i].movers[m].to, half_unit(quantum, 10), run.steps[i].step);
    }
  }
  const auto rest = static_cast<int>(run.header.ids.size()) - 4;
  EXPECT_EQ(replay["sceneries"][0]["movers"], (json{2, 1, 0, 1, 1, 2, 0, rest}));
  EXPECT_EQ(replay["sceneries"][0]["sensors"], json{1});
}

TEST_F(ReportTest, what_is_drawn_between_two_squares_comes_back_where_it_is) {
  const ReportScene scene = sample_report().scenes[6];
  const json replay = data(page(report_of(scene)), "replay-0");
  const json& remainder = replay["runs"][0]["remainder"];
  const std::vector<TraceStep>& steps = scene.runs[0].steps;
  int between = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string key = std::to_string(i);
    ASSERT_EQ(remainder.contains(key), !steps[i].remainder.isZero(0)) << i;
    if (!remainder.contains(key)) continue;
    const Vec2d read = Vec2d(remainder[key][0], remainder[key][1]) * replay["quantum"].get<double>();
    expect_near(read, steps[i].remainder, half_unit(replay["quantum"], 1), steps[i].step);
    ++between;
  }
  EXPECT_GE(between, 25);
  const json others = data(page(report_of(sample_report().scenes[0])), "replay-0");
  EXPECT_FALSE(others["runs"][0].contains("remainder")) << "nothing of it where there is none";
}

TEST_F(ReportTest, every_character_comes_back_with_whom_it_met) {
  const ReportScene scene = sample_report().scenes[4];
  const json replay = data(page(report_of(scene)), "replay-0");
  const json& run = replay["runs"][0];
  ASSERT_EQ(run["others"].size(), 1U);
  const double quantum = replay["quantum"];
  const std::vector<TraceStep>& sent = scene.runs[0].others[0];
  const std::vector<DecodedStep> read = Decoder(run["others"][0], quantum).steps();
  ASSERT_EQ(read.size(), sent.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_LE((read[i].corners.back() - sent[i].path.back().position).cwiseAbs().maxCoeff(), 0.51 * quantum) << i;
    EXPECT_EQ(run["others"][0]["met"].contains(std::to_string(i)), !sent[i].met.empty()) << i;
  }
  EXPECT_EQ(run["others"][0]["met"]["20"], json::parse("[0, 1, 0, 10000, 5000]"));
  EXPECT_EQ(run["events"][0][3], 1);
}

TEST_F(ReportTest, a_run_without_movers_has_no_column_for_them) {
  const json replay = data(page(report_of(walk_of(3))), "replay-0");
  EXPECT_FALSE(replay["runs"][0].contains("movers") || replay["runs"][0].contains("crush"));
  EXPECT_FALSE(replay["sceneries"][0].contains("movers") || replay["sceneries"][0].contains("sensors"));
}

TEST_F(ReportTest, a_crush_comes_back_with_the_colliders_that_did_it) {
  ReportScene scene = walk_of(5);
  scene.runs[0].steps[3].crushed = {2, 5};
  const json replay = data(page(report_of(scene)), "replay-0");
  EXPECT_EQ(replay["runs"][0]["crush"], (json{{"3", {2, 5}}}));
  EXPECT_TRUE(replay["sceneries"][0]["ids"].contains("5"));
}

TEST_F(ReportTest, an_event_comes_back_with_the_collider_that_it_is_about) {
  const json runs = data(page(report_of(sample_report().scenes[0])), "replay-0")["runs"];
  EXPECT_EQ(runs[1]["events"][0][1], "tunnel");
  EXPECT_EQ(runs[1]["events"][0][4], 0) << "the paper";
}

TEST_F(ReportTest, a_drop_comes_back_with_the_chains_it_goes_through) {
  ReportScene scene = walk_of(5);
  scene.runs[0].steps[2].dropped_through = {16};
  const json replay = data(page(report_of(scene)), "replay-0");
  EXPECT_EQ(replay["runs"][0]["drop"], (json{{"2", {16}}}));
  EXPECT_EQ(replay["sceneries"][0]["ids"]["16"], "ledge");
}

TEST_F(ReportTest, steps_with_lengths_of_their_own_come_back_with_these) {
  ReportScene scene = walk_of(5);
  EXPECT_FALSE(data(page(report_of(scene)), "replay-0").contains("dt_list"));
  scene.dt_list = {1.0 / 64, 31.0 / 1024};
  EXPECT_EQ(data(page(report_of(scene)), "replay-0")["dt_list"], (json{0.015625, 0.0302734375}));
}

TEST_F(ReportTest, flags_and_overlaps_come_back) {
  ReportScene scene = walk_of(3);
  TraceStep& step = scene.runs[0].steps[1];
  step.grounded = step.jumping = false;
  step.respawn = step.stuck = step.dropped = step.capped = true;
  step.start_overlap = {4, 0};
  const json run = data(page(report_of(scene)), "replay-0")["runs"][0];
  EXPECT_EQ(Decoder(run, 1).steps()[1].flags, 4 + 8 + 16 + 32);
  EXPECT_EQ(run["start_overlap"], (json{{"1", {4, 0}}}));
}

TEST_F(ReportTest, ten_thousand_kilometres_from_the_origin_steps_still_come_back) {
  ReportScene scene = walk_of(20);
  for (TraceStep& step : scene.runs[0].steps) {
    for (PathPoint<double>& corner : step.path) corner.position.x() += 1e7;
    for (Contact<double>& contact : step.contacts) contact.point.x() += 1e7;
  }
  const json replay = data(page(report_of(scene)), "replay-0");
  expect_same_run(replay["runs"][0], scene.runs[0], replay["quantum"]);
}

TEST_F(ReportTest, a_tiny_character_gets_a_finer_unit) {
  ReportScene scene = walk_of(2);
  for (Vec2d& point : scene.runs[0].header.points) point *= 1e-4;
  const double quantum = data(page(report_of(scene)), "replay-0")["quantum"];
  EXPECT_LE(quantum, 1.25e-8);
  EXPECT_GT(quantum, 1.25e-10);
}

TEST_F(ReportTest, colliders_come_back_where_they_are) {
  const Report report = sample_report();
  const json replay = data(page(report), "replay-1");
  const json& scenery = replay["sceneries"][0];
  const double quantum = replay["quantum"];
  const std::vector<ColliderDef>& real = report.scenes[1].runs[0].header.scenery.colliders;
  std::size_t collider = 0;
  Vec2d origin = Vec2d::Zero();
  for (std::size_t run = 0; run < scenery["order"].size(); run += 2) {
    const json& shape = scenery["shapes"][scenery["order"][run].get<std::size_t>()];
    for (int n = 0; n < scenery["order"][run + 1].get<int>(); ++n, ++collider) {
      ASSERT_LT(collider, real.size());
      EXPECT_EQ(shape[0] == 1, real[collider].shape == ColliderDef::Shape::chain);
      EXPECT_EQ(shape.size() == 3, real[collider].one_way.has_value());
      EXPECT_EQ(shape[1].size(), 1 + real[collider].holes.size());
      origin += Vec2d(scenery["at"][2 * collider], scenery["at"][2 * collider + 1]) * scenery["unit"].get<double>();
      Vec2d vertex = origin;
      ASSERT_EQ(shape[1][0].size(), 2 * real[collider].points.size());
      for (std::size_t i = 0; i < real[collider].points.size(); ++i) {
        vertex += Vec2d(shape[1][0][2 * i], shape[1][0][2 * i + 1]);
        expect_near(vertex * quantum, real[collider].points[i], half_unit(quantum, 30), static_cast<int>(collider));
      }
    }
  }
  EXPECT_EQ(collider, real.size());
}

TEST_F(ReportTest, runs_over_the_same_scenery_share_it) {
  ReportScene scene = sample_report().scenes[1];
  EXPECT_EQ(data(page(report_of(scene)), "replay-0")["sceneries"].size(), 1U);
  const double nudge = 1e-6;  // less than is shown, as rounding to float would do
  scene.runs[1].header.scenery.colliders[0].points[0].x() += nudge;
  EXPECT_EQ(data(page(report_of(scene)), "replay-0")["sceneries"].size(), 1U);
  scene.runs[1].header.scenery.colliders[0].points[0].x() -= 0.5;
  const json replay = data(page(report_of(scene)), "replay-0");
  EXPECT_EQ(replay["sceneries"].size(), 2U);
  EXPECT_EQ(replay["runs"][0]["scenery"], 0);
  EXPECT_EQ(replay["runs"][1]["scenery"], 1);
}

TEST_F(ReportTest, a_level_of_equal_tiles_takes_a_few_bytes_for_each) {
  ReportScene scene = walk_of(2);
  SceneryDef& scenery = scene.runs[0].header.scenery;
  const ColliderDef tile = scenery.colliders[0];
  scenery.colliders.clear();
  constexpr int tiles = 5000;
  for (int i = 0; i < tiles; ++i) {
    scenery.colliders.push_back(tile);
    for (Vec2d& point : scenery.colliders.back().points) point += Vec2d(i % 250, i / 250);
  }
  const std::string packed = data(page(report_of(scene)), "replay-0")["sceneries"][0].dump();
  EXPECT_LT(packed.size(), 5U * tiles) << "\"1,0,\" and a little for each new row";
}

TEST_F(ReportTest, a_stored_step_takes_about_thirty_bytes) {
  constexpr int steps = 1200;
  const std::size_t few = page(report_of(walk_of(steps / 2))).size();
  const std::size_t many = page(report_of(walk_of(steps))).size();
  EXPECT_LT(many - few, 32U * steps / 2);
}

TEST_F(ReportTest, steps_from_the_first_position_that_is_not_finite_are_left_out) {
  ReportScene scene = walk_of(10);
  scene.runs[0].steps[6].path[1].position.y() = std::numeric_limits<double>::quiet_NaN();
  const json run = data(page(report_of(scene)), "replay-0")["runs"][0];
  EXPECT_EQ(run["step"].size(), 6U);
  EXPECT_EQ(run["not_finite_from"], 6);
}

TEST_F(ReportTest, disagreements_beyond_the_limit_are_counted) {
  ReportScene scene = sample_report().scenes[2];
  const Disagreement model = scene.disagreements[0];
  scene.disagreements.assign(9, model);
  ReportOptions options;
  options.max_disagreements = 4;
  const json replay = data(page(report_of(scene), options), "replay-0");
  EXPECT_EQ(replay["disagreements"].size(), 4U);
  EXPECT_EQ(replay["disagreements_in_all"], 9);
  EXPECT_EQ(replay["disagreements"][0]["step"], model.step);
  EXPECT_EQ(replay["disagreements"][0]["statements"][0]["contacts"][0][0], model.statements[0].contacts[0].collider);
  EXPECT_TRUE(replay["disagreements"][0].contains("exact"));
}

}  // namespace
}  // namespace paperproof::compare
