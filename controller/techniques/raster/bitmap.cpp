#include "techniques/raster/bitmap.hpp"

#include <paperproof/techniques.hpp>

namespace paperproof::raster {

void check_picture_size(const PixelBox& box, std::size_t bits_per_pixel) {
  // In floating point, as the number of pixels may not fit into 64 bits. Rows are filled up to words.
  const double words_in_row = std::ceil(static_cast<double>(box.width) * static_cast<double>(bits_per_pixel) / 64);
  if (8 * words_in_row * static_cast<double>(box.height) <= static_cast<double>(max_picture_bytes)) return;
  throw NotExpressible("the level is a picture of " + std::to_string(box.width) + " x " + std::to_string(box.height) +
                       " pixels, and with " + std::to_string(bits_per_pixel) +
                       "-bit pixels it would take more than 256 MiB");
}

Bitmap::Bitmap(const PixelBox& box) : box_(box), stride_((box.width + 63) / 64) {
  check_picture_size(box, 1);
  words_.resize(static_cast<std::size_t>(stride_ * box.height));
}

std::uint64_t Bitmap::row_from(const Pixel& from) const noexcept {
  const Pixel at = from - box_.lower;
  if (at.y < 0 || at.y >= box_.height) return 0;
  const std::int64_t index = at.x >= 0 ? at.x / 64 : (at.x - 63) / 64;
  const std::int64_t shift = at.x - 64 * index;
  const std::uint64_t low = word(at.y, index) >> shift;
  return shift == 0 ? low : low | word(at.y, index + 1) << (64 - shift);
}

void Bitmap::make_white(const Span& span) noexcept {
  const std::int64_t row = (span.row - box_.lower.y) * stride_;
  for (std::int64_t x = span.first - box_.lower.x; x < span.end - box_.lower.x;) {
    const std::int64_t bit = x % 64;
    const std::int64_t count = std::min(64 - bit, span.end - box_.lower.x - x);
    const std::uint64_t ones = ~std::uint64_t{0} >> (64 - count);
    words_[static_cast<std::size_t>(row + x / 64)] |= ones << bit;
    x += count;
  }
}

bool Bitmap::overlaps(const Bitmap& other, const Pixel& at) const noexcept {
  for (std::int64_t row = 0; row < other.box_.height; ++row) {
    for (std::int64_t index = 0; index < other.stride_; ++index) {
      if ((other.word(row, index) & row_from(at + Pixel{64 * index, row})) != 0) return true;
    }
  }
  return false;
}

Bitmap rasterise(const SceneryDef& scenery, double pixels_per_metre) {
  Bitmap level(pixels_around(scenery, pixels_per_metre));
  for_each_span(scenery, pixels_per_metre, [&level](ColliderIndex, const Span& span) { level.make_white(span); });
  return level;
}

ColourPicture::ColourPicture(const SceneryDef& scenery, double pixels_per_metre)
    : box_(pixels_around(scenery, pixels_per_metre)) {
  check_picture_size(box_, 8);
  colours_.resize(static_cast<std::size_t>(box_.width * box_.height));
  for_each_span(scenery, pixels_per_metre, [this](ColliderIndex collider, const Span& span) {
    const auto first = colours_.begin() + (span.row - box_.lower.y) * box_.width - box_.lower.x;
    std::fill(first + span.first, first + span.end, static_cast<std::uint8_t>(1 + collider % 255));
  });
}

}  // namespace paperproof::raster
