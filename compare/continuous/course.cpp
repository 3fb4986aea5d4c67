#include "continuous/course.hpp"

#include "contains.hpp"
#include "continuous/facets.hpp"
#include "continuous/input_times.hpp"
#include "continuous/mover_track.hpp"
#include "continuous/roots.hpp"

#include <algorithm>

namespace paperproof::compare::continuous {
namespace {

constexpr std::size_t most_events = 20000;
/// How many impacts one moment may have.
constexpr int most_at_once = 64;

void require(bool covered, const char* what) {
  if (!covered) throw NotCovered(std::string("the continuous reference has no law for ") + what);
}

void check(const Scene& scene, const std::vector<InputEvent>& input) {
  const CharacterDef& character = scene.character;
  require(character_count(scene) == 1, "several characters");
  require(scene.gravity.x() == 0 && scene.gravity.y() <= 0, "gravity that is not straight down");
  require(character.snap == 0, "ground that is followed down (snap)");
  require(character.step_height == 0, "stairs that are climbed (step_height)");
  const JumpRules& said = scene.jump_rules;
  require(!said.no_jump_toward_wall.value_or(character.no_jump_toward_wall) &&
              !said.side_hit_ends_rise.value_or(character.side_hit_ends_rise),
          "the article's rules for jumps");
  require(character.coyote_time == 0 && !character.jump_buffer && character.jump_cut == 1, "jumps that are helped");
  require(!scene.start.resolve_overlap, "a start inside a solid");
  for (const ColliderDef& collider : scene.scenery.colliders) {
    require(!collider.one_way, "one-way chains");
    require(collider.surface_speed == 0, "conveyors");
    require(collider.shape != ColliderDef::Shape::circle, "circles");
  }
  for (const MoverDef& mover : scene.movers) {
    require(!mover.body, "bodies that Box2D moves");
    require(mover.turns.empty(), "movers that turn");
  }
  for (const InputEvent& event : input) require(!event.drop.value_or(false), "dropping through");
}

/// The extent of a facet or a way, in double and widened: what does not meet it is not looked at more closely.
Box2 extent_of(std::initializer_list<Point> points) {
  Box2 extent = Box2::nowhere();
  for (const Point& point : points) {
    const Vec2d at = point.cast<double>();
    const Vec2d margin = Vec2d::Constant(1e-9) + 1e-12 * at.cwiseAbs();
    extent = extent.merged({at - margin, at + margin});
  }
  return extent;
}

class Solver {
 public:
  Solver(const Scene& scene, const std::vector<InputEvent>& input, Law law, Time time)
      : scene_(scene),
        law_(law),
        in_steps_(time == Time::in_steps),
        inputs_(scene, input),
        facets_(facets_of(scene)),
        legs_(scene.movers.size()) {
    for (const Facet& facet : facets_)
      extents_.push_back(extent_of({facet.begin, facet.begin + facet.along * facet.length}));
    place_ = point_of(scene.start.position);
    velocity_ = point_of(scene.start.velocity);
  }

  Course<Real> solve() {
    if (!in_steps_) step_end_ = inputs_.end();
    while (now_ < inputs_.end()) {
      if (course_.arcs.size() == most_events) throw NotCovered("more than 20,000 events");
      begins_ = in_steps_ && now_ == step_end_;
      if (begins_) begin_step();
      if (begins_ || !in_steps_) begin_legs();
      inputs_.take_until(now_);
      if (begins_) kick();
      if (in_steps_)
        settle_in_step();
      else
        settle();
      course_.arcs.push_back({now_, place_, velocity_, hold_.acceleration});
      advance();
      check_map();
    }
    return std::move(course_);
  }

 private:
  [[nodiscard]] Point carried_by(MoverIndex mover) const { return mover == no_mover ? Point{} : legs_[mover].velocity; }
  [[nodiscard]] Point offset_of(MoverIndex mover) const { return mover == no_mover ? Point{} : legs_[mover].offset; }

  void begin_step() {
    if (step_ > 0) {
      const std::vector<Touch> touches = touched();
      hold_.stands = wedged_ || touches_ground(touches);
      if (hold_.stands)
        find_carrier(touches);
      else
        carrier_ = no_mover;
    }
    dt_ = scene_.dt_list.empty() ? scene_.dt : scene_.dt_list[step_ % scene_.dt_list.size()];
    step_end_ += dt_;
    ++step_;
  }

  static bool touches_ground(const std::vector<Touch>& touches) {
    return std::ranges::any_of(touches, [](const Touch& at) { return at.walkable; });
  }

  [[nodiscard]] Leg leg_of(const MoverDef& mover) const {
    const Leg leg = leg_at(mover, now_);
    if (!in_steps_) return leg;
    return {leg.offset, (leg_at(mover, step_end_).offset - leg.offset) * (1 / dt_), step_end_};
  }

  /// What carries the character takes it along however suddenly it turns.
  void begin_legs() {
    const Point before = carrier_velocity();
    for (MoverIndex k = 0; k < legs_.size(); ++k) legs_[k] = leg_of(scene_.movers[k]);
    if (hold_.stands) velocity_ += carrier_velocity() - before;
    const std::optional<double>& fastest = scene_.character.max_fall_speed;
    require(!hold_.stands || !fastest || carrier_velocity().y() >= -*fastest,
            "ground that falls faster than the character");
  }
  [[nodiscard]] Point carrier_velocity() const { return carried_by(carrier_); }

  /// All facets that the position is on, with what it leaves at once left out.
  std::vector<Touch> touched() {
    std::vector<Touch> touches;
    const Box2 here = extent_of({place_});
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      const Facet& facet = facets_[i];
      if (facet.mover == no_mover && !here.overlaps(extents_[i])) continue;
      const Point from_begin = place_ - offset_of(facet.mover) - facet.begin;
      const Real at = from_begin.dot(facet.along);
      const Real& zero = same();
      if (abs(from_begin.dot(facet.normal)) > zero || at < -zero || at > facet.length + zero) continue;
      Touch touch{i, facet.normal, facet.walkable};
      const std::size_t other = at <= zero ? facet.before : at >= facet.length - zero ? facet.after : facet.none;
      if (other != facet.none) touch.corner = facets_[other].normal;
      const auto stays = [&](const Point& velocity) {
        const Point relative = velocity - carried_by(facet.mover);
        return relative.dot(touch.normal) <= zero * (1 + abs(relative.x()) + abs(relative.y()));
      };
      if (stays(velocity_) || (in_steps_ && stays(momentum_))) touches.push_back(touch);
    }
    return touches;
  }

  /// Takes the mover of what is touched as what carries. @throws NotCovered where that is not one.
  void find_carrier(const std::vector<Touch>& touches) {
    carrier_ = touches.empty() ? no_mover : facets_[touches.front().facet].mover;
    for (const Touch& touch : touches) {
      const MoverIndex mover = facets_[touch.facet].mover;
      require(mover == carrier_, "what is between a mover and something else");
      require(mover == no_mover || touch.walkable, "movers that are met by anything but their walkable side");
    }
  }

  /// Impacts, until none is left; then what holds, and jumps.
  void settle() {
    for (int round = 0; round < most_at_once; ++round) {
      if (jumped()) continue;  // off the ground that it stood on or fell upon, before steering leads it away
      limit_fall();
      const std::vector<Touch> touches = touched();
      find_carrier(touches);
      if (answer_impact(touches)) continue;
      hold_ = acceleration_of(law_, forces(), touches);
      require(!hold_.chatters, "ground that holds with the acceleration of the ground and not with that of the air");
      if (!hold_.stands) carrier_ = no_mover;
      if (jumped()) continue;
      follow(touches);
      return;
    }
    throw NotCovered("more than 64 impacts at one moment");
  }

  /// Steering and gravity of a step, as it begins. The climb of a walk that brakes slows with the walk.
  void kick() {
    const Forces acting = forces();
    const Point& own = acting.velocity;
    const Real most = (hold_.stands ? acting.on_ground : acting.in_air) * dt_;
    steered_ = std::clamp(acting.missing, Real(-most), most);
    if (hold_.stands && own.y() > 0 && steered_ * own.x() < 0)
      velocity_.y() -= own.y() * std::min(Real(-steered_ / own.x()), Real(1));
    (void)jumped();
    velocity_.y() -= acting.fall * dt_;
    if (const std::optional<double>& fastest = scene_.character.max_fall_speed)
      velocity_.y() = std::max(velocity_.y(), Real(carrier_velocity().y() - *fastest));
    momentum_ = velocity_;
    velocity_.x() += steered_;
    wedged_ = false;
  }

  void settle_in_step() {
    for (int round = 0; round < most_at_once; ++round) {
      const std::vector<Touch> touches = touched();
      find_carrier(touches);
      if (!answer_impact(touches)) return;
    }
    throw NotCovered("more than 64 impacts at one moment");
  }

  bool jumped() {
    if (!hold_.stands || !inputs_.jump()) return false;
    velocity_.y() = carrier_velocity().y() + scene_.character.jump_speed;
    hold_.stands = false;
    return true;
  }

  bool answer_impact(const std::vector<Touch>& touches) {
    const Point carried = carrier_velocity();
    const Point relative = velocity_ - carried;
    StepMotion after{relative, momentum_ - carried, steered_};
    if (in_steps_) {
      after = after_impact(law_, after, touches, hold_.stands && touches_ground(touches));
    } else {
      after.velocity = after_impact(law_, relative, touches, hold_.stands);
      if (scene_.gravity.y() < 0) after.velocity = without_climb(law_, after.velocity, touches);
    }
    if (after.velocity == relative) return false;
    wedged_ = in_steps_ && after.velocity == Point{} && momentum_.y() < carried.y();
    // A character that comes from straight above is carried at once.
    if (carrier_ != no_mover && !hold_.stands && velocity_.x() == 0) after = {};
    if (!begins_) ++course_.impacts;
    velocity_ = carried + after.velocity;
    momentum_ = carried + after.momentum;
    steered_ = after.steered;
    hold_.stands = hold_.stands || std::ranges::any_of(touches, [&](const Touch& at) {
                     return at.walkable && abs(after.velocity.dot(at.normal)) <= same() * (1 + abs(after.velocity.x()));
                   });
    return true;
  }

  /// Removes the component into held surfaces that rounding left in the velocity.
  void follow(const std::vector<Touch>& touches) {
    held_.clear();
    for (const Touch& touch : touches) {
      if (!contains(hold_.facets, touch.facet)) continue;
      held_.push_back(touch.facet);
      velocity_ -= touch.normal * (velocity_ - carrier_velocity()).dot(touch.normal);
    }
  }

  void limit_fall() {
    falls_fastest_ = false;
    if (!scene_.character.max_fall_speed) return;
    const Real least = carrier_velocity().y() - *scene_.character.max_fall_speed;
    require(!hold_.stands || velocity_.y() >= least, "walking down faster than the character may fall");
    falls_fastest_ = velocity_.y() <= least + same() * (1 + abs(least));
    if (falls_fastest_) velocity_.y() = least;
  }

  [[nodiscard]] Forces forces() const {
    Forces forces;
    forces.velocity = velocity_ - carrier_velocity();
    forces.fall = falls_fastest_ ? Real(0) : Real(-scene_.gravity.y());
    if (!inputs_.move()) return forces;
    forces.missing = *inputs_.move() * scene_.character.walk_speed - forces.velocity.x();
    forces.on_ground = scene_.character.acceleration;
    forces.in_air = scene_.character.air_acceleration.value_or(scene_.character.acceleration);
    return forces;
  }

  /// Goes to the next event.
  void advance() {
    const Point& a = hold_.acceleration;
    const Real planned = std::min(inputs_.next_after(now_), step_end_);
    Real until = planned - now_;
    const auto consider = [&](const std::optional<Real>& time) {
      if (time && *time < until) until = *time;
    };
    for (const Leg& leg : legs_)
      if (leg.until) consider(*leg.until - now_);
    const Forces now = forces();
    if (now.on_ground != 0 || now.in_air != 0) consider(time_to(now.missing, a.x()));
    if (scene_.character.max_fall_speed && !falls_fastest_)
      consider(time_to(-*scene_.character.max_fall_speed - now.velocity.y(), a.y()));
    consider(end_of_rise());
    for (const std::size_t i : held_) consider(end_of(facets_[i]));
    // A parabola lies within the triangle of its ends and of where their tangents cross.
    const Box2 way = extent_of(
        {place_, place_ + velocity_ * (until / 2), Point(place_ + velocity_ * until + a * (until * until / 2))});
    for (std::size_t i = 0; i < facets_.size(); ++i)
      if (facets_[i].mover != no_mover || way.overlaps(extents_[i])) consider(impact_with(facets_[i]));
    const bool as_planned = until == planned - now_;
    place_ += velocity_ * until + a * (until * until / 2);
    velocity_ += a * until;
    now_ = as_planned ? planned : now_ + until;
    for (Leg& leg : legs_) leg.offset += leg.velocity * until;
    if (abs(forces().missing) <= same() && inputs_.move()) velocity_.x() += forces().missing;
  }

  /// When something that changes evenly has changed by so much.
  static std::optional<Real> time_to(const Real& change, const Real& rate) {
    if (abs(change) <= same() || rate * change <= 0) return std::nullopt;
    return Real(change / rate);
  }

  /// Under a ceiling that holds it, rises and falls follow it differently; on the ground a walk that turns round on a
  /// slope is no longer held as one that brakes.
  [[nodiscard]] std::optional<Real> end_of_rise() const {
    const bool under = std::ranges::any_of(held_, [&](std::size_t i) { return facets_[i].normal.y() < 0; });
    if (under && velocity_.y() > 0) return time_to(-velocity_.y(), hold_.acceleration.y());
    const Point own = forces().velocity;
    return hold_.stands && own.y() > 0 ? time_to(-own.x(), hold_.acceleration.x()) : std::nullopt;
  }

  [[nodiscard]] Point from_begin_of(const Facet& facet) const { return place_ - offset_of(facet.mover) - facet.begin; }

  std::optional<Real> end_of(const Facet& facet) const {
    const Real at = from_begin_of(facet).dot(facet.along);
    const Real speed = (velocity_ - carried_by(facet.mover)).dot(facet.along);
    const Real change = hold_.acceleration.dot(facet.along);
    const std::optional<Real> back = falls_through_zero(at, speed, change);
    const std::optional<Real> forth = falls_through_zero(facet.length - at, -speed, -change);
    return !back || (forth && *forth < *back) ? forth : back;
  }

  std::optional<Real> impact_with(const Facet& facet) const {
    const Point from = from_begin_of(facet);
    const Point velocity = velocity_ - carried_by(facet.mover);
    const std::optional<Real> time =
        falls_through_zero(from.dot(facet.normal), velocity.dot(facet.normal), hold_.acceleration.dot(facet.normal));
    if (!time) return std::nullopt;
    const Point then = from + velocity * *time + hold_.acceleration * (*time * *time / 2);
    const Real at = then.dot(facet.along);
    return at >= -same() && at <= facet.length + same() ? time : std::nullopt;
  }

  /// A map that is left puts contenders back.
  void check_map() const {
    if (!scene_.respawn_box) return;
    const Vec2d at = place_.cast<double>();
    const Vec2d outside = (scene_.respawn_box->lower - at).cwiseMax(at - scene_.respawn_box->upper);
    require(outside.maxCoeff() <= 10, "a map that is left");
  }

  const Scene& scene_;
  Law law_;
  bool in_steps_;
  InputTimes inputs_;
  std::vector<Facet> facets_;
  std::vector<Box2> extents_;
  std::vector<Leg> legs_;

  Course<Real> course_;
  Real now_{0};
  Point place_;
  Point velocity_;
  Hold hold_;
  std::vector<std::size_t> held_;  ///< Facets.
  MoverIndex carrier_ = no_mover;
  bool falls_fastest_ = false;

  // In steps:
  std::size_t step_ = 0;  ///< The next one.
  Real dt_{0};            ///< Of the present one [s].
  Real step_end_{0};      ///< [s]
  bool begins_ = false;   ///< A step begins now.
  Point momentum_;        ///< See `StepMotion`.
  Real steered_{0};
  bool wedged_ = false;  ///< Its fall ended between surfaces.
};

}  // namespace

Course<Real> course_of(const Scene& scene, const std::vector<InputEvent>& input, Law law, Time time) {
  check(scene, input);
  const bool may_end = time == Time::continuous || scene.steps <= static_cast<int>(most_events);
  require(may_end, "more steps than it has events");  // known before the first one
  return Solver(scene, input, law, time).solve();
}

Course<double> rounded(const Course<Real>& course) {
  Course<double> made;
  for (const Arc<Real>& arc : course.arcs)
    made.arcs.push_back({static_cast<double>(arc.begin), arc.place.cast<double>(), arc.velocity.cast<double>(),
                         arc.acceleration.cast<double>()});
  made.impacts = course.impacts;
  return made;
}

}  // namespace paperproof::compare::continuous
