#include <paperproof/box2d/hero.hpp>

#include "float_geometry.hpp"
#include "near_fixtures.hpp"
#include "shapes.hpp"

#include <paperproof/box2d/invalid_definition.hpp>

#include <box2d/b2_body.h>
#include <box2d/b2_contact.h>
#include <box2d/b2_distance.h>
#include <box2d/b2_polygon_shape.h>
#include <box2d/b2_world.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace paperproof::box2d {
namespace {

/// A squeeze out of a gap is not looked at before it is so far [m].
constexpr double most_squeezed = 0.25;

/// How far from the hero its body may be [m]. Less than 9 mm: a ball is not touched. Large: a hero that a crush left
/// inside a body pushes that body away at once.
constexpr double most_off = 0.02;

/// Largest position [m] and speed [m/s] that a call may set.
constexpr double largest = 1e6;

void require(bool holds, const char* words) {
  if (!holds) throw InvalidDefinition(words);
}

void require_number(const Vec2d& value, const char* words) {
  require(std::abs(value.x()) <= largest && std::abs(value.y()) <= largest, words);
}

b2Body& make_body(b2World& world, const HeroDef& def) {
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

void make_fixture(b2Body& body, const HeroDef& def, const b2Filter& filter) {
  b2PolygonShape shape = character_polygon(def.character.shape.hull());
  shape.m_radius = -hero_inset;
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.friction = 0;
  fixture.filter = filter;
  fixture.density = 1;
  body.CreateFixture(&fixture);
  if (!def.mass) return;
  const b2MassData mass{.mass = static_cast<float>(*def.mass), .center = {0, 0}, .I = 0};
  body.SetMassData(&mass);
}

/// Where the world pulls, as a unit vector the other way.
Vec2d up_of(const Vec2d& gravity) {
  const double size = gravity.norm();
  return size > 0 ? Vec2d(-gravity / size) : Vec2d(0, 1);
}

/// How far the point of a body that is now at `point` went in a step [m].
double way_of(const Vec2d& point, const PoseMotion& motion) {
  const Eigen::Rotation2Dd turn(motion.from.angle - motion.to.angle);
  return (motion.from.position + turn * (point - motion.to.position) - point).norm();
}

/// The box around a shape, across up and along it.
Box2<double> seen_by(const UpFrame<double>& frame, const CharacterShape& shape) {
  const Vec2d first = frame.seen(shape.points()[0]);
  Box2<double> box{first, first};
  for (const Vec2d& point : shape.points()) box = box.merged({frame.seen(point), frame.seen(point)});
  return box;
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

/// Whether a fixture is still in the world. @param fixture may have been destroyed.
bool exists(b2World& world, const b2Fixture* fixture) {
  for (b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
    for (const b2Fixture* one = body->GetFixtureList(); one != nullptr; one = one->GetNext())
      if (one == fixture) return true;
  return false;
}

/// Dynamic bodies that touch a body, with the normal towards it.
template <class Each>
void for_each_touching(b2Body& body, const Each& each) {
  for (const b2ContactEdge* edge = body.GetContactList(); edge != nullptr; edge = edge->next) {
    b2Contact& contact = *edge->contact;
    if (!contact.IsTouching() || !contact.IsEnabled() || edge->other->GetType() != b2_dynamicBody) continue;
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    const double side = contact.GetFixtureB()->GetBody() == &body ? 1 : -1;
    each(*edge->other, Vec2d(side * widened(manifold.normal)),
         std::span(manifold.points, static_cast<std::size_t>(contact.GetManifold()->pointCount)));
  }
}

}  // namespace

struct Hero::Impl {
  Impl(b2World& in, const HeroDef& from)
      : world(&in),
        def(from),
        body(&make_body(in, from)),
        fixtures(in, *body),
        controller(from.character),
        other_controller(from.character) {
    make_fixture(*body, def, def.filter);
    HeroPlaces::note(*body, state.position);
    state.position = def.position;
    report.move.position = def.position;
  }
  ~Impl() {
    HeroPlaces::forget(*body);
    world->DestroyBody(body);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  [[nodiscard]] Vec2d gravity() const { return widened(world->GetGravity()); }
  /// The body that carries the hero, if one does. The game may have destroyed it.
  [[nodiscard]] const b2Body* ground_body() const { return fixtures.body_of(state.ride.ground); }

  template <class Go>
  StepStatus advance(double dt, bool drops, const Go& go);
  [[nodiscard]] std::vector<Vec2d> held_points(bool drops) const;
  void note_sensors_at(const Vec2d& position, bool at_end, double fraction);
  void note_sensors();
  [[nodiscard]] bool is_free_at_end(const Vec2d& position);
  [[nodiscard]] bool fits(const CharacterDef& character, const Vec2d& position) const;
  void remake_fixture();
  void change(const CharacterDef& character);
  void take_impacts();
  double end_at(const Vec2d& position, std::size_t corner, double share);
  std::optional<double> limit_squeeze(const CharacterState<double>& before, const Vec2d& body_velocity, double dt);
  [[nodiscard]] bool is_drawn_out(const CharacterState<double>& before) const;
  void stay_crushed(const CharacterState<double>& before);
  void note_step();
  void note_contacts();
  [[nodiscard]] Vec2d place_for_body() const;
  void lead_body(double dt);

  b2World* world;
  HeroDef def;
  b2Body* body;
  NearFixtures fixtures;
  LocalController controller;
  LocalController other_controller;  ///< Asks what the hero overlaps, beside its step.
  CharacterState<double> state;
  StepReport<double> report;
  std::vector<HeroContact> contacts;
  std::vector<HeroContact> contacts_before;
  std::vector<HeroContact> contacts_now;
  std::vector<HeroSensorEvent> sensors;
  std::vector<b2Fixture*> inside;  ///< Sensors that it overlaps.
  std::vector<b2Fixture*> crushed_by;
  std::vector<b2Fixture*> skipped;
};

/// Whether a shape would overlap nothing at a position. Bodies that moved since the hero's last step count where they
/// were then, as the hero does.
bool Hero::Impl::fits(const CharacterDef& character, const Vec2d& position) const {
  NearFixtures around(*world, *body);
  around.restore_poses(fixtures.poses());
  around.begin_step(def, up_of(gravity()), fixtures.dt());
  return LocalController(character).overlaps(position, {.dt = 1},
                                             [&](const auto& box, auto& found) { around.find(box, found); }) == 0U;
}

/// After the shape has changed.
void Hero::Impl::remake_fixture() {
  const b2Filter filter = body->GetFixtureList()->GetFilterData();
  const b2FixtureUserData user_data = body->GetFixtureList()->GetUserData();
  body->DestroyFixture(body->GetFixtureList());
  make_fixture(*body, def, filter);
  body->GetFixtureList()->GetUserData() = user_data;
}

/// After the shape has changed, or the way to move.
void Hero::Impl::change(const CharacterDef& character) {
  const bool same_shape = std::ranges::equal(def.character.shape.hull(), character.shape.hull());
  report.move.keep_own();
  def.character = character;
  controller = LocalController(character);
  other_controller = LocalController(character);
  if (!same_shape) remake_fixture();
}

/// See `NearFixtures::begin_step`. `Input::drop` is for ledges alone: what the hero is in front of holds it. A hero
/// that was just placed may begin in the ground: that lifts it, as in Box2D, if the middle of the hero is in front.
std::vector<Vec2d> Hero::Impl::held_points(bool drops) const {
  if (!state.has_last_free) return {state.position};
  std::vector<Vec2d> corners;
  if (!drops) return corners;
  for (const Vec2d& corner : def.character.shape.hull()) corners.emplace_back(state.position + corner);
  return corners;
}

template <class Go>
StepStatus Hero::Impl::advance(double dt, bool drops, const Go& go) {
  if (world->IsLocked() || !(dt > 0 && dt <= largest) || !gravity().allFinite() || !state.position.allFinite())
    return StepStatus::invalid_input;
  const CharacterState<double> before = state;
  const Vec2d body_velocity = widened(body->GetLinearVelocity());
  const Vec2d up = up_of(gravity());
  fixtures.begin_step(def, up, dt, held_points(drops));
  take_impacts();
  const StepStatus status = go({.gravity = gravity(), .dt = dt, .up = up},
                               [this](const auto& box, auto& found) { fixtures.find(box, found); });
  if (is_refused(status)) {
    state = before;
    return status;
  }
  if (is_drawn_out(before)) stay_crushed(before);
  const std::optional<double> cut = limit_squeeze(before, body_velocity, dt);
  sensors.clear();
  note_sensors_at(before.position, false, 0);
  note_step();
  if (cut) note_sensors_at(state.position, true, *cut);
  fixtures.note_poses();
  lead_body(dt);
  return report.status;
}

/// Whether a hero that was crushed came out farther away than its crushers moved: from under a press to its edge, for
/// example. There may be such a way while the press is hardly in the hero. A player sees a jump.
bool Hero::Impl::is_drawn_out(const CharacterState<double>& before) const {
  if (!before.crushed || state.crushed) return false;
  double reach = report.requested.norm() + most_squeezed;
  for (const Crusher<double>& crusher : before.crushers)
    if (b2Fixture* fixture = fixtures.fixture_of(crusher.collider); fixtures.is_near(fixture))
      reach += way_of(before.position, fixtures.motion_of(*fixture));
  return (state.position - before.position).norm() > reach;
}

/// Undoes a step: the hero waits in place until its crushers leave.
void Hero::Impl::stay_crushed(const CharacterState<double>& before) {
  state = before;
  state.velocity.setZero();
  for (Crusher<double>& crusher : state.crushers) {
    b2Fixture* fixture = fixtures.fixture_of(crusher.collider);
    if (!fixtures.is_near(fixture)) continue;
    const PoseMotion motion = fixtures.motion_of(*fixture);
    crusher.displacement += motion.to.position - motion.from.position;
  }
  report.move.clear();
  report.move.position = state.position;
  report.move.velocity = state.velocity;
  report.move.status = MoveStatus::stuck;
  report.move.path.push_back({state.position, 0});
  report.move.path.push_back({state.position, 1});
  report.sensors.clear();
  report.dropped_through.clear();
  report.status = StepStatus::stuck;
}

/// Dynamic bodies that ran into the hero's body in the last step of the world change the hero's velocity as they
/// changed that of its body, but not more than to their own, as after an impact without bounce.
void Hero::Impl::take_impacts() {
  const Vec2d after = widened(body->GetLinearVelocity());
  for_each_touching(*body, [&](const b2Body& other, const Vec2d& normal, std::span<const b2Vec2> points) {
    if (&other == ground_body()) return;
    for (const b2Vec2& point : points) {
      const Vec2d its = widened(other.GetLinearVelocityFromWorldPoint(point));
      const double most = std::max(0.0, (after - state.velocity).dot(normal));
      state.velocity += normal * std::clamp((its - state.velocity).dot(normal), 0.0, most);
    }
  });
}

/// Whether the hero overlaps nothing at a position on its way at the end of the step.
bool Hero::Impl::is_free_at_end(const Vec2d& position) {
  const auto find = [this](const auto& /*box*/, auto& found) { fixtures.find_again(found); };
  return other_controller.overlaps(position, {.dt = 1}, find, true) == 0U;
}

/// Ends the step on its way, in the air.
/// @param corner of the path towards which the hero goes there. @param share of the way to it.
/// @return when it is there, as a fraction of the step.
double Hero::Impl::end_at(const Vec2d& position, std::size_t corner, double share) {
  teleport(state, position);
  MoveResult<double>& move = report.move;
  const double before = move.path[corner - 1].fraction;
  const double when = before + share * (move.path[corner].fraction - before);
  while (move.path.size() > corner) move.path.pop_back();
  move.path.push_back({position, 1});
  while (!move.contacts.empty() && move.contacts.back().fraction > when) move.contacts.pop_back();
  while (!report.sensors.empty() && report.sensors.back().fraction > when) report.sensors.pop_back();
  move.position = position;
  move.velocity = state.velocity;
  move.grounded = false;
  move.ground = {};
  move.ride = {};
  return when;
}

/// Moving bodies take the hero along, but squeeze it out no faster than they go themselves, or than Box2D moved the
/// hero's body: between two surfaces of nearly one direction it would leave at any speed. It then ends where it is free
/// first on its way.
/// @return when, as a fraction of the step; nothing if it is where the step took it.
std::optional<double> Hero::Impl::limit_squeeze(const CharacterState<double>& before, const Vec2d& body_velocity,
                                                double dt) {
  double most = std::max((report.requested / dt + before.ride.velocity).norm(), state.ride.velocity.norm());
  bool is_pushed = false;
  for (const Contact<double>& contact : report.move.contacts) {
    b2Fixture& fixture = *fixtures.fixture_of(contact.collider);
    const b2Body& other = *fixture.GetBody();
    if (other.GetType() == b2_staticBody || contact.collider == state.ride.ground) continue;
    is_pushed = true;
    const bool has_mass = other.GetType() == b2_dynamicBody;
    most = std::max(most, has_mass ? body_velocity.norm() : way_of(contact.point, fixtures.motion_of(fixture)) / dt);
    if (!has_mass) continue;
    // What Box2D moved a body to part it from others is no velocity of the body, and becomes none of the hero.
    const Vec2d its = widened(other.GetLinearVelocityFromWorldPoint(rounded(contact.point)));
    state.velocity += contact.normal * std::max(0.0, (its - state.velocity).dot(contact.normal));
  }
  const double speed = state.velocity.norm();
  const bool is_too_fast = is_pushed && speed > most;
  if (is_too_fast) state.velocity *= most / speed;
  report.move.velocity = state.velocity;
  if (!is_too_fast) return std::nullopt;
  if ((state.position - before.position).norm() <= most * dt + most_squeezed) return std::nullopt;
  double reach = most * dt;
  for (std::size_t i = 1; i < report.move.path.size(); ++i) {
    const Vec2d from = report.move.path[i - 1].position;
    const Vec2d way = report.move.path[i].position - from;
    for (; reach < way.norm(); reach = 1.25 * reach + most_squeezed) {
      const Vec2d there = from + way * (reach / way.norm());
      if (!is_free_at_end(there)) continue;
      return end_at(there, i, reach / way.norm());
    }
    reach = std::max(0.0, reach - way.norm());
  }
  return std::nullopt;
}

void Hero::Impl::note_step() {
  crushed_by.clear();
  for (const ColliderIndex collider : report.move.crushed) crushed_by.push_back(fixtures.fixture_of(collider));
  skipped.clear();
  for (const ColliderIndex collider : controller.unusable()) skipped.push_back(fixtures.fixture_of(collider));
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
    const auto find = [this](const auto& /*box*/, auto& near) { fixtures.find_sensors(near); };
    std::size_t count = 0;
    while ((count = other_controller.overlaps(position, {.dt = 1}, find, at_end, found).value_or(0)) > found.size())
      found.resize(count);
    for (std::size_t i = 0; i < count; ++i) now.push_back(fixtures.fixture_of(found[i]));
  }
  const auto report_missing = [&](const auto& from, const auto& in, SensorEvent<double>::Change change) {
    for (b2Fixture* sensor : from)
      if (std::find(in.begin(), in.end(), sensor) == in.end() && (fixtures.is_near(sensor) || exists(*world, sensor)))
        sensors.push_back({sensor, change, fraction});
  };
  report_missing(inside, now, SensorEvent<double>::Change::exit);
  report_missing(now, inside, SensorEvent<double>::Change::enter);
  inside = std::move(now);
}

void Hero::Impl::note_sensors() {
  for (const SensorEvent<double>& event : report.sensors) {
    b2Fixture* sensor = fixtures.fixture_of(event.sensor);
    sensors.push_back({sensor, event.change, event.fraction});
    if (event.change == SensorEvent<double>::Change::enter)
      inside.push_back(sensor);
    else
      std::erase(inside, sensor);
  }
}

void Hero::Impl::note_contacts() {
  std::erase_if(contacts, [](const HeroContact& contact) { return contact.change == HeroContact::Change::removed; });
  contacts_before.swap(contacts);
  contacts_now.clear();
  for (const Contact<double>& contact : report.move.contacts)
    contacts_now.push_back({fixtures.fixture_of(contact.collider), HeroContact::Change::added, contact});
  contacts.clear();
  for_each_change<HeroContact>(
      contacts_before, contacts_now, [](const HeroContact& a, const HeroContact& b) { return a.fixture == b.fixture; },
      [this](ContactChange change, const HeroContact& of) {
        contacts.push_back({of.fixture, change, of.contact});
      });
}

/// Where the hero is, but for some millimetres. Box2D parts bodies that are deeper in each other's skins than its slop,
/// and a circle, which has no skin, it does not touch. With its body in its own place a hero moved what it only stood
/// on or stopped at, by 2 cm in each second, did not push a ball, and no listener heard of a circle. So the body is
/// just the slop deep in the dynamic bodies and the circles that the hero touches.
Vec2d Hero::Impl::place_for_body() const {
  const b2Fixture& own = *body->GetFixtureList();
  Vec2d place = state.position;
  for (const Contact<double>& contact : report.move.contacts) {
    const b2Fixture& other = *fixtures.fixture_of(contact.collider);
    const bool is_felt = other.GetBody()->GetType() == b2_dynamicBody || other.GetType() == b2Shape::e_circle;
    if (!is_felt || is_of_hero(other)) continue;
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

Hero::Hero(b2World& world, const HeroDef& def) : impl_(std::make_unique<Impl>(world, def)) {}
Hero::~Hero() = default;
Hero::Hero(Hero&&) noexcept = default;
Hero& Hero::operator=(Hero&&) noexcept = default;

StepStatus Hero::step(const Input& input, double dt) {
  Impl& hero = *impl_;
  return hero.advance(dt, input.drop, [&](const StepContext<double>& context, const LocalController::Find& find) {
    return hero.controller.step(hero.state, input, context, find, hero.report);
  });
}

StepStatus Hero::move(const Vec2d& displacement, double dt) {
  Impl& hero = *impl_;
  return hero.advance(dt, false, [&](const StepContext<double>& context, const LocalController::Find& find) {
    return hero.controller.move(hero.state, displacement, context, find, hero.report);
  });
}

const CharacterState<double>& Hero::state() const noexcept { return impl_->state; }
const StepReport<double>& Hero::report() const noexcept { return impl_->report; }
std::span<const HeroContact> Hero::contacts() const noexcept { return impl_->contacts; }
std::span<const HeroSensorEvent> Hero::sensors() const noexcept { return impl_->sensors; }
std::span<b2Fixture* const> Hero::crushed_by() const noexcept { return impl_->crushed_by; }
std::span<b2Fixture* const> Hero::skipped() const noexcept { return impl_->skipped; }
b2Body& Hero::body() const noexcept { return *impl_->body; }
b2Fixture* Hero::fixture_of(ColliderIndex collider) const noexcept { return impl_->fixtures.fixture_of(collider); }

b2Fixture* Hero::ground() const noexcept {
  const Ground<double>& ground = state().ground;
  return ground.state == GroundState::air ? nullptr : fixture_of(ground.collider);
}
std::span<b2Fixture* const> Hero::inside() const noexcept { return impl_->inside; }

void Hero::place(const Vec2d& position, const Vec2d& velocity) {
  require(!impl_->world->IsLocked(), "a hero cannot be placed during a step of the world");
  require_number(position, "position of a hero: must be within 1e6 m");
  require_number(velocity, "velocity of a hero: must be below 1e6 m/s");
  teleport(impl_->state, position);
  impl_->state.velocity = velocity;
  impl_->state.jumping = false;
  impl_->body->SetTransform(rounded(position), 0);
  impl_->body->SetLinearVelocity(rounded(velocity));
}

void Hero::knock_back(const Vec2d& velocity) {
  require_number(Vec2d(impl_->state.velocity + velocity), "velocity of a hero: must be below 1e6 m/s");
  paperproof::knock_back(impl_->state, velocity);
}

void Hero::set_velocity(const Vec2d& velocity) {
  require_number(velocity, "velocity of a hero: must be below 1e6 m/s");
  CharacterState<double>& state = impl_->state;
  if ((velocity - state.ride.velocity).dot(up_of(impl_->gravity())) > 0) knock_back({0, 0});
  state.velocity = velocity;
}

bool Hero::change(const CharacterDef& character) {
  character.validate();
  (void)character_polygon(character.shape.hull());
  Impl& hero = *impl_;
  require(!hero.world->IsLocked(), "a hero cannot change during a step of the world");
  const UpFrame<double> frame(up_of(hero.gravity()));
  const Box2<double> old_box = seen_by(frame, hero.def.character.shape);
  const Box2<double> box = seen_by(frame, character.shape);
  const double across = (old_box.lower.x() + old_box.upper.x() - box.lower.x() - box.upper.x()) / 2;
  const Vec2d by = frame.in_world({across, old_box.lower.y() - box.lower.y()});
  const Vec2d position = hero.state.position + by;
  if (!hero.fits(character, position)) return false;
  hero.change(character);
  hero.state.position = position;
  hero.state.last_free += by;
  hero.state.ride.place += by;
  hero.body->SetTransform(rounded(position), 0);
  return true;
}

void Hero::shift_origin(const Vec2d& new_origin) {
  require_number(new_origin, "the new origin: must be within 1e6 m");
  Impl& hero = *impl_;
  require(!hero.world->IsLocked(), "the origin cannot be shifted during a step of the world");
  hero.state.position -= new_origin;
  hero.state.last_free -= new_origin;
  for (Crusher<double>& crusher : hero.state.crushers) crusher.last_free -= new_origin;
  hero.fixtures.shift_origin(new_origin);
  hero.body->SetTransform(rounded(hero.state.position), 0);
}

HeroSave Hero::save() const {
  const Impl& hero = *impl_;
  const std::span<const BodyPose> poses = hero.fixtures.poses();
  HeroSave save{hero.def.character,
                hero.state,
                hero.fixtures.fixture_of(hero.state.ride.ground),
                hero.fixtures.fixture_of(hero.state.ground.collider),
                {},
                {poses.begin(), poses.end()},
                hero.contacts,
                hero.inside,
                hero.body->GetPosition(),
                hero.body->GetLinearVelocity(),
                hero.body->IsBullet(),
                hero.controller.reach()};
  for (const Crusher<double>& crusher : hero.state.crushers)
    save.crushers.push_back(hero.fixtures.fixture_of(crusher.collider));
  return save;
}

void Hero::restore(const HeroSave& save) {
  Impl& hero = *impl_;
  require(!hero.world->IsLocked(), "a hero cannot be restored during a step of the world");
  hero.change(save.character);
  hero.state = save.state;
  // A fixture that is near keeps its ids: it may have several.
  const auto rename = [&](ColliderIndex& id, b2Fixture* fixture) {
    if (fixture != nullptr && hero.fixtures.fixture_of(id) != fixture) id = hero.fixtures.id_of(fixture);
  };
  rename(hero.state.ride.ground, save.ride);
  rename(hero.state.ground.collider, save.ground);
  for (std::size_t i = 0; i < save.crushers.size(); ++i) rename(hero.state.crushers[i].collider, save.crushers[i]);
  hero.contacts = save.contacts;
  hero.inside = save.inside;
  hero.fixtures.restore_poses(save.poses);
  hero.controller.set_reach(save.reach);
  hero.body->SetTransform(save.body_position, 0);
  hero.body->SetLinearVelocity(save.body_velocity);
  hero.body->SetBullet(save.is_bullet);
}

}  // namespace paperproof::box2d
