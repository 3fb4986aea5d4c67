// The same fall twice: the controller, and a Box2D world beside it. Exit status 0 when both rest on the same floor.
#include <paperproof/box2d/reference_world.hpp>
#include <paperproof/paperproof.hpp>

#include <cmath>
#include <cstdio>

int main() {
  const paperproof::SceneryDef level{{{.points = {{-5, -1}, {5, -1}, {5, 0}, {-5, 0}}}}};
  const paperproof::Scenery scenery(level);
  const paperproof::CharacterDef character;
  const paperproof::Controller controller(scenery, character);
  paperproof::Scratch scratch = controller.make_scratch();
  paperproof::StepReport report;
  paperproof::CharacterState state;
  state.position = {0, 3};
  paperproof::box2d::ReferenceWorld world(scenery, character, state.position);

  const paperproof::Vec2d gravity(0, -30);
  const double dt = 1.0 / 64;
  paperproof::Vec2d velocity = paperproof::Vec2d::Zero();
  for (int step = 0; step < 120; ++step) {
    controller.step(state, {}, {gravity, dt}, scratch, report);
    velocity = world.step(velocity + gravity * dt, dt).velocity;
  }

  const double apart = std::abs(state.position.y() - world.position().y());
  std::printf("controller %.9g m, Box2D %.9g m\n", state.position.y(), world.position().y());
  return state.grounded && apart <= paperproof::box2d::touch_gap ? 0 : 1;
}
