// The smallest game there is: a character falls onto a floor. Exit status 0 when it stands on it.
#include <paperproof/paperproof.hpp>

#include <cstdio>

namespace {

bool lands_on_the_floor() {
  const paperproof::SceneryDef level{{{.points = {{-5, -1}, {5, -1}, {5, 0}, {-5, 0}}}}};
  const paperproof::Scenery scenery(level);
  const paperproof::CharacterDef character;
  const paperproof::Controller controller(scenery, character);

  paperproof::Scratch scratch = controller.make_scratch();
  paperproof::StepReport report;
  paperproof::CharacterState state;
  state.position = {0, 3};
  const paperproof::Vec2d gravity(0, -30);
  for (int step = 0; step < 120; ++step) controller.step(state, {}, {gravity, 1.0 / 64}, scratch, report);

  const double gap = state.position.y() + character.shape.box().lower.y();
  const double highest = paperproof::Tolerances{}.touch;
  std::printf("grounded %d, %g m above the floor\n", state.grounded, gap);
  return state.grounded && gap > 0 && gap <= highest;
}

}  // namespace

int main() { return lands_on_the_floor() ? 0 : 1; }
