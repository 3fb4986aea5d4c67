#include <paperproof/box2d/reference_world.hpp>

#include "collider_lookup.hpp"
#include "fixtures.hpp"
#include "float_geometry.hpp"
#include "step_recorder.hpp"

#include <box2d/b2_fixture.h>
#include <box2d/b2_world.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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
        lookup(as_run),
        recorder(fixtures.sources, points) {
    check_definition(def);
    for (const Vec2d& corner : character.shape.hull()) points.push_back(widened(rounded(corner)));
    const b2BodyDef ground;
    fixtures = add_scenery(*world.CreateBody(&ground), scenery, as_run, def.mode);
    world.SetAllowSleeping(false);
    world.SetContactListener(&recorder);
    add_character(character, checked(position, "the character's position"));
  }

  void add_character(const CharacterDef& character, const b2Vec2& position) {
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

  void place(const b2Vec2& position, const b2Vec2& velocity) {
    body->SetEnabled(false);  // The one way to have Box2D drop its contacts and the impulses stored in them.
    body->SetTransform(position, 0);
    body->SetLinearVelocity(velocity);
    body->SetEnabled(true);
  }

  void step(const b2Vec2& velocity, float dt);
  void add_touching();
  void add_begun();
  void add(std::size_t source, const TouchPoint& touch, double fraction);
  [[nodiscard]] ColliderIndex nearest_collider(const Vec2d& point);
  [[nodiscard]] double fraction_of(const SceneryEnd& end) const;
  [[nodiscard]] bool moves_into(const Vec2d& normal) const { return normal.dot(wanted) < -least_approach; }

  ReferenceWorldDef def;
  SceneryDef as_run;
  std::vector<Vec2d> points;
  double least_up;  ///< Smallest upward part of the normal of walkable ground.
  b2World world{b2Vec2(0, 0)};
  SceneryFixtures fixtures;
  ColliderLookup lookup;
  StepRecorder recorder;
  b2Body* body = nullptr;
  float last_dt = 0;
  Vec2d wanted{Vec2d::Zero()};  ///< Displacement of the present step [m].
  TwinStep result;
};

void ReferenceWorld::Impl::step(const b2Vec2& velocity, float dt) {
  const b2Vec2 displacement = dt * velocity;
  wanted = widened(displacement);
  result.capped = displacement.LengthSquared() > b2_maxTranslationSquared;
  body->SetLinearVelocity(velocity);
  world.SetWarmStarting(dt <= largest_step_ratio * last_dt);
  recorder.begin_step(*body, wanted);
  world.Step(dt, def.velocity_iterations, def.position_iterations);
  recorder.end_step();
  last_dt = dt;

  result.velocity = widened(body->GetLinearVelocity());
  result.path = recorder.path();
  result.contacts.clear();
  result.grounded = false;
  add_touching();
  add_begun();
  std::sort(result.contacts.begin(), result.contacts.end(), comes_before);
}

double ReferenceWorld::Impl::fraction_of(const SceneryEnd& end) const {
  for (const Beginning& beginning : recorder.beginnings()) {
    if (beginning.source == end.source && beginning.child == end.child) return beginning.fraction;
  }
  return 0;  // It touched when the step began.
}

void ReferenceWorld::Impl::add_touching() {
  for (const b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
    const b2Contact& contact = *edge->contact;
    if (!contact.IsTouching() || !contact.IsEnabled()) continue;
    const SceneryEnd end = scenery_end(contact, *body);
    for (const TouchPoint& touch : touch_points(contact, *body)) {
      const bool leaves = touch.normal.dot(wanted) > least_approach;
      if (touch.normal.y() >= least_up && touch.gap <= standing_gap && !leaves) result.grounded = true;
      if (moves_into(touch.normal)) add(end.source, touch, fraction_of(end));
    }
  }
}

/// After `add_touching`: what still touches is listed with the gap that is left, what does not with the gap it had.
/// What Box2D begins because it is within 20 mm is a contact only if the motion leads into it.
void ReferenceWorld::Impl::add_begun() {
  for (const Beginning& beginning : recorder.beginnings()) {
    for (const TouchPoint& touch : beginning.points) {
      if (beginning.was_impact || moves_into(touch.normal)) add(beginning.source, touch, beginning.fraction);
    }
  }
}

/// The outline was moved by at most 5 mm and the point is rounded to float a few times; but at the end of a chain Box2D
/// may put a point beside the edge, where a foot is in the air: then what is nearest further away is meant.
ColliderIndex ReferenceWorld::Impl::nearest_collider(const Vec2d& point) {
  double reach = touch_gap + 16 * static_cast<double>(b2_epsilon) * point.cwiseAbs().maxCoeff();
  for (; std::isfinite(reach); reach *= 8)
    if (const std::optional<ColliderIndex> found = lookup.nearest(point, reach)) return *found;
  return 0;
}

/// One contact per collider and side; the first to come gives the geometry, the earliest the time.
void ReferenceWorld::Impl::add(std::size_t source, const TouchPoint& touch, double fraction) {
  const std::optional<ColliderIndex> owner = fixtures.sources[source].collider;
  const ColliderIndex collider = owner ? *owner : nearest_collider(touch.point);
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

const TwinStep& ReferenceWorld::step(const Vec2d& wanted_velocity, double dt) {
  impl_->step(checked(wanted_velocity, "the wanted velocity"), checked_step(dt));
  return impl_->result;
}

Vec2d ReferenceWorld::position() const { return widened(impl_->body->GetPosition()); }
const SceneryDef& ReferenceWorld::as_run() const noexcept { return impl_->as_run; }
const std::vector<Vec2d>& ReferenceWorld::points_as_run() const noexcept { return impl_->points; }
ReferenceWorld::Size ReferenceWorld::size() const noexcept { return impl_->fixtures.size; }

}  // namespace paperproof::box2d
