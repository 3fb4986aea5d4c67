#include "studies/bullet.hpp"

#include "oracle/exemptions.hpp"
#include "runs/contender.hpp"
#include "runs/run_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace paperproof::compare {
namespace {

constexpr double usual_step = 1.0 / 60;  ///< [s]
constexpr double pixel = 1.0 / 32;       ///< [m]
constexpr double height = 40 * pixel;    ///< Of the article's character [m].
constexpr std::array rows_of_points{0.0, 0.3125, 0.9375, 1.25};
constexpr double fastest = 3000;  ///< [m/s]
/// Where points are sparse the speeds that get through begin as windows, some of them narrower than 1 %.
constexpr int fine_values = 256;

/// Whether intervals of one length, one beginning at each row, leave something of a circle free.
bool leaves_a_gap(double circumference, double length) {
  std::vector<double> begins;
  for (const double row : rows_of_points) begins.push_back(std::fmod(row, circumference));
  std::sort(begins.begin(), begins.end());
  double covered = begins.front();  // the last line looks at the gap from the last interval round to the first
  for (const double begin : begins) {
    if (begin > covered) return true;
    covered = std::max(covered, begin + length);
  }
  return covered < circumference + begins.front();
}

double pixels_drawn(double thickness) { return std::max(0.0, std::ceil(thickness / pixel - 0.5)); }

std::string phase_axis(int phases) { return fmt::format("phase=0:{}:lin{}", (phases - 1.0) / phases, phases); }

}  // namespace

std::vector<NamedContender> bullet_contenders() {
  return all_contenders_and(
      {{"box2d", {{"continuous", "off"}}}, {"box2d", {{"bullet", "off"}, {"solids", "dynamic"}}}});
}

namespace {

Sweep bullet_sweep(GridSize size, const NamedContender& contender) {
  struct Grid {
    const char* axes;  ///< With a place for the phases.
    int phases;
    int promised_phases;
  };
  constexpr std::array grids{
      Grid{"speed=5:5000:log12 thickness=0.001,0.01,0.1,0.5 angle=90,45 {} dt=0.016666666666666666", 3, 12},
      Grid{"speed=5:5000:log40 thickness=0,0.001,0.003,0.01,0.03,0.1,0.3,1 angle=90,60,30,5 {} "
           "dt=0.016666666666666666,0.006944444444444444",
           16, 400},
      Grid{"speed=5:5000:log80 thickness=0,0.001,0.003,0.01,0.03,0.1,0.3,1 angle=90,75,60,45,30,5 {} "
           "dt=0.03333333333333333,0.016666666666666666,0.006944444444444444",
           32, 1000}};
  const Grid& grid = grids[static_cast<std::size_t>(size)];
  const int phases = is_guaranteed(contender.name, "double") ? grid.promised_phases : grid.phases;
  Sweep sweep;
  sweep.scene = "paper";
  sweep.axes = parse_axes(fmt::format(fmt::runtime(grid.axes), phase_axis(phases)));
  sweep.contenders = {contender};
  return sweep;
}

StudyPart moving_paper_part(GridSize size) {
  constexpr std::array counts{std::pair{6, 2}, std::pair{24, 8}, std::pair{80, 32}};
  const auto [speeds, phases] = counts[static_cast<std::size_t>(size)];
  StudyPart part{moving_paper_title, {}, {}, Bad::tunnels};
  part.sweep.scene = "moving_paper";
  part.sweep.axes = parse_axes(fmt::format("closing=5:5000:log{} thickness=0.001,0.1 {}", speeds, phase_axis(phases)));
  part.sweep.contenders = all_contenders_and({{"box2d", {{"movers", "transform"}}}});
  return part;
}

StudyPart far_part(GridSize size) {
  StudyPart part{far_title, {}, {}, Bad::tunnels};
  part.sweep.scene = "far";
  part.sweep.axes = parse_axes(size == GridSize::quick ? "origin=100:1e6:log8" : "origin=100:1e6:log24");
  part.sweep.contenders = all_contenders_and({});
  return part;
}

int phases_of(GridSize size) { return size == GridSize::quick ? 24 : size == GridSize::standard ? 160 : 400; }

StudyPart lowest_speeds_part(GridSize size) {
  StudyPart part{lowest_speeds_title, {}, {}, Bad::tunnels};
  part.sweep.scene = "paper";
  SweepAxis thickness{"thickness", {}};
  for (const double value : bullet_thicknesses()) thickness.values.push_back(fmt::format("{}", value));
  part.sweep.axes = {thickness};
  part.sweep.contenders = bullet_contenders();
  part.sweep.border = "speed";
  part.run = [phases = phases_of(size)](const Sweep& sweep, std::size_t index) {
    return lowest_speed_through(sweep.at(index),
                                bullet_thicknesses()[index / (sweep.contenders.size() * sweep.scalars.size())], phases);
  };
  return part;
}

}  // namespace

std::vector<double> bullet_thicknesses() { return {0.01, 0.1}; }

std::vector<StudyPart> bullet_parts(GridSize size, const std::vector<std::string>&) {
  std::vector<StudyPart> parts;
  for (const NamedContender& contender : bullet_contenders())
    parts.push_back({"", bullet_sweep(size, contender), {}, Bad::tunnels});
  parts.push_back(moving_paper_part(size));
  parts.push_back(far_part(size));
  parts.push_back(lowest_speeds_part(size));
  return parts;
}

Row lowest_speed_through(const Case& paper, double thickness, int phases) {
  const auto over_phases = [&](double speed) {
    Row worst;
    for (int phase = 0; phase < phases; ++phase) {
      Case one = paper;
      one.parameters = {{"speed", fmt::format("{}", speed)},
                        {"thickness", fmt::format("{}", thickness)},
                        {"height", "0.1"},
                        {"phase", fmt::format("{}", static_cast<double>(phase) / phases)}};
      worst = run_case(one);
      worst.steps_ending_inside.reset();  // it is asked what gets through
      if (worst.tunnels.value_or(0) > 0 || !was_judged(worst)) break;
    }
    return worst;
  };
  const double paper_per_step = thickness / usual_step;
  Row row = find_border("speed_m_s", 0.9 * paper_per_step, 1.6 * paper_per_step, over_phases, fine_values);
  if (!row.border_high && was_judged(row)) row = find_border("speed_m_s", 1.6 * paper_per_step, fastest, over_phases);
  std::erase_if(row.parameters, [](const auto& each) { return each.first == "speed_m_s" || each.first == "phase"; });
  row.case_id =
      hash_of(fmt::format("{} lowest speed through {} m over {} phases", command_of(paper), thickness, phases));
  return row;
}

BulletTheory bullet_theory(const NamedContender& contender, double thickness) {
  const std::string& name = contender.name;
  if (is_reference(name)) {
    if (contender.knobs.empty()) return {true};
    const double to_the_middle = contender.knobs.front().key == "continuous" ? 0 : thickness / 2;
    return {true, (height / 2 + to_the_middle + box2d_skin) / usual_step};
  }
  if (name == "octagon_sweep" || name == "speculative") return {true};
  const double drawn = pixels_drawn(thickness) * pixel;
  if (name == "penetration_resolution") return {true, thickness / usual_step};
  if (name == "speculative_march")
    return thickness < pixel ? BulletTheory{true, thickness / usual_step} : BulletTheory{true};
  if (name == "bounding_box" || name == "discrete") return {true, (height + thickness) / usual_step};
  if (name == "mask") return {true, drawn > 0 ? (height + drawn - pixel) / usual_step : 0};
  if (name == "pixel_colour" || name == "pixel_tile") return drawn > 0 ? BulletTheory{true} : BulletTheory{true, 0.0};
  if (name == "wind_back") {
    if (thickness <= 0) return {true, 0.0};
    double way = thickness;
    while (!leaves_a_gap(way, thickness)) way *= 1 + 1e-5;
    return {true, way / usual_step};
  }
  return {};
}

std::string bullet_theory_in_words(const std::string& who, double thickness) {
  BulletTheory theory;
  for (const NamedContender& contender : bullet_contenders())
    if (contender.called() == who) theory = bullet_theory(contender, thickness);
  if (!theory.known) return "-";
  if (!theory.lowest) return "never";
  return *theory.lowest > 0 ? fmt::format("{:.4g}", *theory.lowest) : "any";
}

Interval wilson(int bad, int all) {
  if (all == 0) return {};
  constexpr double z = 1.959963984540054;
  const double n = all;
  const double rate = bad / n;
  const double middle = rate + z * z / (2 * n);
  const double half = z * std::sqrt(rate * (1 - rate) / n + z * z / (4 * n * n));
  const double scale = 1 + z * z / n;
  return {std::max(0.0, (middle - half) / scale), std::min(1.0, (middle + half) / scale)};
}

}  // namespace paperproof::compare
