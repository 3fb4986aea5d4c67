#include "scenes/mover.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {

namespace {

/// A time mapped into the first run of a path, and how many whole runs were behind it.
struct PathTime {
  double time = 0;
  double runs = 0;
};

/// `fmod` does not round, so a waypoint stays one however many rounds are behind it.
PathTime within_path(double time, double first, double last, MoverDef::Loop loop) {
  const double length = last - first;
  if (!(time > first) || !(length > 0)) return {first, 0};
  switch (loop) {
    case MoverDef::Loop::once:
      return {std::min(time, last), 0};
    case MoverDef::Loop::loop: {
      const double rest = std::fmod(time - first, length);
      return {first + rest, std::round((time - first - rest) / length)};
    }
    case MoverDef::Loop::ping_pong: {
      const double rest = std::fmod(time - first, 2 * length);
      return {rest <= length ? first + rest : last - (rest - length), 0};
    }
  }
  return {first, 0};
}

/// @param points ascending in time, at least one. @param time within theirs.
template <class Point>
auto between(const std::vector<Point>& points, double time) -> decltype(Point::at) {
  const auto after = std::upper_bound(points.begin(), points.end(), time,
                                      [](double wanted, const Point& point) { return wanted < point.time; });
  if (after == points.begin()) return points.front().at;
  const Point& before = *(after - 1);
  if (after == points.end() || time == before.time) return before.at;
  const double share = (time - before.time) / (after->time - before.time);
  return before.at + share * (after->at - before.at);
}

}  // namespace

Vec2d offset_at(const MoverDef& mover, double time) {
  return between(mover.path, within_path(time, mover.path.front().time, mover.path.back().time, mover.loop).time);
}

double angle_at(const MoverDef& mover, double time) {
  if (mover.turns.empty()) return 0;
  const MoverDef::Turn& first = mover.turns.front();
  const MoverDef::Turn& last = mover.turns.back();
  const PathTime at = within_path(time, first.time, last.time, mover.loop);
  return between(mover.turns, at.time) + at.runs * (last.at - first.at);
}

MoverMotion motion_between(const MoverDef& mover, double begin, double end) {
  return {offset_at(mover, begin), offset_at(mover, end), angle_at(mover, begin), angle_at(mover, end)};
}

}  // namespace paperproof::compare
