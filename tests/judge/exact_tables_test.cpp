/// What exact arithmetic answers to one question: the tables of `exact/`. README.md has the notation.
#include "judge/row.hpp"
#include "oracle/exact.hpp"
#include "oracle/first_meeting.hpp"
#include "records/collider_json.hpp"
#include "support/expected.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace paperproof::compare::test {
namespace {

/// Colliders and movers of a row.
struct World {
  explicit World(const Json& said) : header(header_of(said, "somebody")) {
    paperproof::test::refuse_other_keys(said, " what header colliders ask asks ", "a row of questions");
    MoverIndex mover = 0;
    for (std::size_t i = 0; i < header["colliders"].size(); ++i) {
      colliders.push_back(collider_of(header["colliders"][i]));
      if (said["colliders"][i].contains("goes")) colliders.back().mover = mover++;
    }
  }
  [[nodiscard]] ExactScenery scenery() const {
    return {SceneryDef{.colliders = colliders}, points_of(header["points"])};
  }
  [[nodiscard]] ColliderIndex numbered(const std::string& id) const {
    ColliderIndex number = 0;
    while (header["colliders"].at(number)["id"] != id) ++number;
    return number;
  }
  [[nodiscard]] Json ids(const std::vector<ColliderIndex>& some) const {
    Json all = Json::array();
    for (const ColliderIndex collider : some) all.push_back(header["colliders"][collider]["id"]);
    return all;
  }

  Json header;
  std::vector<ColliderDef> colliders{};
};

/// Between which fractions the first overlap is with what turns, on a path: both methods must see one, or none.
Json meeting(const World& world, const Json& asked) {
  const Json goes = movers_of(asked["movers"], world.header).front();
  VertexWay way{.collider = 0, .instants = goes["k"], .vertices = {}};
  for (const Json& points : goes["vertices"]) way.vertices.push_back(points_of(points));
  std::vector<PathPoint> path;
  for (const Json& corner : path_of(asked["path"])) path.push_back({point_of(corner), corner[2]});
  std::vector<std::size_t> part(way.vertices.front().size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  const std::vector<Vec2d> body = points_of(world.header["points"]);
  const detail::Meeting first = detail::first_meeting(body, path, way, part, detail::Asked::when, 0);
  EXPECT_EQ(detail::second_meeting(body, path, way, part, 0).kind, first.kind);
  EXPECT_NE(first.kind, detail::Meeting::Kind::undecided);
  return first.kind == detail::Meeting::Kind::meets ? Json{first.low, first.high} : Json("none");
}

/// At a place: what is overlapped there, and how near or deep the collider is that is asked of. With `to` also what is
/// met on the way, with `by` the impact with that collider, with `reach` where a way out ends.
Json answer(const World& world, const Json& asked) {
  paperproof::test::refuse_other_keys(asked, " what at time to by of reach movers path tells ", "a question");
  if (asked.contains("path")) return {{"meets", meeting(world, asked)}};
  const ExactScenery there = world.scenery();
  const Json said = movers_of(asked.value("movers", Json::object()), world.header);
  std::vector<MoverMotion> movers;
  for (const auto& [id, motion] : said.items()) movers.push_back({point_of(motion[0]), point_of(motion[1])});
  const Place at(point_of(asked["at"]), movers, asked.value("time", 0.0));
  const ColliderIndex of = asked.contains("of") ? world.numbered(asked["of"]) : 0;
  Json all{{"overlapped", world.ids(there.overlapped(at))}, {"impact", "none"}};
  if (movers.empty()) all["separation"] = there.separation(at, of);
  if (movers.empty()) all["penetration"] = there.penetration(at, of);
  if (asked.contains("to")) all["met"] = world.ids(there.met(at, Place(point_of(asked["to"]), movers, 1)));
  if (asked.contains("by"))
    if (const auto impact = there.time_of_impact(at, point_of(asked["by"]), of))
      all["impact"] = {{"fraction", static_cast<double>(impact->fraction)},
                       {"normal", point_json(impact->normal)},
                       {"point", point_json(impact->point)},
                       {"exposed", impact->exposed}};
  if (asked.contains("reach")) {
    const std::optional<Vec2d> out = there.way_out(at, asked["reach"]);
    all["way_out"] = out ? point_json(*out) : Json("none");
    all["overlapped_there"] = out ? world.ids(there.overlapped(Place(*out, movers, at.fraction))) : Json("none");
  }
  all["needed_rationals"] = there.rational_decisions() > 0;
  return all;
}

class ExactTables : public ::testing::TestWithParam<Row> {};

TEST_P(ExactTables, are_what_exact_arithmetic_answers) {
  for (const RowCase& one : cases_of(GetParam())) {
    const World world(one.said);
    for (const Json& patch : one.said.value("asks", Json::array({Json::object()}))) {
      Json asked = one.said.value("ask", Json::object());
      asked.merge_patch(patch);
      SCOPED_TRACE(one.title + ", " + asked.dump());
      EXPECT_EQ(missed(asked.at("tells"), answer(world, asked)), "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExactTables, ::testing::ValuesIn(read_rows(PAPERPROOF_JUDGE_TABLES "/exact")),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace paperproof::compare::test
