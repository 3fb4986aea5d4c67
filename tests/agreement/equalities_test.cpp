/// One table of equalities: the same run in another way gives the same bits. The runs are the campaign's.
#include "agreement/saying.hpp"
#include "campaign/campaign.hpp"
#include "controller/stepping.hpp"
#include "runs/input_cursor.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/saved_state.hpp>
#include <paperproof/together.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <tuple>

namespace paperproof::test {
namespace {

using compare::RandomRun;

/// Steps one character in some way. It owns what it needs.
using Stepper = std::function<void(CharacterState&, const Input&, const StepContext&, StepReport&)>;

struct OtherWay {
  Saying saying{};
  Stepper step;
  Stepper first{};  ///< Steps the run in the first way, where that is not as it was drawn.
};

/// What steps a character of a scene: its own state is not used.
using World = stepping::Stepper;

Stepper controller_of(const SceneryDef& def, const CharacterDef& character, const TechniqueDef& technique = {}) {
  return [world = std::make_shared<World>(def.colliders, character, technique)](
             CharacterState& state, const Input& input, const StepContext& context, StepReport& report) {
    world->controller.step(state, input, context, world->scratch, report);
  };
}

using Kinds = std::span<const char* const>;
/// The selections below count on this order.
constexpr std::array all_kinds{"static", "any_up", "movers", "stairs", "tight/sensors"};
constexpr Kinds without_sensors{all_kinds.data(), 4};
constexpr Kinds without_stairs{all_kinds.data(), 3};
constexpr Kinds with_movers{all_kinds.data() + 2, 1};

struct Equality {
  const char* name;
  /// Changes the run before either way makes it. @return false where there is no such way.
  bool (*prepare)(RandomRun&);
  /// @param other has no stepper yet. It has a saying already where the shape is written elsewhere.
  OtherWay (*make)(const RandomRun&, Random&, OtherWay other);
  /// A run ends with its first crush: after it a level and a controller may say other things (see "Found and open" in
  /// controller/README.md).
  bool until_crushed = false;
  double ties = 0;  ///< So many runs per step may come out otherwise; the next step begins alike again.
  /// Above zero: the shape is written around another origin. Numbers that are so near count as equal; then each step
  /// begins alike, and only what it reports is compared.
  double near = 0;
  Kinds kinds = without_sensors;  ///< Of families; the others have no such runs.
};

bool as_it_is(RandomRun&) { return true; }

OtherWay said_otherwise(const RandomRun& run, Random&, OtherWay other) {
  other.step = controller_of(other.saying.of(run.scene.scenery), other.saying.of(run.scene.character));
  return other;
}

OtherWay turned(const RandomRun& run, Random& random, OtherWay other) {
  Eigen::Matrix2d quarter;
  quarter << 0, -1, 1, 0;
  for (int quarters = random.integer(1, 3); quarters > 0; --quarters)
    other.saying.vector = Eigen::Matrix2d(quarter * other.saying.vector);
  return said_otherwise(run, random, std::move(other));
}

OtherWay mirrored(const RandomRun& run, Random& random, OtherWay other) {
  other.saying.vector << -1, 0, 0, 1;
  return said_otherwise(run, random, std::move(other));
}

/// The order in which a level sees colliders. @return false where two have the same place in it.
bool put_in_order(RandomRun& run) {
  const auto key = [](const ColliderDef& collider) {
    const auto [lower, upper] = Box2::around(collider.points);
    return std::tuple(collider.mover + 1, lower.x(), lower.y(), upper.x(), upper.y(), collider.points.size());
  };
  std::vector<ColliderDef>& all = run.scene.scenery.colliders;
  std::stable_sort(all.begin(), all.end(), [&](const ColliderDef& a, const ColliderDef& b) { return key(a) < key(b); });
  return std::adjacent_find(all.begin(), all.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }) ==
         all.end();
}

/// In any order, with edits that are undone: some before the run, and some before each step, after another character
/// has seen them with the same memory.
OtherWay edited_level(const RandomRun& run, Random& random, OtherWay other) {
  const auto level = std::make_shared<Level>();
  const std::vector<ColliderDef> colliders = run.scene.scenery.colliders;
  std::vector<ColliderIndex> order(colliders.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  for (const ColliderIndex i : order) {
    const ColliderDef& def = colliders[i];
    if (random.chance(0.2)) level->remove(level->add(def));
    const bool is_moved = random.chance(0.2);
    const ColliderIndex id = level->add(is_moved ? compare::box(0, 0, 1, 1, def.mover) : def);
    if (is_moved) level->replace(id, def);
    other.saying.colliders[i] = id;
  }
  const auto controller = std::make_shared<Controller>(*level, other.saying.of(run.scene.character));
  const auto scratch = std::make_shared<Scratch>(controller->make_scratch());
  other.step = [=, ids = other.saying.colliders, next = ColliderIndex{0}](
                   CharacterState& state, const Input& input, const StepContext& context, StepReport& report) mutable {
    const Vec2d& at = state.position;
    const ColliderIndex added = level->add(compare::box(at.x(), at.y() - 1, at.x() + 1, at.y()));
    ColliderDef moved = compare::box(at.x() - 1, at.y(), at.x(), at.y() + 1, colliders[next].mover);
    moved.sensor = colliders[next].sensor;
    level->replace(ids[next], moved);
    CharacterState of_another = state;
    StepReport report_of_another;
    controller->step(of_another, input, context, *scratch, report_of_another);
    level->remove(added);
    level->replace(ids[next], colliders[next]);
    next = (next + 1) % static_cast<ColliderIndex>(colliders.size());
    controller->step(state, input, context, *scratch, report);
  };
  return other;
}

/// Walls far away, so that all sceneries are equally large.
bool add_frame(RandomRun& run) {
  if (run.centre != Vec2d::Zero() || run.reach > 20) return false;
  std::vector<ColliderDef>& all = run.scene.scenery.colliders;
  for (const double x : {-40.0, -30.0, 30.0, 40.0}) all.push_back(compare::box(x, -40, x + 1, 40));
  return true;
}

/// Among others, sensors too, that a filter leaves out, by category or by a predicate.
OtherWay filtered(const RandomRun& run, Random& random, OtherWay other) {
  constexpr std::uint32_t there = 2;
  constexpr std::uint32_t elsewhere = 4;
  SceneryDef def;
  SceneryDef more = random_terrain(static_cast<Terrain>(random.integer(0, 14)), random, {0, 0});
  const auto is_there = std::make_shared<std::vector<bool>>();
  const auto add = [&](ColliderDef collider, bool stays) {
    collider.filter.category = stays ? there : elsewhere;
    def.colliders.push_back(collider);
    is_there->push_back(stays);
  };
  for (ColliderIndex i = 0; i < run.scene.scenery.colliders.size(); ++i) {
    while (!more.colliders.empty() && random.chance(0.4)) {
      more.colliders.back().sensor = !more.colliders.back().one_way && random.chance(0.3);
      add(more.colliders.back(), false);
      more.colliders.pop_back();
    }
    other.saying.colliders[i] = static_cast<ColliderIndex>(def.colliders.size());
    add(run.scene.scenery.colliders[i], true);
  }
  const auto filter = std::make_shared<ColliderFilter>();
  if (random.chance(0.5)) {
    filter->mask = there;
  } else {
    filter->is_there = [](ColliderIndex collider, const void* user) -> bool {
      return (*static_cast<const std::vector<bool>*>(user))[collider];
    };
    filter->user = is_there.get();
  }
  // And one that turns and goes through everything: it makes the ties, see "Found and open" in controller/README.md.
  const auto ghost = static_cast<MoverIndex>(run.scene.movers.size());
  add(compare::box(-2, -2, 2, 2, ghost), false);
  const Stepper whole = controller_of(def, run.scene.character);
  const auto motions = std::make_shared<std::vector<MoverMotion>>();
  other.step = [=, kept = is_there](CharacterState& state, const Input& input, const StepContext& context,
                                    StepReport& report) {
    motions->assign(context.movers.begin(), context.movers.end());
    motions->push_back({{0, 0}, {0.1, 0}, 0, 0.1});
    StepContext with = context;
    with.movers = *motions;
    // Another character takes its step before, with the same memory and without a filter.
    CharacterState of_another;
    of_another.position = state.position;
    StepReport report_of_another;
    whole(of_another, {}, with, report_of_another);
    with.filter = filter.get();
    whole(state, input, with, report);
  };
  return other;
}

/// Saved as bytes and restored in each step, with memory that others have used or nobody has.
OtherWay restored_each_step(const RandomRun& run, Random&, OtherWay) {
  const auto world = std::make_shared<World>(run.scene.scenery.colliders, run.scene.character);
  return {.step = [world](CharacterState& state, const Input& input, const StepContext& context, StepReport& report) {
    CharacterState elsewhere = state;
    elsewhere.position += Vec2d(1, 1);
    StepReport of_elsewhere;
    world->controller.step(elsewhere, {.move = 1}, context, world->scratch, of_elsewhere);
    state = restored(save(state));
    world->controller.step(state, input, context, world->scratch, report);
    world->scratch = world->controller.make_scratch();
  }};
}

OtherWay with_nothing_left_out(const RandomRun& run, Random&, OtherWay) {
  return {.step = controller_of(run.scene.scenery, run.scene.character, {.search = PieceSearch::none})};
}

/// Movers have angles that they keep; in the first way they are made turned so, and need none.
OtherWay keeping_its_angles(const RandomRun& run, Random& random, OtherWay other) {
  std::vector<double> angles(run.scene.movers.size());
  for (double& angle : angles) angle = random.angle();
  other.first = controller_of(made_turned(run.scene.scenery, angles), run.scene.character);
  other.step = [=, as_drawn = controller_of(run.scene.scenery, run.scene.character),
                motions = std::vector<MoverMotion>()](CharacterState& state, const Input& input,
                                                      const StepContext& context, StepReport& report) mutable {
    motions.assign(context.movers.begin(), context.movers.end());
    for (std::size_t i = 0; i < motions.size(); ++i) motions[i].from_angle = motions[i].to_angle = angles[i];
    StepContext with = context;
    with.movers = motions;
    as_drawn(state, input, with, report);
  };
  return other;
}

/// As one of two that are far apart.
OtherWay one_of_many(const RandomRun& run, Random&, OtherWay other) {
  const CharacterDef character = other.saying.of(run.scene.character);
  SceneryDef def = other.saying.of(run.scene.scenery);
  const auto body = static_cast<ColliderIndex>(def.colliders.size());
  for (int i = 0; i < 2; ++i) def.colliders.push_back(body_of(character));
  const auto world = std::make_shared<World>(def.colliders, character);
  const auto turns = std::make_shared<TogetherScratch>();
  other.step = [=](CharacterState& state, const Input& input, const StepContext& context, StepReport& report) {
    CharacterState elsewhere;
    elsewhere.position = state.position + Vec2d(5e5, 0);
    StepReport of_elsewhere;
    const Controller* controller = world->controller.sweep();
    std::array all{Companion{controller, &elsewhere, input, body + 1, &world->scratch, &of_elsewhere},
                   Companion{controller, &state, input, body, &world->scratch, &report}};
    step_together(all, context, *turns);
  };
  return other;
}

constexpr double rounding = 1e-9;  ///< Of a place within 1,000 m [m].

constexpr std::array equalities{
    Equality{"turned_by_quarters", as_it_is, turned, false, 1e-3},
    Equality{"mirrored", as_it_is, mirrored, false, 3e-3},
    Equality{"edited_as_built_at_once", put_in_order, edited_level, true, 0, 0, all_kinds},
    Equality{"filtered_as_without", add_frame, filtered, false, 3e-4, 0, without_stairs},
    Equality{"restored_as_gone_on", as_it_is, restored_each_step},
    Equality{"with_nothing_left_out", as_it_is, with_nothing_left_out, false, 0, 0, all_kinds},
    Equality{"keeping_its_angles", as_it_is, keeping_its_angles, true, 3e-4, 0, with_movers},
    Equality{"as_one_of_many", as_it_is, one_of_many},
    Equality{"with_its_shape_elsewhere", as_it_is, said_otherwise, false, 3e-4, rounding},
    Equality{"with_its_shape_elsewhere_in_a_level", put_in_order, edited_level, true, 3e-4, rounding},
    Equality{"with_its_shape_elsewhere_as_one_of_many", as_it_is, one_of_many, false, 3e-4, rounding},
};

/// One run in two ways.
class Twice {
 public:
  Twice(const Equality& equality, const RandomRun& run, Random& random)
      : equality_(equality),
        run_(run),
        script_(script_of(run_.scene)),
        cursor_(run_.scene, script_),
        other_(equality.make(run, random, {equality.near > 0 ? written_elsewhere(random) : Saying{}, {}})),
        one_(other_.first ? other_.first : controller_of(run.scene.scenery, run.scene.character)) {}

  int steps = 0;
  int touching = 0;  ///< Something solid, or a sensor.
  int ties = 0;

  /// @return the first difference, or nothing.
  std::string go() {
    CharacterState state;
    state.position = run_.scene.start.position;
    state.velocity = run_.scene.start.velocity;
    CharacterState other_state = other_.saying.of(state);
    for (int step = 0; step < run_.scene.steps; ++step) {
      launch(step, state);
      launch(step, other_state, other_.saying);
      const compare::StepInput input = with_up(run_, step, cursor_.at(step));
      StepReport report;
      StepReport other_report;
      one_(state, input.players[0], context_of(input, {}, motions_), report);
      other_.step(other_state, other_.saying.of(input.players[0]), context_of(input, other_.saying, other_motions_),
                  other_report);
      ++steps;
      touching += !report.move.contacts.empty() || !report.sensors.empty();
      if (equality_.until_crushed && (state.crushed || !report.move.crushed.empty())) return "";
      std::string what = difference(report, other_report, other_.saying, equality_.near);
      if (what.empty() && equality_.near == 0 && other_.saying.of(state) != other_state) what = "state";
      if (!what.empty() && equality_.ties == 0) return what + " in step " + std::to_string(step);
      ties += !what.empty();
      if (!what.empty() || equality_.near > 0) other_state = other_.saying.of(state);
      if (report.status == StepStatus::out_of_range) return "";
      if ((state.position - run_.centre).cwiseAbs().maxCoeff() > run_.reach) return "";
    }
    return "";
  }

 private:
  void launch(int step, CharacterState& state, const Saying& saying = {}) const {
    for (const compare::Launch& launch : run_.launches)
      if (launch.step == step) state.velocity = saying.of(launch.velocity);
  }

  static StepContext context_of(const compare::StepInput& input, const Saying& saying,
                                std::vector<MoverMotion>& motions) {
    motions.clear();
    for (const MoverMotion& motion : input.movers) motions.push_back({saying.of(motion.from), saying.of(motion.to)});
    return {saying.of(input.gravity), input.dt, motions, nullptr, saying.of(input.up)};
  }

  const Equality& equality_;
  RandomRun run_;
  compare::Script script_;
  compare::InputCursor cursor_;
  OtherWay other_;
  Stepper one_;
  std::vector<MoverMotion> motions_;
  std::vector<MoverMotion> other_motions_;
};

class Equalities : public ::testing::TestWithParam<std::tuple<Equality, const char*>> {};

TEST_P(Equalities, give_the_same_bits) {
  const auto& [equality, kind] = GetParam();
  const std::vector<const compare::Family*> families = compare::families_named(kind);
  constexpr std::uint64_t tries = 200;  // runs, of which one must have another way
  const int wanted = steps_per_family();
  int steps = 0;
  int touching = 0;
  int ties = 0;
  for (std::uint64_t k = 0; steps < wanted; ++k) {
    ASSERT_TRUE(k < tries || steps > 0) << kind << " has no such runs";
    const compare::Family& family = *families[k % families.size()];
    const std::uint64_t seed = family.first_seed + k / families.size();
    RandomRun run = family.draw(seed);
    run.scene = with_names(run.scene, family.name);
    Random random(seed);
    if (equality.near > 0 && run.centre != Vec2d::Zero()) continue;  // far away numbers are not so near
    if (!equality.prepare(run)) continue;
    Twice twice(equality, run, random);
    ASSERT_EQ(twice.go(), "") << equality.name << ": " << family.title() << " " << seed;
    steps += twice.steps;
    touching += twice.touching;
    ties += twice.ties > 0;  // what stays there comes out otherwise for several steps
  }
  std::printf("%s, %s: %d steps, %d with contact, ties in %d runs\n", equality.name, kind, steps, touching, ties);
  EXPECT_GE(touching, steps / (sanitized ? 15 : 12)) << "a short run touches less";
  const double expected = equality.ties * steps;
  EXPECT_LE(ties, expected > 0 ? 1 + expected + 4 * std::sqrt(expected) : 0) << "runs come by chance";
}

/// Of several characters that meet, and among what turns. Rounding decides some runs, more of long ones.
TEST(ShapeElsewhere, comes_to_the_same_in_a_crowd_and_among_what_turns) {
  for (const char* title : {"crowd/rooms", "turning/planks"}) {
    const compare::Family& family = *compare::families_named(title).front();
    int same = 0;
    const unsigned runs = sampled(64U);
    for (std::uint64_t seed = family.first_seed; seed < family.first_seed + runs; ++seed) {
      RandomRun run = family.draw(seed);
      run.scene.steps = std::min(run.scene.steps, 20);
      Random random(seed);
      const compare::Findings one = run_and_judge(run, title);
      const compare::Findings two = run_and_judge(written_elsewhere(random).of(run), title);
      same += one.steps == two.steps && one.happened == two.happened;
    }
    std::printf("%s: %d of %d runs come to the same\n", title, same, runs);
    EXPECT_GE(same, runs * 8 / 10) << title;
  }
}

std::vector<std::tuple<Equality, const char*>> equalities_by_kind() {
  std::vector<std::tuple<Equality, const char*>> all;
  for (const Equality& equality : equalities)
    for (const char* kind : equality.kinds) all.emplace_back(equality, kind);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, Equalities, ::testing::ValuesIn(equalities_by_kind()), [](const auto& which) {
  std::string name = std::string(std::get<0>(which.param).name) + "_" + std::get<1>(which.param);
  std::ranges::replace(name, '/', '_');
  return name;
});

}  // namespace
}  // namespace paperproof::test
