#include "studies/field.hpp"

#include "oracle/exemptions.hpp"
#include "records/verdict.hpp"
#include "runs/contender.hpp"
#include "runs/peers.hpp"
#include "runs/run_case.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>

namespace paperproof::compare {
namespace {

/// Bounds, each with its reason.
constexpr double visible = 1e-4;    ///< A motion of what should rest [m]: a 300th of a pixel at 32 pixels per metre.
constexpr double most_lost = 0.01;  ///< Share of the wanted motion: less is lost where a float ends.
constexpr double most_off = 0.1;    ///< From the exact way [m]: five of the largest skins.

using FieldAxes = std::array<std::string_view, 3>;

struct FieldScene {
  std::string scene;
  FieldAxes axes{};            ///< For each size of the grid; empty: as the scene is.
  std::array<int, 3> steps{};  ///< The same; 0: the scene's.
  std::string_view instead{};  ///< Of the playground, which stands for a file that is not there.
  bool either_way = false;     ///< It may stop as well as go on: no way is the exact one.
};

struct Group {
  std::string_view name;
  std::string_view question;
  std::vector<FieldScene> scenes;
};

/// None is half the acceleration of who walks: a body without friction that walks into a side of 2:1 is in balance
/// there.
constexpr FieldAxes gravities{"gravity=20,45", "gravity=11:59:lin9", "gravity=11:59:lin25"};
constexpr FieldAxes minute_hour_day{"steps=3600", "steps=216000", "steps=5184000"};

/// A map of SuperTux.
FieldScene map(const std::string& level, std::string_view instead) {
  return {"/usr/share/games/supertux2/levels/" + level + ".stl", {}, {300, 3600, 3600}, instead};
}

std::vector<Group> groups() {
  return {
      {"bullets",
       "A fall onto paper, at five speeds and more.",
       {{"paper",
         {"speed=10,20,40,80,160 thickness=0.001,0.1", "speed=5:640:log15 thickness=0,0.001,0.01,0.1 phase=0,0.25,0.5",
          "speed=5:640:log36 thickness=0,0.001,0.003,0.01,0.03,0.1,0.3 phase=0:0.9:lin10"}}}},
      {field_seams,
       "A walk over flush tiles of a metre.",
       {{"tiles", {"speed=1.7,7.3,11.3", "speed=0.5:12:lin24", "speed=0.12:12:lin100"}}}},
      {"slopes",
       "Up a slope of the climb limit; down into a valley; over a hill.",
       {{"climb45_3m"}, {"skier_no_snap"}, {"slope_joints_no_snap"}}},
      {"steps",
       "Against kerbs of 1 mm and 10 cm and a step of 30 cm, which are walls where nobody climbs steps.",
       {{.scene = "kerb_1mm", .either_way = true}, {"kerb_10cm"}, {"low_step"}}},
      {"edges",
       "Off a ledge, over a gap, into a gap, with the key held, under less and more gravity.",
       {{"ledge_corner", gravities}, {"gap_crossed"}, {"gap_fallen", gravities}}},
      {"wedges",
       "A fall into a V.",
       {{"wedge",
         {"angle=60,30,5", "angle=1:60:log12", "angle=1:120:log60 dt=0.004166666666666667,0.016666666666666666"}}}},
      {"lifts", "Up, down and to the side, and back.", {{"lift_up"}, {"lift_down"}, {"lift_sideways"}}},
      {"turning", "Beside a paper that turns; under an arm that does.", {{"rotating_paper"}, {"turning_arm"}}},
      {"one-way",
       "Up through a ledge that moves; onto one at 50 m/s; dropped through one onto the next.",
       {{"one_way_lift_from_below"}, {"one_way_from_above"}, {"one_way_drop"}}},
      {"closing walls",
       "Between walls that leave 10 cm of room; before a paper that comes at 20 m/s.",
       {{"closing_walls",
         {"closing=1,10 clearance=0.1", "closing=0.5:50:log12 clearance=0.02,0.1",
          "closing=0.5:1000:log30 clearance=0.02,0.1"}},
        {"sweeping_paper"}}},
      {"rest", "A minute of rest; with --grid standard an hour, with full a day.", {{"rest", minute_hour_day}}},
      {"play",
       "Walks and jumps at random through three maps.",
       {map("bonus1/abednego-level4", "seed=1"), map("bonus2/level16", "seed=2"),
        map("bonus3/crystalfields", "seed=3")}},
  };
}

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
  const auto of_size = static_cast<std::size_t>(size);
  std::vector<StudyPart> parts;
  for (const Group& group : groups())
    for (const FieldScene& one : group.scenes) {
      StudyPart part{field_title + std::string(group.name), {}, {}, Bad::does_not_hold, std::string(group.question)};
      const bool is_there = one.instead.empty() || std::filesystem::exists(one.scene);
      part.sweep.scene = is_there ? one.scene : "playground";
      const std::string_view axes = is_there ? one.axes[of_size] : one.instead;
      if (!axes.empty()) part.sweep.axes = parse_axes(axes);
      if (one.steps[of_size] > 0) part.sweep.steps = one.steps[of_size];
      part.sweep.contenders = who;
      const Asked asked{.seams = group.name == field_seams, .way = !one.either_way};
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

std::vector<std::string> field_paragraphs() {
  std::vector<std::string> all{
      "How to read this: a line for each contender, a column for each kind of trouble. A cell has the worst that its "
      "runs do, and of how many runs how many do anything wrong, judged step by step by exact arithmetic. Choose a "
      "cell to see the run beside that of octagon_sweep, step by step.",
      "From bad to less: fails; through a one-way ledge against its normal; through, at the slowest speed, also over "
      "an edge that it sinks into by more than 20 mm; inside something by more than its skin; hangs in the air; clips "
      "a corner; restless, where it should rest, or hops at seams once it has settled, by more than 0.1 mm; loses "
      "more than 1 % of the wanted motion to nothing; off the exact way by more than 0.1 m. A peer's way is held "
      "against the law of octagon_sweep and that of a body without friction, for its own shape, and the nearer one "
      "counts. Steps on which such a law hangs at the same place are no fault, but of octagon_sweep. Where more is "
      "wanted than its maker documents, such as 2 m a step of Box2D 2.4, it is beyond its limit, unless it fails, "
      "passes or ends inside something. What a law of response does by design is no fault, and the scenes' own "
      "answers are not asked. At the kerb of 1 mm it may stop or go over.",
      "Not in it: stairs, as no built-in scene has any and of the peers Rapier's controller alone climbs; several "
      "characters, as no peer that ships runs them."};
  for (const Group& group : groups()) all.push_back(fmt::format("{}: {}", group.name, group.question));
  return all;
}

}  // namespace paperproof::compare
