#include "oracle/free_space.hpp"

#include "oracle/depth.hpp"

#include <algorithm>

namespace paperproof::compare::detail {
namespace {

/// So much more clearance the lines keep, so that a corner of theirs still has all of it after rounding.
constexpr double margin = 1.005;
/// Fine enough that a clearance in units of its square keeps all bits that matter.
constexpr int finest_unit = -64;

/// The octagon at q from where it is is free of the line's part where edge × q >= bound.
struct Line {
  Point<Integer> edge;  ///< In units of 2^unit.
  Integer bound;        ///< In units of 2^(2 unit).
  Vec2d normal{Vec2d::Zero()};
  double distance = 0;  ///< Of the line from where the octagon is, along the normal [m].
};

struct OwnLines {
  std::vector<Line> lines;
  bool enclose_disc = false;  ///< A place between these lines and the disc is free.
};

/// The lines of all obstacles, those of one obstacle in a row.
struct Lines {
  int unit = finest_unit;
  std::vector<OwnLines> of_obstacle;
};

Lines lines_of(std::span<const Obstacle> obstacles, std::span<const Vec2d> octagon, double clearance) {
  Lines lines;
  for (const Obstacle& obstacle : obstacles) {
    lines.unit = std::min(lines.unit, common_unit(*obstacle.part, octagon, obstacle.place));
  }
  const Convert<Integer> number{lines.unit};
  for (const Obstacle& obstacle : obstacles) {
    const std::vector<AxisEdge> axes = axis_edges(*obstacle.part, octagon);
    const std::vector<Integer> separations = scaled_separations(*obstacle.part, octagon, obstacle.place, lines.unit);
    OwnLines& own = lines.of_obstacle.emplace_back();
    own.enclose_disc = obstacle.exact != obstacle.part;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const Vec2d edge = axes[i].end - axes[i].start;
      const double length = edge.norm();
      Line line;
      line.edge = convert(number, axes[i].end) - convert(number, axes[i].start);
      line.bound = Integer(std::ldexp(clearance * margin * length, -2 * lines.unit)) - separations[i];
      line.normal = Vec2d(-edge.y(), edge.x()) / length;
      line.distance = std::ldexp(ratio(line.bound, Integer(1)), 2 * lines.unit) / length;
      own.lines.push_back(std::move(line));
    }
  }
  return lines;
}

/// Where two lines cross, from where the octagon is, rounded once.
std::optional<Vec2d> crossing(const Line& a, const Line& b, int unit) {
  const Integer over = cross(a.edge, b.edge);
  if (over == 0) return std::nullopt;
  const Integer x = a.bound * b.edge.x - b.bound * a.edge.x;
  const Integer y = a.bound * b.edge.y - b.bound * a.edge.y;
  return Vec2d(std::ldexp(ratio(x, over), unit), std::ldexp(ratio(y, over), unit));
}

bool may_be_free(const Lines& lines, const Vec2d& way, double rounding) {
  return std::all_of(lines.of_obstacle.begin(), lines.of_obstacle.end(), [&](const OwnLines& own) {
    return own.enclose_disc || std::any_of(own.lines.begin(), own.lines.end(), [&](const Line& line) {
             return line.normal.dot(way) - line.distance >= -rounding;
           });
  });
}

}  // namespace

std::vector<Vec2d> free_candidates(std::span<const Obstacle> obstacles, std::span<const Vec2d> octagon, const Vec2d& at,
                                   double reach, double clearance, std::span<const Vec2d> others) {
  const Lines lines = lines_of(obstacles, octagon, clearance);
  const double rounding = clearance * (margin - 1) + at.cwiseAbs().maxCoeff() * 0x1p-50;
  std::vector<Vec2d> ways{Vec2d::Zero()};
  for (const Vec2d& other : others) ways.push_back(other - at);
  std::vector<const Line*> near;
  for (const OwnLines& own : lines.of_obstacle) {
    for (const Line& line : own.lines) {
      if (!(std::abs(line.distance) <= reach)) continue;
      near.push_back(&line);
      ways.push_back(line.normal * line.distance);
    }
  }
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (std::size_t j = i + 1; j < near.size(); ++j) {
      if (const std::optional<Vec2d> way = crossing(*near[i], *near[j], lines.unit)) ways.push_back(*way);
    }
  }
  std::erase_if(ways, [&](const Vec2d& way) { return !(way.norm() <= reach) || !may_be_free(lines, way, rounding); });
  std::stable_sort(ways.begin(), ways.end(),
                   [](const Vec2d& a, const Vec2d& b) { return a.squaredNorm() < b.squaredNorm(); });
  ways.erase(std::unique(ways.begin(), ways.end()), ways.end());
  std::vector<Vec2d> positions;
  for (const Vec2d& way : ways) positions.push_back(at + way);
  return positions;
}

}  // namespace paperproof::compare::detail
