/// The part of a `b2World` that is near a hero, as scenery with motions.
#pragma once

#include <paperproof/box2d/hero.hpp>

#include <box2d/b2_math.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

class b2Shape;

namespace paperproof::box2d {

/// Where the hero is, as the bodies near it see it.
struct Stance {
  Vec2d position{Vec2d::Zero()};
  std::span<const Vec2d> hull;     ///< Relative to the position.
  const b2Body* ground = nullptr;  ///< The body that it stands on, if any.
  Vec2d normal{0, 1};              ///< Of that ground.
  Vec2d up{0, 1};                  ///< The side from which ledges block.
};

/// How much smaller than a fixture without a skin the fixture of a hero is for Box2D [m]. A polygon's skin is 1 cm: so
/// the two touch within 6.5 mm. Less than 6.25 mm: Box2D lets bodies rest 5 mm inside each other, give or take 1.25 mm,
/// and a crate would come to rest inside the hero. Much more: it pushes apart what the hero only touches.
inline constexpr float hero_inset = 0.0035F;

/// Where a body is: of another hero where that hero is, as the world moves its body before it steps [m].
[[nodiscard]] Vec2d place_of(const b2Body& body);

/// Reads the fixtures near a hero in each step. While nothing changes that the scenery is made of, the scenery stays.
class Level {
 public:
  Level(b2World& world, const b2Body& hero) noexcept : world_(&world), hero_(&hero) {}

  /// Reads all fixtures in a box, and how their bodies moved since `note_poses`.
  /// @param box of the hero in this step. A wider one is read, so that the scenery stays for some steps.
  /// @param dt for the motion of a body that was not near in the last step.
  /// @return whether the scenery is another than before.
  bool follow(const Box2<double>& box, const HeroDef& def, const Stance& stance, double dt);
  /// The bodies are where they are when the next step begins.
  void note_poses();
  void shift_origin(const Vec2d& new_origin);
  [[nodiscard]] std::span<b2Fixture* const> fixtures() const noexcept { return fixtures_; }
  [[nodiscard]] std::span<const BodyPose> poses() const noexcept { return poses_; }
  void restore_poses(std::span<const BodyPose> poses) { poses_.assign(poses.begin(), poses.end()); }

  [[nodiscard]] const SceneryDef& scenery() const noexcept { return scenery_; }
  [[nodiscard]] std::span<const MoverMotion<double>> motions() const noexcept { return motions_; }
  [[nodiscard]] b2Fixture* fixture(ColliderIndex collider) const noexcept { return fixtures_[collider]; }
  /// The first collider that is (a part of) a fixture, or `no_collider`.
  [[nodiscard]] ColliderIndex collider_of(const b2Fixture* fixture) const noexcept;
  /// Whether the body of a collider has turned since the last step.
  [[nodiscard]] bool has_turned(ColliderIndex collider) const noexcept;
  /// The box that was read.
  [[nodiscard]] const Box2<double>& box() const noexcept { return box_; }
  [[nodiscard]] std::span<b2Fixture* const> skipped() const noexcept { return skipped_; }
  /// Leaves out a collider that cannot be used.
  void skip(ColliderIndex collider);

 private:
  /// All of a fixture that the scenery is made of.
  struct Seen {
    b2Fixture* fixture = nullptr;
    b2Body* body = nullptr;
    const b2Shape* shape = nullptr;
    std::uint64_t geometry = 0;  ///< A hash of the shape's numbers.
    b2Vec2 place{0, 0};          ///< Of a body that stands; zero of one that moves.
    float angle = 0;
    float spin = 0;  ///< Of a circle on a body that turns [radians/s].
    bool moves = false;
    bool sensor = false;
    Surface surface;
    bool operator==(const Seen& other) const noexcept;
  };
  /// What moves as one: a body, or a circle on a body that turns.
  struct Mover {
    b2Body* body = nullptr;
    const b2Fixture* circle = nullptr;
    friend bool operator==(const Mover&, const Mover&) = default;
  };

  void look(const HeroDef& def);
  [[nodiscard]] Seen seen(b2Fixture& fixture, const HeroDef& def) const;
  void build(const HeroDef& def, const Vec2d& up);
  void add(const Seen& seen, ColliderDef collider, const Vec2d& up);
  [[nodiscard]] MoverIndex mover_of(const Seen& seen);
  /// Where a body was when the step began.
  [[nodiscard]] BodyPose begin_of(const b2Body& body, double dt) const;
  [[nodiscard]] MoverMotion<double> motion_of(const Mover& mover, const Stance& stance, double dt) const;
  /// The point of a body that keeps its place while it turns, as the step begins [m].
  [[nodiscard]] Vec2d pivot(const BodyPose& begin, const b2Body& body, double turn, const Stance& stance) const;

  b2World* world_;
  const b2Body* hero_;
  Box2<double> box_{Vec2d::Constant(1), Vec2d::Constant(-1)};
  Vec2d up_{0, 1};
  std::vector<b2Fixture*> found_;
  std::vector<Seen> seen_;
  std::vector<Seen> seen_before_;
  std::vector<BodyPose> poses_;
  SceneryDef scenery_;
  std::vector<b2Fixture*> fixtures_;  ///< One for each collider.
  std::vector<Mover> movers_;
  std::vector<MoverMotion<double>> motions_;
  std::vector<b2Fixture*> skipped_;
  bool is_cut_ = false;  ///< Some chain is in the scenery only as far as the box goes.
};

}  // namespace paperproof::box2d
