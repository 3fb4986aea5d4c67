#include "crowd/sweep_together.hpp"

#include "crowd/avoidance.hpp"

#include <optional>

namespace paperproof::crowd {
namespace {

/// The order of a step: paths as if each were alone, impacts, a last search for room, a check of all paths.
class SweepTogether {
 public:
  explicit SweepTogether(CrowdStep& step) noexcept : step_(step), planner_(step), paths_(step) {}

  [[nodiscard]] bool move_all(std::span<const CharacterState> before) noexcept {
    step_.report.impacts = 0;
    for (CharacterIndex i = 0; i < step_.members.size(); ++i)
      if (!plan_alone(i)) return false;
    note_overlaps();
    Avoidance(step_, paths_).handle_impacts();
    find_room_for_all();
    for (CharacterIndex i = 0; i < step_.members.size(); ++i)
      if (has_lost_ground(i)) step_.members[i].plan.grounded = step_.members[i].end.state.grounded = false;
    for (CharacterIndex i = 0; i < step_.members.size(); ++i) {
      paths_.make(i, step_.members[i].plan);
      step_.members[i].box = paths_.box_along(step_.made(i).path);
    }
    check_paths(before);
    for (CharacterIndex i = 0; i < step_.members.size(); ++i) end(i);
    return true;
  }

 private:
  using WholePath = FixedVector<PathPoint, 2 * MoveResult::max_corners>;

  /// The path that a character would take if it were alone. False where it would leave the range.
  [[nodiscard]] bool plan_alone(CharacterIndex i) noexcept {
    const octagon_sweep::StepRequest& request = *step_.memory.requests[i];
    Member& member = step_.members[i];
    member.now.time = 0;
    member.now.state = step_.memory.states[i];
    set_crushers(request.state.crushers, step_.rules, member.now.state);
    member.now.own_velocity = request.velocity;
    member.now.steered = request.steered;
    member.start = member.now;
    member.obstacles.clear();
    member.replans = 0;
    member.holds_position = member.ground_taken = member.dropped = false;
    member.follows_ground = request.grounded;
    member.next_dt = request.next_dt;
    member.drops = request.drop;
    Moment end = member.now;
    if (planner_.plan_until(i, 1, step_.memory.path, end))
      paths_.follow(i, end);
    else if (is_too_long(step_.memory.path))
      paths_.hold_position(i);
    else
      return false;
    member.starts_stuck = member.plan.status == StepStatus::stuck;
    return true;
  }

  /// Reports the pairs that overlap by more than rounding.
  void note_overlaps() noexcept {
    const Vec2d extent = step_.rules.space.box().upper - step_.rules.space.box().lower;
    for (CharacterIndex i = 0; i < step_.members.size(); ++i) {
      for (CharacterIndex j = i + 1; j < step_.members.size(); ++j) {
        const Vec2d& first = step_.members[i].now.state.position;
        const Vec2d& second = step_.members[j].now.state.position;
        const Vec2d between = second - first;
        if (std::abs(between.x()) > extent.x() || std::abs(between.y()) > extent.y()) continue;
        if (step_.rules.space.separation(first, second) >= -Tolerances{}.certain) continue;
        step_.report.members[i].started_overlapping.push_back(j);
        step_.report.members[j].started_overlapping.push_back(i);
      }
    }
  }

  /// Where one character falls on, others that it held may fall, too: so this is repeated.
  void find_room_for_all() noexcept {
    bool changed = true;
    for (int round = 0; changed && round < step_.rules.max_replans; ++round) {
      changed = false;
      for (CharacterIndex i = 0; i < step_.members.size(); ++i) changed = find_room(i) || changed;
    }
  }

  /// A character that was crushed between two impacts may have room over the whole step, and one that was held may fall
  /// once its obstacle has gone on. So its path is planned once more, now that the paths of all others are known.
  /// @return whether it has a new path.
  bool find_room(CharacterIndex i) noexcept {
    Member& member = step_.members[i];
    const double crush = crush_distance(i);
    const double reach = std::max(crush, missed_fall(i));
    if (reach == 0) return false;
    const Obstacles obstacles = member.obstacles;
    member.obstacles.clear();
    for (CharacterIndex j = 0; j < step_.members.size(); ++j)
      if (j != i && step_.members[j].box.overlaps(member.box.inflated(reach))) member.obstacles.push_back(j);
    Moment end;
    const auto is_lower = [&] { return step_.up.up_of(end.state.position - member.end.state.position) < 0; };
    const bool found =
        (plan_free(i, end) && (crush > 0 || is_lower())) || (crush > 0 && plan_past_all(i, member.start, end));
    if (found) {
      step_.made(i).clear();
      member.now = member.start;
    } else if (crush == 0 || !find_room_from_corners(i, end)) {
      member.obstacles = obstacles;
      return false;
    }
    member.holds_position = member.dropped = false;
    paths_.follow(i, end);
    return true;
  }

  /// The path that a character has made, and then the one that it plans.
  [[nodiscard]] WholePath whole_path(CharacterIndex i) const noexcept {
    WholePath whole;
    for (const PathPoint& corner : step_.made(i).path) whole.push_back(corner);
    for (const PathPoint& corner : step_.members[i].plan.path) whole.push_back(corner);
    return whole;
  }

  /// The same from a corner of the path on, where the character waits until something pushes it: a straight motion from
  /// there may lead past all others.
  bool find_room_from_corners(CharacterIndex i, Moment& end) noexcept {
    Member& member = step_.members[i];
    const WholePath whole = whole_path(i);
    // A character that begins inside a mover must have left it, on the side from which it came.
    const bool starts_inside = !member.start.state.crushers.empty();
    if (starts_inside && (whole.size() < 2 || whole[1].fraction > 0)) return false;
    for (std::size_t k = whole.size(); k-- > (starts_inside ? 1U : 0U);) {
      const bool stays = k > 0 && whole[k - 1].position == whole[k].position;
      if (stays || !(whole[k].fraction < 1) || whole[k].fraction > member.end.crushed_at) continue;
      Moment at = member.start;
      at.time = whole[k].fraction;
      at.own_velocity = Vec2d::Zero();
      at.steered = 0;
      at.state.position = whole[k].position;
      at.state.grounded = at.state.crushed = false;
      at.state.ride = {};
      at.state.crushers.clear();
      if (!plan_past_all(i, at, end)) continue;
      paths_.go_back_to_end_of({whole.begin(), k + 1}, i);
      member.now = at;
      return true;
    }
    return false;
  }

  /// How far the movers go that crush a character [m]. Zero where there is none.
  [[nodiscard]] double crush_distance(CharacterIndex i) const noexcept {
    const Member& member = step_.members[i];
    double distance = 0;
    const auto look_at = [&](const MoveResult& move) {
      for (const ColliderIndex collider : move.crushed) {
        if (step_.rules.is_character(collider)) continue;
        const MoverMotion& motion = step_.movers[step_.rules.scenery.collider(collider).mover];
        distance = std::max(distance, (motion.to - motion.from).cwiseAbs().maxCoeff());
      }
    };
    look_at(step_.made(i));
    look_at(member.plan);
    return distance;
  }

  /// How far a character wanted to fall [m]. Zero where it fell at least half of that, or stands.
  [[nodiscard]] double missed_fall(CharacterIndex i) const noexcept {
    const Member& member = step_.members[i];
    const CharacterState& start = member.start.state;
    const CharacterState& end = member.end.state;
    const bool stands = end.grounded && !has_lost_ground(i);
    if (stands || end.crushed || start.crushed || start.ride.ground != Ride::none) return 0;
    const double wanted = -step_.up.up_of(member.start.own_velocity) * step_.dt;
    return wanted > 0 && step_.up.up_of(start.position - end.position) < wanted / 2 ? wanted : 0.0;
  }

  /// Whether a character stands on another that is not under it at the end of the step: the other may have gone on
  /// after the character planned its path.
  [[nodiscard]] bool has_lost_ground(CharacterIndex i) const noexcept {
    const MoveResult& plan = step_.members[i].plan;
    return plan.grounded && step_.rules.is_character(plan.ground.collider) && !ends_on_another(step_.members[i]);
  }

  /// Whether it touches a character that is under it, and not beside it, at the end of the step.
  [[nodiscard]] bool ends_on_another(const Member& member) const noexcept {
    const Vec2d& position = member.end.state.position;
    const Vec2d size = step_.rules.space.box().upper - step_.rules.space.box().lower;
    const double width = std::abs(size.x() * step_.up.up().y()) + std::abs(size.y() * step_.up.up().x());
    return std::any_of(step_.members.begin(), step_.members.end(), [&](const Member& other) {
      const Vec2d& below = other.end.state.position;
      const Vec2d to = step_.up.seen(below - position);
      return to.y() < 0 && std::abs(to.x()) < width &&
             step_.rules.space.separation(position, below) <= Tolerances{}.touch;
    });
  }

  /// Plans a path of the whole step into `CrowdMemory::path`.
  /// @return whether nothing crushes the character on it, and it has no impact with another.
  [[nodiscard]] bool plan_free(CharacterIndex i, Moment& end) noexcept {
    end = step_.members[i].start;
    return planner_.plan_until(i, 1, step_.memory.path, end) && step_.memory.path.crushed.empty() &&
           !impact_on_path(i, 0);
  }

  /// The same from a moment on, in one part. Nobody is an obstacle at first. A leg of another's path that the planned
  /// path meets becomes one, made longer to the whole time, and another path is planned.
  [[nodiscard]] bool plan_past_all(CharacterIndex i, const Moment& at, Moment& end) noexcept {
    Obstacles& obstacles = step_.members[i].obstacles;
    FixedVector<double, max_obstacles> legs;
    obstacles.clear();
    for (;;) {  // `max_obstacles` times at most, and once more
      end = at;
      if (!planner_.plan_past(i, {legs.begin(), legs.end()}, step_.memory.path, end) ||
          !step_.memory.path.crushed.empty())
        return false;
      const std::optional<Hit> hit = impact_on_path(i, at.time);
      if (!hit) return true;
      if (!obstacles.push_back(hit->other)) return false;
      legs.push_back(planner_.last_corner(hit->other, hit->time));
    }
  }

  struct Hit {
    CharacterIndex other;
    double time;
  };
  /// An impact of a character on the path in `CrowdMemory::path` with one of the others.
  /// @param from when that path begins.
  [[nodiscard]] std::optional<Hit> impact_on_path(CharacterIndex i, double from) const noexcept {
    const Path own = step_.memory.path.path;
    for (CharacterIndex j = 0; j < step_.members.size(); ++j) {
      if (j == i) continue;
      const WholePath whole = whole_path(j);
      const Path other = whole;
      const Impact impact =
          first_impact(step_.rules.space, i < j ? own : other, i < j ? other : own, from, Tolerances{}.hit, step_.up);
      if (impact.happens) return Hit{j, impact.stop};
    }
    return std::nullopt;
  }

  /// A path is made in parts, and rounding may shift each part. So all pairs are checked once more. Both of a pair that
  /// comes too near go back to where they began, which is free; this repeats until no pair has an impact: each round
  /// sends back one more character at least.
  void check_paths(std::span<const CharacterState> before) noexcept {
    const auto& members = step_.report.members;
    for (CharacterIndex i = 0; i < step_.members.size(); ++i)
      if (is_too_long(step_.made(i))) return_to_start(i, before[i]);
    bool changed = true;
    while (changed) {
      changed = false;
      for (CharacterIndex i = 0; i < step_.members.size(); ++i) {
        for (CharacterIndex j = i + 1; j < step_.members.size(); ++j) {
          if ((members[i].stayed && members[j].stayed) || !step_.members[i].box.overlaps(step_.members[j].box))
            continue;
          if (!first_impact(step_.rules.space, step_.made(i).path, step_.made(j).path, 0, Tolerances{}.certain,
                            step_.up)
                   .happens)
            continue;
          return_to_start(i, before[i]);
          return_to_start(j, before[j]);
          changed = true;
        }
      }
    }
  }

  /// Undoes the step of a character: it holds the position where it began.
  void return_to_start(CharacterIndex i, const CharacterState& before) noexcept {
    Member& member = step_.members[i];
    step_.report.members[i].stayed = true;
    step_.made(i).clear();
    member.now.time = 0;
    member.now.state = member.start.state;
    member.now.state.jumping = before.jumping;  // a press of the button is used up, but there was no jump
    paths_.hold_position(i);
    paths_.make(i, member.plan);
    member.box = paths_.box_along(step_.made(i).path);
  }

  /// Sets the status of the whole move, and the state that the controller completes.
  void end(CharacterIndex i) noexcept {
    const Member& member = step_.members[i];
    MoveResult& move = step_.made(i);
    if (!move.crushed.empty())
      move.status = StepStatus::crushed;
    else if (!member.end.state.crushers.empty())
      move.status = StepStatus::stuck;  // a mover still overlaps it, even if the last part met a character alone
    else if (move.status != StepStatus::stuck || !member.starts_stuck)  // to overlap a character alone is not stuck
      move.status = member.dropped || move.status == StepStatus::stuck ? StepStatus::dropped : StepStatus::moved;
    if (step_.rules.is_character(move.ground.collider)) move.ground.collider = no_collider;
    if (!move.grounded && move.ground.state != GroundState::steep) move.ground.state = GroundState::air;
    move.crushers = member.end.state.crushers;
    step_.memory.states[i] = member.end.state;
  }

  CrowdStep& step_;
  PathPlanner planner_;
  Paths paths_;
};

}  // namespace

bool sweep_together(CrowdStep step, std::span<const CharacterState> before) noexcept {
  return SweepTogether(step).move_all(before);
}

}  // namespace paperproof::crowd
