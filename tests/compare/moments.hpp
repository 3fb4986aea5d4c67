/// Synthetic runs for tests of what is measured: nothing moves but what a test says.
#pragma once

#include "metrics/answers.hpp"
#include "oracle/judge.hpp"
#include "records/row.hpp"
#include "records/trace.hpp"

#include <utility>
#include <vector>

namespace paperproof::compare {

inline TraceHeader header(const char* contender = "mine", std::size_t characters = 1) {
  TraceHeader header;
  header.contender = contender;
  header.scalar = "double";
  header.characters = characters;
  header.dt = 0.5;
  header.ids = {"floor", "paper"};
  header.scenery.colliders.resize(2);
  return header;
}

inline Contact contact(ColliderIndex collider, Side side, double fraction = 0) {
  return {.collider = collider, .fraction = fraction, .side = side};
}
inline ExactContact exact(ColliderIndex collider, Side side) { return {.collider = collider, .side = side}; }

/// A synthetic run: what was reported and what was so.
struct Moment {
  TraceStep step;
  StepJudgement judged;
};

inline Moment moment(int number, std::vector<Contact> contacts = {}, std::vector<ExactContact> truth = {}) {
  Moment moment;
  moment.step.step = number;
  moment.step.path = {{Vec2d(0, 0), 0}, {Vec2d(0, 0), 1}};
  moment.step.contacts = std::move(contacts);
  moment.judged.contacts = std::move(truth);
  return moment;
}

/// The row of a run that is asked for answers.
inline Row answered(const std::vector<Answer>& answers, const std::vector<TraceStep>& run, const TraceHeader& head) {
  AnswerCheck check(answers, head);
  for (const TraceStep& step : run) check.add(step);
  Row row;
  check.write(row);
  return row;
}

}  // namespace paperproof::compare
