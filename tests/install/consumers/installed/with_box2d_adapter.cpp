// A game that has its level in a b2World: its hero falls onto the floor. Exit status 0 when it stands on the floor's
// fixture, and the scenery that is read of the world leads to that as well.
#include <paperproof/box2d/hero.hpp>
#include <paperproof/box2d/world_scenery.hpp>

#include <box2d/box2d.h>

#include <cstdio>
#include <vector>

using namespace paperproof::box2d;

int main() {
  b2World world({0, -10});
  b2BodyDef still;
  b2PolygonShape shape;
  shape.SetAsBox(5, 0.5F, {0, -0.5F}, 0);
  const b2Fixture* const floor = world.CreateBody(&still)->CreateFixture(&shape, 0);
  Hero hero(world, {.position = {0, 3}});
  for (int step = 0; step < 120; ++step) {
    world.Step(1.0F / 64, 8, 3);
    hero.step({}, 1.0 / 64);
  }
  const std::vector<b2Fixture*> read = scenery_of(world).fixtures;
  std::printf("grounded %d, and %zu fixture in the scenery\n", hero.grounded(), read.size());
  return hero.ground() == floor && read.size() == 1 && read[0] == floor ? 0 : 1;
}
