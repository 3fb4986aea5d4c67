#include "near_fixtures.hpp"

#include "float_geometry.hpp"
#include "shapes.hpp"

#include <box2d/b2_body.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_world.h>
#include <box2d/b2_world_callbacks.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

namespace paperproof::box2d {
namespace {

/// How far into a one-sided chain a hero may be that the chain lifts out [m]. Zero: rounding lets the hero through.
/// Large: a hero that jumps up through it is lifted sooner.
constexpr double most_lifted = 0.05;

/// A body that went so much farther than its velocity explains [m], or turned so much more [radians], was put there by
/// the game. Zero: platforms that a game moves by their place carry nobody. Large: a body that takes the address of
/// another one, or is turned round by the game, sweeps the hero along.
constexpr double longest_jump = 0.5;

class Collector : public b2QueryCallback {
 public:
  explicit Collector(std::vector<b2Fixture*>& found) noexcept : found_(found) {}
  bool ReportFixture(b2Fixture* fixture) override {
    found_.push_back(fixture);
    return true;
  }

 private:
  std::vector<b2Fixture*>& found_;
};

/// Not smaller than the box in double.
b2AABB rounded_outwards(const Box2& box) {
  const auto slack = [](const Vec2d& corner) { return Vec2d(1e-3 + corner.array().abs() * 1e-6); };
  b2AABB result;
  result.lowerBound = rounded(Vec2d(box.lower - slack(box.lower)));
  result.upperBound = rounded(Vec2d(box.upper + slack(box.upper)));
  return result;
}

/// Of a shape's numbers: a game may change them in place. (Fowler, Noll, Vo: FNV-1a, over words.)
std::uint64_t hash_of(const b2Shape& shape) {
  const auto add = [](std::uint64_t& hash, std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3; };
  std::array<b2Vec2, 2> room;
  const std::span<const b2Vec2> points = points_of(shape, room);
  std::array<std::uint64_t, 4> lanes{};  // side by side they take a fourth of the time
  for (std::size_t i = 0; i < points.size(); ++i) add(lanes[i % 4], std::bit_cast<std::uint64_t>(points[i]));
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::uint64_t lane : lanes) add(hash, lane);
  for (const std::size_t word : {points.size(), std::size_t{shape.GetType()}, std::size_t{is_one_sided(shape)}})
    add(hash, word);
  add(hash, std::bit_cast<std::uint32_t>(shape.m_radius));
  return hash;
}

/// A place of its own, without a turn.
b2Transform at(const b2Vec2& place) {
  b2Transform transform;
  transform.Set(place, 0);
  return transform;
}

/// A circle about the origin of its body.
bool is_wheel(const b2Fixture& fixture) {
  return fixture.GetType() == b2Shape::e_circle &&
         static_cast<const b2CircleShape*>(fixture.GetShape())->m_p == b2Vec2_zero;
}

/// Whether two sets of points overlap where they are seen along a direction.
bool overlap_across(const Vec2d& direction, std::span<const Vec2d> some, std::span<const Vec2d> others) {
  const auto range_of = [&](std::span<const Vec2d> points) {
    const auto place = [&](const Vec2d& point) { return point.dot(Vec2d(direction.y(), -direction.x())); };
    const auto [least, most] = std::ranges::minmax_element(points, {}, place);
    return std::pair(place(*least), place(*most));
  };
  const auto [least, most] = range_of(some);
  const auto [other_least, other_most] = range_of(others);
  return least <= other_most && other_least <= most;
}

/// The runs of segments of a chain that are near a box. Of a one-way chain those before and behind the box, too: they
/// tell on which side a character is.
std::vector<ColliderDef> cut_to(const Box2& box, const ColliderDef& chain) {
  const std::array corners{box.lower, Vec2d(box.upper.x(), box.lower.y()), box.upper,
                           Vec2d(box.lower.x(), box.upper.y())};
  const auto is_near = [&](std::span<const Vec2d> segment) {
    if (chain.one_way) return overlap_across(*chain.one_way, corners, segment);
    return box.overlaps(Box2::around(segment));
  };
  std::vector<ColliderDef> runs;
  bool goes_on = false;
  for (std::size_t i = 0; i + 1 < chain.points.size(); ++i) {
    const bool near = is_near(std::span(chain.points).subspan(i, 2));
    if (near && !goes_on) {
      runs.push_back(chain);
      runs.back().points = {chain.points[i]};
    }
    if (near) runs.back().points.push_back(chain.points[i + 1]);
    goes_on = near;
  }
  return runs;
}

/// Each hero of the program. Neither the body nor its fixture has a place for it: their user data are the game's.
/// Worlds may be stepped in threads of their own.
struct AllHeroes {
  std::mutex mutex;
  std::map<const b2Body*, HeroInWorld> of_body;
};

AllHeroes& all_heroes() {
  static AllHeroes all;
  return all;
}

/// @return nothing of a body that is no hero's.
HeroInWorld hero_of(const b2Body& body) {
  if (body.GetFixtureList() == nullptr || !is_of_hero(*body.GetFixtureList())) return {};
  const std::lock_guard lock(all_heroes().mutex);
  const auto found = all_heroes().of_body.find(&body);
  return found != all_heroes().of_body.end() ? found->second : HeroInWorld{};
}

}  // namespace

void note_hero(const b2Body& body, const HeroInWorld& hero) {
  const std::lock_guard lock(all_heroes().mutex);
  if (hero.place != nullptr)
    all_heroes().of_body[&body] = hero;
  else
    all_heroes().of_body.erase(&body);
}

Vec2d place_of(const b2Body& body) {
  if (const HeroInWorld hero = hero_of(body); hero.place != nullptr) return *hero.place;
  return widened(body.GetPosition());
}

void NearFixtures::begin_step(const HeroDef& def, const Vec2d& up, double dt, const CharacterState& state,
                              std::span<const HeroContact> contacts) {
  def_ = &def;
  up_ = up;
  dt_ = dt;
  begin_ = state;
  touched_.clear();
  if (state.ground.state != GroundState::air) touched_.push_back(fixture_of(state.ground.collider));
  for (const HeroContact& contact : contacts)
    if (contact.change != HeroContact::Change::removed) touched_.push_back(contact.fixture);
}

/// @param known as it was seen last, or as another fixture at its address was. Its chain and front are renewed.
NearFixtures::Seen NearFixtures::seen(b2Fixture& fixture, Known& known, const Box2& box) const {
  const b2Body& body = *fixture.GetBody();
  Seen result{.body = &body,
              .shape = fixture.GetShape(),
              .geometry = hash_of(*fixture.GetShape()),
              .moves = body.GetType() != b2_staticBody,
              .sensor = fixture.IsSensor(),
              .surface = {}};
  if (!result.moves) {
    result.place = body.GetPosition();
    result.angle = body.GetAngle();
  }
  if (result.sensor) return result;
  if (def_->surface_of) result.surface = def_->surface_of(fixture);
  if (result.surface.blocks == Blocking::from_above)
    result.one_way = result.moves ? Vec2d(Eigen::Rotation2Dd(-begin_of(body).angle) * up_) : up_;
  if (result.surface.blocks == Blocking::as_in_box2d && is_one_sided(*result.shape)) {
    const Seen& before = known.seen;
    const bool is_same = before.shape == result.shape && before.geometry == result.geometry &&
                         before.moves == result.moves && before.place == result.place && before.angle == result.angle;
    if (!is_same || known.chain.empty()) {
      known.chain = collider_of(*result.shape, result.moves ? at({0, 0}) : body.GetTransform()).points;
      known.front = front_of(known.chain);
    }
    result.one_way = one_way_of(fixture, known);
  }
  const bool is_long = fixture.GetType() == b2Shape::e_chain && !result.moves;
  if (is_long && result.surface.blocks != Blocking::from_above) result.cut = {box.lower, box.upper};
  return result;
}

/// The side from which alone a one-sided fixture blocks in this step, as its body sees it. Nothing: it blocks from
/// everywhere. It does so while the hero is in front of it, so that its ends and joints hold the hero as those of any
/// fixture. If the middle of the hero is in front, it lifts out a hero that is in it by little, was placed there,
/// touched it in the last step, or stood: the game may have moved it, or made the ground anew. What turns or may tumble
/// always blocks from everywhere.
std::optional<Vec2d> NearFixtures::one_way_of(const b2Fixture& fixture, const Known& known) const {
  const b2Body& body = *fixture.GetBody();
  const bool moves = body.GetType() != b2_staticBody;
  if (!known.front || body.GetType() == b2_dynamicBody || (moves && body.GetAngularVelocity() != 0))
    return std::nullopt;
  const BodyPose begin = moves ? begin_of(body) : BodyPose{};
  const Eigen::Rotation2Dd turn(begin.angle);
  const auto seen_from_body = [&](const Vec2d& point) { return Vec2d(turn.inverse() * (point - begin.position)); };
  const auto is_ahead = [&](std::span<const Vec2d> points, double by) {
    std::vector<Vec2d> there;
    for (const Vec2d& point : points) there.emplace_back(seen_from_body(begin_.position + point) + *known.front * by);
    return is_in_front(there, known.chain, *known.front);
  };
  const std::span<const Vec2d> hull = def_->character.shape.hull();
  if (is_ahead(hull, 0)) return std::nullopt;
  const bool is_ground = begin_.grounded && Vec2d(turn * *known.front).dot(up_) > 0;
  const bool is_known =
      !begin_.has_last_free || is_ground || std::find(touched_.begin(), touched_.end(), &fixture) != touched_.end();
  const Vec2d middle = def_->character.shape.box().middle();
  if (is_ahead({&middle, 1}, 0) && (is_known || is_ahead(hull, most_lifted))) return std::nullopt;
  return known.front;
}

void NearFixtures::search(const Box2& box) {
  hits_.clear();
  near_.clear();
  Collector collector(hits_);
  world_->QueryAABB(&collector, rounded_outwards(box));
  for (b2Body* body : party_)
    if (shown_.contains(body)) hits_.push_back(body->GetFixtureList());
  std::sort(hits_.begin(), hits_.end());  // a chain is found once for each of its segments
  hits_.erase(std::unique(hits_.begin(), hits_.end()), hits_.end());
  b2ContactFilter* filter = world_->GetContactManager().m_contactFilter;
  std::vector<Near> changed;
  for (b2Fixture* fixture : hits_) {
    if (fixture->GetBody() == hero_) continue;
    if (filter != nullptr && !filter->ShouldCollide(hero_->GetFixtureList(), fixture)) continue;
    Known& known = known_[fixture];
    const Seen now = seen(*fixture, known, box);
    const bool is_other = known.seen.body != nullptr && (known.seen.body != now.body || known.seen.shape != now.shape);
    const bool is_gone = now.surface.blocks == Blocking::not_at_all;
    if (is_other || is_gone) {  // another one is at the same address
      take_out(known);
      known = {};
    }
    if (is_gone) continue;
    near_.push_back({fixture, &known});
    if (known.seen == now) continue;
    known.seen = now;
    changed.push_back(near_.back());
  }
  if (known_.size() > near_.size())
    std::erase_if(known_, [&](const auto& entry) {
      if (is_near(entry.first)) return false;
      take_out(entry.second);
      return true;
    });
  // Not in the order of the addresses: steps must be the same in each run of a game.
  const auto key = [](const Near& near) {
    const b2AABB& extent = near.fixture->GetAABB(0);
    return std::tuple(extent.lowerBound.x, extent.lowerBound.y, extent.upperBound.x, extent.upperBound.y);
  };
  std::sort(changed.begin(), changed.end(), [&](const Near& a, const Near& b) { return key(a) < key(b); });
  free_movers();
  for (const Near& near : changed) define(near);
}

/// Bodies that are not near leave their movers to others.
void NearFixtures::free_movers() {
  std::erase_if(movers_, [&](const auto& entry) {
    const auto is_its = [&](const Near& near) {
      return near.known->seen.moves && near.known->seen.body == entry.first;
    };
    if (std::any_of(near_.begin(), near_.end(), is_its)) return false;
    free_movers_.push_back(entry.second);
    return true;
  });
}

MoverIndex NearFixtures::mover_of(const b2Fixture& fixture) {
  const b2Body* body = fixture.GetBody();
  if (body->GetType() == b2_staticBody) return no_mover;
  auto known = movers_.find(body);
  if (known == movers_.end()) {
    if (free_movers_.empty()) free_movers_.push_back(static_cast<MoverIndex>(2 * movers_.size()));
    known = movers_.emplace(body, free_movers_.back()).first;
    free_movers_.pop_back();
  }
  return known->second + (is_wheel(fixture) ? 1 : 0);
}

/// Makes the colliders of a fixture. Those that it had keep their ids.
void NearFixtures::define(const Near& near) {
  const Seen& seen = near.known->seen;
  ColliderDef whole = collider_of(*seen.shape, seen.moves ? at({0, 0}) : seen.body->GetTransform());
  if (const HeroInWorld hero = hero_of(*seen.body); hero.shape != nullptr)
    whole.points.assign(hero.shape->hull().begin(), hero.shape->hull().end());
  whole.sensor = seen.sensor;
  whole.surface_speed = seen.surface.speed;
  if (seen.one_way && whole.shape == ColliderDef::Shape::circle) whole = polygon_around(whole);
  whole.one_way = seen.one_way;
  whole.mover = mover_of(*near.fixture);
  const bool is_cut = seen.cut[0] != seen.cut[1];
  put(is_cut ? cut_to({seen.cut[0], seen.cut[1]}, whole) : std::vector{std::move(whole)}, near);
}

void NearFixtures::put(const std::vector<ColliderDef>& defs, const Near& near) {
  Known& known = *near.known;
  known.is_unusable = false;
  for (; known.parts.size() > defs.size(); known.parts.pop_back()) level_.remove(known.parts.back());
  for (std::size_t i = 0; i < defs.size(); ++i) {
    try {
      if (i < known.parts.size())
        level_.replace(known.parts[i], defs[i]);
      else
        known.parts.push_back(level_.add(defs[i]));
    } catch (const InvalidScenery&) {
      take_out(known);
      known.parts.clear();
      known.is_unusable = true;
      return;
    }
    fixture_of_slot_.resize(level_.collider_count());
    fixture_of_slot_[Level::slot_of(known.parts[i])] = near.fixture;
  }
}

void NearFixtures::take_out(const Known& known) {
  for (const ColliderIndex part : known.parts) level_.remove(part);
}

void NearFixtures::read(const Box2& box) {
  search(box);
  motions_.assign(std::max(level_.mover_count(), 2 * (movers_.size() + free_movers_.size())), {});
  for (const Near& near : near_)
    if (near.known->seen.moves) motions_[mover_of(*near.fixture)] = motion_of(*near.fixture);
}

bool NearFixtures::is_there(ColliderIndex id) const {
  const b2Body* body = body_of(id);
  return shown_.contains(body) || std::find(party_.begin(), party_.end(), body) == party_.end();
}

std::vector<b2Fixture*> NearFixtures::unusable() const {
  std::vector<b2Fixture*> all;
  for (const Near& near : near_)
    if (near.known->is_unusable) all.push_back(near.fixture);
  return all;
}

b2Fixture* NearFixtures::fixture_of(ColliderIndex id) const noexcept {
  return level_.has(id) ? fixture_of_slot_[Level::slot_of(id)] : nullptr;
}

const b2Body* NearFixtures::body_of(ColliderIndex id) const noexcept {
  const auto known = known_.find(fixture_of(id));
  return known == known_.end() ? nullptr : known->second.seen.body;
}

ColliderIndex NearFixtures::id_of(b2Fixture* fixture) const {
  const auto known = known_.find(fixture);
  return known == known_.end() || known->second.parts.empty() ? no_collider : known->second.parts[0];
}

bool NearFixtures::is_near(const b2Fixture* fixture) const noexcept {
  return std::any_of(near_.begin(), near_.end(), [&](const Near& near) { return near.fixture == fixture; });
}

bool NearFixtures::any_sensor() const noexcept {
  return std::any_of(near_.begin(), near_.end(), [](const Near& near) { return near.known->seen.sensor; });
}

void NearFixtures::note_poses() {
  poses_.clear();
  for (const Near& near : near_) {
    const b2Body& body = *near.fixture->GetBody();
    const bool is_known = std::ranges::find(poses_, &body, &BodyPose::body) != poses_.end();
    if (body.GetType() == b2_staticBody || is_known) continue;
    const double speed = widened(body.GetLinearVelocity()).norm();
    const double spin = static_cast<double>(body.GetAngularVelocity());
    poses_.push_back({&body, place_of(body), static_cast<double>(body.GetAngle()), speed, spin});
  }
}

void NearFixtures::shift_origin(const Vec2d& new_origin) {
  for (BodyPose& pose : poses_) pose.position -= new_origin;
}

BodyPose NearFixtures::begin_of(const b2Body& body) const {
  const Vec2d now = place_of(body);
  const double angle = static_cast<double>(body.GetAngle());
  Vec2d way = widened(body.GetLinearVelocity()) * dt_;
  const double turn = static_cast<double>(body.GetAngularVelocity()) * dt_;
  const auto known = std::ranges::find(poses_, &body, &BodyPose::body);
  if (known != poses_.end()) {
    const double explained = std::max(way.norm(), known->speed * dt_) + longest_jump;
    const double turn_explained = std::max(std::abs(turn), std::abs(known->spin) * dt_) + longest_jump;
    if ((now - known->position).norm() <= explained && std::abs(angle - known->angle) <= turn_explained) return *known;
  }
  if (!body.IsAwake() || !body.IsEnabled()) return {&body, now, angle};
  if (way.norm() > b2_maxTranslation) way *= b2_maxTranslation / way.norm();
  return {&body, now - way, angle - turn};
}

MoverMotion NearFixtures::motion_of(b2Fixture& fixture) const {
  const b2Body& body = *fixture.GetBody();
  if (const auto shown = shown_.find(&body); shown != shown_.end()) return shown->second;
  const BodyPose begin = begin_of(body);
  const double angle = static_cast<double>(body.GetAngle());
  MoverMotion motion{begin.position, place_of(body), begin.angle, angle};
  // A wheel turns as fast as its body says: angles in float tell that only roughly, and its place does not depend on
  // them.
  if (is_wheel(fixture)) motion.from_angle = angle - static_cast<double>(body.GetAngularVelocity()) * dt_;
  return motion;
}

}  // namespace paperproof::box2d
