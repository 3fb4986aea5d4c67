#include "studies/bullet.hpp"

#include "oracle/exemptions.hpp"
#include "runs/contender.hpp"
#include "runs/run_case.hpp"
#include "scenes/json_text.hpp"

#include <paperproof/number_in.hpp>

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

}  // namespace

std::vector<NamedContender> bullet_contenders() {
  return all_contenders_and(
      {{"box2d", {{"continuous", "off"}}}, {"box2d", {{"bullet", "off"}, {"solids", "dynamic"}}}});
}

std::vector<StudyPart> bullet_parts(GridSize size, const std::vector<std::string>&) {
  const Json& study = study_text("bullet");
  std::vector<StudyPart> parts;
  for (const NamedContender& contender : bullet_contenders()) {
    const bool promises = is_guaranteed(contender.name, "double");
    parts.push_back(part_of(study.at(promises ? "promised" : "others"), size));
    parts.back().sweep.contenders = {contender};
  }
  for (const Json& text : study.at("parts")) {
    StudyPart& part = parts.emplace_back(part_of(text, size));
    if (!part.sweep.border) continue;
    part.sweep.contenders = bullet_contenders();
    part.run = [phases = of_size(text.at("phases"), size).get<int>()](const Sweep& sweep, std::size_t index) {
      return lowest_speed_through(sweep.at(index), phases);
    };
  }
  for (StudyPart& part : parts) part.bad = Bad::tunnels;
  return parts;
}

Row lowest_speed_through(const Case& paper, int phases) {
  const std::string& thickness = paper.parameters.front().value;
  const auto over_phases = [&](double speed) {
    Row worst;
    for (int phase = 0; phase < phases; ++phase) {
      Case one = paper;
      one.parameters = {{"speed", fmt::format("{}", speed)},
                        {"thickness", thickness},
                        {"height", "0.1"},
                        {"phase", fmt::format("{}", static_cast<double>(phase) / phases)}};
      worst = run_case(one);
      worst.steps_ending_inside.reset();  // it is asked what gets through
      if (worst.tunnels.value_or(0) > 0 || !was_judged(worst)) break;
    }
    return worst;
  };
  const double paper_per_step = number_in<double>(thickness).value() / usual_step;
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
