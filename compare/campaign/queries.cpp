#include "campaign/queries.hpp"

#include "campaign/campaign.hpp"
#include "campaign/random.hpp"
#include "runs/input_cursor.hpp"
#include "scenes/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

namespace paperproof::compare {
namespace {

/// Solids farther from the box of the way are left out [m].
constexpr double near_way = 0.05;
/// Of a way [m].
constexpr double longest = 1000;
/// In one question.
constexpr std::size_t most_vertices = 64;
/// See `Query::degenerate` [m].
constexpr double barely = 1e-9;
constexpr double well_known = 1e-6;
/// Of a run: one run shall not fill a family.
constexpr int most_of_run = 40;
/// So many runs more than questions are tried, as a scene may have no solid that a question can have. What a family
/// does not have comes from those behind it.
constexpr std::uint64_t barren_runs = 200;

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

  /// @return nothing for a way of no length or of more than `longest`, one that begins inside something, has nothing
  /// near it, or more than a question holds.
  [[nodiscard]] std::optional<Query> ask(const Vec2d& position, const Vec2d& displacement) const {
    if (displacement.isZero(0) || displacement.norm() > longest) return std::nullopt;
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

using Way = std::pair<Vec2d, Vec2d>;
/// Ways that were asked about. Who rests wants the same in each step, and one level is drawn for several families.
using Asked = std::set<std::array<double, 4>>;

/// The questions of one run.
class QueryRun {
 public:
  QueryRun(const RandomRun& run, std::string title, std::uint64_t seed, Asked& asked)
      : run_(run), title_(std::move(title)), scene_(with_names(run.scene, title_)), random_(seed), asked_(asked) {}

  void go(int most, const std::function<void(const Query&)>& take) {
    try {
      ask(most, take);
    } catch (const StepRefused&) {
      // The run has left the range.
    }
  }

 private:
  void ask(int most, const std::function<void(const Query&)>& take) {
    const Scenery scenery(scene_.scenery);
    const std::unique_ptr<Contender> contender = make_contender("octagon_sweep", ScalarKind::binary64, scene_, scenery);
    const Script script = script_of(scene_);
    InputCursor cursor(scene_, script);
    const NearlySame solids(scene_.scenery, contender->header().points);
    std::array<TraceStep, 1> record;
    for (int step = 0; step < scene_.steps && most > 0; ++step) {
      for (const Launch& launch : run_.launches_before(step)) contender->launch(launch.velocity, 0);
      const StepInput input = with_up(run_, step, cursor.at(step));
      contender->step(input, record);
      for (const auto& [position, displacement] : ways_of(record.front())) {
        if (!asked_.insert({position.x(), position.y(), displacement.x(), displacement.y()}).second) continue;
        if (std::optional<Query> query = solids.ask(position, displacement); query && most-- > 0) {
          query->source = fmt::format("{} step {}", title_, step);
          take(*query);
        }
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
  Asked& asked_;
};

/// One character, and nothing moves.
bool stands(const RandomRun& run) {
  return run.scene.steps > 0 && run.scene.movers.empty() && run.scene.others.empty();
}

}  // namespace

Family ways_through(const Scene& scene) {
  if (!stands({.scene = scene})) throw InputError(scene.name + ": something moves there beside one character");
  return {.kind = "scene", .name = scene.name, .draw = [scene](std::uint64_t seed) {
            RandomRun run{.scene = scene};
            run.scene.moves_at_random = seed;
            return run;
          }};
}

void make_queries(int count, const std::vector<Family>& from, const std::function<void(const Query&)>& take) {
  std::vector<const Family*> chosen;
  for (const Family& family : from)
    if (stands(family.draw(family.first_seed))) chosen.push_back(&family);
  Asked asked;
  int left = count;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    int of_family = left / static_cast<int>(chosen.size() - i);
    left -= of_family;
    const std::uint64_t end = chosen[i]->first_seed + static_cast<std::uint64_t>(of_family) + barren_runs;
    for (std::uint64_t seed = chosen[i]->first_seed; of_family > 0 && seed < end; ++seed) {
      const RandomRun run = chosen[i]->draw(seed);
      if (!stands(run)) continue;
      QueryRun(run, fmt::format("{} {}", chosen[i]->title(), seed), seed, asked)
          .go(std::min(of_family, most_of_run), [&](const Query& query) {
            --of_family;
            take(query);
          });
    }
    left += of_family;
  }
}

}  // namespace paperproof::compare
