#include "level.hpp"

#include "float_geometry.hpp"
#include "shapes.hpp"

#include <paperproof/box2d/world_scenery.hpp>

#include <box2d/b2_body.h>
#include <box2d/b2_chain_shape.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_distance.h>
#include <box2d/b2_edge_shape.h>
#include <box2d/b2_polygon_shape.h>
#include <box2d/b2_world.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace paperproof::box2d {
namespace {

/// How much wider than asked the box is that is read [m]. Zero: each step reads another scenery. Large: each change of
/// the scenery costs more.
constexpr double read_ahead = 1.5;

/// A body that went so much farther than its velocity explains was put there by the game [m]. Zero: platforms that a
/// game moves by their place carry nobody. Large: a body that takes the address of another one sweeps the hero along.
constexpr double longest_jump = 0.5;

/// So many vertices of a chain are compared from step to step; of a longer chain as many, evenly.
constexpr int compared_vertices = 1024;

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
b2AABB rounded_outwards(const Box2<double>& box) {
  const auto slack = [](double value) { return 1e-3 + std::abs(value) * 1e-6; };
  b2AABB result;
  result.lowerBound = rounded(Vec2d(box.lower - Vec2d(slack(box.lower.x()), slack(box.lower.y()))));
  result.upperBound = rounded(Vec2d(box.upper + Vec2d(slack(box.upper.x()), slack(box.upper.y()))));
  return result;
}

/// Fowler, Noll, Vo: FNV-1a, over words.
class Hash {
 public:
  Hash& add(std::uint64_t word) noexcept {
    value_ = (value_ ^ word) * 0x100000001b3;
    return *this;
  }
  Hash& add(const b2Vec2& v) noexcept {
    return add(std::uint64_t{std::bit_cast<std::uint32_t>(v.x)} << 32U | std::bit_cast<std::uint32_t>(v.y));
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

std::uint64_t hash_of(const b2Shape& shape) {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(shape.GetType()));
  switch (shape.GetType()) {
    case b2Shape::e_circle: {
      const auto& circle = static_cast<const b2CircleShape&>(shape);
      return hash.add(circle.m_p).add(b2Vec2(circle.m_radius, 0)).value();
    }
    case b2Shape::e_edge: {
      const auto& edge = static_cast<const b2EdgeShape&>(shape);
      return hash.add(edge.m_vertex1).add(edge.m_vertex2).value();
    }
    case b2Shape::e_polygon: {
      const auto& polygon = static_cast<const b2PolygonShape&>(shape);
      for (int i = 0; i < polygon.m_count; ++i) hash.add(polygon.m_vertices[i]);
      return hash.value();
    }
    case b2Shape::e_chain: {
      const auto& chain = static_cast<const b2ChainShape&>(shape);
      hash.add(static_cast<std::uint64_t>(chain.m_count));
      const int every = chain.m_count / compared_vertices + 1;
      for (int i = 0; i < chain.m_count; i += every) hash.add(chain.m_vertices[i]);
      return hash.value();
    }
    case b2Shape::e_typeCount:
      break;
  }
  return hash.value();
}

Vec2d turned(const Vec2d& v, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

b2Transform transform_at(const Vec2d& position, double angle) {
  b2Transform transform;
  transform.Set(rounded(position), static_cast<float>(angle));
  return transform;
}

Box2<double> box_around(std::span<const Vec2d> points) {
  Box2<double> box{points[0], points[0]};
  for (const Vec2d& point : points) box = box.merged({point, point});
  return box;
}

/// The runs of segments of a chain that are near a box.
std::vector<ColliderDef> cut_to(const Box2<double>& box, const ColliderDef& chain) {
  std::vector<ColliderDef> runs;
  bool goes_on = false;
  for (std::size_t i = 0; i + 1 < chain.points.size(); ++i) {
    const bool near = box.overlaps(box_around(std::span(chain.points).subspan(i, 2)));
    if (near && !goes_on) {
      runs.push_back({.shape = ColliderDef::Shape::chain, .points = {chain.points[i]}});
    }
    if (near) runs.back().points.push_back(chain.points[i + 1]);
    goes_on = near;
  }
  return runs;
}

}  // namespace

Vec2d place_of(const b2Body& body) {
  b2Fixture* fixture = const_cast<b2Body&>(body).GetFixtureList();  // its user data cannot be read otherwise
  const bool is_hero =
      body.GetType() == b2_dynamicBody && fixture != nullptr && fixture->GetShape()->m_radius == -hero_inset;
  return is_hero ? *reinterpret_cast<const Vec2d*>(fixture->GetUserData().pointer) : widened(body.GetPosition());
}

bool Level::Seen::operator==(const Seen& other) const noexcept {
  return fixture == other.fixture && body == other.body && shape == other.shape && geometry == other.geometry &&
         place == other.place && angle == other.angle && spin == other.spin && moves == other.moves &&
         sensor == other.sensor && surface == other.surface;
}

bool Level::follow(const Box2<double>& box, const HeroDef& def, const Stance& stance, double dt) {
  const Vec2d spare = (box_.upper - box_.lower) - (box.upper - box.lower);
  const bool is_read = box_.contains(box) && spare.maxCoeff() <= 4 * read_ahead;
  if (!is_read) box_ = box.inflated(read_ahead);
  seen_.swap(seen_before_);
  look(def);
  const bool same = seen_ == seen_before_ && stance.up == up_ && (is_read || !is_cut_);
  if (!same) build(def, stance.up);
  motions_.clear();
  for (const Mover& mover : movers_) motions_.push_back(motion_of(mover, stance, dt));
  return !same;
}

void Level::look(const HeroDef& def) {
  found_.clear();
  Collector collector(found_);
  world_->QueryAABB(&collector, rounded_outwards(box_));
  std::sort(found_.begin(), found_.end());  // a chain is found once for each of its segments
  found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
  const Filter filter = filter_of(*hero_->GetFixtureList());
  seen_.clear();
  for (b2Fixture* fixture : found_) {
    if (fixture->GetBody() == hero_ || !collide(filter, filter_of(*fixture))) continue;
    const Seen one = seen(*fixture, def);
    if (one.surface.blocks != Blocking::not_at_all) seen_.push_back(one);
  }
}

Level::Seen Level::seen(b2Fixture& fixture, const HeroDef& def) const {
  b2Body& body = *fixture.GetBody();
  Seen result{.fixture = &fixture,
              .body = &body,
              .shape = fixture.GetShape(),
              .geometry = hash_of(*fixture.GetShape()),
              .angle = body.GetAngle(),
              .moves = body.GetType() != b2_staticBody,
              .sensor = fixture.IsSensor(),
              .surface = {}};
  if (!result.moves) {
    result.place = body.GetPosition();
  } else if (fixture.GetType() == b2Shape::e_circle) {
    result.angle = 0;
    result.spin = body.GetAngularVelocity();
  }
  if (def.surface_of && !result.sensor) result.surface = def.surface_of(fixture);
  return result;
}

void Level::build(const HeroDef& def, const Vec2d& up) {
  up_ = up;
  is_cut_ = false;
  skipped_.clear();
  scenery_.colliders.clear();
  fixtures_.clear();
  movers_.clear();
  struct PlacedCollider {
    Box2<double> box;  ///< In the world.
    const Seen* seen;
    ColliderDef collider;
  };
  std::vector<PlacedCollider> parts;
  for (const Seen& one : seen_) {
    const bool is_wheel = one.moves && one.shape->GetType() == b2Shape::e_circle;
    b2Transform transform = one.body->GetTransform();
    if (one.moves) transform.p.SetZero();
    if (is_wheel) transform = transform_at(-widened(static_cast<const b2CircleShape&>(*one.shape).m_p), 0);
    const ColliderDef whole = box2d::collider_of(*one.shape, transform, def.circle_corners);
    const bool is_long = one.shape->GetType() == b2Shape::e_chain && !one.moves && !one.sensor &&
                         one.surface.blocks == Blocking::from_everywhere;
    is_cut_ = is_cut_ || is_long;
    const Vec2d offset = one.moves ? place_of(*one.body) : Vec2d(0, 0);
    for (const ColliderDef& collider : is_long ? cut_to(box_, whole) : std::vector{whole}) {
      const Box2<double> box = box_around(collider.points);
      parts.push_back({{box.lower + offset, box.upper + offset}, &one, collider});
    }
  }
  // Not in the order of the addresses: steps must be the same in each run of a game.
  std::sort(parts.begin(), parts.end(), [](const PlacedCollider& a, const PlacedCollider& b) {
    const auto key = [](const PlacedCollider& part) {
      return std::tuple(part.seen->moves, part.box.lower.x(), part.box.lower.y(), part.box.upper.x(),
                        part.box.upper.y(), part.collider.points.size());
    };
    return key(a) < key(b);
  });
  for (PlacedCollider& part : parts) add(*part.seen, std::move(part.collider), up);
}

void Level::add(const Seen& seen, ColliderDef collider, const Vec2d& up) {
  collider.sensor = seen.sensor;
  collider.surface_speed = seen.surface.speed;
  if (seen.spin != 0) {
    const float radius = static_cast<const b2CircleShape&>(*seen.shape).m_radius;
    collider.surface_speed -= static_cast<double>(seen.spin) * static_cast<double>(radius);
  }
  if (seen.moves) collider.mover = mover_of(seen);
  if (seen.surface.blocks == Blocking::from_above) collider.one_way = up;
  scenery_.colliders.push_back(std::move(collider));
  fixtures_.push_back(seen.fixture);
}

MoverIndex Level::mover_of(const Seen& seen) {
  const Mover mover{seen.body, seen.shape->GetType() == b2Shape::e_circle ? seen.fixture : nullptr};
  const auto known = std::find(movers_.begin(), movers_.end(), mover);
  const auto index = static_cast<MoverIndex>(known - movers_.begin());
  if (known == movers_.end()) movers_.push_back(mover);
  return index;
}

void Level::skip(ColliderIndex collider) {
  skipped_.push_back(fixtures_[collider]);
  scenery_.colliders.erase(scenery_.colliders.begin() + collider);
  fixtures_.erase(fixtures_.begin() + collider);
  // A mover that moves nothing any more goes, too: their numbers have no gaps.
  for (MoverIndex mover = static_cast<MoverIndex>(movers_.size()); mover-- > 0;) {
    auto& colliders = scenery_.colliders;
    if (std::any_of(colliders.begin(), colliders.end(), [&](const ColliderDef& one) { return one.mover == mover; }))
      continue;
    movers_.erase(movers_.begin() + mover);
    motions_.erase(motions_.begin() + mover);
    for (ColliderDef& one : colliders)
      if (one.mover != no_mover && one.mover > mover) --one.mover;
  }
}

ColliderIndex Level::collider_of(const b2Fixture* fixture) const noexcept {
  const auto found = std::find(fixtures_.begin(), fixtures_.end(), fixture);
  return found == fixtures_.end() ? no_collider : static_cast<ColliderIndex>(found - fixtures_.begin());
}

void Level::note_poses() {
  poses_.clear();
  for (const Seen& one : seen_) {
    if (!one.moves || (!poses_.empty() && poses_.back().body == one.body)) continue;
    const double speed = widened(one.body->GetLinearVelocity()).norm();
    poses_.push_back({one.body, place_of(*one.body), static_cast<double>(one.body->GetAngle()), speed});
  }
}

void Level::shift_origin(const Vec2d& new_origin) {
  for (BodyPose& pose : poses_) pose.position -= new_origin;
  box_ = {Vec2d::Constant(1), Vec2d::Constant(-1)};
}

BodyPose Level::begin_of(const b2Body& body, double dt) const {
  const Vec2d now = place_of(body);
  const double angle = static_cast<double>(body.GetAngle());
  Vec2d way = widened(body.GetLinearVelocity()) * dt;
  const auto known =
      std::find_if(poses_.begin(), poses_.end(), [&](const BodyPose& pose) { return pose.body == &body; });
  if (known != poses_.end()) {
    const double explained = std::max(way.norm(), known->speed * dt) + longest_jump;
    if ((now - known->position).norm() <= explained) return *known;
  }
  if (!body.IsAwake() || !body.IsEnabled()) return {&body, now, angle};
  if (way.norm() > b2_maxTranslation) way *= b2_maxTranslation / way.norm();
  return {&body, now - way, angle - static_cast<double>(body.GetAngularVelocity()) * dt};
}

MoverMotion<double> Level::motion_of(const Mover& mover, const Stance& stance, double dt) const {
  const b2Body& body = *mover.body;
  const Vec2d to = place_of(body);
  const double angle = static_cast<double>(body.GetAngle());
  const BodyPose begin = begin_of(body, dt);
  if (mover.circle != nullptr) {
    const Vec2d centre = widened(static_cast<const b2CircleShape*>(mover.circle->GetShape())->m_p);
    return {begin.position + turned(centre, begin.angle), to + turned(centre, angle)};
  }
  if (begin.angle == angle) return {begin.position, to};
  const Vec2d still = pivot(begin, body, angle - begin.angle, stance);
  return {still - turned(still - begin.position, angle - begin.angle), to};
}

Vec2d Level::pivot(const BodyPose& begin, const b2Body& body, double turn, const Stance& stance) const {
  if (&body == stance.ground) {
    // The lowest corner on the ground as it is turned at the end: there the hero stands.
    const Vec2d down = -turned(stance.normal, turn);
    const Vec2d foot = *std::max_element(stance.hull.begin(), stance.hull.end(),
                                         [&](const Vec2d& a, const Vec2d& b) { return a.dot(down) < b.dot(down); });
    return stance.position + foot;
  }
  std::array<b2Vec2, CharacterShape::max_points> corners;
  for (std::size_t i = 0; i < stance.hull.size(); ++i) corners[i] = rounded(stance.hull[i]);
  b2DistanceInput input;
  input.proxyA.Set(corners.data(), static_cast<int>(stance.hull.size()), 0);
  input.transformA = transform_at(stance.position, 0);
  input.transformB = transform_at(begin.position, begin.angle);
  input.useRadii = false;
  b2DistanceOutput nearest;
  nearest.pointB = input.transformB.p;
  nearest.distance = std::numeric_limits<float>::max();
  for (const Seen& one : seen_) {
    for (int child = 0; one.body == &body && child < one.shape->GetChildCount(); ++child) {
      input.proxyB.Set(one.shape, child);
      b2SimplexCache cache;
      cache.count = 0;
      b2DistanceOutput output;
      b2Distance(&output, &cache, &input);
      if (output.distance < nearest.distance) nearest = output;
    }
  }
  return widened(nearest.pointB);
}

bool Level::has_turned(ColliderIndex collider) const noexcept {
  const b2Body* body = fixtures_[collider]->GetBody();
  const auto known =
      std::find_if(poses_.begin(), poses_.end(), [&](const BodyPose& pose) { return pose.body == body; });
  return known == poses_.end() || known->angle != static_cast<double>(body->GetAngle());
}

}  // namespace paperproof::box2d
