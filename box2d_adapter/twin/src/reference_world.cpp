#include <paperproof/box2d/reference_world.hpp>

#include "characters.hpp"
#include "collider_lookup.hpp"
#include "float_scenery.hpp"
#include "scenery_bodies.hpp"

#include <box2d/b2_fixture.h>
#include <box2d/b2_world.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

namespace paperproof::box2d {
namespace {

/// A motion into a contact of at most this much per step is none [m]: the rounding of velocities and normals to float.
/// The controller's own threshold (`Tolerances::hit`). Zero: sliding along a slope makes and loses contacts by
/// rounding. Large: slow pushes are not seen.
constexpr double least_approach = 1e-7;

/// Beyond this gap the character is not standing on what it touched [m]. Box2D looks for touching when a step begins,
/// so the flag outlives the touch by a step; the slop above its touching distance covers the rest gaps by history.
constexpr double standing_gap = touch_gap + static_cast<double>(b2_linearSlop);

/// By the definition's order: what is met first, then the lowest collider.
bool comes_before(const Contact& a, const Contact& b) {
  if (a.fraction != b.fraction) return a.fraction < b.fraction;
  if (a.collider != b.collider) return a.collider < b.collider;
  return a.side < b.side;
}

bool any_ground_carries(const SceneryDef& scenery) {
  return std::any_of(scenery.colliders.begin(), scenery.colliders.end(), [](const ColliderDef& collider) {
    return collider.mover != no_mover || collider.surface_speed != 0;
  });
}

bool any_one_way(const SceneryDef& scenery) {
  return std::any_of(scenery.colliders.begin(), scenery.colliders.end(),
                     [](const ColliderDef& collider) { return collider.one_way.has_value(); });
}

const ReferenceWorldDef& checked_definition(const ReferenceWorldDef& def) {
  constexpr int most = 1000;
  if (def.velocity_iterations < 1 || def.velocity_iterations > most || def.position_iterations < 1 ||
      def.position_iterations > most) {
    throw InvalidDefinition("Box2D's iterations must be 1 to 1000");
  }
  return def;
}

}  // namespace

std::string box2d_version() { return PAPERPROOF_BOX2D_VERSION; }
std::string box2d_build() { return PAPERPROOF_BOX2D_BUILD; }
std::string box2d_asserts() { return PAPERPROOF_BOX2D_ASSERTS; }

struct ReferenceWorld::Impl {
  Impl(const Scenery& scenery, const CharacterDef& character, std::span<const Vec2d> positions,
       const ReferenceWorldDef& definition)
      : def(checked_definition(definition)),
        least_up(static_cast<double>(static_cast<float>(character.walkable_cosine(tolerances_in_float.climb)))),
        stage(world, scenery, def),
        looks_for_ground(any_ground_carries(stage.as_run)),
        has_one_way(any_one_way(stage.as_run)) {
    for (const Vec2d& corner : character.shape.hull()) points.push_back(widened(rounded(corner)));
    for (const Part& part : std::exchange(stage.parts, {})) lookups.emplace_back(part.solids, part.colliders);
    world.SetAllowSleeping(false);
    world.SetContinuousPhysics(def.continuous);
    world.SetContactListener(&dispatcher);
    for (const Vec2d& position : positions) add_character(character, checked(position, "the character's position"));
  }

  void add_character(const CharacterDef& character, const b2Vec2& position);

  static void place(b2Body* body, const b2Vec2& position, const b2Vec2& velocity) {
    body->SetEnabled(false);  // The one way to have Box2D drop its contacts and the impulses stored in them.
    body->SetTransform(position, 0);
    body->SetLinearVelocity(velocity);
    body->SetEnabled(true);
  }

  void step(std::span<const TwinWish> wishes);
  void step_bare(std::span<const TwinWish> wishes);
  void read(Character& who);
  void add_touching(Character& who);
  void add_begun(Character& who);
  void add(Character& who, const SceneryEnd& end, const TouchPoint& touch, double fraction);
  static void add_met(TwinStep& result, CharacterIndex other, const Vec2d& normal, double fraction);
  void stand_on(TwinStep& result, const SceneryEnd& end, const TouchPoint& touch);
  static void add_sensor_events(Character& who);
  [[nodiscard]] ColliderIndex collider_of(const SceneryEnd& end, const Vec2d& point);
  [[nodiscard]] static double fraction_of(const Character& who, const SceneryEnd& end);
  [[nodiscard]] Vec2d wanted_relative_to(const Character& who, const SceneryEnd& end, const TouchPoint& touch) const;
  [[nodiscard]] bool moves_into(const Character& who, const SceneryEnd& end, const TouchPoint& touch) const {
    return touch.normal.dot(wanted_relative_to(who, end, touch)) < -least_approach;
  }

  ReferenceWorldDef def;
  std::vector<Vec2d> points;
  double least_up;  ///< Smallest upward part of the normal of walkable ground.
  b2World world{b2Vec2(0, 0)};
  SceneryBodies stage;
  std::deque<ColliderLookup> lookups;  ///< For what stands, then for each mover; they can neither be copied nor moved.
  std::deque<Character> characters;    ///< Their recorders are known to the dispatcher.
  Dispatcher dispatcher{characters};
  OneWayListener one_way{characters};
  b2ContactListener none;
  bool looks_for_ground;  ///< There is ground that carries.
  bool has_one_way;
  std::vector<TwinStep> results;
};

void ReferenceWorld::Impl::add_character(const CharacterDef& character, const b2Vec2& position) {
  const b2PolygonShape shape = character_polygon(character.shape.hull());
  b2BodyDef body_def;
  body_def.type = b2_dynamicBody;
  body_def.position = position;
  body_def.fixedRotation = true;
  body_def.bullet = def.bullet;
  body_def.allowSleep = false;
  Character& who = characters.emplace_back(stage.fixtures, points);
  b2Body* body = who.body = world.CreateBody(&body_def);
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.density = 1;
  fixture.friction = 0;
  fixture.restitution = 0;
  fixture.userData.pointer = who.source = stage.fixtures.sources.size();
  FixtureSource source;
  source.character = static_cast<CharacterIndex>(characters.size() - 1);
  stage.fixtures.sources.push_back(source);
  body->CreateFixture(&fixture);
  // Box2D moves the centre of mass and derives the position from it. With the centre at the position nothing is lost.
  b2MassData mass;
  mass.mass = body->GetMass();
  mass.center.SetZero();
  mass.I = 0;
  body->SetMassData(&mass);
}

void ReferenceWorld::Impl::step(std::span<const TwinWish> wishes) {
  for (std::size_t k = 0; k < characters.size(); ++k) {
    Character& who = characters[k];
    const b2Vec2 velocity = rounded(wishes[k].velocity);
    const b2Vec2 displacement = stage.dt * velocity;
    who.wanted = widened(displacement);
    who.result.capped = stage.capped || displacement.LengthSquared() > b2_maxTranslationSquared;
    who.body->SetLinearVelocity(velocity);
    who.recorder.begin_step(*who.body, who.wanted, stage.offsets, wishes[k].drop);
  }
  stage.step(def);
  for (Character& who : characters) who.recorder.end_step();
  results.clear();
  for (Character& who : characters) {
    read(who);
    results.push_back(who.result);
  }
}

/// Where nothing is one-way the recorders are left alone: each would note where its step begins.
void ReferenceWorld::Impl::step_bare(std::span<const TwinWish> wishes) {
  world.SetContactListener(has_one_way ? static_cast<b2ContactListener*>(&one_way) : &none);
  for (std::size_t k = 0; k < characters.size(); ++k) {
    Character& who = characters[k];
    const b2Vec2 velocity = rounded(wishes[k].velocity);
    who.body->SetLinearVelocity(velocity);
    if (has_one_way) who.recorder.begin_step(*who.body, widened(stage.dt * velocity), stage.offsets, wishes[k].drop);
  }
  stage.step(def);
  if (has_one_way)
    for (Character& who : characters) who.recorder.end_step();
  world.SetContactListener(&dispatcher);
}

/// What the step did to a character.
void ReferenceWorld::Impl::read(Character& who) {
  TwinStep& result = who.result;
  result.movers = stage.motions;
  result.velocity = widened(who.body->GetLinearVelocity());
  result.path = who.recorder.path();
  result.dropped_through = who.recorder.dropped_through(stage.motions);
  result.contacts.clear();
  result.met.clear();
  result.grounded = false;
  result.ground.reset();
  who.sensed.swap(who.sensed_before);
  who.sensed.clear();
  add_touching(who);
  add_begun(who);
  add_sensor_events(who);
  std::sort(result.contacts.begin(), result.contacts.end(), comes_before);
  std::stable_sort(result.met.begin(), result.met.end(), [](const auto& a, const auto& b) {
    return a.fraction < b.fraction || (a.fraction == b.fraction && a.other < b.other);
  });
}

double ReferenceWorld::Impl::fraction_of(const Character& who, const SceneryEnd& end) {
  for (const Beginning& beginning : who.recorder.beginnings()) {
    if (beginning.end.source == end.source && beginning.end.child == end.child) return beginning.fraction;
  }
  return 0;  // It touched when the step began.
}

/// What is touched goes with its mover, and around it.
Vec2d ReferenceWorld::Impl::wanted_relative_to(const Character& who, const SceneryEnd& end,
                                               const TouchPoint& touch) const {
  const FixtureSource& source = stage.fixtures.sources[end.source];
  if (source.character) {
    const std::vector<PathPoint>& path = characters[*source.character].recorder.path();
    return who.wanted - (path.back().position - path.front().position);
  }
  if (source.mover == no_mover) return who.wanted;
  const Vec2d arm = touch.point - end.offset;
  const MoverMotion& motion = stage.motions[source.mover];
  return who.wanted - (motion.to - motion.from) - motion.turn() * Vec2d(-arm.y(), arm.x());
}

void ReferenceWorld::Impl::add_touching(Character& who) {
  for (const b2ContactEdge* edge = who.body->GetContactList(); edge != nullptr; edge = edge->next) {
    const b2Contact& contact = *edge->contact;
    if (!contact.IsTouching() || !contact.IsEnabled()) continue;
    const SceneryEnd end = scenery_end(contact, *who.body);
    if (const FixtureSource& source = stage.fixtures.sources[end.source]; source.sensor) {
      who.sensed.push_back(*source.collider);
      continue;
    }
    for (const TouchPoint& touch : touch_points(contact, *who.body)) {
      const bool leaves = touch.normal.dot(wanted_relative_to(who, end, touch)) > least_approach;
      if (touch.normal.y() >= least_up && touch.gap <= standing_gap && !leaves) stand_on(who.result, end, touch);
      if (moves_into(who, end, touch)) add(who, end, touch, fraction_of(who, end));
    }
  }
}

/// Another character carries nobody.
void ReferenceWorld::Impl::stand_on(TwinStep& result, const SceneryEnd& end, const TouchPoint& touch) {
  result.grounded = true;
  if (!looks_for_ground || stage.fixtures.sources[end.source].character) return;
  const TwinStep::Ground ground{collider_of(end, touch.point), touch.normal};
  const auto rank = [](const TwinStep::Ground& one) { return std::pair(-one.normal.y(), one.collider); };
  if (!result.ground || rank(ground) < rank(*result.ground)) result.ground = ground;
}

/// After `add_touching`: what still touches is listed with the gap that is left, what does not with the gap it had.
/// What Box2D begins because it is within 20 mm is a contact only if the motion leads into it.
void ReferenceWorld::Impl::add_begun(Character& who) {
  for (const Beginning& beginning : who.recorder.beginnings()) {
    for (const TouchPoint& touch : beginning.points) {
      if (beginning.was_impact || moves_into(who, beginning.end, touch))
        add(who, beginning.end, touch, beginning.fraction);
    }
  }
}

/// A sensor is touched piece by piece; it is entered with the first and left with the last.
void ReferenceWorld::Impl::add_sensor_events(Character& who) {
  std::vector<ColliderIndex>& now = who.sensed;
  std::sort(now.begin(), now.end());
  now.erase(std::unique(now.begin(), now.end()), now.end());
  std::vector<SensorEvent>& events = who.result.sensors;
  events.clear();
  const auto add_missing = [&events](const std::vector<ColliderIndex>& these,
                                     const std::vector<ColliderIndex>& in_those, SensorEvent::Change change) {
    for (const ColliderIndex sensor : these)
      if (!std::binary_search(in_those.begin(), in_those.end(), sensor)) events.push_back({sensor, change, 0});
  };
  add_missing(who.sensed_before, now, SensorEvent::Change::exit);
  add_missing(now, who.sensed_before, SensorEvent::Change::enter);
}

/// The outline was moved by at most 5 mm and the point is rounded to float a few times; but at the end of a chain Box2D
/// may put a point beside the edge, where a foot is in the air: then what is nearest further away is meant.
ColliderIndex ReferenceWorld::Impl::collider_of(const SceneryEnd& end, const Vec2d& point) {
  const FixtureSource& source = stage.fixtures.sources[end.source];
  if (source.collider) return *source.collider;
  ColliderLookup& lookup = lookups[source.mover == no_mover ? 0 : source.mover + 1];
  const Vec2d arm = point - end.offset;
  const Vec2d place = {end.cosine * arm.x() + end.sine * arm.y(), end.cosine * arm.y() - end.sine * arm.x()};
  double reach = touch_gap + 16 * static_cast<double>(b2_epsilon) * point.cwiseAbs().maxCoeff();
  for (; std::isfinite(reach); reach *= 8)
    if (const std::optional<ColliderIndex> found = lookup.nearest(place, reach)) return *found;
  return 0;
}

/// One contact per collider and side; the first to come gives the geometry, the earliest the time.
void ReferenceWorld::Impl::add(Character& who, const SceneryEnd& end, const TouchPoint& touch, double fraction) {
  TwinStep& result = who.result;
  if (const auto& other = stage.fixtures.sources[end.source].character) {
    // Of who stands where it is met, its own way does not tell the time.
    const double of_other = fraction_of(characters[*other], {who.source, 0});
    return add_met(result, *other, touch.normal, std::max(fraction, of_other));
  }
  const ColliderIndex collider = collider_of(end, touch.point);
  const Side side = side_of_normal(touch.normal.x(), touch.normal.y());
  const auto same = std::find_if(result.contacts.begin(), result.contacts.end(), [&](const Contact& known) {
    return known.collider == collider && known.side == side;
  });
  if (same != result.contacts.end()) {
    same->fraction = std::min(same->fraction, fraction);
    return;
  }
  result.contacts.push_back({collider, touch.point, touch.normal, fraction, touch.gap, side});
}

void ReferenceWorld::Impl::add_met(TwinStep& result, CharacterIndex other, const Vec2d& normal, double fraction) {
  const Side side = side_of_normal(normal.x(), normal.y());
  const auto same = std::find_if(result.met.begin(), result.met.end(),
                                 [&](const CrowdContact& known) { return known.other == other && known.side == side; });
  if (same == result.met.end())
    result.met.push_back({other, normal, fraction, side});
  else
    same->fraction = std::min(same->fraction, fraction);
}

ReferenceWorld::ReferenceWorld(const Scenery& scenery, const CharacterDef& character, const Vec2d& position,
                               const ReferenceWorldDef& def)
    : ReferenceWorld(scenery, character, std::span(&position, 1), def) {}
ReferenceWorld::ReferenceWorld(const Scenery& scenery, const CharacterDef& character, std::span<const Vec2d> positions,
                               const ReferenceWorldDef& def)
    : impl_(std::make_unique<Impl>(scenery, character, positions, def)) {}
ReferenceWorld::~ReferenceWorld() = default;
ReferenceWorld::ReferenceWorld(ReferenceWorld&&) noexcept = default;
ReferenceWorld& ReferenceWorld::operator=(ReferenceWorld&&) noexcept = default;

void ReferenceWorld::place(const Vec2d& position, const Vec2d& velocity, std::size_t character) {
  const b2Vec2 at = checked(position, "the character's position");
  Impl::place(impl_->characters.at(character).body, at, checked(velocity, "the character's velocity"));
}

const TwinStep& ReferenceWorld::step(const Vec2d& wanted_velocity, double dt, std::span<const MoverMotion> movers,
                                     bool drop) {
  const TwinWish wish{wanted_velocity, drop};
  return step_all(std::span(&wish, 1), dt, movers).front();
}

std::span<const TwinStep> ReferenceWorld::step_all(std::span<const TwinWish> wishes, double dt,
                                                   std::span<const MoverMotion> movers) {
  if (wishes.size() != impl_->characters.size()) throw InvalidDefinition("a step takes one wish of each character");
  for (const TwinWish& wish : wishes) (void)checked(wish.velocity, "the wanted velocity");
  impl_->stage.send(dt, movers);
  impl_->step(wishes);
  return impl_->results;
}

void ReferenceWorld::step_bare(std::span<const TwinWish> wishes, double dt, std::span<const MoverMotion> movers) {
  if (wishes.size() != impl_->characters.size()) throw InvalidDefinition("a step takes one wish of each character");
  impl_->stage.send(dt, movers);
  impl_->step_bare(wishes);
}

Vec2d ReferenceWorld::position(std::size_t character) const {
  return widened(impl_->characters.at(character).body->GetPosition());
}
const SceneryDef& ReferenceWorld::as_run() const noexcept { return impl_->stage.as_run; }
const std::vector<Vec2d>& ReferenceWorld::points_as_run() const noexcept { return impl_->points; }
ReferenceWorld::Size ReferenceWorld::size() const noexcept { return impl_->stage.fixtures.size; }

}  // namespace paperproof::box2d
