#include "metrics/jitter.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

namespace paperproof::compare {
namespace {

constexpr double least_move = 1e-12;  ///< [m]
constexpr double at_rest = 1e-6;      ///< A change of height that is none [m].
constexpr std::size_t least_positions = 8;
constexpr std::size_t most_positions = 4096;

/// What the straight line that fits best leaves.
std::vector<double> detrended(std::span<const double> values) {
  const auto count = static_cast<double>(values.size());
  const double middle = (count - 1) / 2;
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double slope = 0;
  double spread = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double place = static_cast<double>(k) - middle;
    slope += place * (values[k] - mean);
    spread += place * place;
  }
  slope /= spread;
  std::vector<double> left;
  for (std::size_t k = 0; k < values.size(); ++k)
    left.push_back(values[k] - mean - slope * (static_cast<double>(k) - middle));
  return left;
}

/// By Goertzel's recurrence.
double power_at(std::span<const double> values, std::size_t frequency) {
  const double angle = 2 * std::numbers::pi * static_cast<double>(frequency) / static_cast<double>(values.size());
  const double twice = 2 * std::cos(angle);
  double before = 0;
  double last = 0;
  for (const double value : values) before = std::exchange(last, value + twice * last - before);
  return last * last + before * before - twice * last * before;
}

}  // namespace

double sign_changes(std::span<const double> positions) {
  if (positions.size() < 3) return 0;
  int changes = 0;
  int sign = 0;
  for (std::size_t k = 1; k < positions.size(); ++k) {
    const double move = positions[k] - positions[k - 1];
    if (std::abs(move) <= least_move) continue;
    const int now = move > 0 ? 1 : -1;
    changes += sign != 0 && now != sign;
    sign = now;
  }
  return 1000.0 * changes / static_cast<double>(positions.size() - 1);
}

std::optional<double> upper_band_share(std::span<const double> positions) {
  if (positions.size() < least_positions) return std::nullopt;
  const std::vector<double> left = detrended(positions);
  const double squares = std::inner_product(left.begin(), left.end(), left.begin(), 0.0);
  if (std::sqrt(squares / static_cast<double>(left.size())) < least_move) return std::nullopt;
  double all = 0;
  double upper = 0;
  for (std::size_t frequency = 1; 2 * frequency <= left.size(); ++frequency) {
    // The transform of real numbers is symmetric: every frequency but the highest occurs twice.
    const double power = power_at(left, frequency) * (2 * frequency < left.size() ? 2 : 1);
    all += power;
    if (4 * frequency > left.size()) upper += power;
  }
  return upper / all;
}

std::optional<double> log_dimensionless_jerk(std::span<const Vec2d> positions, double dt) {
  if (positions.size() < 4) return std::nullopt;
  double fastest = 0;
  for (std::size_t k = 1; k < positions.size(); ++k)
    fastest = std::max(fastest, (positions[k] - positions[k - 1]).norm() / dt);
  double integral = 0;
  for (std::size_t k = 3; k < positions.size(); ++k) {
    const Vec2d third = positions[k] - 3 * positions[k - 1] + 3 * positions[k - 2] - positions[k - 3];
    integral += (third / (dt * dt * dt)).squaredNorm() * dt;
  }
  const double duration = static_cast<double>(positions.size() - 1) * dt;
  if (!(fastest > 0) || !(integral > 0)) return std::nullopt;
  return -std::log(duration * duration * duration / (fastest * fastest) * integral);
}

Smoothness::Smoothness(const SceneryDef& scenery) {
  for (const ColliderDef& collider : scenery.colliders)
    stands_.push_back(collider.mover == no_mover && collider.surface_speed == 0);
}

void Smoothness::add(const TraceStep& step, double dt) {
  if (step.path.empty()) return;
  if (step.respawn) {
    positions_.clear();
    last_.reset();
  }
  dt_ = dt;
  const Vec2d end = step.path.back().position;
  positions_.push_back(end);
  if (positions_.size() > most_positions) positions_.pop_front();
  const bool is_on_level_ground = std::ranges::any_of(step.contacts, [&](const Contact& contact) {
    return contact.normal == Vec2d(0, 1) && stands_[contact.collider];
  });
  if (!step.grounded || step.requested.x() == 0 || !is_on_level_ground) {
    last_.reset();
    return;
  }
  const Walk now{step.requested.x(), end.x() - step.path.front().position.x(), end.y()};
  if (last_ && last_->wanted == now.wanted) {
    hop_share_ = std::max(hop_share_.value_or(0), std::abs(now.way - last_->way) / std::abs(now.wanted));
    const double hop = std::abs(now.height - last_->height);
    if (!rested_ && hop <= at_rest) hop_ = 0;
    rested_ = rested_ || hop <= at_rest;
    hop_ = std::max(hop_.value_or(0), hop);
  }
  last_ = now;
}

void Smoothness::write(Row& row) const {
  const std::vector<Vec2d> in_order(positions_.begin(), positions_.end());
  const auto keep_the_worst = [](std::optional<double>& of_all, const std::optional<double>& mine, auto is_worse) {
    if (mine && (!of_all || is_worse(*mine, *of_all))) of_all = mine;
  };
  keep_the_worst(row.log_dimensionless_jerk, log_dimensionless_jerk(in_order, dt_), std::less<>());
  keep_the_worst(row.seam_hop_share, hop_share_, std::greater<>());
  keep_the_worst(row.seam_hop_m, hop_, std::greater<>());
}

}  // namespace paperproof::compare
