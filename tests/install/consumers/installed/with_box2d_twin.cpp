// A character falls onto a floor in the reference world. Exit status 0 when it rests there.
#include <paperproof/box2d/reference_world.hpp>

#include <cmath>
#include <cstdio>

int main() {
  const paperproof::Scenery scenery({{{.points = {{-5, -1}, {5, -1}, {5, 0}, {-5, 0}}}}});
  const paperproof::CharacterDef character;
  paperproof::box2d::ReferenceWorld world(scenery, character, {0, 3});
  const double dt = 1.0 / 64;
  paperproof::Vec2d velocity = paperproof::Vec2d::Zero();
  for (int step = 0; step < 120; ++step) velocity = world.step(velocity + paperproof::Vec2d(0, -30 * dt), dt).velocity;

  const double gap = world.position().y() + character.shape.box().lower.y();
  std::printf("%g m above the floor\n", gap);
  return std::abs(gap) <= paperproof::box2d::touch_gap ? 0 : 1;
}
