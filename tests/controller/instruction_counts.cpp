// Does a number of steps, or makes a level of a number of pieces, for instruction_counts.sh to count what that takes:
//   instruction_counts walk|shared|set_up NUMBER
#include <paperproof/controller.hpp>

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

using namespace paperproof;

constexpr int width = 200;  // [m]
constexpr int characters = 50;

ColliderDef rectangle(double left, double bottom, double right, double top) {
  return {.points = {{left, bottom}, {right, bottom}, {right, top}, {left, top}}};
}

/// Rows of unit tiles between two walls; on the upper one a hill every ten metres and a platform every seven.
SceneryDef level(int tiles) {
  SceneryDef def;
  for (int i = 0; i < tiles; ++i) {
    const int x = i % width;
    const int y = -(i / width);
    if (y == 0 && x % 10 == 5)
      def.colliders.push_back({.points = {{x + 0.0, -1}, {x + 1.0, -1}, {x + 1.0, 0}, {x + 0.5, 0.2}, {x + 0.0, 0}}});
    else
      def.colliders.push_back(rectangle(x, y - 1, x + 1, y));
    if (y == 0 && x % 7 == 0) def.colliders.push_back(rectangle(x, 2.5, x + 2, 2.7));
  }
  def.colliders.push_back(rectangle(-1, -1, 0, 50));
  def.colliders.push_back(rectangle(width, -1, width + 1, 50));
  return def;
}

/// Walks to and fro, and jumps.
Input input_of_step(int step) { return {.move = step / 1000 % 2 == 0 ? 1.0 : -1.0, .jump = step % 61 < 3}; }

/// One step of each of some characters in turns, through one scratch. @return where they end.
double steps(int count, int of_characters) {
  const Scenery scenery(level(1000));
  const Controller controller(scenery, CharacterDef{});
  Scratch scratch = controller.make_scratch();
  std::vector<CharacterState> states(static_cast<std::size_t>(of_characters));
  for (std::size_t i = 0; i < states.size(); ++i) states[i].position = {2.5 + 3 * static_cast<double>(i), 0.7};
  StepReport report;
  for (int step = 0; step < count; ++step)
    controller.step(states[static_cast<std::size_t>(step) % states.size()], input_of_step(step / of_characters),
                    {{0, -30}, 1.0 / 60}, scratch, report);
  return states[0].position.x();
}

double set_up(int pieces) {
  const Scenery scenery(level(pieces));
  const Controller controller(scenery, CharacterDef{});
  return static_cast<double>(scenery.pieces().size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string_view what = argv[1];
  const int number = std::atoi(argv[2]);
  const double result = what == "set_up" ? set_up(number) : steps(number, what == "walk" ? 1 : characters);
  std::printf("%.17g\n", result);
}
