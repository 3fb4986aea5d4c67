/// One result: a (scene, contender, scalar, mode) and its numbers. A metric that does not apply is absent.
#pragma once

#include "records/commit.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace paperproof::compare {

enum class Verdict { holds, tunnels, violates, not_applicable, flagged, failed };
inline constexpr std::array<std::string_view, 6> verdict_names{"holds",          "tunnels", "violates",
                                                               "not_applicable", "flagged", "failed"};
[[nodiscard]] std::string_view name_of(Verdict verdict) noexcept;

/// A result is looked at along these, and none hides another.
enum class Axis {
  safety,    ///< Passes nothing, ends inside nothing.
  progress,  ///< Gets where it can.
  answer,    ///< Meets the scene's exact answer.
  validity,  ///< The run is within the contender's limits.
};
[[nodiscard]] std::string_view name_of(Axis axis) noexcept;

/// Whether the guarantee of the README covers this contender: octagon_sweep in double.
[[nodiscard]] constexpr bool is_guaranteed(std::string_view contender, std::string_view scalar) noexcept {
  return contender == "octagon_sweep" && scalar == "double";
}

/// The contender of rows that are of no run, and have no cost: what steps alone make of continuous motion.
inline constexpr std::string_view law_of_steps = "law of steps";

/// Where a run fell short: see records/verdict.hpp.
struct AxisFault {
  Axis axis = Axis::safety;
  Verdict verdict = Verdict::flagged;
  std::string words;
};

/// The first passage through a solid, or through another character: then it has words alone.
struct FirstTunnel {
  int step = 0;
  std::string collider;  ///< Empty for a character.
  double speed_m_s = 0;
  double thickness_m = 0;  ///< At the crossing.
  double angle_deg = 0;    ///< Of the way to the face: 90 is head-on.
  std::string words;

  friend bool operator==(const FirstTunnel&, const FirstTunnel&) = default;
};

/// Events of one kind and cause on which a contender and Box2D differ.
struct Disagreements {
  int count = 0;
  int first_step = 0;
  std::string first;  ///< What each side says there.

  friend bool operator==(const Disagreements&, const Disagreements&) = default;
};

/// What is counted as bad where many rows stand together.
enum class Bad : std::uint8_t {
  does_not_hold,  ///< A verdict other than `holds`.
  tunnels,        ///< A solid was passed.
};

/// The sweep that a row is a case of: a cell of a heat map stands for it.
struct SweptIn {
  std::string question;           ///< Of a study that asks several; may be empty.
  std::vector<std::string> axes;  ///< Keys in `parameters`.
  Bad bad = Bad::does_not_hold;

  friend bool operator==(const SweptIn&, const SweptIn&) = default;
};

/// What the numbers of a row are.
namespace metric_kind {
using flag = bool;
using count = int;
using measure = double;  ///< Never below zero.
using real = double;
using bytes = std::size_t;
}  // namespace metric_kind

struct Row {
  std::string scene;
  std::string contender;
  std::string scalar = "double";
  std::string mode = "free";
  std::string knob;     ///< Settings that are not the usual ones, as `name=value`, with spaces between; empty for none.
  std::string engine;   ///< Name and version, as a peer says.
  std::string machine;  ///< What its engine runs on, as a peer says: native, webassembly, javascript or script.
  int steps = 0;        ///< that ran
  Verdict verdict = Verdict::holds;
  std::string reason;  ///< empty for `holds` only
  std::vector<AxisFault> faults;

  std::string case_id;                 ///< Of a run that is a Case: see records/case.hpp.
  std::string command;                 ///< That runs it alone; of a border, the case at the upper end of the bracket.
  std::string commit{built_commit()};  ///< That the command was built from.
  std::optional<SweptIn> swept;
  std::string source;                                      ///< Of the scene: see `Scene::source`.
  std::vector<std::pair<std::string, double>> parameters;  ///< Of scene, input and knobs, by keys that end in units.
  std::string border;                                      ///< Key of the parameter that was bisected; may be empty.

  // The numbers: records/metric_table.hpp says what each means. A number that does not apply is absent.
#define METRIC(kind, key, ...) std::optional<metric_kind::kind> key{};
#include "records/metric_table.hpp"

  std::optional<FirstTunnel> first_tunnel;
  /// Steps that broke a clause, promised or not, by its name: see records/clause.hpp.
  std::map<std::string, int> broken;
  std::map<std::string, int> exempted;  ///< What was not held against it, how often: see oracle/exemptions.hpp.
  /// Where a ledger was kept, by `cause.kind`: the events on which it and the Box2D twin differ. See `Ledger`.
  std::map<std::string, Disagreements> disagreements;
  std::string exact_first_impact;  ///< Collider of the exact first impact; empty where there is none, or only a seam.
  std::string answer;              ///< The answer that is missed most, in words; empty where all are met.
  std::string first_difference_box2d;  ///< The first difference to the twin in words, and which side is right.
  std::string event_sequence;          ///< Which events there were: see metrics/events.hpp.
  std::string worst;                   ///< That it does, in words: see `studies/field.hpp`.
  std::string curve;                   ///< Key of the parameter that a curve of several runs is over.
  std::vector<std::string> findings;   ///< Sentences: where the run began, what was not compared.
};

/// Whether a run was made and judged: neither `failed` nor `not_applicable`.
[[nodiscard]] bool was_judged(const Row& row) noexcept;

/// Whether it ran in float and could have run in double: engines have one number type.
[[nodiscard]] inline bool is_float_by_choice(const Row& row) noexcept {
  return row.scalar == "float" && row.engine.empty() && !row.contender.starts_with("box2d");
}

/// See `is_guaranteed`.
[[nodiscard]] inline bool is_guaranteed(const Row& row) noexcept { return is_guaranteed(row.contender, row.scalar); }

/// Whether octagon_sweep in double broke its guarantee.
[[nodiscard]] inline bool breaks_guarantee(const Row& row) noexcept {
  return is_guaranteed(row) && row.verdict == Verdict::violates;
}

/// One of its `parameters`; nothing where it has none of that key.
[[nodiscard]] std::optional<double> parameter_of(const Row& row, std::string_view key);

/// What a step takes [ns], of an engine by itself where the harness adds something to it; nothing for a row without
/// time.
[[nodiscard]] std::optional<double> time_per_step(const Row& row);

/// What a second of motion takes [ns]; nothing for a row without time or length of a step.
[[nodiscard]] std::optional<double> time_per_second(const Row& row);

/// The contender in words, with the number type where it could be another: Box2D's is always float.
[[nodiscard]] std::string called(const Row& row);

}  // namespace paperproof::compare
