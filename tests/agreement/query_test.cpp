/// cast, overlaps, contacts_at, nearest and sensors_at against exact arithmetic, in random scenery with movers. In half
/// of it these have angles that they keep, and exact arithmetic is asked of movers that are made turned.
#include "agreement/saying.hpp"
#include "controller/stepping.hpp"
#include "oracle/exact.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace paperproof::test {
namespace {

using compare::ExactScenery;
using compare::Place;

struct Tally {
  int casts = 0;
  int hits = 0;
  int grazing = 0;  ///< Exact arithmetic and the query differ about a contact, by less than the contact's gap.
  int overlapping = 0;
  int near = 0;
};

/// One character and the oracle in one scenery, and in a second one, whose solids are sensors.
class Questions {
 public:
  Questions(Terrain family, std::uint64_t seed) : random_(seed), solids_(random_colliders(family, random_)) {}

  void ask(Tally& tally) {
    std::vector<Wanderer> wanderers(motions_.size());
    for (int question = 0; question < 20; ++question) {
      for (std::size_t k = 0; k < motions_.size(); ++k)
        motions_[k] = {motions_[k].to, next_offset(wanderers[k], motions_[k].to, random_), angles_[k], angles_[k]};
      const Place from(random_.point(6), motions_, 0);
      const double angle = random_.chance(0.3) ? random_.integer(0, 7) * std::numbers::pi / 4 : random_.angle();
      const Vec2d displacement = compare::towards(angle) * random_.log_between(0.1, 20);
      const std::vector<ColliderIndex> inside = oracle_.overlapped(from);
      overlaps(from, inside, tally);
      near(from, tally);
      if (inside.empty()) cast(from, displacement, tally);
    }
  }

 private:
  static std::vector<ColliderDef> random_colliders(Terrain family, Random& random) {
    SceneryDef def = random_terrain(family, random, Vec2d::Zero());
    while (def.colliders.size() < 4) def.colliders.push_back(compare::polygon({{50, 50}, {51, 50}, {50, 51}}));
    const int movers = random.integer(0, 3);
    for (int mover = 0; mover < movers; ++mover)
      add_mover(def.colliders, static_cast<MoverIndex>(mover), random, Vec2d::Zero());
    return def.colliders;
  }
  static std::vector<double> some_angles(std::size_t movers, Random& random) {
    std::vector<double> angles(movers);
    if (random.chance(0.5)) std::ranges::generate(angles, [&] { return random.angle(); });
    return angles;
  }
  static std::vector<ColliderDef> as_sensors(std::vector<ColliderDef> colliders) {
    for (ColliderDef& collider : colliders) collider.sensor = !collider.one_way;
    return colliders;
  }
  [[nodiscard]] StepContext context() const { return {.dt = 1, .movers = motions_}; }
  [[nodiscard]] const std::vector<ColliderDef>& colliders() const { return oracle_.scenery().colliders; }

  void overlaps(const Place& from, const std::vector<ColliderIndex>& exact, Tally& tally) {
    std::array<ColliderIndex, 256> found{};
    const auto count = solids_.sweep().overlaps(from.position, context(), solids_.scratch, found);
    tally.overlapping += !exact.empty();
    ASSERT_EQ(count, exact.size());
    const std::set<ColliderIndex> sorted(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(exact.size()));
    EXPECT_TRUE(std::equal(exact.begin(), exact.end(), sorted.begin(), sorted.end()));
    std::array<ColliderIndex, 256> sensed{};
    const std::size_t around = sensors_.sweep().sensors_at(from.position, context(), sensors_.scratch, sensed);
    EXPECT_TRUE(std::is_permutation(exact.begin(), exact.end(), sensed.begin(), sensed.begin() + around));
  }

  void near(const Place& from, Tally& tally) {
    constexpr double rounding = 1e-9;
    const double within = random_.log_between(1e-3, 3);
    std::array<Contact, 64> contacts;
    const std::size_t count = solids_.sweep().contacts_at(from.position, within, context(), solids_.scratch, contacts);
    const auto nearest = solids_.sweep().nearest(from.position, within, context(), solids_.scratch);
    ASSERT_EQ(nearest.has_value(), count > 0);
    for (std::size_t i = 0; i < count; ++i) {
      const Contact& contact = contacts[i];
      EXPECT_LE(contacts[i > 0 ? i - 1 : 0].separation, contact.separation);
      EXPECT_LE(contact.separation, within);
      // A collider of several pieces is as near as the nearest of them.
      if (contact.separation >= 0)
        EXPECT_GE(contact.separation, oracle_.separation(from, contact.collider) - rounding);
      else
        EXPECT_TRUE(contact.separation > -rounding || oracle_.overlaps(from, contact.collider));
    }
    double least = within;
    for (ColliderIndex collider = 0; collider < colliders().size(); ++collider)
      if (!colliders()[collider].one_way) least = std::min(least, oracle_.separation(from, collider));
    if (least >= 0 && least < within) {
      ASSERT_GT(count, 0U);
      EXPECT_LE(contacts[0].separation, least + rounding);
    }
    if (count == 0) return;
    ++tally.near;
    EXPECT_EQ(nearest->separation, contacts[0].separation);
    EXPECT_EQ(nearest->collider, contacts[0].collider);
  }

  void cast(const Place& from, const Vec2d& displacement, Tally& tally) {
    ++tally.casts;
    const auto hit = solids_.sweep().cast(from.position, displacement, context(), solids_.scratch);
    const Place to(from.position + displacement, motions_, 1);
    double first = 2;
    for (ColliderIndex collider = 0; collider < colliders().size(); ++collider)
      if (const auto impact = oracle_.impact_between(from, to, collider))
        first = std::min(first, static_cast<double>(impact->fraction));
    tally.hits += first <= 1;
    if (!hit && first > 1) return;
    if (hit && first <= 1 && std::abs(hit->fraction - first) <= 1e-9) return;
    // Along a rim or a surface, nearer than what counts as a contact.
    const double time = std::min({hit ? hit->fraction : 1, first, 1.0});
    const Place then(Vec2d(from.position + displacement * time), motions_, time);
    double gap = 1;
    for (ColliderIndex collider = 0; collider < colliders().size(); ++collider)
      gap = std::min(gap, oracle_.separation(then, collider));
    EXPECT_LE(gap, 1.1e-7) << "exact " << first << ", found " << (hit ? hit->fraction : 2);
    ++tally.grazing;
  }

  Random random_;
  stepping::Stepper solids_;
  stepping::Stepper sensors_{as_sensors(solids_.scenery->as_run().colliders)};
  std::vector<double> angles_ = some_angles(solids_.movers.size(), random_);
  ExactScenery oracle_{made_turned(solids_.scenery->as_run(), angles_), solids_.hull()};
  std::vector<MoverMotion>& motions_ = solids_.movers;
};

class Queries : public ::testing::TestWithParam<Terrain> {};

TEST_P(Queries, are_answered_as_by_exact_arithmetic) {
  Tally tally;
  for (std::uint64_t seed = 1; tally.casts < sampled(1000); ++seed) {
    Questions(GetParam(), seed).ask(tally);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GE(tally.hits, tally.casts / 20);
  EXPECT_LE(tally.grazing, tally.casts / 50);
  EXPECT_GE(tally.overlapping, 1 + tally.casts / 100);
  EXPECT_GE(tally.near, tally.casts / 10);
}

INSTANTIATE_TEST_SUITE_P(EveryFamily, Queries, ::testing::ValuesIn(all_terrains),
                         [](const ::testing::TestParamInfo<Terrain>& family) { return name_of(family.param); });

}  // namespace
}  // namespace paperproof::test
