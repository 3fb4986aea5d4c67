#include "campaign/families.hpp"

#include "campaign/draw.hpp"
#include "contains.hpp"
#include "embedded.hpp"
#include "near_names.hpp"
#include "scenes/input_error.hpp"
#include "scenes/json_text.hpp"

#include <fmt/format.h>

#include <array>
#include <map>

namespace paperproof::compare {
namespace {

/// A kind of runs, and what draws one: a family for each name. families.json says what each covers.
struct Kind {
  std::vector<std::string> families;
  std::function<RandomRun(std::size_t family, std::uint64_t seed)> draw;
};

template <class Names>
std::vector<std::string> listed(const Names& names) {
  return {names.begin(), names.end()};
}

constexpr std::array rates{60, 240, 1000};  ///< Steps per second.

std::vector<std::string> names_of_play() {
  std::vector<std::string> names;
  for (const std::string_view level : play_level_names)
    for (const int rate : rates) names.push_back(fmt::format("{}_at_{}", level, rate));
  return names;
}

template <class Value>
auto of_each(RandomRun (*draw)(Value, std::uint64_t)) {
  return [draw](std::size_t family, std::uint64_t seed) { return draw(static_cast<Value>(family), seed); };
}

std::map<std::string, Kind> all_kinds() {
  using Seed = std::uint64_t;
  const std::vector<std::string> terrains = listed(terrain_names);
  const std::vector<std::string> levels = listed(play_level_names);
  const auto draw_play_at = [](std::size_t i, Seed seed) {
    return draw_play(static_cast<PlayLevel>(i / rates.size()), rates[i % rates.size()], seed);
  };
  const auto draw_tight = [](std::size_t i, Seed seed) {
    if (i == 0) return draw_near_a_corner(seed);
    if (i == 1) return draw_through_sensors(seed);
    return i == 2 ? draw_exact_fit(true, seed) : draw_opening(seed);
  };
  const auto draw_presses = [](std::size_t i, Seed seed) {
    if (i >= 2) return draw_among_presses(i == 3, seed);
    return i == 0 ? draw_exact_fit(false, seed) : draw_touched_by_ledge(seed);
  };
  return {
      {"static", {terrains, of_each<Terrain>([](Terrain t, Seed seed) { return draw_still(t, seed, false); })}},
      {"any_up", {terrains, of_each<Terrain>([](Terrain t, Seed seed) { return draw_still(t, seed, true); })}},
      {"movers", {terrains, of_each<Terrain>([](Terrain t, Seed seed) { return draw_among_movers(t, seed, false); })}},
      {"movers_any_up",
       {terrains, of_each<Terrain>([](Terrain t, Seed seed) { return draw_among_movers(t, seed, true); })}},
      {"turning", {listed(turning_names), of_each(draw_among_turning)}},
      {"play", {names_of_play(), draw_play_at}},
      {"stairs", {levels, of_each(draw_stairs)}},
      {"courses", {{"walks"}, [](std::size_t, Seed seed) { return draw_course(seed); }}},
      {"slanted", {levels, of_each(draw_slanted)}},
      {"lines", {listed(line_names), of_each(draw_on_line)}},
      {"inside", {terrains, of_each(draw_inside)}},
      {"tight", {{"corners", "sensors", "fits", "openings"}, draw_tight}},
      {"presses", {{"fits", "ledges", "chambers", "buckets"}, draw_presses}},
      {"crowd", {{"rooms"}, [](std::size_t, Seed seed) { return draw_crowd(seed); }}},
      {"crowd_movers", {{"rooms"}, [](std::size_t, Seed seed) { return draw_crowd_among_movers(seed); }}}};
}

/// All of one kind. @param text what families.json has of it.
void add_families(const Json& text, const Kind& kind, std::vector<Family>& families) {
  const Json some = text.value("only", Json(kind.families));
  for (std::size_t i = 0, number = 0; i < kind.families.size(); ++i) {
    if (!contains(some, kind.families[i])) continue;
    Json own = text;
    own.merge_patch(text.value("but", Json::object()).value(kind.families[i], Json::object()));
    Family& family = families.emplace_back();
    family.kind = own["kind"];
    family.name = kind.families[i];
    family.draw = [draw = kind.draw, i](std::uint64_t seed) { return draw(i, seed); };
    if (own.contains("first_seeds")) family.first_seed = own["first_seeds"].at(number);
    ++number;
    if (own.contains("first_seed")) family.first_seed = own["first_seed"].get<std::uint64_t>() * number;
    family.share = own.value("share", 1.0);
    const Json covers = own.value("covers", Json::object());
    for (const auto& [happening, shares] : covers.items())
      family.covers.push_back({happening, shares.at(0), shares.size() > 1 ? shares[1].get<double>() : 1});
  }
}

}  // namespace

const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> listed;
    const std::map<std::string, Kind> kinds = all_kinds();
    const Json texts = Json::parse(families_file.front().text);
    for (const Json& text : texts) add_families(text, kinds.at(text.at("kind")), listed);
    return listed;
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
