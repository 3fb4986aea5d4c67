// The smallest game there is: a character falls onto a floor. Exit status 0 when it stands on it, in both scalars.
#include <paperproof/paperproof.hpp>

#include <cstdio>

namespace {

template <class Scalar>
bool lands_on_the_floor() {
  const paperproof::SceneryDef level{{{.points = {{-5, -1}, {5, -1}, {5, 0}, {-5, 0}}}}};
  const paperproof::Scenery<Scalar> scenery(level);
  const paperproof::CharacterDef character;
  const paperproof::Controller<Scalar> controller(scenery, character);

  paperproof::Scratch<Scalar> scratch = controller.make_scratch();
  paperproof::StepReport<Scalar> report;
  paperproof::CharacterState<Scalar> state;
  state.position = {Scalar(0), Scalar(3)};
  const paperproof::Vec2<Scalar> gravity(Scalar(0), Scalar(-30));
  for (int step = 0; step < 120; ++step) controller.step(state, {}, {gravity, Scalar(1) / Scalar(64)}, scratch, report);

  const double gap = static_cast<double>(state.position.y()) + character.shape.box().lower.y();
  const double highest = static_cast<double>(paperproof::Tolerances<Scalar>{}.touch);
  std::printf("grounded %d, %g m above the floor\n", state.grounded, gap);
  return state.grounded && gap > 0 && gap <= highest;
}

}  // namespace

int main() { return lands_on_the_floor<double>() && lands_on_the_floor<float>() ? 0 : 1; }
