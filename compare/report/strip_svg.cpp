#include "report/strip_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

namespace paperproof::compare {
namespace {

constexpr double panel_width = 84;
constexpr double panel_height = 170;
constexpr double gap = 8;
constexpr double strip_top = 40;
constexpr double margin = 8;

constexpr std::string_view style = R"(<style>
text { font: 12px system-ui, "Segoe UI", Roboto, "Liberation Sans", sans-serif; fill: #1d2125; text-anchor: middle; }
.title { font-size: 14px; font-weight: 600; text-anchor: start; } .quiet { fill: #5c646c; }
.good { fill: #1d6b3a; font-weight: 600; } .bad { fill: #b3261e; font-weight: 600; }
.frame { fill: none; stroke: #b9bec3; } .none { fill: #eef0f2; stroke: #b9bec3; }
.solid { fill: #c9ced3; stroke: #7d868f; } .chain { fill: none; stroke: #1d2125; stroke-width: 1.5; }
.way, .ghost { fill: none; stroke: #0b5cad; stroke-width: 1.5; } .ghost { stroke-dasharray: 2 2; } .end { fill: #0b5cad; }
@media (prefers-color-scheme: dark) {
text { fill: #e3e6e8; } .quiet { fill: #a0a8b0; } .good { fill: #7fd19b; } .bad { fill: #ff8f85; }
.frame { stroke: #5a636c; } .none { fill: #23282d; stroke: #5a636c; }
.solid { fill: #454d55; stroke: #7a858f; } .chain { stroke: #e3e6e8; }
.way, .ghost { stroke: #74b4f5; } .end { fill: #74b4f5; }
}
</style>
)";

struct Box {
  Vec2d lower = Vec2d::Constant(std::numeric_limits<double>::infinity());
  Vec2d upper = Vec2d::Constant(-std::numeric_limits<double>::infinity());
  void grow(const Vec2d& point) {
    lower = lower.cwiseMin(point).eval();
    upper = upper.cwiseMax(point).eval();
  }
};

std::optional<int> first_tunnel(const ReportRun& run) {
  std::optional<int> first;
  for (const ReportEvent& event : run.events)
    if (event.kind == ReportEvent::Kind::tunnel && (!first || event.step < *first)) first = event.step;
  return first;
}

std::optional<int> first_contact(const ReportRun& run) {
  const auto found =
      std::find_if(run.steps.begin(), run.steps.end(), [](const TraceStep& step) { return !step.contacts.empty(); });
  return found == run.steps.end() ? std::nullopt : std::optional(found->step);
}

int step_to_show(const std::vector<StripPanel>& panels) {
  for (const auto& moment : {first_tunnel, first_contact}) {
    std::optional<int> first;
    for (const StripPanel& panel : panels) {
      if (panel.run == nullptr) continue;
      const std::optional<int> own = moment(*panel.run);
      if (own && (!first || *own < *first)) first = own;
    }
    if (first) return *first;
  }
  return 0;
}

const TraceStep* record_of(const StripPanel& panel, int step) {
  if (panel.run == nullptr) return nullptr;
  const auto found = std::find_if(panel.run->steps.begin(), panel.run->steps.end(),
                                  [&](const TraceStep& one) { return one.step == step && !one.path.empty(); });
  return found == panel.run->steps.end() ? nullptr : &*found;
}

/// Metres to the pixels of a panel; y goes down.
class View {
 public:
  explicit View(const Box& box) : middle_((box.lower + box.upper) / 2) {
    const Vec2d size = (box.upper - box.lower).cwiseMax(1e-9);
    scale_ = std::min((panel_width - 12) / size.x(), (panel_height - 20) / size.y());
  }
  [[nodiscard]] double x(const Vec2d& point) const { return panel_width / 2 + (point.x() - middle_.x()) * scale_; }
  [[nodiscard]] double y(const Vec2d& point) const { return panel_height / 2 - (point.y() - middle_.y()) * scale_; }
  /// As the attributes `points` and `d` have them.
  [[nodiscard]] std::string list(const std::vector<Vec2d>& points, const Vec2d& offset) const {
    std::string pixels;
    for (const Vec2d& point : points)
      fmt::format_to(std::back_inserter(pixels), "{:.2f},{:.2f} ", x(point + offset), y(point + offset));
    return pixels;
  }

 private:
  Vec2d middle_;
  double scale_ = 1;
};

/// The points of a collider; of a circle, those of a polygon.
std::vector<Vec2d> drawn_outline(const ColliderDef& collider) {
  constexpr int corners = 64;
  if (collider.shape != ColliderDef::Shape::circle) return collider.points;
  std::vector<Vec2d> outline;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    outline.emplace_back(collider.points.front() + collider.radius * Vec2d(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

std::string scenery(const View& view, const ReportRun& run, const TraceStep& record) {
  std::string svg;
  for (const ColliderDef& collider : run.header.scenery.colliders) {
    const bool moves = collider.mover != no_mover && collider.mover < record.movers.size();
    const Vec2d offset = moves ? record.movers[collider.mover].to : Vec2d(Vec2d::Zero());
    if (collider.shape == ColliderDef::Shape::chain) {
      svg += fmt::format("<polyline points=\"{}\" class=\"chain\"/>\n", view.list(collider.points, offset));
      continue;
    }
    std::string rings = 'M' + view.list(drawn_outline(collider), offset) + 'Z';
    for (const std::vector<Vec2d>& hole : collider.holes) rings += 'M' + view.list(hole, offset) + 'Z';
    svg += fmt::format("<path fill-rule=\"evenodd\" d=\"{}\" class=\"solid\"/>\n", rings);
  }
  return svg;
}

std::string way_of(const View& view, const ReportRun& run, const TraceStep& record) {
  std::vector<Vec2d> way;
  for (const PathPoint& corner : record.path) way.push_back(corner.position);
  return fmt::format(
      "<polygon points=\"{}\" class=\"ghost\"/>\n<polyline points=\"{}\" class=\"way\"/>\n"
      "<polygon points=\"{}\" class=\"way\"/>\n<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\" class=\"end\"/>\n",
      view.list(run.header.points, way.front()), view.list(way, Vec2d::Zero()),
      view.list(run.header.points, way.back()), view.x(way.back()), view.y(way.back()));
}

std::string escaped(std::string_view words) {
  std::string safe;
  for (const char c : words) safe += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return safe;
}

std::string text(double x, double y, std::string_view words, std::string_view of_class) {
  return fmt::format("<text x=\"{}\" y=\"{}\" class=\"{}\">{}</text>\n", x, y, of_class, escaped(words));
}

/// Below a panel, in two lines where they are long.
std::string words_below(double middle, double y, const std::string& words, std::string_view of_class) {
  constexpr std::size_t widest = 12;  // characters in a line
  const std::size_t cut = words.size() > widest ? words.find_last_of("_ ", widest + 1) : std::string::npos;
  const std::size_t first = cut == std::string::npos ? words.size() : cut + 1;
  std::string svg = text(middle, y, words.substr(0, first), of_class);
  if (first < words.size()) svg += text(middle, y + 15, words.substr(first), of_class);
  return svg;
}

}  // namespace

std::string svg_of_strip(const std::string& title, const std::vector<StripPanel>& panels) {
  const int step = step_to_show(panels);
  Box box;
  for (const StripPanel& panel : panels)
    if (const TraceStep* record = record_of(panel, step))
      for (const PathPoint& corner : record->path)
        for (const Vec2d& point : panel.run->header.points) box.grow(corner.position + point);
  const View view(box);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\">\n",
      2 * margin + static_cast<double>(panels.size()) * (panel_width + gap) - gap, strip_top + panel_height + 78);
  svg += fmt::format("<title>{}</title>\n{}", escaped(title), style) + text(margin, 24, title, "title");
  double left = margin;
  for (const StripPanel& panel : panels) {
    const TraceStep* record = record_of(panel, step);
    const std::string place =
        fmt::format("x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", left, strip_top, panel_width, panel_height);
    if (record != nullptr)  // what is in a drawing of its own is cut off at its edges
      svg += fmt::format("<svg {}>\n{}{}</svg>\n", place, scenery(view, *panel.run, *record),
                         way_of(view, *panel.run, *record));
    svg += fmt::format("<rect {} class=\"{}\"/>\n", place, record != nullptr ? "frame" : "none");
    svg += words_below(left + panel_width / 2, strip_top + panel_height + 18, panel.name, "");
    svg += words_below(left + panel_width / 2, strip_top + panel_height + 52, panel.words,
                       record == nullptr ? "quiet"
                       : panel.bad       ? "bad"
                                         : "good");
    left += panel_width + gap;
  }
  return svg + "</svg>\n";
}

}  // namespace paperproof::compare
