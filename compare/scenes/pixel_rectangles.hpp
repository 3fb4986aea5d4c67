/// Scenery of pixels: what pictures and tiles of pixels become.
#pragma once

#include "scenes/scene.hpp"

#include <functional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// The solid pixels as rectangles: runs of them in a row, and runs of the same extent below each other as one.
struct PixelScenery {
  SceneryDef scenery;
  std::vector<std::string> ids;  ///< `column,row` of the upper left pixel of each, counted from the picture's own.
  Box2 box;                      ///< Of the whole picture [m].
};

/// A picture of solid pixels and others.
struct SolidPixels {
  int width = 0;                                      ///< [px]
  int height = 0;                                     ///< [px]
  std::function<bool(int column, int row)> is_solid;  ///< Rows are counted from the top.
  int left = 0;                                       ///< Of the picture's left edge [px].
  int top = 0;                                        ///< Of its upper edge, y up [px].
};

/// Vertices are (pixels) / `pixels_per_metre` with one division, so that neighbours share bits.
/// @param given the file as the user named it.
/// @throws InputError for more than 200,000 rectangles. None at all is no error here.
[[nodiscard]] PixelScenery scenery_of_pixels(const SolidPixels& pixels, double pixels_per_metre,
                                             const std::string& given);

}  // namespace paperproof::compare
