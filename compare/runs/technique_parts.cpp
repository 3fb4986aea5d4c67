#include "runs/technique_parts.hpp"

#include "contains.hpp"
#include "records/row.hpp"

#include <paperproof/tolerances.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

std::vector<NamedTolerance> tolerances_of(ScalarKind scalar) {
  const Tolerances t = scalar == ScalarKind::binary32 ? tolerances_in_float : Tolerances{};
  return {{"hit", t.hit},         {"stop", t.stop},       {"touch", t.touch}, {"look", t.look},
          {"certain", t.certain}, {"restore", t.restore}, {"range", t.range}};
}

/// The article's techniques name the pair that was tested; all contenders are compared by where the normal points.
Contact recorded(Contact contact, Sides sides) {
  if (sides == Sides::of_normals) contact.side = side_of_normal(contact.normal.x(), contact.normal.y());
  return contact;
}

std::optional<TraceRide> recorded(const Ride& ride) {
  if (ride.ground == Ride::none) return std::nullopt;
  return TraceRide{ride.ground, ride.velocity};
}

/// That the picture techniques take.
constexpr double finest_raster = 1000;

bool is_turned(std::span<const KnobSetting> knobs, std::string_view name) {
  return std::ranges::any_of(knobs, [name](const KnobSetting& each) { return each.key == name; });
}

/// Scenery of vectors is drawn as finely as can be, since there the resolution is a knob. A picture that is drawn
/// with fewer pixels than it has is another level, and that is for the knob to say.
void refuse_coarser_drawing(const TechniqueEntry& technique, const Scene& scene, std::span<const KnobSetting> knobs) {
  if (!technique.draws_level || !scene.has_pixels || is_turned(knobs, "raster_pixels_per_metre")) return;
  if (scene.pixels_per_metre > finest_raster)
    throw NotApplicable(fmt::format("{} draws at most {} pixels per metre, and the scene's pixels are {} to the metre",
                                    technique.name, finest_raster, scene.pixels_per_metre));
}

/// A level of tiles is complete and has pixels of its own.
std::shared_ptr<const PixelTileSet> tiles_for(const TechniqueEntry& technique, const Scene& scene,
                                              std::span<const KnobSetting> knobs) {
  if (technique.name != "pixel_tile" || !scene.tiles) return nullptr;
  for (const std::string_view knob : {"raster_pixels_per_metre", "pixels_per_tile"})
    if (is_turned(knobs, knob))
      throw NotApplicable(fmt::format("pixel_tile has its tiles from the scene, where {} is no knob", knob));
  return scene.tiles;
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

CharacterDef with_rules(const Scene& scene, const JumpRules& turned, bool usual) {
  CharacterDef character = scene.character;
  const JumpRules& said = scene.jump_rules;
  character.no_jump_toward_wall = turned.no_jump_toward_wall.value_or(said.no_jump_toward_wall.value_or(usual));
  character.side_hit_ends_rise = turned.side_hit_ends_rise.value_or(said.side_hit_ends_rise.value_or(usual));
  return character;
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

double as_run(double value, ScalarKind scalar) noexcept {
  return scalar == ScalarKind::binary32 ? static_cast<double>(static_cast<float>(value)) : value;
}

Vec2d as_run(const Vec2d& value, ScalarKind scalar) noexcept {
  return {as_run(value.x(), scalar), as_run(value.y(), scalar)};
}

SceneryDef as_run(SceneryDef scenery, ScalarKind scalar) {
  const auto round_all = [scalar](std::vector<Vec2d>& points) {
    for (Vec2d& point : points) point = as_run(point, scalar);
  };
  for (ColliderDef& collider : scenery.colliders) {
    round_all(collider.points);
    for (std::vector<Vec2d>& hole : collider.holes) round_all(hole);
    collider.radius = as_run(collider.radius, scalar);
  }
  return scenery;
}

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

CharacterDef rules_for(const TechniqueEntry& technique, const Scene& scene, std::span<const KnobSetting> knobs) {
  const std::optional<bool> turned = turned_jump_rules(knobs);
  return with_rules(scene, {turned, turned}, technique.name != "octagon_sweep");
}

CharacterDef rules_for_twin(const Scene& scene) { return with_rules(scene, {}, false); }

double jump_rules_in_force(const CharacterDef& character) {
  return (character.no_jump_toward_wall ? 0.5 : 0) + (character.side_hit_ends_rise ? 0.5 : 0);
}

std::vector<bool> turning_movers(const Scene& scene) {
  std::vector<bool> turning;
  for (const MoverDef& mover : scene.movers) turning.push_back(!mover.turns.empty());
  if (!contains(turning, true)) turning.clear();
  return turning;
}

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

TraceHeader header_of(const TechniqueEntry& technique, ScalarKind scalar, const Scenery& scenery, const Scene& scene,
                      const Planning& planning) {
  const std::span<const KnobSetting> knobs = planning.knobs;
  TraceHeader header;
  header.scene = scene.name;
  header.contender = technique.name;
  header.scalar = name_of(scalar);
  header.knob = turned_knobs(knobs, technique.name);
  header.dt = as_run(scene.dt, scalar);
  header.characters = character_count(scene);
  for (const Vec2d& point : scene.character.shape.hull()) header.points.push_back(as_run(point, scalar));
  add_terms(scene, rules_for(technique, scene, knobs), header);
  TechniqueDef def;
  def.name = technique.name;
  turn_knobs(knobs, def);
  // Who answers fewer impacts than is usual does not promise what takes several.
  if (def.sweep_iterations < SweepDef{}.iterations) std::erase_if(header.guarantees, takes_several_impacts);
  header.scenery = as_run(scene.scenery, scalar);
  check_as_run(header.scenery, scenery.as_run(), scene.ids);
  header.ids = scene.ids;
  header.plan = plan_of(scenery, planning);
  header.tolerances = tolerances_of(scalar);
  // The steps in which the technique searches or moves; 0 where it computes.
  const double unit = technique.unit == nullptr ? 0 : technique.unit(article_knobs(technique, scene, knobs));
  if (unit > 0) header.tolerances.push_back({"unit", unit});
  if (technique.draws_level && scene.has_pixels && !is_turned(knobs, "raster_pixels_per_metre"))
    header.tolerances.push_back({"pixel", 1 / scene.pixels_per_metre});
  return header;
}

void write_state(const CharacterState& state, TraceStep& record) {
  record.velocity = state.velocity;
  record.grounded = state.grounded;
  record.jumping = state.jumping;
  record.ride = recorded(state.ride);
}

void write_report(const StepReport& report, const CharacterState& state, Sides sides, TraceStep& record) {
  const MoveResult& move = report.move;
  record.path.clear();
  record.path.assign(move.path.begin(), move.path.end());
  record.requested = report.requested;
  record.steered = report.steered;
  write_state(state, record);
  record.remainder = state.technique_memory;
  record.ground_velocity = state.ground.velocity;
  record.stuck = report.status == StepStatus::stuck;
  record.dropped = report.status == StepStatus::dropped;
  record.capped = false;
  record.crushed.assign(move.crushed.begin(), move.crushed.end());
  record.dropped_through.assign(report.dropped_through.begin(), report.dropped_through.end());
  record.sensors.assign(report.sensors.begin(), report.sensors.end());
  record.contacts.clear();
  for (const Contact& contact : move.contacts) record.contacts.push_back(recorded(contact, sides));
}

void refuse_unusable(StepStatus status, std::string_view refusal) {
  if (status == StepStatus::out_of_range)
    throw StepRefused("the motion would leave the range of +-2e6 m, and the run ends there");
  if (status == StepStatus::refused) throw StepRefused(fmt::format("{}, and the run ends there", refusal));
  if (status == StepStatus::invalid_input) throw std::runtime_error("the motion is not finite");
}

Pose pose_of(const CharacterState& state) {
  return {.position = state.position,
          .state = {.velocity = state.velocity,
                    .grounded = state.grounded,
                    .jumping = state.jumping,
                    .jump_held = state.jump_held,
                    .jump_pending = state.jump_pending,
                    .ride = recorded(state.ride)}};
}

CharacterState state_at(const Pose& pose, ScalarKind scalar) {
  CharacterState state;
  state.position = as_run(pose.position, scalar);
  state.velocity = as_run(pose.state.velocity, scalar);
  state.grounded = pose.state.grounded;
  state.jumping = pose.state.jumping;
  state.jump_held = pose.state.jump_held;
  state.jump_pending = pose.state.jump_pending;
  return state;
}

}  // namespace paperproof::compare
