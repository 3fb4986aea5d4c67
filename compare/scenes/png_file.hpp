/// Reads PNG files: the numbers that are in the file, whatever they look like on a screen.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace paperproof::compare {

/// Red, green, blue, alpha (255: nothing shines through).
using Rgba = std::array<std::uint8_t, 4>;

/// A picture in memory; reading is thread-safe.
struct PngPicture {
  int width = 0;              ///< [px]
  int height = 0;             ///< [px]
  std::vector<Rgba> palette;  ///< Of an indexed picture; empty for all others.
  /// Row by row from the top: an index into the palette for each pixel, or four bytes where there is none.
  std::vector<std::uint8_t> bytes;

  [[nodiscard]] Rgba colour_at(int column, int row) const noexcept;
  /// Only of an indexed picture.
  [[nodiscard]] std::uint8_t index_at(int column, int row) const noexcept { return bytes[place_of(column, row)]; }
  /// How many pixels come before it.
  [[nodiscard]] std::size_t place_of(int column, int row) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }
};

/// Reads a PNG of any kind: grey, true colour or indexed, of 1 to 16 bits, with or without alpha, interlaced or not.
/// Of channels of 16 bits the upper 8 count, and those of fewer bits become the same share of 255. No gamma or colour profile
/// is applied: a level's colours are names.
/// @param given the file as the user named it.
/// @throws InputError: no file, no PNG or a broken one, more than 2^26 pixels (before anything is allocated for them),
///   a pixel whose index is beyond the palette.
[[nodiscard]] PngPicture read_png(const std::string& path, const std::string& given);

}  // namespace paperproof::compare
