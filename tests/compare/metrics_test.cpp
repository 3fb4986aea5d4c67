/// What a row says of a made-up run: the rows of metrics.json.
#include "metrics/metrics.hpp"

#include "compare/moments.hpp"
#include "compare/table_file.hpp"
#include "records/collider_json.hpp"
#include "records/metric.hpp"
#include "records/rows_json.hpp"
#include "scenes/formula.hpp"
#include "support/expected.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>

namespace paperproof {

const std::map<std::string, Side> sides{
    {"left", Side::left}, {"right", Side::right}, {"top", Side::top}, {"bottom", Side::bottom}};
inline void from_json(const nlohmann::json& name, Side& side) { side = sides.at(name); }
inline void to_json(nlohmann::json& name, Side side) { name = compare::name_of(side); }

namespace compare {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Passing, collider, speed, thickness, angle)
/// The members that a row may name; `others` has the remaining keys.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(StepJudgement, end_overlap, drawn, pressed, tunnelled, passings,
                                                clipped, clipped_depth, crushed, crushed_with_room, excused_crush,
                                                dont_care, contact_band, deflected, ghosts, first_impact_comparable,
                                                hovers, motion_wanted, motion_lost, stuck_refuted, ground_refuted,
                                                ground_late, ghost_speed_loss, beside_another)

namespace {

/// What else may be so in a step, or may have been made of it.
const std::map<std::string, std::function<void(const Json&, TraceStep&, StepJudgement&)>> others{
    {"times", [](const Json&, TraceStep&, StepJudgement&) {}},
    {"stuck", [](const Json& said, TraceStep& step, StepJudgement&) { step.stuck = said; }},
    {"grounded",
     [](const Json& said, TraceStep& step, StepJudgement&) { step.grounded = paperproof::test::is_true(said); }},
    {"at", [](const Json& at, TraceStep& step, StepJudgement&) { step.path.back().position = point_of(at); }},
    {"path",
     [](const Json& corners, TraceStep& step, StepJudgement&) {
       step.path.clear();
       for (const Json& corner : corners) step.path.push_back({point_of(corner), corner.at(2)});
     }},
    {"requested", [](const Json& way, TraceStep& step, StepJudgement&) { step.requested = point_of(way); }},
    {"movers",
     [](const Json& all, TraceStep& step, StepJudgement&) {
       for (const Json& ends : all) step.movers.push_back({point_of(ends.at(0)), point_of(ends.at(1))});
     }},
    {"contacts",
     [](const Json& all, TraceStep& step, StepJudgement&) {
       for (const Json& one : all)
         step.contacts.push_back(contact(one.at("with"), sides.at(one.at("side")), one.value("fraction", 0.0)));
     }},
    {"met",
     [](const Json& all, TraceStep& step, StepJudgement&) {
       for (const Json& one : all)
         step.met.push_back(
             {.other = one.at("with"), .fraction = one.at("fraction"), .side = sides.at(one.at("side"))});
     }},
    {"truth",
     [](const Json& all, TraceStep&, StepJudgement& judged) {
       for (const Json& one : all) judged.contacts.push_back(exact(one.at(0), sides.at(one.at(1))));
     }},
    {"first_impact",
     [](const Json& at, TraceStep&, StepJudgement& judged) { judged.first_impact = at.get<double>(); }}};

Moment moment_of(const Json& told) {
  static const nlohmann::json plain = StepJudgement();
  Moment made = moment(0);
  made.judged = nlohmann::json(told).get<StepJudgement>();
  for (const auto& [key, value] : told.items())
    if (!plain.contains(key)) others.at(key)(value, made.step, made.judged);
  return made;
}

/// The row of a made-up run.
Row row_of(const Json& told) {
  const std::string contender = told.value("contender", "mine");
  const int characters = told.value("characters", 1);
  TraceHeader head = header(contender.c_str(), static_cast<std::size_t>(characters));
  head.dt = told.value("dt", head.dt);
  if (told.value("mover", false)) head.scenery.colliders[1].mover = 0;
  Metrics metrics(head);
  Breaches breaches;
  int number = 0;
  for (const Json& one : told.at("run")) {
    Moment made = moment_of(one);
    for (int times = one.value("times", 1); times > 0; --times, ++number) {
      made.step.step = number / characters;
      made.step.character = static_cast<CharacterIndex>(number % characters);
      metrics.add(made.step, made.judged, breaches);
    }
  }
  Row row;
  metrics.write(row);
  row.steps = number / characters;  // without it a row has no exemptions
  return row;
}

TEST(Metrics, of_a_run_that_was_made_up_are_those_of_its_row) {
  for (const Json& text : read_table("metrics.json")) {
    for (const Values& values : cases_of(text.value("for", Json::object()), constants())) {
      const Json told = computed(text, values);
      const Row row = row_of(told);
      const Json written = row_json(row);
      for (const auto& [key, expected] : told.at("row").items()) {
        const Json found = written.value(key, Json());
        EXPECT_TRUE(!expected.is_null() || find_metric(key) != nullptr) << "no metric is called " << key;
        if (told.contains("within"))
          EXPECT_NEAR(found.get<double>(), expected.get<double>(), told["within"].get<double>()) << text["what"] << key;
        else
          EXPECT_EQ(found, expected) << text["what"] << ": " << key;
      }
      if (told.contains("words")) {
        EXPECT_EQ(row.first_tunnel.value().words, told["words"]);
      }
    }
  }
}

}  // namespace
}  // namespace compare
}  // namespace paperproof
