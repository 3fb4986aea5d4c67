#include "oracle/mover_way.hpp"

#include "contains.hpp"
#include "oracle/turning_room.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace paperproof::compare {
namespace {

constexpr double rounding = 0x1p-53;
constexpr double rounding_of_float = 0x1p-24;
/// Of the coordinates that a vertex is computed from: cosine and sine, two products, a difference, the sum, and for a
/// centre the way there and back.
constexpr int roundings_of_vertex = 8;
constexpr int roundings_of_time = 4;
/// Share of a step that a turn at once takes.
constexpr double turning_share = 1e-6;
/// Of an angle that is read off vertices.
constexpr double angle_rounding = 1e-9;
constexpr int moments_of_chord = 8;

/// A time since the first entry, brought into the first run of a path.
struct Folded {
  double time = 0;
  double runs = 0;  ///< Whole ones that are behind it.
};

Folded fold(MoverScript::Loop loop, double first, double last, double time) {
  const double length = last - first;
  if (time <= first || length <= 0) return {first, 0};
  if (loop == MoverScript::Loop::once) return {std::min(time, last), 0};
  const double gone = time - first;
  if (loop == MoverScript::Loop::loop) {
    const double rest = std::fmod(gone, length);
    return {first + rest, std::nearbyint((gone - rest) / length)};
  }
  const double rest = std::fmod(gone, 2 * length);
  return {rest > length ? last - (rest - length) : first + rest, 0};
}

template <class Entry>
auto value_at(const std::vector<Entry>& entries, double time) -> decltype(Entry::at) {
  std::size_t next = 0;
  while (next < entries.size() && entries[next].time <= time) ++next;
  if (next == 0) return entries.front().at;
  const Entry& a = entries[next - 1];
  if (a.time == time || next == entries.size()) return a.at;
  const Entry& b = entries[next];
  return a.at + (time - a.time) / (b.time - a.time) * (b.at - a.at);
}

double size_of(const Vec2d& way) { return way.norm(); }
double size_of(double turn) { return std::abs(turn); }

/// Of a path [m/s], or of turns [rad/s].
template <class Entry>
double largest_speed(const std::vector<Entry>& entries) {
  double most = 0;
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const auto& [before, a] = entries[i - 1];
    const auto& [after, b] = entries[i];
    most = std::max(most, size_of(b - a) / (after - before));
  }
  return most;
}

/// Places vertices in a pose.
class Placing {
 public:
  explicit Placing(const MoverPose& pose)
      : offset_(pose.offset.cast<long double>()),
        cosine_(std::cos(static_cast<long double>(pose.angle))),
        sine_(std::sin(static_cast<long double>(pose.angle))) {}
  [[nodiscard]] Vec2d operator()(const Vec2d& v) const {
    const long double x = v.x();
    const long double y = v.y();
    return {static_cast<double>(offset_.x() + (cosine_ * x - sine_ * y)),
            static_cast<double>(offset_.y() + (sine_ * x + cosine_ * y))};
  }

 private:
  Eigen::Matrix<long double, 2, 1> offset_;
  long double cosine_;
  long double sine_;
};

/// The points of a definition in the order of `VertexWay::vertices`.
std::vector<Vec2d> points_of(const ColliderDef& def) {
  std::vector<Vec2d> all = def.points;
  for (const std::vector<Vec2d>& hole : def.holes) all.insert(all.end(), hole.begin(), hole.end());
  return all;
}

bool is_circle(const ColliderDef& def) { return def.shape == ColliderDef::Shape::circle; }

template <class Index>
void note(std::vector<Index>& list, Index one) {
  if (!contains(list, one)) list.push_back(one);
}

/// Parts of a step are equally long, no more than promised, and each turns at once; but after a crush the rest is one.
bool is_divided_evenly(const VertexWay& way, bool crushed) {
  if (!turns_at_once(way, 1)) return true;
  const double parts = std::round(1 / way.instants[2]);
  if (!(parts <= most_turning_parts && std::abs(way.instants[2] * parts - 1) <= turning_share)) return false;
  std::size_t turned = 0;
  for (std::size_t k = 1; k < way.instants.size(); ++k) turned += turns_at_once(way, k);
  return crushed || turned == static_cast<std::size_t>(parts);
}

}  // namespace

MoverPose pose_at(const MoverScript& script, double time) {
  const Folded on_path = fold(script.loop, script.path.front().time, script.path.back().time, time);
  MoverPose pose{value_at(script.path, on_path.time), 0};
  if (script.turns.empty()) return pose;
  const MoverScript::Turn& first = script.turns.front();
  const MoverScript::Turn& last = script.turns.back();
  const Folded turned = fold(script.loop, first.time, last.time, time);
  pose.angle = value_at(script.turns, turned.time) + turned.runs * (last.at - first.at);
  return pose;
}

MoverPose MoverWayJudge::Course::at(double fraction) const {
  if (fraction == 0) return from;
  if (fraction == 1) return to;
  return {from.offset + fraction * (to.offset - from.offset), from.angle + fraction * turn()};
}

MoverWayJudge::MoverWayJudge(const TraceHeader& header, std::vector<MoverScript> scripts)
    : header_(header), scripts_(std::move(scripts)), is_float_(header.scalar == "float") {
  for (const Vec2d& corner : header.points) radius_ = std::max(radius_, corner.norm());
  extent_ = Box2::around(header.points).size().norm();
}

/// Records of several characters share a step.
void MoverWayJudge::tell_time(const TraceStep& step) {
  if (step.step == step_) return;
  goes_on_ = step_ >= 0 && step.step == step_ + 1 && !now_.offsets.empty();
  before_ = std::exchange(now_, {});
  step_ = step.step;
  vary_ = step.dt.has_value();
  begin_ = vary_ ? static_cast<double>(time_) : step.step * header_.dt;
  if (vary_) time_ = time_ + *step.dt;
  end_ = vary_ ? static_cast<double>(time_) : (step.step + 1) * header_.dt;
}

MoverWayJudge::Course MoverWayJudge::course_of(MoverIndex mover) const {
  double slack = vary_ ? roundings_of_time * rounding * end_ : 0;
  if (is_float_) slack += rounding_of_float * end_;
  return {pose_at(scripts_[mover], begin_), pose_at(scripts_[mover], end_), slack};
}

/// Whether a step goes in more parts than what turns near by needs.
bool MoverWayJudge::is_fine(const TraceStep& step, const Near& near) const {
  const int parts = parts_of(step.vertex_ways);
  if (parts < 2) return false;
  double way = 0;
  for (const VertexWay& its : step.vertex_ways) way = std::max(way, detail::largest_motion(its));
  const double wanted = step.requested.norm();
  if (!near(way + wanted + near_what_turns).empty()) return false;
  const CharacterDef& character = header_.character;
  const double dt = length_of(step, header_);
  const double acceleration =
      character.acceleration + character.air_acceleration.value_or(0) + gravity_in(step, header_).norm();
  const double otherwise = (character.jump_speed + acceleration * dt) * dt + character.snap + character.step_height +
                           character.wall_reach + 2 * most_turned_at_once;
  const std::vector<ColliderIndex> beside = near(way + 2 * (extent_ + wanted) + 3 * otherwise);
  return std::ranges::none_of(beside, [&](ColliderIndex one) {
    const MoverIndex mover = header_.scenery.colliders[one].mover;
    const double turned = std::abs(course_of(mover).turn()) * extent_;
    return scripts_[mover].body || turned >= most_turned_at_once * parts / 2 * (1 - turning_share);
  });
}

MoverWayJudgement MoverWayJudge::judge(const TraceStep& step, const Near& near) {
  tell_time(step);
  MoverWayJudgement judgement;
  for (MoverIndex mover = 0; mover < scripts_.size(); ++mover) judgement.turns.push_back(course_of(mover).turn());
  judgement.is_fine = is_fine(step, near);
  const std::vector<ColliderIndex> beside = near(near_what_turns);
  judge_offsets(step, judgement);
  for (const VertexWay& way : step.vertex_ways) {
    const MoverIndex mover = header_.scenery.colliders[way.collider].mover;
    const double turn = std::abs(course_of(mover).turn());
    // A circle does not turn: its centre goes straight.
    const bool is_near = std::ranges::any_of(beside, [&](ColliderIndex one) {
      const ColliderDef& other = header_.scenery.colliders[one];
      return other.mover == mover && !is_circle(other);
    });
    const double most =
        is_near ? std::max(std::min(turn, most_turned_at_once / extent_), turn / most_turning_parts) : turn;
    judge_way(way, step, most, judgement);
  }
  return judgement;
}

bool MoverWayJudge::is_on_script(const Vec2d& offset, const MoverPose& pose, MoverIndex mover, double slack) const {
  if (offset == pose.offset) return true;
  const double rounded = (is_float_ ? rounding_of_float : rounding) * pose.offset.norm();
  return slack > 0 && (offset - pose.offset).norm() <= slack * largest_speed(scripts_[mover].path) + 2 * rounded;
}

void MoverWayJudge::judge_offsets(const TraceStep& step, MoverWayJudgement& judgement) {
  for (MoverIndex i = 0; i < scripts_.size() && i < step.movers.size(); ++i) {
    const Course course = course_of(i);
    const MoverMotion& motion = step.movers[i];
    const bool begins = (scripts_[i].body && step.step > 0) || is_on_script(motion.from, course.from, i, course.slack);
    const bool ends = scripts_[i].body || is_on_script(motion.to, course.to, i, course.slack);
    const bool goes_on = !goes_on_ || motion.from == before_.offsets[i];
    if (!(begins && ends && goes_on)) judgement.off_script.push_back(i);
  }
  if (step.movers.size() < scripts_.size()) judgement.off_script.push_back(static_cast<MoverIndex>(step.movers.size()));
  now_.offsets.clear();
  for (const MoverMotion& motion : step.movers) now_.offsets.push_back(motion.to);
}

double MoverWayJudge::allowed(const MoverPose& pose, const Vec2d& v, MoverIndex mover, double slack) const {
  const MoverScript& script = scripts_[mover];
  return roundings_of_vertex * rounding * ((1 + std::abs(pose.angle)) * v.norm() + pose.offset.norm()) +
         slack * (largest_speed(script.path) + largest_speed(script.turns) * v.norm());
}

void MoverWayJudge::judge_way(const VertexWay& way, const TraceStep& step, double most, MoverWayJudgement& judgement) {
  const ColliderDef& def = header_.scenery.colliders[way.collider];
  const MoverIndex mover = def.mover;
  const Course course = course_of(mover);
  const std::vector<Vec2d> points = points_of(def);
  const auto before = before_.vertices.find(way.collider);
  const bool jumps = goes_on_ && before != before_.vertices.end() && before->second != way.vertices.front();
  if (jumps) note(judgement.off_script, mover);
  now_.vertices[way.collider] = way.vertices.back();

  for (std::size_t k = 0; k < way.instants.size(); ++k) {
    const bool turned = turns_at_once(way, k);
    const MoverPose pose = course.at(way.instants[turned ? k + 1 : k]);
    const Placing place(pose);
    const bool between = k > 0 && k + 1 < way.instants.size();
    Vec2d moved = Vec2d::Zero();  // by a turn at once about another point
    if (turned && !points.empty()) moved = way.vertices[k][0] - place(points[0]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vec2d there = place(points[i]) + moved;
      if (is_circle(def) && between) {
        const Vec2d& begin = way.vertices.front()[i];
        there = begin + way.instants[turned ? k - 1 : k] * (way.vertices.back()[i] - begin);
      }
      const double off = (way.vertices[k][i] - there).norm();
      const double more = (turned ? 2 : 1) + (is_circle(def) ? 2 : 0);  // of roundings
      if (off <= more * (allowed(pose, points[i], mover, course.slack) + rounding * moved.norm())) continue;
      if (between)
        note(judgement.out_of_way, way.collider);
      else
        note(judgement.off_script, mover);
    }
    if (!turned || points.size() < 2) continue;
    const double angle = std::abs(detail::RigidMotion(way.vertices[k - 1], way.vertices[k]).angle());
    if (angle > most + angle_rounding) note(judgement.coarse, way.collider);
  }
  if (!is_divided_evenly(way, !step.crushed.empty())) note(judgement.coarse, way.collider);
  measure_arc(way, step, most, judgement);
}

void MoverWayJudge::measure_arc(const VertexWay& way, const TraceStep& step, double most,
                                MoverWayJudgement& judgement) const {
  const ColliderDef& def = header_.scenery.colliders[way.collider];
  const Course course = course_of(def.mover);
  if (course.turn() == 0) return;
  const std::vector<Vec2d> points = points_of(def);
  const double turn = std::abs(course.turn());
  std::vector<double> errors(points.size());
  for (std::size_t k = 1; k < way.instants.size(); ++k)
    for (int moment = 0; moment <= moments_of_chord; ++moment) {
      const double share = static_cast<double>(moment) / moments_of_chord;
      const Placing place(course.at(way.instants[k - 1] + share * (way.instants[k] - way.instants[k - 1])));
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2d& from = way.vertices[k - 1][i];
        const Vec2d there = from + share * (way.vertices[k][i] - from);
        errors[i] = std::max(errors[i], (there - place(points[i])).norm());
      }
    }
  const double carried = (course.to.offset - course.from.offset).norm();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double r = points[i].norm();
    double far = 0;  // from the position of the character
    for (const PathPoint& corner : step.path)
      for (const auto* vertices : {&way.vertices.front(), &way.vertices.back()})
        far = std::max(far, ((*vertices)[i] - corner.position).norm());
    const double lag = turning_share * (carried + r * turn) + allowed(course.to, points[i], def.mover, course.slack);
    const double bound =
        lag + (is_circle(def) ? r * turn * turn / 8 : most * std::max(r, 2 * far + 4 * radius_) + r * most * most / 8);
    if (errors[i] > bound) note(judgement.off_arc, way.collider);
    judgement.arc_share = std::max(judgement.arc_share, errors[i] / bound);
    judgement.arc_error = std::max(judgement.arc_error, errors[i]);
  }
}

}  // namespace paperproof::compare
