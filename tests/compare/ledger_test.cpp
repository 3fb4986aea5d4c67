/// The ledger of disagreement on made-up traces: each cause, and a neighbour that is just outside of it.
#include "metrics/ledger.hpp"
#include "compare/judge_steps.hpp"
#include "compare/table_file.hpp"
#include "records/collider_json.hpp"
#include "scenes/formula.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

TraceHeader header(bool box2d) {
  // Two tiles beside each other, a wall, a slope of 45 degrees, and a floor far down the line.
  TraceHeader made = test::header({box(-4, -1, 0, 0), box(0, -1, 4, 0), box(3, 0, 4, 8),
                                   polygon({{10, 0}, {18, 0}, {18, 8}}), box(-200, -1, -100, 0)},
                                  !box2d);
  made.contender = box2d ? "box2d" : "octagon_sweep";
  made.scalar = box2d ? "float" : "double";
  made.tolerances = {{"hit", 1e-7}, {"stop", 5e-7}, {"touch", 7e-7}};
  return made;
}

/// Steps of the two sides, both judged by exact arithmetic, and the ledger of what they disagree about.
class Ledgers {
 public:
  explicit Ledgers(bool lockstep)
      : ledger_({&mine_header_, &mine_judge_.scenery()}, {&reference_header_, &reference_judge_.scenery()}, lockstep) {}

  void add(TraceStep mine, TraceStep reference) {
    mine.step = reference.step = number_++;
    mine.start_overlap = mine_judge_.scenery().overlapped(Place(mine.path.front().position));
    reference.start_overlap = reference_judge_.scenery().overlapped(Place(reference.path.front().position));
    ledger_.add(mine, mine_judge_.judge(mine), reference, reference_judge_.judge(reference));
  }

  /// Nothing is added any more.
  const Ledger& finished() {
    ledger_.finish();
    return ledger_;
  }

 private:
  const TraceHeader mine_header_ = header(false);
  const TraceHeader reference_header_ = header(true);
  Judge mine_judge_{mine_header_};
  Judge reference_judge_{reference_header_};
  Ledger ledger_;
  int number_ = 0;
};

std::string event_of(const Ledger::Key& key) {
  return std::string(name_of(key.first)) + "." + std::string(name_of(key.second));
}

/// What stands in a ledger, as `cause.kind` in order; a space between.
std::string found_in(const Ledger& ledger) {
  std::string text;
  for (const auto& [key, sum] : ledger.sums()) text += (text.empty() ? "" : " ") + event_of(key);
  return text;
}

/// A step as disagreements.json tells it: see tables/README.md.
TraceStep step_of(const Json& told) {
  const Vec2d way = point_of(told.at("way"));
  const Vec2d made = told.contains("made") ? point_of(told["made"]) : way;
  const Vec2d from = point_of(told.at("from"));
  TraceStep one = step({from, from + made}, way);
  one.velocity = made / dt;
  for (const Json& touched : told.value("contacts", Json::array())) {
    one.contacts.push_back(contact(touched.at("with"), point_of(touched.at("normal")), touched.value("fraction", 0.0)));
    one.contacts.back().point = point_of(touched.at("at"));
  }
  if (told.contains("met")) {
    const Contact touched = contact(0, point_of(told["met"].at("normal")), told["met"].at("fraction"));
    one.met.push_back({.other = 1, .normal = touched.normal, .fraction = touched.fraction, .side = touched.side});
  }
  one.capped = told.value("capped", false);
  if (told.contains("stays_from"))
    one.path.insert(one.path.begin() + 1, {one.path.back().position, told["stays_from"].get<double>()});
  if (told.value("stops", false)) one.velocity.setZero();
  one.grounded = told.value("grounded", false);
  return one;
}

TEST(Ledger, has_each_cause_and_no_other) {
  const Json file = read_table("disagreements.json");
  for (const Json& story : file.at("stories")) {
    SCOPED_TRACE(story.at("name"));
    Ledgers ledgers(story.value("lockstep", true));
    for (const Json& both : computed(story.at("steps"), constants())) {
      Json ours = both;
      Json box2d = both;
      ours.update(both.at("ours"));
      box2d.update(both.at("box2d"));
      for (int times = both.value("times", 1); times > 0; --times) ledgers.add(step_of(ours), step_of(box2d));
    }
    EXPECT_EQ(found_in(ledgers.finished()), story.at("found"));
    const Json counts = story.value("counts", Json::object());
    const Json begins = story.value("begins", Json::object());
    const Json words = story.value("words", Json::object());
    for (const auto& [key, sum] : ledgers.finished().sums()) {
      const std::string event = event_of(key);
      EXPECT_EQ(sum.count, counts.value(event, sum.count)) << event;
      EXPECT_EQ(sum.first_step, begins.value(event, sum.first_step)) << event;
      EXPECT_THAT(sum.first, testing::HasSubstr(words.value(event, "")));
    }
  }
}

}  // namespace
}  // namespace paperproof::compare::test
