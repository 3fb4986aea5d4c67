#include <paperproof/together.hpp>

#include "geometry/overlap_time.hpp"
#include "geometry/vectors.hpp"
#include "turning/turning_step.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace paperproof {
namespace {

using geometry::dot;
using turning::contains;

constexpr std::size_t nobody = ~std::size_t{0};

/// Along a normal of one of two outlines, from the second towards the first: how far they are apart where both are at
/// the same place [m].
struct Axis {
  Vec2d normal;
  double apart;
};

/// All of them for two outlines.
struct Axes {
  std::span<const Vec2d> first, second;
  FixedVector<Axis, 2 * CharacterShape::max_points> all{};

  Axes(std::span<const Vec2d> a, std::span<const Vec2d> b) : first(a), second(b) {
    for (const bool of_first : {true, false}) {
      const std::span<const Vec2d> outline = of_first ? first : second;
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec2d left = geometry::normal_of(outline[(i + 1) % outline.size()] - outline[i]);
        const Vec2d normal = of_first ? left : Vec2d(-left);
        all.push_back({normal, geometry::least_along(first, normal) + geometry::least_along(second, -normal)});
      }
    }
  }
};

/// How far they are apart along the best axis [m]. @param at of the first relative to the second [m].
double gap(const Axes& axes, const Vec2d& at) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Axis& axis : axes.all) most = std::max(most, axis.apart + dot(at, axis.normal));
  return most;
}

/// When they are nearer than `within` along each axis [m]. @param from,to of the first relative to the second [m].
geometry::OverlapTime time_near(const Axes& axes, const Vec2d& from, const Vec2d& to, double within) {
  geometry::OverlapTime time;
  for (const Axis& axis : axes.all)
    time.narrow(axis.apart + dot(from, axis.normal), axis.apart + dot(to, axis.normal), within);
  return time;
}

/// One of them in this step.
struct Member {
  CharacterState before;
  Vec2d to{};                ///< Where it is now [m].
  Box2 reach;                ///< What its step may touch [m].
  bool is_in_group = false;  ///< In this one, or in one that has gone.
  bool has_gone = false;
  bool waits = false;                    ///< Its turn has begun: it waits for those in its way.
  bool follows = false;                  ///< It waits for its carrier to go.
  bool is_late = false;                  ///< It was crushed beside one that went sooner, and might have given way.
  bool has_velocity = false;             ///< That of its carrier is in its own.
  std::size_t began = 0;                 ///< How many turns had begun before its own.
  std::size_t carrier = nobody;          ///< Whom it rides on.
  std::vector<std::size_t> near;         ///< The others that it may meet.
  std::vector<TurnTaker::Other> moving;  ///< Of these the ones that went in its turn.
  std::vector<std::size_t> in_way;       ///< Those that have not gone, and are in its way.
  std::vector<std::size_t> yielding;     ///< Of these the ones that let it go as if they were not there.
  std::vector<std::size_t> carried;      ///< Those that ride on it, and have gone first by the way that it would go.
  // While it waits: how far it would go without those that yield [m],
  std::optional<Vec2d> carries;  ///< for those that ride on it, and
  std::optional<Vec2d> pushes;   ///< as movers alone take it, for others.
  Vec2d foreseen{};              ///< By which those went that it carries [m].
  std::optional<Vec2d> known;    ///< How far it went in the round before, where those foresaw another way [m].

  [[nodiscard]] const Vec2d& from() const { return before.position; }
};

}  // namespace

ColliderDef body_of(const CharacterDef& character, const Filter& filter) {
  const std::span<const Vec2d> hull = character.shape.hull();
  return {.points = {hull.begin(), hull.end()}, .mover = its_character, .filter = filter};
}

namespace {

/// Steps a companion by its controller.
class OfController final : public TurnTaker {
 public:
  /// @param order all of them.
  OfController(Companion& companion, const std::vector<Companion*>& order, const StepContext& context)
      : companion_(companion), order_(order), context_(context) {}

  [[nodiscard]] const Controller& controller() const override { return *companion_.controller; }
  [[nodiscard]] CharacterState& state() override { return *companion_.state; }
  [[nodiscard]] StepReport& report() override { return *companion_.report; }
  [[nodiscard]] Box2 reach() const override { return controller().reach(*companion_.state, context_); }
  [[nodiscard]] bool is_body_of(ColliderIndex collider, std::size_t other) const override {
    return order_[other]->body == collider;
  }

  void step(std::span<const Other> others, bool is_taken) override {
    turning::Memory& memory = turning::memory_of(*companion_.scratch);
    const Scenery& scenery = controller().scenery();
    // Too few of them are refused.
    const std::size_t movers = std::min(context_.movers.size(), scenery.mover_count());
    const bool are_all = movers == scenery.mover_count();
    memory.motions_of_all.assign(context_.movers.begin(),
                                 context_.movers.begin() + static_cast<std::ptrdiff_t>(movers));
    memory.bodies.clear();
    for (const Other& other : are_all ? others : std::span<const Other>{}) {
      memory.motions_of_all.push_back(other.motion);
      memory.bodies.push_back(scenery.pieces_of(order_[other.who]->body).first);
    }
    memory.apart = memory.bodies;
    StepContext among = context_;
    among.movers = memory.motions_of_all;
    Input input = companion_.input;
    if (is_taken) {
      among.gravity.setZero();
      input = {};
    }
    (void)controller().step(state(), input, among, *companion_.scratch, report());
    memory.bodies.clear();
    memory.apart.clear();
  }

 private:
  Companion& companion_;
  const std::vector<Companion*>& order_;
  const StepContext& context_;
};

/// The turns of one step.
struct Turns final : OwnMemory {
  void make_step(std::span<TurnTaker* const> takers_now, const Vec2d& with_up) {
    all = takers_now;
    up = with_up;
    members.resize(all.size());
    turn_of.resize(all.size());
    order.resize(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = 0; i < all.size(); ++i) {
      Member& member = members[i];
      member.before = all[i]->state();
      member.reach = all[i]->reach();
      // It is refused.
      if (!member.reach.lower.allFinite() || !member.reach.upper.allFinite()) member.reach = Box2::nowhere();
      member.to = member.from();
      member.is_in_group = member.has_gone = member.waits = member.has_velocity = false;
      member.known.reset();
      member.carrier = nobody;
      member.near.clear();
      member.moving.clear();
    }
    find_near();
    for (std::size_t i = 0; i < all.size(); ++i) {
      std::sort(members[i].near.begin(), members[i].near.end());
      if (members[i].before.ride.ground != Ride::none) members[i].carrier = owner_of(members[i].before.ride.ground, i);
    }
    turns = begun = 0;
    axes.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
      group.clear();
      add_to_group(i);
      let_take_turns();
    }
  }

  std::vector<std::size_t> turn_of;  ///< Of each, its place in the order.
  std::vector<Member> members;
  std::vector<Companion*> companions;  ///< By the ids of their bodies.
  std::vector<OfController> takers;
  std::vector<TurnTaker*> pointers;

 private:
  /// What one tries.
  enum class Try : std::uint8_t {
    its_step,
    without_those,        ///< Its step, as if those that yield were not there.
    taken_without_those,  ///< Likewise, but it goes only as movers take it.
    past_what_stands      ///< Its step, among others that only stand.
  };

  [[nodiscard]] std::span<const Vec2d> hull(std::size_t i) const {
    return all[i]->controller().character().shape.hull();
  }
  [[nodiscard]] StepReport& report_of(std::size_t i) const { return all[i]->report(); }
  [[nodiscard]] bool is_still(std::size_t i) const { return !members[i].has_gone && !members[i].waits; }

  /// @return nobody where it is no body of one that is near.
  [[nodiscard]] std::size_t owner_of(ColliderIndex body, std::size_t i) const {
    const std::vector<std::size_t>& near = members[i].near;
    const auto owner = std::ranges::find_if(near, [&](std::size_t j) { return all[i]->is_body_of(body, j); });
    return owner == near.end() ? nobody : *owner;
  }

  /// Most characters have one of a few shapes, whichever controllers they have. @return valid until the next call.
  [[nodiscard]] const Axes& axes_between(std::size_t i, std::size_t other) {
    constexpr std::size_t most_pairs = 16;
    const auto are_they = [&](const Axes& known) {
      return std::ranges::equal(known.first, hull(i)) && std::ranges::equal(known.second, hull(other));
    };
    const auto known = std::ranges::find_if(axes, are_they);
    if (known != axes.end()) return *known;
    if (axes.size() == most_pairs) axes.clear();
    return axes.emplace_back(hull(i), hull(other));
  }

  /// Whether one that has gone came no nearer to where another begins, along a direction in which it began farthest.
  [[nodiscard]] bool recedes(std::size_t other, std::size_t i) {
    constexpr double noise = 1e-12;
    const Vec2d at = members[i].from() - members[other].from();
    const Vec2d way = members[other].to - members[other].from();
    const Axes& between = axes_between(i, other);
    const double farthest = gap(between, at) - noise;
    return std::ranges::any_of(between.all, [&](const Axis& axis) {
      return axis.apart + dot(at, axis.normal) >= farthest && dot(way, axis.normal) <= noise;
    });
  }

  /// Whether a way of another, straight and even, leads into where one begins.
  [[nodiscard]] bool leads_into(std::size_t other, const Vec2d& way, std::size_t i) {
    const Vec2d from = members[other].from() - members[i].from();
    return time_near(axes_between(other, i), from, from + way, 0).any();
  }

  /// How another goes while one takes its turn.
  [[nodiscard]] MoverMotion motion_of(std::size_t other, std::size_t i, Try what) {
    const Member& it = members[other];
    const bool carries = members[i].carrier == other;
    MoverMotion motion{it.to, it.to};
    if (what == Try::past_what_stands) return motion;
    if (it.has_gone && (carries || recedes(other, i))) motion.from = it.from();
    if (carries && it.carries) motion.to = it.from() + *it.carries;
    if (!carries && it.pushes && leads_into(other, *it.pushes, i)) motion.to = it.from() + *it.pushes;
    return motion;
  }

  /// Makes the step of one from where it began. Whatever it touches was near. @return how far it went.
  Vec2d attempt(std::size_t i, Try what) {
    Member& me = members[i];
    const bool without = what == Try::without_those || what == Try::taken_without_those;
    for (;;) {
      others.clear();
      for (const std::size_t other : me.near)
        if (!without || !contains(me.yielding, other)) others.push_back({other, motion_of(other, i, what)});
      CharacterState& state = all[i]->state();
      state = me.before;
      if (what == Try::taken_without_those) {
        state.velocity = state.ride.velocity;
        state.jump_pending = false;
      }
      all[i]->step(others, what == Try::taken_without_those);
      if (is_refused(report_of(i).status)) break;
      const Box2 way = all[i]->controller().reach(report_of(i).move);
      if (me.reach.contains(way)) break;
      me.reach = me.reach.merged(way);
      add_near(i);
    }
    return all[i]->state().position - me.from();
  }

  /// Whether the way that one went leads past another as it stands. @param within of it [m].
  [[nodiscard]] bool is_clear_of(std::size_t i, std::size_t other, double within) {
    const std::vector<PathPoint>& path = report_of(i).move.path;
    const Vec2d& place = members[other].to;
    const Axes& between = axes_between(i, other);
    for (std::size_t k = 1; k < path.size(); ++k) {
      const Vec2d from = path[k - 1].position - place;
      if (time_near(between, from, path[k].position - place, within).any()) return false;
    }
    return true;
  }

  /// Whether the way that one went in its last attempt leads past those as they stand that moved in it.
  [[nodiscard]] bool is_clear(std::size_t i) {
    return std::ranges::all_of(others, [&](const TurnTaker::Other& other) {
      return other.motion.from == other.motion.to || is_clear_of(i, other.who, Tolerances{}.certain);
    });
  }

  /// Whom the step of one met that has not gone.
  void find_in_way(std::size_t i) {
    Member& me = members[i];
    me.in_way.clear();
    if (is_refused(report_of(i).status)) return;
    for (const Contact& contact : report_of(i).move.contacts) {
      const std::size_t other = owner_of(contact.collider, i);
      if (other != nobody && is_still(other) && !contains(me.in_way, other)) me.in_way.push_back(other);
    }
  }

  /// Of those that ride on one, the ones that are in the way that it would go without them.
  void find_riders_in_way(std::size_t i) {
    Member& me = members[i];
    me.in_way.clear();
    for (const std::size_t other : me.near)
      if (members[other].carrier == i && is_still(other)) me.in_way.push_back(other);
    if (me.in_way.empty()) return;
    me.yielding = me.in_way;
    attempt(i, Try::without_those);
    std::erase_if(me.in_way, [&](std::size_t other) { return is_clear_of(i, other, Tolerances{}.hit); });
  }

  /// Whether movers may take one along, or others that they push.
  [[nodiscard]] bool may_be_moved(std::size_t i) const {
    const std::vector<Contact>& contacts = report_of(i).move.contacts;
    return members[i].before.ride.ground != Ride::none || std::ranges::any_of(contacts, [&](const Contact& contact) {
             const std::size_t other = owner_of(contact.collider, i);
             if (other != nobody) return members[other].pushes.has_value();
             return all[i]->controller().scenery().collider(contact.collider).mover != no_mover;
           });
  }

  /// How far one went in its last attempt. Over the edge of a stair it goes higher than it ends: as high as that.
  [[nodiscard]] Vec2d highest_way(std::size_t i) const {
    const Vec2d way = all[i]->state().position - members[i].from();
    const double rise = std::max(dot(way, up), 0.0);
    double peak = rise;
    for (const PathPoint& corner : report_of(i).move.path)
      peak = std::max(peak, dot(Vec2d(corner.position - members[i].from()), up));
    return way + up * (peak - rise);
  }

  /// Whether its last attempt went so far [m].
  [[nodiscard]] bool is_as_foreseen(std::size_t i, const Vec2d& way) const {
    return (highest_way(i) - way).norm() <= Tolerances{}.touch;
  }

  /// Lets those go first that are in the way of one.
  void let_go_first(std::size_t i) {
    Member& me = members[i];
    const std::vector<std::size_t> in_way = me.in_way;
    me.yielding.clear();
    if (may_be_moved(i)) {
      me.yielding = in_way;
      const Vec2d way = attempt(i, Try::taken_without_those);
      std::erase_if(me.yielding, [&](std::size_t other) { return is_clear_of(i, other, Tolerances{}.hit); });
      if (!me.yielding.empty()) me.pushes = me.known.value_or(way);
    }
    const auto rides = [&](std::size_t other) { return members[other].carrier == i; };
    if (std::ranges::any_of(in_way, rides)) {
      std::copy_if(in_way.begin(), in_way.end(), std::back_inserter(me.yielding), rides);
      if (!me.known) attempt(i, Try::without_those);
      me.carries = me.foreseen = me.known ? *me.known : highest_way(i);
    }
    for (const std::size_t other : in_way)
      if (is_still(other)) take_turn(other);
    if (me.carries) std::copy_if(in_way.begin(), in_way.end(), std::back_inserter(me.carried), rides);
    me.carries.reset();
    me.pushes.reset();
  }

  /// Makes the step of one. Those that it carries have made room for it: by rounding alone they do not hold it.
  void try_step(std::size_t i) {
    Member& me = members[i];
    attempt(i, Try::its_step);
    if (me.carried.empty() || is_as_foreseen(i, me.foreseen)) return;
    me.yielding = me.carried;
    attempt(i, Try::without_those);
    if (!std::ranges::all_of(me.carried,
                             [&](std::size_t other) { return is_clear_of(i, other, Tolerances{}.certain); }))
      attempt(i, Try::its_step);
  }

  void take_turn(std::size_t i) {
    Member& me = members[i];
    if (me.carrier != nobody && is_still(me.carrier) && !members[me.carrier].follows) {
      me.follows = true;
      take_turn(me.carrier);
      me.follows = false;
      if (me.has_gone) return;  // it was in the way of its carrier
    }
    me.waits = true;
    me.began = begun++;
    me.carried.clear();
    find_riders_in_way(i);
    if (!me.in_way.empty()) let_go_first(i);
    for (try_step(i), find_in_way(i); !me.in_way.empty(); try_step(i), find_in_way(i)) let_go_first(i);
    end_turn(i);
  }

  [[nodiscard]] bool is_crushed_by_others(std::size_t i) const {
    return std::ranges::any_of(report_of(i).move.crushed,
                               [&](ColliderIndex collider) { return owner_of(collider, i) != nobody; });
  }

  /// Whether one is crushed beside another whose turn began sooner: that one might have given way.
  [[nodiscard]] bool comes_late(std::size_t i) const {
    const MoveResult& move = report_of(i).move;
    return std::ranges::any_of(move.contacts, [&](const Contact& contact) {
      const std::size_t other = owner_of(contact.collider, i);
      const bool crushes = std::ranges::find(move.crushed, contact.collider) != move.crushed.end();
      return other != nobody && !crushes && members[other].began < members[i].began;
    });
  }

  /// Whether one went in the turn of another.
  [[nodiscard]] bool went(std::size_t one, std::size_t other) const {
    const std::vector<TurnTaker::Other>& moving = members[other].moving;
    return std::ranges::find(moving, one, &TurnTaker::Other::who) != moving.end();
  }

  /// Whether those of the group that were to carry or push others went as these saw it. From now on the others know
  /// how.
  /// @param go else those are to see it stand.
  [[nodiscard]] bool all_went_as_foreseen(bool go) {
    bool all_did = true;
    for (const std::size_t i : group)
      for (const TurnTaker::Other& other : members[i].moving) {
        if (turn_of[other.who] < turn_of[i]) continue;
        Member& it = members[other.who];
        if (is_as_foreseen(other.who, other.motion.to - it.from())) continue;
        it.known = go ? highest_way(other.who) : Vec2d(0, 0);
        all_did = false;
      }
    return all_did;
  }

  /// When all have gone. A carrier that climbs a stair, or is stopped, has another velocity than its way has. One that
  /// went from under its rider, which had gone, carries it no more.
  void take_velocity_of_carrier(std::size_t i) {
    CharacterState& state = all[i]->state();
    const std::size_t carrier = state.ride.ground == Ride::none ? nobody : owner_of(state.ride.ground, i);
    if (carrier == nobody || std::exchange(members[i].has_velocity, true)) return;
    take_velocity_of_carrier(carrier);
    MoveResult& move = report_of(i).move;
    const bool is_left = gap(axes_between(i, carrier), members[i].to - members[carrier].to) > Tolerances{}.touch;
    if (is_left && !went(carrier, i)) {
      state.ride = move.ride = {};
      return;
    }
    const Vec2d change = all[carrier]->state().velocity - state.ride.velocity;
    for (Vec2d* velocity : {&state.velocity, &state.ride.velocity, &state.ground.velocity, &move.velocity,
                            &move.ride.velocity, &move.ground.velocity})
      *velocity += change;
  }

  void end_turn(std::size_t i) {
    Member& me = members[i];
    if (!is_refused(report_of(i).status)) {
      me.is_late = !report_of(i).move.crushed.empty() && comes_late(i);
      if (is_crushed_by_others(i) || !is_clear(i)) attempt(i, Try::past_what_stands);
    }
    me.to = all[i]->state().position;
    me.moving.clear();
    for (const TurnTaker::Other& other : others)
      if (other.motion.from != other.motion.to) me.moving.push_back(other);
    me.has_gone = true;
    turn_of[i] = turns++;
  }

  /// Two may meet where the boxes overlap that their steps may touch.
  void find_near() {
    std::ranges::sort(
        order, [&](std::size_t a, std::size_t b) { return members[a].reach.lower.x() < members[b].reach.lower.x(); });
    for (std::size_t k = 0; k < order.size(); ++k) {
      Member& one = members[order[k]];
      for (std::size_t l = k + 1; l < order.size(); ++l) {
        Member& other = members[order[l]];
        if (!(other.reach.lower.x() <= one.reach.upper.x())) break;
        if (!one.reach.overlaps(other.reach)) continue;
        one.near.push_back(order[l]);
        other.near.push_back(order[k]);
      }
    }
  }

  /// For one whose step leads beyond what it was to touch.
  void add_near(std::size_t i) {
    for (std::size_t j = 0; j < members.size(); ++j) {
      std::vector<std::size_t>& near = members[i].near;
      if (j == i || !members[j].reach.overlaps(members[i].reach) || contains(near, j)) continue;
      near.push_back(j);
      members[j].near.push_back(i);
      add_to_group(j);
    }
  }

  /// Adds one, and whoever may meet it, unless they are in a group.
  void add_to_group(std::size_t i) {
    if (std::exchange(members[i].is_in_group, true)) return;
    std::size_t next = group.size();
    group.push_back(i);
    for (; next < group.size(); ++next)
      for (const std::size_t other : members[group[next]].near)
        if (!std::exchange(members[other].is_in_group, true)) group.push_back(other);
  }

  /// The steps of the group, again as long as some must go otherwise: those that came late go first, and those that a
  /// carrier moved otherwise than they foresaw go by the way that it went.
  void let_take_turns() {
    constexpr int most_rounds = 8;
    constexpr int rounds_foreseen = 3;
    const std::size_t begin = turns;
    first.clear();
    for (int round = 0; round < most_rounds; ++round) {
      turns = begin;
      std::ranges::sort(group);
      for (const std::size_t i : group) {
        members[i].to = members[i].from();
        members[i].has_gone = members[i].waits = members[i].is_late = false;
      }
      for (const std::size_t i : first)
        if (is_still(i)) take_turn(i);
      for (std::size_t k = 0; k < group.size(); ++k)  // it may grow
        if (is_still(group[k])) take_turn(group[k]);
      const std::size_t known = first.size();
      for (const std::size_t i : group)
        if (members[i].is_late && !contains(first, i)) first.push_back(i);
      if (all_went_as_foreseen(round < rounds_foreseen) && first.size() == known) break;
    }
    for (const std::size_t i : group) take_velocity_of_carrier(i);
  }

  std::span<TurnTaker* const> all;
  Vec2d up{0, 1};
  std::vector<std::size_t> order;
  std::vector<std::size_t> group;  ///< Those that may meet.
  std::vector<std::size_t> first;  ///< Those of the group that go before the others.
  std::vector<TurnTaker::Other> others;
  std::vector<Axes> axes;  ///< Of the pairs of outlines that were asked for last in this step.
  std::size_t turns = 0;
  std::size_t begun = 0;
};

Turns& turns_of(TogetherScratch& scratch) {
  if (scratch.own == nullptr) scratch.own = std::make_unique<Turns>();
  return static_cast<Turns&>(*scratch.own);
}

}  // namespace

std::span<const std::size_t> take_turns(std::span<TurnTaker* const> all, const Vec2d& up, TogetherScratch& scratch) {
  Turns& turns = turns_of(scratch);
  turns.make_step(all, up);
  return turns.turn_of;
}

void step_together(std::span<Companion> companions, const StepContext& context, TogetherScratch& scratch) {
  Turns& turns = turns_of(scratch);
  turns.companions.clear();
  turns.takers.clear();
  turns.pointers.clear();
  for (Companion& companion : companions) turns.companions.push_back(&companion);
  std::ranges::sort(turns.companions, [](const Companion* a, const Companion* b) { return a->body < b->body; });
  for (Companion* companion : turns.companions) turns.takers.emplace_back(*companion, turns.companions, context);
  for (OfController& taker : turns.takers) turns.pointers.push_back(&taker);
  turns.make_step(turns.pointers, context.up);
  for (std::size_t i = 0; i < turns.companions.size(); ++i) {
    Companion& companion = *turns.companions[i];
    companion.turn = turns.turn_of[i];
    companion.moving.clear();
    for (const TurnTaker::Other& other : turns.members[i].moving)
      companion.moving.push_back(turns.companions[other.who]->body);
  }
}

}  // namespace paperproof
