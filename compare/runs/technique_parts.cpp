#include "runs/technique_parts.hpp"

#include "records/row.hpp"

#include <paperproof/tolerances.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

using SensorChange = SensorEvent<double>::Change;

template <class Scalar>
std::vector<NamedTolerance> tolerances_of() {
  constexpr Tolerances<Scalar> t{};
  return {{"hit", t.hit},         {"stop", t.stop},       {"touch", t.touch}, {"look", t.look},
          {"certain", t.certain}, {"restore", t.restore}, {"range", t.range}};
}

template <class Scalar>
Vec2d widened(const Vec2<Scalar>& v) {
  return v.template cast<double>();
}

/// The article's techniques name the pair that was tested; all contenders are compared by where the normal points.
template <class Scalar>
Contact<double> recorded(const Contact<Scalar>& contact, Sides sides) {
  return {.collider = contact.collider,
          .point = widened<Scalar>(contact.point),
          .normal = widened<Scalar>(contact.normal),
          .fraction = static_cast<double>(contact.fraction),
          .separation = static_cast<double>(contact.separation),
          .side = sides == Sides::as_said ? contact.side : side_of_normal(contact.normal.x(), contact.normal.y())};
}

/// That the picture techniques take.
constexpr double finest_raster = 1000;

bool is_turned(std::span<const KnobSetting> knobs, std::string_view name) {
  return std::any_of(knobs.begin(), knobs.end(), [name](const KnobSetting& each) { return each.name == name; });
}

/// Scenery of vectors is drawn as finely as can be, since there the resolution is a knob. A picture that is drawn
/// with fewer pixels than it has is another level, and that is for the knob to say.
void refuse_coarser_drawing(const TechniqueEntry& technique, const Scene& scene, std::span<const KnobSetting> knobs) {
  if (!technique.draws_level || !scene.has_pixels || is_turned(knobs, "raster_pixels_per_metre")) return;
  if (scene.pixels_per_metre > finest_raster)
    throw NotApplicable(fmt::format("{} draws at most {} pixels per metre, and the scene's pixels are {} to the metre",
                                    technique.name, finest_raster, scene.pixels_per_metre));
}

/// A level of tiles is complete, has pixels of its own, and is in the way through its tiles alone.
std::shared_ptr<const PixelTileSet> tiles_for(const TechniqueEntry& technique, const Scene& scene,
                                              std::span<const KnobSetting> knobs) {
  if (technique.name != "pixel_tile" || !scene.tile_level.tiles) return nullptr;
  for (const std::string_view knob : {"raster_pixels_per_metre", "pixels_per_tile"})
    if (is_turned(knobs, knob))
      throw NotApplicable(fmt::format("pixel_tile has its tiles from the scene's file, where {} is no knob", knob));
  const std::vector<ColliderDef>& all = scene.scenery.colliders;
  const auto solids = std::count_if(all.begin(), all.end(), [](const ColliderDef& each) { return !each.sensor; });
  if (const std::size_t others = static_cast<std::size_t>(solids) - scene.tile_level.colliders; others > 0)
    throw NotApplicable(
        fmt::format("pixel_tile sees the tiles of the scene's file alone, and {} in the way beside them",
                    others == 1 ? "1 collider is" : fmt::format("{} colliders are", others)));
  return scene.tile_level.tiles;
}

std::shared_ptr<const SceneryDef> decoration_for(const TechniqueEntry& technique, const Scene& scene) {
  if (technique.name != "pixel_colour" || scene.decoration.empty()) return nullptr;
  SceneryDef drawn;
  for (const Decoration& each : scene.decoration) drawn.colliders.push_back({.points = each.polygon});
  return std::make_shared<const SceneryDef>(std::move(drawn));
}

/// The picture of the character has the scene's pixels.
std::vector<std::string> sprite_for(const TechniqueEntry& technique, const Scene& scene,
                                    std::span<const KnobSetting> knobs) {
  if (technique.name != "mask" || scene.sprite.empty()) return {};
  if (is_turned(knobs, "raster_pixels_per_metre") || scene.pixels_per_metre > finest_raster)
    throw NotApplicable("mask has the picture of the character from the scene, in the scene's pixels");
  return scene.sprite;
}

ArticleKnobs article_knobs(const TechniqueEntry& technique, const Scene& scene, std::span<const KnobSetting> knobs) {
  TechniqueDef def;
  def.name = technique.name;
  def.article.unit = 1 / scene.pixels_per_metre;
  def.article.raster_pixels_per_metre = std::min(scene.pixels_per_metre, finest_raster);
  turn_knobs(knobs, def);
  return def.article;
}

/// The steps in which the technique searches or moves [m]; 0 where it computes.
double unit_of(const TechniqueEntry& technique, const Scene& scene, std::span<const KnobSetting> knobs) {
  return technique.unit == nullptr ? 0 : technique.unit(article_knobs(technique, scene, knobs));
}

}  // namespace

TechniqueDef definition_of(const TechniqueEntry& technique, const Scene& scene, const Planning& planning) {
  const std::span<const KnobSetting> knobs = planning.knobs;
  TechniqueDef def;
  def.name = technique.name;
  if (planning.full) {
    def.broad_phase = BroadPhaseKind::all_pairs;
    def.search = PieceSearch::none;
  }
  def.article = article_knobs(technique, scene, knobs);
  turn_knobs(knobs, def);
  refuse_coarser_drawing(technique, scene, knobs);
  def.pixel_tiles = tiles_for(technique, scene, knobs);
  def.decoration = decoration_for(technique, scene);
  def.sprite = sprite_for(technique, scene, knobs);
  return def;
}

namespace {

CharacterDef with_rules(const Scene& scene, const JumpRules& turned, bool usual) {
  CharacterDef character = scene.character;
  const JumpRules& said = scene.jump_rules;
  character.no_jump_toward_wall = turned.no_jump_toward_wall.value_or(said.no_jump_toward_wall.value_or(usual));
  character.side_hit_ends_rise = turned.side_hit_ends_rise.value_or(said.side_hit_ends_rise.value_or(usual));
  return character;
}

}  // namespace

CharacterDef rules_for(const TechniqueEntry& technique, const Scene& scene, std::span<const KnobSetting> knobs) {
  const std::optional<bool> turned = turned_jump_rules(knobs);
  return with_rules(scene, {turned, turned}, technique.name != "octagon_sweep");
}

CharacterDef rules_for_twin(const Scene& scene) { return with_rules(scene, {}, false); }

double jump_rules_in_force(const CharacterDef& character) {
  return (character.no_jump_toward_wall ? 0.5 : 0) + (character.side_hit_ends_rise ? 0.5 : 0);
}

namespace {

/// What a scene says of a scenery, in the number type that runs.
template <class Scalar>
SceneryDef rounded(SceneryDef scenery) {
  const auto round = [](double& value) { value = static_cast<double>(static_cast<Scalar>(value)); };
  const auto round_all = [&round](std::vector<Vec2d>& points) {
    for (Vec2d& point : points) {
      round(point.x());
      round(point.y());
    }
  };
  for (ColliderDef& collider : scenery.colliders) {
    round_all(collider.points);
    for (std::vector<Vec2d>& hole : collider.holes) round_all(hole);
    round(collider.radius);
  }
  return scenery;
}

/// What runs must be what the scene says: the judge sees the latter.
/// @throws std::logic_error naming the collider that differs.
void check_as_run(const SceneryDef& said, const SceneryDef& runs, const std::vector<std::string>& ids) {
  const auto same = [](const ColliderDef& a, const ColliderDef& b) {
    return a.shape == b.shape && a.points == b.points && a.holes == b.holes && a.radius == b.radius &&
           a.mover == b.mover && a.sensor == b.sensor && a.one_way.has_value() == b.one_way.has_value();
  };
  for (std::size_t i = 0; i < said.colliders.size(); ++i)
    if (i >= runs.colliders.size() || !same(said.colliders[i], runs.colliders[i]))
      throw std::logic_error(fmt::format("the collider \"{}\" that runs is not the scene's", ids[i]));
}

}  // namespace

void add_terms(const Scene& scene, const CharacterDef& character, TraceHeader& header) {
  header.character = character;
  header.gravity = scene.gravity;
  for (std::size_t k = 0; k < character_count(scene); ++k)
    header.starts.push_back({start_of(scene, k).position, start_of(scene, k).velocity});
  header.respawn_box = scene.respawn_box;
  for (const MoverDef& mover : scene.movers)
    header.scripts.push_back(
        {.path = mover.path, .loop = mover.loop, .turns = mover.turns, .body = mover.body.has_value()});
  for (ColliderIndex i = 0; i < scene.scenery.colliders.size(); ++i)
    if (const MoverIndex mover = scene.scenery.colliders[i].mover; mover != no_mover)
      header.scripts[mover].colliders.push_back(i);
  if (is_guaranteed(header.contender, header.scalar)) header.guarantees = every_clause();
}

template <class Scalar>
TraceHeader header_of(const TechniqueEntry& technique, const Scenery<Scalar>& scenery, const Scene& scene,
                      const Planning& planning) {
  const std::span<const KnobSetting> knobs = planning.knobs;
  TraceHeader header;
  header.scene = scene.name;
  header.contender = technique.name;
  header.scalar = name_of(std::is_same_v<Scalar, float> ? ScalarKind::binary32 : ScalarKind::binary64);
  header.knob = turned_knobs(knobs, technique.name);
  header.dt = static_cast<double>(static_cast<Scalar>(scene.dt));
  header.characters = character_count(scene);
  for (const Vec2d& point : scene.character.shape.hull())
    header.points.push_back(point.cast<Scalar>().template cast<double>());
  add_terms(scene, rules_for(technique, scene, knobs), header);
  header.scenery = rounded<Scalar>(scene.scenery);
  check_as_run(header.scenery, scenery.as_run(), scene.ids);
  header.ids = scene.ids;
  header.plan = plan_of(scenery, planning);
  header.tolerances = tolerances_of<Scalar>();
  if (const double unit = unit_of(technique, scene, knobs); unit > 0) header.tolerances.push_back({"unit", unit});
  if (technique.draws_level && scene.has_pixels && !is_turned(knobs, "raster_pixels_per_metre"))
    header.tolerances.push_back({"pixel", 1 / scene.pixels_per_metre});
  return header;
}

template <class Scalar>
std::optional<TraceRide> recorded_ride(const Ride<Scalar>& ride) {
  if (ride.ground == Ride<Scalar>::none) return std::nullopt;
  return TraceRide{ride.ground, widened<Scalar>(ride.velocity)};
}

template <class Scalar>
void write_report(const StepReport<Scalar>& report, const CharacterState<Scalar>& state, Sides sides,
                  TraceStep& record) {
  const MoveResult<Scalar>& move = report.move;
  record.path.clear();
  for (const PathPoint<Scalar>& corner : move.path)
    record.path.push_back({widened<Scalar>(corner.position), static_cast<double>(corner.fraction)});
  record.requested = widened<Scalar>(report.requested);
  record.steered = static_cast<double>(report.steered);
  record.velocity = widened<Scalar>(state.velocity);
  record.remainder = widened<Scalar>(state.technique_memory);
  record.grounded = state.grounded;
  record.jumping = state.jumping;
  record.ride = recorded_ride(state.ride);
  record.ground_velocity = widened<Scalar>(state.ground.velocity);
  record.stuck = report.status == StepStatus::stuck;
  record.dropped = report.status == StepStatus::dropped;
  record.capped = false;
  record.crushed.assign(move.crushed.begin(), move.crushed.end());
  record.dropped_through.assign(report.dropped_through.begin(), report.dropped_through.end());
  record.sensors.clear();
  for (const SensorEvent<Scalar>& event : report.sensors) {
    const bool enters = event.change == SensorEvent<Scalar>::Change::enter;
    record.sensors.push_back(
        {event.sensor, enters ? SensorChange::enter : SensorChange::exit, static_cast<double>(event.fraction)});
  }
  record.contacts.clear();
  for (const Contact<Scalar>& contact : move.contacts) record.contacts.push_back(recorded(contact, sides));
}

void refuse_unusable(StepStatus status, std::string_view refusal) {
  if (status == StepStatus::out_of_range)
    throw StepRefused("the motion would leave the range of +-2e6 m, and the run ends there");
  if (status == StepStatus::refused) throw StepRefused(fmt::format("{}, and the run ends there", refusal));
  if (status == StepStatus::invalid_input) throw std::runtime_error("the motion is not finite");
}

template <class Scalar>
Pose pose_of(const CharacterState<Scalar>& state) {
  return {.position = widened<Scalar>(state.position),
          .velocity = widened<Scalar>(state.velocity),
          .grounded = state.grounded,
          .jumping = state.jumping,
          .jump_held = state.jump_held,
          .jump_pending = state.jump_pending,
          .ride = {.ground = state.ride.ground,
                   .place = widened<Scalar>(state.ride.place),
                   .velocity = widened<Scalar>(state.ride.velocity)}};
}

template <class Scalar>
CharacterState<Scalar> state_at(const Pose& pose) {
  CharacterState<Scalar> state;
  state.position = pose.position.cast<Scalar>();
  state.velocity = pose.velocity.cast<Scalar>();
  state.grounded = pose.grounded;
  state.jumping = pose.jumping;
  state.jump_held = pose.jump_held;
  state.jump_pending = pose.jump_pending;
  return state;
}

template TraceHeader header_of(const TechniqueEntry&, const Scenery<float>&, const Scene&, const Planning&);
template TraceHeader header_of(const TechniqueEntry&, const Scenery<double>&, const Scene&, const Planning&);
template std::optional<TraceRide> recorded_ride(const Ride<float>&);
template std::optional<TraceRide> recorded_ride(const Ride<double>&);
template void write_report(const StepReport<float>&, const CharacterState<float>&, Sides, TraceStep&);
template void write_report(const StepReport<double>&, const CharacterState<double>&, Sides, TraceStep&);
template Pose pose_of(const CharacterState<float>&);
template Pose pose_of(const CharacterState<double>&);
template CharacterState<float> state_at(const Pose&);
template CharacterState<double> state_at(const Pose&);

}  // namespace paperproof::compare
