/// PNG files of every kind, written chunk by chunk: the reader is what is tested, and the library that it asks.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

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
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(summed.data()), static_cast<uInt>(summed.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + summed + big_endian(static_cast<std::uint32_t>(sum));
}

/// By the numbers of the PNG specification.
enum class PngColour : std::uint8_t { grey = 0, rgb = 2, indexed = 3, grey_alpha = 4, rgb_alpha = 6 };

struct PngFile {
  PngColour colour = PngColour::grey;
  int depth = 8;  ///< Bits of a sample.
  bool interlaced = false;
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> samples{};  ///< Row by row from the top, the channels of a pixel side by side.
  std::string chunks{};                  ///< Those between header and pixels.

  [[nodiscard]] int channels() const { return std::array{1, 0, 3, 1, 2, 0, 4}.at(std::size_t(colour)); }
  [[nodiscard]] std::uint16_t sample(int column, int row, int channel) const {
    return samples[static_cast<std::size_t>((row * width + column) * channels() + channel)];
  }
  [[nodiscard]] std::string bytes() const {
    std::string pixels;
    if (interlaced) {
      for (const auto& [column, row, columns, rows] : std::vector<std::array<int, 4>>{
               {0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}})
        pixels += packed(column, row, columns, rows);
    } else {
      pixels = packed(0, 0, 1, 1);
    }
    std::string deflated(compressBound(pixels.size()), '\0');
    uLongf size = deflated.size();
    EXPECT_EQ(compress(reinterpret_cast<Bytef*>(deflated.data()), &size, reinterpret_cast<const Bytef*>(pixels.data()),
                       pixels.size()),
              Z_OK);
    deflated.resize(size);
    const std::string header = big_endian(static_cast<std::uint32_t>(width)) +
                               big_endian(static_cast<std::uint32_t>(height)) + static_cast<char>(depth) +
                               static_cast<char>(colour) + '\0' + '\0' + static_cast<char>(interlaced ? 1 : 0);
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + chunks + png_chunk("IDAT", deflated) +
           png_chunk("IEND", "");
  }

 private:
  /// Every `columns`-th pixel of every `rows`-th row, from one on; each row begins with its filter, which is none.
  [[nodiscard]] std::string packed(int column, int row, int columns, int rows) const {
    std::string all;
    if (column >= width) return all;
    for (int y = row; y < height; y += rows) {
      std::string line(1, '\0');
      int free = 0;  // bits in the last byte
      for (int x = column; x < width; x += columns) {
        for (int channel = 0; channel < channels(); ++channel) {
          const unsigned value = sample(x, y, channel);
          if (depth == 16) line += static_cast<char>(value >> 8U);
          if (depth < 8) {
            if (free == 0) line += '\0';
            if (free == 0) free = 8;
            free -= depth;
            line.back() = static_cast<char>(static_cast<unsigned char>(line.back()) | (value << free));
          } else {
            line += static_cast<char>(value & 0xffU);
          }
        }
      }
      all += line;
    }
    return all;
  }
};

}  // namespace paperproof::compare
