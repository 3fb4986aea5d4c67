#include "scenes/picture.hpp"

#include "scenes/input_error.hpp"

#include <fmt/format.h>
#include <png.h>

#include <map>

namespace paperproof::compare {
namespace {

/// 256 MiB once it is unpacked.
constexpr std::uint64_t max_pixels = std::uint64_t{1} << 26;
/// A photograph makes millions of them, and a run of hours.
constexpr std::size_t max_rectangles = 200'000;
constexpr std::size_t bytes_per_pixel = 4;
constexpr std::uint8_t half_transparent = 128;

/// The simple interface of libpng; what it has allocated goes when this does.
class Png {
 public:
  Png(const std::string& bytes, const std::string& given) : given_(given) {
    image_.version = PNG_IMAGE_VERSION;
    check(png_image_begin_read_from_memory(&image_, bytes.data(), bytes.size()));
    if (std::uint64_t{image_.width} * image_.height > max_pixels)
      fail(
          fmt::format("expected a picture of at most {} pixels, not {} x {}", max_pixels, image_.width, image_.height));
    image_.format = PNG_FORMAT_RGBA;
    pixels_.resize(PNG_IMAGE_SIZE(image_));
    check(png_image_finish_read(&image_, nullptr, pixels_.data(), 0, nullptr));
  }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
  ~Png() { png_image_free(&image_); }

  [[nodiscard]] int width() const noexcept { return static_cast<int>(image_.width); }
  [[nodiscard]] int height() const noexcept { return static_cast<int>(image_.height); }
  [[nodiscard]] bool is_solid(int column, int row, const PictureRule& rule) const noexcept {
    const auto pixel = static_cast<std::size_t>(row) * image_.width + static_cast<std::size_t>(column);
    const std::uint8_t* at = pixels_.data() + pixel * bytes_per_pixel;
    const bool same = Colour{at[0], at[1], at[2]} == rule.colour;
    return at[3] >= half_transparent && same != rule.is_background;
  }

 private:
  void check(int fine) {
    if (fine == 0) fail(fmt::format("expected a PNG picture ({})", static_cast<const char*>(image_.message)));
  }
  /// A constructor that throws has no destructor to rely on.
  [[noreturn]] void fail(const std::string& expected) {
    png_image_free(&image_);
    refuse(given_, expected);
  }

  png_image image_{};
  std::vector<std::uint8_t> pixels_;
  const std::string& given_;
};

/// Pixels: columns from `left` up to, but not including, `right`; rows alike, counted from the top.
struct Rectangle {
  int left;
  int top;
  int right;
  int bottom;
};

class Rectangles {
 public:
  void add_row(const Png& picture, const PictureRule& rule, int row) {
    std::map<std::pair<int, int>, std::size_t> now;
    for (int left = 0; left < picture.width();) {
      if (!picture.is_solid(left, row, rule)) {
        ++left;
        continue;
      }
      int right = left + 1;
      while (right < picture.width() && picture.is_solid(right, row, rule)) ++right;
      now[{left, right}] = place({left, row, right, row + 1});
      left = right;
    }
    above_ = std::move(now);
  }
  [[nodiscard]] const std::vector<Rectangle>& all() const noexcept { return all_; }

 private:
  /// Where the row above has the same run, its rectangle grows.
  std::size_t place(const Rectangle& run) {
    const auto same = above_.find({run.left, run.right});
    if (same == above_.end()) {
      all_.push_back(run);
      return all_.size() - 1;
    }
    all_[same->second].bottom = run.bottom;
    return same->second;
  }

  std::vector<Rectangle> all_;
  std::map<std::pair<int, int>, std::size_t> above_;  ///< The runs of the row above, by their ends.
};

int digit(char c) noexcept {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

ColliderDef collider_of(const Rectangle& r, double pixels_per_metre) {
  const auto corner = [&](int column, int row) {
    return Vec2d(static_cast<double>(column) / pixels_per_metre, static_cast<double>(-row) / pixels_per_metre);
  };
  return {
      .points = {corner(r.left, r.bottom), corner(r.right, r.bottom), corner(r.right, r.top), corner(r.left, r.top)}};
}

}  // namespace

std::optional<Colour> colour_from(std::string_view text) noexcept {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  Colour colour{};
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const int high = digit(text[1 + 2 * i]);
    const int low = digit(text[2 + 2 * i]);
    if (high < 0 || low < 0) return std::nullopt;
    colour[i] = static_cast<std::uint8_t>(16 * high + low);
  }
  return colour;
}

std::string text_of(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

PictureScenery read_picture(const std::string& path, const std::string& given, const PictureRule& rule,
                            double pixels_per_metre) {
  const std::string bytes = read_file(path, given);
  const Png picture(bytes, given);
  Rectangles rectangles;
  for (int row = 0; row < picture.height(); ++row) {
    rectangles.add_row(picture, rule, row);
    if (rectangles.all().size() > max_rectangles)
      refuse(given, fmt::format("expected a drawing; its solid pixels make more than {} rectangles", max_rectangles));
  }
  if (rectangles.all().empty())
    refuse(given, fmt::format("expected a solid pixel; {} {}", rule.is_background ? "all of them are" : "none is",
                              text_of(rule.colour)));
  PictureScenery result;
  for (const Rectangle& each : rectangles.all()) {
    result.scenery.colliders.push_back(collider_of(each, pixels_per_metre));
    result.ids.push_back(fmt::format("{},{}", each.left, each.top));
  }
  result.box = {Vec2d(0, static_cast<double>(-picture.height()) / pixels_per_metre),
                Vec2d(static_cast<double>(picture.width()) / pixels_per_metre, 0)};
  return result;
}

}  // namespace paperproof::compare
