#include "campaign/play_levels.hpp"

#include "campaign/shapes.hpp"

namespace paperproof::compare {
namespace {

constexpr double half_hall = 30;  ///< [m]

/// Builds from left to right.
class LevelBuilder {
 public:
  explicit LevelBuilder(Random& random) : random_(random) {
    add(box(-half_hall, -13, half_hall, -12));
    add(box(-half_hall - 1, -13, -half_hall, 40));
    add(box(half_hall, -13, half_hall + 1, 40));
  }

  SceneryDef level(PlayLevel level) {
    using Part = void (LevelBuilder::*)();
    using B = LevelBuilder;
    constexpr std::array<Part, play_level_names.size()> parts{&B::gap,        &B::kerb,  &B::ramp, &B::funnel,
                                                              &B::turned_box, &B::tooth, &B::arch, &B::dead_end};
    const Part part = parts[static_cast<std::size_t>(level)];
    if (level == PlayLevel::platforms)
      for (int i = 0; i < 150; ++i) (this->*part)();
    else
      while (x_ < half_hall - 8) (this->*part)();
    return std::move(def_);
  }

 private:
  void add(ColliderDef collider) { def_.colliders.push_back(std::move(collider)); }

  void gap() {
    const double width = random_.between(1, 6);
    add(box(x_, y_ - 3, x_ + width, y_));
    x_ += width + random_.between(0.7, 3);
    y_ += random_.between(-0.25, 0.25);
  }

  void kerb() {
    const double width = random_.between(0.3, 3);
    add(box(x_, y_ - 6, x_ + width, y_));
    x_ += width;
    y_ += random_.between(-0.5, 0.5);
  }

  void ramp() {
    const double width = random_.between(2, 6);
    const double height = random_.between(0.5, 4);
    const double base = height / std::tan(random_.between(30, 89.5) * degree);
    const double foot = x_ + width / 2;
    add(box(x_, -3, x_ + width, 0));
    const double top = random_.chance(0.5) ? foot : foot + base;
    add(polygon({{foot, 0}, {foot + base, 0}, {top, height}}));
    x_ += width + random_.between(0, 3);
  }

  void funnel() {
    const double width = random_.between(2, 4);
    const double depth = random_.between(1, 4);
    const double half_gap = random_.between(0, 0.6);
    const double middle = x_ + width / 2;
    add(polygon({{x_, 0}, {x_, -depth}, {middle - half_gap, -depth}}));
    add(polygon({{x_ + width, 0}, {middle + half_gap, -depth}, {x_ + width, -depth}}));
    x_ += width;
  }

  void turned_box() {
    const Vec2d middle{random_.between(-half_hall, half_hall), random_.between(-10, 8)};
    const Vec2d half{random_.between(0.025, 2), random_.between(0.01, 0.75)};
    const double angle = random_.chance(0.7) ? 0 : random_.between(-1.5, 1.5);
    const auto corner = [&](double x, double y) -> Vec2d {
      return {middle.x() + std::cos(angle) * x - std::sin(angle) * y,
              middle.y() + std::sin(angle) * x + std::cos(angle) * y};
    };
    add(polygon({corner(-half.x(), -half.y()), corner(half.x(), -half.y()), corner(half.x(), half.y()),
                 corner(-half.x(), half.y())}));
  }

  void tooth() {
    const double width = random_.between(0.2, 2);
    const double height = random_.between(0.1, 2);
    const double top = x_ + width * random_.unit();
    add(polygon({{x_, -3}, {x_ + width, -3}, {x_ + width, 0}, {top, height}, {x_, 0}}));
    x_ += width;
  }

  void arch() {
    const double radius = random_.between(0.5, 4);
    const int edges = random_.integer(4, 33);
    std::vector<Vec2d> outline;
    for (int i = 0; i <= edges; ++i) {
      const double angle = std::numbers::pi * i / edges;
      outline.push_back({x_ + radius + radius * std::cos(angle), radius * std::sin(angle)});
    }
    outline.push_back({x_, -1});
    outline.push_back({x_ + 2 * radius, -1});
    add(polygon(std::move(outline)));
    x_ += 2 * radius + random_.between(0, 1.5);
  }

  /// The default limit is 50 degrees.
  void dead_end() {
    const double length = random_.between(1, 6);
    const double height = length * std::tan(random_.between(5, 49.5) * degree);
    const double wall = x_ + length;
    add(polygon({{x_, 0}, {wall, 0}, {wall, height}}));
    add(box(wall, -1, wall + random_.between(0.3, 2), height + random_.between(0.2, 4)));
    add(box(x_ - 1, -1, wall, 0));
    if (random_.chance(0.5)) add(box(x_, height + random_.between(0.8, 3), wall, height + 3.5));
    x_ = wall + random_.between(2, 5);
  }

  Random& random_;
  SceneryDef def_;
  double x_ = -half_hall;
  double y_ = 0;
};

}  // namespace

SceneryDef play_level(PlayLevel level, Random& random) { return LevelBuilder(random).level(level); }

CharacterShape play_shape(int which) {
  if (which == 0) return CharacterShape::article();
  const std::array<Vec2d, 4> box{Vec2d(-0.3, -0.5), Vec2d(0.3, -0.5), Vec2d(0.3, 0.5), Vec2d(-0.3, 0.5)};
  const std::array<Vec2d, 3> triangle{Vec2d(-0.3, -0.5), Vec2d(0.3, -0.5), Vec2d(0, 0.5)};
  return which == 1 ? CharacterShape(box) : CharacterShape(triangle);
}

}  // namespace paperproof::compare
