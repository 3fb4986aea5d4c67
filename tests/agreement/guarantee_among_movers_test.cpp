/// The guarantee of octagon_sweep against the exact oracle, among up to 64 movers: boxes, papers, chains, one-way
/// chains and rows of tiles, at speeds up to 1e6 m per step, in random scenery that stands still.
#include "agreement/random_movers.hpp"
#include "agreement/recorded.hpp"
#include "agreement/reported.hpp"
#include "agreement/run_trace.hpp"
#include "oracle/judge.hpp"
#include "runs/mover_record.hpp"
#include "support/random_sceneries.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>
#include <paperproof/tolerances.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <sstream>

namespace paperproof::test {
namespace {

using compare::ExactScenery;
using compare::Judge;
using compare::Place;
using compare::StepJudgement;
using compare::TraceHeader;
using compare::TraceStep;

/// What is left at a contact at most, and how far its place along its normal may be off [m]: in double the guarantee's
/// 1e-6.
template <class Scalar>
constexpr double contact_reach = 2 * static_cast<double>(Tolerances<Scalar>{}.stop);
/// Nearer than this is a contact, and the rounding of a position 1e6 m away [m].
template <class Scalar>
constexpr double hit_distance = static_cast<double>(Tolerances<Scalar>{}.hit) * 1.01;
/// Among many movers the oracle takes seconds to find that there is no room within reach of one that goes farther than
/// this [m]: such crushes are judged where there are few, unless all are asked for; and the first one of a run, as the
/// steps that follow mostly are the same again.
constexpr double far_crush = 3;
constexpr std::size_t few_movers = 8;
/// So many steps of a family that break it are described.
constexpr int most_described = 3;

/// Runs are counted from here, in each family: others have not been seen before.
std::uint64_t first_run() { return static_cast<std::uint64_t>(steps_wanted("PAPERPROOF_GUARANTEE_FIRST_RUN", 0)); }

/// Steps, and how many of them did what.
struct Tally {
  int steps = 0;
  int with_contact = 0;
  int riding = 0;
  int crushed = 0;
  int dropped = 0;
  int in_wedges = 0;     ///< Of the dropped ones: they came to rest where surfaces close in on them from several sides,
  int launched_far = 0;  ///< and of the others: they, or what they met, went so far that the iterations may run out.
  int stuck = 0;
  int overlaps = 0;        ///< Ended inside what they did not begin in, and what did not crush.
  int passages = 0;        ///< Passed a solid, and be it with a rim.
  int one_way = 0;         ///< Passed a one-way chain against its normal.
  int gaps = 0;            ///< Left more than the guaranteed gap at a contact.
  int fractions_seen = 0;  ///< Had a first contact that can be compared,
  int fractions = 0;       ///< at another time than the exact one.
  int room = 0;            ///< Were crushed where there was room.
  int far = 0;             ///< Were crushed by what goes far.
  int unsound = 0;         ///< Were not finite, or did not end where they said.
  int on_purpose = 0;      ///< Dropped through one-way chains,
  int drops = 0;           ///< and named others, or without being asked to.
  int contacts = 0;        ///< Had a contact whose normal, point and gap are not what is there.
  int hanging = 0;         ///< Could have fallen, and did not.
  int stuck_refuted = 0;   ///< Said that they are stuck, and there was a straight way out.
  int fine = 0;            ///< Are fine, see `is_fine`, as are all before them in their run.
  int fine_broken = 0;     ///< Of these, ended inside something or passed it.

  [[nodiscard]] int broken() const {
    return overlaps + passages + one_way + gaps + fractions + room + unsound + drops + contacts + hanging +
           stuck_refuted + dropped - in_wedges - launched_far;
  }
};

template <class Scalar>
class RandomRun {
 public:
  RandomRun(Family family, std::uint64_t seed, bool up_turns = false)
      : family_(family),
        seed_(seed),
        random_(seed),
        origin_(random_.chance(0.8) ? Vec2d{0, 0} : Vec2d{far(), far()}),
        scenery_(scenery()),
        controller_(scenery_, character()),
        scratch_(controller_.make_scratch()),
        motions_(scenery_.mover_count()),
        wanderers_(scenery_.mover_count()),
        record_(scenery_.mover_count(), scenery_),
        up_turns_(up_turns) {}

  void go(Tally& tally) {
    state_.position = (origin_ + Vec2d{random_.between(-4, 4), random_.between(-3, 5)}).cast<Scalar>();
    const double dt = random_.chance(0.7) ? 1.0 / 60 : random_.log_between(1e-3, 0.1);
    TraceHeader header;
    header.contender = "octagon_sweep";
    header.scalar = std::is_same_v<Scalar, float> ? "float" : "double";
    header.points = hull();
    header.scenery = scenery_.as_run();
    header.dt = static_cast<double>(static_cast<Scalar>(dt));
    header.character = controller_.character();
    header.guarantees = compare::every_clause();
    judge_.emplace(header);
    reported_.emplace(header.scenery, header.points, Tolerances<Scalar>{}.certain);
    if (!std::is_same_v<Scalar, float>)
      trace_.emplace(header, up_turns_ ? "movers_any_up" : "movers", name_of(family_) + "_" + std::to_string(seed_));
    Input input;
    for (int step = 0; step < 60; ++step) {
      if (random_.chance(0.1)) input.move = random_.integer(-1, 1);
      if (random_.chance(0.1)) input.jump = !input.jump;
      input.drop = random_.chance(input.drop ? 0.8 : 0.1);
      if (random_.chance(0.05)) launch(dt);
      move_wanderers(dt);
      if (up_turns_ && (step == 0 || random_.chance(0.1))) {
        const double angle = random_.angle();
        up_ = Vec2d{std::cos(angle), std::sin(angle)}.cast<Scalar>();
      }
      take(input, static_cast<Scalar>(dt), tally);
      const bool gone = (state_.position.template cast<double>() - origin_).cwiseAbs().maxCoeff() > 14;
      if (gone || ends_ || ::testing::Test::HasFatalFailure()) return;
    }
  }

 private:
  double far() { return random_.either_sign_log_between(1, 9.9e5); }

  SceneryDef scenery() {
    SceneryDef def = random_.chance(0.8) ? random_scenery(family_, random_, origin_) : SceneryDef{};
    const int movers = random_.chance(0.1) ? 64 : random_.integer(1, 8);
    for (int i = 0; i < movers; ++i) add_mover(def.colliders, static_cast<MoverIndex>(i), random_, origin_);
    if (family_ == Family::circles) round_movers(def.colliders, random_);
    def_ = def;
    return def;
  }

  CharacterDef character() {
    CharacterDef def;
    if (random_.chance(0.3)) def.snap = 0.5;
    if (random_.chance(0.2)) def.max_climb_degrees = random_.between(0, 89);
    return def;
  }

  std::vector<Vec2d> hull() {
    std::vector<Vec2d> points;
    for (const Vec2d& p : controller_.character().shape.hull())
      points.push_back(p.cast<Scalar>().template cast<double>());
    return points;
  }

  void launch(double dt) {
    const double speed = random_.log_between(1e-3, random_.chance(0.2) ? 1e6 : 10) / dt;
    const double angle = random_.angle();
    state_.velocity = Vec2d{std::cos(angle) * speed, std::sin(angle) * speed}.cast<Scalar>();
    launched_ = true;
  }

  void move_wanderers(double dt) {
    for (std::size_t i = 0; i < wanderers_.size(); ++i) {
      MoverMotion<Scalar>& motion = motions_[i];
      motion.from = motion.to;
      motion.to = next_offset(wanderers_[i], motion.from.template cast<double>(), random_).template cast<Scalar>();
    }
    record_.take(motions_, static_cast<Scalar>(dt));
  }

  void take(const Input& input, Scalar dt, Tally& tally) {
    const Vec2<Scalar> gravity = Scalar(-30) * up_;
    const CharacterState<Scalar> state_before = state_;
    const Ride<Scalar> ride = state_.ride;
    const bool rides = ride.ground != Ride<Scalar>::none;
    const StepStatus status = controller_.step(state_, input, {gravity, dt, motions_, nullptr, up_}, scratch_, report_);
    const Tally before = tally;
    ++tally.steps;
    ASSERT_NE(status, StepStatus::invalid_input) << where();
    if (status == StepStatus::out_of_range) {
      state_ = CharacterState<Scalar>{};
      state_.position = origin_.cast<Scalar>();
      begins_anew_ = true;
      return;
    }
    tally.with_contact += !report_.move.contacts.empty();
    tally.riding += state_.ride.ground != Ride<Scalar>::none;
    tally.crushed += !report_.move.crushed.empty();
    tally.dropped += status == StepStatus::dropped;
    tally.stuck += status == StepStatus::stuck;
    const bool far = crushed_from_afar();
    tally.far += far;
    ends_ = far;
    if (far && wanderers_.size() > few_movers && steps_wanted("PAPERPROOF_FAR_CRUSHES", 0) == 0) return;
    TraceStep record = recorded<Scalar>(report_, state_, motions_);
    record.requested += record_.carried_by(ride, input.drop);
    record.respawn = begins_anew_;
    begins_anew_ = false;
    const StepJudgement judgement = judge_->judge(record);
    if constexpr (std::is_same_v<Scalar, double>) {
      record.up = up_;
      record.gravity = gravity;
      trace_->write(record, state_before, input, launched_ || record.respawn);
      launched_ = false;
    }
    count(record, judgement, tally);
    count_what_is_said(record, input.drop, tally);
    if (!rides && !up_turns_) count_fraction(record, judgement, tally);
    if (!std::is_same_v<Scalar, float> && before.broken() < most_described && tally.broken() > before.broken())
      std::printf("breaks: %s\n", (what(judgement) + where()).c_str());
  }

  [[nodiscard]] bool crushed_from_afar() const {
    const auto& crushed = report_.move.crushed;
    return std::any_of(crushed.begin(), crushed.end(), [&](ColliderIndex collider) {
      const MoverMotion<Scalar>& motion = motions_[scenery_.collider(collider).mover];
      return static_cast<double>((motion.to - motion.from).norm()) > far_crush;
    });
  }

  void count(const TraceStep& record, const StepJudgement& judgement, Tally& tally) {
    const MoveResult<Scalar>& move = report_.move;
    tally.overlaps += !judgement.entered.empty();
    tally.passages += !judgement.tunnelled.empty() || !judgement.corner_cut.empty();
    tally.one_way += !judgement.one_way_broken.empty();
    all_fine_ = all_fine_ && is_fine(record);
    if (all_fine_) {
      ++tally.fine;
      tally.fine_broken += !judgement.entered.empty() || !judgement.tunnelled.empty() ||
                           !judgement.corner_cut.empty() || !judgement.one_way_broken.empty();
    }
    tally.room += !judgement.crushed_with_room.empty();
    tally.hanging += judgement.hangs && !up_turns_;  // the judge of a run knows no other up
    tally.in_wedges += record.dropped && is_between_surfaces(record);
    tally.launched_far += record.dropped && !is_between_surfaces(record) && goes_far(record);
    tally.stuck_refuted += judgement.stuck_refuted;
    const bool named =
        judgement.end_overlap.empty() || report_.status == StepStatus::stuck || report_.status == StepStatus::crushed;
    const bool ends = record.path.back().fraction == 1 && move.path.back().position == state_.position;
    const bool kept = !move.path.overflowed() && !move.crushed.overflowed();
    tally.unsound += !(named && ends && kept && state_.position.allFinite() && state_.velocity.allFinite());
    const bool near = std::all_of(record.contacts.begin(), record.contacts.end(), [](const Contact<double>& contact) {
      return contact.separation <= contact_reach<Scalar>;
    });
    // A contact with what was overlapped, or crushes later in the step, has no gap.
    const bool free = record.crushed.empty() && judgement.end_overlap.empty();
    tally.gaps += free && !(near && judgement.max_contact_gap <= contact_reach<Scalar>);
  }

  /// Whether nothing crushes, and an ulp of every number of the step is at most a sixteenth of the gap that is kept. A
  /// position, the end of a mover and the way of each are rounded once, and a step has few parts: their errors do not
  /// add up to the gap. In float this is so up to 262 m.
  [[nodiscard]] bool is_fine(const TraceStep& record) const {
    constexpr double ulp = std::numeric_limits<Scalar>::epsilon();
    constexpr double largest = static_cast<double>(Tolerances<Scalar>{}.stop) / 16 / ulp;
    const auto is_small = [](const Vec2d& v) { return v.cwiseAbs().maxCoeff() <= largest; };
    return record.crushed.empty() && is_small(record.requested) &&
           std::all_of(record.path.begin(), record.path.end(),
                       [&](const PathPoint<double>& corner) { return is_small(corner.position); }) &&
           std::all_of(record.movers.begin(), record.movers.end(), [&](const MoverMotion<double>& motion) {
             return is_small(motion.from) && is_small(motion.to) && is_small(motion.to - motion.from);
           });
  }

  /// What closes in is met on one side and on the other, sooner and sooner: no number of iterations is enough. The last
  /// way may lead along the tangent of a circle, and so away from it.
  [[nodiscard]] bool is_between_surfaces(const TraceStep& record) const {
    return std::any_of(record.path.begin(), record.path.end(), [&](const PathPoint<double>& corner) {
      const auto parts = judge_->scenery().near_parts(Place(corner, record.movers), contact_reach<Scalar>);
      const auto opposes = [](const Vec2d& one) {
        return [one](const compare::NearPart& part) { return part.faces.front().normal.dot(one) < 0; };
      };
      return std::any_of(parts.begin(), parts.end(), [&](const compare::NearPart& part) {
        return part.moved != Vec2d::Zero() &&
               std::any_of(parts.begin(), parts.end(), opposes(part.faces.front().normal));
      });
    });
  }

  /// As for launches among scenery that stands.
  [[nodiscard]] bool goes_far(const TraceStep& record) const {
    constexpr double far_launch = 1000;
    return record.requested.norm() >= far_launch ||
           std::any_of(record.contacts.begin(), record.contacts.end(), [&](const Contact<double>& contact) {
             const MoverIndex mover = scenery_.collider(contact.collider).mover;
             return mover != no_mover && (record.movers[mover].to - record.movers[mover].from).norm() >= far_launch;
           });
  }

  void count_what_is_said(const TraceStep& record, bool drops, Tally& tally) {
    std::vector<Place> path;
    for (const PathPoint<double>& corner : record.path) path.emplace_back(corner, record.movers);
    tally.contacts += !std::all_of(record.contacts.begin(), record.contacts.end(), [&](const Contact<double>& contact) {
      return reported_->contact_holds(path, contact);
    });
    const std::vector<ColliderIndex>& named = record.dropped_through;
    const bool kept = !report_.dropped_through.overflowed();
    tally.on_purpose += !named.empty();
    tally.drops += !named.empty() && !(drops && kept && reported_->drops_hold(path, named));
  }

  /// The first contact of a step that nothing carries happens when the exact motion first meets its collider.
  void count_fraction(const TraceStep& record, const StepJudgement& judgement, Tally& tally) {
    if (!judgement.first_impact_comparable || record.contacts.empty()) return;
    const ExactScenery& oracle = judge_->scenery();
    const Place start(record.path.front(), record.movers);
    const Vec2d wanted = record.requested;
    // What rests, and touches something, is carried from now on.
    if (wanted.x() == 0 && wanted.y() <= 0 && !oracle.near(start, start, contact_reach<Scalar>).empty()) return;
    ++tally.fractions_seen;
    const Contact<double>& first = record.contacts[0];
    const auto exact = oracle.time_of_impact(start, wanted, first.collider);
    const MoverIndex mover = scenery_.collider(first.collider).mover;
    Vec2d relative = wanted;
    if (mover != no_mover) relative -= record.movers[mover].to - record.movers[mover].from;
    if (exact &&
        std::abs(static_cast<double>(exact->fraction) - first.fraction) * std::abs(relative.dot(exact->normal)) <=
            contact_reach<Scalar>)
      return;
    // A way that passes a rim within the hit distance may be stopped there.
    const Place there(start.position + wanted * first.fraction, record.movers, first.fraction);
    const double gap = oracle.separation(there, first.collider);
    tally.fractions += !(gap > 0 && gap <= hit_distance<Scalar>);
  }

  [[nodiscard]] static std::string what(const StepJudgement& judgement) {
    std::ostringstream text;
    text.precision(17);
    text << "enters " << names(judgement.entered) << "passes " << names(judgement.tunnelled)
         << names(judgement.corner_cut) << "against one-way " << names(judgement.one_way_broken) << "with room beside "
         << names(judgement.crushed_with_room) << (judgement.hangs ? "hangs " : "")
         << (judgement.stuck_refuted ? "is not stuck " : "") << "gap " << judgement.max_contact_gap;
    if (judgement.room) text << " room at " << judgement.room->transpose();
    if (judgement.first_impact) text << " exact fraction " << *judgement.first_impact;
    return text.str();
  }

  static std::string names(const std::vector<ColliderIndex>& colliders) {
    std::string text;
    for (const ColliderIndex collider : colliders) text += std::to_string(collider) + " ";
    return text;
  }

  [[nodiscard]] std::string where() const {
    std::ostringstream text;
    text.precision(17);
    text << "\n  " << name_of(family_) << ", seed " << seed_ << ", status " << static_cast<int>(report_.status)
         << ", requested " << report_.requested.transpose() << ", way";
    for (const PathPoint<Scalar>& corner : report_.move.path)
      text << " (" << corner.position.x() << ", " << corner.position.y() << " @ " << corner.fraction << ")";
    text << ", contacts";
    for (const Contact<Scalar>& c : report_.move.contacts) {
      text << "\n    " << c.collider << " n " << c.normal.transpose() << " @ " << c.fraction << " gap " << c.separation;
      const MoverIndex mover = scenery_.collider(c.collider).mover;
      if (mover != no_mover) text << " mover by " << (motions_[mover].to - motions_[mover].from).transpose();
    }
    text << "\n  drops through";
    for (const ColliderIndex chain : report_.dropped_through) text << " " << chain;
    text << "\n  crushed";
    for (const ColliderIndex c : report_.move.crushed) {
      const MoverIndex mover = scenery_.collider(c).mover;
      text << " " << c << " by " << (motions_[mover].to - motions_[mover].from).transpose();
    }
    return text.str();
  }

  Family family_;
  std::uint64_t seed_;
  Random random_;
  Vec2d origin_;
  SceneryDef def_;
  Scenery<Scalar> scenery_;
  Controller<Scalar> controller_;
  std::optional<Judge> judge_;
  std::optional<Reported> reported_;
  Scratch<Scalar> scratch_;
  CharacterState<Scalar> state_;
  StepReport<Scalar> report_;
  std::vector<MoverMotion<Scalar>> motions_;
  std::vector<Wanderer> wanderers_;
  compare::MoverRecord<Scalar> record_;
  bool begins_anew_ = false;
  bool ends_ = false;
  bool all_fine_ = true;  ///< All steps so far.
  bool up_turns_;         ///< Between the steps of the run, now and then.
  Vec2<Scalar> up_{0, 1};
  std::optional<RunTrace> trace_;
  bool launched_ = false;
};

class AmongMovers : public ::testing::TestWithParam<Family> {};

template <class Scalar>
Tally run_family(Family family, int steps, bool up_turns = false) {
  Tally tally;
  for (std::uint64_t run = first_run(); tally.steps < steps; ++run) {
    try {
      RandomRun<Scalar>(family, 2000003 * (static_cast<std::uint64_t>(family) + 1) + run, up_turns).go(tally);
    } catch (const InvalidScenery&) {
      // Far from the origin neighbouring vertices become one in float.
      EXPECT_EQ(sizeof(Scalar), sizeof(float));
    }
    if (::testing::Test::HasFatalFailure()) break;
  }
  std::printf(
      "%s in %s: %d steps, %d with contact, %d riding, %d crushed, %d stuck, %d dropped (%d between surfaces, %d "
      "launched far); %d "
      "overlaps, %d passages, %d "
      "against one-way chains, %d gaps, %d of %d fractions, %d crushes with room, %d crushed from afar, %d unsound, "
      "%d of %d drops, %d contacts, %d hanging, %d not stuck\n",
      name_of(family).c_str(), sizeof(Scalar) == 8 ? "double" : "float", tally.steps, tally.with_contact, tally.riding,
      tally.crushed, tally.stuck, tally.dropped, tally.in_wedges, tally.launched_far, tally.overlaps, tally.passages,
      tally.one_way, tally.gaps, tally.fractions, tally.fractions_seen, tally.room, tally.far, tally.unsound,
      tally.drops, tally.on_purpose, tally.contacts, tally.hanging, tally.stuck_refuted);
  return tally;
}

TEST_P(AmongMovers, no_step_breaks_the_guarantee) {
  const Tally tally = run_family<double>(GetParam(), steps_per_family());
  const std::string family = name_of(GetParam());
  BrokenByRuns::all().expect_only_what_is_known(family);
  EXPECT_EQ(tally.overlaps, 0);
  EXPECT_EQ(tally.passages, 0);
  EXPECT_EQ(tally.one_way, 0);
  EXPECT_EQ(tally.gaps, 0);
  EXPECT_EQ(tally.fractions, 0);
  EXPECT_LE(tally.room, most_broken("movers", compare::Clause::crush, tally.steps, family));
  EXPECT_EQ(tally.unsound, 0);
  EXPECT_EQ(tally.drops, 0);
  EXPECT_LE(tally.contacts, most_broken("movers", compare::Clause::contact_invented, tally.steps, family));
  EXPECT_LE(tally.hanging, most_broken("movers", compare::Clause::hanging, tally.steps, family));
  EXPECT_LE(tally.stuck_refuted, most_broken("movers", compare::Clause::start_inside, tally.steps, family));
  EXPECT_EQ(tally.dropped, tally.in_wedges + tally.launched_far);
  if (tally.steps < few_steps) return;
  // The generators must really meet the solids, and also miss them.
  EXPECT_GE(tally.with_contact, tally.steps * 0.1);
  EXPECT_LE(tally.with_contact, tally.steps * 0.9);
  EXPECT_GT(tally.fractions_seen, 0);
  // Few families have ledges: in some a drop through one comes once in thousands of steps.
  if (tally.steps >= 9000) {
    EXPECT_GT(tally.on_purpose, 0);
  }
  EXPECT_GT(tally.riding, 0);
  EXPECT_GT(tally.crushed, 0);
  EXPECT_LT(tally.crushed, tally.steps / 5);
}

TEST_P(AmongMovers, no_step_with_any_up_breaks_the_guarantee) {
  const Tally tally = run_family<double>(GetParam(), std::max(steps_per_family() / 9, 2000), true);
  const std::string family = name_of(GetParam());
  BrokenByRuns::all().expect_only_what_is_known(family);
  EXPECT_EQ(tally.overlaps, 0);
  EXPECT_EQ(tally.passages, 0);
  EXPECT_EQ(tally.one_way, 0);
  EXPECT_EQ(tally.gaps, 0);
  EXPECT_LE(tally.room, most_broken("movers_any_up", compare::Clause::crush, tally.steps, family));
  EXPECT_EQ(tally.unsound, 0);
  EXPECT_EQ(tally.drops, 0);
  EXPECT_LE(tally.contacts, most_broken("movers_any_up", compare::Clause::contact_invented, tally.steps, family));
  EXPECT_LE(tally.stuck_refuted, most_broken("movers_any_up", compare::Clause::start_inside, tally.steps, family));
  EXPECT_LE(tally.dropped - tally.in_wedges - tally.launched_far, 1 + tally.steps / 5000);
  EXPECT_GT(tally.riding, 0);
}

/// Each broke a promise once, or made the judge say so.
TEST(AmongMoversFound, what_broke_once_holds) {
  const std::vector<std::pair<Family, std::uint64_t>> found{
      {Family::tiles, 2001356},     {Family::stairs, 14000776},   {Family::slopes, 4001578},
      {Family::slopes, 4000198},    {Family::papers, 8001016},    {Family::papers, 8001922},
      {Family::chains, 10000835},   {Family::shafts, 18001570},   {Family::ceilings, 16002797},
      {Family::ceilings, 16004470}, {Family::ceilings, 16001581}, {Family::one_way, 24000858},
      {Family::one_way, 24000897}};
  for (const auto& [family, seed] : found) {
    Tally tally;
    RandomRun<double>(family, seed).go(tally);
    EXPECT_EQ(tally.broken(), 0) << name_of(family) << ", seed " << seed;
    EXPECT_EQ(BrokenByRuns::all().take("movers", compare::Clause::passage), 0) << name_of(family) << ", seed " << seed;
  }
}

TEST_P(AmongMovers, in_float_nothing_is_passed_where_rounding_is_finer_than_the_gap) {
  const Tally tally = run_family<float>(GetParam(), steps_per_family() / 9);
  EXPECT_EQ(tally.fine_broken, 0);
  if (tally.steps < few_steps) return;
  EXPECT_GE(tally.fine, tally.steps / 4) << "of " << tally.steps;
  EXPECT_LT(tally.fine, tally.steps);
}

INSTANTIATE_TEST_SUITE_P(EveryFamily, AmongMovers, ::testing::ValuesIn(all_families),
                         [](const ::testing::TestParamInfo<Family>& family) { return name_of(family.param); });

}  // namespace
}  // namespace paperproof::test
