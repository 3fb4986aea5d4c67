/// cast, overlaps, contacts_at and nearest against exact arithmetic, in random scenery with movers.
#include "oracle/exact.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>

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

class Questions {
 public:
  Questions(Terrain family, std::uint64_t seed) : random_(seed), def_(random_terrain(family, random_, Vec2d::Zero())) {
    const int movers = random_.integer(0, 3);
    while (def_.colliders.size() < 4) def_.colliders.push_back({.points = {{50, 50}, {51, 50}, {50, 51}}});
    for (MoverIndex mover = 0; mover < static_cast<MoverIndex>(movers); ++mover)
      add_mover(def_.colliders, mover, random_, Vec2d::Zero());
  }

  void ask(Tally& tally) {
    const Scenery<double> scenery(def_);
    const Controller<double> controller(scenery, CharacterDef{});
    Scratch<double> scratch = controller.make_scratch();
    const auto hull = controller.character().shape.hull();
    const ExactScenery oracle(scenery.as_run(), {hull.begin(), hull.end()});
    std::vector<MoverMotion<double>> motions(scenery.mover_count());
    std::vector<Wanderer> wanderers(motions.size());
    for (int question = 0; question < 20; ++question) {
      for (std::size_t k = 0; k < motions.size(); ++k)
        motions[k] = {motions[k].to, next_offset(wanderers[k], motions[k].to, random_)};
      const Vec2d at{random_.between(-6, 6), random_.between(-6, 6)};
      const double length = random_.log_between(0.1, 20);
      const double angle = random_.chance(0.3) ? random_.integer(0, 7) * std::numbers::pi / 4 : random_.angle();
      const StepContext<double> context{.dt = 1, .movers = motions};
      const Place from(at, motions, 0);
      overlaps(controller.overlaps(at, context, scratch, found_).value(), oracle.overlapped(from), tally);
      near(controller, context, scratch, oracle, from, tally);
      if (oracle.overlapped(from).empty())
        cast(controller, context, scratch, oracle, at, Vec2d{std::cos(angle), std::sin(angle)} * length, tally);
    }
  }

 private:
  void overlaps(std::size_t count, const std::vector<ColliderIndex>& exact, Tally& tally) {
    tally.overlapping += !exact.empty();
    ASSERT_EQ(count, exact.size());
    std::sort(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(count));
    EXPECT_TRUE(std::equal(exact.begin(), exact.end(), found_.begin()));
  }

  void near(const Controller<double>& controller, const StepContext<double>& context, Scratch<double>& scratch,
            const ExactScenery& oracle, const Place& from, Tally& tally) {
    const double within = random_.log_between(1e-3, 3);
    std::array<Contact<double>, 64> contacts;
    const std::size_t count = controller.contacts_at(from.position, within, context, scratch, contacts);
    const auto nearest = controller.nearest(from.position, within, context, scratch);
    ASSERT_EQ(nearest.has_value(), count > 0);
    for (std::size_t i = 0; i < count; ++i) {
      const Contact<double>& contact = contacts[i];
      EXPECT_LE(contacts[i > 0 ? i - 1 : 0].separation, contact.separation);
      EXPECT_LE(contact.separation, within);
      // A collider of several pieces is as near as the nearest of them.
      if (contact.separation >= 0)
        EXPECT_GE(contact.separation, oracle.separation(from, contact.collider) - 1e-9);
      else
        EXPECT_TRUE(contact.separation > -1e-9 || oracle.overlaps(from, contact.collider));
    }
    double least = within;
    for (ColliderIndex collider = 0; collider < def_.colliders.size(); ++collider)
      if (!def_.colliders[collider].one_way) least = std::min(least, oracle.separation(from, collider));
    if (least >= 0 && least < within) {
      ASSERT_GT(count, 0U);
      EXPECT_LE(contacts[0].separation, least + 1e-9);
    }
    if (count == 0) return;
    ++tally.near;
    EXPECT_EQ(nearest->separation, contacts[0].separation);
    EXPECT_EQ(nearest->collider, contacts[0].collider);
  }

  void cast(const Controller<double>& controller, const StepContext<double>& context, Scratch<double>& scratch,
            const ExactScenery& oracle, const Vec2d& at, const Vec2d& displacement, Tally& tally) {
    ++tally.casts;
    const auto hit = controller.cast(at, displacement, context, scratch);
    const Place from(at, context.movers, 0);
    const Place to(at + displacement, context.movers, 1);
    double first = 2;
    for (ColliderIndex collider = 0; collider < def_.colliders.size(); ++collider) {
      const auto impact = oracle.impact_between(from, to, collider);
      if (impact) first = std::min(first, impact->fraction.convert_to<double>());
    }
    tally.hits += first <= 1;
    if (!hit && first > 1) return;
    if (!hit || first > 1 || std::abs(hit->fraction - first) > 1e-9) {
      // Along a rim or a surface, nearer than what counts as a contact.
      const double time = hit ? std::min(hit->fraction, first) : first;
      const Place then(Vec2d(at + displacement * std::min(time, 1.0)), context.movers, std::min(time, 1.0));
      double gap = 1;
      for (ColliderIndex collider = 0; collider < def_.colliders.size(); ++collider)
        gap = std::min(gap, oracle.separation(then, collider));
      EXPECT_LE(gap, 1.1e-7) << "exact " << first << ", found " << (hit ? hit->fraction : 2);
      ++tally.grazing;
    }
  }

  Random random_;
  SceneryDef def_;
  std::array<ColliderIndex, 256> found_{};
};

class Queries : public ::testing::TestWithParam<Terrain> {};

TEST_P(Queries, are_answered_as_by_exact_arithmetic) {
  Tally tally;
  for (std::uint64_t seed = 1; tally.casts < sampled(1000); ++seed) {
    Questions(GetParam(), seed).ask(tally);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  std::printf("%s: %d casts, %d hit, %d grazing, %d positions overlap, %d are near\n", name_of(GetParam()).c_str(),
              tally.casts, tally.hits, tally.grazing, tally.overlapping, tally.near);
  EXPECT_GE(tally.hits, tally.casts / 20);
  EXPECT_LE(tally.grazing, tally.casts / 50);
  EXPECT_GE(tally.overlapping, 10);
  EXPECT_GE(tally.near, tally.casts / 10);
}

INSTANTIATE_TEST_SUITE_P(EveryFamily, Queries, ::testing::ValuesIn(all_terrains),
                         [](const ::testing::TestParamInfo<Terrain>& family) { return name_of(family.param); });

}  // namespace
}  // namespace paperproof::test
