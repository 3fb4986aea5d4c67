/// The knobs that several techniques share.
#pragma once

#include <paperproof/techniques.hpp>

#include <stdexcept>
#include <utility>

namespace paperproof::knob {

inline constexpr Knob unit{"unit", "step of every search [m]; without it a pixel of the scene",
                           [](const std::string& value, TechniqueDef& def) { def.article.unit = real_in(value); }};

inline constexpr Knob iterations{
    "iterations", "rounds per step, at least 1",
    [](const std::string& value, TechniqueDef& def) { def.article.iterations = whole_in(value); }};

inline constexpr Knob points{"points", "8, or 4: the corners of the bounding box",
                             [](const std::string& value, TechniqueDef& def) { def.article.points = whole_in(value); }};

inline constexpr Knob pairs{"pairs", "direction, or all: points are tested whichever way it goes",
                            [](const std::string& value, TechniqueDef& def) {
                              using enum ArticleKnobs::Pairs;
                              def.article.pairs = is_second(value, "direction", "all") ? all : direction;
                            }};

inline constexpr Knob objects{
    "objects", "each, or all: penetration resolution looks at one object after the other, or at all at once",
    [](const std::string& value, TechniqueDef& def) {
      using enum ArticleKnobs::Objects;
      def.article.objects = is_second(value, "each", "all") ? all : each;
    }};

inline constexpr Knob response{"response", "component, or shorten: a hit shortens the whole vector",
                               [](const std::string& value, TechniqueDef& def) {
                                 using enum ArticleKnobs::Response;
                                 def.article.response = is_second(value, "component", "shorten") ? shorten : component;
                               }};

inline constexpr Knob raster_pixels_per_metre{
    "raster_pixels_per_metre", "resolution of the level, at most 1000; without it the scene's",
    [](const std::string& value, TechniqueDef& def) { def.article.raster_pixels_per_metre = real_in(value); }};

inline constexpr Knob broad_phase{
    "broad_phase", "tree, buckets, or all_pairs: every piece is looked at; how the pieces near it are found",
    [](const std::string& value, TechniqueDef& def) {
      using enum BroadPhaseKind;
      for (const auto& [name, kind] :
           {std::pair("tree", tree), std::pair("buckets", buckets), std::pair("all_pairs", all_pairs)})
        if (value == name) return void(def.broad_phase = kind);
      throw std::invalid_argument("expected tree, buckets or all_pairs");
    }};

/// Of the techniques that search.
[[nodiscard]] inline std::vector<Knob> of_search() {
  return {unit, iterations, points, pairs, objects, response, broad_phase};
}

[[nodiscard]] inline double unit_of_search(const ArticleKnobs& knobs) { return knobs.unit; }
[[nodiscard]] inline double pixel(const ArticleKnobs& knobs) { return 1 / knobs.raster_pixels_per_metre; }

}  // namespace paperproof::knob
