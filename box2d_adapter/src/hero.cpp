#include "hero_impl.hpp"
#include "shapes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace paperproof::box2d {
namespace {

/// The box around a shape, across up and along it.
Box2 seen_by(const UpFrame& frame, const CharacterShape& shape) {
  std::vector<Vec2d> seen;
  for (const Vec2d& point : shape.points()) seen.push_back(frame.seen(point));
  return Box2::around(seen);
}

}  // namespace

Hero::Impl::Impl(b2World& in, const HeroDef& from)
    : world(&in),
      def(from),
      body(&make_body(in, from)),
      fixtures(in, *body),
      controller(fixtures.level(), from.character),
      scratch(controller.make_scratch()) {
  make_fixture(def.filter);
  note_hero(*body, {&state.position, &def.character.shape});
  state.position = def.position;
  report.move.position = def.position;
}

Hero::Impl::~Impl() {
  note_hero(*body, {});
  world->DestroyBody(body);
}

/// Whether a shape would overlap nothing at a position. Bodies that moved since the hero's last step count where they
/// were then, as the hero does.
bool Hero::Impl::fits(const CharacterDef& character, const Vec2d& position) const {
  NearFixtures around(*world, *body);
  around.restore_poses(fixtures.poses());
  around.begin_step(def, up_of(gravity()), fixtures.dt(), state, contacts);
  const Box2& extent = character.shape.box();
  around.read({position + extent.lower, position + extent.upper});
  const Controller asked(around.level(), character);
  Scratch memory = asked.make_scratch();
  return asked.overlaps(position, {.dt = 1, .movers = around.motions()}, memory) == 0U;
}

/// After the shape has changed, or the way to move.
void Hero::Impl::change(const CharacterDef& character) {
  const bool same_shape = std::ranges::equal(def.character.shape.hull(), character.shape.hull());
  def.character = character;
  controller = Controller(fixtures.level(), character);
  scratch = controller.make_scratch();
  if (!same_shape) remake_fixture();
}

Hero::Hero(b2World& world, const HeroDef& def) : impl_(std::make_unique<Impl>(world, def)) {}
Hero::~Hero() = default;
Hero::Hero(Hero&&) noexcept = default;
Hero& Hero::operator=(Hero&&) noexcept = default;

StepStatus Hero::step(const Input& input, double dt) {
  Impl& hero = *impl_;
  return hero.advance(dt, [&](const StepContext& context) {
    return hero.controller.step(hero.state, input, context, hero.scratch, hero.report);
  });
}

StepStatus Hero::move(const Vec2d& displacement, double dt) {
  Impl& hero = *impl_;
  return hero.advance(dt, [&](const StepContext& context) {
    return hero.controller.move(hero.state, displacement, context, hero.scratch, hero.report);
  });
}

const CharacterState& Hero::state() const noexcept { return impl_->state; }
const StepReport& Hero::report() const noexcept { return impl_->report; }
std::span<const HeroContact> Hero::contacts() const noexcept { return impl_->contacts; }
std::span<const HeroSensorEvent> Hero::sensors() const noexcept { return impl_->sensors; }
std::span<b2Fixture* const> Hero::crushed_by() const noexcept { return impl_->crushed_by; }
std::span<b2Fixture* const> Hero::skipped() const noexcept { return impl_->skipped; }
b2Body& Hero::body() const noexcept { return *impl_->body; }
b2Fixture* Hero::fixture_of(ColliderIndex collider) const noexcept { return impl_->fixtures.fixture_of(collider); }

b2Fixture* Hero::ground() const noexcept {
  const Ground& ground = state().ground;
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
  impl_->struck.setZero();
  impl_->body->SetTransform(rounded(position), 0);
  impl_->body->SetLinearVelocity(rounded(velocity));
}

void Hero::knock_back(const Vec2d& velocity) {
  require_number(Vec2d(impl_->state.velocity + velocity), "velocity of a hero: must be below 1e6 m/s");
  paperproof::knock_back(impl_->state, velocity);
}

void Hero::set_velocity(const Vec2d& velocity) {
  require_number(velocity, "velocity of a hero: must be below 1e6 m/s");
  CharacterState& state = impl_->state;
  if ((velocity - state.ride.velocity).dot(up_of(impl_->gravity())) > 0) knock_back({0, 0});
  state.velocity = velocity;
}

bool Hero::change(const CharacterDef& character) {
  character.validate();
  (void)character_polygon(character.shape.hull());
  Impl& hero = *impl_;
  require(!hero.world->IsLocked(), "a hero cannot change during a step of the world");
  const UpFrame frame(up_of(hero.gravity()));
  const Box2 old_box = seen_by(frame, hero.def.character.shape);
  const Box2 box = seen_by(frame, character.shape);
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
  for (Crusher& crusher : hero.state.crushers) crusher.last_free -= new_origin;
  hero.fixtures.shift_origin(new_origin);
  hero.body->SetTransform(rounded(hero.state.position), 0);
}

HeroSave Hero::save() const {
  const Impl& hero = *impl_;
  const std::span<const BodyPose> poses = hero.fixtures.poses();
  HeroSave save{.character = hero.def.character,
                .state = hero.state,
                .ride = hero.fixtures.fixture_of(hero.state.ride.ground),
                .ground = hero.fixtures.fixture_of(hero.state.ground.collider),
                .poses = {poses.begin(), poses.end()},
                .contacts = hero.contacts,
                .inside = hero.inside,
                .body_position = hero.body->GetPosition(),
                .body_velocity = hero.body->GetLinearVelocity(),
                .is_bullet = hero.body->IsBullet(),
                .struck = hero.struck};
  for (const Crusher& crusher : hero.state.crushers)
    save.crushers.push_back(hero.fixtures.fixture_of(crusher.collider));
  return save;
}

void Hero::restore(const HeroSave& save) {
  Impl& hero = *impl_;
  require(!hero.world->IsLocked(), "a hero cannot be restored during a step of the world");
  hero.change(save.character);
  hero.state = save.state;
  hero.contacts = save.contacts;
  hero.fixtures.restore_poses(save.poses);
  hero.fixtures.begin_step(hero.def, up_of(hero.gravity()), hero.fixtures.dt(), hero.state, hero.contacts);
  hero.read_near(hero.controller.reach(hero.state, {.gravity = hero.gravity(), .dt = hero.fixtures.dt()}));
  // A fixture that is near keeps its ids: it may have several.
  const auto rename = [&](ColliderIndex& id, b2Fixture* fixture) {
    if (fixture != nullptr && hero.fixtures.fixture_of(id) != fixture) id = hero.fixtures.id_of(fixture);
  };
  rename(hero.state.ride.ground, save.ride);
  rename(hero.state.ground.collider, save.ground);
  for (std::size_t i = 0; i < save.crushers.size(); ++i) rename(hero.state.crushers[i].collider, save.crushers[i]);
  hero.inside = save.inside;
  hero.sensors.clear();
  hero.crushed_by.clear();
  hero.skipped.clear();
  hero.body->SetTransform(save.body_position, 0);
  hero.body->SetLinearVelocity(save.body_velocity);
  hero.body->SetBullet(save.is_bullet);
  hero.struck = save.struck;
}

}  // namespace paperproof::box2d
