#include "oracle/judge.hpp"

#include "oracle/passing.hpp"

#include <algorithm>

namespace paperproof::compare {
namespace {

/// Passing a solid by no deeper than this is a corner cut [m]. Zero: a rounding error at a corner counts as tunnelling.
/// Large: real passages are hidden.
constexpr double slop_of_exact_path = 0.005;
/// The same for a path that only holds samples: Box2D's skin.
constexpr double slop_of_sampled_path = 0.020;
/// So much of the octagon's narrowest width the slop may be at most: a character of a few millimetres that is passed by
/// a paper is half a width deep, which must not be excused.
constexpr double slop_of_width = 0.125;
/// A contact is this near along its normal [m]: twice what the controller stops at.
constexpr double contact_reach = 1e-6;
/// Below this gap at the end of the motion the controller may call it a contact already [m]: its hit distance, with
/// room for the rounding of the comparison.
constexpr double hit_reach = 1.01e-7;
/// Box2D begins to report touching at this gap [m].
constexpr double skin = 0.020;
/// See `Judge`: sine of the flattest approach whose fraction is compared.
constexpr double least_approach = 1e-3;
/// Cosine of the angle between two normals of one face, as far as Box2D's floats and its rounded corners know it.
constexpr double same_face = 0.9;
/// A smaller share of the speed is rounding: Box2D's floats have 24 bits.
constexpr double least_loss = 1e-5;
/// Instants at which the depth of a passing is looked at first.
constexpr int depth_samples = 32;
constexpr int depth_refinements = 40;

bool contains(const std::vector<ColliderIndex>& sorted, ColliderIndex collider) {
  return std::binary_search(sorted.begin(), sorted.end(), collider);
}

std::vector<Vec2d> positions_of(const TraceStep& step) {
  std::vector<Vec2d> path;
  for (const PathPoint<double>& corner : step.path) {
    if (path.empty() || path.back() != corner.position) path.push_back(corner.position);
  }
  return path;
}

double length_of(const std::vector<Vec2d>& path) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) length += (path[i + 1] - path[i]).norm();
  return length;
}

bool is_one_way(const ExactScenery& scenery, ColliderIndex collider) {
  return scenery.scenery().colliders[collider].one_way.has_value();
}

void add_contact(const ExactImpact& impact, double fraction, StepJudgement& judgement) {
  const Side side = side_of_normal(impact.normal.x(), impact.normal.y());
  for (ExactContact& known : judgement.contacts) {
    if (known.collider != impact.collider || known.side != side) continue;
    known.fraction = std::min(known.fraction, fraction);
    return;
  }
  judgement.contacts.push_back(
      {.collider = impact.collider, .side = side, .normal = impact.normal, .fraction = fraction});
}

}  // namespace

Judge::Judge(const TraceHeader& header) : header_(header), scenery_(header.scenery, header.points) {
  slop_ = std::min(header.path_exact ? slop_of_exact_path : slop_of_sampled_path,
                   slop_of_width * detail::narrowest_width(header.points));
}

StepJudgement Judge::judge(const TraceStep& step) {
  if (repeats(step)) return last_->second;
  StepJudgement judgement;
  const Path path = positions_of(step);
  if (path.empty()) return judgement;
  begin_episodes(step, path.front());
  const bool starts_free = inside_.empty();
  Box2<double> reach{path[0], path[0]};
  for (const Vec2d& corner : path) {
    reach = reach.merged({corner, corner});
    const Vec2d wanted = corner + step.requested;
    reach = reach.merged({wanted, wanted});
  }
  const bool alone = inside_.empty() && step.contacts.empty() && scenery_.near(reach.lower, reach.upper, skin).empty();
  if (!alone) {
    judgement.end_overlap = scenery_.overlapped(path.back());
    judge_way(path, judgement);
    judge_contacts(step, starts_free, judgement);
  }
  const double speed = length_of(path) / header_.dt;
  for (Passing& passing : judgement.passings) passing.speed = speed;
  last_end_ = path.back();
  last_.reset();
  if (path.size() == 1 && inside_.empty()) last_.emplace(step, judgement);
  return judgement;
}

bool Judge::repeats(const TraceStep& step) const {
  if (!last_ || step.respawn) return false;
  const TraceStep& last = last_->first;
  const auto same_corner = [](const PathPoint<double>& a, const PathPoint<double>& b) {
    return a.position == b.position && a.fraction == b.fraction;
  };
  const auto same_contact = [](const Contact<double>& a, const Contact<double>& b) {
    return a.collider == b.collider && a.normal == b.normal;
  };
  return step.requested == last.requested && step.velocity == last.velocity &&
         std::equal(step.path.begin(), step.path.end(), last.path.begin(), last.path.end(), same_corner) &&
         std::equal(step.contacts.begin(), step.contacts.end(), last.contacts.begin(), last.contacts.end(),
                    same_contact);
}

void Judge::begin_episodes(const TraceStep& step, const Vec2d& start) {
  if (!step.respawn && last_end_ && *last_end_ == start) return;
  inside_.clear();
  for (const ColliderIndex collider : scenery_.overlapped(start)) {
    inside_[collider] = {std::nullopt, scenery_.penetration(start, collider)};
  }
}

void Judge::judge_way(const Path& path, StepJudgement& judgement) {
  std::map<ColliderIndex, Vec2d> touched;  // with the corner where the first leg that meets it begins
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    for (const ColliderIndex collider : scenery_.met(path[i], path[i + 1])) touched.emplace(collider, path[i]);
  }
  for (const auto& [collider, from] : touched) {
    if (is_one_way(scenery_, collider)) judgement.one_way_broken.push_back(collider);
  }
  for (const ColliderIndex collider : judgement.end_overlap) {
    const double depth = scenery_.penetration(path.back(), collider);
    judgement.max_penetration = std::max(judgement.max_penetration, depth);
    const auto entered = touched.find(collider);
    Episode& episode =
        inside_.try_emplace(collider, Episode{entered != touched.end() ? entered->second : path[0], 0}).first->second;
    episode.depth = std::max(episode.depth, depth);
    touched.erase(collider);
  }
  for (auto it = inside_.begin(); it != inside_.end();) {
    const ColliderIndex collider = it->first;
    if (contains(judgement.end_overlap, collider)) {
      ++it;
      continue;
    }
    const std::optional<Vec2d>& from = it->second.free_from;
    if (from && scenery_.meets(*from, path.back(), collider)) judge_passing(path, collider, it->second, judgement);
    touched.erase(collider);
    it = inside_.erase(it);
  }
  for (const auto& [collider, from] : touched) {
    if (!is_one_way(scenery_, collider)) judge_passing(path, collider, {path[0], 0}, judgement);
  }
}

void Judge::judge_passing(const Path& path, ColliderIndex collider, const Episode& episode,
                          StepJudgement& judgement) const {
  const double depth = std::max(episode.depth, depth_of(path, collider));
  if (depth <= slop_) {
    judgement.corner_cut.push_back(collider);
    return;
  }
  judgement.tunnelled.push_back(collider);
  Vec2d from = *episode.free_from;
  Vec2d to = path.back();
  for (std::size_t i = 0; i + 1 < path.size() && *episode.free_from == path[0]; ++i) {
    if (!scenery_.meets(path[i], path[i + 1], collider)) continue;
    from = path[i];
    to = path[i + 1];
    break;
  }
  judgement.passings.push_back(detail::describe_passing(scenery_, from, to, collider));
}

/// The largest depth on the way: between entry and exit of every leg at equal distances, then closing in on the deepest
/// (the depth in one convex part has a single peak along a leg).
double Judge::depth_of(const Path& path, ColliderIndex collider) const {
  double deepest = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vec2d& from = path[i];
    const Vec2d way = path[i + 1] - from;
    const auto in = scenery_.time_of_impact(from, way, collider);
    const auto out = scenery_.time_of_impact(path[i + 1], -way, collider);
    const double first = in ? static_cast<double>(in->fraction) : 0;
    const double last = out ? 1 - static_cast<double>(out->fraction) : 1;
    if (!in && !out) continue;
    const auto depth_at = [&](double t) { return scenery_.penetration(from + t * way, collider); };
    const double apart = (last - first) / depth_samples;
    double best = first;
    double depth = depth_at(first);
    const auto look = [&](double t) {
      const double here = depth_at(t);
      if (here > depth) {
        depth = here;
        best = t;
      }
    };
    for (int k = 1; k <= depth_samples; ++k) look(first + k * apart);
    double reach = apart;
    for (int k = 0; k < depth_refinements; ++k, reach /= 2) {
      look(std::max(first, best - reach / 2));
      look(std::min(last, best + reach / 2));
    }
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

void Judge::add_contacts_at(const std::vector<ExactImpact>& impacts, double fraction, const TraceStep& step,
                            StepJudgement& judgement) const {
  for (const ExactImpact& impact : impacts) {
    const double way = static_cast<double>(impact.fraction) * std::abs(step.requested.dot(impact.normal));
    if (way > contact_reach) continue;
    if (impact.exposed) {
      add_contact(impact, fraction, judgement);
    } else {
      judgement.dont_care.push_back(impact.collider);
    }
  }
}

void Judge::add_first_impacts(const std::vector<ExactImpact>& impacts, const TraceStep& step, bool starts_free,
                              StepJudgement& judgement) const {
  const auto first = std::min_element(impacts.begin(), impacts.end(), [](const ExactImpact& a, const ExactImpact& b) {
    return a.fraction < b.fraction;
  });
  if (first == impacts.end()) return;
  for (const ExactImpact& impact : impacts) {
    if (impact.fraction != first->fraction || !impact.exposed) continue;
    add_contact(impact, static_cast<double>(impact.fraction), judgement);
  }
  if (!starts_free) return;
  const double fraction = static_cast<double>(first->fraction);
  const double approach = std::abs(step.requested.dot(first->normal));
  judgement.first_impact = fraction;
  judgement.first_impact_comparable = fraction * approach > (header_.path_exact ? contact_reach : skin) &&
                                      approach >= least_approach * step.requested.norm();
}

void Judge::judge_contacts(const TraceStep& step, bool starts_free, StepJudgement& judgement) const {
  for (std::size_t i = 0; i < step.path.size(); ++i) {
    const Vec2d& position = step.path[i].position;
    const bool end = i == 0 || i + 1 == step.path.size();
    if (!header_.path_exact && !end) continue;
    if (i > 0 && position == step.path[i - 1].position) continue;
    const std::vector<ExactImpact> impacts = scenery_.impacts(position, step.requested);
    if (i == 0) add_first_impacts(impacts, step, starts_free, judgement);
    add_contacts_at(impacts, step.path[i].fraction, step, judgement);
  }
  for (const Contact<double>& contact : step.contacts) {
    double gap = std::numeric_limits<double>::infinity();
    for (const Vec2d& corner : positions_of(step)) gap = std::min(gap, scenery_.separation(corner, contact.collider));
    judgement.max_contact_gap = std::max(judgement.max_contact_gap, gap);
  }
  judge_skin(step, judgement);
  judgement.ghost_speed_loss = ghost_speed_loss(step, starts_free);
}

double Judge::ghost_speed_loss(const TraceStep& step, bool starts_free) const {
  const double wanted = step.requested.x() / header_.dt;
  if (wanted == 0) return 0;
  const double loss = std::clamp(1 - step.velocity.x() / wanted, 0.0, 1.0);
  if (loss < least_loss || !starts_free) return 0;
  const double beyond = std::copysign(header_.path_exact ? contact_reach : skin, wanted);
  for (const PathPoint<double>& corner : step.path) {
    for (const ExactImpact& impact : scenery_.impacts(corner.position, step.requested + Vec2d(beyond, 0))) {
      if (impact.exposed && impact.normal.x() * wanted < 0) return 0;
    }
  }
  if (!header_.path_exact && pushed_by_skin(step, wanted)) return 0;
  return loss;
}

/// Box2D pushes out of what is within its skin: whether a reported contact against the motion has a real face there.
bool Judge::pushed_by_skin(const TraceStep& step, double wanted) const {
  return std::any_of(step.contacts.begin(), step.contacts.end(), [&](const Contact<double>& contact) {
    return contact.normal.x() * wanted < 0 && has_face(step, contact);
  });
}

/// Whether a face of the solids taken together is there to be touched along the reported normal.
bool Judge::has_face(const TraceStep& step, const Contact<double>& contact) const {
  const double reach = header_.path_exact ? 2 * contact_reach : skin;
  for (const PathPoint<double>& corner : step.path) {
    for (const ExactImpact& impact : scenery_.impacts(corner.position, -contact.normal * reach)) {
      if (impact.exposed && impact.normal.dot(contact.normal) > same_face) return true;
    }
  }
  return false;
}

void Judge::add_ghosts(const TraceStep& step, StepJudgement& judgement) const {
  for (const Contact<double>& contact : step.contacts) {
    if (!contains(judgement.dont_care, contact.collider) || has_face(step, contact)) continue;
    judgement.ghosts.emplace_back(contact.collider, contact.side);
  }
}

/// Whether what an exact contact leaves of the requested motion leads into a collider that is touched: which part that
/// is belongs to the contender's law of response, not to geometry. (In a corner of a wall and a slope, pushing down
/// along the slope: it runs along the slope and into the wall; what is left of it falls onto the slope.)
bool Judge::met_after_another(const TraceStep& step, const Contact<double>& contact,
                              const StepJudgement& judgement) const {
  const Vec2d& d = step.requested;
  const bool deflected =
      std::any_of(judgement.contacts.begin(), judgement.contacts.end(), [&](const ExactContact& one) {
        const Vec2d along = d - one.normal * d.dot(one.normal);
        return std::min({contact.normal.dot(along), contact.normal.x() * d.x(), contact.normal.y() * d.y()}) < 0;
      });
  return deflected && std::any_of(step.path.begin(), step.path.end(), [&](const PathPoint<double>& corner) {
           return scenery_.separation(corner.position, contact.collider) <= contact_reach;
         });
}

void Judge::judge_skin(const TraceStep& step, StepJudgement& judgement) const {
  const Vec2d& start = step.path.front().position;
  const Vec2d& end = step.path.back().position;
  const auto exact = [&](ColliderIndex collider) {
    return std::any_of(judgement.contacts.begin(), judgement.contacts.end(),
                       [&](const ExactContact& contact) { return contact.collider == collider; });
  };
  if (!header_.path_exact) {
    for (const ColliderIndex collider : scenery_.near(start, end, skin)) {
      const double gap = std::min(scenery_.separation(start, collider), scenery_.separation(end, collider));
      if (gap <= skin) judgement.dont_care.push_back(collider);
    }
  }
  for (const Contact<double>& contact : step.contacts) {
    if (!header_.path_exact) break;
    if (exact(contact.collider) || contact.normal.dot(step.requested) >= 0) continue;
    for (const PathPoint<double>& corner : step.path) {
      const double gap = scenery_.separation(corner.position + step.requested, contact.collider);
      if (gap >= 0 && gap <= hit_reach) judgement.dont_care.push_back(contact.collider);
    }
  }
  for (const Contact<double>& contact : step.contacts)
    if (header_.path_exact && !exact(contact.collider) && met_after_another(step, contact, judgement))
      judgement.dont_care.push_back(contact.collider);
  std::sort(judgement.dont_care.begin(), judgement.dont_care.end());
  judgement.dont_care.erase(std::unique(judgement.dont_care.begin(), judgement.dont_care.end()),
                            judgement.dont_care.end());
  std::erase_if(judgement.dont_care, exact);
  add_ghosts(step, judgement);
}

}  // namespace paperproof::compare
