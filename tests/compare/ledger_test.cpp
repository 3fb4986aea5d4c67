/// The ledger of disagreement on made-up traces: each cause, and a neighbour that is just outside of it.
#include "metrics/ledger.hpp"
#include "compare/judge_steps.hpp"
#include "scenes/formula.hpp"

#include <gtest/gtest.h>

#include <fstream>

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

/// A step by `way` of which `made` is made.
TraceStep step(const Vec2d& from, const Vec2d& way, const Vec2d& made, std::vector<Contact> contacts = {}) {
  TraceStep one = test::step({from, from + made}, way, std::move(contacts));
  one.velocity = made / dt;
  return one;
}

Contact touch(ColliderIndex collider, const Vec2d& normal, const Vec2d& point, double fraction = 0) {
  const Side side = side_of_normal(normal.x(), normal.y());
  return {.collider = collider, .point = point, .normal = normal, .fraction = fraction, .side = side};
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

/// What stands in a ledger, as `cause.kind` in order; a space between.
std::string found_in(const Ledger& ledger) {
  std::string text;
  for (const auto& [key, sum] : ledger.sums())
    text +=
        (text.empty() ? "" : " ") + std::string(name_of(sum.first.cause)) + "." + std::string(name_of(sum.first.kind));
  return text;
}

const Vec2d still(0, 0);

const Contact ground = touch(0, {0, 1}, {-2, 0});

/// So far above the first tile.
Vec2d above(double height) { return {-2, half_height + height}; }
TraceStep stopped(TraceStep one) {
  one.velocity.setZero();
  return one;
}
const Vec2d over_seam(-0.15625, half_height + 0.015);

Vec2d point_of(const Json& two) { return Vec2d(two.at(0), two.at(1)); }

/// A step as disagreements.json tells it: see tables/README.md.
TraceStep step_of(const Json& told) {
  const Vec2d way = point_of(told.at("way"));
  const Vec2d made = told.contains("made") ? point_of(told["made"]) : way;
  TraceStep one = step(point_of(told.at("from")), way, made);
  for (const Json& touched : told.value("contacts", Json::array()))
    one.contacts.push_back(touch(touched.at("with"), point_of(touched.at("normal")), point_of(touched.at("at")),
                                 touched.value("fraction", 0.0)));
  if (told.contains("met")) {
    const Vec2d normal = point_of(told["met"].at("normal"));
    one.met.push_back({.other = 1,
                       .normal = normal,
                       .fraction = told["met"].at("fraction"),
                       .side = side_of_normal(normal.x(), normal.y())});
  }
  one.capped = told.value("capped", false);
  if (told.contains("stays_from"))
    one.path.insert(one.path.begin() + 1, {one.path.back().position, told["stays_from"].get<double>()});
  return told.value("stops", false) ? stopped(one) : one;
}

TEST(Ledger, has_each_cause_and_no_other) {
  const Json file = Json::parse(std::ifstream(PAPERPROOF_SOURCE_DIR "/tests/compare/tables/disagreements.json"));
  for (const Json& story : file.at("stories")) {
    Ledgers ledgers(true);
    for (const Json& both : computed(story.at("steps"), constants())) {
      Json ours = both;
      Json box2d = both;
      ours.update(both.at("ours"));
      box2d.update(both.at("box2d"));
      ledgers.add(step_of(ours), step_of(box2d));
    }
    EXPECT_EQ(found_in(ledgers.finished()), story.at("found")) << story.at("name");
  }
}

TEST(Ledger, names_the_side_that_trembles_at_rest_with_its_reason) {
  Ledgers ledgers(true);
  for (int k = 0; k < 40; ++k) {
    TraceStep mine = step(above(5e-7), {0, -0.001}, still, {ground});
    TraceStep reference = step(above(0.015), {0, -0.001}, still, {ground});
    mine.grounded = reference.grounded = true;
    if (k == 36) reference.contacts.push_back(touch(0, {1, 0}, {0, 0}));
    ledgers.add(mine, reference);
  }
  const Ledger& ledger = ledgers.finished();
  EXPECT_TRUE(found_in(ledger).find("ghost_collision.contact") != std::string::npos) << found_in(ledger);
  EXPECT_EQ(ledger.sums().at({Cause::skin, EventKind::toggle_box2d}).count, 2);
}

TEST(Ledger, counts_apart_what_both_are_right_about_once_they_are_apart) {
  // Step 0: a ghost stops Box2D. Step 1: ours comes to the wall, Box2D is a metre behind.
  Ledgers ledgers(false);
  const Vec2d way(0.2, 0);
  ledgers.add(step(over_seam, {2.75, 0}, {2.75, 0}), step(over_seam, {2.75, 0}, still, {touch(1, {-1, 0}, {0, 0})}));
  ledgers.add(
      stopped(step(over_seam + Vec2d(2.75, 0), way, {0.0937495, 0}, {touch(2, {-1, 0}, {3, half_height}, 0.46875)})),
      step(over_seam, way, way));
  const Ledger& ledger = ledgers.finished();
  EXPECT_EQ(found_in(ledger),
            "ghost_collision.contact ghost_collision.stop after_divergence.contact after_divergence.stop");
  const LedgerEntry& first = ledger.sums().at({Cause::after_divergence, EventKind::contact}).first;
  EXPECT_EQ(first.step, 1);
  EXPECT_NE(first.words.find("apart since step 0 (ghost_collision)"), std::string::npos) << first.words;
}

TEST(Ledger, has_nothing_after_divergence_while_both_are_together) {
  Ledgers ledgers(false);
  const Vec2d from(2.5875, half_height + 0.015);
  const Vec2d way(0.2, 0);
  ledgers.add(stopped(step(from, way, {0.0999995, 0}, {touch(2, {-1, 0}, {3, half_height}, 0.5)})),
              step(from, way, {0.05, 0}));
  EXPECT_EQ(found_in(ledgers.finished()).find("after_divergence"), std::string::npos);
}

}  // namespace
}  // namespace paperproof::compare::test
