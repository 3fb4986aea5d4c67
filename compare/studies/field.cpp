#include "studies/field.hpp"

#include "oracle/exemptions.hpp"
#include "records/verdict.hpp"
#include "runs/contender.hpp"
#include "runs/peers.hpp"
#include "runs/run_case.hpp"
#include "scenes/json_text.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>

namespace paperproof::compare {
namespace {

/// Bounds, each with its reason.
constexpr double visible = 1e-4;    ///< A motion of what should rest [m]: a 300th of a pixel at 32 pixels per metre.
constexpr double most_lost = 0.01;  ///< Share of the wanted motion: less is lost where a float ends.
constexpr double most_off = 0.1;    ///< From the exact way [m]: five of the largest skins.

template <class Number>
std::optional<double> beyond(const std::optional<Number>& size, double bound) {
  return size && *size > bound ? std::optional<double>(*size) : std::nullopt;
}

/// What is not asked in every scene.
struct Asked {
  bool seams;  ///< Its ground is level: what hops hops at seams.
  bool way;    ///< There is an exact one.
};

/// One thing that a run may do wrong.
struct Fault {
  double rank;                                    ///< See `Row::badness`.
  const char* words;                              ///< With a place for its size.
  double unit;                                    ///< In which the size is told.
  std::optional<double> (*size)(const Row& row);  ///< Nothing: it does not.
  bool Asked::*where = nullptr;                   ///< Null: everywhere.
};

// Ranks that mean more than an order.
constexpr double failing = 4;
constexpr double through_ledge = 3.2;
constexpr double through = 3;
constexpr double inside = 2;
constexpr double least_unsafe = 1;

/// The worst one first.
constexpr std::array faults{
    Fault{failing, "fails", 1,
          [](const Row& row) { return row.verdict == Verdict::failed ? std::optional(0.0) : std::nullopt; }},
    Fault{through_ledge, "through a ledge", 1, [](const Row& row) { return beyond(row.one_way_violations, 0); }},
    Fault{through, "through at {} m/s", 1,
          [](const Row& row) {
            if (row.tunnels.value_or(0) == 0) return std::optional<double>{};
            return std::optional(row.first_tunnel ? row.first_tunnel->speed_m_s : 0);
          }},
    Fault{inside, "inside {} mm", 1e-3, [](const Row& row) { return beyond(row.max_penetration_m, skin_of(row)); }},
    // Where more was wanted than its maker documents none of the others below counts.
    Fault{0.05, "beyond its limit", 1,
          [](const Row& row) { return falls_short(row, Axis::validity) ? std::optional(0.0) : std::nullopt; }},
    Fault{least_unsafe, "hangs {} of its steps", 1,
          [](const Row& row) { return beyond(std::optional(hanging_of(row)), 0); }},
    Fault{0.8, "clips {} mm", 1e-3, [](const Row& row) { return beyond(row.clipped_depth_max_m, 0); }},
    Fault{0.6, "restless {} mm", 1e-3, [](const Row& row) { return beyond(row.rest_peak_to_peak_m, visible); }},
    Fault{0.4, "hops {} mm", 1e-3, [](const Row& row) { return beyond(row.seam_hop_m, visible); }, &Asked::seams},
    Fault{0.2, "loses {} %", 0.01, [](const Row& row) { return beyond(row.wanted_motion_lost, most_lost); }},
    Fault{0.1, "off {} m", 1, [](const Row& row) { return beyond(row.error_law_max_m, most_off); }, &Asked::way},
};

/// Says of a run the worst that it does: `worst`, in a word and a figure, and `badness`.
void judge_field(Row& row, const Asked& asked) {
  if (row.verdict == Verdict::not_applicable) return;
  row.worst = "holds";
  row.badness = 0;
  for (const Fault& fault : faults)
    if (const auto size = fault.where == nullptr || asked.*fault.where ? fault.size(row) : std::nullopt) {
      row.worst = fmt::format(fmt::runtime(fault.words), in_short(*size / fault.unit));
      // Of two alike the larger one is worse; of two passages the slower one.
      const double share = *size / (1 + *size);
      row.badness = fault.rank + 0.1 * (fault.rank == through ? 1 - share : share);
      return;
    }
}

}  // namespace

std::string in_short(double number) { return fmt::format(fmt::runtime(number >= 10 ? "{:.0f}" : "{:.2g}"), number); }

int hanging_of(const Row& row) {
  return row.hanging_steps.value_or(0) - (is_guaranteed(row) ? 0 : row.hanging_by_law.value_or(0));
}

double skin_of(const Row& row) { return row.skin_m.value_or(is_reference(row.contender) ? box2d_skin : 0); }

bool is_unsafe(const Row& row) { return row.badness.value_or(0) >= least_unsafe; }

std::optional<ReportEvent::Kind> hole_of(const Row& row) {
  const double badness = row.badness.value_or(0);
  if (!is_unsafe(row) || badness >= through_ledge) return std::nullopt;
  return badness >= through  ? ReportEvent::Kind::tunnel
         : badness >= inside ? ReportEvent::Kind::inside
                             : ReportEvent::Kind::hanging;
}

std::vector<StudyPart> field_parts(GridSize size, const std::vector<std::string>& contenders) {
  std::vector<NamedContender> who;
  for (const std::string& name : contenders) who.push_back({name});
  if (contenders.empty()) {
    who = {{"octagon_sweep"}, {"box2d"}};
    for (const Peer& peer : peers()) who.push_back({peer.name});
  }
  std::vector<StudyPart> parts;
  for (const Json& group : study_text("field").at("groups"))
    for (const Json& text : group.at("parts")) {
      StudyPart part = part_of(text, size);
      part.title = field_title + group.at("name").get<std::string>();
      part.question = group.at("question");
      if (text.contains("instead") && !std::filesystem::exists(part.sweep.scene)) {
        part.sweep.scene = "playground";
        part.sweep.axes = parse_axes(text["instead"].get<std::string>());
      }
      part.sweep.contenders = who;
      const Asked asked{.seams = group.at("name") == field_seams, .way = !text.value("either_way", false)};
      part.run = [asked](const Sweep& sweep, std::size_t index) {
        const Case one_case = sweep.at(index);
        // Costs are those of the walk over tiles, which everybody can make.
        Row row = run_case_beside_motion(one_case, asked.seams && one_case.peer.empty());
        judge_field(row, asked);
        return row;
      };
      parts.push_back(std::move(part));
    }
  return parts;
}

std::vector<std::string> field_questions() {
  std::vector<std::string> all;
  for (const Json& group : study_text("field").at("groups"))
    all.push_back(fmt::format("{}: {}", group.at("name").get<std::string>(), group.at("question").get<std::string>()));
  return all;
}

}  // namespace paperproof::compare
