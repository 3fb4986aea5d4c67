#include "runs/run_judge.hpp"

#include "contains.hpp"
#include "oracle/claims.hpp"
#include "oracle/contact_place.hpp"
#include "oracle/contacts.hpp"
#include "oracle/legs.hpp"
#include "oracle/response_laws.hpp"
#include "oracle/turning.hpp"
#include "oracle/up.hpp"
#include "records/verdict.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::compare {
namespace {

/// The largest gap that is allowed at a contact, and how far a time of impact may be off along the normal [m].
constexpr double guaranteed_gap = 1e-6;
/// Normals are computed from rounded vertices [degrees].
constexpr double rounding_of_normal = 1e-3;
constexpr double rounding_of_unit = 1e-6;
/// Cosine of the angle between two normals of one face that is round.
constexpr double same_face = 0.9;
/// A larger share of the wanted motion that is lost to nothing is a fault of a contender that promises none.
constexpr double most_motion_lost = 0.01;
/// The guarantee covers starts this near to the origin, and displacements up to it [m].
constexpr double guaranteed_range = 1e6;
/// Positions and offsets beyond are refused [m].
constexpr double range = 2e6;
/// What turns and touches has one velocity to within this [m/s].
constexpr double hardly_turns = 1e-3;
/// So many impacts a step answers, unless its contender is set otherwise: `SweepDef::iterations`.
constexpr std::size_t impacts_of_step = 12;
/// Who is no faster stands still [m/s].
constexpr double standstill = 1e-6;
/// Who goes no farther in a step may creep [m].
constexpr double most_crept = 1e-3;
/// Its gap is restored once, and it settles on ground that hardly bends [m].
constexpr double most_drift = 5e-6;
/// Over uneven ground so much of its way is made by the gaps that it keeps.
constexpr double share_of_way = 0.01;
/// What moves farther away than this does not reach a character at rest in the step [m].
constexpr double beside = 0.01;
/// Relative: two computations of a velocity.
constexpr double same_speed = 1e-9;
/// A character this far outside of its map is put back [m].
constexpr double lost_beyond = 10;

/// Whether a contact's point is in the character's box at some corner of the way, and no farther from it than it says.
bool is_point_of(const TraceStep& record, const Contact& contact, std::span<const Vec2d> points) {
  constexpr double near = 1e-5;
  const Box2 box = Box2::around(points).inflated(near);
  const auto is_there = [&](const PathPoint& at) {
    const Vec2d point = contact.point - at.position;
    return box.contains({point, point});
  };
  return std::abs(contact.separation) <= near && std::any_of(record.path.begin(), record.path.end(), is_there);
}

/// Whether it says that it has met two surfaces that face different ways.
bool is_between(const TraceStep& record) {
  return std::any_of(record.contacts.begin(), record.contacts.end(), [&](const Contact& contact) {
    return contact.normal.dot(record.contacts.front().normal) < same_face;
  });
}

/// How many corners its way has that are not where the one before is.
std::size_t places_of(const TraceStep& record) {
  std::size_t places = 1;
  for (std::size_t i = 1; i < record.path.size(); ++i) places += record.path[i].position != record.path[i - 1].position;
  return places;
}

/// Whether a face of what a contact is with has its normal, or nearly so.
bool has_face(std::span<const NearPart> parts, const Contact& contact) {
  return std::any_of(parts.begin(), parts.end(), [&](const NearPart& part) {
    return part.collider == contact.collider &&
           std::any_of(part.faces.begin(), part.faces.end(),
                       [&](const NearFace& face) { return face.normal.dot(contact.normal) > same_face; });
  });
}

bool moves(const MoverMotion& motion) { return motion.from != motion.to; }

std::string metres(double length) { return fmt::format("{:.3g} m", length); }

}  // namespace

RunJudge::RunJudge(const TraceHeader& header, const Measured& measured)
    : header_(header), measured_(measured), metrics_(std::in_place, header, measured), judgements_(header.characters) {
  for (std::size_t k = 0; k < header.characters; ++k)
    followers_.push_back({.judge = std::make_unique<Judge>(header_, k > 0 ? followers_[0].judge.get() : nullptr),
                          .intent = Intent(header_)});
  if (header.characters > 1) company_ = std::make_unique<CompanyJudge>(header_);
  const auto is_known = [](const MoverScript& script) { return !script.path.empty(); };
  if (!header_.scripts.empty() && std::all_of(header_.scripts.begin(), header_.scripts.end(), is_known))
    ways_.emplace(header_, header_.scripts);
}

void RunJudge::note(Clause clause, const TraceStep& record, const std::string& what) {
  breaches_[clause].add(record.step,
                        [&] { return (company_ ? fmt::format("character {}: ", record.character) : "") + what; });
}

bool RunJudge::is_free(std::span<const Vec2d> positions, std::size_t character) const {
  return !company_ || company_->overlapped(positions, static_cast<CharacterIndex>(character)).empty();
}

/// Whether another character is near that goes in its turn, or went since the one before.
bool RunJudge::is_beside_another(const TraceStep& turn, const Follower& follower) const {
  const std::vector<ColliderIndex> near =
      scenery().near(Place(turn.path.front(), turn.movers), Place(turn.path.back(), turn.movers), beside);
  return std::any_of(near.begin(), near.end(), [&](ColliderIndex collider) {
    const MoverIndex mover = header_.scenery.colliders[collider].mover;
    return header_.is_body(collider) && (moves(turn.movers[mover]) || follower.last.empty() ||
                                         turn.movers[mover].from != follower.last.back().movers[mover].to);
  });
}

bool RunJudge::is_wall_ahead(const TraceStep& record, double move) const {
  const Vec2d up = up_in(record, header_);
  const Vec2d there = right_of(up) * std::copysign(header_.character.wall_reach, move);
  for (const ExactImpact& impact : scenery().impacts({record.path.front(), record.movers}, there))
    if (side_of_normal(impact.normal.dot(right_of(up)), impact.normal.dot(up)) == (move < 0 ? Side::left : Side::right))
      return true;
  return false;
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
    const auto wall_ahead = [this](const TraceStep& step, double move) { return is_wall_ahead(step, move); };
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
    follower.last_wanted.push_back(follower.wanted);
    if (follower.last.size() > 2) {
      follower.last.erase(follower.last.begin());
      follower.last_wanted.erase(follower.last_wanted.begin());
    }
  }
  if (in_turns_) judge_carrying(all);
  ++steps_;
  const auto any = [this](const auto& is) { return std::any_of(judgements_.begin(), judgements_.end(), is); };
  steps_broken_ += any([](const StepJudgement& judged) { return judged.broke(); });
  broke_company_ = broke_company_ || any([](const StepJudgement& judged) { return judged.company.broke(); });
  disagreements_ += any([](const StepJudgement& judged) { return !judged.methods_disagree.empty(); });
  steps_capped_ += std::any_of(records.begin(), records.end(), [](const TraceStep& record) { return record.capped; });
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
  for (std::vector<ColliderIndex>* found : {&judgement.end_overlap, &judgement.dont_care, &judgement.contact_band})
    std::erase_if(*found, is_body);
  for (std::vector<std::pair<ColliderIndex, Side>>* found : {&judgement.deflected, &judgement.ahead, &judgement.ghosts})
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
      !std::is_sorted(path.begin(), path.end(), [](const auto& a, const auto& b) { return a.fraction < b.fraction; }))
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
  if (std::none_of(record.movers.begin(), record.movers.end(), moves)) return true;
  const std::vector<ColliderIndex> near =
      scenery().near(Place(record.path.front(), record.movers), Place(record.path.back(), record.movers), beside);
  return std::none_of(near.begin(), near.end(), [&](ColliderIndex collider) {
    const MoverIndex mover = header_.scenery.colliders[collider].mover;
    return mover != no_mover && moves(record.movers[mover]);
  });
}

/// Once position and velocity have repeated, and the same is wanted again, nothing may change any more.
void RunJudge::judge_rest(const TraceStep& record, const Follower& follower) {
  if (follower.last.size() < 2 || record.respawn) return;
  const TraceStep& before = follower.last[1];
  const TraceStep& earlier = follower.last[0];
  const auto same = [](const TraceStep& a, const TraceStep& b) {
    return a.path.back().position == b.path.back().position && a.velocity == b.velocity && a.grounded == b.grounded;
  };
  const auto is_asked_alike = [this](const TraceStep& a, const TraceStep& b) {
    return length_of(a, header_) == length_of(b, header_) && up_in(a, header_) == up_in(b, header_);
  };
  const bool repeated =
      same(before, earlier) && stands(earlier) && stands(before) && stands(record) && follower.steps_alone > 2 &&
      follower.last_wanted[1].displacement == follower.wanted.displacement &&
      follower.last_wanted[1].steered == follower.wanted.steered && before.input.drop == record.input.drop &&
      is_asked_alike(earlier, before) && is_asked_alike(before, record);
  if (repeated && !same(record, before))
    note(Clause::rest, record,
         fmt::format("changes after position and velocity had repeated: goes {}, ends with ({:.3g}, {:.3g}) m/s, {}",
                     metres((record.path.back().position - before.path.back().position).norm()), record.velocity.x(),
                     record.velocity.y(), record.grounded ? "and stands" : "and does not stand"));
}

/// Who says that it stands still, and wants nothing but to fall, stays where it began to.
void RunJudge::judge_standing(const TraceStep& record, Follower& follower) {
  const Wanted& wanted = follower.wanted;
  const Vec2d up = up_in(record, header_);
  const double across = (wanted.displacement - wanted.displacement.dot(up) * up).norm() / length_of(record, header_);
  const bool as_before =
      follower.last.empty() || (up_in(follower.last.back(), header_) == up &&
                                gravity_in(follower.last.back(), header_) == gravity_in(record, header_));
  const bool stays = record.grounded && record.velocity.norm() <= standstill && across <= standstill &&
                     !wanted.jumped && !wanted.ridden && stands(record) && as_before && follower.steps_alone > 0 &&
                     record.start_overlap.empty() && !header_.guarantees.empty();
  const Vec2d& end = record.path.back().position;
  // What goes farther at once is asked for its velocity.
  const bool creeps = (end - record.path.front().position).norm() <= most_crept;
  if (!stays || !creeps) {
    follower.stood_at.reset();
  } else if (!follower.stood_at) {
    follower.stood_at = end;
  } else if (const double drift = (end - *follower.stood_at).norm(); drift > most_drift + 4 * ulp_at(header_, end)) {
    note(Clause::rest, record, fmt::format("has drifted by {} since it stands still", metres(drift)));
  }
}

/// Gaps are restored and seams followed once each: over many steps that leads nowhere. A hundredth of the way may be
/// made so, on uneven ground.
void RunJudge::judge_creeping(const TraceStep& record, const StepJudgement& judged, Follower& follower) {
  if (record.respawn) follower.crept.setZero();
  follower.crept += judged.crept;
  const double crept = follower.crept.norm();
  if (crept > 2 * most_drift) {
    note(Clause::velocity, record, fmt::format("has crept {} that no velocity made", metres(crept)));
    follower.crept.setZero();
  }
  const double way = (record.path.back().position - record.path.front().position).norm();
  if (crept > 0) follower.crept *= std::max(0.0, 1 - share_of_way * way / crept);
}

/// Whether it says that its ground moves, and has touched nothing that does since it said otherwise.
bool RunJudge::is_ground_velocity_invented(const TraceStep& record, const Follower& follower) const {
  const bool is_kept =
      !follower.last.empty() && !record.grounded && follower.last.back().ground_velocity == record.ground_velocity;
  if (record.ground_velocity.isZero(0) || is_kept || record.respawn || is_beside_what_turns(record)) return false;
  return std::none_of(record.path.begin(), record.path.end(), [&](const PathPoint& at) {
    const std::vector<NearPart> parts = scenery().near_parts(Place(at, record.movers), guaranteed_gap);
    return std::any_of(parts.begin(), parts.end(), [this](const NearPart& part) { return moves_or_conveys(part); });
  });
}

bool RunJudge::moves_or_conveys(const NearPart& part) const {
  return !part.moved.isZero(0) || header_.scenery.colliders[part.collider].surface_speed != 0;
}

/// Whether the step goes on ground that moves or conveys, and on no other, all along, and is held there by gravity.
bool RunJudge::is_carried_unsaid(const TraceStep& record, const Follower& follower) const {
  const bool goes_on = !follower.last.empty() && !record.respawn && !record.from && follower.last.back().grounded;
  const bool plain = record.grounded && record.start_overlap.empty() && record.crushed.empty() && !record.stuck &&
                     !record.dropped && record.dropped_through.empty() && !follower.wanted.jumped &&
                     !is_beside_what_turns(record) && header_.substeps == 1;
  if (!goes_on || !plain) return false;
  const Vec2d up = up_in(record, header_);
  if (!(gravity_in(record, header_).dot(up) < 0)) return false;
  const auto stands_on_what_moves = [&](const PathPoint& at) {
    bool stands = false;
    for (const NearPart& part : scenery().near_parts(Place(at, record.movers), guaranteed_gap))
      for (const NearFace& face : part.faces) {
        if (!(face.normal.dot(up) > 0)) continue;
        if (!moves_or_conveys(part)) return false;
        stands = stands || is_walked_on(face.normal, header_, up);
      }
    return stands;
  };
  return std::all_of(record.path.begin(), record.path.end(), stands_on_what_moves);
}

/// What it says that it rides is there, and goes as it says.
void RunJudge::judge_carrier(const SolidsInStep& there, const Follower& follower) {
  const TraceStep& record = there.step();
  if (header_.guarantees.empty()) return;
  if (is_ground_velocity_invented(record, follower))
    note(Clause::wanted, record, "says that its ground moves, and none does");
  if (!record.ride) {
    if (is_carried_unsaid(record, follower))
      note(Clause::ground_missed, record, "stands on what moves all along, and says no ride");
    return;
  }
  const ColliderIndex carrier = record.ride->collider;
  const Place end(record.path.back(), record.movers);
  const Vec2d up = up_in(record, header_);
  double off = std::numeric_limits<double>::infinity();
  for (const NearPart& part : there.at(1).near_parts(end, guaranteed_gap))
    for (const NearFace& face : part.faces) {
      if (part.collider != carrier || !(face.normal.dot(up) > 0)) continue;
      const Vec2d foot =
          *std::min_element(header_.points.begin(), header_.points.end(),
                            [&](const Vec2d& a, const Vec2d& b) { return a.dot(face.normal) < b.dot(face.normal); });
      for (const SolidsInStep::Carrying& by :
           there.carrying(carrier, end.position + foot, detail::extent_of(header_.points))) {
        const Vec2d velocity = by.velocity + conveyed(header_.scenery.colliders[carrier], face.normal);
        const Vec2d other = seen(record.ride->velocity - velocity, face.normal);
        off = std::min(off, std::max(std::abs(other.x()) - by.along, std::abs(other.y()) - by.across) -
                                (same_speed + detail::waited_in_part) * (1 + velocity.norm()));
      }
    }
  if (off == std::numeric_limits<double>::infinity())
    note(Clause::ground_invented, record, "says it rides `" + header_.ids[carrier] + "`, which is not there");
  else if (off > 0)
    note(Clause::velocity, record,
         fmt::format("says it rides `{}` at a velocity that is {:.3g} m/s off", header_.ids[carrier], off));
}

/// A rider that goes nowhere on its mover keeps its place there.
void RunJudge::judge_ride(const TraceStep& record, const Follower& follower) {
  if (follower.last.empty() || record.respawn || !record.ride || !record.vertex_ways.empty()) return;
  const std::optional<TraceRide>& before = follower.last.back().ride;
  const ColliderDef& ground = header_.scenery.colliders[record.ride->collider];
  if (!before || before->collider != record.ride->collider || ground.mover == no_mover || ground.surface_speed != 0)
    return;
  const MoverMotion& motion = record.movers[ground.mover];
  const Vec2d up = up_in(record, header_);
  const Vec2d own = follower.wanted.displacement - (motion.to - motion.from);
  const bool stays = std::abs(own.dot(right_of(up))) == 0 && own.dot(up) <= 0 &&
                     std::all_of(record.contacts.begin(), record.contacts.end(),
                                 [&](const Contact& contact) { return contact.collider == record.ride->collider; });
  if (!stays || follower.last.size() < 2) return;
  const std::optional<TraceRide>& earlier = follower.last[0].ride;
  if (!earlier || earlier->collider != before->collider) return;
  const Vec2d drift = (record.path.back().position - motion.to) - (record.path.front().position - motion.from);
  const double ulps = ulp_at(header_, record.path.back().position) + ulp_at(header_, record.path.front().position) +
                      ulp_at(header_, motion.to) + ulp_at(header_, motion.from);
  if (drift.cwiseAbs().maxCoeff() > ulps && drift.norm() < guaranteed_gap)
    note(Clause::rest, record, fmt::format("drifts {} on what carries it", metres(drift.norm())));
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

/// Whether a contact was met when it says so: the first one where the exact motion meets it, and each where the way
/// comes to it.
void RunJudge::judge_times(const TraceStep& record, const StepJudgement& judged, const Wanted& wanted) {
  if (judged.beside_another || record.contacts.empty() || !record.start_overlap.empty()) return;
  const auto check = [&](const Contact& contact, double off, double allowed) {
    if (off > allowed && off < std::numeric_limits<double>::infinity())
      note(Clause::time_of_impact, record,
           fmt::format("says it met `{}` at {:.6g} of the step, and that is {} off along the normal",
                       header_.ids[contact.collider], contact.fraction, metres(off)));
  };
  if (judged.first_impact && judged.first_approach) {
    const auto first = std::min_element(record.contacts.begin(), record.contacts.end(),
                                        [](const auto& a, const auto& b) { return a.fraction < b.fraction; });
    const bool is_exact = std::any_of(judged.contacts.begin(), judged.contacts.end(), [&](const ExactContact& exact) {
      return exact.collider == first->collider && exact.side == first->side && exact.foreseen;
    });
    // It stops up to 7e-7 m before the impact, and the exact fraction counts from there on.
    if (is_exact)
      check(*first, std::abs(first->fraction - *judged.first_impact) * *judged.first_approach, guaranteed_gap);
  }
  const detail::TurningJudge& turning = followers_.front().judge->turning();
  const bool meets_turning = std::any_of(record.contacts.begin(), record.contacts.end(),
                                         [&](const auto& contact) { return turning.turns(contact.collider); });
  const bool in_parts = parts_of(record.vertex_ways) > 1;
  for (const Contact& contact : record.contacts) {
    if (in_parts || !turning.turns(contact.collider) || !judged.end_overlap.empty()) continue;
    std::vector<PathPoint> then{{place_at(record.path, contact.fraction), contact.fraction}};
    std::copy_if(record.path.begin(), record.path.end(), std::back_inserter(then),
                 [&](const PathPoint& corner) { return corner.fraction == contact.fraction; });
    const bool is_there = std::any_of(then.begin(), then.end(), [&](const PathPoint& at) {
      return has_face(turning.near(record, at, 3 * guaranteed_gap), contact);
    });
    if (!is_there)
      note(Clause::time_of_impact, record,
           fmt::format("says it met `{}` at {:.6g} of the step, and was not there", header_.ids[contact.collider],
                       contact.fraction));
  }
  if (in_parts || meets_turning || !record.crushed.empty() || !judged.end_overlap.empty()) return;
  for (const Contact& contact : record.contacts) {
    const MoverIndex mover = header_.scenery.colliders[contact.collider].mover;
    const Vec2d carried =
        mover != no_mover ? Vec2d(record.movers[mover].to - record.movers[mover].from) : Vec2d::Zero();
    // Of one collider that is the first contact: a later one is another face, and is met where the way comes to it.
    const auto is_of_it = [&](const Contact& one) { return one.collider == contact.collider; };
    const Contact& first = *std::find_if(record.contacts.begin(), record.contacts.end(), is_of_it);
    const auto is_there = [&](const PathPoint& corner) {
      const Place at(corner, record.movers);
      if (&first == &contact) return scenery().separation(at, contact.collider) <= guaranteed_gap;
      return has_face(scenery().near_parts(at, guaranteed_gap), contact);
    };
    if (carried != Vec2d::Zero() && is_there(record.path.front()) && &first == &contact) {
      // It gives way from the start, and meets no later than what was requested touches. What begins at rest on its
      // ground may go with it from the start, and meets it by its own motion then.
      const Place start(record.path.front(), record.movers);
      const auto late = [&](const Vec2d& way) {
        const double approach = (carried - way).dot(contact.normal);
        const auto touch = scenery().time_of_impact(start, way, contact.collider);
        const bool at_once = touch && touch->normal.dot(contact.normal) > same_face &&
                             static_cast<double>(touch->fraction) * approach <= guaranteed_gap;
        return at_once && approach > 0 ? (contact.fraction - static_cast<double>(touch->fraction)) * approach : 0;
      };
      const Vec2d up = up_in(record, header_);
      const bool rests = wanted.carried.isZero(0) && right_of(up).dot(record.requested) == 0 &&
                         up.dot(record.requested) <= 0 && detail::is_walkable(contact.normal, header_, up);
      const double off = late(record.requested);
      check(contact, rests ? std::min(off, late(record.requested + carried)) : off, 2 * guaranteed_gap);
      continue;
    }
    // As far along the normal as it is off the time at which the way touches, at the pace of the leg that leads there.
    double off = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < record.path.size(); ++i) {
      const PathPoint& corner = record.path[i];
      if (!is_there(corner)) continue;
      if (contact.fraction == corner.fraction) off = 0;  // it was there, however it came
      const bool waited = i == 0 || !(record.path[i - 1].fraction < corner.fraction);
      const PathPoint& begin = waited ? corner : record.path[i - 1];
      const Vec2d pace =
          waited ? record.requested : Vec2d((corner.position - begin.position) / (corner.fraction - begin.fraction));
      const double approach = (carried - pace).dot(contact.normal);
      if (approach > same_speed * (carried - pace).norm())
        off = std::min(off, std::abs(contact.fraction - corner.fraction) * approach);
      // A motion that grazes stops long before it touches; what it would touch is of one direction with what it
      // reports.
      const Place far(begin.position + pace * (1 - begin.fraction), record.movers, 1);
      const auto touch = scenery().impact_between(Place(begin, record.movers), far, contact.collider);
      if (!touch || !(touch->normal.dot(contact.normal) > same_face)) continue;
      const double when = begin.fraction + static_cast<double>(touch->fraction) * (1 - begin.fraction);
      off = std::min(off, std::abs(contact.fraction - when) * std::abs((carried - pace).dot(touch->normal)));
    }
    check(contact, off, 2 * guaranteed_gap);
  }
}

/// What it says that it dropped through is one-way, was asked for, and was passed, or stood upon where a leg begins: by
/// the octagon itself or, as rounding may name a chain whose tip is grazed, by one a little to its side.
void RunJudge::judge_drops(const TraceStep& record) {
  for (const Contact& contact : record.contacts)
    if (record.input.drop && header_.scenery.colliders[contact.collider].one_way)
      note(Clause::contact_invented, record,
           "reports a contact with `" + header_.ids[contact.collider] + "`, which blocks nobody who drops");
  constexpr double aside = 1e-5;
  for (const ColliderIndex chain : record.dropped_through) {
    const std::optional<Vec2d>& one_way = header_.scenery.colliders[chain].one_way;
    const detail::TurningJudge& turning = followers_.front().judge->turning();
    // How it passes one that turns is not judged.
    const double within = beside + record.requested.norm() + turning.longest_way(record);
    bool passes = one_way && turning.turns(chain) && contains(turning.near_at_begin(record, within), chain);
    for (std::size_t i = 1; i < record.path.size() && one_way && !passes; ++i)
      for (const double shift : {0.0, aside, -aside}) {
        Place from(record.path[i - 1], record.movers);
        Place to(record.path[i], record.movers);
        for (Place* place : {&from, &to}) place->position += shift * Vec2d(one_way->y(), -one_way->x());
        Place below = from;
        below.position -= guaranteed_gap * *one_way;
        passes = passes || scenery().meets(from, to, chain) || scenery().meets(from, below, chain);
      }
    if (!record.input.drop || !passes)
      note(Clause::one_way, record, "says it dropped through `" + header_.ids[chain] + "`, and did not");
  }
}

/// A character meets others, and not itself. In turns its contact with their bodies is judged: see `InTurns`.
void RunJudge::judge_met(const TraceStep& record) {
  for (const CrowdContact& met : record.met)
    if (met.other >= followers_.size() || met.other == record.character)
      note(Clause::contact_invented, record, fmt::format("met character {}, which is no other one", met.other));
}

void RunJudge::check_start(const TraceStep& claimed, const TraceStep& judged) {
  if (claimed.start_overlap != judged.start_overlap ||
      claimed.start_overlap_characters != judged.start_overlap_characters)
    note(Clause::start_inside, judged, "says that it begins inside of other things than it does");
}

void RunJudge::judge_clauses(const TraceStep& record, const StepJudgement& judged) {
  const auto name = [&](const std::vector<ColliderIndex>& colliders) {
    return colliders.empty() ? std::string("another character") : "`" + header_.ids[colliders.front()] + "`";
  };
  const auto check = [&](Clause clause, bool broken, const auto& words) {
    if (broken) note(clause, record, words());
  };
  check(Clause::overlap, !judged.entered.empty() || !judged.company.entered.empty(),
        [&] { return "ends inside " + name(judged.entered); });
  check(Clause::passage, !judged.tunnelled.empty() || !judged.company.passed.empty(),
        [&] { return "passes through " + name(judged.tunnelled); });
  check(Clause::one_way, !judged.one_way_broken.empty(),
        [&] { return "passes " + name(judged.one_way_broken) + " against its normal"; });
  check(Clause::gap, judged.max_contact_gap > guaranteed_gap,
        [&] { return "a contact is " + metres(judged.max_contact_gap) + " away"; });
  check(Clause::normal, judged.normal_error.value_or(0) > rounding_of_normal,
        [&] { return fmt::format("a normal is {:.3g} degrees off", *judged.normal_error); });
  check(Clause::normal,
        std::any_of(record.contacts.begin(), record.contacts.end(),
                    [](const Contact& contact) { return std::abs(contact.normal.norm() - 1) > rounding_of_unit; }),
        [] { return std::string("a normal is no unit vector"); });
  check(Clause::sensor, judged.sensor_events_missing > 0 || judged.sensor_events_extra > 0, [&] {
    return std::string(judged.sensor_events_missing > 0 ? "a sensor's event is missing"
                                                        : "reports a sensor's event that was none");
  });
  check(Clause::sensor, judged.max_sensor_way > guaranteed_gap,
        [&] { return fmt::format("a sensor's event is {:.3g} of the step off", judged.max_sensor_error); });
  check(Clause::sensor,
        !std::is_sorted(record.sensors.begin(), record.sensors.end(),
                        [](const auto& a, const auto& b) { return a.fraction < b.fraction; }),
        [] { return std::string("the events of sensors are not in order of time"); });
  check(Clause::start_inside, judged.stuck_refuted, [] { return std::string("says it is stuck beside a way out"); });
  check(Clause::start_inside, judged.start_mishandled,
        [] { return std::string("begins inside, and neither leaves by the shortest way out nor stays and says so"); });
  check(Clause::velocity, !(judged.way_gained <= 0),
        [&] { return "goes " + metres(judged.way_gained) + " more or less than the law allows"; });
  check(Clause::velocity, !(judged.leg_error <= 0),
        [&] { return "goes another way than the law makes, by " + metres(judged.leg_error); });
  check(Clause::velocity, !(judged.end_error <= 0),
        [&] { return "goes another way than its velocity at the end says, by " + metres(judged.end_error); });
  check(Clause::velocity, !(judged.speed_gained <= 0),
        [&] { return fmt::format("is {:.3g} m/s faster or slower than the law allows", judged.speed_gained); });
  check(Clause::hanging, judged.hangs, [] { return std::string("hangs in the air"); });
  check(Clause::speed_lost, judged.motion_lost > 0,
        [&] { return "loses " + metres(judged.motion_lost) + " of its horizontal way to nothing"; });
  check(Clause::speed_lost, judged.motion_lost == 0 && (judged.speed_lost > 0 || judged.ghost_speed_loss > 0), [&] {
    return judged.speed_lost > 0
               ? fmt::format("loses {:.3g} m/s to nothing", judged.speed_lost)
               : fmt::format("loses {:.3g} % of its horizontal speed to nothing", 100 * judged.ghost_speed_loss);
  });
  check(Clause::ground_invented, judged.ground_refuted,
        [] { return std::string("says it is grounded with nothing under it"); });
  check(Clause::ground_missed, judged.ground_missed,
        [] { return std::string("stands on ground, and says it does not"); });
  check(Clause::ground_missed, judged.ground_left,
        [] { return std::string("leaves ground that `snap` has it follow"); });
  check(Clause::speed_lost, judged.kerb_missed,
        [] { return std::string("is stopped by what `step_height` has it climb"); });
  check(Clause::crush, !judged.crushed_with_room.empty(),
        [&] { return "is crushed by " + name(judged.crushed_with_room) + " with room to give way"; });
  check(Clause::refusal, record.path.back().position.cwiseAbs().maxCoeff() > range || !(length_of(record, header_) > 0),
        [] { return std::string("takes a step that must be refused"); });
  judge_places(record, judged);
}

/// Where each contact says that it is; and of several that the motion meets first, at one time, each is reported.
void RunJudge::judge_places(const TraceStep& record, const StepJudgement& judged) {
  const bool excused = !record.start_overlap.empty() || !judged.end_overlap.empty() || record.stuck ||
                       !record.crushed.empty() || record.contacts.empty() || header_.guarantees.empty();
  if (excused) return;
  const detail::TurningJudge& turning = followers_.front().judge->turning();
  for (const Contact& contact : record.contacts) {
    if (detail::side_along(contact.normal, up_in(record, header_)) != contact.side)
      note(Clause::normal, record,
           "has a contact with `" + header_.ids[contact.collider] + "` on another side than its normal says");
    if (turning.turns(contact.collider)) {
      if (!is_point_of(record, contact, header_.points))
        note(Clause::contact_invented, record,
             "has a contact with `" + header_.ids[contact.collider] + "` in a point that it does not come to");
      continue;
    }
    if (header_.is_body(contact.collider)) continue;  // a meeting has no point
    if (const std::optional<PlaceFault> fault = place_fault(header_, record, contact))
      note(fault->clause, record, fault->words);
  }
  for (const ExactContact& exact : judged.contacts) {
    const auto is_it = [&](const Contact& one) { return one.collider == exact.collider && one.side == exact.side; };
    const auto on_side = [&](const Contact& one) { return one.side == exact.side; };
    // Of a side where none is reported the metrics tell.
    if (exact.first && std::any_of(record.contacts.begin(), record.contacts.end(), on_side) &&
        std::none_of(record.contacts.begin(), record.contacts.end(), is_it))
      note(Clause::contact_missed, record,
           fmt::format("does not report a contact: `{}`, {}", header_.ids[exact.collider], name_of(exact.side)));
  }
}

/// Whether the law of response (§4 of the design) makes the velocity at the end of what was wanted, at the contacts
/// that are reported: these are judged for themselves. That law is no law of nature, and asked only of who promises it.
void RunJudge::judge_velocity(const SolidsInStep& there, const StepJudgement& judged, const Follower& follower) {
  const TraceStep& record = there.step();
  const Wanted& wanted = follower.wanted;
  const bool crushed =
      !judged.crushed.empty() || (!judged.crushed_with_room.empty() && contains(header_.guarantees, Clause::crush));
  const bool excused = !record.start_overlap.empty() || !judged.end_overlap.empty() || crushed || record.stuck ||
                       record.dropped || header_.substeps > 1 || wanted.parts > 1 || judged.beside_another;
  if (excused || !contains(header_.guarantees, Clause::velocity)) return;
  const Vec2d up = up_in(record, header_);
  if (detail::stairs_climbed(header_, scenery(), record, {}, wanted) > 0) {
    const double changed = (record.velocity - wanted.velocity).dot(right_of(up));
    if (stands(record) && std::abs(changed) > same_speed * (1 + wanted.velocity.norm()))
      note(Clause::velocity, record, fmt::format("climbs a stair, which changes its speed by {:.3g} m/s", changed));
    return;
  }
  ControlledStep step{.wanted = wanted.velocity, .up = up};
  step.unsteered = wanted.velocity - wanted.steered / length_of(record, header_) * right_of(up);
  step.side_hit_ends_rise = header_.character.side_hit_ends_rise;
  step.sides = sides_of(header_, up);
  step.most_pressed_out = detail::push_beyond_motion / length_of(record, header_);
  const bool walks = !wanted.jumped && begins_as_walk(header_, record, wanted.from_ground, wanted.velocity);
  const std::vector<MetSurface> surfaces = met_surfaces(there, record.contacts, walks, wanted.stays_on());
  // What turns has no one normal in a step, nor has the ground that is left one velocity: there only its size is
  // judged.
  const auto turns = [](const MetSurface& at) { return at.spread > hardly_turns; };
  const std::optional<TraceRide> carrier = record.from             ? record.from->ride
                                           : follower.last.empty() ? std::nullopt
                                                                   : follower.last.back().ride;
  const bool is_bounded_only = std::any_of(surfaces.begin(), surfaces.end(), turns) ||
                               (carrier && there.spread(carrier->collider, carrier->velocity, 1) > 0);
  if (is_bounded_only) return;
  if (const auto fault = velocity_fault(step, surfaces, record.velocity)) note(Clause::velocity, record, *fault);
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
  const bool movers_leave = std::any_of(header_.scripts.begin(), header_.scripts.end(), [](const MoverScript& script) {
    return std::any_of(script.path.begin(), script.path.end(), [](const MoverScript::Waypoint& waypoint) {
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
  const auto fault = [&](Axis axis, Verdict verdict, const std::string& words) {
    add_fault(row, axis, verdict, words);
  };
  const auto on_steps = [&](const std::optional<int>& steps, const char* what) {
    if (steps.value_or(0) > 0)
      fault(Axis::progress, Verdict::flagged, fmt::format("{} on {}", what, counted(*steps, "step")));
  };
  if (const int unsure = row.undecided_steps.value_or(0); unsure > 0)
    fault(Axis::safety, Verdict::flagged, fmt::format("too near to what turns to tell on {}", counted(unsure, "step")));
  on_steps(row.dropped_steps, "drops displacement");
  if (disagreements_ > 0)
    fault(Axis::validity, Verdict::failed,
          fmt::format("the judge's two methods disagree on {}", counted(disagreements_, "step")));
  if (steps_capped_ > 0)
    fault(Axis::validity, Verdict::flagged,
          fmt::format("{} beyond Box2D's travel cap of 2 m per step, not scored", counted(steps_capped_, "step")));
  if (!header_.guarantees.empty()) return;  // the rest are clauses
  if (row.first_tunnel)                     // the first passage in words says more than how many there are
    fault(Axis::safety, Verdict::tunnels, row.first_tunnel->words);
  if (row.steps_ending_inside.value_or(0) > 0 && steps_broken_ > 0)
    fault(Axis::safety, Verdict::flagged,
          fmt::format("ends {} inside {}, up to {:.3g} m deep", counted(*row.steps_ending_inside, "step"),
                      broke_company_ ? "a solid or another character" : "a solid", row.max_penetration_m.value_or(0)));
  if (const int passed = row.one_way_violations.value_or(0); passed > 0)
    fault(Axis::safety, Verdict::flagged,
          fmt::format("passes a one-way chain against its normal on {}", counted(passed, "step")));
  if (row.crushes_refuted.value_or(0) > 0)
    fault(Axis::safety, Verdict::flagged,
          fmt::format("a crush with room to give way on {}", counted(*row.crushes_refuted, "step")));
  on_steps(row.hanging_steps, "hangs");
  on_steps(row.stuck_refuted, "says it is stuck beside a way out");
  on_steps(row.ground_refuted, "says it is grounded with nothing under it");
  if (const double share = row.wanted_motion_lost.value_or(0); share > most_motion_lost)
    fault(Axis::progress, Verdict::flagged,
          fmt::format("loses {:.3g} % of its horizontal motion to nothing", 100 * share));
  if (const auto other = breaches_.find(Clause::wanted); other != breaches_.end())
    fault(Axis::validity, Verdict::flagged,
          fmt::format("was asked for another motion than the scene wants on {}", counted(other->second.steps, "step")));
}

}  // namespace paperproof::compare
