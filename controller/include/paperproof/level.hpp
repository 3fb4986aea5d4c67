/// A level that changes between steps: colliders come, go and turn.
#pragma once

#include <paperproof/controller.hpp>
#include <paperproof/local_controller.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace paperproof {

/// A set of colliders that may be edited between steps: tiles that break, doors, bridges. A `Scenery` is fixed, and
/// steps through it are faster.
///
/// Colliders are named by ids. An id is stamped with a generation: the id of a removed collider never names another
/// one (but a copy of the level, which is edited apart, gives the same ids again). Without edits the ids are 0, 1, 2
/// and so on. To add, replace or remove a collider takes about a microsecond, however large the level is.
///
/// Not thread-safe while it is edited. Any number of threads may read it meanwhile, each with its own
/// `LevelController`.
class Level {
 public:
  Level() = default;
  /// @throws InvalidScenery as `add`, with the index of the collider.
  explicit Level(const SceneryDef& def);

  /// @param def its `mover` is the index of a pose in `LevelContext::movers`, and may be any number below 65,536.
  /// @throws InvalidScenery as `Scenery`; std::length_error for more than 2^24 - 1 colliders. Nothing changed then.
  ColliderIndex add(const ColliderDef& def);
  /// Gives a collider another definition. It keeps its id, so a character keeps riding on it.
  /// @return false if there is no collider of this id. @throws InvalidScenery as `add`.
  bool replace(ColliderIndex id, const ColliderDef& def);
  /// Whoever stands on it falls in the next step. @return false if there is no collider of this id.
  bool remove(ColliderIndex id);

  /// @return null if there is no collider of this id. Valid until the next edit.
  [[nodiscard]] const ColliderDef* find(ColliderIndex id) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// One more than the highest index of a mover that ever moved a collider.
  [[nodiscard]] std::size_t mover_count() const noexcept { return movers_.size(); }
  /// Another number after each edit, copy or move, of this level or another one: what a controller read holds while
  /// this number is the same.
  [[nodiscard]] std::uint64_t last_edit() const noexcept { return last_edit_.number; }

  /// Appends all colliders without a mover that are in a box, in no order, each once or more often.
  void find_standing(const Box2& box, std::vector<NearCollider>& found) const;
  /// Appends all colliders of movers that come into a box during a step.
  void find_moving(const Box2& box, std::span<const PoseMotion> movers, std::vector<NearCollider>& found) const;

 private:
  struct Slot {
    ColliderDef def;
    Box2 box;  ///< Where the pose is zero.
    std::uint64_t version = 0;
    std::uint32_t generation = 0;
    bool is_used = false;
  };
  /// A copy has a number of its own. So has what was moved from.
  struct Edit {
    Edit() = default;
    Edit(const Edit&) noexcept { renew(); }
    Edit(Edit&& from) noexcept : Edit(from) { from.renew(); }
    Edit& operator=(const Edit&) noexcept { return renew(); }
    Edit& operator=(Edit&& from) noexcept { return from.renew(), renew(); }
    ~Edit() = default;
    Edit& renew() noexcept;

    std::uint64_t number = 0;
  };
  /// A cell of a grid; grids have cells of 1 m, 2 m, 4 m and so on. A collider lies in the cells of the finest grid
  /// whose cells are not smaller than the collider, hence in at most four.
  struct Cell {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t grid = 0;
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  struct CellHash {
    std::size_t operator()(const Cell& cell) const noexcept;
  };
  static constexpr std::size_t grid_count = 24;

  [[nodiscard]] const Slot* slot_of(ColliderIndex id) const noexcept;
  [[nodiscard]] static int grid_of(const Box2& box) noexcept;
  template <class Visit>
  static void for_each_cell(const Box2& box, int grid, const Visit& visit);
  void place(ColliderIndex id, Slot& slot, const ColliderDef& def);
  void displace(ColliderIndex id, Slot& slot);

  std::vector<Slot> slots_;
  std::vector<std::uint32_t> unused_;  ///< Slots whose colliders were removed, last removed last.
  std::unordered_map<Cell, std::vector<ColliderIndex>, CellHash> cells_;
  std::array<std::uint32_t, grid_count> in_grid_{};  ///< How many colliders stand in each grid.
  std::vector<std::vector<ColliderIndex>> movers_;
  std::size_t size_ = 0;
  Edit last_edit_;
};

/// The surroundings of a step in a level: see `StepContext`.
struct LevelContext {
  Vec2d gravity{Vec2d::Zero()};          ///< [m/s²]
  double dt = 0;                         ///< [s]
  std::span<const PoseMotion> movers{};  ///< At least `Level::mover_count()`.
  const ColliderFilter* filter = nullptr;
  Vec2d up{0, 1};
};

/// Steps one character through a level. Reports and state name colliders by their ids in the level. A state may be
/// copied, saved and restored; a controller keeps nothing that changes a result.
///
/// A step reads what is near the character. While that does not change, what was read is used again. Steps give the
/// same bits as those of a `Controller` over a `Scenery` of all colliders in the order of their places. Steps allocate
/// where what is near has changed. See `LocalController` for what turns.
///
/// Not thread-safe: each thread brings its own.
class LevelController {
 public:
  /// @param level must outlive the controller. @throws InvalidCharacter
  LevelController(const Level& level, const CharacterDef& character) : level_(&level), local_(character) {}

  /// One step: see `Controller::step`. `invalid_input` also if there are fewer movers than `Level::mover_count()`, or
  /// a pose is not finite or beyond 1e6.
  StepStatus step(CharacterState& state, const Input& input, const LevelContext& context, StepReport& report);
  /// One step of a game that owns its velocities: see `Controller::move`.
  StepStatus move(CharacterState& state, const Vec2d& displacement, const LevelContext& context, StepReport& report);
  /// How many solid colliders a character of this kind would overlap, where the movers' motions begin.
  [[nodiscard]] std::optional<std::size_t> overlaps(const Vec2d& position, const LevelContext& context);
  /// What moved near the character in the last step, as the step saw it; empty where nothing near it turned.
  [[nodiscard]] std::span<const TurnedCollider> turned() const noexcept { return local_.turned(); }
  [[nodiscard]] const CharacterDef& character() const noexcept { return local_.character(); }

 private:
  [[nodiscard]] bool accepts(const LevelContext& context) const noexcept;
  [[nodiscard]] LocalController::Find finder(const LevelContext& context);

  const Level* level_;
  LocalController local_;
  std::vector<NearCollider> standing_;  ///< In `read_`, after `last_edit_`.
  Box2 read_{Vec2d::Constant(1), Vec2d::Constant(-1)};
  std::uint64_t last_edit_ = 0;
};

}  // namespace paperproof
