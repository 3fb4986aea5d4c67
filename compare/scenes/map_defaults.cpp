#include "scenes/map_defaults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "scenes/validate.hpp"

namespace paperproof::compare {

void set_map_defaults(Scene& scene) {
  scene.steps = 3600;
  scene.character.max_fall_speed = 25;  // [m/s]; a fall down a whole level would reach 60 m/s
  scene.moves_at_random = 1;            // a character that stands still meets nothing
  // Where a slope or a floor is drawn by hand its ends lie on whole or half pixels: beside its neighbour, which is off
  // by as much, there is a kerb of up to a pixel. Without a step height 6 mm hold a walker up for ever.
  scene.character.step_height = 1 / scene.pixels_per_metre;
  scene.description =
      fmt::format("its character climbs kerbs up to a pixel of the map ({:.4g} m)", scene.character.step_height);
}

std::optional<Vec2d> first_ground(const Scene& scene, const Box2& box, double column) {
  const SceneryDef scenery = scenery_at(scene, 0);
  const FreePlaces places(scenery, scene.character.shape);
  const Box2& body = scene.character.shape.box();
  constexpr double above = 1.0 / 16;
  for (int i = 0;; ++i) {
    const double x = box.lower.x() + (i + 0.5) * column;
    if (x > box.upper.x()) return std::nullopt;
    std::vector<double> grounds;
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    for (const ColliderIndex near : places.near({{x, -everywhere}, {x, everywhere}}))
      grounds.push_back(box_of(scenery.colliders[near]).upper.y());
    std::sort(grounds.begin(), grounds.end(), std::greater<>());
    for (const double ground : grounds) {
      const Vec2d position{x, ground + above - body.lower.y()};
      if (position.y() + body.upper.y() <= box.upper.y() && places.is_free(position)) return position;
    }
  }
}

std::optional<Vec2d> free_place_near(const Scene& scene, const Box2& box, const Vec2d& wanted) {
  const SceneryDef scenery = scenery_at(scene, 0);
  const FreePlaces places(scenery, scene.character.shape);
  constexpr double pixel = 1.0 / 32;
  const auto search_up = [&](double x, int pixels) -> std::optional<Vec2d> {
    for (int i = 0; i <= pixels; ++i) {
      const Vec2d position{x, wanted.y() + i * pixel};
      if (places.is_free(position)) return position;
    }
    return std::nullopt;
  };
  constexpr int near = 5 * 32;
  for (int columns = 0; columns <= 8; ++columns) {
    for (const int direction : {1, -1}) {
      if (const auto found = search_up(wanted.x() + direction * columns, near)) return found;
    }
  }
  const double to_top = std::max(box.upper.y() - wanted.y(), 0.0) / pixel;
  constexpr double most = 1 << 16;
  return search_up(wanted.x(), static_cast<int>(std::min(to_top, most)));
}

}  // namespace paperproof::compare
