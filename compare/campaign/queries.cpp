#include "campaign/queries.hpp"

#include "campaign/campaign.hpp"
#include "campaign/random.hpp"
#include "runs/input_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace paperproof::compare {
namespace {

/// Solids farther from the box of the way are left out [m].
constexpr double near_way = 0.05;
/// In one question.
constexpr std::size_t most_vertices = 64;
/// See `Query::degenerate` [m].
constexpr double barely = 1e-9;
constexpr double well_known = 1e-6;
/// Of a run: one run shall not fill a family.
constexpr int most_of_run = 40;

bool is_plain(const ColliderDef& collider) {
  return collider.shape != ColliderDef::Shape::circle && !collider.sensor && !collider.one_way;
}

/// The shape, larger by so much all around.
std::vector<Vec2d> grown(std::vector<Vec2d> points, double by) {
  const Vec2d middle = std::accumulate(points.begin(), points.end(), Vec2d{Vec2d::Zero()}) / points.size();
  for (Vec2d& point : points) point += by * (point - middle).normalized();
  return points;
}

/// The solids of one run, and the same questions for shapes that are barely larger and smaller.
class NearlySame {
 public:
  NearlySame(const SceneryDef& scenery, const std::vector<Vec2d>& points)
      : scenery_(scenery, points), larger_(scenery, grown(points, barely)), smaller_(scenery, grown(points, -barely)) {}

  /// @return nothing for a way that begins inside something, or has nothing near it, or more than a question holds.
  [[nodiscard]] std::optional<Query> ask(const Vec2d& position, const Vec2d& displacement) const {
    const std::vector<ColliderIndex> near = scenery_.near(position, position + displacement, near_way);
    if (near.empty() || !scenery_.overlapped(position).empty()) return std::nullopt;
    Query query;
    query.points.assign(scenery_.points().begin(), scenery_.points().end());
    query.position = position;
    query.displacement = displacement;
    std::size_t vertices = 0;
    for (const ColliderIndex collider : near) {
      query.solids.push_back(scenery_.scenery().colliders[collider]);
      vertices += query.solids.back().points.size();
      for (const std::vector<Vec2d>& hole : query.solids.back().holes) vertices += hole.size();
    }
    if (vertices > most_vertices || !std::all_of(query.solids.begin(), query.solids.end(), is_plain))
      return std::nullopt;
    const std::optional<ExactImpact> impact = scenery_.first_impact(position, displacement);
    if (impact) {
      query.contact = impact->fraction;
      query.with = static_cast<std::size_t>(std::find(near.begin(), near.end(), impact->collider) - near.begin());
    }
    const auto sooner = larger_.first_impact(position, displacement);
    const auto later = smaller_.first_impact(position, displacement);
    query.degenerate = sooner.has_value() != later.has_value() ||
                       (sooner && (static_cast<double>(later->fraction) - static_cast<double>(sooner->fraction)) *
                                          displacement.norm() >
                                      well_known);
    return query;
  }

 private:
  ExactScenery scenery_;
  ExactScenery larger_;
  ExactScenery smaller_;
};

Vec2d on_grid(const Vec2d& point) {
  constexpr double step = 1.0 / 64;
  return (point / step).array().round() * step;
}

/// The questions of one run.
class QueryRun {
 public:
  QueryRun(const RandomRun& run, std::string title, std::uint64_t seed)
      : run_(run), title_(std::move(title)), scene_(with_names(run.scene, title_)), random_(seed) {}

  void go(int most, const std::function<void(const Query&)>& take) {
    try {
      ask(most, take);
    } catch (const StepRefused&) {
      // The run has left the range.
    }
  }

 private:
  using Way = std::pair<Vec2d, Vec2d>;

  void ask(int most, const std::function<void(const Query&)>& take) {
    const Scenery scenery(scene_.scenery);
    const std::unique_ptr<Contender> contender = make_contender("octagon_sweep", ScalarKind::binary64, scene_, scenery);
    const Script script = script_of(scene_);
    InputCursor cursor(scene_, script);
    const NearlySame solids(scene_.scenery, contender->header().points);
    std::array<TraceStep, 1> record;
    std::size_t launch = 0;
    for (int step = 0; step < scene_.steps && most > 0; ++step) {
      for (; launch < run_.launches.size() && run_.launches[launch].step == step; ++launch)
        contender->launch(run_.launches[launch].velocity, 0);
      const StepInput input = with_up(run_, step, cursor.at(step));
      contender->step(input, record);
      for (const auto& [position, displacement] : ways_of(record.front()))
        if (std::optional<Query> query = solids.ask(position, displacement); query && most-- > 0) {
          query->source = fmt::format("{} step {}", title_, step);
          take(*query);
        }
    }
  }

  /// The step's own, the same again from where it ended, a random one, and one on a grid.
  std::array<Way, 4> ways_of(const TraceStep& record) {
    const Vec2d at = record.path.front().position;
    const double angle = random_.angle();
    const double length = random_.log_between(barely, 100);
    const Vec2d away = Vec2d{std::cos(angle), std::sin(angle)} * length;
    const Vec2d left = record.path.back().position;  // the same motion is wanted again where the step was stopped
    return {Way{at, record.requested}, Way{left, record.requested}, Way{at, away}, Way{on_grid(at), on_grid(4 * away)}};
  }

  const RandomRun& run_;
  std::string title_;
  Scene scene_;
  Random random_;
};

/// One character, and nothing moves.
bool stands(const RandomRun& run) {
  return run.scene.steps > 0 && run.scene.movers.empty() && run.scene.others.empty();
}

}  // namespace

void make_queries(int count, const std::function<void(const Query&)>& take) {
  std::vector<const Family*> chosen;
  for (const Family& family : families())
    if (stands(family.draw(family.first_seed))) chosen.push_back(&family);
  int left = count;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    int of_family = left / static_cast<int>(chosen.size() - i);
    left -= of_family;
    for (std::uint64_t seed = chosen[i]->first_seed; of_family > 0; ++seed) {
      const RandomRun run = chosen[i]->draw(seed);
      if (!stands(run)) continue;
      QueryRun(run, fmt::format("{} {}", chosen[i]->title(), seed), seed)
          .go(std::min(of_family, most_of_run), [&](const Query& query) {
            --of_family;
            take(query);
          });
    }
  }
}

}  // namespace paperproof::compare
