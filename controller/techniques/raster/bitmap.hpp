/// Pictures in memory: one bit per pixel, or one byte.
#pragma once

#include "techniques/raster/rasterise.hpp"

#include <vector>

namespace paperproof::raster {

/// What a picture may take [bytes]: 2^31 pixels in black and white. Smaller: long levels are refused. Larger: a
/// scene with one far piece fills the memory of a small machine.
inline constexpr std::size_t max_picture_bytes = std::size_t{1} << 28;

/// @throws NotExpressible, with the size, where a picture of this box would take more than `max_picture_bytes`.
void check_picture_size(const PixelBox& box, std::size_t bits_per_pixel);

/// Black and white. Everything outside its box is black. Rows lie from the lowest up, each in words of 64 pixels, the
/// leftmost pixel in the lowest bit. Reading is thread-safe.
class Bitmap {
 public:
  Bitmap() = default;
  /// All black.
  /// @throws NotExpressible as `check_picture_size`.
  explicit Bitmap(const PixelBox& box);

  [[nodiscard]] const PixelBox& box() const noexcept { return box_; }
  [[nodiscard]] bool is_white(const Pixel& pixel) const noexcept { return (row_from(pixel) & 1U) != 0; }
  /// 64 pixels of a row, `from` in the lowest bit.
  [[nodiscard]] std::uint64_t row_from(const Pixel& from) const noexcept;
  /// @param span inside the box.
  void make_white(const Span& span) noexcept;
  /// Any pixel is white in both when the lower left corner of the other's box is laid on `at`.
  [[nodiscard]] bool overlaps(const Bitmap& other, const Pixel& at) const noexcept;
  /// Calls `visit(pixel)` for each pixel that is white in both, from the lowest row up, left to right.
  template <class Visit>
  void for_each_overlap(const Bitmap& other, const Pixel& at, const Visit& visit) const;
  [[nodiscard]] std::size_t memory_bytes() const noexcept { return words_.size() * sizeof(std::uint64_t); }

 private:
  [[nodiscard]] std::uint64_t word(std::int64_t row, std::int64_t index) const noexcept {
    return index < 0 || index >= stride_ ? 0 : words_[static_cast<std::size_t>(row * stride_ + index)];
  }

  PixelBox box_;
  std::int64_t stride_ = 0;  ///< Words in a row.
  std::vector<std::uint64_t> words_;
};

/// The solid pixels of a scenery: of what blocks and stands still.
/// @throws NotExpressible as `Bitmap` and `spans_of`.
[[nodiscard]] Bitmap rasterise(const SceneryDef& scenery, double pixels_per_metre);

/// Indexed colours. Colour 0 is the background, also everywhere outside; collider `i` has the colour 1 + i mod 255,
/// and the later one where two overlap. Reading is thread-safe.
class ColourPicture {
 public:
  /// @throws NotExpressible as `check_picture_size` and `spans_of`.
  ColourPicture(const SceneryDef& scenery, double pixels_per_metre);

  [[nodiscard]] std::uint8_t colour(const Pixel& pixel) const noexcept {
    const Pixel at = pixel - box_.lower;
    return box_.contains(pixel) ? colours_[static_cast<std::size_t>(at.y * box_.width + at.x)] : std::uint8_t{0};
  }
  [[nodiscard]] std::size_t memory_bytes() const noexcept { return colours_.size(); }

 private:
  PixelBox box_;
  std::vector<std::uint8_t> colours_;
};

template <class Visit>
void Bitmap::for_each_overlap(const Bitmap& other, const Pixel& at, const Visit& visit) const {
  for (std::int64_t row = 0; row < other.box_.height; ++row) {
    for (std::int64_t index = 0; index < other.stride_; ++index) {
      const Pixel first = at + Pixel{64 * index, row};
      const std::uint64_t both = other.word(row, index) & row_from(first);
      for (std::int64_t bit = 0; bit < 64; ++bit) {
        if (((both >> bit) & 1U) != 0) visit(first + Pixel{bit, 0});
      }
    }
  }
}

}  // namespace paperproof::raster
