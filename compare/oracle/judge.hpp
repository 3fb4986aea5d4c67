/// Judges a run from its trace alone, step by step.
#pragma once

#include "oracle/crush.hpp"
#include "oracle/intent.hpp"
#include "records/trace.hpp"

#include <map>
#include <memory>

namespace paperproof::compare {

namespace detail {
class TurningJudge;
struct LaterParts;
}  // namespace detail

/// A contact that the requested motion really had.
struct ExactContact {
  ColliderIndex collider = 0;
  Side side = Side::bottom;
  Vec2d normal{Vec2d::Zero()};  ///< Unit, from the obstacle towards the octagon.
  double fraction = 0;          ///< Of the step.
  /// Met by the requested motion from the start of the step alone: what turns the motion before may prevent it.
  bool foreseen = false;
  bool first = false;  ///< Of those that the requested motion of the step meets before all others, at one time.
};

/// How a solid was passed.
struct Passing {
  ColliderIndex collider = 0;
  double speed = 0;      ///< Length of the step's way relative to the solid over dt [m/s].
  double thickness = 0;  ///< Of the solid, along the normal of the face that was passed [m]; 0 for a chain.
  double angle = 0;      ///< Of the way to that face [degrees]: 90 is head-on, 0 grazes.
};

struct StepJudgement {
  std::vector<ColliderIndex> end_overlap;  ///< Solids that the octagon overlaps at the end of the step.
  std::vector<ColliderIndex> pressed;      ///< Of these, the ones that a crush brought on, now or before: see `Judge`.
  std::vector<ColliderIndex> entered;      ///< Of these, the ones that are new and not pressed.
  std::vector<ColliderIndex> rounded;      ///< Of these, the ones that are no deeper than rounding: see `Judge`.
  std::vector<ColliderIndex> drawn;        ///< Of these, the ones that are no deeper than a pixel: see `Judge`.
  std::vector<ColliderIndex> tunnelled;    ///< Solids that were passed through: see `Judge`.
  std::vector<Passing> passings;           ///< One for each of `tunnelled`.
  std::vector<ColliderIndex> clipped;      ///< The same, but with a rim of the octagon only.
  double clipped_depth = 0;                ///< The deepest of these, and of `Company::clipped` [m].
  /// One-way chains that were passed against their normal, and not on purpose.
  std::vector<ColliderIndex> one_way_broken;
  std::vector<ColliderIndex> crushed;            ///< Reported as crushing, and there was no room: see `Judge`.
  std::vector<ColliderIndex> crushed_with_room;  ///< Reported as crushing, although there was room.
  bool excused_crush = false;                    ///< Some of `crushed` had room, beside another character.
  std::optional<Vec2d> room;                     ///< Where that was, if something was reported as crushing.
  double max_penetration = 0;                    ///< At the end of the step, apart from `pressed` [m].
  /// Over the reported contacts: the smallest exact separation at any corner of the way [m].
  double max_contact_gap = 0;
  std::vector<ExactContact> contacts;  ///< What should have been reported.
  /// Within reach of what the contender calls touching: neither right nor wrong.
  std::vector<ColliderIndex> dont_care;
  /// Reported contacts that are between where §6 of the guarantee begins to hit and where it lets go.
  std::vector<std::pair<ColliderIndex, Side>> contact_band;
  /// Reported contacts that no requested motion has, but what an exact contact leaves of it: right all the same.
  std::vector<std::pair<ColliderIndex, Side>> deflected;
  /// Reported contacts that are no farther than 1e-6 m, and met by the requested motion only after this step.
  std::vector<std::pair<ColliderIndex, Side>> ahead;
  std::optional<double> normal_error;  ///< Largest over the reported contacts that are exact [degrees].
  /// Reported contacts with a don't-care collider on a side where no face stands out: wrong all the same.
  std::vector<std::pair<ColliderIndex, Side>> ghosts;
  std::optional<double> first_impact;    ///< Exact fraction of the first impact of the requested motion, started free.
  bool first_impact_comparable = false;  ///< A reported fraction can be held against it: see `Judge`.
  /// How far the requested motion goes against the normal of the first impact [m], if it goes as requested until then.
  std::optional<double> first_approach;
  bool hangs = false;         ///< It could have fallen, and did not: see `Judge`.
  bool hovers = false;        ///< Only surfaces farther than 1e-6 m away, within the contender's own reach, hold it.
  double remainder_made = 0;  ///< Horizontally, taken up by a grid to be made later [m].
  double motion_wanted = 0;   ///< Horizontally [m].
  double motion_lost = 0;     ///< Of that, to nothing exact [m]: see `Judge`.
  /// It began inside something, and neither left that as §6 of the guarantee says nor was held there: see `Judge`.
  bool start_mishandled = false;
  bool stuck_refuted = false;   ///< It said that it is stuck, and there is a way out: see `Judge`.
  bool ground_refuted = false;  ///< It said that it is grounded, and nothing is under it: see `Judge`.
  bool ground_late = false;     ///< The same, but something was under it earlier in the step: excused.
  /// It hangs, or loses motion or speed, unless what turns comes farther than its nearest point does (see `Bounds`); or
  /// it touches a disc that turns by no script, so that nobody knows how fast the rim goes.
  bool unsure = false;
  bool in_parts = false;        ///< It goes in parts, and a contact or a time that follows the first is not asked for.
  bool turning_sensor = false;  ///< It overlaps a sensor that turns: its events are not judged.
  bool ground_missed = false;   ///< It touches ground that it does not leave, and says that it is not grounded.
  bool ground_left = false;     ///< A walk ends in the air above ground that `snap` has it follow.
  bool kerb_missed = false;     ///< A face stops a walk that could climb it: see `CharacterDef::step_height`.
  double speed_lost = 0;        ///< Of the wanted velocity, with nothing exact that took it [m/s].
  double speed_gained = 0;      ///< More than the wanted velocity and what moves near by can give [m/s].
  double way_gained = 0;        ///< The same of the way [m].
  Vec2d crept{Vec2d::Zero()};   ///< Way that no velocity made [m]: see `detail::leg_faults`.
  double leg_error = 0;         ///< So far from where the law of response leads it a leg ends [m].
  double end_error = 0;         ///< So far from where the velocity at the end leads it the last leg ends [m].
  double ghost_speed_loss = 0;  ///< Share of the wanted horizontal speed that was lost to nothing exact, in [0, 1].
  std::vector<ExactSensorEvent> sensor_events;  ///< What should have been reported.
  int sensor_events_missing = 0;                ///< Of `sensor_events`.
  int sensor_events_extra = 0;                  ///< Reported, and there was no such event.
  double max_sensor_error = 0;                  ///< Over the other reported ones: of the fraction of the step,
  double max_sensor_way = 0;  ///< and of the way relative to the sensor that the whole step takes [m].

  /// What happened with characters of a higher index; each pair is told once. See `CompanyJudge`.
  struct Company {
    std::vector<CharacterIndex> overlap;  ///< Overlapped at the end of the step.
    std::vector<CharacterIndex> entered;  ///< Of these, the ones that are new.
    std::vector<CharacterIndex> passed;   ///< Got past each other.
    std::vector<CharacterIndex> clipped;  ///< The same, but with a rim of the octagon only.
    std::vector<CharacterIndex> rounded;  ///< Overlapped anew, by no more than rounding.

    [[nodiscard]] bool broke() const { return !entered.empty() || !passed.empty(); }
  };
  Company company{};
  /// Solids that turn of which only the second method could tell whether the step met them: see
  /// `detail::TurningJudge`.
  std::vector<ColliderIndex> undecided{};
  /// Solids that turn of which the two methods say different things: an error of the judge, and never excused.
  std::vector<ColliderIndex> methods_disagree{};
  /// Of a contact with what turns, where it began: how far the reported fraction is from the first touch [steps].
  std::optional<double> turning_toi_error{};
  bool beside_another = false;  ///< Another that goes at the same time is near: see `Judge`.

  /// @param all `clipped`, or that of `company`. @param depth [m].
  template <class Index>
  void note_clipped(std::vector<Index>& all, Index whom, double depth) {
    all.push_back(whom);
    clipped_depth = std::max(clipped_depth, depth);
  }
  [[nodiscard]] bool clips() const { return !clipped.empty() || !company.clipped.empty(); }
  /// The step entered a solid or another character, passed one, or passed a one-way chain against its normal.
  [[nodiscard]] bool broke() const {
    return !entered.empty() || !tunnelled.empty() || !one_way_broken.empty() || company.broke();
  }
};

/// Feed it every step of one run in order. Not thread-safe.
///
/// Among movers everything is judged in the frame of the mover that a collider goes along with: the way that tunnels
/// it, the position from which it was last free, and the requested displacement, less the mover's own, that leads into
/// it.
///
/// **Tunnelled.** A solid (a polygon, or a two-sided chain) is tunnelled in a step that ends free of it when
/// - the octagon was free of it when the step began, and its open interior meets the solid somewhere on the polyline
///   that was travelled; or
/// - it was inside since an earlier step, and the straight ways from its last position free of the solid to all corners
///   of the way since it left meet the solid: it left on another side. Leaving a solid in which the run (or a respawn,
///   or a placement of the twin) began is none; entering it again after that is.
///
/// A crushing mover may sweep over the resting character; where the character's own way crosses it, it is tunnelled.
/// The own way is the straight one in the world from where the octagon was when the mover came over it to where it is
/// now, and the mover stands where this step leaves it.
///
/// **Crushed.** A mover that the contender names as crushing is excused, and what it is pressed into stays excused
/// until the octagon is free of it, if exact arithmetic finds no room. Room is a position at the end of the step
/// - not farther than the longest motion of the movers that are named, and 0.25 m (`detail::push_beyond_motion`), from
///   where the way to it begins, and from the octagon's. How far it went by itself is no push. What it was pushed
///   already is taken off;
/// - with a clearance of at least 1e-7 m to every solid, so that no opening under 2e-7 m is asked for;
/// - reached from a corner of the way that was travelled, no later than where the first leg begins that meets one of
///   those named, or from where that leg touches it (no way that leaves later undoes what has been pressed in), by a
///   straight uniform motion until the end of the step that meets no solid but what is overlapped at that corner, and
///   comes no nearer than 1e-7 m (each side of the octagon moved out by so much) to what is farther away there: who
///   passes a rim nearer than that may be stopped at it. And no solid that was met before lies between the last place
///   free of it and there: on its far side there is no room.
///
/// A crush with room counts as one without where another that goes at the same time is near (exempted). `room` says
/// where it was.
/// The same is asked for who promises nothing when a step ends inside something new: of the movers that come closer and
/// are within its reach, named or not. Where they leave no room, all that it is pressed into is excused.
/// A mover that goes and is named with room breaks `crush`. Of who promises that clause it is no matter of `overlap`
/// and `passage`, nor what it stops of `speed_lost` and `hanging`, like one without room: one breach is said once.
/// A collider that stands still or rests never crushes, nor does one that is nowhere on the way within 1e-6 m (who
/// promises nothing: its reach), nor does anything where nothing that is named comes closer to where the octagon was
/// when the step began. What a mover presses the octagon into besides itself is not excused.
///
/// **Sensor events** are reported in order of time, and compared for every sensor entering and leaving apart.
///
/// **Exemptions** are data, with their sizes for each kind of contender: oracle/exemptions.hpp.
///
/// **Rounding.** Whoever promises nothing may end inside by one ulp of its largest coordinate: `rounded` is no overlap.
///
/// **Drawn.** Who draws a level that is made of pixels lays itself on whole pixels, up to one beside the octagon. Where
/// it ends no deeper inside than that, it is `drawn` (exempted): no overlap, but its depth counts.
///
/// **Clipped.** The same as tunnelling, but with a rim of the octagon only, and its core stays free all along: it is
/// nowhere deeper than 20 mm, its contender's unit or its pixel (exempted), nor than an eighth of the octagon's
/// narrowest width. The rule is the same for all who promise nothing. The depth is the octagon's, not the solid's:
/// however thin a paper is, an octagon that passes it is half its own width deep at some instant.
///
/// **Contact.** A collider that the requested displacement, from a corner of the path (for Box2D: from its start or
/// end), enters after at most 1e-6 m along the contact normal, if it enters it in what is left of the step there, or
/// from the start of the step (for Box2D: in any case); or one that the requested motion of the step meets first.
/// Nearness without motion into it is none, nor is a normal that only a seam between abutting colliders has, nor a
/// one-way chain that is passed on purpose.
///
/// A reported contact with a face there to be touched is right, too (`deflected`), if what an exact contact leaves of
/// the requested motion enters it, or if the way that was travelled runs into it (ground that is followed).
///
/// **Don't care.** A collider whose contact is a matter of the contender's own reach: for Box2D within 20 mm of the
/// start or the end of the path; else one that the requested motion leads against and comes within 1e-7 m (who searches
/// by units: a unit) of, or that is no farther than the reach; one that is near enough for a contact where the step
/// ends, but not reported, as the motion, or that of a mover, may end there; and one that is near enough, but only
/// behind a seam. A report of it is a ghost where no face stands out that its normal could be of. Of octagon_sweep in
/// double only `contact_band` counts neither way: what comes within 1e-7 m, or is held up to 7e-7 m away.
///
/// **Fraction.** A first impact is comparable where the octagon began farther than 1e-6 m (Box2D: its skin, 20 mm) away
/// along the normal, and the approach against the normal is at least 1e-3 of the displacement: at rest, and where the
/// motion grazes, a gap of a micrometre is much of the way. Who is stuck does not go as requested, and has none; nor
/// has who gives way to a mover from the start of the step, or who goes in parts of the step, as what turns does.
///
/// **Hangs.** Let u be what is requested less what the step's steering added to it. C is the set of displacements that
/// enter no solid that is within 1e-6 m (separation along the best axis) of a corner of the travelled way: of each
/// convex part, those against none of the normals of one face that separates it there, relative to how far it moves in
/// the step. (A one-way chain counts where it blocks the shortest way to it, from there or from where the leg began
/// that ended there.) The projection of u onto C is the displacement of C that is nearest to u. A step hangs if the
/// projection falls, u falls, each by more than 1e-9 m and an ulp of the largest coordinate, and the step falls less
/// than half of both. Among movers two more things must hold, as what moves may touch for a part of the step only:
/// - Leg by leg it could have fallen twice as far, too. The rate of a leg is that of the projection onto C of its first
///   corner, of its last, or of both, whichever falls least, and no more than that of the leg before: what takes
///   momentum takes it for the rest of the step.
/// - No mover that does not touch the octagon at a corner runs into it from there, whether it stays or goes on as
///   requested: a character may give way instead.
/// Excepted are
/// - a direction with less than 2e-7 m of room between what is left and right of it, which is not in C;
/// - ground, a part in reach with a face within `max_climb_degrees` (and 1e-6 rad) of level: of a step that says that
///   it stands, or cannot fall straight down past that part;
/// - a step that touches a corner deeper than 1e-6 m inside a solid, a verified crush, and Box2D's cap: other answers
///   say so.
/// What turns comes along a face's normal by no more than a bound that is safe. Who hangs only if it comes as far as
/// the point does that is nearest to the octagon is `unsure` (exempted). What a grid has taken up and not made yet
/// (`remainder`) counts as made. A step hovers if it would hang, but for what is within the contender's own reach
/// (`detail::reach_of`): Box2D's skin, a unit of the article's search.
///
/// **Motion lost.** What is missing of the requested horizontal displacement is lost to nothing under the conditions of
/// ghost speed loss, whether a contact was reported or not; but for a step that Box2D's cap cut short, or one that
/// said it is stuck and was right.
///
/// **Start inside.** A step that begins inside of solids leaves them at once, in its first leg, which takes no time. No
/// straight way out is shorter by more than 1e-6 m, ends with a gap of 1e-6 m to everything, passes no rim of what it
/// leaves nearer than 2e-7 m, and keeps to the side of the last free place. Else the step is held: it ends free of
/// them, or says that it is stuck or crushed, and neither its way nor its velocity at the end is more than what moves
/// near by gives it (`detail::leg_faults`). Of what turns only the latter is asked of a step that says it is stuck.
///
/// **Stuck, refuted.** A step that says it is stuck is refuted if it begins and ends free, or if the shortest straight
/// way out (`ExactScenery::way_out`) ends on the side of the last place that was free of what it is inside of. The way
/// is asked for where the step begins, as things are then: what moves may open one later. Of a step that begins free
/// and ends inside it is asked for where it ends.
///
/// **Ground, refuted.** A step that says it is grounded is refuted if at its end it overlaps nothing, and no solid has
/// a face that looks upwards within the contender's reach (`detail::reach_of`; who promises nothing: and rounding).
/// Whoever promises nothing may have stood on something earlier in the step (exempted): Box2D reads its contacts before
/// it moves the bodies, and the article's techniques go on after they have met the ground.
///
/// **In parts.** A step that goes in parts, as what turns near it does, wants another motion in each: see `LaterParts`.
/// What is asked of its progress is asked for all of them together. What was requested is what the first of them wants:
/// a contact, or a time of impact, that it tells of in a later one is not asked for (`in_parts`, exempted).
///
/// **Normal error.** The angle between the normal of a reported contact and the nearest normal of the exact contacts
/// with that collider on that side, and of the face that is touched along the reported normal.
///
/// **What turns** is judged apart, exactly as well: see oracle/turning.hpp.
///
/// **Ghost speed loss.** Horizontal speed was lost to nothing where the step began free and crushed nobody, and no
/// solid opposes the wanted horizontal motion, neither with the rise that was requested nor with the one that was made,
/// within the step and the contender's reach beyond it (octagon_sweep in double: 1e-6 m; Box2D: 20 mm), from any corner
/// of the path. No more is lost than steering in the slowest way leaves of a step in parts. What is lost where
/// something that turns may oppose the motion (`TurningJudge::opposes`), or no more than by what a touched one may come
/// farther than its nearest point, is `unsure` (exempted).
///
/// **Beside another** character that goes at the same time: that one may have turned the motion aside, held or pushed
/// it. Contacts that are only reported, or only exact, count neither way (exempted). Nor do the first impact, lost way
/// and speed, falls, ground, room and ways out.
class Judge {
 public:
  /// @param like of another character of the same run: both ask the same exact sceneries.
  explicit Judge(const TraceHeader& header, const Judge* like = nullptr);
  ~Judge();
  Judge(Judge&&) = delete;
  /// @param wanted what the step was asked for, as `requested` of the step has it: then what the step says of its end
  ///   is judged, too.
  /// @param beside_another see `CompanyJudge::is_beside_another`.
  [[nodiscard]] StepJudgement judge(const TraceStep& step, const Wanted* wanted = nullptr, bool beside_another = false);
  /// The solids that the octagon overlaps where a step begins, in order.
  [[nodiscard]] std::vector<ColliderIndex> overlapped(const TraceStep& step) const;
  /// What turns is no solid there.
  [[nodiscard]] const ExactScenery& scenery() const noexcept { return scenery_; }
  [[nodiscard]] const detail::TurningJudge& turning() const noexcept { return *turning_; }

 private:
  /// A place that outlasts its step.
  struct Kept {
    explicit Kept(const Place& at)
        : position(at.position), movers(at.movers.begin(), at.movers.end()), fraction(at.fraction) {}
    [[nodiscard]] Place place() const { return {position, movers, fraction}; }
    Vec2d position;
    std::vector<MoverMotion> movers;
    double fraction = 0;
  };
  /// A stay inside a solid.
  struct Episode {
    std::optional<Kept> free_from;  ///< Last place free of it; none where the run began inside.
    double depth = 0;               ///< Largest so far [m].
    bool pressed = false;           ///< By a verified crush.
    bool rounded = false;           ///< No deeper than rounding, or a drawn pixel, so far.
  };
  using Path = std::vector<Place>;
  using Touched = std::map<ColliderIndex, std::size_t>;  ///< With the corner where the first leg that meets it begins.

  struct Sceneries {
    explicit Sceneries(const TraceHeader& header);
    ExactScenery octagon;
    std::map<double, std::unique_ptr<ExactScenery>> larger;  ///< By how much the octagon is [m].
  };

  /// The scenery for an octagon that is larger by so many metres.
  [[nodiscard]] const ExactScenery& scenery_for(double larger);
  /// A step of a run in which something turns.
  struct AmongTurning {
    const TraceStep& step;
    bool begins_inside = false;  ///< Of something that turns.
  };
  /// @param step without contacts with what turns, events of it, and crushes by it. @param turns what turns near by.
  [[nodiscard]] StepJudgement judge_step(const TraceStep& step, const WhatTurns& turns, const Wanted* wanted,
                                         bool beside_another, const AmongTurning* turning = nullptr);
  [[nodiscard]] WhatTurns what_turns(const TraceStep& step) const;
  [[nodiscard]] bool is_stuck_refuted(const Place& at, const WhatTurns& turns, const AmongTurning* turning,
                                      bool in_turning);
  void excuse_by_turning(const TraceStep& step, const detail::LaterParts& later, const WhatTurns& turns,
                         StepJudgement& judgement) const;
  [[nodiscard]] Path path_of(const TraceStep& step) const;
  /// Whether nothing differs from the last step, as at rest: then neither does the judgement.
  [[nodiscard]] bool repeats(const TraceStep& step, const Wanted* wanted) const;
  /// Whether the step begins where the last one ended, movers included.
  [[nodiscard]] bool continues(const TraceStep& step, const Place& start) const;
  void begin_episodes(const Place& start, bool goes_on);
  void leave_bodies_out(StepJudgement& judgement) const;
  /// Whether no solid is near enough to matter.
  [[nodiscard]] bool alone(const Path& path, const TraceStep& step) const;
  void judge_way(const Path& path, const TraceStep& step, const WhatTurns& turns, StepJudgement& judgement);
  void judge_end(const Path& path, Touched& touched, StepJudgement& judgement);
  [[nodiscard]] bool is_said_as_crush(const Place& end, ColliderIndex collider, const StepJudgement& judgement) const;
  void judge_passing(const Path& path, ColliderIndex collider, const Place& from, const Place& to, double depth,
                     StepJudgement& judgement) const;
  [[nodiscard]] double depth_of(const Path& path, ColliderIndex collider) const;
  [[nodiscard]] double way_past(const Path& path, ColliderIndex collider) const;
  void judge_crushes(const Path& path, const TraceStep& step, const Touched& touched, const WhatTurns& turns,
                     StepJudgement& judgement);
  void judge_sensors(const Path& path, const TraceStep& step, StepJudgement& judgement) const;
  void judge_progress(const detail::StepView& at, const Wanted* wanted, bool starts_free, StepJudgement& judgement);
  void judge_legs(const detail::StepView& at, const Wanted& wanted, const detail::LaterParts& later,
                  StepJudgement& judgement) const;
  /// How a step that begins inside of solids leaves them.
  struct Leaving {
    bool inside = false;   ///< The step begins inside of solids.
    bool at_once = false;  ///< Its first leg leaves one of them.
    bool free = false;     ///< That leg leaves all of them.
    bool longer = false;   ///< And there is a shorter way.
    bool turning = false;  ///< Something that turns is among them.
  };
  [[nodiscard]] Leaving leaving_of(const Path& path, const WhatTurns& turns, bool from_turning);
  [[nodiscard]] bool ends_on_another_side(const Place& at, const Vec2d& out) const;
  [[nodiscard]] double farthest_out(const Place& at) const;
  [[nodiscard]] bool has_way_out(const Place& at, const WhatTurns& turns);

  const TraceHeader header_;
  std::unique_ptr<detail::TurningJudge> turning_;
  std::shared_ptr<Sceneries> sceneries_;
  const ExactScenery& scenery_;
  std::size_t mover_count_ = 0;
  bool has_sensors_ = false;
  double rim_ = 0;
  bool promises_ = false;  ///< See `Party::promising`.
  Leaving leaving_;        ///< Of the step that is being judged.
  double dt_ = 0;          ///< Of the step that is being judged [s].
  std::map<ColliderIndex, Episode> inside_;
  std::optional<Kept> last_end_;
  Vec2d remainder_before_{Vec2d::Zero()};  ///< See `TraceStep::remainder`.
  /// The last step and what became of it, where no episode was open.
  struct Last {
    TraceStep step;
    std::optional<Wanted> wanted;
    StepJudgement judgement;
  };
  std::optional<Last> last_;
  /// The last place of which `has_way_out` was asked, and the answer.
  std::optional<std::pair<Kept, bool>> asked_way_out_;
};

}  // namespace paperproof::compare
