// The smallest game there is: a character falls onto a floor. Exit status 0 when it stands on it.
#include <paperproof/paperproof.hpp>

#include <cstdio>

using namespace paperproof;

int main() {
  const SceneryDef level{{{.points = {{-5, -1}, {5, -1}, {5, 0}, {-5, 0}}}}};
  const Scenery scenery(level);
  const CharacterDef character;
  const Controller controller(scenery, character);

  Scratch scratch = controller.make_scratch();
  StepReport report;
  CharacterState state;
  state.position = {0, 3};
  for (int step = 0; step < 120; ++step) controller.step(state, {}, {{0, -30}, 1.0 / 64}, scratch, report);

  const double gap = state.position.y() + character.shape.box().lower.y();
  std::printf("grounded %d, %g m above the floor\n", state.grounded, gap);
  return state.grounded && gap > 0 && gap <= Tolerances{}.touch ? 0 : 1;
}
