#include "runs/preparation.hpp"

#include "oracle/judge.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>

namespace paperproof::compare {
namespace {

/// Fewer pairs are prepared within seconds.
constexpr double many_pairs = 2e6;
/// In the sample: few enough for a fraction of a second, enough to stand out from what does not grow.
constexpr double pairs_to_measure = 1e5;
/// What a contender takes for less is noise [s]: it is taken to grow evenly.
constexpr double measurable = 2e-3;

/// From how many others some hundred boxes, evenly spread, are within reach of.
double pairs_in(std::span<const Box2> boxes, double reach) {
  constexpr std::size_t asked = 200;
  const std::size_t stride = std::max<std::size_t>(1, boxes.size() / asked);
  double met = 0;
  double count = 0;
  for (std::size_t i = 0; i < boxes.size(); i += stride, ++count)
    met += static_cast<double>(
               std::ranges::count_if(boxes, [&](const Box2& box) { return box.overlaps(boxes[i].inflated(reach)); })) -
           1;
  return count == 0 ? 0 : met / count * static_cast<double>(boxes.size()) / 2;
}

/// Every `stride`-th piece of the scenery as a collider of its own, standing still.
Scene sample_of(const Scene& scene, const Scenery& scenery, std::size_t stride) {
  Scene sample = scene;
  sample.scenery = {};
  sample.ids.clear();
  sample.movers.clear();
  sample.tiles = nullptr;
  for (PieceIndex piece = 0; piece < scenery.pieces().size(); piece += static_cast<PieceIndex>(stride)) {
    const ColliderDef& whole = scene.scenery.colliders[scenery.pieces()[piece].collider];
    const auto vertices = scenery.vertices_of(piece);
    ColliderDef part;
    part.shape = whole.shape == ColliderDef::Shape::circle ? whole.shape
                 : vertices.size() == 2                    ? ColliderDef::Shape::chain
                                                           : ColliderDef::Shape::polygon;
    part.radius = whole.radius;
    part.points.assign(vertices.begin(), vertices.end());
    part.one_way = whole.one_way;
    part.sensor = whole.sensor;
    sample.scenery.colliders.push_back(std::move(part));
    sample.ids.push_back(std::to_string(piece));
  }
  return sample;
}

/// What it takes one contender to get ready, its judge included [s].
double measured(const Scene& scene, const std::string& contender, ScalarKind scalar) {
  const auto begin = std::chrono::steady_clock::now();
  try {
    const Scenery scenery(scene.scenery);
    const auto runner = make_contender(contender, scalar, scene, scenery);
    const Judge judge(runner->header());
  } catch (const std::exception&) {
    return 0;  // it will not run
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

std::optional<Preparation> expected_preparation(const Scene& scene, const std::vector<std::string>& contenders,
                                                const std::vector<ScalarKind>& scalars) {
  const Scenery scenery(scene.scenery);
  // What the character can touch both of at once is compared.
  const Box2& body = scene.character.shape.box();
  Preparation expected{.pairs = pairs_in(scenery.boxes(), (body.upper - body.lower).maxCoeff())};
  if (expected.pairs < many_pairs) return std::nullopt;
  const auto stride = static_cast<std::size_t>(std::ceil(std::sqrt(expected.pairs / pairs_to_measure)));
  const Scene sample = sample_of(scene, scenery, stride);
  const Scene half = sample_of(scene, scenery, 2 * stride);
  for (const std::string& contender : contenders)
    for (const ScalarKind scalar : scalars) {
      if (computes_in_one(contender) && scalar != scalars.front()) continue;
      const double of_half = measured(half, contender, scalar);
      const double of_sample = measured(sample, contender, scalar);
      const bool grows = of_half > 0 && of_sample > measurable;
      const double power = grows ? std::clamp(std::log2(of_sample / of_half), 1.0, 2.0) : 1;
      expected.seconds += of_sample * std::pow(static_cast<double>(stride), power);
    }
  return expected;
}

}  // namespace paperproof::compare
