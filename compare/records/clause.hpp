/// The clauses of the guarantee, by the names that traces, rows and the command use.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// What a contender may promise of every step. oracle/README.md says what the judge asks for each.
enum class Clause : std::uint8_t {
  overlap,           ///< Ends inside nothing that it did not overlap before and that did not crush it.
  passage,           ///< Passes through nothing.
  one_way,           ///< Passes no one-way chain against its normal, unless on purpose.
  gap,               ///< What stopped it is within 1e-6 m.
  time_of_impact,    ///< The fraction of a first contact is that of the exact motion, within 1e-6 m along the normal.
  contact_missed,    ///< Reports every contact.
  contact_invented,  ///< Reports no other contact.
  normal,            ///< Reports the normal of the face that it touches.
  sensor,            ///< Reports what enters and leaves, and when.
  rest,              ///< Stays where it rests, bit for bit, and a rider on its place.
  start_inside,      ///< Leaves what it starts inside of by the shortest straight way, and is stuck only without one.
  refusal,           ///< Refuses what is invalid or out of range, and nothing else.
  hanging,           ///< Falls where it can.
  speed_lost,        ///< Loses speed and way only to contacts.
  ground_invented,   ///< Is grounded only on ground.
  ground_missed,     ///< Is grounded wherever it touches ground and does not leave it.
  crush,             ///< Is crushed only without room.
  wanted,            ///< Goes for what scene, input and state ask for.
  velocity,          ///< Ends with a velocity that the law of response makes of what was wanted.
  continuity,        ///< Begins each step as it ended the one before.
  mover_way,         ///< Takes movers to go as the scene says.
};

inline constexpr std::array<std::string_view, 21> clause_names{
    "overlap",          "passage",    "one_way",         "gap",           "time_of_impact", "contact_missed",
    "contact_invented", "normal",     "sensor",          "rest",          "start_inside",   "refusal",
    "hanging",          "speed_lost", "ground_invented", "ground_missed", "crush",          "wanted",
    "velocity",         "continuity", "mover_way"};

/// As a trace and a row have it.
[[nodiscard]] constexpr std::string_view name_of(Clause clause) noexcept {
  return clause_names[static_cast<std::size_t>(clause)];
}

/// Nothing where no clause has that name.
[[nodiscard]] constexpr std::optional<Clause> clause_named(std::string_view name) noexcept {
  for (std::size_t i = 0; i < clause_names.size(); ++i)
    if (clause_names[i] == name) return static_cast<Clause>(i);
  return std::nullopt;
}

[[nodiscard]] inline std::vector<Clause> every_clause() {
  std::vector<Clause> clauses;
  for (std::size_t i = 0; i < clause_names.size(); ++i) clauses.push_back(static_cast<Clause>(i));
  return clauses;
}

/// Whether it takes more than one impact in a step: to meet a surface, to go on along it, to meet another.
[[nodiscard]] constexpr bool takes_several_impacts(Clause clause) noexcept {
  return clause == Clause::rest || clause == Clause::hanging || clause == Clause::speed_lost ||
         clause == Clause::velocity;
}

/// On how many steps a clause was broken, and where first.
struct Breach {
  int steps = 0;
  int first_step = 0;
  int last_step = 0;
  std::string first;  ///< What happened there.

  /// Counts a step once, whatever else breaks the clause in it. Steps come in order. @param words for the first one.
  template <class Words>
  void add(int step, const Words& words) {
    if (steps == 0) {
      first_step = step;
      first = words();
    }
    steps += steps == 0 || step != last_step;
    last_step = step;
  }
};
using Breaches = std::map<Clause, Breach>;

}  // namespace paperproof::compare
