/// One equality: a hero among fixtures steps as the controller over the colliders that these are. The runs are the
/// campaign's.
#include "hero_world.hpp"

#include "agreement/saying.hpp"
#include "campaign/campaign.hpp"
#include "campaign/random.hpp"
#include "float_geometry.hpp"
#include "runs/input_cursor.hpp"
#include "shapes.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/box2d/invalid_definition.hpp>

#include <gtest/gtest.h>

#include <string>

namespace paperproof::box2d::hero_test {
namespace {

using compare::Random;
using compare::RandomRun;

/// The scenery of a run as fixtures: what stands on one static body, each mover on a kinematic one.
class Fixtures {
 public:
  explicit Fixtures(std::size_t movers) {
    b2BodyDef def;
    for (std::size_t i = 0; i <= movers; ++i) {
      bodies_.push_back(world.CreateBody(&def));
      def.type = b2_kinematicBody;
    }
  }

  /// @param def must stay where it is.
  void add(const ColliderDef& def) {
    if (def.shape == ColliderDef::Shape::circle) {
      b2CircleShape circle;
      circle.m_p = rounded(def.points[0]);
      circle.m_radius = static_cast<float>(def.radius);
      return add(circle, def);
    }
    try {
      return add(character_polygon(def.points), def);
    } catch (const InvalidDefinition&) {  // Box2D has no such polygon: then its outline
    }
    const bool is_closed = def.shape == ColliderDef::Shape::polygon;
    for (std::size_t i = is_closed ? 0 : 1; i < def.points.size(); ++i) {
      const b2Vec2 from = rounded(def.points[i == 0 ? def.points.size() - 1 : i - 1]);
      const b2Vec2 to = rounded(def.points[i]);
      b2EdgeShape edge;
      edge.SetTwoSided(from, to);
      if (!(from == to)) add(edge, def);
    }
  }
  void keep(std::size_t count) {
    for (; all.size() > count; all.pop_back()) all.back()->GetBody()->DestroyFixture(all.back());
    scenery.colliders.resize(count);
  }

  /// The movers go on, and the world.
  std::span<const MoverMotion> step(const compare::StepInput& input) {
    motions_.resize(input.movers.size());
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      motions_[i].from = widened(bodies_[i + 1]->GetPosition());
      bodies_[i + 1]->SetLinearVelocity(rounded(Vec2d((input.movers[i].to - motions_[i].from) / input.dt)));
    }
    world.Step(static_cast<float>(input.dt), 8, 3);
    for (std::size_t i = 0; i < motions_.size(); ++i) motions_[i].to = widened(bodies_[i + 1]->GetPosition());
    return motions_;
  }

  b2World world{{0, 0}};
  std::vector<b2Fixture*> all;
  SceneryDef scenery;  ///< Read back from all fixtures.

 private:
  void add(const b2Shape& shape, const ColliderDef& def) {
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.userData.pointer = reinterpret_cast<std::uintptr_t>(&def);
    all.push_back(bodies_[def.mover == no_mover ? 0 : def.mover + 1]->CreateFixture(&fixture));
    b2Transform still;
    still.SetIdentity();
    ColliderDef& read = scenery.colliders.emplace_back(collider_of(*all.back()->GetShape(), still));
    read.mover = def.mover;
    read.surface_speed = def.surface_speed;
    if (def.one_way) read.one_way = {0, 1};
  }

  std::vector<b2Body*> bodies_;
  std::vector<MoverMotion> motions_;
};

Surface surface_of(b2Fixture& fixture) {
  const auto& def = *reinterpret_cast<const ColliderDef*>(fixture.GetUserData().pointer);
  return {def.one_way ? Blocking::from_above : Blocking::from_everywhere, def.surface_speed};
}

struct Tally {
  int steps = 0;
  int touching = 0;
  int ties = 0;   ///< Steps that rounding decides otherwise, or the order of the colliders.
  int apart = 0;  ///< Runs that end as the hero is squeezed, which it alone limits.
};

/// One run in two ways. The shape may lie away from the position, and the fixtures are made while the hero steps there.
class Twice {
 public:
  Twice(RandomRun run, Random& random)
      : run_(random.chance(0.3) ? test::written_elsewhere(random).of(std::move(run)) : std::move(run)),
        fixtures_(run_.scene.movers.size()),
        hero_(fixtures_.world,
              {.character = run_.scene.character, .position = run_.scene.start.position, .surface_of = surface_of}) {
    for (const ColliderDef& def : run_.scene.scenery.colliders) {
      const std::size_t before = fixtures_.all.size();
      fixtures_.add(def);
      if (!random.chance(0.2)) continue;
      hero_.step({}, frame);
      fixtures_.keep(before);
      if (random.chance(0.5)) hero_.step({}, frame);
      fixtures_.add(def);
    }
    hero_.place(run_.scene.start.position, run_.scene.start.velocity);
    state_.position = run_.scene.start.position;
    state_.velocity = run_.scene.start.velocity;
  }

  void go(Tally& tally) {
    const Scenery scenery(fixtures_.scenery);
    const Controller controller(scenery, run_.scene.character);
    Scratch scratch = controller.make_scratch();
    const compare::Script script = script_of(run_.scene);
    compare::InputCursor cursor(run_.scene, script);
    for (int step = 0; step < run_.scene.steps; ++step) {
      const compare::StepInput input = with_up(run_, step, cursor.at(step));
      fixtures_.world.SetGravity(rounded(input.gravity));
      const Vec2d gravity = widened(fixtures_.world.GetGravity());
      const Vec2d up = -gravity / gravity.norm();
      for (const compare::Launch& launch : run_.launches) {
        if (launch.step != step || launch.velocity.norm() > 1e6) continue;
        hero_.set_velocity(launch.velocity);
        if ((launch.velocity - state_.ride.velocity).dot(up) > 0) knock_back(state_, {0, 0});
        state_.velocity = launch.velocity;
      }
      const std::span<const MoverMotion> motions = fixtures_.step(input);
      hero_.step(input.players[0], input.dt);
      controller.step(state_, input.players[0], {gravity, input.dt, motions, nullptr, up}, scratch, report_);
      ++tally.steps;
      tally.touching += !hero_.contacts().empty();
      if (!is_same(tally)) return;
      if ((state_.position - run_.centre).cwiseAbs().maxCoeff() > run_.reach) return;
    }
  }

 private:
  bool is_same(Tally& tally) {
    const bool same_answers = hero_.report().status == report_.status && hero_.grounded() == state_.grounded;
    const double off = (hero_.position() - state_.position).norm();
    if (same_answers && off == 0 && hero_.velocity() == state_.velocity) return true;
    const bool among_movers = !run_.scene.movers.empty();
    const double most = among_movers ? 1e-6 : 1e-12;
    // Movers give the hero no more than their own speed.
    const bool same_speed = among_movers ? hero_.velocity().norm() <= state_.velocity.norm() * (1 + 1e-9) + most
                                         : (hero_.velocity() - state_.velocity).norm() <= most;
    const bool is_tie = same_answers && off <= most && same_speed;
    (is_tie ? tally.ties : tally.apart) += 1;
    state_.position = hero_.position();
    state_.velocity = hero_.velocity();
    return is_tie;
  }

  RandomRun run_;
  Fixtures fixtures_;
  Hero hero_;
  CharacterState state_;
  StepReport report_;
};

class HeroInRuns : public ::testing::TestWithParam<const char*> {};

TEST_P(HeroInRuns, steps_as_the_controller_over_the_same_colliders) {
  const std::string kind = GetParam();
  const int wanted = test::steps_wanted("PAPERPROOF_HERO_STEPS", 600);
  const auto has_front = [](const ColliderDef& def) { return def.one_way.has_value(); };
  Tally tally;
  for (const compare::Family* family : compare::families_named(kind)) {
    const int end = tally.steps + wanted;
    for (std::uint64_t seed = family->first_seed; tally.steps < end; ++seed) {
      RandomRun run = family->draw(seed);
      const bool has_ledges = std::ranges::any_of(run.scene.scenery.colliders, has_front);
      if (has_ledges && !run.ups.empty()) break;  // the hero's block from above, wherever that is
      if (run.centre != Vec2d::Zero() || run.scene.start.velocity.norm() > 1e6) continue;
      run.scene.steps = std::min(run.scene.steps, 600);
      Random random(seed);
      const int apart = tally.apart;
      Twice(std::move(run), random).go(tally);
      ASSERT_TRUE(tally.apart == apart || kind == "movers")
          << "hero and controller part; the controller's run is " << family->replay_of(seed);
    }
  }
  EXPECT_GE(tally.touching, tally.steps / 12);
  EXPECT_LE(tally.ties, tally.steps * (kind == "movers" || kind == "stairs" ? 3e-2 : 1e-3));
  EXPECT_LE(tally.apart, tally.steps * 5e-3);
}

INSTANTIATE_TEST_SUITE_P(Every, HeroInRuns, ::testing::Values("static", "any_up", "play", "stairs", "movers"),
                         [](const auto& kind) { return std::string(kind.param); });

}  // namespace
}  // namespace paperproof::box2d::hero_test
