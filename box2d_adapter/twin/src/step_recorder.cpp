#include "step_recorder.hpp"

#include <algorithm>

namespace paperproof::box2d {

SceneryEnd scenery_end(const b2Contact& contact, const b2Body& character) {
  // Box2D puts edges and chains first, but polygons in the order in which it found them.
  const bool character_is_a = contact.GetFixtureA()->GetBody() == &character;
  // The const overload of GetUserData does not exist in 2.4.
  auto* fixture = const_cast<b2Fixture*>(character_is_a ? contact.GetFixtureB() : contact.GetFixtureA());
  const b2Transform& at = fixture->GetBody()->GetTransform();
  return {fixture->GetUserData().pointer, character_is_a ? contact.GetChildIndexB() : contact.GetChildIndexA(),
          widened(at.p), static_cast<double>(at.q.c), static_cast<double>(at.q.s)};
}

FixedVector<TouchPoint, b2_maxManifoldPoints> touch_points(const b2Contact& contact, const b2Body& character) {
  b2WorldManifold manifold;
  contact.GetWorldManifold(&manifold);
  const bool character_is_a = contact.GetFixtureA()->GetBody() == &character;
  const Vec2d normal = widened(character_is_a ? -manifold.normal : manifold.normal);
  const double radii = static_cast<double>(contact.GetFixtureA()->GetShape()->m_radius) +
                       static_cast<double>(contact.GetFixtureB()->GetShape()->m_radius);
  FixedVector<TouchPoint, b2_maxManifoldPoints> points;
  for (int32 i = 0; i < contact.GetManifold()->pointCount; ++i) {
    // Box2D's point lies half way between the surfaces, as both shapes have the same radius.
    const double gap = static_cast<double>(manifold.separations[i]) + radii;
    points.push_back({widened(manifold.points[i]) - normal * (gap / 2), normal, gap});
  }
  return points;
}

void StepRecorder::begin_step(const b2Body& character, const Vec2d& wanted_displacement, std::span<const Vec2d> offsets,
                              bool drop) {
  character_ = &character;
  offsets_ = offsets;
  drops_ = drop;
  phase_ = Phase::collide;
  step_start_ = widened(character.GetPosition());
  leg_start_ = {step_start_, 0};
  leg_end_ = step_start_ + wanted_displacement;
  seen_ = leg_start_;
  path_.assign(1, leg_start_);
  beginnings_.clear();
}

void StepRecorder::end_step() {
  path_.push_back({widened(character_->GetPosition()), 1});
  character_ = nullptr;
}

bool StepRecorder::blocks(std::size_t source) const {
  const FixtureSource& from = sources_[source];
  if (from.sensor) return false;
  if (!from.one_way) return true;
  return !drops_ && wholly_above(from, step_start_, from.mover == no_mover ? Vec2d::Zero() : offsets_[from.mover]);
}

bool StepRecorder::wholly_above(const FixtureSource& segment, const Vec2d& position, const Vec2d& offset) const {
  return std::all_of(hull_.begin(), hull_.end(), [&](const Vec2d& corner) {
    const Vec2d to_corner = position + corner - segment.one_way->point - offset;
    return segment.one_way->normal.dot(to_corner) >= 0;
  });
}

std::vector<ColliderIndex> StepRecorder::dropped_through(std::span<const MoverMotion> movers) const {
  std::vector<ColliderIndex> passed;
  if (!drops_) return passed;
  for (const FixtureSource& source : sources_)
    if (source.one_way && leaves(source, source.mover == no_mover ? MoverMotion{} : movers[source.mover]))
      passed.push_back(*source.collider);
  std::sort(passed.begin(), passed.end());
  passed.erase(std::unique(passed.begin(), passed.end()), passed.end());
  return passed;
}

/// Whether the character was wholly above a segment when the step began, is not when it ends, and came by.
bool StepRecorder::leaves(const FixtureSource& segment, const MoverMotion& motion) const {
  const Vec2d from = path_.front().position - motion.from;
  const Vec2d to = path_.back().position - motion.to;
  if (!wholly_above(segment, from, Vec2d::Zero()) || wholly_above(segment, to, Vec2d::Zero())) return false;
  Box2 swept{from + hull_.front(), from + hull_.front()};
  for (const Vec2d& corner : hull_)
    for (const Vec2d& at : {from, to}) swept = swept.merged({at + corner, at + corner});
  const auto& [point, end, normal] = *segment.one_way;
  return swept.overlaps({point.cwiseMin(end), point.cwiseMax(end)});
}

double StepRecorder::fraction_at(const Vec2d& position) const {
  const Vec2d leg = leg_end_ - leg_start_.position;
  const double length_squared = leg.squaredNorm();
  if (!(length_squared > 0)) return leg_start_.fraction;
  const Vec2d travelled = position - leg_start_.position;
  const double share = std::clamp(travelled.dot(leg) / length_squared, 0.0, 1.0);
  return leg_start_.fraction + (1 - leg_start_.fraction) * share;
}

/// Notes where the body is, if that is somewhere new.
void StepRecorder::look() {
  const Vec2d position = widened(character_->GetPosition());
  if (phase_ == Phase::collide && position == step_start_) return;
  phase_ = Phase::impacts;
  if (position == seen_.position) return;
  seen_ = {position, std::max(seen_.fraction, fraction_at(position))};
  path_.push_back(seen_);
}

void StepRecorder::begin_contact(const b2Contact& contact) {
  look();
  const SceneryEnd end = scenery_end(contact, *character_);
  if (!blocks(end.source)) return;
  const bool was_impact = phase_ == Phase::impacts;
  beginnings_.push_back({end, seen_.fraction, was_impact, touch_points(contact, *character_)});
}

void StepRecorder::pre_solve(b2Contact& contact) {
  look();
  let_through(contact);
}

/// A one-way segment lets through what is not wholly on the side that it blocks. The question is asked in every step,
/// not once per contact: who rises through it and falls back before the contact has ended must land on it.
void StepRecorder::let_through(b2Contact& contact) const {
  if (!blocks(scenery_end(contact, *character_).source)) contact.SetEnabled(false);
}

void StepRecorder::post_solve() {
  if (phase_ == Phase::collide) phase_ = Phase::solved;
  if (phase_ == Phase::impacts) leg_start_ = seen_;
  leg_end_ = widened(character_->GetPosition());
}

}  // namespace paperproof::box2d
