#include "runs/technique_contestant.hpp"

#include <paperproof/controller.hpp>

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

/// `Scenery<double>` is shared by all contestants of a scene; one in float brings its own, rounded.
template <class Scalar>
class OwnScenery {
 public:
  explicit OwnScenery(const Scenery<double>& shared) : own_(shared.as_run()) {}
  [[nodiscard]] const Scenery<Scalar>& get() const noexcept { return own_; }

 private:
  Scenery<Scalar> own_;
};
template <>
class OwnScenery<double> {
 public:
  explicit OwnScenery(const Scenery<double>& shared) : shared_(shared) {}
  [[nodiscard]] const Scenery<double>& get() const noexcept { return shared_; }

 private:
  const Scenery<double>& shared_;
};

template <class Scalar>
class TechniqueContestant final : public Contestant {
 public:
  TechniqueContestant(TechniqueKind kind, const Scene& scene, const Scenery<double>& scenery, const Planning& planning)
      : scenery_(scenery),
        plan_(plan_of(scenery_.get(), scene.character, planning)),
        controller_(scenery_.get(), rules_for(kind, scene.character), definition(kind, scene, plan_)),
        scratch_(controller_.make_scratch()),
        gravity_(scene.gravity.cast<Scalar>()),
        dt_(static_cast<Scalar>(scene.dt)),
        motions_(scene.movers.size()) {
    header_.scene = scene.name;
    header_.contender = name_of(kind);
    header_.scalar = name_of(std::is_same_v<Scalar, float> ? ScalarKind::binary32 : ScalarKind::binary64);
    header_.dt = static_cast<double>(dt_);
    for (const Vec2d& point : scene.character.shape.hull())
      header_.points.push_back(point.cast<Scalar>().template cast<double>());
    header_.scenery = scenery_.get().as_run();
    header_.ids = scene.ids;
    header_.plan = plan_;
    header_.tolerances = tolerances_of<Scalar>();
    place({.position = scene.start.position, .velocity = scene.start.velocity});
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, TraceStep& record) override {
    const Ride<Scalar> ride = state_.ride;
    const Vec2d rode = motion_of(ride.ground);
    step_unrecorded(input);
    const MoveResult<Scalar>& move = report_.move;
    record.path.clear();
    for (const PathPoint<Scalar>& corner : move.path)
      record.path.push_back({corner.position.template cast<double>(), static_cast<double>(corner.fraction)});
    record.requested = report_.requested.template cast<double>() + carried_by(ride, rode);
    record.velocity = state_.velocity.template cast<double>();
    record.grounded = state_.grounded;
    record.jumping = state_.jumping;
    record.stuck = report_.status == StepStatus::stuck;
    record.dropped = report_.status == StepStatus::dropped;
    record.capped = false;
    record.movers.clear();
    for (const MoverMotion<Scalar>& motion : motions_)
      record.movers.push_back({motion.from.template cast<double>(), motion.to.template cast<double>()});
    record.crushed.assign(move.crushed.begin(), move.crushed.end());
    record.sensors.clear();
    for (const SensorEvent<Scalar>& event : report_.sensors) {
      const bool enters = event.change == SensorEvent<Scalar>::Change::enter;
      record.sensors.push_back(
          {event.sensor, enters ? SensorChange::enter : SensorChange::exit, static_cast<double>(event.fraction)});
    }
    record.contacts.clear();
    // The article's techniques name the pair that was tested; all contenders are compared by where the normal points.
    for (const Contact<Scalar>& contact : move.contacts)
      record.contacts.push_back({.collider = contact.collider,
                                 .point = contact.point.template cast<double>(),
                                 .normal = contact.normal.template cast<double>(),
                                 .fraction = static_cast<double>(contact.fraction),
                                 .separation = static_cast<double>(contact.separation),
                                 .side = side_of_normal(contact.normal.x(), contact.normal.y())});
    if (report_.status == StepStatus::out_of_range)
      throw LeftRange("the motion would leave the range of +-2e6 m, and the run ends there");
    if (report_.status == StepStatus::invalid_input) throw std::runtime_error("the motion is not finite");
  }

  void step_unrecorded(const StepInput& input) override {
    for (std::size_t i = 0; i < motions_.size(); ++i)
      motions_[i] = {input.movers[i].from.template cast<Scalar>(), input.movers[i].to.template cast<Scalar>()};
    controller_.step(state_, input.player, gravity_, dt_, motions_, scratch_, report_);
  }

  [[nodiscard]] Pose pose() const override {
    return {.position = state_.position.template cast<double>(),
            .velocity = state_.velocity.template cast<double>(),
            .grounded = state_.grounded,
            .jumping = state_.jumping,
            .jump_held = state_.jump_held,
            .jump_pending = state_.jump_pending,
            .ride = {.ground = state_.ride.ground,
                     .place = state_.ride.place.template cast<double>(),
                     .velocity = state_.ride.velocity.template cast<double>()}};
  }

  [[nodiscard]] std::size_t memory_bytes() const override { return controller_.technique().memory_bytes(); }

  void place(const Pose& pose) override {
    state_ = {};
    state_.position = pose.position.cast<Scalar>();
    state_.velocity = pose.velocity.cast<Scalar>();
    state_.grounded = pose.grounded;
    state_.jumping = pose.jumping;
    state_.jump_held = pose.jump_held;
    state_.jump_pending = pose.jump_pending;
  }

 private:
  /// Of the mover that a collider goes along with, in the present step or, before it, in the last one [m].
  [[nodiscard]] Vec2d motion_of(ColliderIndex ground) const {
    if (ground == Ride<Scalar>::none) return Vec2d::Zero();
    const MoverIndex mover = header_.scenery.colliders[ground].mover;
    if (mover == no_mover) return Vec2d::Zero();
    return (motions_[mover].to - motions_[mover].from).template cast<double>();
  }

  /// What the ground adds to the displacement of this step [m]. A conveyor's part is what was left of the ride's
  /// velocity in the last step, `rode` apart.
  [[nodiscard]] Vec2d carried_by(const Ride<Scalar>& ride, const Vec2d& rode) const {
    if (ride.ground == Ride<Scalar>::none) return Vec2d::Zero();
    Vec2d carried = motion_of(ride.ground);
    if (header_.scenery.colliders[ride.ground].surface_speed != 0)
      carried += ride.velocity.template cast<double>() * header_.dt - rode;
    return carried;
  }

  static TechniqueDef definition(TechniqueKind kind, const Scene& scene, const Plan& plan) {
    TechniqueDef def;
    def.kind = kind;
    def.broad_phase = plan.broad_phase;
    def.stages = plan.stages;
    def.article.unit = 1 / scene.pixels_per_metre;
    constexpr double finest = 1000;  // that the picture techniques take
    def.article.raster_pixels_per_metre = std::min(scene.pixels_per_metre, finest);
    return def;
  }

  /// The article's jumping rules belong to the article's techniques; for octagon_sweep they are the scene's choice.
  static CharacterDef rules_for(TechniqueKind kind, CharacterDef character) {
    if (kind != TechniqueKind::octagon_sweep) character.no_jump_toward_wall = character.side_hit_ends_rise = true;
    return character;
  }

  OwnScenery<Scalar> scenery_;
  Plan plan_;
  Controller<Scalar> controller_;
  Scratch<Scalar> scratch_;
  Vec2<Scalar> gravity_;
  Scalar dt_;
  std::vector<MoverMotion<Scalar>> motions_;  ///< Of the present step.
  TraceHeader header_;
  CharacterState<Scalar> state_;
  StepReport<Scalar> report_;
};

}  // namespace

std::unique_ptr<Contestant> make_technique_contestant(TechniqueKind kind, ScalarKind scalar, const Scene& scene,
                                                      const Scenery<double>& scenery, const Planning& planning) {
  if (scalar == ScalarKind::binary32)
    return std::make_unique<TechniqueContestant<float>>(kind, scene, scenery, planning);
  return std::make_unique<TechniqueContestant<double>>(kind, scene, scenery, planning);
}

}  // namespace paperproof::compare
