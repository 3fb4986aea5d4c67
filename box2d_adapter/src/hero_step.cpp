#include "hero_impl.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace paperproof::box2d {
namespace {

/// Fixtures are read in squares of this size, and one more around what a step needs [m]. Zero: each step reads other
/// ones. Large: each change costs more.
constexpr double read_ahead = 1;

/// Largest coordinate of what can be read [m].
constexpr double farthest = 1e8;

/// How far the point of a body that is now at `point` went in a step [m].
double way_of(const Vec2d& point, const MoverMotion& motion) {
  const Eigen::Rotation2Dd turn(-motion.turn());
  return (motion.from + turn * (point - motion.to) - point).norm();
}

/// Whether a fixture is still in the world. @param fixture may have been destroyed.
bool exists(b2World& world, const b2Fixture* fixture) {
  for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
    for (const b2Fixture* one = body->GetFixtureList(); one != nullptr; one = one->GetNext())
      if (one == fixture) return true;
  return false;
}

}  // namespace

StepStatus Hero::Impl::advance(double dt, const Go& go) {
  if (!begin(dt)) return StepStatus::invalid_input;
  const StepStatus status = attempt(context_of(dt), go);
  if (is_refused(status)) {
    state = begun.state;
    return status;
  }
  end(dt);
  return report.status;
}

/// Begins a step. @return false if it cannot be made: nothing changed then.
bool Hero::Impl::begin(double dt) {
  if (world->IsLocked() || !(dt > 0 && dt <= largest) || !gravity().allFinite() || !state.position.allFinite())
    return false;
  begun.state = state;
  begun.body_velocity = widened(body->GetLinearVelocity());
  fixtures.begin_step(def, up_of(gravity()), dt, state, contacts);
  take_impacts();
  begun.own_velocity = state.velocity;
  return true;
}

/// Makes the step from `state`, as it was after `begin`.
StepStatus Hero::Impl::attempt(const StepContext& context, const Go& go) {
  StepContext read = context;
  const StepStatus status = step_as_far_as_read(read, go);
  if (!is_refused(status)) limit_speed(read.dt);
  return status;
}

/// Ends a step that was made.
void Hero::Impl::end(double dt) {
  sensors.clear();
  note_sensors_at_begin();
  note_step();
  fixtures.note_poses();
  struck = strike(dt);
  lead_body(dt);
}

/// Reads what is near. The box follows from the state alone, so a roll-back gives the same steps again.
void Hero::Impl::read_near(const Box2& needed) {
  const auto before = [](double x) { return (std::floor(x / read_ahead) - 1) * read_ahead; };
  const auto after = [](double x) { return (std::ceil(x / read_ahead) + 1) * read_ahead; };
  fixtures.read(
      {{before(needed.lower.x()), before(needed.lower.y())}, {after(needed.upper.x()), after(needed.upper.y())}});
}

/// Makes the step. If it leads beyond what was read, reads more and makes it again.
StepStatus Hero::Impl::step_as_far_as_read(StepContext& context, const Go& go) {
  const CharacterState from = state;
  Box2 needed = controller.reach(state, context);
  for (;;) {
    if (!(needed.lower.minCoeff() > -farthest && needed.upper.maxCoeff() < farthest))
      return report.status = StepStatus::invalid_input;
    read_near(needed);
    context.movers = fixtures.motions();
    state = from;
    const StepStatus status = go(context);
    if (is_refused(status)) return status;
    const Box2 way = controller.reach(report.move);
    if (needed.contains(way)) return status;
    needed = needed.merged(way.inflated((needed.upper - needed.lower).maxCoeff()));
  }
}

/// Moving bodies take the hero along, but give it no more than their own speed, or that to which Box2D brought the
/// hero's body.
void Hero::Impl::limit_speed(double dt) {
  double most = std::max((report.requested / dt + begun.state.ride.velocity).norm(), state.ride.velocity.norm());
  const Vec2d middle = begun.state.position + def.character.shape.box().middle();
  bool is_pushed = begun.state.crushed;
  for (const Crusher& crusher : begun.state.crushers)
    if (b2Fixture* fixture = fixtures.fixture_of(crusher.collider); fixtures.is_near(fixture))
      most = std::max(most, way_of(middle, fixtures.motion_of(*fixture)) / dt);
  for (const Contact& contact : report.move.contacts) {
    b2Fixture& fixture = *fixtures.fixture_of(contact.collider);
    const b2Body& other = *fixture.GetBody();
    if (other.GetType() == b2_staticBody) continue;
    is_pushed = true;
    const bool has_mass = other.GetType() == b2_dynamicBody;
    most =
        std::max(most, has_mass ? begun.body_velocity.norm() : way_of(contact.point, fixtures.motion_of(fixture)) / dt);
    if (!has_mass || contact.collider == state.ride.ground) continue;
    // What Box2D moved a body to part it from others is no velocity of the body, and becomes none of the hero.
    const Vec2d its = widened(other.GetLinearVelocityFromWorldPoint(rounded(contact.point)));
    state.velocity += contact.normal * std::max(0.0, (its - state.velocity).dot(contact.normal));
  }
  const double speed = state.velocity.norm();
  if (is_pushed && speed > most) state.velocity *= most / speed;
  report.move.velocity = state.velocity;
}

void Hero::Impl::note_step() {
  crushed_by.clear();
  for (const ColliderIndex collider : report.move.crushed) crushed_by.push_back(fixtures.fixture_of(collider));
  skipped = fixtures.unusable();
  note_sensors();
  note_contacts();
}

/// Sensors that the hero came to overlap, or ceased to, since the last step: it was placed, or the sensor was.
void Hero::Impl::note_sensors_at_begin() {
  std::vector<b2Fixture*> now;
  if (fixtures.any_sensor()) {
    std::vector<ColliderIndex> found(16);
    std::size_t count = 0;
    const StepContext here{.dt = 1, .movers = fixtures.motions()};
    while ((count = controller.sensors_at(begun.state.position, here, scratch, found)) > found.size())
      found.resize(count);
    for (std::size_t i = 0; i < count; ++i) now.push_back(fixtures.fixture_of(found[i]));
  }
  const auto report_missing = [&](const auto& from, const auto& in, SensorEvent::Change change) {
    for (b2Fixture* sensor : from)
      if (std::find(in.begin(), in.end(), sensor) == in.end() && (fixtures.is_near(sensor) || exists(*world, sensor)))
        sensors.push_back({sensor, change, 0});
  };
  report_missing(inside, now, SensorEvent::Change::exit);
  report_missing(now, inside, SensorEvent::Change::enter);
  inside = std::move(now);
}

void Hero::Impl::note_sensors() {
  for (const SensorEvent& event : report.sensors) {
    b2Fixture* sensor = fixtures.fixture_of(event.sensor);
    sensors.push_back({sensor, event.change, event.fraction});
    if (event.change == SensorEvent::Change::enter)
      inside.push_back(sensor);
    else
      std::erase(inside, sensor);
  }
}

void Hero::Impl::note_contacts() {
  std::erase_if(contacts, [](const HeroContact& contact) { return contact.change == HeroContact::Change::removed; });
  contacts_before.swap(contacts);
  contacts_now.clear();
  for (const Contact& contact : report.move.contacts)
    contacts_now.push_back({fixtures.fixture_of(contact.collider), HeroContact::Change::added, contact});
  contacts.clear();
  for_each_change<HeroContact>(
      contacts_before, contacts_now, [](const HeroContact& a, const HeroContact& b) { return a.fixture == b.fixture; },
      [this](ContactChange change, const HeroContact& of) {
        contacts.push_back({of.fixture, change, of.contact});
      });
}

}  // namespace paperproof::box2d
