#include "command/commands.hpp"

#include "command/compare_command.hpp"
#include "records/output_file.hpp"
#include "runs/contender.hpp"
#include "runs/row_views.hpp"
#include "runs/run.hpp"
#include "scenes/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace paperproof::compare {
namespace {

constexpr double pixels_per_line = 5;

/// How a technique looks for collisions, and what that means for the bullet.
struct Lesson {
  std::string_view name;
  std::string_view words;
};

constexpr std::array lessons{
    Lesson{"grid",
           "The level is an array of squares, and the character is in exactly one. It moves by whole squares, so a "
           "bullet of one pixel is not its business."},
    Lesson{"pixel_colour",
           "Before each pixel of its way it looks at the colours beside it. 50 pixels are 50 looks: it "
           "misses nothing that is drawn, and pays for each pixel."},
    Lesson{"pixel_tile", "As pixel_colour, with tiles that say per pixel what a collision does."},
    Lesson{"mask",
           "It draws itself where it would arrive, and asks which pixels lie on the level. Nobody looks at the "
           "way: the bullet arrives behind the platform."},
    Lesson{"bounding_box",
           "Boxes around everything, tested where the step ends. The box of the bullet is behind the box "
           "of the platform by then."},
    Lesson{"discrete", "It looks at the present and the expected place, and at nothing in between."},
    Lesson{"wind_back",
           "If a point is in something where the step ends, it goes back along the way. Here no point is in "
           "anything: there is nothing to go back from."},
    Lesson{"penetration_resolution", "Points that end in something are pushed out of it. These ended behind it."},
    Lesson{"speculative_march",
           "It advances along the way one unit at a time and goes back one when a point is in "
           "something: the article's answer. A platform thinner than a unit would be stepped over."},
    Lesson{"speculative",
           "The same with the time of impact of each point computed. Points alone: a spike between two of "
           "them would not be met."},
    Lesson{"octagon_sweep", "The whole outline is swept along the whole way, and stops at the time of impact."},
    Lesson{"box2d", "Box2D sweeps the body to its time of impact, too, and stops within its skin."},
    Lesson{"box2d_pieces", "The same with one fixture per convex piece."},
};

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

int demo_command(const std::string& technique) {
  if (!technique.empty()) check_contenders({technique}, "demo");
  const Scene scene = load_scene("article_bullet", {});
  print_out(
      "The article's bullet: one pixel, falling 50 pixels in its first frame, onto a platform 5 pixels thick that\n"
      "begins 30 pixels below it. It should stop at 0.6 of the frame.\n\n");
  for (const Lesson& lesson : lessons) {
    if (!technique.empty() && lesson.name != technique) continue;
    RunOptions options;
    options.contenders = {std::string(lesson.name)};
    options.reference = false;
    options.measure_cost = false;
    options.max_replay_steps = 8;
    const ReportScene result = run_scene(scene, options);
    print_out(fmt::format("{}: {}\n{}\n", lesson.name, outcome_of(result.rows.front()), lesson.words));
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
