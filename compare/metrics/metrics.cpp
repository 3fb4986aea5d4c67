#include "metrics/metrics.hpp"

#include "contains.hpp"
#include "records/metric.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

void raise(std::optional<double>& maximum, double value) { maximum = std::max(maximum.value_or(value), value); }

void count(std::optional<int>& counter, bool happened) { counter = counter.value_or(0) + (happened ? 1 : 0); }

void write_the_least_quiet(const Rest& rest, Row& row) {
  Row other;
  rest.write(other);
  for (const auto metric : {&Row::rest_peak_to_peak_m, &Row::rest_rms_m, &Row::contact_toggles, &Row::rest_sign_changes,
                            &Row::rest_upper_band})
    if (other.*metric) raise(row.*metric, *(other.*metric));
}

template <class Contacts>
std::vector<std::pair<ColliderIndex, Side>> touches_of(const Contacts& contacts) {
  std::vector<std::pair<ColliderIndex, Side>> touches;
  for (const auto& contact : contacts) touches.emplace_back(contact.collider, contact.side);
  std::ranges::sort(touches);
  touches.erase(std::unique(touches.begin(), touches.end()), touches.end());
  return touches;
}

}  // namespace

Metrics::Metrics(const TraceHeader& header, const Measured& measured)
    : ids_(header.ids),
      dt_(header.dt),
      measured_(measured),
      followers_(header.characters, Follower(header.scenery)),
      energy_(header, measured.gravity),
      events_(header.characters) {
  promises_ = party_of(header) == Party::promising;
  sampled_ = party_of(header) == Party::sampled;
  if (header.characters > 1) sums_.characters = static_cast<int>(header.characters);
  const std::vector<ColliderDef>& colliders = header.scenery.colliders;
  const auto any = [&colliders](auto&& test) { return std::ranges::any_of(colliders, test); };
  has_one_way_ = any([](const ColliderDef& def) { return def.one_way.has_value(); });
  if (any([](const ColliderDef& def) { return def.sensor; })) sums_.sensor_events = sums_.sensor_errors = 0;
  for (std::optional<int>* counter :
       {&sums_.tunnels, &sums_.clipped, &sums_.steps_ending_inside, &sums_.contact_steps, &sums_.hanging_steps,
        &sums_.stuck_steps, &sums_.stuck_refuted, &sums_.ground_refuted, &sums_.dropped_steps}) {
    *counter = 0;
  }
  if (measured_.respawns) sums_.respawns = 0;
  if (contains(header.turning, true)) sums_.undecided_steps = 0;
  if (has_one_way_) sums_.one_way_violations = 0;
  sums_.max_penetration_m = 0;
}

/// Both directions of the match of one step; of sampled paths with its neighbours.
void Metrics::match(const View& view, Matches& matches, Breaches& breaches) const {
  const Moment& now = view.now();
  const auto anywhere = [&](auto&& test) { return test(now) || (sampled_ && std::ranges::any_of(view.around, test)); };
  for (const Touch& touch : now.reported) {
    const bool in_time = contains(now.exact, touch) || contains(now.deflected, touch);
    const bool right = in_time || anywhere([&](const Moment& moment) { return contains(moment.exact, touch); });
    const bool ghost = contains(now.ghosts, touch);
    if (!right && now.held && promises_) {
      ++matches.stuck;
      continue;
    }
    if (!right && now.beside_another) {
      ++matches.by_company;
      continue;
    }
    const bool excused = !right && !ghost && anywhere([&](const Moment& moment) {
      return promises_ ? contains(moment.band, touch) : contains(moment.dont_care, touch.first);
    });
    if (excused) {
      ++(promises_ ? matches.band : matches.reach);
      continue;
    }
    if (!right) note(Clause::contact_invented, now, touch, breaches);
    matches.deflected += !sampled_ && !contains(now.exact, touch) && contains(now.deflected, touch);
    matches.ahead += !sampled_ && contains(now.ahead, touch);
    ++matches.counted;
    matches.right += right;
    matches.late += right && !in_time;
  }
  match_wanted(view, matches, breaches);
}

void Metrics::match_wanted(const View& view, Matches& matches, Breaches& breaches) const {
  const Moment& now = view.now();
  if (now.stuck) {
    matches.stuck += !now.exact.empty();
    return;
  }
  for (const Side side : {Side::top, Side::bottom, Side::left, Side::right}) {
    const auto of_side = [&](const Touch& touch) { return touch.second == side; };
    if (std::ranges::none_of(now.exact, of_side)) continue;
    const auto reports = [&](const Moment& moment) {
      return std::ranges::any_of(moment.reported,
                                 [&](const Touch& touch) { return of_side(touch) && contains(now.exact, touch); });
    };
    const bool in_time = reports(now);
    const bool late = !in_time && sampled_ && std::ranges::any_of(view.around, reports);
    if (!in_time && !late && now.held && promises_) {
      ++matches.stuck;
      continue;
    }
    if (!in_time && !late) note(Clause::contact_missed, now, *std::ranges::find_if(now.exact, of_side), breaches);
    ++matches.wanted;
    matches.found += in_time || late;
  }
}

void Metrics::add_contacts(const TraceStep& step, const StepJudgement& judgement, Breaches& breaches, bool far) {
  followers_[step.character].window.add({.reported = touches_of(step.contacts),
                                         .exact = touches_of(judgement.contacts),
                                         .dont_care = judgement.dont_care,
                                         .ghosts = judgement.ghosts,
                                         .stuck = step.stuck && !(promises_ && judgement.stuck_refuted),
                                         .held = !judgement.crushed.empty() || !step.start_overlap.empty(),
                                         .far = far,
                                         .step = step.step,
                                         .deflected = judgement.deflected,
                                         .ahead = judgement.ahead,
                                         .band = judgement.contact_band,
                                         .beside_another = judgement.beside_another},
                                        [&](const View& view) { match(view, matches_, breaches); });
  for (const Contact& contact : step.contacts) touched_.insert(contact.collider);
  if (!step.contacts.empty()) raise(sums_.max_contact_gap_m, judgement.max_contact_gap);
  if (!step.contacts.empty() || !step.met.empty()) add_first_contact(step, judgement);
}

void Metrics::add_first_contact(const TraceStep& step, const StepJudgement& judgement) {
  const auto with_scenery = std::ranges::min_element(step.contacts, {}, &Contact::fraction);
  const auto with_another = std::ranges::min_element(step.met, {}, &CrowdContact::fraction);
  const bool meets = with_scenery == step.contacts.end() ||
                     (with_another != step.met.end() && with_another->fraction < with_scenery->fraction);
  const double fraction = meets ? with_another->fraction : with_scenery->fraction;
  const bool same_step = sums_.first_contact_step == step.step && fraction < *sums_.first_contact_fraction;
  if (!sums_.first_contact_step || same_step) {
    sums_.first_contact_step = step.step;
    sums_.first_contact_fraction = fraction;
  }
  const bool exact = !meets && std::ranges::find(judgement.contacts, with_scenery->collider, &ExactContact::collider) !=
                                   judgement.contacts.end();
  if (judgement.turning_toi_error) raise(sums_.toi_error_max, *judgement.turning_toi_error);
  if (judgement.first_impact && judgement.first_impact_comparable && exact) {
    raise(sums_.toi_error_max, std::abs(fraction - *judgement.first_impact));
  }
}

void Metrics::add_exact_impact(const TraceStep& step, const StepJudgement& judgement) {
  met_another_ = met_another_ || judgement.beside_another;  // which may come before any other impact
  if (!judgement.first_impact || met_another_) return;
  const bool later = sums_.exact_first_impact_step && (*sums_.exact_first_impact_step != step.step ||
                                                       *judgement.first_impact >= *sums_.exact_first_impact_fraction);
  if (later) return;
  sums_.exact_first_impact_step = step.step;
  sums_.exact_first_impact_fraction = judgement.first_impact;
  // What is within reach of a corner of the way is merged with what is met from there: the earliest is the one.
  const auto with = std::ranges::min_element(judgement.contacts, {}, &ExactContact::fraction);
  sums_.exact_first_impact = with == judgement.contacts.end() ? "" : "`" + ids_[with->collider] + "`";
}

void Metrics::add_passings(const TraceStep& step, const StepJudgement& judgement) {
  const StepJudgement::Company& company = judgement.company;
  count(sums_.tunnels, !judgement.tunnelled.empty() || !company.passed.empty());
  count(sums_.clipped, judgement.clips());
  if (judgement.clips()) raise(sums_.clipped_depth_max_m, judgement.clipped_depth);
  const auto inside_on_its_own = [&judgement](ColliderIndex collider) {
    return !contains(judgement.pressed, collider) && !contains(judgement.rounded, collider) &&
           !contains(judgement.drawn, collider);
  };
  const bool inside = !company.overlap.empty() || std::ranges::any_of(judgement.end_overlap, inside_on_its_own);
  count(sums_.steps_ending_inside, inside);
  if (has_one_way_) count(sums_.one_way_violations, !judgement.one_way_broken.empty());
  raise(sums_.max_penetration_m, judgement.max_penetration);
  if (sums_.first_tunnel) return;
  if (!judgement.passings.empty()) {
    const Passing& passing = judgement.passings.front();
    const std::string& id = ids_[passing.collider];
    sums_.first_tunnel = {
        .step = step.step,
        .collider = id,
        .speed_m_s = passing.speed,
        .thickness_m = passing.thickness,
        .angle_deg = passing.angle,
        .words = fmt::format("step {}: passed `{}` at {:.1f} m/s, {:.3g} m thick at the crossing, {:.0f}° to its face",
                             step.step, id, passing.speed, passing.thickness, passing.angle)};
  } else if (!company.passed.empty()) {
    sums_.first_tunnel = {.step = step.step,
                          .collider = {},
                          .words = fmt::format("step {}: character {} and character {} passed through each other",
                                               step.step, step.character, company.passed.front())};
  }
}

void Metrics::add_events(const TraceStep& step, const StepJudgement& judgement) {
  if (!step.movers.empty()) {
    count(sums_.crushes, !judgement.crushed.empty());
    count(sums_.crushes_refuted, !judgement.crushed_with_room.empty());
    const bool pressed_alone = !judgement.pressed.empty() && judgement.pressed.size() == judgement.end_overlap.size();
    count(sums_.steps_inside_after_crush, pressed_alone);
  }
  if (!sums_.sensor_events) return;
  *sums_.sensor_events += static_cast<int>(judgement.sensor_events.size());
  *sums_.sensor_errors += judgement.sensor_events_missing + judgement.sensor_events_extra;
  const bool matched = static_cast<int>(judgement.sensor_events.size()) > judgement.sensor_events_missing;
  if (matched) raise(sums_.max_sensor_error, judgement.max_sensor_error);
}

void Metrics::add_progress(const TraceStep& step, const StepJudgement& judgement) {
  if (sums_.undecided_steps) count(sums_.undecided_steps, !judgement.undecided.empty());
  count(sums_.hanging_steps, judgement.hangs);
  count(sums_.stuck_steps, step.stuck);
  count(sums_.stuck_refuted, judgement.stuck_refuted);
  count(sums_.ground_refuted, judgement.ground_refuted);
  count(sums_.dropped_steps, step.dropped);
  motion_wanted_ += judgement.motion_wanted;
  motion_lost_ += judgement.motion_lost;
  double length = 0;
  for (std::size_t i = 1; i < step.path.size(); ++i)
    length += (step.path[i].position - step.path[i - 1].position).norm();
  sums_.distance_m = sums_.distance_m.value_or(0) + length;
  if (judgement.normal_error) raise(sums_.normal_error_max_deg, *judgement.normal_error);
}

void Metrics::add_exempted(const StepJudgement& judgement) {
  if (!promises_) count(sums_.rounding, !judgement.rounded.empty() || !judgement.company.rounded.empty());
  const auto exempt = [this](Exempt which, bool happened) {
    if (happened) ++sums_.exempted[std::string(exemptions()[static_cast<std::size_t>(which)].name)];
  };
  exempt(Exempt::clipped, judgement.clips());
  exempt(Exempt::hover, judgement.hovers);
  exempt(Exempt::drawn, !judgement.drawn.empty());
  exempt(Exempt::late_ground, judgement.ground_late);
  exempt(Exempt::company, judgement.excused_crush);
  exempt(Exempt::unsure, judgement.unsure);
  exempt(Exempt::in_parts, judgement.in_parts);
  exempt(Exempt::turning_sensor, judgement.turning_sensor);
}

void Metrics::add(const TraceStep& step, const StepJudgement& judgement, Breaches& breaches, bool far) {
  add_contacts(step, judgement, breaches, far);
  add_exact_impact(step, judgement);
  add_passings(step, judgement);
  add_events(step, judgement);
  const double dt = step.dt.value_or(dt_);
  if (measured_.rest) followers_[step.character].rest.add(step, dt);
  followers_[step.character].smoothness.add(step, dt);
  energy_.add(step, dt);
  events_.add(step);
  count(sums_.contact_steps, !step.contacts.empty() || !step.met.empty());
  if (measured_.respawns) count(sums_.respawns, step.respawn);
  add_progress(step, judgement);
  add_exempted(judgement);
  if (judgement.motion_wanted > 0) raise(sums_.ghost_speed_loss, judgement.ghost_speed_loss);
}

void Metrics::note(Clause clause, const Moment& moment, const Touch& touch, Breaches& breaches) const {
  if (moment.far) return;
  breaches[clause].add(moment.step, [&] {
    const char* what =
        clause == Clause::contact_missed ? "does not report a contact" : "reports a contact that is none";
    const std::string id = touch.first < ids_.size() ? ids_[touch.first] : std::to_string(touch.first);
    return fmt::format("{}: `{}`, {}", what, id, name_of(touch.second));
  });
}

/// Those of the last steps included, which have no neighbours after them.
Metrics::Matches Metrics::all_matches(Breaches& breaches) const {
  Matches matches = matches_;
  for (const Follower& follower : followers_)
    follower.window.last([&](const View& view) { match(view, matches, breaches); });
  return matches;
}

void Metrics::end(Breaches& breaches) const { static_cast<void>(all_matches(breaches)); }

void Metrics::write(Row& row) const {
  take_numbers(sums_, row);
  row.exact_first_impact = sums_.exact_first_impact;
  row.first_tunnel = sums_.first_tunnel;
  row.colliders_touched = static_cast<int>(touched_.size());
  if (motion_wanted_ > 0) row.wanted_motion_lost = motion_lost_ / motion_wanted_;
  energy_.write(row);
  events_.write(row);

  for (const Follower& follower : followers_) {
    write_the_least_quiet(follower.rest, row);
    follower.smoothness.write(row);
  }
  Breaches noted;  // by `end`
  const Matches matches = all_matches(noted);
  if (matches.counted > 0) row.contact_precision = static_cast<double>(matches.right) / matches.counted;
  if (matches.wanted > 0) row.contact_recall = static_cast<double>(matches.found) / matches.wanted;
  if (promises_) row.contact_band = matches.band;
  row.exempted = sums_.exempted;
  for (const auto& [which, often] : {std::pair{Exempt::late_match, matches.late},
                                     {Exempt::reach, matches.reach},
                                     {Exempt::company, matches.by_company},
                                     {Exempt::stuck, matches.stuck},
                                     {Exempt::deflected, matches.deflected},
                                     {Exempt::ahead, matches.ahead}})
    if (often > 0) row.exempted[std::string(exemptions()[static_cast<std::size_t>(which)].name)] += often;
}

}  // namespace paperproof::compare
