/// The gallery: who fails where, and who is the cheapest of those that do not.
#include "runs/gallery.hpp"
#include "compare/scene_files.hpp"
#include "runs/contestant.hpp"
#include "scenes/sets.hpp"

#include <algorithm>

namespace paperproof::compare {
namespace {

Row row(const std::string& scene, const std::string& contender, double ns) {
  Row row;
  row.scene = scene;
  row.contender = contender;
  row.ns_per_step = ns;
  return row;
}

TEST(Gallery, names_the_worst_failure_and_the_largest_lead) {
  std::vector<Row> rows{row("a", "one", 10),  row("a", "two", 30), row("b", "one", 10),
                        row("b", "two", 100), row("c", "one", 20), row("c", "two", 5)};
  rows[4].contact_recall = 0.5;
  rows[1].verdict = Verdict::tunnels;
  rows[1].reason = "step 3: passed `paper`";
  const std::vector<GalleryEntry> gallery = gallery_of(rows);
  ASSERT_EQ(gallery.size(), 2U);
  ASSERT_TRUE(gallery[0].fails && gallery[0].cheapest && gallery[1].fails && gallery[1].cheapest);
  EXPECT_EQ(gallery[0].fails->scene, "c");
  EXPECT_EQ(gallery[0].fails->failure.words, "misses 50 % of the contacts that exact arithmetic has");
  EXPECT_EQ(gallery[0].cheapest->scene, "a") << "where nobody else is without a failure";
  EXPECT_EQ(gallery[0].cheapest->next, "");
  EXPECT_EQ(gallery[1].fails->failure.words, "step 3: passed `paper`");
  EXPECT_EQ(gallery[1].cheapest->scene, "c");
}

TEST(Gallery, prefers_the_worse_failure_over_the_earlier_one) {
  std::vector<Row> rows{row("a", "one", 1), row("b", "one", 1)};
  rows[0].rest_peak_to_peak_m = 0.03;
  rows[1].verdict = Verdict::flagged;
  rows[1].steps_ending_inside = 4;
  rows[1].reason = "ends 4 steps inside a solid";
  EXPECT_EQ(gallery_of(rows)[0].fails->scene, "b");
  rows.pop_back();
  EXPECT_EQ(gallery_of(rows)[0].fails->failure.words, "moves by 0.03 m at rest");
}

TEST(Gallery, says_that_a_search_found_none) {
  std::vector<Row> rows{row("a", "one", 10), row("a", "two", 20), row("a", "three", 0)};
  rows[2].verdict = Verdict::not_applicable;
  rows[2].ns_per_step.reset();
  const std::vector<std::string> lines = gallery_lines(gallery_of(rows));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_TRUE(holds(lines[0], "one: the search over 1 scene found none on which it fails; on a it is the cheapest"));
  EXPECT_TRUE(holds(lines[1], "on none it is the cheapest"));
  EXPECT_EQ(lines[2], "three: can express none of the scenes.");
}

TEST(Gallery, says_once_that_nothing_was_timed) {
  std::vector<Row> rows{row("a", "one", 1), row("a", "two", 1)};
  for (Row& one : rows) one.ns_per_step.reset();
  const std::vector<std::string> lines = gallery_lines(gallery_of(rows));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1], "two: the search over 1 scene found none on which it fails.");
  EXPECT_EQ(lines[2], "Nothing was timed, so that none is named as the cheapest.");
}

TEST(Gallery, a_run_without_a_number_is_no_failure_and_a_nan_is_one) {
  EXPECT_FALSE(failure_of(row("a", "one", 1)));
  Row odd = row("a", "one", 1);
  odd.rest_peak_to_peak_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(failure_of(odd));
}

TEST(SceneSets, are_made_of_built_in_scenes) {
  ASSERT_NE(find_set("technique_gallery"), nullptr);
  EXPECT_EQ(find_set("article_bullet"), nullptr);
  for (const SceneSet& set : scene_sets()) {
    const std::vector<Scene> scenes = load_scenes(set.name);
    ASSERT_EQ(scenes.size(), set.scenes.size());
    for (std::size_t i = 0; i < scenes.size(); ++i) EXPECT_EQ(scenes[i].name, set.scenes[i]);
  }
}

}  // namespace
}  // namespace paperproof::compare
