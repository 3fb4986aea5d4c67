#include "hero_impl.hpp"
#include "shapes.hpp"

#include <box2d/b2_contact.h>
#include <box2d/b2_distance.h>
#include <box2d/b2_polygon_shape.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace paperproof::box2d {
namespace {

/// How far from the hero its body may be [m]. Less than 9 mm: a ball is not touched. Large: a hero that a crush left
/// inside a body pushes that body away at once.
constexpr double most_off = 0.02;

/// How much larger the body is than the hero [m]. A hero stands 5e-7 m above its ground. A body so near would make
/// Box2D take it there in eight sub-steps of every step. What a body overlaps already, Box2D does not take it to.
constexpr float larger = 2e-4F;

/// Moves the sides of a polygon outwards.
void grow(b2PolygonShape& shape, float by) {
  for (int32 i = 0; i < shape.m_count; ++i) {
    const b2Vec2& next = shape.m_normals[i];
    const b2Vec2& last = shape.m_normals[i == 0 ? shape.m_count - 1 : i - 1];
    shape.m_vertices[i] += by / (1 + b2Dot(last, next)) * (last + next);
  }
}

/// The separation of two fixtures as Box2D sees them, skins included, where one is moved [m].
double separation(const b2Fixture& moved, const Vec2d& to, const b2Fixture& other) {
  b2DistanceInput input;
  input.proxyA.Set(moved.GetShape(), 0);
  input.transformA.Set(rounded(to), 0);
  input.transformB = other.GetBody()->GetTransform();
  input.useRadii = false;
  float least = std::numeric_limits<float>::max();
  for (int child = 0; child < other.GetShape()->GetChildCount(); ++child) {
    input.proxyB.Set(other.GetShape(), child);
    b2SimplexCache cache;
    cache.count = 0;
    b2DistanceOutput output;
    b2Distance(&output, &cache, &input);
    least = std::min(least, output.distance);
  }
  return static_cast<double>(least - moved.GetShape()->m_radius - other.GetShape()->m_radius);
}

/// Dynamic bodies that touch a body, with the normal towards it.
template <class Each>
void for_each_touching(b2Body& body, const Each& each) {
  for (const b2ContactEdge* edge = body.GetContactList(); edge != nullptr; edge = edge->next) {
    b2Contact& contact = *edge->contact;
    if (!contact.IsTouching() || !contact.IsEnabled() || edge->other->GetType() != b2_dynamicBody) continue;
    if (contact.GetManifold()->pointCount == 0) continue;  // a sensor: Box2D leaves its normal as it was in memory
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    const double side = contact.GetFixtureB()->GetBody() == &body ? 1 : -1;
    each(*edge->other, Vec2d(side * widened(manifold.normal)),
         std::span(manifold.points, static_cast<std::size_t>(contact.GetManifold()->pointCount)));
  }
}

}  // namespace

b2Body& Hero::Impl::make_body(b2World& world, const HeroDef& def) {
  require_number(def.position, "position of a hero: must be within 1e6 m");
  const double mass = def.mass.value_or(1);
  const double push_force = def.push_force.value_or(0);
  require(mass >= 1e-6 && mass <= 1e9, "mass of a hero: must be from 1e-6 to 1e9 kg");
  require(push_force >= 0 && push_force <= 1e15, "push_force of a hero: must be from 0 to 1e15 N");
  require(!world.IsLocked(), "a hero cannot be made during a step of the world");
  def.character.validate();
  (void)character_polygon(def.character.shape.hull());  // refuses what Box2D does not take
  b2BodyDef body;
  body.type = b2_dynamicBody;
  body.position = rounded(def.position);
  body.fixedRotation = true;
  body.allowSleep = false;
  body.bullet = true;  // see `lead_body`
  body.gravityScale = 0;
  return *world.CreateBody(&body);
}

void Hero::Impl::make_fixture(const b2Filter& filter) {
  b2PolygonShape shape = character_polygon(def.character.shape.hull());
  b2MassData mass;
  shape.ComputeMass(&mass, 1);
  if (def.mass) mass = {.mass = static_cast<float>(*def.mass), .center = {0, 0}, .I = 0};
  grow(shape, larger);
  shape.m_radius = -hero_inset;
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.friction = 0;
  fixture.filter = filter;
  fixture.density = 1;
  body->CreateFixture(&fixture);
  body->SetMassData(&mass);
}

/// After the shape has changed.
void Hero::Impl::remake_fixture() {
  const b2Filter filter = body->GetFixtureList()->GetFilterData();
  const b2FixtureUserData user_data = body->GetFixtureList()->GetUserData();
  body->DestroyFixture(body->GetFixtureList());
  make_fixture(filter);
  body->GetFixtureList()->GetUserData() = user_data;
}

/// Dynamic bodies that ran into the hero's body in the last step of the world change the hero's velocity as they
/// changed that of its body, but not more than to their own, as after an impact without bounce.
void Hero::Impl::take_impacts() {
  const Vec2d after = widened(body->GetLinearVelocity());
  if (struck != Vec2d::Zero()) {
    const Vec2d way = struck.normalized();
    const double gain = std::min(after.dot(way), struck.norm()) - state.velocity.dot(way);
    if (gain > 0 && way.dot(up_of(gravity())) > 0) paperproof::knock_back(state, {0, 0});  // it leaves the ground
    state.velocity += way * std::max(0.0, gain);
  }
  for_each_touching(*body, [&](const b2Body& other, const Vec2d& normal, std::span<const b2Vec2> points) {
    if (&other == ground_body()) return;
    for (const b2Vec2& point : points) {
      const Vec2d its = widened(other.GetLinearVelocityFromWorldPoint(point));
      const double most = std::max(0.0, (after - state.velocity).dot(normal));
      state.velocity += normal * std::clamp((its - state.velocity).dot(normal), 0.0, most);
    }
  });
}

/// A jump, a dash or a knock-back may be stopped at once by a dynamic body at hand: Box2D did not see the hero come.
/// The hero's body strikes that body in the next step of the world, and `take_impacts` gives the hero what is left.
/// @return the velocity with which it strikes.
Vec2d Hero::Impl::strike(double dt) const {
  const Vec2d up = up_of(gravity());
  const Vec2d wanted = begun.own_velocity + up * std::max(0.0, (report.requested / dt - begun.own_velocity).dot(up));
  Vec2d result = Vec2d::Zero();
  for (const Contact& contact : report.move.contacts) {
    const b2Fixture& other = *fixtures.fixture_of(contact.collider);
    if (other.GetBody()->GetType() != b2_dynamicBody || is_of_hero(other)) continue;
    const double unseen = (wanted - begun.body_velocity).dot(-contact.normal);
    const double lost = (wanted - state.velocity).dot(-contact.normal);
    result -= contact.normal * std::max(0.0, std::min(unseen, lost) + result.dot(contact.normal));
  }
  return result;
}

/// Where the hero is, but for some millimetres. Box2D parts bodies that are deeper in each other's skins than its slop,
/// and a circle, which has no skin, it does not touch. With its body in its own place a hero moved what it only stood
/// on or stopped at, by 2 cm in each second, did not push a ball, and no listener heard of a circle. So the body is
/// just the slop deep in the dynamic bodies and the circles that the hero touches.
Vec2d Hero::Impl::place_for_body() const {
  const b2Fixture& own = *body->GetFixtureList();
  Vec2d place = state.position;
  for (const Contact& contact : report.move.contacts) {
    const b2Fixture& other = *fixtures.fixture_of(contact.collider);
    const bool is_felt = other.GetBody()->GetType() == b2_dynamicBody || other.GetType() == b2Shape::e_circle;
    if (!is_felt || is_of_hero(other)) continue;
    place += contact.normal * double{larger};  // with its face where the hero's is: of what overlaps nothing is known
    const double off = -static_cast<double>(b2_linearSlop) - separation(own, place, other);
    place += contact.normal * std::clamp(off, -most_off, most_off);
  }
  return place;
}

/// Puts the body where the hero is. In the next step of the world it goes on as the hero does, and presses on what is
/// in the way: with the hero's weight downwards, and with at most `push_force` across.
///
/// It is a bullet: what is thrown at it must not get into it before Box2D sees the impact. But Box2D takes a body that
/// a bullet touches back to where the step began, and moves it on without its joints and its contacts with other
/// dynamic bodies. A hero of 70 kg pressed its crate into the crate below by 8 cm in each second. So it is no bullet
/// then.
void Hero::Impl::lead_body(double dt) {
  const Vec2d down = -up_of(gravity());
  const Vec2d stopped = report.requested / dt + state.ride.velocity - state.velocity;
  const double weight = std::clamp(stopped.dot(down), 0.0, gravity().norm() * dt);
  Vec2d push = stopped - down * stopped.dot(down);
  const double acceleration =
      def.push_force ? *def.push_force / static_cast<double>(body->GetMass()) : def.character.acceleration;
  const double most = acceleration * dt;
  if (push.norm() > most) push *= most / push.norm();
  const bool presses = !report.move.contacts.empty();
  Vec2d lead = presses ? Vec2d(state.velocity + push + down * weight) : state.velocity;
  lead += struck;
  const Vec2d before = widened(body->GetLinearVelocity());
  bool is_touched = false;
  for_each_touching(*body, [&](const b2Body& other, const Vec2d& normal, std::span<const b2Vec2>) {
    is_touched = true;
    if (&other == ground_body()) return;
    // Through its skin the body pushes what the hero has not reached yet: with no more force than else.
    const Vec2d across = normal - down * normal.dot(down);
    lead += across * std::max(0.0, (before - lead).dot(across) - most);
  });
  body->SetBullet(!is_touched);
  body->SetTransform(rounded(place_for_body()), 0);
  body->SetLinearVelocity(rounded(lead));
}

}  // namespace paperproof::box2d
