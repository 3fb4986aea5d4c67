#include "crowd/among_movers_impacts.hpp"
#include "one_way_chains.hpp"
#include "scenery_facts.hpp"
#include "sensors.hpp"
#include "step_parts.hpp"

namespace paperproof::crowd {
namespace {

template <class Scalar>
SceneryDef with_places_for_company(const Scenery<Scalar>& scene, const CharacterShape& shape) {
  SceneryDef def = scene.as_run();
  ColliderDef place{.points = {shape.hull().begin(), shape.hull().end()}};
  for (std::size_t k = 0; k < most_company; ++k) {
    place.mover = static_cast<MoverIndex>(scene.mover_count() + k);
    def.colliders.push_back(place);
  }
  return def;
}

}  // namespace

template <class Scalar>
Surrounded<Scalar>::Surrounded(const Scenery<Scalar>& scene, const CharacterShape& shape)
    : scenery(with_places_for_company(scene, shape)),
      first_companion(static_cast<ColliderIndex>(scene.as_run().colliders.size())) {
  if (scenery.sensor_pieces().size() > 0) sensors = std::make_unique<Sensors<Scalar>>(scenery, shape);
  if (has_one_way_chains(scenery)) one_way = std::make_unique<OneWayChains<Scalar>>(scenery, shape);
}

template <class Scalar>
Surrounded<Scalar>::~Surrounded() = default;

template <class Scalar>
AmongMovers<Scalar>::AmongMovers(const Controller<Scalar>& controller, const Surrounded<Scalar>& surrounded,
                                 const CrowdRules<Scalar>& rules, WalkerMemory<Scalar>& memory,
                                 Scratch<Scalar>& scratch, CrowdReport<Scalar>& report, std::size_t count,
                                 const Vec2<Scalar>& gravity, Scalar dt,
                                 std::span<const MoverMotion<Scalar>> movers) noexcept
    : controller_(controller),
      surrounded_(surrounded),
      space_(rules.space),
      walkable_cosine_(rules.walkable_cosine),
      most_changes_(rules.most_impacts),
      memory_(memory),
      scratch_(scratch),
      report_(report),
      walkers_(std::span(memory.walkers).first(count)),
      timetable_(std::span(memory.rows).first(count)),
      gravity_(gravity),
      dt_(dt),
      movers_(movers) {}

template <class Scalar>
StepStatus AmongMovers<Scalar>::begin(std::span<const CharacterState<Scalar>> states,
                                      std::span<const Input> inputs) noexcept {
  report_.impacts = 0;
  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    if (!step_parts::finite(states[i], inputs[i], gravity_, dt_, movers_)) return StepStatus::invalid_input;
    Walker<Scalar>& walker = walkers_[i];
    CharacterState<Scalar>& state = walker.now.state;
    state = states[i];
    remember(states[i].pressers, state);
    // What is carried steers, jumps and falls relative to what carries it.
    if (state.ride.ground != Ride<Scalar>::none) state.velocity -= state.ride.velocity;
    walker.now.time = 0;
    const DesiredVelocity<Scalar> desired = desired_velocity(controller_.character(), gravity_, inputs[i], dt_, state);
    walker.now.own = desired.velocity;
    walker.now.steered = desired.steered;
    walker.start = walker.now;
    walker.company.clear();
    walker.changes = 0;
    walker.stays = walker.no_snap = walker.dropped = false;
    walker.walks = state.grounded;
    walker.drops = inputs[i].drop;
    clear(member(i));
    member(i).step.requested = walker.now.own * dt_;
    member(i).step.steered = desired.steered * dt_;
    walker.end = walker.now;
    if (!ask(i, 1, walker.plan, walker.end)) return StepStatus::out_of_range;
    walker.box = box_along(space_, walker.plan.path);
  }
  note_overlaps(space_, states, report_);
  return StepStatus::moved;
}

/// Whether a way of the whole step meets nobody on theirs.
template <class Scalar>
bool AmongMovers<Scalar>::is_clear(std::size_t i, const MoveResult<Scalar>& way) noexcept {
  for (std::size_t j = 0; j < walkers_.size(); ++j) {
    if (j == i) continue;
    FixedVector<PathPoint<Scalar>, 2 * MoveResult<Scalar>::max_corners> whole;
    for (const PathPoint<Scalar>& corner : member(j).step.move.path) whole.push_back(corner);
    for (const PathPoint<Scalar>& corner : walkers_[j].plan.path) whole.push_back(corner);
    const Way<Scalar> theirs{{whole.begin(), whole.size()}, 0, 1};
    const bool meets = i < j ? first_meeting(space_, way_of(way), theirs, Scalar(0), Tolerances<Scalar>{}.hit).meets
                             : first_meeting(space_, theirs, way_of(way), Scalar(0), Tolerances<Scalar>{}.hit).meets;
    if (meets) return false;
  }
  return true;
}

/// How far the movers go that crush it [m]; zero where none does, or where it began that way.
template <class Scalar>
Scalar AmongMovers<Scalar>::reach_of_crush(std::size_t i) noexcept {
  const Walker<Scalar>& walker = walkers_[i];
  if (walker.start.state.crushed) return 0;
  const std::vector<ColliderDef>& colliders = surrounded_.scenery.as_run().colliders;
  Scalar reach = 0;
  const auto look_at = [&](const MoveResult<Scalar>& way) {
    for (const ColliderIndex collider : way.crushed) {
      if (is_companion(collider)) continue;
      const MoverMotion<Scalar>& motion = movers_[colliders[collider].mover];
      reach = std::max(reach, (motion.to - motion.from).cwiseAbs().maxCoeff());
    }
  };
  look_at(member(i).step.move);
  look_at(walker.plan);
  return reach;
}

/// What crushes a character between two impacts may have left it room over the whole step. The technique looks for it
/// with the others going straight from where they began to where they end; whether their real ways leave it free is
/// looked at afterwards.
template <class Scalar>
void AmongMovers<Scalar>::seek_room(std::size_t i) noexcept {
  const Scalar reach = reach_of_crush(i);
  if (reach == 0) return;
  Walker<Scalar>& walker = walkers_[i];
  const Company company = walker.company;
  walker.company.clear();
  for (std::size_t j = 0; j < walkers_.size(); ++j)
    if (j != i && walkers_[j].box.overlaps(walker.box.inflated(reach)))
      walker.company.push_back(static_cast<CharacterIndex>(j));
  set_motions(walker.company, 0, 1);
  controller_.technique().move(request_at(walker, walker.start, 1), scratch_, memory_.part);
  MoveResult<Scalar>& way = memory_.way;
  way.clear();
  append(memory_.part, 0, 1, way);
  if (way.status == MoveStatus::out_of_range || !way.crushed.empty() || way.path.overflowed() || !is_clear(i, way)) {
    walker.company = company;
    return;
  }
  member(i).step.move.clear();
  walker.now = walker.end = walker.start;
  pass_on(memory_.part, 1, walker.end);
  walker.plan = way;
  walker.stays = false;
  walker.box = box_along(space_, way.path);
}

template <class Scalar>
void AmongMovers<Scalar>::finish(std::span<CharacterState<Scalar>> states) noexcept {
  for (std::size_t i = 0; i < walkers_.size(); ++i) seek_room(i);
  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    make(i, walkers_[i].plan);
    walkers_[i].box = box_along(space_, member(i).step.move.path);
  }
  const auto box_of = [this](std::size_t i) -> const Box2<Scalar>& { return walkers_[i].box; };
  keep_back_what_is_not_clear<Scalar>(space_, std::span(report_.members).first(walkers_.size()), box_of,
                                      [&](std::size_t i) { keep_back(i, states[i]); });
  for (std::size_t i = 0; i < walkers_.size(); ++i) hand_out(i, states[i]);
}

template <class Scalar>
void AmongMovers<Scalar>::keep_back(std::size_t i, const CharacterState<Scalar>& start) noexcept {
  CrowdMember<Scalar>& made = member(i);
  Walker<Scalar>& walker = walkers_[i];
  made.stayed = true;
  made.step.move.clear();
  walker.dropped = true;
  walker.now.time = 0;
  const CharacterState<Scalar> flags = walker.now.state;
  walker.now.state = start;
  walker.now.state.jump_held = flags.jump_held;
  walker.now.state.jump_pending = flags.jump_pending;
  ask_to_stay(i);
  make(i, walker.plan);
  walker.box = box_along(space_, made.step.move.path);
}

template <class Scalar>
void AmongMovers<Scalar>::hand_out(std::size_t i, CharacterState<Scalar>& state) noexcept {
  Walker<Scalar>& walker = walkers_[i];
  StepReport<Scalar>& report = member(i).step;
  MoveResult<Scalar>& move = report.move;
  if (!move.crushed.empty())
    move.status = MoveStatus::crushed;
  else if (!walker.end.state.pressers.empty())
    move.status = MoveStatus::stuck;  // also where another character came over it last, who is not named
  else if (move.status != MoveStatus::stuck)
    move.status = walker.dropped ? MoveStatus::dropped : MoveStatus::moved;
  report.status = step_parts::status_of(move.status);
  const std::span<const PathPoint<Scalar>> path(move.path.begin(), move.path.size());
  set_motions({}, 0, 1);
  if (surrounded_.sensors) surrounded_.sensors->observe(path, memory_.motions, scratch_.sensors, report.sensors);
  if (walker.drops && surrounded_.one_way)
    surrounded_.one_way->find_passed(path, memory_.motions, scratch_.one_way, report.dropped_through);
  CharacterState<Scalar> next = walker.end.state;
  move.pressers = next.pressers;
  step_parts::adopt(controller_.character(), move, next);
  state = next;
}

template struct Surrounded<float>;
template struct Surrounded<double>;
template class AmongMovers<float>;
template class AmongMovers<double>;

}  // namespace paperproof::crowd
