/// Small pieces of SVG.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// Collects elements; y goes down, lengths are pixels. The classes are those of the style that `finish` writes.
class Svg {
 public:
  Svg(double width, double height) : width_(width), height_(height) {}

  void line(double x0, double y0, double x1, double y1, std::string_view of_class);
  void rectangle(double x, double y, double width, double height, std::string_view of_class);
  /// A line through all points, closed or not. @param points x and y in turn.
  void polyline(const std::vector<double>& points, bool closed, std::string_view of_class);
  /// A filled outline with holes.
  void rings(const std::vector<std::vector<double>>& all, std::string_view of_class);
  /// @param anchor start, middle or end.
  void text(double x, double y, std::string_view anchor, std::string_view words, std::string_view of_class = "t");
  /// A mark of its own for each curve. @param kind any number; there are six.
  void mark(double x, double y, double radius, std::size_t kind, std::string_view of_class);
  void raw(std::string_view element) { body_ += element; }

  /// The whole file. @param title what the picture shows, for those who cannot see it.
  [[nodiscard]] std::string finish(std::string_view title) const;

 private:
  double width_;
  double height_;
  std::string body_;
};

/// Curves and contenders take these in turn.
inline constexpr std::size_t svg_inks = 8;

}  // namespace paperproof::compare
