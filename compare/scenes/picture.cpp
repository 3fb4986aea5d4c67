#include "scenes/picture.hpp"

#include "scenes/input_error.hpp"
#include "scenes/map_defaults.hpp"
#include "scenes/validate.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

namespace paperproof::compare {
namespace {

constexpr std::uint8_t half_transparent = 128;

std::string text_of(const std::variant<Colour, PaletteIndex>& pixels) {
  if (const auto* entry = std::get_if<PaletteIndex>(&pixels))
    return fmt::format("colour {} of the palette", entry->index);
  const Colour& colour = std::get<Colour>(pixels);
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

bool is_named(const PngPicture& picture, const PictureRule& rule, int column, int row) {
  if (const auto* entry = std::get_if<PaletteIndex>(&rule.pixels)) return picture.index_at(column, row) == entry->index;
  const Rgba pixel = picture.colour_at(column, row);
  return Colour{pixel[0], pixel[1], pixel[2]} == std::get<Colour>(rule.pixels);
}

}  // namespace

std::optional<Colour> colour_from(std::string_view text) noexcept {
  unsigned colour = 0;
  const char* const end = text.data() + text.size();
  if (text.size() != 7 || text[0] != '#' || std::from_chars(text.data() + 1, end, colour, 16).ptr != end)
    return std::nullopt;
  const auto byte = [colour](unsigned shift) { return static_cast<std::uint8_t>(colour >> shift); };
  return Colour{byte(16), byte(8), byte(0)};
}

PixelScenery scenery_of(const PngPicture& picture, const PictureRule& rule, double pixels_per_metre,
                        const std::string& given) {
  const auto is_solid = [&](int column, int row) {
    return picture.colour_at(column, row)[3] >= half_transparent &&
           is_named(picture, rule, column, row) != rule.is_background;
  };
  PixelScenery result = scenery_of_pixels({.width = picture.width, .height = picture.height, .is_solid = is_solid},
                                          pixels_per_metre, given);
  if (result.ids.empty())
    refuse(given, fmt::format("expected a solid pixel; {} {}", rule.is_background ? "all of them are" : "none is",
                              text_of(rule.pixels)));
  return result;
}

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
