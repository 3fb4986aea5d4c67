#include "scenes/png_file.hpp"

#include "scenes/input_error.hpp"

#include <fmt/format.h>
#include <lodepng.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

/// 256 MiB once it is unpacked, and four times that on the way where a channel has 16 bits.
constexpr std::uint64_t max_pixels = std::uint64_t{1} << 26;
constexpr std::size_t bytes_per_colour = 4;

/// No fewer than the bytes of any picture of that size, each row with its filter. The seven passes of an interlaced one
/// have less than two rows for each of the picture's, and each of them is filled up to a whole byte.
std::size_t most_unpacked(std::size_t width, std::size_t height, std::size_t bits_per_pixel) {
  return width * height * bits_per_pixel / 8 + 4 * height + 16;
}

std::vector<Rgba> palette_of(const LodePNGColorMode& kind) {
  std::vector<Rgba> palette(kind.palettesize);
  for (std::size_t i = 0; i < palette.size(); ++i)
    std::copy_n(kind.palette + bytes_per_colour * i, bytes_per_colour, palette[i].begin());
  return palette;
}

/// One byte for each index. @param packed without gaps, the first index in the highest bits.
std::vector<std::uint8_t> unpacked(const std::vector<std::uint8_t>& packed, std::size_t depth, std::size_t count) {
  std::vector<std::uint8_t> indices(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t after = 8 - depth - i * depth % 8;  // bits behind it in its byte
    indices[i] = static_cast<std::uint8_t>(packed[i * depth / 8] >> after & ((1U << depth) - 1));
  }
  return indices;
}

}  // namespace

Rgba PngPicture::colour_at(int column, int row) const noexcept {
  if (!palette.empty()) return palette[index_at(column, row)];
  const std::uint8_t* at = bytes.data() + place_of(column, row) * bytes_per_colour;
  return {at[0], at[1], at[2], at[3]};
}

PngPicture read_png(const std::string& path, const std::string& given) {
  const std::string file = read_file(path, given);
  const auto* const begin = reinterpret_cast<const unsigned char*>(file.data());
  const auto check = [&](unsigned error) {
    if (error != 0) refuse(given, fmt::format("expected a PNG picture ({})", lodepng_error_text(error)));
  };
  lodepng::State state;
  unsigned width = 0;
  unsigned height = 0;
  check(lodepng_inspect(&width, &height, &state, begin, file.size()));
  const std::uint64_t count = std::uint64_t{width} * height;
  if (count > max_pixels)
    refuse(given, fmt::format("expected a picture of at most {} pixels, not {} x {}", max_pixels, width, height));
  const LodePNGColorMode& kind = state.info_png.color;
  const bool is_indexed = kind.colortype == LCT_PALETTE;
  state.decoder.zlibsettings.max_output_size = most_unpacked(width, height, lodepng_get_bpp(&kind));
  state.decoder.read_text_chunks = 0;
  // A converted index would be lost where two entries of the palette look alike.
  state.decoder.color_convert = is_indexed ? 0 : 1;
  state.info_raw.colortype = LCT_RGBA;
  state.info_raw.bitdepth = 8;
  PngPicture picture;
  check(lodepng::decode(picture.bytes, width, height, state, begin, file.size()));
  picture.width = static_cast<int>(width);
  picture.height = static_cast<int>(height);
  if (!is_indexed) return picture;
  picture.palette = palette_of(kind);
  picture.bytes = unpacked(picture.bytes, kind.bitdepth, count);
  const std::uint8_t highest = *std::max_element(picture.bytes.begin(), picture.bytes.end());
  if (highest >= picture.palette.size())
    refuse(given, fmt::format("expected a PNG picture (a pixel has index {}, and its palette {} colours)", highest,
                              picture.palette.size()));
  return picture;
}

}  // namespace paperproof::compare
