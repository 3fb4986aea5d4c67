#include "campaign/families.hpp"

#include "campaign/draw.hpp"
#include "near_names.hpp"
#include "scenes/input_error.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>

namespace paperproof::compare {
namespace {

/// It happens: of few families more is known.
constexpr double ever = 1e-9;

/// A family for each value of an enumeration. @param make from the value and its number, counted from 1; gives no name.
template <class Values, class Make>
std::vector<Family> one_of_each(const Values& values, const Make& make) {
  std::vector<Family> all;
  for (const auto value : values) {
    all.push_back(make(value, std::uint64_t{all.size() + 1}));
    all.back().name = name_of(value);
  }
  return all;
}

std::vector<Family> still() {
  return one_of_each(all_terrains, [](Terrain terrain, std::uint64_t number) -> Family {
    const bool has_ledges = terrain == Terrain::one_way || terrain == Terrain::one_way_solids;
    return {.kind = "static",
            .draw = [terrain](std::uint64_t seed) { return draw_still(terrain, seed, false); },
            .first_seed = 1000003 * number,
            .covers = {{"contact", 0.1, 0.9},
                       {"falling", 0.1},
                       {"launched", 0.1},
                       {"sensed", ever},
                       {"unnamed", 0, 0},
                       {"through", has_ledges ? ever : 0, has_ledges ? 1.0 : 0.0}}};
  });
}

std::vector<Family> any_up() {
  return one_of_each(all_terrains, [](Terrain terrain, std::uint64_t number) -> Family {
    return {.kind = "any_up",
            .draw = [terrain](std::uint64_t seed) { return draw_still(terrain, seed, true); },
            .first_seed = 2000003 * number,
            .covers = {{"contact", 0.06, 0.9},
                       {"falling", 0.1},
                       {"walkable", 0.01},
                       {"steep", 0.003},
                       {"wall", 0.0004},
                       {"ceiling", 0.01},
                       {"sensed", ever}}};
  });
}

std::vector<Family> movers(bool up_turns) {
  return one_of_each(all_terrains, [up_turns](Terrain terrain, std::uint64_t number) -> Family {
    return {.kind = up_turns ? "movers_any_up" : "movers",
            .draw = [terrain, up_turns](std::uint64_t seed) { return draw_among_movers(terrain, seed, up_turns); },
            .first_seed = 2000003 * number,
            .share = up_turns ? 2.0 / 9 : 1,
            .covers = {{"contact", 0.1, 0.9},
                       {"riding", ever},
                       {"crushed", ever, 0.2},
                       {"sensed", ever},
                       {"unnamed", 0, up_turns ? 1.0 : 0.0}}};
  });
}

std::vector<Family> turning() {
  return one_of_each(all_turning, [](Turning family, std::uint64_t number) -> Family {
    const double least_crushed = family == Turning::presses ? ever : 0;
    return {.kind = "turning",
            .draw = [family](std::uint64_t seed) { return draw_among_turning(family, seed); },
            .first_seed = 3000017 * number,
            .share = family == Turning::balls ? 1 : 1.0 / 3,  // a ball seldom carries anyone
            .covers = {{"turning", 0.2},
                       {"moving", 0.02, 0.9},
                       {"riding", ever},
                       {"sensed", ever},
                       {"crushed", least_crushed, 0.2}}};
  });
}

std::vector<Family> play() {
  std::vector<Family> all;
  for (const PlayLevel level : all_play_levels)
    for (const int rate : {60, 240, 1000})
      all.push_back({.kind = "play",
                     .name = fmt::format("{}_at_{}", name_of(level), rate),
                     .draw = [level, rate](std::uint64_t seed) { return draw_play(level, rate, seed); },
                     .first_seed = 7919 + static_cast<std::uint64_t>(level),
                     .share = 4.0 / 9,
                     .covers = {{"falling", 0.01}}});
  return all;
}

std::vector<Family> play_on_stairs() {
  return one_of_each(all_play_levels, [](PlayLevel level, std::uint64_t /*number*/) -> Family {
    std::vector<Coverage> covers;
    if (level == PlayLevel::kerbs) covers = {{"climbing", 0.0005}, {"descending", 0.001}};
    return {.kind = "stairs",
            .draw = [level](std::uint64_t seed) { return draw_stairs(level, seed); },
            .share = 4.0 / 9,
            .covers = covers};
  });
}

std::vector<Family> slanted() {
  return one_of_each(all_play_levels, [](PlayLevel level, std::uint64_t number) -> Family {
    return {.kind = "slanted",
            .draw = [level](std::uint64_t seed) { return draw_slanted(level, seed); },
            .first_seed = 13000027 * number,
            .share = 4.0 / 9,
            .covers = {{"grounded", 0.2}, {"falling", 0.01}}};
  });
}

std::vector<Family> on_lines() {
  return one_of_each(all_lines, [](Line line, std::uint64_t number) -> Family {
    const double through = line == Line::arch || line == Line::ramp ? ever : 0;  // from the others few get through
    return {.kind = "lines",
            .draw = [line](std::uint64_t seed) { return draw_on_line(line, seed); },
            .first_seed = 4000037 * number,
            .share = 1.0 / 3,
            .covers = {{"contact", 0.1, 0.95}, {"walkable", 0.05}, {"through", through}}};
  });
}

std::vector<Family> inside() {
  constexpr std::array some{Terrain::tiles, Terrain::stairs, Terrain::concave, Terrain::lattice, Terrain::circles};
  return one_of_each(some, [](Terrain terrain, std::uint64_t number) -> Family {
    return {.kind = "inside",
            .draw = [terrain](std::uint64_t seed) { return draw_inside(terrain, seed); },
            .first_seed = 5000011 * number,
            .share = 1.0 / 6,
            .covers = {{"inside", 0.1}, {"freed", 0.1}, {"stuck", 0.001}}};
  });
}

std::vector<Family> tight() {
  const auto fits = [](bool rest) { return [rest](std::uint64_t seed) { return draw_exact_fit(rest, seed); }; };
  return {{"tight", "corners", draw_near_a_corner, 6000011, 2, {{"contact", 0.5, 0.9}}},
          {"tight", "sensors", draw_through_sensors, 7000003, 1, {{"sensed", 0.15}}},
          {"tight", "fits", fits(true), 8000009, 1, {{"ceiling", 0.05}}},
          {"tight", "openings", draw_opening, 11000027, 1, {{"contact", 0.2, 0.95}, {"falling", 0.2}}},
          {"presses", "fits", fits(false), 9000011, 1, {{"ceiling", 0.05}, {"crushed", 0.02}, {"riding", 0.05}}},
          {"presses", "ledges", draw_touched_by_ledge, 10000019, 1, {{"contact", 0.2, 0.9}}}};
}

std::vector<Family> courses() {
  return {{"courses",
           "walks",
           draw_course,
           14000029,
           2,
           {{"climbing", 0.002}, {"riding", 0.1}, {"descending", 0.002}, {"grounded", 0.3}, {"crushed", 0, 0.01}}}};
}

std::vector<Family> rest() {
  const auto presses = [](const char* name, bool rims) -> Family {
    return {.kind = "presses",
            .name = name,
            .draw = [rims](std::uint64_t seed) { return draw_among_presses(rims, seed); },
            .share = 1.0 / 3,
            .covers = {{"aside", 0.02}, {"crushed", 0.005}, {"again", 0.0005}, {"freed", 0.002}, {"unnamed", 0, 1e-4}}};
  };
  return {presses("chambers", false),
          presses("buckets", true),
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
         std::array{still(), any_up(), movers(false), movers(true), turning(), play(), play_on_stairs(), courses(),
                    slanted(), on_lines(), inside(), tight(), rest()})
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
