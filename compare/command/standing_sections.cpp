#include "command/standing_sections.hpp"

#include "oracle/exemptions.hpp"
#include "runs/environment.hpp"

#include <paperproof/box2d/reference_world.hpp>
#include <paperproof/techniques.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

std::string known(const Environment& environment, std::string_view name) {
  const auto found =
      std::find_if(environment.begin(), environment.end(), [&](const auto& each) { return each.first == name; });
  return found == environment.end() ? "unknown" : found->second;
}

/// What differs between the sides by their nature, and touches the numbers of a comparison: a heading, then a line for
/// each difference: what, octagon_sweep, the article's techniques, Box2D. Sizes and numbers of iterations are those of
/// this build; one that a knob turns in a run stands in its row.
std::vector<std::vector<std::string>> fairness_table() {
  const Environment all = environment();
  const TechniqueDef technique;
  const box2d::ReferenceWorldDef world;
  const std::string build = known(all, "build") + ", " + known(all, "flags");
  return {
      {"what", "octagon_sweep", "the article's techniques", "Box2D"},
      {"skin: gap left at what is touched", "at most 1e-6 m", "up to a unit or a pixel, where they search by these",
       fmt::format("rests at {:g} m, touches from {:g} m", box2d::rest_gap, box2d::touch_gap)},
      {"farthest way in a step", "1e6 m", "none is set",
       fmt::format("{:g} m; a run that meets it is flagged, not scored", box2d::max_travel_per_step)},
      {"iterations in a step", fmt::format("{} impacts", technique.sweep_iterations),
       fmt::format("{} where they iterate", technique.article.iterations),
       fmt::format("{} for velocities, {} for positions", world.velocity_iterations, world.position_iterations)},
      {"when a contact is reported", "in the step of the impact", "in the step of the impact",
       "in that step or in the next one: it may match one step late"},
      {"numbers", "double; float beside it where asked for", "the same", "float"},
      {"build", build, build, known(all, "box2d_build")},
      {"assertions", "off in a release build", "off in a release build", known(all, "box2d_asserts")},
      {"recorder within the timed step", "none", "none",
       "the listener of contacts; `bare` is the cost of the world alone"},
  };
}

}  // namespace

ReportSection exemptions_section() {
  return {"What is not held against a contender, counted as `exempted`, and up to what size", exemptions_in_words()};
}

std::vector<ReportSection> standing_sections() {
  return {exemptions_section(), {"Is it fair? What differs between the sides by their nature", {}, fairness_table()}};
}

}  // namespace paperproof::compare
