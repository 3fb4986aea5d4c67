#include "report/scenery_json.hpp"
#include "report/svg.hpp"
#include "report/svg_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace paperproof::compare {
namespace {

constexpr double panel_width = 84;
constexpr double panel_height = 170;
constexpr double gap = 8;
constexpr double strip_top = 40;
constexpr double margin = 8;

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

/// Metres to the pixels of a panel.
class View {
 public:
  View(const Box& box, double left) : left_(left), middle_((box.lower + box.upper) / 2) {
    const Vec2d size = (box.upper - box.lower).cwiseMax(1e-9);
    scale_ = std::min((panel_width - 12) / size.x(), (panel_height - 20) / size.y());
  }
  [[nodiscard]] double x(const Vec2d& point) const {
    return left_ + panel_width / 2 + (point.x() - middle_.x()) * scale_;
  }
  [[nodiscard]] double y(const Vec2d& point) const {
    return strip_top + panel_height / 2 - (point.y() - middle_.y()) * scale_;
  }
  [[nodiscard]] std::vector<double> flat(const std::vector<Vec2d>& points, const Vec2d& offset) const {
    std::vector<double> pixels;
    for (const Vec2d& point : points) {
      const Vec2d at = point + offset;
      pixels.insert(pixels.end(), {x(at), y(at)});
    }
    return pixels;
  }

 private:
  double left_;
  Vec2d middle_;
  double scale_ = 1;
};

void draw_scenery(Svg& svg, const View& view, const ReportRun& run, const TraceStep& record) {
  for (const ColliderDef& collider : run.header.scenery.colliders) {
    const bool moves = collider.mover != no_mover && collider.mover < record.movers.size();
    const Vec2d offset = moves ? record.movers[collider.mover].to : Vec2d(Vec2d::Zero());
    if (collider.shape == ColliderDef::Shape::chain) {
      svg.polyline(view.flat(collider.points, offset), false, "border curve");
      continue;
    }
    std::vector<std::vector<double>> rings{view.flat(drawn_outline(collider), offset)};
    for (const std::vector<Vec2d>& hole : collider.holes) rings.push_back(view.flat(hole, offset));
    svg.rings(rings, "solid");
  }
}

void draw_way(Svg& svg, const View& view, const ReportRun& run, const TraceStep& record, std::size_t ink_number) {
  const std::string ink = fmt::format("i{}", ink_number % svg_inks);
  std::vector<Vec2d> way;
  for (const PathPoint& corner : record.path) way.push_back(corner.position);
  svg.polyline(view.flat(run.header.points, way.front()), true, "curve ghost " + ink);
  svg.polyline(view.flat(way, Vec2d::Zero()), false, "curve " + ink);
  svg.polyline(view.flat(run.header.points, way.back()), true, "curve " + ink);
  svg.mark(view.x(way.back()), view.y(way.back()), 4, 0, ink);
}

/// Below a panel, in two lines where they are long.
void write_below(Svg& svg, double middle, double y, const std::string& words, std::string_view of_class) {
  constexpr std::size_t widest = 12;  // characters in a line
  const std::size_t cut = words.size() > widest ? words.find_last_of("_ ", widest + 1) : std::string::npos;
  const std::size_t first = cut == std::string::npos ? words.size() : cut + 1;
  svg.text(middle, y, "middle", words.substr(0, first), of_class);
  if (first < words.size()) svg.text(middle, y + 15, "middle", words.substr(first), of_class);
}

}  // namespace

std::string svg_of_strip(const std::string& title, const std::vector<StripPanel>& panels) {
  const int step = step_to_show(panels);
  Box box;
  for (const StripPanel& panel : panels)
    if (const TraceStep* record = record_of(panel, step))
      for (const PathPoint& corner : record->path)
        for (const Vec2d& point : panel.run->header.points) box.grow(corner.position + point);
  Svg svg(2 * margin + static_cast<double>(panels.size()) * (panel_width + gap) - gap, strip_top + panel_height + 78);
  svg.text(margin, 24, "start", title, "title");
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const StripPanel& panel = panels[i];
    const double left = margin + static_cast<double>(i) * (panel_width + gap);
    const TraceStep* record = record_of(panel, step);
    if (record != nullptr) {
      const View view(box, left);
      svg.raw(
          fmt::format("<clipPath id=\"p{}\"><rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\"/>"
                      "</clipPath>\n<g clip-path=\"url(#p{})\">\n",
                      i, left, strip_top, panel_width, panel_height, i));
      draw_scenery(svg, view, *panel.run, *record);
      draw_way(svg, view, *panel.run, *record, i);
      svg.raw("</g>\n");
    }
    svg.rectangle(left, strip_top, panel_width, panel_height, record != nullptr ? "frame" : "none");
    write_below(svg, left + panel_width / 2, strip_top + panel_height + 18, panel.name, "t");
    write_below(svg, left + panel_width / 2, strip_top + panel_height + 52, panel.words,
                record == nullptr ? "quiet"
                : panel.bad       ? "bad"
                                  : "good");
  }
  return svg.finish(title);
}

}  // namespace paperproof::compare
