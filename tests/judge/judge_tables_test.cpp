/// What the judge tells of traces that are made by hand: the tables of this folder.
#include "judge/row.hpp"
#include "oracle/company.hpp"
#include "oracle/judge.hpp"
#include "records/collider_json.hpp"
#include "records/trace_reader.hpp"
#include "support/expected.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace paperproof::compare::test {
namespace {

/// Several after a word, of each that has some: "inside floor wall, entered floor".
template <class Number>
std::string in_words(const std::vector<std::pair<const char*, std::vector<Number>>>& said, const auto& name) {
  std::string text;
  for (const auto& [word, all] : said) {
    if (!all.empty()) text += (text.empty() ? "" : ", ") + std::string(word);
    for (const Number one : all) text += " " + name(one);
  }
  return text;
}

/// A judgement in JSON, under the names of its members. `solids` has what became of them, `demands` the contacts that
/// should have been reported, `company` what became of other characters.
Json told(const StepJudgement& one, const TraceHeader& header) {
  const auto id = [&](ColliderIndex collider) { return header.ids[collider]; };
  const auto number = [](CharacterIndex character) { return std::to_string(character); };
  const auto ids = [&](const std::vector<ColliderIndex>& all) {
    Json names = Json::array();
    for (const ColliderIndex collider : all) names.push_back(id(collider));
    return names;
  };
  using Touches = std::vector<std::pair<ColliderIndex, Side>>;
  const auto touches = [&](Touches all) {
    std::sort(all.begin(), all.end());
    std::string text;
    for (const auto& [collider, side] : all)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", id(collider), name_of(side));
    return text;
  };
  Json all{{"solids", in_words<ColliderIndex>({{"inside", one.end_overlap},
                                               {"pressed", one.pressed},
                                               {"entered", one.entered},
                                               {"rounded", one.rounded},
                                               {"drawn", one.drawn},
                                               {"tunnelled", one.tunnelled},
                                               {"clipped", one.clipped},
                                               {"one-way broken", one.one_way_broken},
                                               {"crushed", one.crushed},
                                               {"crushed with room", one.crushed_with_room}},
                                              id)},
           {"company", in_words<CharacterIndex>({{"inside", one.company.overlap},
                                                 {"entered", one.company.entered},
                                                 {"passed", one.company.passed},
                                                 {"clipped", one.company.clipped}},
                                                number)},
           {"broke", one.broke()}};
  all.update({{"hangs", one.hangs},
              {"hovers", one.hovers},
              {"unsure", one.unsure},
              {"in_parts", one.in_parts},
              {"stuck_refuted", one.stuck_refuted},
              {"ground_refuted", one.ground_refuted},
              {"ground_late", one.ground_late},
              {"ground_missed", one.ground_missed},
              {"ground_left", one.ground_left},
              {"kerb_missed", one.kerb_missed},
              {"turning_sensor", one.turning_sensor},
              {"beside_another", one.beside_another},
              {"excused_crush", one.excused_crush},
              {"room", one.room.has_value()},
              {"first_impact_comparable", one.first_impact_comparable}});
  all.update({{"max_penetration", one.max_penetration},
              {"clipped_depth", one.clipped_depth},
              {"max_contact_gap", one.max_contact_gap},
              {"motion_wanted", one.motion_wanted},
              {"motion_lost", one.motion_lost},
              {"ghost_speed_loss", one.ghost_speed_loss},
              {"speed_lost", one.speed_lost},
              {"speed_gained", one.speed_gained},
              {"way_gained", one.way_gained},
              {"sensor_events_missing", one.sensor_events_missing},
              {"sensor_events_extra", one.sensor_events_extra},
              {"max_sensor_error", one.max_sensor_error}});
  for (const auto& [name, value] : {std::pair{"first_impact", &one.first_impact},
                                    {"normal_error", &one.normal_error},
                                    {"turning_toi_error", &one.turning_toi_error}})
    all[name] = *value ? Json(**value) : Json("none");
  all.update({{"dont_care", ids(one.dont_care)},
              {"undecided", ids(one.undecided)},
              {"methods_disagree", ids(one.methods_disagree)},
              {"deflected", touches(one.deflected)},
              {"contact_band", touches(one.contact_band)},
              {"ghosts", touches(one.ghosts)}});
  Touches demanded;
  all["contacts"] = all["passings"] = all["sensor_events"] = Json::array();
  for (const ExactContact& contact : one.contacts) {
    demanded.emplace_back(contact.collider, contact.side);
    all["contacts"].push_back(Json{{"normal", point_json(contact.normal)}, {"fraction", contact.fraction}});
  }
  all["demands"] = touches(demanded);
  for (const Passing& passing : one.passings)
    all["passings"].push_back(
        Json{{"speed", passing.speed}, {"thickness", passing.thickness}, {"angle", passing.angle}});
  for (const ExactSensorEvent& event : one.sensor_events)
    all["sensor_events"].push_back(
        Json{{"change", name_of(event.change)}, {"fraction", static_cast<double>(event.fraction)}});
  return all;
}

bool is_so(const Json& object, const char* key) { return paperproof::test::is_true(object.value(key, Json(false))); }

using Turn = Eigen::Rotation2D<double>;

/// Everything about the origin, and up with it. No row needs it of contacts, sensors or what turns.
void turn(const Turn& by, TraceHeader& header, std::vector<TraceStep>& steps) {
  const auto turn = [&by](Vec2d& v) { v = by * v; };
  turn(header.up);
  turn(header.gravity);
  for (Vec2d& point : header.points) turn(point);
  for (ColliderDef& collider : header.scenery.colliders)
    for (Vec2d& point : collider.points) turn(point);
  for (TraceStep& step : steps) {
    for (PathPoint& corner : step.path) turn(corner.position);
    for (MoverMotion& mover : step.movers) {
      turn(mover.from);
      turn(mover.to);
    }
    turn(step.velocity);
    turn(step.requested);
  }
}

/// A displacement that is not said is the one that was requested, a velocity the one that makes it.
Wanted wanted_of(const Json& said, const TraceStep& step, const TraceHeader& header, const Turn& by) {
  paperproof::test::refuse_other_keys(said, " displacement velocity steered carried ridden jumped parts from_ground ",
                                      "wanted");
  const auto vector = [&](const char* key, const Vec2d& otherwise) -> Vec2d {
    return said.contains(key) ? Vec2d(by * said[key].get<Vec2d>()) : otherwise;
  };
  Wanted wanted;
  wanted.displacement = vector("displacement", step.requested);
  wanted.velocity = vector("velocity", wanted.displacement / length_of(step, header));
  wanted.carried = vector("carried", {0, 0});
  wanted.steered = said.value("steered", 0.0);
  if (said.contains("ridden")) {
    const auto ridden = std::find(header.ids.begin(), header.ids.end(), said["ridden"].get<std::string>());
    wanted.ridden = static_cast<ColliderIndex>(ridden - header.ids.begin());
  }
  wanted.jumped = is_so(said, "jumped");
  wanted.from_ground = is_so(said, "from_ground");
  wanted.parts = said.value("parts", 1);
  return wanted;
}

/// Of clauses the steps that break them, and `unlike` those of which the checker in Python has other words: what is
/// excused, what movers crush, and a stay inside after its first step.
void note_broken(const StepJudgement& one, const TraceStep& step, Json& broken) {
  const auto note = [&](const char* clause, bool so) {
    if (so) broken[clause].push_back(step.step);
  };
  note("overlap", !one.entered.empty() || !one.company.entered.empty());
  note("passage", !one.tunnelled.empty() || !one.company.passed.empty());
  note("one_way", !one.one_way_broken.empty());
  note("unlike", !one.rounded.empty() || !one.drawn.empty() || one.clips() || !step.crushed.empty() ||
                     one.end_overlap != one.entered || !one.pressed.empty());
}

class JudgeTables : public ::testing::TestWithParam<Row> {
 protected:
  /// Kept where the test fails.
  [[nodiscard]] static std::string file() {
    return ::testing::TempDir() + "judged_" + std::to_string(getpid()) + "_" + GetParam().name + ".jsonl";
  }

  /// As a reader of traces has it.
  static std::pair<TraceHeader, std::vector<TraceStep>> read(const RowTrace& trace) {
    {
      std::ofstream out(file());
      out << trace.header.dump() << "\n";
      for (const Json& record : trace.records) out << record.dump() << "\n";
    }
    TraceReader reader(file());
    std::vector<TraceStep> steps;
    while (std::optional<TraceStep> step = reader.next()) steps.push_back(std::move(*step));
    return {reader.header(), std::move(steps)};
  }

  static void run(const RowTrace& trace) {
    auto [header, steps] = read(trace);
    const Turn by(trace.turned);
    if (trace.turned != 0) turn(by, header, steps);
    std::vector<std::unique_ptr<Judge>> judges;
    for (std::size_t i = 0; i < header.characters; ++i) judges.push_back(std::make_unique<Judge>(header));
    CompanyJudge company(header);
    Json broken = Json::object();
    for (std::size_t first = 0; first < steps.size(); first += header.characters) {
      std::vector<StepJudgement> judgements;
      for (std::size_t i = 0; i < header.characters; ++i) {
        const TraceStep& step = steps.at(first + i);
        const Json& beside = trace.beside[first + i];
        std::optional<Wanted> wanted;
        if (beside.contains("wanted")) wanted = wanted_of(beside["wanted"], step, header, by);
        judgements.push_back(judges[i]->judge(step, wanted ? &*wanted : nullptr, is_so(beside, "beside_another")));
      }
      if (header.characters > 1) company.judge(std::span(steps).subspan(first, header.characters), judgements);
      for (std::size_t i = 0; i < header.characters; ++i) {
        const Json& beside = trace.beside[first + i];
        SCOPED_TRACE(fmt::format("record {}: {}", first + i, beside.value("what", "")));
        note_broken(judgements[i], steps[first + i], broken);
        Json tells{{"solids", ""}};
        tells.update(beside.value("tells", Json::object()));
        EXPECT_EQ(missed(tells, told(judgements[i], header)), "");
      }
    }
    if (const char* folder = std::getenv("PAPERPROOF_JUDGE_TRACES"); folder != nullptr && header.path_exact) {
      static int number = 0;
      const std::string stem = fmt::format("{}/{}.{}", folder, GetParam().name, ++number);
      std::filesystem::copy_file(file(), stem + ".jsonl");
      std::ofstream(stem + ".json") << broken.dump();
    }
  }
};

TEST_P(JudgeTables, are_what_the_judge_tells) {
  for (const RowCase& one : cases_of(GetParam()))
    for (const RowTrace& trace : traces_of(one)) {
      SCOPED_TRACE(trace.title + "\n" + file());
      run(trace);
      if (HasFailure()) return;
    }
  std::filesystem::remove(file());
}

INSTANTIATE_TEST_SUITE_P(All, JudgeTables, ::testing::ValuesIn(read_rows(PAPERPROOF_JUDGE_TABLES)),
                         [](const auto& row) { return row.param.name; });

TEST(JudgeTable, that_no_judge_could_miss_is_refused) {
  EXPECT_EQ(missed(Json{{"hangs", true}}, Json{{"hangs", false}}), "\nhangs is false instead of true within 0");
  EXPECT_THROW((void)missed(Json{{"hang", true}}, Json{{"hangs", false}}), std::invalid_argument) << "no such answer";
  for (const char* said : {R"({"hangs": {"abov": 1}})", R"({"hangs": {}})", R"({"hangs": {"within": 1}})"})
    EXPECT_THROW((void)missed(Json::parse(said), Json{{"hangs", false}}), std::invalid_argument) << said;
  for (const char* said :
       {R"({"stpes": [], "step": {"path": [[0, 0]]}})", R"({"contender": "sombody", "step": {"path": [[0, 0]]}})",
        R"({"colliders": [{"chain": [[0, 0], [1, 0]], "goes": "strait"}], "step": {"path": [[0, 0]]}})",
        R"({"step": {"path": [[0, 0]], "movers": {"lift": [0, 1]}}})"})
    EXPECT_THROW((void)traces_of({.title = "", .said = Json::parse(said)}), std::invalid_argument) << said;
}

}  // namespace
}  // namespace paperproof::compare::test
