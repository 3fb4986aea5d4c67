#include "metrics/answers.hpp"

#include "contains.hpp"
#include "oracle/hanging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace paperproof::compare {
namespace {

using Of = Answer::Of;

const Vec2d& end_of(const TraceStep& step) { return step.path.back().position; }

/// The same by which a contender may hang.
double reach_of_answers(const TraceHeader& header) {
  const double reach = detail::reach_of(header).contact;
  return reach > detail::exact_reach.contact ? reach : 0;
}

bool is_time(Of of) { return of == Of::contact || of == Of::enter || of == Of::leave; }

/// What each answer says, by `Of`. `with` is the id of a collider within quotes and behind a blank, or empty; `any` is
/// " something" then.
constexpr auto sentences = std::to_array<const char*>({
    "stands at {axis} = {number} m {from}{when}",
    "has the speed {number} m/s along {axis} {when}",
    "comes to {number} m along {axis}",
    "drifts by {number} m on{with}",
    "meets{any} after {number} steps",
    "touches{any} on {number} steps",
    "is not grounded on {number} steps",
    "comes to rest after {number} steps",
    "is crushed{by} in step {number}",
    "is crushed by {number} colliders",
    "enters{with} after {number} steps",
    "leaves{with} after {number} steps",
});
static_assert(sentences.size() == static_cast<std::size_t>(Of::leave) + 1);

/// In words, with `number` as its value.
std::string told(const Answer& answer, const std::string& number) {
  const Vec2d& along = answer.along;
  const std::string axis = along == Vec2d(1, 0)   ? "x"
                           : along == Vec2d(0, 1) ? "y"
                                                  : fmt::format("({:g}, {:g})", along.x(), along.y());
  const std::string with = answer.with.empty() ? "" : " `" + answer.with + "`";
  return fmt::format(
      fmt::runtime(sentences.at(static_cast<std::size_t>(answer.of))), fmt::arg("number", number),
      fmt::arg("axis", axis), fmt::arg("with", with), fmt::arg("any", with.empty() ? " something" : with),
      fmt::arg("from", with.empty() ? "" : "from" + with + " "), fmt::arg("by", with.empty() ? "" : " by" + with),
      fmt::arg("when", answer.step == Answer::end ? "at the end" : fmt::format("after step {}", answer.step - 1)));
}

}  // namespace

AnswerCheck::AnswerCheck(const std::vector<Answer>& answers, const TraceHeader& header)
    : reach_(reach_of_answers(header)), late_(header.path_exact ? 0 : 1) {
  const bool follows_law = header.contender == "octagon_sweep";
  for (const Answer& answer : answers) {
    if (answer.by_law && !follows_law) continue;
    if (answer.clearance > 0 && reach_ > answer.clearance) continue;
    Watch watch{.answer = answer};
    if (!answer.with.empty()) {
      const auto found = std::ranges::find(header.ids, answer.with);
      if (found == header.ids.end()) throw std::invalid_argument("no collider has the id `" + answer.with + "`");
      watch.collider = static_cast<ColliderIndex>(found - header.ids.begin());
      watch.mover = header.scenery.colliders[watch.collider].mover;
    }
    watches_.push_back(std::move(watch));
  }
}

/// Where a character ends, relative to the mover that is asked for.
Vec2d AnswerCheck::place_of(const Watch& watch, const TraceStep& step) {
  return watch.mover == no_mover ? end_of(step) : Vec2d(end_of(step) - step.movers[watch.mover].to);
}

std::optional<double> AnswerCheck::first_contact(const Watch& watch, const TraceStep& step) {
  std::optional<double> earliest;
  const auto take = [&earliest](double fraction) { earliest = std::min(earliest.value_or(fraction), fraction); };
  const bool any = watch.collider == no_collider;
  for (const Contact& contact : step.contacts)
    if (any || contact.collider == watch.collider) take(contact.fraction);
  if (any)
    for (const CrowdContact& contact : step.met) take(contact.fraction);
  return earliest;
}

void AnswerCheck::Watch::first(double when) {
  if (seen) return;
  seen = true;
  value = when;
}

void AnswerCheck::Watch::largest(double at) {
  value = seen ? std::max(value, at) : at;
  seen = true;
}

void AnswerCheck::add(const TraceStep& step) {
  steps_ = step.step + 1;
  for (Watch& watch : watches_)
    if (watch.answer.character == Answer::all || watch.answer.character == step.character) see(watch, step);
}

void AnswerCheck::see(Watch& watch, const TraceStep& step) const {
  const Answer& answer = watch.answer;
  const bool always = answer.step == Answer::end;
  const bool until = always || step.step < answer.step;   // the steps asked for are not over
  const bool since = always || step.step >= answer.step;  // they are
  switch (answer.of) {
    case Of::place:
    case Of::speed:
      if (until) watch.value = (answer.of == Of::place ? place_of(watch, step) : step.velocity).dot(answer.along);
      break;
    case Of::farthest:
      for (const PathPoint& corner : step.path) watch.largest(corner.position.dot(answer.along));
      break;
    case Of::drift:
      if (since && !until) watch.largest((place_of(watch, step) - watch.anchor).cwiseAbs().maxCoeff());
      if (until && (!always || !watch.seen)) watch.anchor = place_of(watch, step);
      if (always) watch.largest((place_of(watch, step) - watch.anchor).cwiseAbs().maxCoeff());
      break;
    case Of::contact:
      if (const auto when = first_contact(watch, step)) watch.first(step.step + *when);
      break;
    case Of::contacts:
      if (first_contact(watch, step)) ++watch.value;
      break;
    case Of::in_the_air:
      if (since && !step.grounded) ++watch.value;
      break;
    case Of::settled:
      watch.settle(step, reach_);
      break;
    case Of::crush:
      if (watch.collider == no_collider ? !step.crushed.empty() : contains(step.crushed, watch.collider))
        watch.first(step.step);
      break;
    case Of::crushers:
      watch.named.insert(step.crushed.begin(), step.crushed.end());
      watch.value = static_cast<double>(watch.named.size());
      break;
    case Of::enter:
    case Of::leave:
      watch.change(step, answer.of == Of::enter ? SensorEvent::Change::enter : SensorEvent::Change::exit);
      break;
  }
}

void AnswerCheck::Watch::settle(const TraceStep& step, double reach) {
  if (seen && step.grounded == grounded && (end_of(step) - anchor).norm() <= reach) return;
  seen = true;
  anchor = end_of(step);
  grounded = step.grounded;
  value = step.step + 1;
}

void AnswerCheck::Watch::change(const TraceStep& step, SensorEvent::Change what) {
  for (const SensorEvent& event : step.sensors)
    if (event.change == what && event.sensor == collider) first(step.step + event.fraction);
}

double AnswerCheck::value_of(const Watch& watch) const {
  const Of of = watch.answer.of;
  const bool may_never_come = is_time(of) || of == Of::crush;
  return may_never_come && !watch.seen ? steps_ : watch.value;
}

double AnswerCheck::off(const Watch& watch) const {
  const double value = value_of(watch);
  const double error = std::max({0.0, watch.answer.at_least - value, value - watch.answer.at_most});
  return std::isnan(value) ? std::numeric_limits<double>::infinity() : error;
}

double AnswerCheck::allowed(const Answer& answer) const {
  return answer.tolerance + reach_ * answer.per_metre + (is_time(answer.of) ? late_ : 0);
}

std::string AnswerCheck::words(const Watch& watch) const {
  const Answer& answer = watch.answer;
  const auto number = [](double value) { return fmt::format("{:.9g}", value); };
  std::string wanted = number(answer.at_least);
  if (!std::isfinite(answer.at_least))
    wanted = "at most " + number(answer.at_most);
  else if (!std::isfinite(answer.at_most))
    wanted = "at least " + wanted;
  else if (answer.at_most > answer.at_least)
    wanted += " to " + number(answer.at_most);
  return told(answer, number(value_of(watch))) + " instead of " + wanted;
}

void AnswerCheck::ask_no_contacts() {
  std::erase_if(watches_,
                [](const Watch& watch) { return watch.answer.of == Of::contact || watch.answer.of == Of::contacts; });
}

void AnswerCheck::write(Row& row) const {
  if (watches_.empty()) return;
  const Watch* worst = nullptr;
  double most = -1;
  for (const Watch& watch : watches_) {
    const double error = off(watch);
    const double many = error > 0 ? error / allowed(watch.answer) : 0;  // nothing allowed: infinitely many
    if (many > most) {
      most = many;
      worst = &watch;
    }
  }
  row.answer_error = off(*worst);
  row.answer_ok = most <= 1;
  if (!*row.answer_ok) row.answer = words(*worst);
}

}  // namespace paperproof::compare
