/// PNG files of every kind, as lodepng writes them.
#pragma once

#include <gtest/gtest.h>
#include <lodepng.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace paperproof::compare {

/// Most significant byte first.
inline std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((number >> shift) & 0xffU);
  return bytes;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string summed = type + data;
  const unsigned sum = lodepng_crc32(reinterpret_cast<const unsigned char*>(summed.data()), summed.size());
  return big_endian(static_cast<std::uint32_t>(data.size())) + summed + big_endian(sum);
}

struct PngFile {
  LodePNGColorType colour = LCT_GREY;
  int depth = 8;  ///< Bits of a sample.
  bool interlaced = false;
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> samples{};  ///< Row by row from the top, the channels of a pixel side by side.
  std::vector<std::array<std::uint8_t, 4>> palette{};
  std::vector<std::uint16_t> transparent{};  ///< Of a kind without alpha: the sample, or the three, that tRNS names.

  [[nodiscard]] int channels() const { return std::array{1, 0, 3, 1, 2, 0, 4}.at(std::size_t(colour)); }
  [[nodiscard]] std::uint16_t sample(int column, int row, int channel) const {
    return samples[static_cast<std::size_t>((row * width + column) * channels() + channel)];
  }
  [[nodiscard]] std::string bytes() const {
    lodepng::State state;
    state.encoder.auto_convert = 0;
    state.info_png.interlace_method = interlaced ? 1 : 0;
    LodePNGColorMode& kind = state.info_png.color;
    kind.colortype = colour;
    kind.bitdepth = static_cast<unsigned>(depth);
    for (const auto& [red, green, blue, alpha] : palette) lodepng_palette_add(&kind, red, green, blue, alpha);
    if (!transparent.empty()) {
      kind.key_defined = 1;
      kind.key_r = transparent.front();
      kind.key_g = transparent[transparent.size() / 2];
      kind.key_b = transparent.back();
    }
    lodepng_color_mode_copy(&state.info_raw, &kind);
    const auto bits = static_cast<std::size_t>(depth);
    std::vector<unsigned char> packed((samples.size() * bits + 7) / 8);
    for (std::size_t bit = 0; bit < samples.size() * bits; ++bit) {
      const unsigned is_set = samples[bit / bits] >> (bits - 1 - bit % bits) & 1U;
      packed[bit / 8] = static_cast<unsigned char>(packed[bit / 8] | is_set << (7 - bit % 8));
    }
    std::vector<unsigned char> file;
    EXPECT_EQ(lodepng::encode(file, packed, static_cast<unsigned>(width), static_cast<unsigned>(height), state), 0U);
    return {file.begin(), file.end()};
  }
};

}  // namespace paperproof::compare
