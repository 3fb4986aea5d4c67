// Runs every technique, and several characters, through random scenery and hashes every bit that a step produces.
//   same_bits            prints one line per scene and technique: its hash after a tenth of the steps and after
//                        all, and how many steps had a contact (of several: with each other)
//   same_bits GOLDEN     compares with such lines, and prints both where they differ; exit status 1 then
//   same_bits GOLDEN tenth   makes and compares a tenth of the steps, for a build that takes a hundred times as long
// Nothing here may depend on the compiler either: no distribution of the standard library, no libm beyond sqrt.
#include "agreement/golden_scenes.hpp"

#include <paperproof/techniques.hpp>
#include <paperproof/together.hpp>

#include <bit>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace paperproof::golden {
namespace {

constexpr int steps_per_run = 5000;
constexpr int first_steps = 500;  ///< Hashed apart.
constexpr int steps_between_shots = 250;
constexpr double dt = 1.0 / 60;

class Hash {
 public:
  /// One after the other.
  template <class... Values>
  void add(const Values&... values) {
    (add_one(values), ...);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  void add_one(const Vec2d& value) { add(value.x(), value.y()); }
  void add_one(double value) { add_one(std::bit_cast<std::uint64_t>(value)); }
  // FNV-1a, byte by byte (Fowler, Noll, Vo; draft-eastlake-fnv).
  void add_one(auto value) {
    auto bits = static_cast<std::uint64_t>(value);
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) value_ = (value_ ^ (bits & 0xff)) * 0x100000001b3U;
  }
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

void add_step(Hash& hash, const CharacterState& state, const StepReport& report) {
  hash.add(state.position, state.velocity, state.last_free, state.has_last_free, state.grounded, state.jumping,
           state.jump_held, state.jump_pending, state.wall_left, state.wall_right, state.stuck_steps);
  hash.add(report.status, report.requested);
  for (const PathPoint& corner : report.move.path) hash.add(corner.position, corner.fraction);
  for (const Contact& contact : report.move.contacts)
    hash.add(contact.collider, contact.point, contact.normal, contact.fraction, contact.separation, contact.side);
  hash.add(state.crushed, state.ride.ground, state.ride.place, state.ride.velocity);
  for (const ColliderIndex collider : report.move.crushed) hash.add(collider);
  for (const SensorEvent& event : report.sensors) hash.add(event.sensor, event.change, event.fraction);
}

struct RunResult {
  std::uint64_t first_hash = 0;  ///< Of the first steps.
  std::uint64_t hash = 0;
  int steps_with_contact = 0;
};

const CharacterDef character{.snap = 0.25};

CharacterState shot(Random& random, const Scene& scene) {
  CharacterState state;
  state.position = random.point(scene.origin, scene.origin + Vec2d(arena_width, arena_height));
  state.velocity = random.point({-200, -200}, {200, 200});
  return state;
}

Input any_input(Random& random) {
  return {.move = static_cast<double>(random.below(5)) / 2 - 1, .jump = random.below(3) == 0};
}

/// @param first steps are hashed apart.
/// @param make one step of all: it adds to the hash what came of it. @return whether there was a contact.
template <class Make>
RunResult make_steps(const Scene& scene, int steps, int first, const Make& make) {
  std::vector<MoverMotion> motions(scene.shuttles.size());
  Hash hash;
  RunResult result;
  for (int step = 0; step < steps; ++step) {
    if (step == first) result.first_hash = hash.value();
    for (std::size_t i = 0; i < motions.size(); ++i)
      motions[i] = {scene.shuttles[i].offset_at(step * dt), scene.shuttles[i].offset_at((step + 1) * dt)};
    result.steps_with_contact += make(step, StepContext{{0.0, -30.0}, dt, motions}, hash);
  }
  result.hash = hash.value();
  return result;
}

/// Walks and jumps at random; now and then the character is put somewhere else and shot in some direction.
RunResult run(const Scene& scene, std::string_view kind, int steps) {
  const Scenery scenery(scene.scenery);
  const TechniqueController controller = make_controller(scenery, character, {.name = kind});
  Scratch scratch = controller.make_scratch();
  StepReport report;
  CharacterState state;
  Input input;
  Random random(5);
  return make_steps(scene, steps, first_steps, [&](int step, const StepContext& context, Hash& hash) {
    if (step % steps_between_shots == 0) state = shot(random, scene);
    if (step % 20 == 0) input = any_input(random);
    controller.step(state, input, context, scratch, report);
    add_step(hash, state, report);
    return !report.move.contacts.empty();
  });
}

/// Several that take turns: the steps are shared between them.
RunResult run_together(const Scene& scene, int steps) {
  constexpr std::size_t count = 8;
  Level level(scene.scenery);
  const Controller controller(level, character);
  Scratch scratch = controller.make_scratch();
  TogetherScratch turns;
  std::vector<StepReport> reports(count);
  std::vector<CharacterState> states(count);
  std::vector<Companion> companions(count);
  for (std::size_t i = 0; i < count; ++i)
    companions[i] = {&controller, &states[i], {}, level.add(body_of(character)), &scratch, &reports[i]};
  Random random(8);
  const auto make = [&](int step, const StepContext& context, Hash& hash) {
    for (std::size_t i = 0; i < count; ++i) {
      if (step % steps_between_shots == 0) states[i] = shot(random, scene);
      if (step % 20 == 0) companions[i].input = any_input(random);
    }
    step_together(companions, context, turns);
    bool have_met = false;
    for (std::size_t i = 0; i < count; ++i) {
      hash.add(companions[i].turn);
      add_step(hash, states[i], reports[i]);
      for (const Contact& contact : reports[i].move.contacts)
        have_met = have_met || contact.collider >= companions[0].body;
    }
    return have_met;
  };
  return make_steps(scene, steps / static_cast<int>(count), first_steps / static_cast<int>(count), make);
}

using Lines = std::map<std::string, std::string>;

/// @param run called with the number of steps.
template <class Run>
std::string line_of(const Run& run, int steps) {
  try {
    const RunResult result = run(steps);
    std::ostringstream line;
    line << std::hex;
    if (steps == first_steps)
      line << result.hash;
    else
      line << result.first_hash << ' ' << result.hash << ' ' << std::dec << result.steps_with_contact;
    return line.str();
  } catch (const NotExpressible&) {
    return "not_expressible";
  }
}

Lines run_all(int steps) {
  Lines lines;
  for (const Scene& scene : make_scenes()) {
    for (const std::string_view kind : technique_names())
      lines[scene.name + ' ' + std::string(kind) + " double"] =
          line_of([&](int count) { return run(scene, kind, count); }, steps);
    lines[scene.name + " together double"] = line_of([&](int count) { return run_together(scene, count); }, steps);
  }
  return lines;
}

/// Lines `scene technique scalar hash hash steps`; what starts with # is a comment.
/// @param first only the hash of the first steps.
Lines read_lines(const char* file, bool first) {
  std::ifstream in(file);
  Lines lines;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string scene, technique, scalar, rest;
    if (line.starts_with('#') || !(words >> scene >> technique >> scalar >> std::ws)) continue;
    std::getline(words, rest);
    lines[scene + ' ' + technique + ' ' + scalar] = first ? rest.substr(0, rest.find(' ')) : rest;
  }
  return lines;
}

int compare(const Lines& golden, const Lines& here) {
  int differences = 0;
  Lines all = golden;
  all.insert(here.begin(), here.end());
  const auto value_of = [](const Lines& lines, const std::string& key) {
    return lines.contains(key) ? lines.at(key) : "absent";
  };
  for (const auto& [key, ignored] : all) {
    if (value_of(golden, key) == value_of(here, key)) continue;
    ++differences;
    std::cout << key << ": golden " << value_of(golden, key) << ", here " << value_of(here, key) << '\n';
  }
  std::cout << here.size() << " runs, " << differences << " differences\n";
  return differences == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace paperproof::golden

int main(int argc, char** argv) {
  using namespace paperproof::golden;
  const bool first = argc > 2 && std::string(argv[2]) == "tenth";
  const Lines here = run_all(first ? first_steps : steps_per_run);
  if (argc > 1) return compare(read_lines(argv[1], first), here);
  for (const auto& [key, found] : here) std::cout << key << ' ' << found << '\n';
  return EXIT_SUCCESS;
}
