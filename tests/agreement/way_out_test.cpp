/// Starts inside solids with a last free place: each comes out on its side, by a way that is not longer than any that
/// trial finds there. Without a last free place the campaign asks for the shortest way: inside.
#include "campaign/families.hpp"
#include "controller/stepping.hpp"
#include "oracle/exact.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace paperproof::test {
namespace {

using compare::Place;
using Colliders = std::vector<ColliderIndex>;

/// What is asked of a way that is found by trial [m].
constexpr double roomy = 1e-4;

/// A character in a scene of the family `inside`, which nothing pulls, and exact answers about it.
struct Solids : stepping::Stepper {
  explicit Solids(const compare::RandomRun& run)
      : Stepper(run.scene.scenery.colliders), start(run.scene.start.position) {
    state.position = start;
    gravity = {0, 0};
  }

  /// Whether a way passes nothing else.
  [[nodiscard]] bool is_open(const Vec2d& from, const Vec2d& to, const Colliders& may_pass) const {
    const Vec2d way = roomy * (to - from).normalized();
    const Vec2d across{-way.y(), way.x()};
    for (const Vec2d& end : {to, Vec2d(to + across), Vec2d(to - across)}) {
      const Colliders met = oracle.met(from, end);
      if (!std::includes(may_pass.begin(), may_pass.end(), met.begin(), met.end())) return false;
    }
    return true;
  }
  [[nodiscard]] bool is_roomy(const Vec2d& at) const {
    const Colliders near = oracle.near(Place(at), Place(at), 2 * roomy);
    return oracle.overlapped(at).empty() && std::none_of(near.begin(), near.end(), [&](ColliderIndex collider) {
             return !oracle.scenery().colliders[collider].one_way && oracle.separation(Place(at), collider) <= roomy;
           });
  }
  /// By trial: shorter than `length`, and open to the last free place.
  [[nodiscard]] std::optional<Vec2d> way_out(const Colliders& inside, const Vec2d& last_free, double length) const {
    constexpr int directions = 48;
    constexpr double stride = 0.05;
    for (int k = 0; k < directions; ++k) {
      const Vec2d way = compare::towards(2 * std::numbers::pi * k / directions);
      for (double distance = stride; distance < length; distance += stride) {
        const Vec2d end = start + way * distance;
        if (!is_open(start, end, inside)) break;
        if (is_roomy(end) && is_open(last_free, end, {})) return end;
      }
    }
    return std::nullopt;
  }

  Vec2d start;
  compare::ExactScenery oracle{scenery->as_run(), hull()};
};

class WayOut : public ::testing::TestWithParam<const compare::Family*> {};

TEST_P(WayOut, leads_to_the_side_of_the_last_free_place_by_the_shortest_way_there) {
  const int wanted = sampled(200);
  int starts = 0;
  int to_its_side = 0;
  for (std::uint64_t seed = GetParam()->first_seed; starts < wanted && !HasFailure(); ++seed) {
    SCOPED_TRACE(GetParam()->replay_of(seed));
    Solids solids(GetParam()->draw(seed));
    const Colliders inside = solids.oracle.overlapped(solids.start);
    Random random(seed);
    const Vec2d last_free = solids.start + random.point(9);
    solids.state.last_free = last_free;
    solids.state.has_last_free = true;
    if (inside.empty() || !solids.oracle.overlapped(last_free).empty()) continue;
    solids.step();
    ++starts;
    const auto& path = solids.report.move.path;
    const bool is_out = path.size() > 1 && path[1].fraction == 0 && solids.oracle.overlapped(path[1].position).empty();
    const bool on_its_side = is_out && solids.oracle.met(last_free, path[1].position).empty();
    to_its_side += on_its_side;
    // Nothing is said about a way that ends farther away than the solids reach.
    const double length = on_its_side ? (path[1].position - solids.start).norm() - roomy : 2;
    const std::optional<Vec2d> shorter = solids.way_out(inside, last_free, length);
    EXPECT_FALSE(shorter) << "there is a way from " << solids.start.transpose() << " on the side of "
                          << last_free.transpose() << " to " << shorter->transpose();
  }
  EXPECT_GE(to_its_side, starts / 10);
}

INSTANTIATE_TEST_SUITE_P(Every, WayOut, ::testing::ValuesIn(compare::families_named("inside")),
                         [](const auto& family) { return family.param->name; });

}  // namespace
}  // namespace paperproof::test
