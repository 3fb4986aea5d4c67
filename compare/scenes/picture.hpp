/// A picture as scenery, and alone as a scene.
#pragma once

#include "scenes/pixel_rectangles.hpp"
#include "scenes/png_file.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

namespace paperproof::compare {

/// Red, green, blue.
using Colour = std::array<std::uint8_t, 3>;

/// A colour of a palette, by its number. Unlike `Colour` it tells two of the same red, green and blue apart.
struct PaletteIndex {
  std::uint8_t index = 0;
};

/// Which pixels of a picture are solid. One that is more than half transparent never is.
struct PictureRule {
  std::variant<Colour, PaletteIndex> pixels = Colour{255, 255, 255};
  bool is_background = false;  ///< True: all pixels but these are solid. False: these alone.
};

/// A colour written as `#rrggbb`, in either letter case; none where `text` is not that.
[[nodiscard]] std::optional<Colour> colour_from(std::string_view text) noexcept;

/// The solid pixels of a picture. Its upper left corner is put at the origin, as a map's.
/// @param rule an index only where the picture has a palette.
/// @param given the file as the user named it.
/// @throws InputError: not one solid pixel, or too many rectangles of them.
[[nodiscard]] PixelScenery scenery_of(const PngPicture& picture, const PictureRule& rule, double pixels_per_metre,
                                      const std::string& given);

/// White pixels are solid, 32 to a metre, as in a JSON scene that says nothing else; the character begins above the
/// first ground. @throws InputError
[[nodiscard]] Scene read_picture_map(const std::string& path, const std::string& given);

}  // namespace paperproof::compare
