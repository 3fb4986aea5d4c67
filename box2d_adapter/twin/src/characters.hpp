/// The characters of a reference world, and who hears what Box2D calls back.
#pragma once

#include "step_recorder.hpp"

#include <paperproof/box2d/reference_world.hpp>

#include <deque>

namespace paperproof::box2d {

/// A character with what a step found out about it.
struct Character {
  Character(const SceneryFixtures& fixtures, const std::vector<Vec2d>& points) : recorder(fixtures.sources, points) {}

  b2Body* body = nullptr;
  std::size_t source = 0;  ///< Position in `SceneryFixtures::sources`.
  StepRecorder recorder;
  Vec2d wanted{Vec2d::Zero()};        ///< Displacement of the present step [m].
  std::vector<ColliderIndex> sensed;  ///< Sensors that were touched in the last step, ascending.
  std::vector<ColliderIndex> sensed_before;
  TwinStep result;
};

/// The listener of a world: hands each call to the one or two characters that it is about.
class Dispatcher final : public b2ContactListener {
 public:
  explicit Dispatcher(std::deque<Character>& characters) : characters_(characters) {}

  void BeginContact(b2Contact* contact) override {
    for_each(*contact, [contact](StepRecorder& recorder) { recorder.begin_contact(*contact); });
  }
  void PreSolve(b2Contact* contact, const b2Manifold*) override {
    for_each(*contact, [contact](StepRecorder& recorder) { recorder.pre_solve(*contact); });
  }
  void PostSolve(b2Contact* contact, const b2ContactImpulse*) override {
    for_each(*contact, [](StepRecorder& recorder) { recorder.post_solve(); });
  }

 private:
  template <class Call>
  void for_each(const b2Contact& contact, const Call& call) {
    for (Character& who : characters_)
      if (who.recorder.watches(contact)) call(who.recorder);
  }
  std::deque<Character>& characters_;
};

/// The listener of a world in which nothing is recorded: one-way chains, and no more.
class OneWayListener final : public b2ContactListener {
 public:
  explicit OneWayListener(std::deque<Character>& characters) : characters_(characters) {}

  void PreSolve(b2Contact* contact, const b2Manifold*) override {
    for (Character& who : characters_)
      if (who.recorder.watches(*contact)) who.recorder.let_through(*contact);
  }

 private:
  std::deque<Character>& characters_;
};

}  // namespace paperproof::box2d
