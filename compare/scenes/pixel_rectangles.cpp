#include "scenes/pixel_rectangles.hpp"

#include "scenes/input_error.hpp"

#include <fmt/format.h>

#include <map>

namespace paperproof::compare {
namespace {

/// A photograph makes millions of them, and a run of hours.
constexpr std::size_t max_rectangles = 200'000;

/// Pixels: columns from `left` up to, but not including, `right`; rows alike, counted from the top.
struct Rectangle {
  int left;
  int top;
  int right;
  int bottom;
};

class Rectangles {
 public:
  void add_row(const SolidPixels& pixels, int row) {
    std::map<std::pair<int, int>, std::size_t> now;
    for (int left = 0; left < pixels.width;) {
      if (!pixels.is_solid(left, row)) {
        ++left;
        continue;
      }
      int right = left + 1;
      while (right < pixels.width && pixels.is_solid(right, row)) ++right;
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

}  // namespace

PixelScenery scenery_of_pixels(const SolidPixels& pixels, double pixels_per_metre, const std::string& given) {
  Rectangles rectangles;
  for (int row = 0; row < pixels.height; ++row) {
    rectangles.add_row(pixels, row);
    if (rectangles.all().size() > max_rectangles)
      refuse(given, fmt::format("expected a drawing; its solid pixels make more than {} rectangles", max_rectangles));
  }
  const auto corner = [&](int column, int row) {
    return Vec2d(static_cast<double>(pixels.left + column) / pixels_per_metre,
                 static_cast<double>(pixels.top - row) / pixels_per_metre);
  };
  PixelScenery result;
  for (const Rectangle& r : rectangles.all()) {
    result.scenery.colliders.push_back({.points = {corner(r.left, r.bottom), corner(r.right, r.bottom),
                                                   corner(r.right, r.top), corner(r.left, r.top)}});
    result.ids.push_back(fmt::format("{},{}", r.left, r.top));
  }
  result.box = {corner(0, pixels.height), corner(pixels.width, 0)};
  return result;
}

}  // namespace paperproof::compare
