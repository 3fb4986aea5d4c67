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

}  // namespace

PixelScenery scenery_of_pixels(const SolidPixels& pixels, double pixels_per_metre, const std::string& given) {
  std::vector<Rectangle> rectangles;
  std::map<std::pair<int, int>, std::size_t> above;  // the runs of the row above, by their ends
  for (int row = 0; row < pixels.height; ++row) {
    std::map<std::pair<int, int>, std::size_t> now;
    for (int left = 0; left < pixels.width; ++left) {
      if (!pixels.is_solid(left, row)) continue;
      int right = left + 1;
      while (right < pixels.width && pixels.is_solid(right, row)) ++right;
      // Where the row above has the same run, its rectangle grows.
      const auto same = above.find({left, right});
      const std::size_t grown = same == above.end() ? rectangles.size() : same->second;
      if (same == above.end()) rectangles.push_back({left, row, right, row});
      rectangles[grown].bottom = row + 1;
      now[{left, right}] = grown;
      left = right;
    }
    above = std::move(now);
    if (rectangles.size() > max_rectangles)
      refuse(given, fmt::format("expected a drawing; its solid pixels make more than {} rectangles", max_rectangles));
  }
  const auto corner = [&](int column, int row) {
    return Vec2d(static_cast<double>(pixels.left + column) / pixels_per_metre,
                 static_cast<double>(pixels.top - row) / pixels_per_metre);
  };
  PixelScenery result;
  for (const Rectangle& r : rectangles) {
    result.scenery.colliders.push_back({.points = {corner(r.left, r.bottom), corner(r.right, r.bottom),
                                                   corner(r.right, r.top), corner(r.left, r.top)}});
    result.ids.push_back(fmt::format("{},{}", r.left, r.top));
  }
  result.box = {corner(0, pixels.height), corner(pixels.width, 0)};
  return result;
}

}  // namespace paperproof::compare
