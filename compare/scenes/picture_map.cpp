#include "scenes/picture_map.hpp"

#include "scenes/input_error.hpp"
#include "scenes/map_defaults.hpp"
#include "scenes/picture.hpp"
#include "scenes/spawn.hpp"
#include "scenes/validate.hpp"

#include <filesystem>

namespace paperproof::compare {

Scene read_picture_map(const std::string& path, const std::string& given) {
  Scene scene;
  scene.name = std::filesystem::path(given).stem().string();
  set_map_defaults(scene);
  PixelScenery pixels = scenery_of(read_png(path, given), PictureRule{}, scene.pixels_per_metre, given);
  scene.scenery = std::move(pixels.scenery);
  scene.ids = std::move(pixels.ids);
  scene.has_pixels = true;
  scene.respawn_box = pixels.box;
  check_scenery(scene.scenery, scene.ids, [&](ColliderIndex) { return given; });
  constexpr double column = 1;  // [m] between two places that are tried
  const std::optional<Vec2d> start = first_ground(scene, pixels.box, column);
  if (!start) refuse(given, "expected ground (white pixels) with room for the character above it to begin on");
  scene.start.position = *start;
  scene.notes.emplace_back("white pixels are solid, 32 to a metre; the character begins above the first ground");
  return scene;
}

}  // namespace paperproof::compare
