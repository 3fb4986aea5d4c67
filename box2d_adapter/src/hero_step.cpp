#include "hero_impl.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace paperproof::box2d {
namespace {

/// How much farther than they go bodies may squeeze the hero in a step [m].
constexpr double most_squeezed = 0.25;

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
  cut = is_refused(status) ? std::nullopt : limit_squeeze(read);
  return status;
}

/// Ends a step that was made.
void Hero::Impl::end(double dt) {
  sensors.clear();
  note_sensors_at(begun.state.position, false, 0);
  note_step();
  if (cut) note_sensors_at(state.position, true, *cut);
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
/// @return the largest speed that the hero may have [m/s], and whether such a body pushed it.
std::pair<double, bool> Hero::Impl::limit_speed(double dt) {
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
  return {most, is_pushed};
}

/// Moving bodies squeeze the hero out hardly faster than they go: between two surfaces of nearly one direction, or from
/// under a press that is hardly in it, it would leave at any speed. It then ends where it is free first on its way. If
/// that is far away, it waits, and they crush it.
/// @return when it was stopped, as a fraction of the step; nothing if it is where the step took it, or where it began.
std::optional<double> Hero::Impl::limit_squeeze(const StepContext& context) {
  const auto [speed, is_pushed] = limit_speed(context.dt);
  double most = speed * context.dt + most_squeezed;
  if (!is_pushed) most += def.character.step_height + def.character.snap;
  if ((state.position - begun.state.position).norm() <= most || !(is_pushed || is_freed())) return std::nullopt;
  if (const std::optional<double> when = end_sooner(speed * context.dt, most)) return when;
  state = begun.state;
  controller.wait(state, context, scratch, report);
  return std::nullopt;
}

/// Whether the step may have freed the hero from bodies that move: where it began, or where they turned. Out of what
/// stands it goes, however far that is; so it does out of bodies in which it was placed.
bool Hero::Impl::is_freed() {
  if (!begun.state.has_last_free) return false;
  std::array<ColliderIndex, 16> found{};
  const std::size_t count = controller.overlaps(begun.state.position, here(false), scratch, found).value_or(0);
  const std::span<const ColliderIndex> holding(found.data(), std::min(count, found.size()));
  const auto stands = [&](ColliderIndex id) { return fixtures.body_of(id)->GetType() == b2_staticBody; };
  if (holding.empty()) return fixtures.any_turns();
  return std::none_of(holding.begin(), holding.end(), stands);
}

/// Ends the step in the air, at a free place on its way.
/// @param least and @param most how far from the beginning [m].
/// @return when it is there, as a fraction of the step; nothing if no place was found.
std::optional<double> Hero::Impl::end_sooner(double least, double most) {
  constexpr int places = 8;
  MoveResult& move = report.move;
  for (int i = 0; i <= places; ++i) {
    double reach = least + (most - least) * i / places;
    std::size_t corner = 1;
    double length = 0;
    for (; corner < move.path.size(); ++corner, reach -= length) {
      length = (move.path[corner].position - move.path[corner - 1].position).norm();
      if (reach < length) break;
    }
    if (corner == move.path.size()) return std::nullopt;
    const auto [from, before] = move.path[corner - 1];
    const double share = reach / length;
    const Vec2d there = from + (move.path[corner].position - from) * share;
    if (controller.overlaps(there, here(true), scratch) != 0U) continue;
    const double when = before + share * (move.path[corner].fraction - before);
    teleport(state, there);
    state.last_free = there;
    state.has_last_free = true;
    move.path.resize(corner);
    move.path.push_back({there, 1});
    while (!move.contacts.empty() && move.contacts.back().fraction > when) move.contacts.pop_back();
    while (!report.sensors.empty() && report.sensors.back().fraction > when) report.sensors.pop_back();
    move.position = there;
    move.velocity = state.velocity;
    move.grounded = false;
    move.ground = {};
    move.ride = {};
    return when;
  }
  return std::nullopt;
}

void Hero::Impl::note_step() {
  crushed_by.clear();
  for (const ColliderIndex collider : report.move.crushed) crushed_by.push_back(fixtures.fixture_of(collider));
  skipped = fixtures.unusable();
  note_sensors();
  note_contacts();
}

/// Sensors that the hero came to overlap, or ceased to, although its way does not show it: it was placed, or the sensor
/// was, or the way was cut.
/// @param at_end the position and the sensors are those of the end of the step, else of its beginning.
/// @param fraction of the events.
void Hero::Impl::note_sensors_at(const Vec2d& position, bool at_end, double fraction) {
  std::vector<b2Fixture*> now;
  if (fixtures.any_sensor()) {
    std::vector<ColliderIndex> found(16);
    std::size_t count = 0;
    while ((count = controller.sensors_at(position, here(at_end), scratch, found)) > found.size()) found.resize(count);
    for (std::size_t i = 0; i < count; ++i) now.push_back(fixtures.fixture_of(found[i]));
  }
  const auto report_missing = [&](const auto& from, const auto& in, SensorEvent::Change change) {
    for (b2Fixture* sensor : from)
      if (std::find(in.begin(), in.end(), sensor) == in.end() && (fixtures.is_near(sensor) || exists(*world, sensor)))
        sensors.push_back({sensor, change, fraction});
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
