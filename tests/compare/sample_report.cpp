#include "compare/sample_report.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

constexpr double dt = 1.0 / 60;

/// The article's octagon at 32 pixels per metre, counter-clockwise around the middle of its 20 x 40 px rectangle.
std::vector<Vec2d> octagon() {
  std::vector<Vec2d> points;
  for (const auto& [x, y] :
       {std::pair{-5, -20}, {5, -20}, {10, -10}, {10, 10}, {5, 20}, {-5, 20}, {-10, 10}, {-10, -10}}) {
    points.emplace_back(x / 32.0, y / 32.0);
  }
  return points;
}

ColliderDef box(double left, double bottom, double right, double top) {
  return {ColliderDef::Shape::polygon, {{left, bottom}, {right, bottom}, {right, top}, {left, top}}};
}

TraceHeader header(const std::string& scene, const std::string& contender) {
  TraceHeader made;
  made.scene = scene;
  made.contender = contender;
  made.scalar = "double";
  made.dt = dt;
  made.points = octagon();
  made.path_exact = contender != "box2d";
  if (!made.path_exact) made.box2d = "2.4.1";
  return made;
}

TraceStep straight_step(int number, const Vec2d& from, const Vec2d& to) {
  TraceStep step;
  step.step = number;
  step.path = {{from, 0}, {to, 1}};
  step.requested = to - from;
  step.velocity = (to - from) / dt;
  return step;
}

Row row(const std::string& scene, const std::string& contender, int steps) {
  Row made;
  made.scene = scene;
  made.contender = contender;
  made.steps = steps;
  made.tunnels = 0;
  made.steps_ending_inside = 0;
  made.max_penetration_m = 0;
  return made;
}

// --- scene 0: 2 m per step down onto 1 cm of paper ---

constexpr double paper_top = 0.01;
constexpr double feet = 20 / 32.0;

ReportRun bullet_run(const std::string& contender, bool stops, double gap) {
  ReportRun run;
  run.header = header("bullet", contender);
  run.header.scenery.colliders = {box(-4, 0, 4, paper_top), box(-4, -6, 4, -5)};
  run.header.ids = {"paper", "floor"};
  Vec2d position{0, 5};
  for (int number = 0; number < 12; ++number) {
    const double wanted = position.y() - 2;
    const double lowest = (stops ? paper_top : -5) + feet + gap;
    TraceStep step = straight_step(number, position, {0, std::max(wanted, lowest)});
    if (wanted < lowest) {
      const double fraction = (position.y() - lowest) / 2;
      step.path = {{position, 0}, {{0, lowest}, fraction}, {{0, lowest}, 1}};
      step.contacts = {{stops ? 0U : 1U, {0, lowest - feet - gap}, {0, 1}, fraction, gap, Side::bottom}};
      step.velocity = Vec2d::Zero();
      step.grounded = true;
    }
    position = step.path.back().position;
    run.steps.push_back(step);
  }
  return run;
}

ReportScene bullet_scene() {
  ReportScene scene;
  scene.name = "bullet";
  scene.description = "120 m/s onto 1 cm of paper; a controller that holds stops on it.";
  scene.sentence = "penetration_resolution passes through the paper in step 2; octagon_sweep and Box2D stop on it.";
  scene.runs = {bullet_run("octagon_sweep", true, 5e-7), bullet_run("penetration_resolution", false, 0),
                bullet_run("box2d", true, 0.015)};
  scene.runs[1].events = {{2, ReportEvent::Kind::tunnel, "through paper at 120 m/s, 10 mm thick", 0, 0}};
  scene.rows = {row("bullet", "octagon_sweep", 12), row("bullet", "penetration_resolution", 12),
                row("bullet", "box2d", 12)};
  scene.rows[0].max_contact_gap_m = 5e-7;
  scene.rows[0].ns_per_step = 212;
  scene.rows[1].verdict = Verdict::tunnels;
  scene.rows[1].tunnels = 1;
  scene.rows[1].reason = "It looks only at where it arrives.";
  scene.rows[1].findings = {"First tunnel in step 2 through paper, 10 mm thick, at 120 m/s."};
  scene.rows[2].max_contact_gap_m = 0.015;
  scene.rows[2].ns_per_step = 1830;
  return scene;
}

// --- scene 1: a walk ---

double ground(double x) { return x < 12 ? 0 : std::min((x - 12) / 2, 2.0); }

SceneryDef walk_scenery(std::vector<std::string>& ids) {
  SceneryDef scenery;
  for (int i = -2; i < 12; ++i) {
    scenery.colliders.push_back(box(i, -1, i + 1, 0));
    ids.push_back("tile_" + std::to_string(i));
  }
  scenery.colliders.push_back({ColliderDef::Shape::polygon, {{12, -1}, {22, -1}, {22, 2}, {16, 2}, {12, 0}}});
  ColliderDef frame = box(5, 3.5, 9, 6);
  frame.holes = {{{5.5, 4}, {5.5, 5.5}, {8.5, 5.5}, {8.5, 4}}};
  scenery.colliders.push_back(frame);
  scenery.colliders.push_back({ColliderDef::Shape::chain, {{1, 2.5}, {3, 2.5}, {4, 3}}, {}, Vec2d(0, 1)});
  scenery.colliders.push_back({ColliderDef::Shape::chain, {{20, 2}, {20, 5}, {19, 5.5}}});
  ids.insert(ids.end(), {"hill", "frame", "ledge", "wall"});
  return scenery;
}

ReportRun walk_run(const std::string& contender, double gap, int steps) {
  ReportRun run;
  run.header = header("walk", contender);
  run.header.scenery = walk_scenery(run.header.ids);
  Vec2d position{0, feet + gap};
  for (int number = 0; number < steps; ++number) {
    const double x = std::min(position.x() + 0.06, 19.6);
    const double hop = number > 60 && number < 100 ? (number - 60) * (100 - number) * 0.004 : 0;
    TraceStep step = straight_step(number, position, {x, ground(x + 5 / 32.0) + feet + gap + hop});
    step.grounded = hop == 0;
    step.jumping = hop > 0;
    if (hop == 0) {
      const ColliderIndex under = x < 12 ? static_cast<ColliderIndex>(std::floor(x) + 2) : 14;
      step.contacts.push_back({under, {x + 5 / 32.0, ground(x + 5 / 32.0)}, {0, 1}, 0, gap, Side::bottom});
    }
    if (x >= 19.6) step.contacts.push_back({17, {20, position.y()}, {-1, 0}, 0.5, gap, Side::right});
    position = step.path.back().position;
    run.steps.push_back(step);
  }
  return run;
}

ReportScene walk_scene() {
  ReportScene scene;
  scene.name = "walk";
  scene.description = "Flat tiles, a slope, a ledge that blocks from above only, and a wall.";
  scene.sentence = "Both hold; Box2D keeps its own rest gap of 15 mm.";
  scene.runs = {walk_run("octagon_sweep", 5e-7, 400), walk_run("box2d", 0.015, 380)};
  scene.rows = {row("walk", "octagon_sweep", 400), row("walk", "box2d", 380), row("walk", "grid", 0)};
  scene.rows[0].contact_precision = 1;
  scene.rows[0].contact_recall = 1;
  scene.rows[0].contact_agreement_box2d = 0.9975;
  scene.rows[0].max_position_difference_box2d_m = 0.0151;
  scene.rows[1].contact_precision = 0.98;
  scene.rows[1].contact_recall = 0.964;
  scene.rows[2] = Row{};
  scene.rows[2].contender = "grid";
  scene.rows[2].verdict = Verdict::not_applicable;
  scene.rows[2].reason = "A grid cannot hold a slope.";
  return scene;
}

// --- scene 2: hostile texts, lockstep and disagreements ---

ReportScene hostile_scene() {
  ReportScene scene = walk_scene();
  scene.name = hostile_text();
  scene.description = "A text with \"quotes\", <b>tags</b> & a \xE2\x82\xAC, and bytes that are not UTF-8: \xFF\xFE.";
  for (ReportRun& run : scene.runs) {
    run.header.mode = "lockstep";
    run.header.ids[3] = hostile_text();
  }
  for (Row& made : scene.rows) made.mode = "lockstep";
  scene.rows[0].max_penetration_m = std::nan("");
  for (const int number : {40, 150}) {
    Disagreement disagreement;
    disagreement.step = number;
    disagreement.who_is_right = "octagon_sweep is right: exact arithmetic finds the floor, and Box2D missed it.";
    for (std::size_t run = 0; run < 2; ++run) {
      const TraceStep& step = scene.runs[run].steps[static_cast<std::size_t>(number)];
      Disagreement::Statement statement{run, step.path.front().position, step.path.back().position, {}};
      if (run == 0) statement.contacts = step.contacts;
      disagreement.statements.push_back(statement);
    }
    disagreement.exact = disagreement.statements.front().contacts;
    scene.disagreements.push_back(disagreement);
  }
  return scene;
}

// --- scene 3: a lift under a ceiling, and a sensor ---

/// It rises from -3 by 0.05 m per step, under the feet and on, until the head is at the ceiling.
ReportRun lift_run(const std::string& contender, double gap) {
  constexpr double rise = 0.05, ceiling = 2;
  constexpr int last_free = 75;
  ReportRun run;
  run.header = header("lift", contender);
  ColliderDef lift = box(-1, -0.25, 1, 0);
  lift.mover = 0;
  ColliderDef arm = box(1, -0.1, 2, 0);
  arm.mover = 0;
  ColliderDef zone = box(-0.5, -1, 0.5, 0.5);
  zone.sensor = true;
  run.header.scenery.colliders = {box(-4, ceiling, 4, ceiling + 1), lift, arm, zone};
  run.header.ids = {"ceiling", "lift", "arm", "zone"};
  for (int number = 0; number < 80; ++number) {
    const double low = -3 + rise * number;
    const int ridden = std::min(number, last_free);
    TraceStep step = straight_step(number, {0, -3 + rise * ridden + feet + gap},
                                   {0, -3 + rise * std::min(number + 1, last_free) + feet + gap});
    step.movers = {{{0, low}, {0, low + rise}}};
    step.grounded = true;
    step.contacts = {{1, {0, low + rise}, {0, 1}, 0, gap, Side::bottom}};
    if (number >= last_free) step.crushed = {1};
    if (number == 25) step.sensors = {{3, SensorEvent<double>::Change::enter, 0.25}};
    run.steps.push_back(step);
  }
  run.events = {{25, ReportEvent::Kind::sensor, "enters zone at 0.25 of the step"},
                {last_free, ReportEvent::Kind::crush, "is crushed by lift", 0, 1}};
  return run;
}

ReportScene lift_scene() {
  ReportScene scene;
  scene.name = "lift";
  scene.sentence = "The lift leaves no room from step 75 on.";
  scene.runs = {lift_run("octagon_sweep", 5e-7), lift_run("box2d", 0.015)};
  scene.rows = {row("lift", "octagon_sweep", 80), row("lift", "box2d", 80)};
  return scene;
}

// --- scene 4: two characters ---

/// The second comes down by 0.1 m per step onto the head of the first and stands there.
ReportRun pair_run(const std::string& contender, double gap) {
  constexpr double fall = 0.1;
  ReportRun run;
  run.header = header("pair", contender);
  run.header.characters = 2;
  run.header.scenery.colliders = {box(-4, -1, 4, 0)};
  run.header.ids = {"floor"};
  run.others.resize(1);
  const double low = feet + gap;
  double height = low + 2 * feet + 1.05;
  for (int number = 0; number < 40; ++number) {
    TraceStep below = straight_step(number, {0, low}, {0, low});
    below.grounded = true;
    below.contacts = {{0, {0, 0}, {0, 1}, 0, gap, Side::bottom}};
    const double lowest = low + 2 * feet + gap;
    TraceStep above = straight_step(number, {0.1, height}, {0.1, std::max(height - fall, lowest)});
    above.character = 1;
    if (height - fall <= lowest) {
      above.met = {{0, {0, 1}, 0.5, Side::bottom}};
      below.met = {{1, {0, -1}, 0.5, Side::top}};
    }
    height = above.path.back().position.y();
    run.steps.push_back(below);
    run.others[0].push_back(above);
  }
  run.events = {{10, ReportEvent::Kind::corner_cut, "character 1 cuts a corner of character 0", 1}};
  return run;
}

ReportScene pair_scene() {
  ReportScene scene;
  scene.name = "pair";
  scene.sentence = "One stands on the head of the other.";
  scene.runs = {pair_run("octagon_sweep", 5e-7), pair_run("box2d", 0.015)};
  scene.rows = {row("pair", "octagon_sweep", 40), row("pair", "box2d", 40)};
  scene.rows[0].characters = scene.rows[1].characters = 2;
  return scene;
}

// --- scene 5: steps of different lengths, and a drop ---

/// Falls by 0.1 m in 16 ms, then by 0.2 m in 100 s, through a ledge.
ReportScene uneven_scene() {
  ReportScene scene;
  scene.name = "uneven";
  scene.sentence = "The second step takes a hundred seconds.";
  scene.dt_list = {1.0 / 64, 100};
  ReportRun run;
  run.header = header("uneven", "octagon_sweep");
  run.header.scenery.colliders = {box(-4, -9, 4, -8), {ColliderDef::Shape::chain, {{-1, 0}, {1, 0}}, {}, Vec2d(0, 1)}};
  run.header.ids = {"floor", "ledge"};
  run.steps = {straight_step(0, {0, feet + 0.2}, {0, feet + 0.1}), straight_step(1, {0, feet + 0.1}, {0, feet - 0.1})};
  run.steps[1].dropped_through = {1};
  run.events = {{1, ReportEvent::Kind::drop, "drops through ledge"}};
  scene.runs = {run};
  scene.rows = {row("uneven", "octagon_sweep", 2)};
  return scene;
}

// --- scene 6: a character that goes by whole squares ---

/// A tenth of a square is wanted in each step: it is made once it is half a square.
ReportScene squares_scene() {
  ReportScene scene;
  scene.name = "squares";
  scene.sentence = "It is in one square or in the next, and drawn in between.";
  ReportRun run;
  run.header = header("squares", "grid");
  run.header.scenery.colliders = {box(-4, -1, 8, 0)};
  run.header.ids = {"floor"};
  Vec2d position{0, feet};
  for (int number = 0; number < 30; ++number) {
    const double wanted = 0.1 * (number + 1);
    TraceStep step = straight_step(number, position, {std::floor(wanted + 0.5), feet});
    position = step.path.back().position;
    step.remainder = {wanted - position.x(), 0};
    step.grounded = true;
    run.steps.push_back(step);
  }
  scene.runs = {run};
  scene.rows = {row("squares", "grid", 30)};
  return scene;
}

}  // namespace

std::string hostile_text() { return "</script><script>throw 1</script><!-- & \" ' ]]>"; }

Report sample_report() {
  Report report;
  report.environment = {{"paperproof", "sample"}, {"compiler", "the one that built this test"}};
  report.tolerances = {{"hit", 1e-7}, {"stop", 5e-7}, {"touch", 7e-7}};
  report.scenes = {bullet_scene(), walk_scene(),   hostile_scene(), lift_scene(),
                   pair_scene(),   uneven_scene(), squares_scene()};
  report.guarantee_notes = {"No step of octagon_sweep in double ended inside a solid: 0 violations in 812 steps."};
  return report;
}

}  // namespace paperproof::compare
