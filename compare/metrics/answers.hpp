/// Whether a run comes to what its scene must come to.
#pragma once

#include "records/row.hpp"
#include "records/trace.hpp"
#include "scenes/answer.hpp"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace paperproof::compare {

/// Collects the answers of one run. Feed every record in order, then write the row. Memory does not grow with the
/// number of steps. Not thread-safe.
///
/// - `answer_ok`: every answer is met, within its tolerance and the contender's reach.
/// - `answer_error`: of the answer that is missed by most of its tolerances, by how much it is missed, in its unit (m,
///   m/s, steps, colliders); 0 where all are met to the bit.
/// - `answer`: the same in words, where it is missed.
///
/// All are absent where no answer is asked for.
class AnswerCheck {
 public:
  /// @throws std::invalid_argument for an answer with an id that is not in the header.
  AnswerCheck(const std::vector<Answer>& answers, const TraceHeader& header);
  void add(const TraceStep& step);
  /// Of a contender that may leave contacts out: when and how often it meets something is not asked.
  void ask_no_contacts();
  void write(Row& row) const;

 private:
  /// One answer and what was seen of it so far.
  struct Watch {
    Answer answer;
    ColliderIndex collider = no_collider;
    MoverIndex mover = no_mover;
    bool seen = false;  ///< `value` is one.
    double value = 0;
    Vec2d anchor{Vec2d::Zero()};      ///< `drift`, `settled`: what it is compared with.
    bool grounded = false;            ///< `settled`: the same.
    std::set<ColliderIndex> named{};  ///< `crushers`

    void first(double when);
    void largest(double at);
    void settle(const TraceStep& step, double reach);
    void change(const TraceStep& step, SensorEvent::Change what);
  };
  static constexpr ColliderIndex no_collider = ~ColliderIndex{0};

  void see(Watch& watch, const TraceStep& step) const;
  [[nodiscard]] static Vec2d place_of(const Watch& watch, const TraceStep& step);
  [[nodiscard]] static std::optional<double> first_contact(const Watch& watch, const TraceStep& step);
  [[nodiscard]] double value_of(const Watch& watch) const;
  [[nodiscard]] double off(const Watch& watch) const;
  [[nodiscard]] double allowed(const Answer& answer) const;
  [[nodiscard]] std::string words(const Watch& watch) const;

  std::vector<Watch> watches_;
  /// By how much answers may be off for what the contender is: what it keeps from surfaces, or moves by [m]; none for
  /// octagon_sweep in double.
  double reach_;
  double late_;  ///< By how much it may notice a contact late [steps].
  int steps_ = 0;
};

}  // namespace paperproof::compare
