/// Levels of pixel tiles, as somebody writes them.
#pragma once

#include <string>

namespace paperproof::compare {

/// Tiles of 8 pixels: level ground 8 px high from column -48 on, a slope of 45 degrees from column 16 to 31, level
/// again to column 47. `R` is where the ground rises by one to the right, `l` where a foot that comes from there goes
/// down.
inline const std::string hill_of_tiles = R"({
  "paperproof_pixel_tiles": 1,
  "description": "a hill",
  "pixels_per_tile": 8,
  "tiles": {
    "#": ["########", "########", "########", "########", "########", "########", "########", "########"],
    "/": [".....l.R",
          "....l.R#",
          "...l.R##",
          "..l.R###",
          ".l.R####",
          "l.R#####",
          ".R######",
          "R#######"],
    "a": ["........", "........", "........", "........", "........", "........", ".......l", "........"],
    "b": ["........", "........", "........", "........", "........", "........", ".......l", "......l."],
    "c": ["........", "........", "........", "........", "........", "........", "........", "......l."]
  },
  "at": [-6, 4],
  "map": [".........c..",
          "........b/##",
          ".......a/###",
          "############"]
})";

/// The highest solid pixel of a column of that hill, from -48 to 47.
constexpr int hill_top(int column) { return column < 16 ? 7 : column < 32 ? column - 8 : 23; }

}  // namespace paperproof::compare
