#include "command/commands.hpp"

#include "command/compare_command.hpp"
#include "embedded.hpp"
#include "records/output_file.hpp"
#include "runs/contender.hpp"
#include "runs/row_views.hpp"
#include "runs/run.hpp"
#include "scenes/load.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace paperproof::compare {
namespace {

constexpr double pixels_per_line = 5;

/// Steps that are drawn: behind them a bullet that got through is below the picture.
constexpr std::size_t drawn_steps = 2;

std::string picture(const ReportRun& run, double pixels_per_metre) {
  std::vector<double> ends;
  for (std::size_t k = 0; k < std::min(drawn_steps, run.steps.size()); ++k) {
    const auto& path = run.steps[k].path;
    if (k == 0) ends.push_back(path.front().position.y() * pixels_per_metre);
    ends.push_back(path.back().position.y() * pixels_per_metre);
  }
  std::string text;
  const double lowest = std::min(-pixels_per_line, *std::min_element(ends.begin(), ends.end()));
  for (double top = 35; top > lowest; top -= pixels_per_line) {
    const double bottom = top - pixels_per_line;
    const auto is_here = [&](double y) { return y < top && y >= bottom; };
    const bool platform = bottom >= -5 && top <= 0;
    std::string marks;
    for (std::size_t k = 0; k < ends.size(); ++k)
      if (is_here(ends[k])) marks += fmt::format("  {}", k == 0 ? "start" : fmt::format("end of step {}", k - 1));
    const bool on_the_way = top <= ends.front() && bottom >= ends.back();
    const char bullet = !marks.empty() ? 'o' : on_the_way ? '|' : ' ';
    const std::string side(12, platform ? '=' : ' ');
    text += fmt::format("  {:>4.0f} px {}{}{}{}\n", top, side, bullet, platform || !marks.empty() ? side : "", marks);
  }
  return text;
}

}  // namespace

int demo_command(const Given& given) {
  const std::string& technique = given.what;
  if (!technique.empty()) check_contenders({technique}, "demo");
  const Scene scene = load_scene("article_bullet", {});
  print_out(
      "The article's bullet: one pixel, falling 50 pixels in its first frame, onto a platform 5 pixels thick that\n"
      "begins 30 pixels below it. It should stop at 0.6 of the frame.\n\n");
  // How each technique looks for collisions, and what that means for the bullet.
  const auto lessons = nlohmann::ordered_json::parse(lessons_file.front().text);
  for (const auto& [name, words] : lessons.items()) {
    if (!technique.empty() && name != technique) continue;
    RunOptions options;
    options.contenders = {name};
    options.reference = false;
    options.measure_cost = false;
    options.max_replay_steps = 8;
    const ReportScene result = run_scene(scene, options);
    print_out(fmt::format("{}: {}\n{}\n", name, outcome_of(result.rows.front()), words.get<std::string>()));
    if (result.runs.empty())
      print_out(fmt::format("  {}\n", result.rows.front().reason));
    else
      print_out(picture(result.runs.front(), scene.pixels_per_metre));
    print_out("\n");
  }
  print_out("`paperproof study bullet` has the same over speeds, thicknesses, angles and phases.\n");
  return 0;
}

}  // namespace paperproof::compare
