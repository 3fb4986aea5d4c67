/// The one interface of all techniques: the wanted move goes in, the possible move comes out.
#pragma once

#include <paperproof/character.hpp>
#include <paperproof/report_vector.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/up_frame.hpp>

#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace paperproof {

/// Which colliders are there for a character in one step: those that collide by the filters, and by a predicate.
///
/// A predicate does not take seams away. Of two tiles that abut, the sides between them stay covered if one is left
/// out: the character is stopped at half the usual gap there. Chains that are one surface stay one. Give such colliders
/// different filters instead: see `ColliderDef::filter`.
struct ColliderFilter : Filter {
  /// If set, it is asked for each collider that collides by the filters: false if the collider is not there. During a
  /// step it must give the same answers, and between steps it may change them. It must not throw. It may be called from
  /// any thread that steps.
  bool (*is_there)(ColliderIndex collider, const void* user) = nullptr;
  const void* user = nullptr;       ///< Handed to `is_there`.
  ColliderIndex end = no_collider;  ///< A `Crowd` sets it: its own colliders begin here.

  template <class Scalar>
  [[nodiscard]] bool operator()(const Scenery<Scalar>& scenery, ColliderIndex collider) const noexcept {
    return (*this)(collider, scenery.collider(collider).filter);
  }
  /// @param other that of the collider.
  [[nodiscard]] bool operator()(ColliderIndex collider, const Filter& other) const noexcept {
    if (collider >= end) return true;
    return collide(*this, other) && (is_there == nullptr || is_there(collider, user));
  }
};

/// A collider was in the way of the requested motion.
template <class Scalar = double>
struct Contact {
  ColliderIndex collider = 0;
  Vec2<Scalar> point{Vec2<Scalar>::Zero()};   ///< On the obstacle [m].
  Vec2<Scalar> normal{Vec2<Scalar>::Zero()};  ///< Unit, from the obstacle towards the character.
  Scalar fraction = 0;                        ///< Time of impact as a fraction of the step, in [0, 1].
  Scalar separation = 0;                      ///< Gap that is left, along the normal [m]; negative: overlap.
  Side side = Side::bottom;
};

/// The character's open interior came to overlap a sensor (of a chain: its line), or ceased to. Events of one sensor
/// alternate, also over steps, as long as the filter stays the same; a character that begins inside does not enter.
template <class Scalar>
struct SensorEvent {
  enum class Change : std::uint8_t { enter, exit };
  ColliderIndex sensor = 0;
  Change change = Change::enter;
  Scalar fraction = 0;  ///< Of the step, in [0, 1].
};

/// A corner of the path.
template <class Scalar>
struct PathPoint {
  Vec2<Scalar> position{Vec2<Scalar>::Zero()};  ///< [m]
  Scalar fraction = 0;                          ///< Of the step, in [0, 1].
};

template <class Scalar>
struct MoveRequest {
  Vec2<Scalar> position{Vec2<Scalar>::Zero()};      ///< Where the step begins [m].
  Vec2<Scalar> displacement{Vec2<Scalar>::Zero()};  ///< The wanted displacement [m].
  Vec2<Scalar> velocity{Vec2<Scalar>::Zero()};      ///< The velocity behind the displacement [m/s].
  /// The part of `velocity` across up that this step's steering added [m/s].
  Scalar steered = 0;
  Vec2<Scalar> last_free{Vec2<Scalar>::Zero()};         ///< See `CharacterState::last_free`.
  Vec2<Scalar> technique_memory{Vec2<Scalar>::Zero()};  ///< See `CharacterState::technique_memory`.
  bool has_last_free = false;
  bool grounded = false;  ///< The last step ended on the ground, and this one does not begin with a jump.
  bool crushed = false;   ///< See `CharacterState::crushed`.
  bool drop = false;      ///< One-way chains do not block: see `Input::drop`.
  /// A motion leaves ground that it touches if it goes away from it faster than this [m/s]: by more than
  /// `Tolerances::touch` in one more step. Zero in a step that begins with a jump.
  Scalar leaves_ground_above = 0;
  std::span<const Crusher<Scalar>> crushers{};  ///< See `CharacterState::crushers`.
  /// One for each mover of the scenery.
  std::span<const MoverMotion<Scalar>> movers{};
  const ColliderFilter* filter = nullptr;  ///< Null: all colliders are there.
  Scalar dt = 0;                           ///< [s]
  UpFrame<Scalar> up{};                    ///< See `StepContext::up`.
  /// The ground that carries the character, if any: `displacement` and `velocity` are then relative to this ground, and
  /// the technique adds the ground's motion.
  Ride<Scalar> ride{};
};

enum class MoveStatus : std::uint8_t {
  moved,    ///< The result holds. It may be shorter than requested: see `contacts`.
  dropped,  ///< The result holds, but displacement was left and was dropped: the iterations ran out, or no exact proof
            ///< was found.
  stuck,    ///< The step began inside a solid and still ends inside it.
  crushed,  ///< The result holds, but movers left no free position: see `crushed`.
  out_of_range,  ///< Refused: the step would leave the range of the technique. Nothing moved.
  refused,       ///< Refused for a reason of the technique's own: see `refusal`. Nothing moved.
};

/// The report of one move. `octagon_sweep` reports everything: elements beyond the inline storage go to memory of its
/// scratch, which is sized by the scenery (see `ReportVector`). Other techniques, and a `Crowd`, leave out the elements
/// beyond the inline storage, and the vector has `overflowed()`. A crowd's `crushed` alone is always complete.
template <class Scalar = double>
struct MoveResult {
  static constexpr std::size_t max_corners = 64;
  static constexpr std::size_t max_contacts = 32;
  static constexpr std::size_t max_crushed = 64;

  MoveStatus status = MoveStatus::moved;
  Vec2<Scalar> position{Vec2<Scalar>::Zero()};
  Vec2<Scalar> velocity{Vec2<Scalar>::Zero()};
  Vec2<Scalar> technique_memory{Vec2<Scalar>::Zero()};  ///< See `CharacterState::technique_memory`.
  bool grounded = false;
  Ground<Scalar> ground;
  std::string_view refusal{};  ///< The reason, in static memory. Valid where the status is `refused`.
  /// From the start (fraction 0) to the end (fraction 1); linear between. A technique that tests only the end of the
  /// move has just these two corners. Impacts bound the number of corners. The character's own motion has at most
  /// `SweepDef::iterations` impacts. Movers may add any number: `octagon_sweep` has room for 4 more corners per moving
  /// piece, and a step that needs more is `dropped`.
  ReportVector<PathPoint<Scalar>, max_corners> path;
  /// Bounded by the facets of all pieces that block.
  ReportVector<Contact<Scalar>, max_contacts> contacts;
  Ride<Scalar> ride;  ///< For the next step. `velocity` above is in the world, the ride included.
  /// Colliders of movers that ran into the character when it had no room to give way; each once.
  ReportVector<ColliderIndex, max_crushed> crushed;
  Crushers<Scalar> crushers;  ///< See `CharacterState::crushers`.

  /// Gives up what is in borrowed memory, of a scratch for example: its owner uses it again, or goes.
  void keep_own() noexcept {
    path.keep_own();
    contacts.keep_own();
    crushed.keep_own();
  }
  [[gnu::always_inline]] void clear() noexcept {
    status = MoveStatus::moved;
    technique_memory.setZero();
    grounded = false;
    ground.state = GroundState::air;
    path.clear();
    contacts.clear();
    ride = {};
    crushed.clear();
    crushers.clear();
  }
};

/// Memory that only its technique knows how to use.
struct OwnMemory {
  virtual ~OwnMemory() = default;
};

/// Memory for the answer of a query that may find every piece of a level. It is not touched before it is needed, so
/// small answers take little memory, even in a large level.
class PieceBuffer {
 public:
  PieceBuffer() = default;
  explicit PieceBuffer(std::size_t size) : pieces_(std::make_unique_for_overwrite<PieceIndex[]>(size)), size_(size) {}

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] PieceIndex* data() const noexcept { return pieces_.get(); }
  [[nodiscard]] PieceIndex& operator[](std::size_t i) const noexcept { return pieces_[i]; }
  [[nodiscard]] PieceIndex* begin() const noexcept { return data(); }
  [[nodiscard]] PieceIndex* end() const noexcept { return data() + size_; }

 private:
  std::unique_ptr<PieceIndex[]> pieces_;
  std::size_t size_ = 0;
};

/// Pieces near a character: the answer of a broad phase, which holds for the next steps as well.
template <class Scalar>
struct Candidates {
  PieceBuffer pieces;  ///< Has room for the largest possible answer.
  std::size_t count = 0;
  Box2<Scalar> box;  ///< Positions of the character for which the pieces are complete, if `valid`.
  bool valid = false;
  /// Positions known to be quiet: while the character moves among them, nothing happens between it and any piece.
  Box2<Scalar> quiet{Vec2<Scalar>::Constant(1), Vec2<Scalar>::Constant(-1)};
  bool filtered = false;    ///< Pieces that are not there are missing,
  ColliderFilter filter{};  ///< by this filter.
};

/// Memory of a step, one per thread. It belongs to the controller (or the technique) that made it and carries nothing
/// from one step to the next that could change a result.
template <class Scalar = double>
struct Scratch {
  Candidates<Scalar> solids;       ///< Belongs to the technique, as the next member does.
  std::unique_ptr<OwnMemory> own;  ///< Null for most techniques.
  Candidates<Scalar> sensors;      ///< Belongs to the controller, as all that follows.
  Candidates<Scalar> one_way;
  /// The maker of this memory: a controller refuses memory that another controller made. The mark expires with its
  /// controller, so it never matches a later controller at the same address.
  std::weak_ptr<const void> maker;
};

/// What a technique reads of a `MoveRequest`, beside what each technique reads.
struct Abilities {
  bool filter = false;  ///< `MoveRequest::filter` has an effect; else it must be null.
  bool up = false;      ///< `MoveRequest::up` has an effect; else it must be (0, 1).
};

/// A way to find out how far a character can move. Const and shareable between threads; each thread brings its scratch.
template <class Scalar>
class Technique {
 public:
  virtual ~Technique() = default;
  /// The technique's name on the command line.
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  [[nodiscard]] virtual Scratch<Scalar> make_scratch() const = 0;
  /// Size of the technique's own copy of the level [bytes]; 0 for a technique that reads the scenery.
  [[nodiscard]] virtual std::size_t memory_bytes() const noexcept { return 0; }
  [[nodiscard]] virtual Abilities abilities() const noexcept { return {}; }
  /// Never allocates and never throws.
  /// @param scratch made by this technique, which is not checked here.
  virtual void move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
                    MoveResult<Scalar>& result) const noexcept = 0;
};

}  // namespace paperproof
