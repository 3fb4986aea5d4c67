#include "runs/run_judge.hpp"

#include "contains.hpp"
#include "oracle/turning.hpp"
#include "oracle/up.hpp"
#include "records/verdict.hpp"
#include "runs/run_judge_limits.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {

using namespace run_judge;
namespace {

/// A larger share of the wanted motion that is lost to nothing is a fault of a contender that promises none.
constexpr double most_motion_lost = 0.01;
/// The guarantee covers starts this near to the origin, and displacements up to it [m].
constexpr double guaranteed_range = 1e6;
/// So many impacts a step answers, unless its contender is set otherwise: `SweepDef::iterations`.
constexpr std::size_t impacts_of_step = 12;
/// A character this far outside of its map is put back [m].
constexpr double lost_beyond = 10;

/// Whether it says that it has met two surfaces that face different ways.
bool is_between(const TraceStep& record) {
  return std::ranges::any_of(record.contacts, [&](const Contact& contact) {
    return contact.normal.dot(record.contacts.front().normal) < same_face;
  });
}

/// How many corners its way has that are not where the one before is.
std::size_t places_of(const TraceStep& record) {
  std::size_t places = 1;
  for (std::size_t i = 1; i < record.path.size(); ++i) places += record.path[i].position != record.path[i - 1].position;
  return places;
}

}  // namespace

RunJudge::RunJudge(const TraceHeader& header, const Measured& measured)
    : header_(header), measured_(measured), metrics_(std::in_place, header, measured), judgements_(header.characters) {
  for (std::size_t k = 0; k < header.characters; ++k)
    followers_.push_back({.judge = std::make_unique<Judge>(header_, k > 0 ? followers_[0].judge.get() : nullptr),
                          .intent = Intent(header_)});
  if (header.characters > 1) company_ = std::make_unique<CompanyJudge>(header_);
  const auto is_known = [](const MoverScript& script) { return !script.path.empty(); };
  if (!header_.scripts.empty() && std::ranges::all_of(header_.scripts, is_known))
    ways_.emplace(header_, header_.scripts);
}

void RunJudge::note(Clause clause, const TraceStep& record, const std::string& what) {
  breaches_[clause].add(record.step,
                        [&] { return (company_ ? fmt::format("character {}: ", record.character) : "") + what; });
}

bool RunJudge::is_free(std::span<const Vec2d> positions, std::size_t character) const {
  return !company_ || company_->overlapped(positions, static_cast<CharacterIndex>(character)).empty();
}

/// Whether another character stands elsewhere than the turn before left it, and is or was near. Of one that goes now
/// nobody is asked who stands: see `stands`.
bool RunJudge::is_beside_another(const TraceStep& turn, const Follower& follower) const {
  if (follower.last.empty()) return true;
  const std::vector<MoverMotion>& before = follower.last.back().movers;
  const auto went = [&](ColliderIndex collider) {
    const MoverIndex mover = header_.scenery.colliders[collider].mover;
    return header_.is_body(collider) && turn.movers[mover].from != before[mover].to;
  };
  const auto went_near = [&](const std::vector<MoverMotion>& movers) {
    const std::vector<ColliderIndex> near =
        scenery().near(Place(turn.path.front(), movers), Place(turn.path.back(), movers), beside);
    return std::ranges::any_of(near, went);
  };
  return went_near(turn.movers) || went_near(before);
}

/// What one of them does in its turn is the step of a character alone among movers.
void RunJudge::begin_turns(const TraceStep& record) {
  in_turns_.emplace(header_, record.movers.size());
  of_scene_ = std::move(followers_.front().judge);
  header_ = in_turns_->header();
  metrics_.emplace(header_, measured_);
  for (Follower& follower : followers_)
    follower.judge =
        std::make_unique<Judge>(header_, &follower == &followers_.front() ? nullptr : followers_[0].judge.get());
}

void RunJudge::add(std::span<TraceStep> all) {
  judge_movers(all);
  if (all.front().turn && !in_turns_) begin_turns(all.front());
  std::vector<TraceStep> turns;
  if (in_turns_) turns = in_turns_->turns(all);
  const std::span<TraceStep> records = in_turns_ ? std::span(turns) : all;
  std::vector<TraceStep> asked(records.begin(), records.end());
  std::vector<Vec2d> starts;
  for (const TraceStep& record : records) starts.push_back(record.path.front().position);
  for (std::size_t k = 0; k < records.size(); ++k) {
    TraceStep& record = records[k];
    Follower& follower = followers_[k];
    if (!record.respawn && !follower.last.empty()) record.from.reset();  // it goes on
    judge_course(record, follower);
    // What moves stands where the last step left it: a character that was not put elsewhere begins in what it ended in.
    if (follower.begins) follower.inside = follower.judge->overlapped(record);
    follower.begins = false;
    record.start_overlap = all[k].start_overlap = follower.inside;
    if (in_turns_)
      for (const ColliderIndex collider : scenery().overlapped({record.path.front(), record.movers}))
        if (header_.is_body(collider)) record.start_overlap.push_back(collider);
    if (company_)
      all[k].start_overlap_characters = record.start_overlap_characters =
          company_->overlapped(starts, record.character);
    const auto wall_ahead = [this](const TraceStep& step, double move) {
      return is_wall_ahead(header_, scenery(), {step.path.front(), step.movers}, up_in(step, header_), move);
    };
    const int parts = header_.substeps * parts_of(record.vertex_ways);
    follower.wanted = follower.intent.begin(record, parts, wall_ahead);
    judge_wish(record, follower.wanted, follower);
    asked[k] = record;
    // A character that is given another velocity where it is remembers from which side it came.
    const bool stays =
        !follower.last.empty() && follower.last.back().path.back().position == record.path.front().position;
    asked[k].respawn = record.respawn && !stays;
    if (header_.substeps == 1) {
      asked[k].requested = follower.wanted.displacement;
      asked[k].steered = follower.wanted.steered;
    }
    if (!record.input.drop) asked[k].dropped_through.clear();  // the input did not ask for it
    // Who gives up is between two surfaces, and has met as much as a step answers, or met others, or what turns.
    const bool gives_up = is_between(record) &&
                          (places_of(record) > impacts_of_step || !all[k].met.empty() || is_beside_what_turns(record));
    asked[k].dropped = record.dropped && gives_up;
  }
  for (std::size_t k = 0; k < records.size(); ++k) {
    const bool beside_another = company_ && company_->is_beside_another(asked[k], asked);
    const bool is_alone = in_turns_ ? !is_beside_another(asked[k], followers_[k]) : !beside_another;
    followers_[k].steps_alone = is_alone ? followers_[k].steps_alone + 1 : 0;
    judgements_[k] = followers_[k].judge->judge(asked[k], &followers_[k].wanted, beside_another);
  }
  if (steps_ == 0) note_begin(asked);
  if (company_) company_->judge(in_turns_ ? all : std::span<TraceStep>(asked), judgements_);
  const auto is_far = [](const TraceStep& step) {
    return step.path.front().position.cwiseAbs().maxCoeff() > guaranteed_range ||
           step.requested.cwiseAbs().maxCoeff() > guaranteed_range;
  };
  // What they note is of the step before.
  for (std::size_t k = 0; k < records.size(); ++k) metrics_->add(asked[k], judgements_[k], breaches_, is_far(asked[k]));
  for (std::size_t k = 0; k < records.size(); ++k) {
    Follower& follower = followers_[k];
    if (is_far(asked[k])) {
      steps_far_ += !header_.guarantees.empty();
    } else {
      const SolidsInStep there(header_, scenery(), asked[k]);
      judge_velocity(there, judgements_[k], follower);  // says more than that a bound is broken
      judge_clauses(asked[k], judgements_[k]);
      judge_times(asked[k], judgements_[k], follower.wanted);
      judge_drops(records[k]);
      judge_met(all[k]);
      judge_rest(asked[k], follower);
      judge_standing(asked[k], follower);
      judge_creeping(asked[k], judgements_[k], follower);
      if (!judgements_[k].beside_another) judge_ride(asked[k], follower);
      if (!judgements_[k].beside_another) judge_carrier(there, follower);
    }
    if (in_turns_) leave_bodies_out(judgements_[k]);
    follower.inside = judgements_[k].end_overlap;
    follower.intent.end(records[k]);
    follower.last.push_back(asked[k]);
    if (follower.last.size() > 2) follower.last.erase(follower.last.begin());
    follower.last_wanted = follower.wanted;
  }
  if (in_turns_) judge_carrying(all);
  ++steps_;
  const auto any = [this](const auto& is) { return std::ranges::any_of(judgements_, is); };
  steps_broken_ += any([](const StepJudgement& judged) { return judged.broke(); });
  broke_company_ = broke_company_ || any([](const StepJudgement& judged) { return judged.company.broke(); });
  disagreements_ += any([](const StepJudgement& judged) { return !judged.methods_disagree.empty(); });
  steps_capped_ += std::ranges::any_of(records, [](const TraceStep& record) { return record.capped; });
}

/// Who rides on another character goes as fast as that one does when it ends its step.
void RunJudge::judge_carrying(std::span<const TraceStep> records) {
  for (const TraceStep& record : records) {
    if (!record.ride || !record.ride->character) continue;
    const Vec2d& velocity = records[*record.ride->character].velocity;
    const double off = (record.ride->velocity - velocity).norm();
    if (!(off <= same_speed * (1 + velocity.norm())))
      note(
          Clause::velocity, record,
          fmt::format("says it rides character {} at a velocity that is {:.3g} m/s off", *record.ride->character, off));
  }
}

/// Others ask of what the scene has.
void RunJudge::leave_bodies_out(StepJudgement& judgement) const {
  const auto is_body = [this](ColliderIndex collider) { return header_.is_body(collider); };
  const auto of_body = [&](const auto& touch) { return is_body(touch.first); };
  for (std::vector<ColliderIndex>* found : {&judgement.end_overlap, &judgement.dont_care})
    std::erase_if(*found, is_body);
  for (std::vector<std::pair<ColliderIndex, Side>>* found :
       {&judgement.contact_band, &judgement.deflected, &judgement.ahead, &judgement.ghosts})
    std::erase_if(*found, of_body);
  std::erase_if(judgement.contacts, [&](const ExactContact& contact) { return is_body(contact.collider); });
}

void RunJudge::note_begin(const std::vector<TraceStep>& records) {
  for (const TraceStep& record : records) {
    const std::vector<ColliderIndex>& inside = record.start_overlap;
    if (inside.empty()) continue;
    const std::string who = company_ ? fmt::format("character {}", record.character) : "the run";
    std::string text = fmt::format("{} begins inside `{}`", who, header_.ids[inside.front()]);
    if (inside.size() > 1) text += " and " + counted(inside.size() - 1, "other collider");
    begins_inside_.push_back(text);
  }
}

/// Whether a record may say that it begins elsewhere than the one before ended.
bool RunJudge::may_respawn(const TraceStep& record, const Follower& follower) const {
  if (header_.guarantees.empty()) return true;  // a twin in lockstep is placed before every step
  if (!header_.respawn_box || record.character >= header_.starts.size() || follower.last.empty()) return false;
  const Vec2d& left = follower.last.back().path.back().position;
  return !header_.respawn_box->inflated(lost_beyond).contains({left, left}) &&
         !record.from.value_or(TraceState{}).grounded;
}

/// Whether the step goes on from the one before, along a way that takes the whole step.
void RunJudge::judge_course(const TraceStep& record, Follower& follower) {
  const std::vector<PathPoint>& path = record.path;
  const auto is_start = [&] {
    if (record.character >= header_.starts.size()) return false;
    const TraceStart& start = header_.starts[record.character];
    const TraceState from = record.from.value_or(TraceState{.velocity = start.velocity});
    // A run in float rounds what its scene says.
    const auto is_said = [this](const Vec2d& is, const Vec2d& said) {
      return is == said || (header_.scalar == "float" && is == Vec2d(said.cast<float>().cast<double>()));
    };
    return is_said(path.front().position, start.position) && is_said(from.velocity, start.velocity) && !from.ride &&
           !(from.grounded || from.jumping || from.jump_held || from.jump_pending);
  };
  std::string fault;
  if (path.front().fraction != 0 || path.back().fraction != 1 ||
      !std::ranges::is_sorted(path, {}, &PathPoint::fraction))
    fault = "the fractions of its way do not ascend from 0 to 1";
  if (refused_) {
    fault = "goes on after the step that it refused";
  } else if (follower.last.empty()) {
    if (record.step != 0)
      fault = fmt::format("the run begins with step {}", record.step);
    else if (record.respawn || !is_start())
      fault = "the run begins elsewhere than the scene says";
  } else if (record.step != follower.last.back().step + 1) {
    fault = fmt::format("follows step {}", follower.last.back().step);
  } else if (record.respawn) {
    if (!may_respawn(record, follower) || (!header_.guarantees.empty() && !is_start()))
      fault = "is put elsewhere, and the scene asks for that nowhere";
  } else if (path.front().position != follower.last.back().path.back().position) {
    fault = fmt::format("begins {} from where the step before ended",
                        metres((path.front().position - follower.last.back().path.back().position).norm()));
  }
  for (std::size_t i = 0; i + header_.bodies < record.movers.size() && !follower.last.empty(); ++i)
    if (record.movers[i].from != follower.last.back().movers[i].to)
      fault = "a mover begins elsewhere than where the step before left it";
  follower.begins =
      follower.begins || follower.last.empty() || path.front().position != follower.last.back().path.back().position;
  const bool in_lockstep = header_.mode == "lockstep" && header_.guarantees.empty();
  if (!fault.empty() && !in_lockstep) note(Clause::continuity, record, fault);
}

/// Whether what it says that it was asked is what scene, input and state ask for.
void RunJudge::judge_wish(const TraceStep& record, const Wanted& wanted, const Follower& follower) {
  if (header_.substeps > 1) return;
  const double rounding = follower.intent.rounding(record, wanted);
  if (!(std::abs(record.steered - wanted.steered) <= rounding))
    note(Clause::wanted, record,
         fmt::format("says that {:.9g} m of its motion were steered, and {:.9g} m were", record.steered,
                     wanted.steered));
  else if (!((record.requested - wanted.displacement).norm() <= rounding))
    note(Clause::wanted, record,
         fmt::format("says it was asked to go ({:.9g}, {:.9g}) m, and ({:.9g}, {:.9g}) m was wanted",
                     record.requested.x(), record.requested.y(), wanted.displacement.x(), wanted.displacement.y()));
  const bool jumping = wanted.jumping && !record.grounded;
  if (!header_.guarantees.empty() && wanted.parts == 1 && record.jumping != jumping)
    note(Clause::wanted, record,
         record.jumping ? "says that a jump goes on, and none does" : "says nothing of its jump");
  const bool jumps_later = wanted.parts > 1 && record.jumping && !wanted.jumping;
  if (jumps_later && !(wanted.pending && touches_from_above(record, up_in(record, header_))))
    note(Clause::wanted, record, "says it jumped in a part of the step, and could not");
}

bool RunJudge::is_beside_what_turns(const TraceStep& record) const {
  return !followers_.front().judge->turning().is_alone(record, beside);
}

/// Whether nothing near the character moves.
bool RunJudge::stands(const TraceStep& record) const {
  if (record.respawn || is_beside_what_turns(record)) return false;
  if (std::ranges::none_of(record.movers, moves)) return true;
  const std::vector<ColliderIndex> near =
      scenery().near(Place(record.path.front(), record.movers), Place(record.path.back(), record.movers), beside);
  return std::ranges::none_of(near, [&](ColliderIndex collider) {
    const MoverIndex mover = header_.scenery.colliders[collider].mover;
    return mover != no_mover && moves(record.movers[mover]);
  });
}

/// Whether movers go as the scene says.
void RunJudge::judge_movers(std::span<TraceStep> records) {
  if (!ways_) return;
  const TraceStep& record = records.front();
  const detail::TurningJudge& turning = followers_.front().judge->turning();
  const MoverWayJudgement judged =
      ways_->judge(record, [&](double within) { return turning.near_at_begin(record, within); });
  arc_error_ = std::max(arc_error_, judged.arc_error);
  for (TraceStep& step : records)
    for (VertexWay& way : step.vertex_ways)
      if (const MoverIndex mover = header_.scenery.colliders[way.collider].mover; !header_.scripts[mover].body)
        way.turn = judged.turns[mover];
  if (!judged.broken()) return;
  const char* what = !judged.off_script.empty()   ? "a mover leaves its script"
                     : !judged.out_of_way.empty() ? "what turns leaves its way between two instants"
                     : !judged.coarse.empty()     ? "what turns is turned at once by more than promised"
                     : judged.is_fine             ? "the step goes in more parts than what turns near by needs"
                                                  : "what turns leaves its arc by more than the bound";
  note(Clause::mover_way, record, what);
}

void RunJudge::check_start(const TraceStep& claimed, const TraceStep& judged) {
  if (claimed.start_overlap != judged.start_overlap ||
      claimed.start_overlap_characters != judged.start_overlap_characters)
    note(Clause::start_inside, judged, "says that it begins inside of other things than it does");
}

void RunJudge::add_refused(const TraceStep& record) {
  const Follower& follower = followers_[record.character];
  if (ways_) ways_->pass_over(record);
  refused_ = true;
  TraceStart begin;
  if (record.character < header_.starts.size()) begin = header_.starts[record.character];
  if (!follower.last.empty()) begin = {follower.last.back().path.back().position, follower.last.back().velocity};
  const double dt = length_of(record, header_);
  const CharacterDef& character = header_.character;
  const double fastest = begin.velocity.norm() + character.jump_speed + character.walk_speed +
                         character.acceleration * dt + gravity_in(record, header_).norm() * dt;
  const bool may = !(dt > 0) || !(begin.position.cwiseAbs().maxCoeff() + fastest * dt < range);
  const bool movers_leave = std::ranges::any_of(header_.scripts, [](const MoverScript& script) {
    return std::ranges::any_of(script.path, [](const MoverScript::Waypoint& waypoint) {
      return !(waypoint.at.cwiseAbs().maxCoeff() < range);
    });
  });
  if (!may && !movers_leave) note(Clause::refusal, record, "refuses a step that it can take: " + record.refused);
}

Breaches RunJudge::breaches() const {
  Breaches all = breaches_;
  metrics_->end(all);
  return all;
}

void RunJudge::write(Row& row) const {
  metrics_->write(row);
  const Breaches all = breaches();
  if (contains(header_.turning, true)) row.arc_error_max_m = arc_error_;
  if (!header_.guarantees.empty())
    row.ground_missed = all.contains(Clause::ground_missed) ? all.at(Clause::ground_missed).steps : 0;
  for (const auto& [clause, breach] : all) row.broken[std::string(name_of(clause))] = breach.steps;
  if (steps_far_ > 0) row.exempted[std::string(exemptions()[static_cast<std::size_t>(Exempt::far)].name)] = steps_far_;
  write_faults(row);
  for (const auto& [clause, breach] : all)
    if (contains(header_.guarantees, clause))
      add_fault(row, Axis::safety, Verdict::violates,
                fmt::format("breaks the clause {} on {} (step {}: {})", name_of(clause), counted(breach.steps, "step"),
                            breach.first_step, breach.first));
}

/// Where it falls short, whatever it promises.
void RunJudge::write_faults(Row& row) const {
  const auto on_steps = [&](Axis axis, const std::optional<int>& steps, const std::string& what) {
    if (steps.value_or(0) > 0)
      add_fault(row, axis, Verdict::flagged, fmt::format("{} on {}", what, counted(*steps, "step")));
  };
  on_steps(Axis::safety, row.undecided_steps, "too near to what turns to tell");
  on_steps(Axis::progress, row.dropped_steps, "drops displacement");
  if (disagreements_ > 0)
    add_fault(row, Axis::validity, Verdict::failed,
              fmt::format("the judge's two methods disagree on {}", counted(disagreements_, "step")));
  if (steps_capped_ > 0)
    add_fault(row, Axis::validity, Verdict::flagged,
              fmt::format("{} beyond the way that its maker documents as the most in a step, not scored",
                          counted(steps_capped_, "step")));
  if (!header_.guarantees.empty()) return;  // the rest are clauses
  if (row.first_tunnel)                     // the first passage in words says more than how many there are
    add_fault(row, Axis::safety, Verdict::tunnels, row.first_tunnel->words);
  if (row.steps_ending_inside.value_or(0) > 0 && steps_broken_ > 0)
    add_fault(
        row, Axis::safety, Verdict::flagged,
        fmt::format("ends {} inside {}, up to {:.3g} m deep", counted(*row.steps_ending_inside, "step"),
                    broke_company_ ? "a solid or another character" : "a solid", row.max_penetration_m.value_or(0)));
  on_steps(Axis::safety, row.one_way_violations, "passes a one-way chain against its normal");
  on_steps(Axis::safety, row.crushes_refuted, "a crush with room to give way");
  on_steps(Axis::progress, row.hanging_steps, "hangs");
  on_steps(Axis::progress, row.stuck_refuted, "says it is stuck beside a way out");
  on_steps(Axis::progress, row.ground_refuted, no_ground(header_));
  if (const double share = row.wanted_motion_lost.value_or(0); share > most_motion_lost)
    add_fault(row, Axis::progress, Verdict::flagged,
              fmt::format("loses {:.3g} % of its horizontal motion to nothing", 100 * share));
  if (const auto other = breaches_.find(Clause::wanted); other != breaches_.end())
    on_steps(Axis::validity, other->second.steps, "was asked for another motion than the scene wants");
}

}  // namespace paperproof::compare
