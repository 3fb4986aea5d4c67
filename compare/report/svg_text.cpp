#include "report/svg_text.hpp"

#include <fmt/format.h>

#include <iterator>

namespace paperproof::compare {
namespace {

constexpr std::string_view style = R"(<style>
text { font: 12px system-ui, "Segoe UI", Roboto, "Liberation Sans", sans-serif; }
.t, .mark-t { fill: #1d2125; } .quiet { fill: #5c646c; } .title { fill: #1d2125; font-size: 14px; font-weight: 600; } .name { fill: #1d2125; font-weight: 600; }
.good { fill: #1d6b3a; font-weight: 600; } .bad { fill: #b3261e; font-weight: 600; }
.grid { stroke: #d9dcdf; stroke-width: 1; } .border { stroke: #1d2125; stroke-width: 2.5; }
.frame { fill: none; stroke: #b9bec3; } .solid { fill: #c9ced3; stroke: #7d868f; } .none { fill: #eef0f2; stroke: #b9bec3; }
.some { fill: #f3c06b; } .all { fill: #c2410c; } .holds { fill: #a9d2ec; } .on-all { fill: #ffffff; }
.curve { fill: none; stroke-width: 1.5; } .ghost { fill: none; stroke-dasharray: 2 2; }
.i0 { stroke: #0b5cad; fill: #0b5cad; } .i1 { stroke: #d1590a; fill: #d1590a; } .i2 { stroke: #2a7d3f; fill: #2a7d3f; }
.i3 { stroke: #a3268f; fill: #a3268f; } .i4 { stroke: #7a5c00; fill: #7a5c00; } .i5 { stroke: #007d84; fill: #007d84; }
.i6 { stroke: #6a4fc4; fill: #6a4fc4; } .i7 { stroke: #c0304f; fill: #c0304f; }
.curve.i0, .curve.i1, .curve.i2, .curve.i3, .curve.i4, .curve.i5, .curve.i6, .curve.i7 { fill: none; }
@media (prefers-color-scheme: dark) {
.t, .mark-t, .title, .name { fill: #e3e6e8; } .quiet { fill: #a0a8b0; } .good { fill: #7fd19b; } .bad { fill: #ff8f85; }
.grid { stroke: #363d44; } .border { stroke: #e3e6e8; } .frame { stroke: #5a636c; }
.solid { fill: #454d55; stroke: #7a858f; } .none { fill: #23282d; stroke: #5a636c; }
.some { fill: #8f6a24; } .all { fill: #d9603b; } .holds { fill: #24506f; } .on-all { fill: #16181a; }
.i0 { stroke: #74b4f5; fill: #74b4f5; } .i1 { stroke: #ff9a4d; fill: #ff9a4d; } .i2 { stroke: #74cf8d; fill: #74cf8d; }
.i3 { stroke: #eb86da; fill: #eb86da; } .i4 { stroke: #dcbb4b; fill: #dcbb4b; } .i5 { stroke: #55cdd4; fill: #55cdd4; }
.i6 { stroke: #ac98fa; fill: #ac98fa; } .i7 { stroke: #ff8aa2; fill: #ff8aa2; }
}
</style>
)";

std::string escaped(std::string_view words) {
  std::string safe;
  for (const char c : words) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '&')
      safe += "&amp;";
    else
      safe += c;
  }
  return safe;
}

/// Marks other than the circle: corners around the middle, as multiples of the radius.
const std::vector<std::vector<double>>& mark_shapes() {
  static const std::vector<std::vector<double>> all{{-1, -1, 1, -1, 1, 1, -1, 1},        // square
                                                    {0, -1.2, 1.1, 0.9, -1.1, 0.9},      // triangle
                                                    {0, -1.3, 1.3, 0, 0, 1.3, -1.3, 0},  // diamond
                                                    {0, 1.2, 1.1, -0.9, -1.1, -0.9},     // triangle, point down
                                                    {-.4, -1.2, .4,  -1.2, .4,  -.4, 1.2,  -.4, 1.2,  .4,  .4,  .4,
                                                     .4,  1.2,  -.4, 1.2,  -.4, .4,  -1.2, .4,  -1.2, -.4, -.4, -.4}};
  return all;
}

/// To a hundredth of a pixel.
std::string short_pixels(double at) {
  std::string text = fmt::format("{:.2f}", at);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace

void Svg::line(double x0, double y0, double x1, double y1, std::string_view of_class) {
  fmt::format_to(std::back_inserter(body_), "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" class=\"{}\"/>\n",
                 short_pixels(x0), short_pixels(y0), short_pixels(x1), short_pixels(y1), of_class);
}

void Svg::rectangle(double x, double y, double width, double height, std::string_view of_class) {
  fmt::format_to(std::back_inserter(body_), "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"{}\"/>\n",
                 short_pixels(x), short_pixels(y), short_pixels(width), short_pixels(height), of_class);
}

void Svg::polyline(const std::vector<double>& points, bool closed, std::string_view of_class) {
  body_ += closed ? "<polygon points=\"" : "<polyline points=\"";
  for (std::size_t i = 0; i + 1 < points.size(); i += 2)
    fmt::format_to(std::back_inserter(body_), "{}{},{}", i == 0 ? "" : " ", short_pixels(points[i]),
                   short_pixels(points[i + 1]));
  fmt::format_to(std::back_inserter(body_), "\" class=\"{}\"/>\n", of_class);
}

void Svg::rings(const std::vector<std::vector<double>>& all, std::string_view of_class) {
  body_ += "<path fill-rule=\"evenodd\" d=\"";
  for (const std::vector<double>& points : all) {
    for (std::size_t i = 0; i + 1 < points.size(); i += 2)
      fmt::format_to(std::back_inserter(body_), "{}{},{}", i == 0 ? "M" : " ", short_pixels(points[i]),
                     short_pixels(points[i + 1]));
    body_ += 'Z';
  }
  fmt::format_to(std::back_inserter(body_), "\" class=\"{}\"/>\n", of_class);
}

void Svg::text(double x, double y, std::string_view anchor, std::string_view words, std::string_view of_class) {
  fmt::format_to(std::back_inserter(body_), "<text x=\"{}\" y=\"{}\" text-anchor=\"{}\" class=\"{}\">{}</text>\n",
                 short_pixels(x), short_pixels(y), anchor, of_class, escaped(words));
}

void Svg::mark(double x, double y, double radius, std::size_t kind, std::string_view of_class) {
  const std::size_t shapes = mark_shapes().size() + 1;
  if (kind % shapes == 0) {
    fmt::format_to(std::back_inserter(body_), "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" class=\"{}\"/>\n", short_pixels(x),
                   short_pixels(y), short_pixels(radius), of_class);
    return;
  }
  std::vector<double> points = mark_shapes()[kind % shapes - 1];
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = points[i] * radius + (i % 2 == 0 ? x : y);
  polyline(points, true, of_class);
}

std::string Svg::finish(std::string_view title) const {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
             "{1:.0f}\" "
             "role=\"img\">\n<title>{2}</title>\n",
             width_, height_, escaped(title)) +
         std::string(style) + body_ + "</svg>\n";
}

}  // namespace paperproof::compare
