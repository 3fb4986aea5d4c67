#include "campaign/families.hpp"

#include "campaign/draw.hpp"
#include "near_names.hpp"
#include "scenes/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace paperproof::compare {
namespace {

/// It happens: of few families more is known.
constexpr double ever = 1e-9;

std::vector<Family> still() {
  std::vector<Family> all;
  for (std::uint64_t i = 0; i < terrain_names.size(); ++i) {
    const auto terrain = static_cast<Terrain>(i);
    const bool has_ledges = terrain == Terrain::one_way || terrain == Terrain::one_way_solids;
    all.push_back({.kind = "static",
                   .name = std::string(terrain_names[i]),
                   .draw = [terrain](std::uint64_t seed) { return draw_still(terrain, seed, false); },
                   .first_seed = 1000003 * (i + 1),
                   .covers = {{"contact", 0.1, 0.9}, {"falling", 0.1}, {"launched", 0.1}}});
    all.back().covers.push_back({"through", has_ledges ? ever : 0, has_ledges ? 1.0 : 0.0});
  }
  return all;
}

std::vector<Family> any_up() {
  std::vector<Family> all;
  for (std::uint64_t i = 0; i < terrain_names.size(); ++i) {
    const auto terrain = static_cast<Terrain>(i);
    all.push_back({.kind = "any_up",
                   .name = std::string(terrain_names[i]),
                   .draw = [terrain](std::uint64_t seed) { return draw_still(terrain, seed, true); },
                   .first_seed = 2000003 * (i + 1),
                   .covers = {{"contact", 0.06, 0.9},
                              {"falling", 0.1},
                              {"walkable", 0.01},
                              {"steep", 0.003},
                              {"wall", 0.0004},
                              {"ceiling", 0.01}}});
  }
  return all;
}

std::vector<Family> movers(bool up_turns) {
  std::vector<Family> all;
  for (std::uint64_t i = 0; i < terrain_names.size(); ++i) {
    const auto terrain = static_cast<Terrain>(i);
    all.push_back(
        {.kind = up_turns ? "movers_any_up" : "movers",
         .name = std::string(terrain_names[i]),
         .draw = [terrain, up_turns](std::uint64_t seed) { return draw_among_movers(terrain, seed, up_turns); },
         .first_seed = 2000003 * (i + 1),
         .share = up_turns ? 2.0 / 9 : 1,
         .covers = {{"contact", 0.1, 0.9}, {"riding", ever}, {"crushed", ever, 0.2}}});
  }
  return all;
}

std::vector<Family> turning() {
  std::vector<Family> all;
  for (std::uint64_t i = 0; i < turning_names.size(); ++i) {
    const auto family = static_cast<Turning>(i);
    all.push_back({.kind = "turning",
                   .name = std::string(turning_names[i]),
                   .draw = [family](std::uint64_t seed) { return draw_among_turning(family, seed); },
                   .first_seed = 3000017 * (i + 1),
                   .share = 1.0 / 3,
                   .covers = {{"turning", 0.2}, {"moving", 0.02, 0.9}, {"riding", ever}, {"crushed", 0, 0.2}}});
    if (family == Turning::presses) all.back().covers.push_back({"crushed", ever});
  }
  return all;
}

std::vector<Family> play() {
  std::vector<Family> all;
  for (std::size_t i = 0; i < play_level_names.size(); ++i)
    for (const int rate : {60, 240, 1000}) {
      const auto level = static_cast<PlayLevel>(i);
      all.push_back({.kind = "play",
                     .name = fmt::format("{}_at_{}", play_level_names[i], rate),
                     .draw = [level, rate](std::uint64_t seed) { return draw_play(level, rate, seed); },
                     .first_seed = 7919 + i,
                     .share = 4.0 / 9,
                     .covers = {{"falling", 0.01}}});
    }
  for (std::size_t i = 0; i < play_level_names.size(); ++i) {
    const auto level = static_cast<PlayLevel>(i);
    all.push_back({.kind = "stairs",
                   .name = std::string(play_level_names[i]),
                   .draw = [level](std::uint64_t seed) { return draw_stairs(level, seed); },
                   .share = 4.0 / 9});
    if (level == PlayLevel::kerbs) all.back().covers = {{"climbing", 0.0005}, {"descending", 0.001}};
  }
  return all;
}

std::vector<Family> rest() {
  return {{.kind = "presses",
           .name = "chambers",
           .draw = draw_among_presses,
           .share = 1.0 / 3,
           .covers = {{"aside", 0.02}, {"crushed", 0.005}, {"again", 0.0005}, {"freed", 0.002}}},
          {.kind = "crowd",
           .name = "rooms",
           .draw = draw_crowd,
           .share = 2,
           .covers = {{"met", 0.1, 0.95}, {"grounded", 0.05}, {"stuck", 0, 0}}},
          {.kind = "crowd_movers",
           .name = "rooms",
           .draw = draw_crowd_among_movers,
           .share = 0.25,
           .covers = {{"met", 0.1}, {"riding", 0.02}, {"crushed", 0.0005, 0.02}, {"dropped", 0, 0.0002}}}};
}

}  // namespace

const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> joined;
    for (std::vector<Family>& some :
         std::array{still(), any_up(), movers(false), movers(true), turning(), play(), rest()})
      std::move(some.begin(), some.end(), std::back_inserter(joined));
    return joined;
  }();
  return all;
}

std::vector<const Family*> families_named(std::string_view title) {
  std::vector<const Family*> named;
  std::vector<std::string> titles;
  for (const Family& family : families()) {
    titles.push_back(family.title());
    if (title.empty() || family.kind == title || family.title() == title) named.push_back(&family);
  }
  if (named.empty()) refuse(std::string(title), "expected a family of random runs" + did_you_mean(title, titles));
  return named;
}

}  // namespace paperproof::compare
