/// Listens to one step of Box2D: where the character was seen, and which contacts began.
#pragma once

#include "fixtures.hpp"

#include <box2d/b2_contact.h>
#include <box2d/b2_world_callbacks.h>

#include <span>
#include <vector>

namespace paperproof::box2d {

/// One point of a contact in world metres, as Box2D's manifold has it at the body's present position.
struct TouchPoint {
  Vec2d point{Vec2d::Zero()};   ///< On the obstacle's bare surface.
  Vec2d normal{Vec2d::Zero()};  ///< Unit, towards the character.
  /// Between the bare surfaces [m]: Box2D's separation plus the radii of both shapes, 20 mm for polygons and edges.
  double gap = 0;
};

/// The other side of a contact of the character: scenery, or another character.
struct SceneryEnd {
  std::size_t source = 0;  ///< Position in `SceneryFixtures::sources`.
  int32 child = 0;
  Vec2d offset{Vec2d::Zero()};  ///< Of its body at that moment [m],
  double cosine = 1;            ///< and how far that was turned.
  double sine = 0;
};
[[nodiscard]] SceneryEnd scenery_end(const b2Contact& contact, const b2Body& character);

[[nodiscard]] FixedVector<TouchPoint, b2_maxManifoldPoints> touch_points(const b2Contact& contact,
                                                                         const b2Body& character);

/// A contact that began during the step, copied: Box2D may destroy it before the step ends.
struct Beginning {
  SceneryEnd end;
  double fraction = 0;
  bool was_impact = false;  ///< Continuous collision stopped the body there; else it was near when the step began.
  FixedVector<TouchPoint, b2_maxManifoldPoints> points;
};

/// What a reference world hears about one character. Box2D calls back in three phases, and only the third moves the
/// body between calls: Collide (the body is where the step began), Solve (PostSolve sees it at the end of its way,
/// before continuous collision), SolveTOI (the body is moved along that way to each impact, and on from there).
class StepRecorder {
 public:
  /// `sources` and `hull` (relative to the position, as run) must outlive the recorder.
  StepRecorder(const std::vector<FixtureSource>& sources, const std::vector<Vec2d>& hull)
      : sources_(sources), hull_(hull) {}

  /// @param offsets of the movers when the step begins [m]; must outlive the step.
  /// @param drop one-way segments block nothing in this step.
  void begin_step(const b2Body& character, const Vec2d& wanted_displacement, std::span<const Vec2d> offsets, bool drop);
  void end_step();
  /// Whether a call about this contact is for this recorder.
  [[nodiscard]] bool watches(const b2Contact& contact) const {
    const auto is_its = [this](const b2Fixture* fixture) { return fixture->GetBody() == character_; };
    return character_ != nullptr && (is_its(contact.GetFixtureA()) || is_its(contact.GetFixtureB()));
  }

  [[nodiscard]] std::span<const Beginning> beginnings() const noexcept { return beginnings_; }
  [[nodiscard]] const std::vector<PathPoint>& path() const noexcept { return path_; }
  /// False for a sensor, and for a one-way segment while the character is not wholly on the side that it blocks.
  [[nodiscard]] bool blocks(std::size_t source) const;
  /// After the step: see `TwinStep`. @param movers as they went.
  [[nodiscard]] std::vector<ColliderIndex> dropped_through(std::span<const MoverMotion> movers) const;

  // For contacts that it watches:
  void begin_contact(const b2Contact& contact);
  void pre_solve(b2Contact& contact);
  /// The part of it that Box2D needs to know: what does not block is passed.
  void let_through(b2Contact& contact) const;
  void post_solve();

 private:
  enum class Phase : std::uint8_t { collide, solved, impacts };

  void look();
  [[nodiscard]] bool wholly_above(const FixtureSource& segment, const Vec2d& position, const Vec2d& offset) const;
  [[nodiscard]] bool leaves(const FixtureSource& segment, const MoverMotion& motion) const;
  [[nodiscard]] double fraction_at(const Vec2d& position) const;

  const std::vector<FixtureSource>& sources_;
  const std::vector<Vec2d>& hull_;
  const b2Body* character_ = nullptr;  ///< Null between steps: destroying contacts calls back as well.
  std::span<const Vec2d> offsets_;
  bool drops_ = false;
  Phase phase_ = Phase::collide;
  Vec2d step_start_{Vec2d::Zero()};
  PathPoint leg_start_;           ///< Where the straight leg that the body is on began.
  Vec2d leg_end_{Vec2d::Zero()};  ///< Where it leads to at fraction 1.
  PathPoint seen_;                ///< Last position seen.
  std::vector<PathPoint> path_;
  std::vector<Beginning> beginnings_;
};

}  // namespace paperproof::box2d
