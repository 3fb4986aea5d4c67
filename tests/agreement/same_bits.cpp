// Runs every technique in both scalars through random scenery and hashes every bit that a step produces.
//   same_bits            prints one line per scene, technique and scalar: its hash, and how many steps had a contact
//   same_bits GOLDEN     compares with such lines, and prints both where they differ; exit status 1 then
// Nothing here may depend on the compiler either: no distribution of the standard library, no libm beyond sqrt.
#include <paperproof/paperproof.hpp>

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace {

using paperproof::ColliderDef;
using paperproof::SceneryDef;
using paperproof::Vec2d;

constexpr int steps_per_run = 20000;
constexpr int steps_between_shots = 250;
constexpr double arena_width = 40;
constexpr double arena_height = 20;

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  std::uint64_t below(std::uint64_t count) { return bits_() % count; }
  Vec2d point(const Vec2d& low, const Vec2d& high) {
    const double x = uniform(low.x(), high.x());
    const double y = uniform(low.y(), high.y());
    return {x, y};
  }

 private:
  std::mt19937_64 bits_;
};

class Hash {
 public:
  template <class Value>
  void add(Value value) {
    if constexpr (std::is_same_v<Value, double>) {
      add_bits(std::bit_cast<std::uint64_t>(value));
    } else if constexpr (std::is_same_v<Value, float>) {
      add_bits(std::bit_cast<std::uint32_t>(value));
    } else {
      add_bits(static_cast<std::uint64_t>(value));
    }
  }
  template <class Scalar>
  void add(const paperproof::Vec2<Scalar>& value) {
    add(value.x());
    add(value.y());
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  // FNV-1a, byte by byte (Fowler, Noll, Vo; draft-eastlake-fnv).
  void add_bits(std::uint64_t bits) {
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) value_ = (value_ ^ (bits & 0xff)) * 0x100000001b3U;
  }
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

ColliderDef polygon(const Vec2d& at, std::vector<Vec2d> points) {
  for (Vec2d& point : points) point += at;
  return {.points = std::move(points)};
}

ColliderDef chain(const Vec2d& at, std::vector<Vec2d> points, bool one_way) {
  ColliderDef def = polygon(at, std::move(points));
  def.shape = ColliderDef::Shape::chain;
  if (one_way) def.one_way = Vec2d(0, 1);
  return def;
}

ColliderDef box(const Vec2d& at, double width, double height) {
  return polygon(at, {{0, 0}, {width, 0}, {width, height}, {0, height}});
}

ColliderDef random_box(Random& random, const Vec2d& at) {
  const double width = random.uniform(0.2, 4);
  return box(at, width, random.uniform(0.2, 2));
}

ColliderDef random_slope(Random& random, const Vec2d& at) {
  const double width = random.uniform(0.5, 5);
  const double height = random.uniform(0.1, 3);
  switch (random.below(4)) {
    case 0:
      return polygon(at, {{0, 0}, {width, 0}, {0, height}});
    case 1:
      return polygon(at, {{0, height}, {width, height}, {0.3 * width, 0}});
    case 2:
      return polygon(at, {{0, 0}, {width, 0}, {width, height}, {0.5 * width, 0.2 * height}, {0, height}});
    default:
      return polygon(at, {{0, 0}, {width, 0}, {0.8 * width, height}, {0.1 * width, 0.7 * height}});
  }
}

ColliderDef random_paper(Random& random, const Vec2d& at) {
  const double width = random.uniform(0.5, 6);
  const double rise = random.uniform(-1, 1);
  const double thickness = 0.001;
  switch (random.below(4)) {
    case 0:
      return box(at, width, thickness);
    case 1:
      return polygon(at, {{0, 0}, {width, rise}, {width, rise + thickness}, {0, thickness}});
    case 2:
      return chain(at, {{0, 0}, {0.5 * width, rise}, {width, 0}}, false);
    default:
      return chain(at, {{0, 0}, {width, rise}}, true);
  }
}

struct Scene {
  std::string name;
  Vec2d origin;
  SceneryDef scenery;
};

Scene make_scene(const std::string& name, const Vec2d& origin, std::uint64_t seed, int pieces,
                 const std::function<ColliderDef(Random&, const Vec2d&)>& make_piece) {
  Scene scene{name, origin, {}};
  std::vector<ColliderDef>& colliders = scene.scenery.colliders;
  colliders.push_back(box(origin - Vec2d(1, 1), arena_width + 2, 1));
  colliders.push_back(box(origin + Vec2d(-1, arena_height), arena_width + 2, 1));
  colliders.push_back(box(origin - Vec2d(1, 0), 1, arena_height));
  colliders.push_back(box(origin + Vec2d(arena_width, 0), 1, arena_height));
  Random random(seed);
  for (int piece = 0; piece < pieces; ++piece) {
    const Vec2d at = random.point(origin, origin + Vec2d(arena_width, arena_height));
    colliders.push_back(make_piece(random, at));
  }
  return scene;
}

std::vector<Scene> make_scenes() {
  const auto any = [](Random& random, const Vec2d& at) {
    switch (random.below(3)) {
      case 0:
        return random_box(random, at);
      case 1:
        return random_slope(random, at);
      default:
        return random_paper(random, at);
    }
  };
  return {make_scene("boxes", {0, 0}, 1, 40, random_box), make_scene("slopes", {-13, 7}, 2, 40, random_slope),
          make_scene("paper", {0.1, 0.7}, 3, 40, random_paper), make_scene("far_away", {1e5, -1e5}, 4, 60, any)};
}

template <class Scalar>
void add_step(Hash& hash, const paperproof::CharacterState<Scalar>& state,
              const paperproof::StepReport<Scalar>& report) {
  hash.add(state.position);
  hash.add(state.velocity);
  hash.add(state.last_free);
  for (const bool flag : {state.has_last_free, state.grounded, state.jumping, state.jump_held, state.jump_pending,
                          state.wall_left, state.wall_right}) {
    hash.add(flag);
  }
  hash.add(state.stuck_steps);
  hash.add(report.status);
  hash.add(report.requested);
  for (const paperproof::PathPoint<Scalar>& corner : report.move.path) {
    hash.add(corner.position);
    hash.add(corner.fraction);
  }
  for (const paperproof::Contact<Scalar>& contact : report.move.contacts) {
    hash.add(contact.collider);
    hash.add(contact.point);
    hash.add(contact.normal);
    hash.add(contact.fraction);
    hash.add(contact.separation);
    hash.add(contact.side);
  }
}

struct RunResult {
  std::uint64_t hash = 0;
  int steps_with_contact = 0;
};

/// Walks and jumps at random; now and then the character is put somewhere else and shot in some direction.
template <class Scalar>
RunResult run(const Scene& scene, paperproof::TechniqueKind kind) {
  const paperproof::Scenery<Scalar> scenery(scene.scenery);
  paperproof::CharacterDef character;
  character.snap = 0.25;
  const paperproof::Controller<Scalar> controller(scenery, character, {.kind = kind});
  paperproof::Scratch<Scalar> scratch = controller.make_scratch();
  paperproof::StepReport<Scalar> report;
  paperproof::CharacterState<Scalar> state;
  paperproof::Input input;
  Random random(5);
  Hash hash;
  RunResult result;
  for (int step = 0; step < steps_per_run; ++step) {
    if (step % steps_between_shots == 0) {
      state = {};
      state.position = random.point(scene.origin, scene.origin + Vec2d(arena_width, arena_height)).cast<Scalar>();
      state.velocity = random.point({-200, -200}, {200, 200}).cast<Scalar>();
    }
    if (step % 20 == 0) {
      input.move = static_cast<double>(random.below(5)) / 2 - 1;
      input.jump = random.below(3) == 0;
    }
    const paperproof::Vec2<Scalar> gravity(Scalar(0), Scalar(-30));
    controller.step(state, input, gravity, Scalar(1) / Scalar(60), scratch, report);
    add_step(hash, state, report);
    if (!report.move.contacts.empty()) ++result.steps_with_contact;
  }
  result.hash = hash.value();
  return result;
}

using Lines = std::map<std::string, std::string>;

template <class Scalar>
std::string line_of(const Scene& scene, paperproof::TechniqueKind kind) {
  try {
    const RunResult result = run<Scalar>(scene, kind);
    std::ostringstream line;
    line << std::hex << result.hash << std::dec << ' ' << result.steps_with_contact;
    return line.str();
  } catch (const paperproof::NotExpressible&) {
    return "not_expressible";
  }
}

Lines run_all() {
  Lines lines;
  for (const Scene& scene : make_scenes()) {
    for (const paperproof::TechniqueKind kind : paperproof::all_techniques) {
      const std::string key = scene.name + ' ' + std::string(paperproof::name_of(kind)) + ' ';
      lines[key + "double"] = line_of<double>(scene, kind);
      // At 1e5 m a float knows a position to 8 mm only: paper is nothing there, and refused.
      if (scene.name != "far_away") lines[key + "float"] = line_of<float>(scene, kind);
    }
  }
  return lines;
}

/// Lines `scene technique scalar hash steps`; what starts with # is a comment.
Lines read_lines(const char* file) {
  std::ifstream in(file);
  Lines lines;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string scene, technique, scalar, rest;
    if (words >> scene && !scene.starts_with('#') && words >> technique >> scalar &&
        std::getline(words >> std::ws, rest)) {
      lines[scene + ' ' + technique + ' ' + scalar] = rest;
    }
  }
  return lines;
}

int compare(const Lines& golden, const Lines& here) {
  int differences = 0;
  const auto show = [&](const std::string& key, const std::string& expected, const std::string& found) {
    ++differences;
    std::cout << key << ": golden " << expected << ", here " << found << '\n';
  };
  for (const auto& [key, found] : here) {
    const auto expected = golden.find(key);
    if (expected == golden.end()) {
      show(key, "absent", found);
    } else if (expected->second != found) {
      show(key, expected->second, found);
    }
  }
  for (const auto& [key, expected] : golden) {
    if (!here.contains(key)) show(key, expected, "absent");
  }
  std::cout << here.size() << " runs, " << differences << " differences\n";
  return differences == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  const Lines here = run_all();
  if (argc > 1) return compare(read_lines(argv[1]), here);
  for (const auto& [key, found] : here) std::cout << key << ' ' << found << '\n';
  return EXIT_SUCCESS;
}
