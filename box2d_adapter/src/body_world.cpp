#include <paperproof/box2d/body_world.hpp>

#include "scenery_bodies.hpp"

#include <utility>

namespace paperproof::box2d {

struct BodyWorld::Impl {
  Impl(const Scenery<double>& scenery, std::span<const std::optional<BodyDef>> bodies, const Vec2d& gravity)
      : world(checked(gravity, "gravity")), stage(world, scenery, {}, bodies) {
    world.SetAllowSleeping(false);
    stage.parts.clear();
  }

  b2World world;
  SceneryBodies stage;
};

BodyWorld::BodyWorld(const Scenery<double>& scenery, std::span<const std::optional<BodyDef>> bodies,
                     const Vec2d& gravity)
    : impl_(std::make_unique<Impl>(scenery, bodies, gravity)) {}
BodyWorld::~BodyWorld() = default;
BodyWorld::BodyWorld(BodyWorld&&) noexcept = default;
BodyWorld& BodyWorld::operator=(BodyWorld&&) noexcept = default;

void BodyWorld::step(double dt, std::span<MoverMotion<double>> motions, std::span<const MoverTurn> turns) {
  SceneryBodies& stage = impl_->stage;
  stage.send(dt, motions, turns);
  stage.step({});
  for (std::size_t i = 0; i < motions.size(); ++i)
    if (stage.movers[i].dynamic) motions[i] = stage.motions[i];
}

}  // namespace paperproof::box2d
