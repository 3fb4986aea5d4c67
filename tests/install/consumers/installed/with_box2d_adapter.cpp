// A game that has its level in a b2World: the character falls onto the floor, and a kinematic body follows it. Exit
// status 0 when both are there and the contact leads to the floor's fixture.
#include <paperproof/box2d/world_scenery.hpp>
#include <paperproof/paperproof.hpp>

#include <box2d/box2d.h>

#include <cmath>
#include <cstdio>

using namespace paperproof;
using namespace paperproof::box2d;

int main() {
  b2World world({0, -10});
  b2BodyDef floor_def;
  b2PolygonShape floor_shape;
  floor_shape.SetAsBox(5, 0.5F, {0, -0.5F}, 0);
  const b2Fixture* const floor = world.CreateBody(&floor_def)->CreateFixture(&floor_shape, 0);
  b2BodyDef hero_def;
  hero_def.type = b2_kinematicBody;
  hero_def.position = {0, 3};
  b2Body* const hero_body = world.CreateBody(&hero_def);

  const WorldScenery borrowed = scenery_of(world);
  const Scenery scenery(borrowed.scenery);
  const CharacterDef character;
  const Controller controller(scenery, character);
  Scratch scratch = controller.make_scratch();
  StepReport report;
  CharacterState hero;
  hero.position = {0, 3};
  const double dt = 1.0 / 64;
  for (int step = 0; step < 120; ++step) {
    controller.step(hero, {}, {{0, -10}, dt}, scratch, report);
    const Vec2d way = hero.position - Vec2d(hero_body->GetPosition().x, hero_body->GetPosition().y);
    hero_body->SetLinearVelocity({static_cast<float>(way.x() / dt), static_cast<float>(way.y() / dt)});
    world.Step(static_cast<float>(dt), 8, 3);
  }

  const double gap = hero.position.y() + character.shape.box().lower.y();
  const double behind = std::abs(hero.position.y() - static_cast<double>(hero_body->GetPosition().y));
  const bool on_floor = !report.move.contacts.empty() && borrowed.fixtures[report.move.contacts[0].collider] == floor;
  std::printf("grounded %d, %g m above the floor, its body %g m behind\n", hero.grounded, gap, behind);
  return hero.grounded && on_floor && gap > 0 && gap <= Tolerances{}.touch && behind < 1e-5 ? 0 : 1;
}
