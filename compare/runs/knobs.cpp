#include "runs/knobs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace paperproof::compare {
namespace {

struct Knob {
  std::string_view name;
  std::string_view meaning;
  std::vector<TechniqueKind> kinds;  ///< Who has it.
  void (*turn)(const std::string& value, TechniqueDef& def);
};

/// The whole text is a number.
template <class Number>
Number number_in(const std::string& text, std::string_view expected) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || last != end) throw std::invalid_argument(fmt::format("expected {}", expected));
  return number;
}

double real_in(const std::string& text) { return number_in<double>(text, "a number"); }
int whole_in(const std::string& text) { return number_in<int>(text, "a whole number"); }

/// One of two words: false for the first.
bool second_of(const std::string& text, std::string_view first, std::string_view second) {
  if (text != first && text != second) throw std::invalid_argument(fmt::format("expected {} or {}", first, second));
  return text == second;
}

const std::vector<Knob>& all_knobs() {
  using enum TechniqueKind;
  static const std::vector<TechniqueKind> searching{penetration_resolution, speculative_march, speculative};
  static const std::vector<Knob> all{
      {"unit",
       "step of every search [m]; without it a pixel of the scene",
       {wind_back, penetration_resolution, speculative_march, speculative},
       [](const std::string& value, TechniqueDef& def) { def.article.unit = real_in(value); }},
      {"iterations",
       "rounds per step, at least 1",
       {bounding_box, discrete, penetration_resolution, speculative_march, speculative, octagon_sweep},
       [](const std::string& value, TechniqueDef& def) {
         (def.kind == octagon_sweep ? def.sweep_iterations : def.article.iterations) = whole_in(value);
       }},
      {"points",
       "8, or 4: the corners of the bounding box",
       {wind_back, penetration_resolution, speculative_march, speculative},
       [](const std::string& value, TechniqueDef& def) { def.article.points = whole_in(value); }},
      {"pairs", "direction, or all: points are tested whichever way it goes", searching,
       [](const std::string& value, TechniqueDef& def) {
         def.article.pairs =
             second_of(value, "direction", "all") ? ArticleKnobs::Pairs::all : ArticleKnobs::Pairs::direction;
       }},
      {"response",
       "component, or shorten: a hit shortens the whole vector",
       {mask, penetration_resolution, speculative_march, speculative},
       [](const std::string& value, TechniqueDef& def) {
         def.article.response = second_of(value, "component", "shorten") ? ArticleKnobs::Response::shorten
                                                                         : ArticleKnobs::Response::component;
       }},
      {"square",
       "side of a square [m]",
       {grid},
       [](const std::string& value, TechniqueDef& def) { def.article.square = real_in(value); }},
      {"raster_pixels_per_metre",
       "resolution of the level, at most 1000; without it the scene's",
       {pixel_colour, pixel_tile, mask},
       [](const std::string& value, TechniqueDef& def) { def.article.raster_pixels_per_metre = real_in(value); }},
      {"pixels_per_tile",
       "along a side of a tile: more take more memory, nothing else changes",
       {pixel_tile},
       [](const std::string& value, TechniqueDef& def) { def.article.pixels_per_tile = whole_in(value); }},
  };
  return all;
}

const Knob* find_knob(std::string_view name) {
  const auto found =
      std::find_if(all_knobs().begin(), all_knobs().end(), [&](const Knob& knob) { return knob.name == name; });
  return found == all_knobs().end() ? nullptr : &*found;
}

bool is_of(const Knob& knob, TechniqueKind kind) {
  return std::find(knob.kinds.begin(), knob.kinds.end(), kind) != knob.kinds.end();
}

/// A level of one square metre: whatever a knob may be is tried on it.
Scenery<double> a_square() { return Scenery<double>({{{.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}}); }

}  // namespace

KnobSetting parse_knob(std::string_view text) {
  const std::size_t equals = text.find('=');
  const Knob* knob = find_knob(text.substr(0, equals));
  if (equals == std::string_view::npos || knob == nullptr) {
    std::vector<std::string_view> names;
    for (const Knob& each : all_knobs()) names.push_back(each.name);
    throw std::invalid_argument(fmt::format("expected NAME=VALUE with a NAME of {}", fmt::join(names, ", ")));
  }
  return {std::string(knob->name), std::string(text.substr(equals + 1))};
}

void check_knob(const KnobSetting& setting, TechniqueKind kind) {
  TechniqueDef def;
  def.kind = kind;
  turn_knobs(std::span(&setting, 1), def);
  const Scenery<double> scenery = a_square();
  try {
    static_cast<void>(make_technique(def, scenery, CharacterDef{}));
  } catch (const NotExpressible&) {
    // Another level may do.
  }
}

std::vector<std::string> describe_knobs() {
  std::vector<std::string> lines;
  for (const Knob& knob : all_knobs()) {
    std::vector<std::string_view> names;
    for (const TechniqueKind kind : knob.kinds) names.push_back(paperproof::name_of(kind));
    lines.push_back(fmt::format("{:<24} {} ({})", knob.name, knob.meaning, fmt::join(names, ", ")));
  }
  return lines;
}

bool has_knob(TechniqueKind kind, std::string_view name) {
  const Knob* knob = find_knob(name);
  return knob != nullptr && is_of(*knob, kind);
}

void turn_knobs(std::span<const KnobSetting> knobs, TechniqueDef& def) {
  for (const KnobSetting& setting : knobs)
    if (const Knob* knob = find_knob(setting.name); knob != nullptr && is_of(*knob, def.kind))
      knob->turn(setting.value, def);
}

std::string turned_knobs(std::span<const KnobSetting> knobs, TechniqueKind kind) {
  std::string text;
  for (const KnobSetting& setting : knobs) {
    if (!has_knob(kind, setting.name)) continue;
    if (!text.empty()) text += ' ';
    text += setting.name + '=' + setting.value;
  }
  return text;
}

}  // namespace paperproof::compare
