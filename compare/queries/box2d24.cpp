/// Box2D 2.4 answers questions of first contact, piece by piece: b2TimeOfImpact or b2ShapeCast.
///
///     queries_box2d24 impact|cast QUERIES.jsonl > ANSWERS.jsonl
///
/// Tolerances are those of its sources at v2.4.1. b2TimeOfImpact stops where the cores of two polygons, which have a
/// skin of b2_polygonRadius each, are a slop apart, or a quarter of it more; b2ShapeCast where they are a skin apart,
/// or half a slop more.
#include "answers.hpp"

#include <box2d/b2_distance.h>
#include <box2d/b2_time_of_impact.h>
#include <box2d/box2d.h>

#include <algorithm>

namespace {

using queries::Json;
using Vertices = std::vector<b2Vec2>;
constexpr auto vertices = &queries::points<b2Vec2, float>;

bool is_polygon(const Vertices& ring) {
  std::size_t left = 0;
  for (std::size_t i = 0, n = ring.size(); i < n; ++i)
    left += b2Cross(ring[(i + 1) % n] - ring[i], ring[(i + 2) % n] - ring[(i + 1) % n]) > 0;
  return ring.size() <= b2_maxPolygonVertices && (left == 0 || left == ring.size());
}

/// Polygons as they are where Box2D has such, edges of the rest.
std::vector<Vertices> pieces(const Json& question) {
  std::vector<Vertices> result;
  for (const Json& solid : question["solids"]) {
    Json lines = solid.value("holes", Json::array());
    lines.push_back(solid[solid.contains("chain") ? "chain" : "polygon"]);
    for (const Json& each : lines) {
      Vertices line = vertices(each, question["position"]);
      const bool is_ring = solid.contains("polygon");
      if (is_ring && lines.size() == 1 && is_polygon(line)) {
        result.push_back(line);
        continue;
      }
      if (is_ring) line.push_back(line.front());
      for (std::size_t i = 1; i < line.size(); ++i) result.push_back({line[i - 1], line[i]});
    }
  }
  return result;
}

b2DistanceProxy proxy(const Vertices& points) {
  b2DistanceProxy result;
  result.Set(points.data(), static_cast<int32>(points.size()), b2_polygonRadius);
  return result;
}

/// As the engine's own steps read it: only what touches stops a body.
std::optional<double> time_of_impact(const Vertices& shape, const b2Vec2& way, const Vertices& piece) {
  const auto sweep_to = [](const b2Vec2& end) { return b2Sweep{b2Vec2_zero, b2Vec2_zero, end, 0, 0, 0}; };
  const b2TOIInput input{proxy(piece), proxy(shape), sweep_to(b2Vec2_zero), sweep_to(way), 1};
  b2TOIOutput output;
  b2TimeOfImpact(&output, &input);
  return output.state == b2TOIOutput::e_touching ? std::optional<double>(output.t) : std::nullopt;
}

std::optional<double> cast(const Vertices& shape, const b2Vec2& way, const Vertices& piece) {
  const b2Transform stays{b2Vec2_zero, b2Rot(0)};
  const b2ShapeCastInput input{proxy(piece), proxy(shape), stays, stays, way};
  b2ShapeCastOutput output;
  return b2ShapeCast(&output, &input) ? std::optional<double>(output.lambda) : std::nullopt;
}

}  // namespace

int main(int, char** arguments) {
  const bool casts = arguments[1] == std::string("cast");
  const auto prepare = [&](const Json& question) {
    const auto way = queries::point<b2Vec2, float>(question["displacement"], {0, 0});
    const Vertices shape = vertices(question["points"], {0, 0});
    return [=, solids = pieces(question)] {
      std::optional<double> first;
      for (const Vertices& piece : solids)
        if (const auto contact = casts ? cast(shape, way, piece) : time_of_impact(shape, way, piece))
          first = std::min(*contact, first.value_or(1));
      return first;
    };
  };
  const double tolerance = casts ? b2_polygonRadius + 0.5 * b2_linearSlop : 1.25 * b2_linearSlop;
  const char* method = casts ? "Box2D 2.4 b2ShapeCast" : "Box2D 2.4 b2TimeOfImpact";
  queries::answer_all(arguments[2], {{"method", method}, {"tolerance", tolerance}, {"float", true}}, prepare);
}
