/// Reads a picture (PNG) as scenery.
#pragma once

#include "scenes/scene.hpp"

#include <array>
#include <cstdint>

namespace paperproof::compare {

/// Red, green, blue.
using Colour = std::array<std::uint8_t, 3>;

/// Which pixels of a picture are solid. One that is more than half transparent never is.
struct PictureRule {
  Colour colour{255, 255, 255};
  bool is_background = false;  ///< True: every colour but this one is solid. False: this one alone.
};

/// A colour written as `#rrggbb`, in either letter case; none where `text` is not that.
[[nodiscard]] std::optional<Colour> colour_from(std::string_view text) noexcept;
[[nodiscard]] std::string text_of(const Colour& colour);

/// The solid pixels as rectangles: runs of them in a row, and runs of the same extent below each other as one.
struct PictureScenery {
  SceneryDef scenery;
  std::vector<std::string> ids;  ///< `column,row` of the upper left pixel of each.
  Box2<double> box;              ///< Of the whole picture [m].
};

/// Reads a PNG of any kind. Its upper left corner is put at the origin, as a map's; vertices are (pixels) /
/// `pixels_per_metre` with one division, so that neighbours share bits.
/// @param given the file as the user named it.
/// @throws InputError: no file, no PNG, not one solid pixel, more than 2^26 pixels or 200,000 rectangles.
[[nodiscard]] PictureScenery read_picture(const std::string& path, const std::string& given, const PictureRule& rule,
                                          double pixels_per_metre);

}  // namespace paperproof::compare
