#include "studies/bullet.hpp"

#include "runs/contestant.hpp"
#include "runs/run_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace paperproof::compare {
namespace {

constexpr double usual_step = 1.0 / 60;  ///< [s]
constexpr double pixel = 1.0 / 32;       ///< Unit and pixel of every technique that has one [m].
constexpr double height = 1.25;          ///< Of the character [m].
constexpr std::array rows_of_points{0.0, 0.3125, 0.9375, 1.25};
constexpr double fastest = 3000;  ///< [m/s]
/// Where points are sparse the speeds that get through begin as windows, some of them narrower than 1 %.
constexpr int fine_values = 256;

/// Whether intervals of one length, one beginning at each row, leave something of a circle free.
bool leaves_a_gap(double circumference, double length) {
  std::vector<double> begins;
  for (const double row : rows_of_points) begins.push_back(std::fmod(row, circumference));
  std::sort(begins.begin(), begins.end());
  double covered = begins.front();  // the way round from the last one is looked at in the end
  for (const double begin : begins) {
    if (begin > covered) return true;
    covered = std::max(covered, begin + length);
  }
  return covered < circumference + begins.front();
}

double pixels_drawn(double thickness) { return std::max(0.0, std::ceil(thickness / pixel - 0.5)); }

std::string axis_of(std::size_t count, double first, double last, const char* kind) {
  return fmt::format("{}:{}:{}{}", first, last, kind, count);
}

}  // namespace

std::string BulletContender::called() const {
  std::string text = name;
  for (const Case::Setting& knob : knobs) text += fmt::format(" {}={}", knob.key, knob.value);
  return text;
}

std::vector<BulletContender> bullet_contenders(const std::vector<std::string>& wanted) {
  std::vector<BulletContender> all;
  const auto is_wanted = [&](std::string_view name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
  };
  for (const std::string_view name : contender_names())
    if (is_wanted(name)) all.push_back({std::string(name)});
  if (!is_wanted("box2d")) return all;
  all.push_back({"box2d", {{"continuous", "off"}}});
  all.push_back({"box2d", {{"bullet", "off"}, {"solids", "dynamic"}}});
  return all;
}

Sweep bullet_sweep(GridSize size, const BulletContender& contender) {
  struct Counts {
    std::size_t speeds;
    const char* thickness;
    const char* angles;
    std::size_t phases;
    std::size_t promised_phases;
    const char* steps;
  };
  constexpr Counts quick{12, "thickness=0.001,0.01,0.1,0.5", "angle=90,45", 3, 12, "dt=0.016666666666666666"};
  constexpr Counts standard{40,  "thickness=0,0.001,0.003,0.01,0.03,0.1,0.3,1", "angle=90,60,30,5", 16,
                            400, "dt=0.016666666666666666,0.006944444444444444"};
  constexpr Counts full{80,
                        "thickness=0,0.001,0.003,0.01,0.03,0.1,0.3,1",
                        "angle=90,75,60,45,30,5",
                        32,
                        1000,
                        "dt=0.03333333333333333,0.016666666666666666,0.006944444444444444"};
  const Counts& counts = size == GridSize::quick ? quick : size == GridSize::standard ? standard : full;
  const std::size_t phases = is_guaranteed(contender.name, "double") ? counts.promised_phases : counts.phases;
  Sweep sweep;
  sweep.scene = "paper";
  const auto last = static_cast<double>(phases - 1) / static_cast<double>(phases);
  for (const std::string& axis :
       {"speed=" + axis_of(counts.speeds, 5, 5000, "log"), std::string(counts.thickness), std::string(counts.angles),
        "phase=" + axis_of(phases, 0, last, "lin"), std::string(counts.steps)})
    sweep.axes.push_back(parse_axis(axis));
  sweep.contenders = {contender.name};
  sweep.knobs = contender.knobs;
  return sweep;
}

std::vector<double> bullet_thicknesses() { return {0.01, 0.1}; }

int phases_of(GridSize size) { return size == GridSize::quick ? 24 : size == GridSize::standard ? 160 : 400; }

Row lowest_speed_through(const BulletContender& contender, double thickness, int phases) {
  Case one;
  one.scene = "paper";
  one.contender = contender.name;
  one.knobs = contender.knobs;
  const auto over_phases = [&](double speed) {
    Row worst;
    for (int phase = 0; phase < phases; ++phase) {
      one.parameters = {{"speed", fmt::format("{}", speed)},
                        {"thickness", fmt::format("{}", thickness)},
                        {"height", "0.1"},
                        {"phase", fmt::format("{}", static_cast<double>(phase) / phases)}};
      worst = run_case(one);
      worst.steps_ending_inside.reset();  // it is asked who gets through
      if (worst.tunnels.value_or(0) > 0 || worst.verdict == Verdict::not_applicable) break;
    }
    return worst;
  };
  const double paper_per_step = thickness / usual_step;
  const Row near = find_border("speed_m_s", 0.9 * paper_per_step, 1.6 * paper_per_step, over_phases, fine_values);
  if (near.border_high || near.verdict == Verdict::not_applicable) return near;
  return find_border("speed_m_s", 1.6 * paper_per_step, fastest, over_phases);
}

BulletTheory bullet_theory(const BulletContender& contender, double thickness) {
  const std::string& name = contender.name;
  if (is_reference(name)) return contender.knobs.empty() ? BulletTheory{true} : BulletTheory{};
  if (name == "octagon_sweep" || name == "speculative") return {true};
  const double drawn = pixels_drawn(thickness) * pixel;
  if (name == "penetration_resolution") return {true, thickness / usual_step};
  if (name == "speculative_march")
    return thickness < pixel ? BulletTheory{true, thickness / usual_step} : BulletTheory{true};
  if (name == "bounding_box" || name == "discrete") return {true, (height + thickness) / usual_step};
  if (name == "mask") return {true, drawn > 0 ? (height + drawn - pixel) / usual_step : 0};
  if (name == "pixel_colour" || name == "pixel_tile") return drawn > 0 ? BulletTheory{true} : BulletTheory{true, 0.0};
  if (name == "wind_back") {
    double way = thickness;
    while (!leaves_a_gap(way, thickness)) way *= 1 + 1e-5;
    return {true, way / usual_step};
  }
  return {};
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
