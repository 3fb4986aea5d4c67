#include "runs/row_views.hpp"

#include "contains.hpp"
#include "metrics/agreement.hpp"
#include "runs/view.hpp"
#include "words.hpp"

#include <paperproof/box2d/reference_world.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace paperproof::compare {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

std::vector<std::string> those(const std::vector<Row>& rows, const std::function<bool(const Row&)>& which) {
  std::vector<std::string> names;
  for (const Row& row : rows)
    if (which(row)) names.push_back(called(row));
  return names;
}

/// A horizontal speed loss in one step beyond which a run counts as snagged: Box2D's users call 1 % a ghost collision.
constexpr double snagged = 0.01;
/// Runs that are nearer to each other than this [m] are not held apart by Box2D's skin, whatever it rounds.
constexpr double nearer_than_skin = 0.99 * box2d::rest_gap;

std::string plural(const std::vector<std::string>& names, const char* one, const char* many) {
  return names.size() == 1 ? one : many;
}

/// What may not be passed.
const char* solid_in(const std::vector<Row>& rows) {
  const bool several = std::ranges::any_of(rows, [](const Row& row) { return row.characters.has_value(); });
  return several ? "a solid or another character" : "a solid";
}

/// What a row's first tunnel was, in words.
std::string passage(const Row& row) {
  return row.first_tunnel ? row.first_tunnel->words
                          : fmt::format("passes a solid on {}", counted(*row.tunnels, "step"));
}

std::string about_tunnels(const std::vector<Row>& rows) {
  const auto passes = [](const Row& row) { return was_judged(row) && row.tunnels.value_or(0) > 0; };
  const auto firm = those(rows, [&](const Row& row) { return was_judged(row) && !passes(row); });
  std::vector<std::pair<std::string, std::vector<std::string>>> wrong;
  for (const Row& row : rows)
    if (passes(row)) entry_of(wrong, passage(row)).push_back(called(row));
  std::string text;
  for (const auto& [words, same] : wrong)
    text += fmt::format("{} {} wrong: {}. ", listed(same), plural(same, "is", "are"), words);
  if (firm.empty()) return text;
  if (text.empty()) return fmt::format("Nobody passes {}. ", solid_in(rows));
  return text + fmt::format("{} {} not pass. ", listed(firm), plural(firm, "does", "do"));
}

std::string about_overlap(const std::vector<Row>& rows) {
  const auto ends_inside = [](const Row& row) { return row.steps_ending_inside.value_or(0) > 0; };
  const auto inside = those(rows, ends_inside);
  if (inside.empty()) return "";
  double deepest = 0;
  for (const Row& row : rows)
    if (ends_inside(row)) deepest = std::max(deepest, row.max_penetration_m.value_or(0));
  const auto crushed = [](const Row& row) { return row.steps_inside_after_crush.value_or(0) > 0; };
  const auto outside =
      those(rows, [&](const Row& row) { return was_judged(row) && !ends_inside(row) && !crushed(row); });
  const auto pressed =
      those(rows, [&](const Row& row) { return was_judged(row) && !ends_inside(row) && crushed(row); });
  std::string text = fmt::format("{} {} some steps inside {}, up to {:.2g} m deep", listed(inside),
                                 plural(inside, "ends", "end"), solid_in(rows), deepest);
  if (!pressed.empty())
    text += fmt::format("; {} only where movers that press {} leave no room", listed(pressed),
                        plural(pressed, "it", "them"));
  if (!outside.empty()) text += fmt::format("; {} never {}", listed(outside), plural(outside, "does", "do"));
  return text + ". ";
}

std::string about_snags(const std::vector<Row>& rows) {
  const auto snags = those(rows, [](const Row& row) { return row.ghost_speed_loss.value_or(0) > snagged; });
  if (snags.empty()) return "";
  return fmt::format("{} {} where exact arithmetic has nothing in the way (ghost collision). ", listed(snags),
                     plural(snags, "snags", "snag"));
}

std::string about_agreement(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    if (!is_guaranteed(row.contender, row.scalar)) continue;
    if (!row.max_position_difference_box2d_m) return "";
    std::string text;
    const double apart = *row.max_position_difference_box2d_m;
    if (apart <= beyond_box2d_skin)
      text = fmt::format("octagon_sweep and Box2D agree to {:.3g} m, which is {}Box2D's skin. ", apart,
                         apart < nearer_than_skin ? "less than " : "");
    else
      text = fmt::format("octagon_sweep and Box2D come {:.3g} m apart. ", apart);
    if (!row.first_difference_box2d.empty()) text += "They first differ on " + row.first_difference_box2d + ". ";
    return text;
  }
  return "";
}

/// A reason without the name of the contender that it may begin with: what several have in common.
std::string shared_reason(const Row& row) {
  const std::string name = row.contender + " ";
  return row.reason.starts_with(name) ? "each " + row.reason.substr(name.size()) : row.reason;
}

std::string about_limits(const std::vector<Row>& rows) {
  const auto limited = [](const Row& row) {
    const bool told =
        row.steps_ending_inside.value_or(0) > 0 &&  // by about_overlap
        std::ranges::all_of(row.faults, [](const AxisFault& fault) { return fault.axis == Axis::safety; });
    return (row.verdict == Verdict::flagged && !told) || !was_judged(row);
  };
  std::vector<std::string> told;
  std::string text;
  for (const Row& row : rows) {
    if (!limited(row) || contains(told, shared_reason(row))) continue;
    told.push_back(shared_reason(row));
    const auto same =
        those(rows, [&](const Row& other) { return limited(other) && shared_reason(other) == shared_reason(row); });
    text += fmt::format("{}: {}. ", listed(same), same.size() == 1 ? row.reason : shared_reason(row));
  }
  return text;
}

}  // namespace

std::string who_is_right(const std::vector<Row>& rows) {
  std::string text = about_tunnels(rows) + about_overlap(rows) + about_snags(rows) + about_agreement(rows);
  text += about_limits(rows);
  if (!text.empty()) text.pop_back();
  return text;
}

}  // namespace paperproof::compare
