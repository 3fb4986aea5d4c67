#include "oracle/box_tree.hpp"

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
#include <utility>

namespace paperproof::compare::detail {
namespace {

namespace geometry = boost::geometry;
using Corner = geometry::model::point<double, 2, geometry::cs::cartesian>;
using Entry = std::pair<geometry::model::box<Corner>, std::uint32_t>;

geometry::model::box<Corner> same(const Box2& box) {
  return {Corner(box.lower.x(), box.lower.y()), Corner(box.upper.x(), box.upper.y())};
}

}  // namespace

struct BoxTree::Tree : geometry::index::rtree<Entry, geometry::index::quadratic<8>> {
  using rtree::rtree;
};

BoxTree::BoxTree(std::span<const Box2> boxes, std::span<const std::uint32_t> names) {
  std::vector<Entry> entries;
  entries.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) entries.emplace_back(same(boxes[i]), names[i]);
  tree_ = std::make_shared<const Tree>(entries);
}

std::vector<std::uint32_t> BoxTree::meeting(const Box2& box) const {
  std::vector<std::uint32_t> found;
  const auto add = [&](const Entry& entry) { found.push_back(entry.second); };
  if (tree_) tree_->query(geometry::index::intersects(same(box)), boost::make_function_output_iterator(add));
  std::ranges::sort(found);
  return found;
}

}  // namespace paperproof::compare::detail
