#include <paperproof/box2d/reference_world.hpp>

#include "collider_lookup.hpp"
#include "fixtures.hpp"
#include "float_geometry.hpp"
#include "step_recorder.hpp"

#include <box2d/b2_fixture.h>
#include <box2d/b2_world.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <utility>

namespace paperproof::box2d {
namespace {

/// A motion into a contact of at most this much per step is none [m]: the rounding of velocities and normals to float.
/// The controller's own threshold (`Tolerances<double>::hit`). Zero: sliding along a slope makes and loses contacts by
/// rounding. Large: slow pushes are not seen.
constexpr double least_approach = 1e-7;

/// Beyond this gap the character is not standing on what it touched [m]. Box2D looks for touching when a step begins,
/// so the flag outlives the touch by a step; the slop above its touching distance covers the rest gaps by history.
constexpr double standing_gap = touch_gap + static_cast<double>(b2_linearSlop);

/// Steps whose length changes by more than this factor start Box2D's solver cold. It scales the stored impulses by the
/// ratio, and a large one overflows.
constexpr float largest_step_ratio = 16;

/// By the definition's order: what is met first, then the lowest collider.
bool comes_before(const Contact<double>& a, const Contact<double>& b) {
  if (a.fraction != b.fraction) return a.fraction < b.fraction;
  if (a.collider != b.collider) return a.collider < b.collider;
  return a.side < b.side;
}

void check_definition(const ReferenceWorldDef& def) {
  constexpr int most = 1000;
  if (def.velocity_iterations < 1 || def.velocity_iterations > most || def.position_iterations < 1 ||
      def.position_iterations > most) {
    throw InvalidDefinition("Box2D's iterations must be 1 to 1000");
  }
}

float checked_step(double dt) {
  const auto step = static_cast<float>(dt);
  if (!(dt >= least_step) || !(dt <= largest_number)) throw InvalidDefinition("a time step must be 1e-9 s to 1e9 s");
  return step;
}

}  // namespace

std::string box2d_version() { return PAPERPROOF_BOX2D_VERSION; }

struct ReferenceWorld::Impl {
  Impl(const Scenery<double>& scenery, const CharacterDef& character, const Vec2d& position,
       const ReferenceWorldDef& definition)
      : def(definition),
        as_run(rounded(scenery.as_run())),
        least_up(std::cos(character.max_climb_degrees * std::numbers::pi / 180)),
        recorder(fixtures.sources, points) {
    check_definition(def);
    for (const Vec2d& corner : character.shape.hull()) points.push_back(widened(rounded(corner)));
    add_scenery(scenery);
    world.SetAllowSleeping(false);
    world.SetContactListener(&recorder);
    add_character(character, checked(position, "the character's position"));
  }

  void add_scenery(const Scenery<double>& scenery);
  void add_character(const CharacterDef& character, const b2Vec2& position);

  void place(const b2Vec2& position, const b2Vec2& velocity) {
    body->SetEnabled(false);  // The one way to have Box2D drop its contacts and the impulses stored in them.
    body->SetTransform(position, 0);
    body->SetLinearVelocity(velocity);
    body->SetEnabled(true);
  }

  void step(const b2Vec2& velocity, float dt, std::span<const MoverMotion<double>> motions);
  void send_movers(float dt, std::span<const MoverMotion<double>> motions);
  void add_touching();
  void add_begun();
  void add(const SceneryEnd& end, const TouchPoint& touch, double fraction);
  void stand_on(const SceneryEnd& end, const TouchPoint& touch);
  void add_sensor_events();
  [[nodiscard]] ColliderIndex collider_of(const SceneryEnd& end, const Vec2d& point);
  [[nodiscard]] double fraction_of(const SceneryEnd& end) const;
  [[nodiscard]] Vec2d wanted_relative_to(const SceneryEnd& end) const;
  [[nodiscard]] bool moves_into(const SceneryEnd& end, const Vec2d& normal) const {
    return normal.dot(wanted_relative_to(end)) < -least_approach;
  }

  /// The body of a mover.
  struct Mover {
    b2Body* body = nullptr;
    b2Vec2 goal{0, 0};  ///< Where it is to be after the present step, or the last [m].
  };

  ReferenceWorldDef def;
  SceneryDef as_run;
  std::vector<Vec2d> points;
  double least_up;  ///< Smallest upward part of the normal of walkable ground.
  b2World world{b2Vec2(0, 0)};
  SceneryFixtures fixtures;
  std::deque<ColliderLookup> lookups;  ///< For what stands, then for each mover; they can neither be copied nor moved.
  StepRecorder recorder;
  std::vector<Mover> movers;
  std::vector<Vec2d> offsets;         ///< Of the movers, when the step begins [m].
  bool looks_for_ground = false;      ///< There is ground that carries.
  std::vector<ColliderIndex> sensed;  ///< Sensors that were touched in the last step, ascending.
  std::vector<ColliderIndex> sensed_before;
  b2Body* body = nullptr;
  float last_dt = 0;
  Vec2d wanted{Vec2d::Zero()};  ///< Displacement of the present step [m].
  TwinStep result;
};

void ReferenceWorld::Impl::add_scenery(const Scenery<double>& scenery) {
  std::vector<b2Body*> bodies;
  for (const Part& part : parts_of(as_run, scenery.mover_count())) {
    b2BodyDef body_def;
    body_def.type = part.mover == no_mover ? b2_staticBody : b2_kinematicBody;
    body_def.allowSleep = false;
    bodies.push_back(world.CreateBody(&body_def));
    add_solids(*bodies.back(), scenery, part, def.mode, fixtures);
    lookups.emplace_back(part.solids, part.colliders);
    if (part.mover != no_mover) movers.push_back({.body = bodies.back()});
  }
  add_sensors(bodies, scenery, as_run, fixtures);
  offsets.resize(movers.size(), Vec2d::Zero());
  result.movers.resize(movers.size());
  looks_for_ground =
      !movers.empty() || std::any_of(as_run.colliders.begin(), as_run.colliders.end(),
                                     [](const ColliderDef& collider) { return collider.surface_speed != 0; });
}

void ReferenceWorld::Impl::add_character(const CharacterDef& character, const b2Vec2& position) {
  const b2PolygonShape shape = character_polygon(character.shape.hull());
  b2BodyDef body_def;
  body_def.type = b2_dynamicBody;
  body_def.position = position;
  body_def.fixedRotation = true;
  body_def.bullet = true;
  body_def.allowSleep = false;
  body = world.CreateBody(&body_def);
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.density = 1;
  fixture.friction = 0;
  fixture.restitution = 0;
  body->CreateFixture(&fixture);
  // Box2D moves the centre of mass and derives the position from it. With the centre at the position nothing is lost.
  b2MassData mass;
  mass.mass = body->GetMass();
  mass.center.SetZero();
  mass.I = 0;
  body->SetMassData(&mass);
}

/// By velocity: Box2D sweeps a body from where the step finds it, and what is put somewhere was never on the way.
void ReferenceWorld::Impl::send_movers(float dt, std::span<const MoverMotion<double>> motions) {
  for (std::size_t i = 0; i < movers.size(); ++i) {
    Mover& mover = movers[i];
    const b2Vec2 from = rounded(motions[i].from);
    if (!(mover.goal == from)) mover.body->SetTransform(from, 0);
    mover.goal = rounded(motions[i].to);
    const b2Vec2 way = mover.goal - mover.body->GetPosition();
    if (way.LengthSquared() > b2_maxTranslationSquared) result.capped = true;
    mover.body->SetLinearVelocity((1 / dt) * way);
    offsets[i] = widened(mover.body->GetPosition());
  }
}

void ReferenceWorld::Impl::step(const b2Vec2& velocity, float dt, std::span<const MoverMotion<double>> motions) {
  const b2Vec2 displacement = dt * velocity;
  wanted = widened(displacement);
  result.capped = displacement.LengthSquared() > b2_maxTranslationSquared;
  body->SetLinearVelocity(velocity);
  send_movers(dt, motions);
  world.SetWarmStarting(dt <= largest_step_ratio * last_dt);
  recorder.begin_step(*body, wanted, offsets);
  world.Step(dt, def.velocity_iterations, def.position_iterations);
  recorder.end_step();
  last_dt = dt;

  for (std::size_t i = 0; i < movers.size(); ++i)
    result.movers[i] = {offsets[i], widened(movers[i].body->GetPosition())};
  result.velocity = widened(body->GetLinearVelocity());
  result.path = recorder.path();
  result.contacts.clear();
  result.grounded = false;
  result.ground.reset();
  sensed.swap(sensed_before);
  sensed.clear();
  add_touching();
  add_begun();
  add_sensor_events();
  std::sort(result.contacts.begin(), result.contacts.end(), comes_before);
}

double ReferenceWorld::Impl::fraction_of(const SceneryEnd& end) const {
  for (const Beginning& beginning : recorder.beginnings()) {
    if (beginning.end.source == end.source && beginning.end.child == end.child) return beginning.fraction;
  }
  return 0;  // It touched when the step began.
}

Vec2d ReferenceWorld::Impl::wanted_relative_to(const SceneryEnd& end) const {
  const MoverIndex mover = fixtures.sources[end.source].mover;
  if (mover == no_mover) return wanted;
  return wanted - (result.movers[mover].to - result.movers[mover].from);
}

void ReferenceWorld::Impl::add_touching() {
  for (const b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
    const b2Contact& contact = *edge->contact;
    if (!contact.IsTouching() || !contact.IsEnabled()) continue;
    const SceneryEnd end = scenery_end(contact, *body);
    if (const FixtureSource& source = fixtures.sources[end.source]; source.sensor) {
      sensed.push_back(*source.collider);
      continue;
    }
    for (const TouchPoint& touch : touch_points(contact, *body)) {
      const bool leaves = touch.normal.dot(wanted_relative_to(end)) > least_approach;
      if (touch.normal.y() >= least_up && touch.gap <= standing_gap && !leaves) stand_on(end, touch);
      if (moves_into(end, touch.normal)) add(end, touch, fraction_of(end));
    }
  }
}

void ReferenceWorld::Impl::stand_on(const SceneryEnd& end, const TouchPoint& touch) {
  result.grounded = true;
  if (!looks_for_ground) return;
  const TwinStep::Ground ground{collider_of(end, touch.point), touch.normal};
  const auto rank = [](const TwinStep::Ground& one) { return std::pair(-one.normal.y(), one.collider); };
  if (!result.ground || rank(ground) < rank(*result.ground)) result.ground = ground;
}

/// After `add_touching`: what still touches is listed with the gap that is left, what does not with the gap it had.
/// What Box2D begins because it is within 20 mm is a contact only if the motion leads into it.
void ReferenceWorld::Impl::add_begun() {
  for (const Beginning& beginning : recorder.beginnings()) {
    for (const TouchPoint& touch : beginning.points) {
      if (beginning.was_impact || moves_into(beginning.end, touch.normal))
        add(beginning.end, touch, beginning.fraction);
    }
  }
}

/// A sensor is touched piece by piece; it is entered with the first and left with the last.
void ReferenceWorld::Impl::add_sensor_events() {
  std::sort(sensed.begin(), sensed.end());
  sensed.erase(std::unique(sensed.begin(), sensed.end()), sensed.end());
  result.sensors.clear();
  const auto add_missing = [this](const std::vector<ColliderIndex>& these, const std::vector<ColliderIndex>& in_those,
                                  SensorEvent<double>::Change change) {
    for (const ColliderIndex sensor : these)
      if (!std::binary_search(in_those.begin(), in_those.end(), sensor)) result.sensors.push_back({sensor, change, 0});
  };
  add_missing(sensed_before, sensed, SensorEvent<double>::Change::exit);
  add_missing(sensed, sensed_before, SensorEvent<double>::Change::enter);
}

/// The outline was moved by at most 5 mm and the point is rounded to float a few times; but at the end of a chain Box2D
/// may put a point beside the edge, where a foot is in the air: then what is nearest further away is meant.
ColliderIndex ReferenceWorld::Impl::collider_of(const SceneryEnd& end, const Vec2d& point) {
  const FixtureSource& source = fixtures.sources[end.source];
  if (source.collider) return *source.collider;
  ColliderLookup& lookup = lookups[source.mover == no_mover ? 0 : source.mover + 1];
  const Vec2d place = point - end.offset;
  double reach = touch_gap + 16 * static_cast<double>(b2_epsilon) * point.cwiseAbs().maxCoeff();
  for (; std::isfinite(reach); reach *= 8)
    if (const std::optional<ColliderIndex> found = lookup.nearest(place, reach)) return *found;
  return 0;
}

/// One contact per collider and side; the first to come gives the geometry, the earliest the time.
void ReferenceWorld::Impl::add(const SceneryEnd& end, const TouchPoint& touch, double fraction) {
  const ColliderIndex collider = collider_of(end, touch.point);
  const Side side = side_of_normal(touch.normal.x(), touch.normal.y());
  const auto same = std::find_if(result.contacts.begin(), result.contacts.end(), [&](const Contact<double>& known) {
    return known.collider == collider && known.side == side;
  });
  if (same != result.contacts.end()) {
    same->fraction = std::min(same->fraction, fraction);
    return;
  }
  result.contacts.push_back({collider, touch.point, touch.normal, fraction, touch.gap, side});
}

ReferenceWorld::ReferenceWorld(const Scenery<double>& scenery, const CharacterDef& character, const Vec2d& position,
                               const ReferenceWorldDef& def)
    : impl_(std::make_unique<Impl>(scenery, character, position, def)) {}
ReferenceWorld::~ReferenceWorld() = default;
ReferenceWorld::ReferenceWorld(ReferenceWorld&&) noexcept = default;
ReferenceWorld& ReferenceWorld::operator=(ReferenceWorld&&) noexcept = default;

void ReferenceWorld::place(const Vec2d& position, const Vec2d& velocity) {
  impl_->place(checked(position, "the character's position"), checked(velocity, "the character's velocity"));
}

const TwinStep& ReferenceWorld::step(const Vec2d& wanted_velocity, double dt,
                                     std::span<const MoverMotion<double>> movers) {
  if (movers.size() != impl_->movers.size()) throw InvalidDefinition("a step takes one motion for each mover");
  for (const MoverMotion<double>& motion : movers) {
    (void)checked(motion.from, "a mover");
    (void)checked(motion.to, "a mover");
  }
  impl_->step(checked(wanted_velocity, "the wanted velocity"), checked_step(dt), movers);
  return impl_->result;
}

Vec2d ReferenceWorld::position() const { return widened(impl_->body->GetPosition()); }
const SceneryDef& ReferenceWorld::as_run() const noexcept { return impl_->as_run; }
const std::vector<Vec2d>& ReferenceWorld::points_as_run() const noexcept { return impl_->points; }
ReferenceWorld::Size ReferenceWorld::size() const noexcept { return impl_->fixtures.size; }

}  // namespace paperproof::box2d
