#include "studies/scale.hpp"

#include "scenes/scene.hpp"

#include <paperproof/techniques.hpp>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>

namespace paperproof::compare {
namespace {

constexpr double between_floors = 8;  ///< [m] Higher than a jump.
constexpr int steps = 600;
constexpr std::size_t repeats = 9;
constexpr std::uint64_t seed = 1;

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

SceneryDef floors(std::size_t tiles) {
  SceneryDef def;
  def.colliders.reserve(tiles);
  const std::size_t count = tiles / tiles_per_floor;
  for (std::size_t floor = 0; floor < count; ++floor) {
    // The middle floor is at height zero.
    const double y = (static_cast<double>(floor) - static_cast<double>(count / 2)) * between_floors;
    for (std::size_t i = 0; i < tiles_per_floor; ++i) {
      const double x = static_cast<double>(i) - static_cast<double>(tiles_per_floor) / 2;
      def.colliders.push_back({.points = {{x, y - 1}, {x + 1, y - 1}, {x + 1, y}, {x, y}}});
    }
  }
  return def;
}

std::vector<Input> inputs() {
  const std::vector<InputEvent> events = random_input(seed, steps);
  std::vector<Input> all;
  for (int step = 0; step < steps; ++step) all.push_back(input_at(events, step));
  return all;
}

/// One search in one level, ready to run again and again.
class Subject {
 public:
  Subject(PieceSearch search, const Scenery& scenery) {
    const auto begin = Clock::now();
    controller_ = std::make_unique<Controller>(scenery, CharacterDef{}, SweepDef{.search = search});
    point_.build_ms = milliseconds_since(begin);
    point_.search = search;
    point_.pieces = scenery.pieces().size();
    point_.steps = steps;
    scratch_ = controller_->make_scratch();
  }

  /// From the start, with every position kept.
  std::vector<Vec2d> positions(const std::vector<Input>& inputs) {
    std::vector<Vec2d> all;
    CharacterState hero = start();
    for (const Input& input : inputs) {
      step(hero, input);
      all.push_back(hero.position);
    }
    return all;
  }

  void time(const std::vector<Input>& inputs) {
    CharacterState hero = start();
    const auto begin = Clock::now();
    for (const Input& input : inputs) step(hero, input);
    costs_.push_back(milliseconds_since(begin) * 1e6 / static_cast<double>(inputs.size()));
  }

  [[nodiscard]] ScalePoint finish(bool same_bits) {
    std::sort(costs_.begin(), costs_.end());
    point_.ns_per_step_min = costs_.front();
    point_.ns_per_step_median = costs_[costs_.size() / 2];
    point_.ns_per_step_max = costs_.back();
    point_.same_bits = same_bits;
    return point_;
  }

 private:
  static CharacterState start() {
    CharacterState hero;
    hero.position = {0, 1};
    return hero;
  }
  void step(CharacterState& hero, const Input& input) {
    controller_->step(hero, input, {{0, -30}, 1.0 / 60}, scratch_, report_);
  }

  std::unique_ptr<Controller> controller_;
  Scratch scratch_;
  StepReport report_;
  ScalePoint point_;
  std::vector<double> costs_;
};

void study_level(std::size_t pieces, const std::vector<Input>& inputs, std::vector<ScalePoint>& points) {
  const Scenery scenery(floors(pieces));
  std::vector<Subject> subjects;
  for (const PieceSearch search : scale_searches) subjects.emplace_back(search, scenery);
  // The warm-up, and what both have to give.
  const std::vector<Vec2d> expected = subjects.front().positions(inputs);
  std::vector<bool> same;
  for (Subject& subject : subjects) same.push_back(subject.positions(inputs) == expected);
  for (std::size_t run = 0; run < repeats; ++run)
    for (Subject& subject : subjects) subject.time(inputs);
  for (std::size_t i = 0; i < subjects.size(); ++i) points.push_back(subjects[i].finish(same[i]));
}

}  // namespace

std::vector<ScalePoint> study_scale(const std::vector<std::size_t>& counts,
                                    const std::function<void(double)>& progress) {
  for (const std::size_t count : counts) {
    if (count == 0 || count % tiles_per_floor != 0 || count > most_tiles)
      throw std::invalid_argument("pieces: expected a multiple of " + std::to_string(tiles_per_floor) + " from " +
                                  std::to_string(tiles_per_floor) + " to " + std::to_string(most_tiles) + ", not " +
                                  std::to_string(count));
  }
  const std::vector<Input> same_for_all = inputs();
  std::vector<ScalePoint> points;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(counts.size()));
    study_level(counts[i], same_for_all, points);
  }
  return points;
}

double growth(const std::vector<ScalePoint>& points, PieceSearch search) {
  const ScalePoint* fewest = nullptr;
  const ScalePoint* most = nullptr;
  for (const ScalePoint& point : points) {
    if (point.search != search) continue;
    if (fewest == nullptr || point.pieces < fewest->pieces) fewest = &point;
    if (most == nullptr || point.pieces > most->pieces) most = &point;
  }
  return fewest == nullptr ? 1 : most->ns_per_step_min / fewest->ns_per_step_min;
}

}  // namespace paperproof::compare
