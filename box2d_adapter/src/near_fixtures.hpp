/// The fixtures of a `b2World` that are near a hero, as a level.
#pragma once

#include <paperproof/box2d/hero.hpp>
#include <paperproof/scenery.hpp>

#include <box2d/b2_math.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

class b2Shape;

namespace paperproof::box2d {

/// How much smaller than a fixture without a skin the fixture of a hero is for Box2D [m]. A polygon's skin is 1 cm: so
/// the two touch within 6.5 mm. Less than 6.25 mm: Box2D lets bodies rest 5 mm inside each other, give or take 1.25 mm,
/// and a crate would come to rest inside the hero. Much more: it pushes apart what the hero only touches.
inline constexpr float hero_inset = 0.0035F;

/// Whether a fixture is that of a hero's body.
[[nodiscard]] inline bool is_of_hero(const b2Fixture& fixture) noexcept {
  return fixture.GetShape()->m_radius == -hero_inset;
}

/// A hero as the other heroes see it.
struct HeroInWorld {
  const Vec2d* place = nullptr;           ///< Its position [m].
  const CharacterShape* shape = nullptr;  ///< Its body is larger.
};

/// Notes the hero of a body, for the other heroes. Thread-safe.
/// @param hero its pointers must stay valid. An empty one removes the entry.
void note_hero(const b2Body& body, const HeroInWorld& hero);

/// Position of a body [m]; for the body of another hero that hero's own, because `world.Step` moved the body and the
/// hero has not stepped yet.
[[nodiscard]] Vec2d place_of(const b2Body& body);

/// Reads fixtures anew in each step. What did not change stays in the level as it is.
class NearFixtures {
 public:
  NearFixtures(b2World& world, b2Body& hero) noexcept : world_(&world), hero_(&hero) {}

  /// Before the first `read` of a step.
  /// @param up the side from which ledges block.
  /// @param dt for the motion of a body that was not near in the last step.
  /// @param state of the hero, when the step begins. @param contacts of the step before.
  void begin_step(const HeroDef& def, const Vec2d& up, double dt, const CharacterState& state,
                  std::span<const HeroContact> contacts);
  /// Reads all fixtures in a box, and how their bodies moved since `note_poses`.
  void read(const Box2& box);
  /// From now on these bodies go so, wherever they are in the world, and other heroes of their party are not there.
  /// @param party the bodies of heroes that take turns. Empty: all go as they went in the world.
  void show(std::span<b2Body* const> party, const std::map<const b2Body*, MoverMotion>& shown) {
    party_.assign(party.begin(), party.end());
    shown_ = shown;
  }
  /// Those that were read last.
  [[nodiscard]] const Level& level() const noexcept { return level_; }
  /// Whether a collider is there in the step: it is not the body of a hero that is not shown.
  [[nodiscard]] bool is_there(ColliderIndex id) const;
  /// Of its movers.
  [[nodiscard]] std::span<const MoverMotion> motions() const noexcept { return motions_; }
  /// Those that no collider can be made of: see `InvalidScenery`.
  [[nodiscard]] std::vector<b2Fixture*> unusable() const;
  /// The bodies are where they are when the next step begins.
  void note_poses();

  /// Null for a collider that was not there in the last step.
  [[nodiscard]] b2Fixture* fixture_of(ColliderIndex id) const noexcept;
  /// Its body in the last step, even if the fixture was destroyed since. Null as for `fixture_of`.
  [[nodiscard]] const b2Body* body_of(ColliderIndex id) const noexcept;
  /// The id of (the first part of) a fixture; `no_collider` for one that is not near.
  [[nodiscard]] ColliderIndex id_of(b2Fixture* fixture) const;
  /// Whether a fixture was found in the last step.
  [[nodiscard]] bool is_near(const b2Fixture* fixture) const noexcept;
  [[nodiscard]] bool any_sensor() const noexcept;
  /// Of the body of a fixture that was found in the last step.
  [[nodiscard]] MoverMotion motion_of(b2Fixture& fixture) const;

  void shift_origin(const Vec2d& new_origin);
  /// Of the last step [s]; zero before the first one.
  [[nodiscard]] double dt() const noexcept { return dt_; }
  [[nodiscard]] std::span<const BodyPose> poses() const noexcept { return poses_; }
  void restore_poses(std::span<const BodyPose> poses) { poses_.assign(poses.begin(), poses.end()); }

 private:
  /// All of a fixture that its colliders are made of.
  struct Seen {
    const b2Body* body = nullptr;
    const b2Shape* shape = nullptr;
    std::uint64_t geometry = 0;  ///< A hash of the shape's numbers.
    b2Vec2 place{0, 0};          ///< Of a body that stands; zero of one that moves.
    float angle = 0;             ///< The same.
    bool moves = false;
    bool sensor = false;
    Surface surface;
    std::optional<Vec2d> one_way{};  ///< The side from which alone it blocks, as the body sees it.
    /// Corners of the box to which a long chain is cut; else always the same.
    std::array<Vec2d, 2> cut{Vec2d::Zero(), Vec2d::Zero()};
    friend bool operator==(const Seen&, const Seen&) = default;
  };
  struct Known {
    Seen seen;  ///< Of no body: not yet.
    bool is_unusable = false;
    std::vector<ColliderIndex> parts;  ///< One, but of a chain that is cut.
    /// Of a one-sided shape: its vertices, in the world or, of a body that may move, relative to the body; and what
    /// they face.
    std::vector<Vec2d> chain;
    std::optional<Vec2d> front;
  };

  struct Near {
    b2Fixture* fixture;
    Known* known;
  };

  void search(const Box2& box);
  [[nodiscard]] Seen seen(b2Fixture& fixture, Known& known, const Box2& box) const;
  [[nodiscard]] std::optional<Vec2d> one_way_of(const b2Fixture& fixture, const Known& known) const;
  void define(const Near& near);
  void put(const std::vector<ColliderDef>& defs, const Near& near);
  void take_out(const Known& known);
  [[nodiscard]] MoverIndex mover_of(const b2Fixture& fixture);
  void free_movers();
  /// Where a body was when the step began.
  [[nodiscard]] BodyPose begin_of(const b2Body& body) const;

  b2World* world_;
  b2Body* hero_;
  const HeroDef* def_ = nullptr;
  Vec2d up_{0, 1};
  double dt_ = 0;
  CharacterState begin_;                   ///< Of the hero, when the step begins.
  std::vector<const b2Fixture*> touched_;  ///< What it stands on and touched.
  std::vector<b2Body*> party_;
  std::map<const b2Body*, MoverMotion> shown_;  ///< Those of the party that are there.
  std::map<b2Fixture*, Known> known_;
  std::vector<b2Fixture*> hits_;
  std::vector<Near> near_;  ///< Found in the last search.
  std::vector<BodyPose> poses_;
  Level level_;
  std::vector<b2Fixture*> fixture_of_slot_;     ///< By `Level::slot_of`.
  std::map<const b2Body*, MoverIndex> movers_;  ///< The first of two: wheels are movers of their own.
  std::vector<MoverIndex> free_movers_;
  std::vector<MoverMotion> motions_;
};

}  // namespace paperproof::box2d
