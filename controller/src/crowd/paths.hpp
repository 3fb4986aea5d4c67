/// The path of each character through one step: planned, cut at an impact, and made, part by part.
#pragma once

#include "crowd/path_planner.hpp"

namespace paperproof::crowd {

/// Whether a new path leaves a character no room.
struct Crush {
  bool by_character = false;  ///< One of its obstacles runs into it.
  bool by_mover = false;      ///< A mover runs into it that did not on its path up to now.
  [[nodiscard]] bool any() const noexcept { return by_character || by_mover; }
};

/// The paths of all characters. What a character has done stands in the report, what it plans in its `Member`.
class Paths {
 public:
  explicit Paths(CrowdStep& step) noexcept : step_(step), planner_(step) {}

  /// Around the shape along a whole path, and a little more.
  [[nodiscard]] Box2 box_along(Path path) const noexcept {
    Box2 box{path[0].position, path[0].position};
    for (const PathPoint& corner : path) box = box.merged({corner.position, corner.position});
    const Box2& shape = step_.rules.space.box();
    return Box2{box.lower + shape.lower, box.upper + shape.upper}.inflated(Tolerances{}.touch);
  }

  /// Plans a new path for the rest of the step. Where there is none the character holds its position.
  Crush replan(CharacterIndex i) noexcept {
    Member& member = step_.members[i];
    Moment end = member.now;
    if (!(end.time < 1) || !planner_.plan_until(i, 1, step_.memory.path, end)) {
      hold_position(i);
      return {};
    }
    Crush crush;
    for (const ColliderIndex collider : step_.memory.path.crushed) {
      if (step_.rules.is_character(collider))
        crush.by_character = true;
      else if (!contains(member.plan.crushed, collider) && !contains(step_.made(i).crushed, collider))
        crush.by_mover = true;
    }
    follow(i, end);
    return crush;
  }

  /// Makes the path in `CrowdMemory::path` the plan.
  void follow(CharacterIndex i, const Moment& end) noexcept {
    Member& member = step_.members[i];
    member.plan = step_.memory.path;
    member.end = end;
    member.box = box_along(member.plan.path);
  }

  /// Plans to stay in the same place of the world for the rest of the step. Movers that run into the character crush
  /// it.
  void hold_position(CharacterIndex i) noexcept {
    Member& member = step_.members[i];
    const Moment& now = member.now;
    member.holds_position = member.dropped = true;
    member.end = now;
    if (now.time < 1) {
      planner_.plan_to_hold_position(member, 1, member.plan, member.end);
    } else {
      member.plan.clear();
      member.plan.path.push_back({now.state.position, 1});
    }
    member.plan.position = now.state.position;
    member.plan.velocity = Vec2d::Zero();
    member.box = box_along(member.plan.path);
  }

  /// Moves a character along its plan up to a time. Until it is planned anew, the plan still begins earlier.
  void advance_to(CharacterIndex i, double time) noexcept {
    Member& member = step_.members[i];
    if (!(time > member.now.time)) return;
    const Vec2d planned = planner_.position(i, time, false);
    Moment at = member.now;
    const bool found = planner_.plan_until(i, time, step_.memory.path, at);
    // With less to go the technique may take another path: the one that was planned is made as it is. But half of a way
    // out of a mover may end on its wrong side: the character stays instead.
    const bool as_planned = found && (at.state.position - planned).cwiseAbs().maxCoeff() <= Tolerances{}.certain;
    if (!as_planned && !member.now.state.crushers.empty()) {
      planner_.plan_to_hold_position(member, time, step_.memory.path, member.now);
    } else {
      if (found) member.now = at;
      if (!as_planned) cut_plan(i, time, planned);
    }
    make(i, step_.memory.path);
  }

  /// Takes a part of its path for what a character has done, instead of all that it did and plans.
  /// @param kept from the start of the step; ends before anything crushed the character.
  void go_back_to_end_of(Path kept, CharacterIndex i) noexcept {
    MoveResult& made = step_.made(i);
    made.path.clear();
    for (const PathPoint& corner : kept) add_corner(made, corner);
    std::size_t count = 0;
    for (const Contact& contact : made.contacts)
      if (contact.fraction <= kept.back().fraction) made.contacts[count++] = contact;
    while (made.contacts.size() > count) made.contacts.pop_back();
    for (const Contact& contact : step_.members[i].plan.contacts)
      if (contact.fraction <= kept.back().fraction && !step_.rules.is_character(contact.collider))
        add_contact(made, contact);
    made.crushed.clear();
  }

  /// Adds the next part of a path, and what it meets, to the report.
  void make(CharacterIndex i, const MoveResult& path) noexcept {
    Member& member = step_.members[i];
    append_path(path, step_.made(i));
    for (const Contact& contact : path.contacts) {
      if (step_.rules.is_character(contact.collider)) {
        const CharacterIndex other = member.obstacles[contact.collider - step_.rules.first_slot];
        step_.report.add_contact(i, other, contact.normal, contact.fraction, step_.up);
      } else {
        add_contact(step_.made(i), contact);
      }
    }
    for (const ColliderIndex collider : path.crushed)
      if (!step_.rules.is_character(collider) && !contains(step_.made(i).crushed, collider))
        step_.made(i).crushed.push_back(collider);
    member.dropped = member.dropped || path.status == StepStatus::dropped;
    step_.made(i).status = path.status;
  }

 private:
  /// Cuts the plan at a time, into `CrowdMemory::path`.
  void cut_plan(CharacterIndex i, double time, const Vec2d& position) noexcept {
    Member& member = step_.members[i];
    const MoveResult& plan = member.plan;
    MoveResult& path = step_.memory.path;
    path.clear();
    for (const PathPoint& corner : plan.path)
      if (corner.fraction < time) add_corner(path, corner);
    add_corner(path, {position, time});
    for (const Contact& contact : plan.contacts)
      if (contact.fraction <= time) add_contact(path, contact);
    path.crushed = plan.crushed;
    path.status = plan.status;
    path.position = position;
    member.now.time = time;
    member.now.state.position = position;
    member.now.state.crushed = member.now.state.crushed || !plan.crushed.empty();
  }

  CrowdStep& step_;
  PathPlanner planner_;
};

}  // namespace paperproof::crowd
