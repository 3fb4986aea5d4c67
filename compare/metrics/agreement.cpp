#include "metrics/agreement.hpp"

#include "metrics/rest.hpp"
#include "oracle/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

namespace paperproof::compare {
namespace {

/// The sides on which every contact is with a collider that is a don't-care, and neither exact nor a ghost.
unsigned only_excused(const std::vector<Contact>& contacts, const StepJudgement& judged) {
  unsigned other = 0;
  for (const Contact& contact : contacts)
    if (detail::is_ghost(judged, contact) || detail::is_exact(judged, contact) ||
        !contains(judged.dont_care, contact.collider))
      other |= 1U << static_cast<unsigned>(contact.side);
  return sides_of(contacts) & ~other;
}

std::string named(unsigned sides) {
  std::vector<std::string_view> names;
  for (const Side side : {Side::bottom, Side::top, Side::left, Side::right})
    if ((sides >> static_cast<unsigned>(side) & 1U) != 0) names.push_back(name_of(side));
  return names.empty() ? "no contact" : fmt::format("{}", fmt::join(names, " and "));
}

}  // namespace

Agreement::Agreement(const TraceHeader& mine, const TraceHeader& reference, std::size_t most)
    : mine_name_(mine.contender), reference_name_(reference.contender), most_(most) {}

void Agreement::match(const View& view, Matches& matches) {
  unsigned mine = 0;
  unsigned reference = 0;
  unsigned excused = 0;
  for (const Moment& moment : view.around) {
    mine |= moment.mine.reported;
    reference |= moment.reference.reported;
    excused |= moment.excused;
  }
  const auto count = [&](unsigned sides, unsigned others, int& counted, int& matched) {
    matched += std::popcount(sides & others);
    counted += std::popcount(sides & (others | ~excused));
  };
  count(view.now().mine.reported, reference, matches.mine, matches.mine_matched);
  count(view.now().reference.reported, mine, matches.reference, matches.reference_matched);
}

bool Agreement::is_right(const View& view, Party Moment::*party) {
  unsigned exact = 0;
  unsigned reported = 0;
  for (const Moment& moment : view.around) {
    exact |= (moment.*party).exact;
    reported |= (moment.*party).reported;
  }
  const Party& now = view.now().*party;
  return (now.reported & ~exact & ~now.excused) == 0 && (now.exact & ~reported) == 0;
}

SideDisagreement::Right Agreement::who(const View& view) {
  using Right = SideDisagreement::Right;
  const bool mine = is_right(view, &Moment::mine);
  const bool reference = is_right(view, &Moment::reference);
  if (mine) return reference ? Right::both : Right::mine;
  return reference ? Right::reference : Right::neither;
}

/// The step before now has both its neighbours.
void Agreement::settle_last(const View& view) {
  if (!last_) return;
  const SideDisagreement::Right right = who(view);
  --counts_[static_cast<std::size_t>(last_->right)];
  judge_last(right);
  if (last_is_kept_) disagreements_.back() = *last_;
  if (!first_wrong_ && right != SideDisagreement::Right::both) first_wrong_ = last_;
}

void Agreement::add(const TraceStep& mine, const StepJudgement& mine_judged, const TraceStep& reference,
                    const StepJudgement& reference_judged) {
  Moment moment;
  moment.mine = {sides_of(mine.contacts), sides_of(mine_judged.contacts), only_excused(mine.contacts, mine_judged)};
  moment.reference = {sides_of(reference.contacts), sides_of(reference_judged.contacts),
                      only_excused(reference.contacts, reference_judged)};
  moment.excused = only_excused(mine.contacts, reference_judged) | moment.reference.excused | moment.mine.excused;
  window_.add(moment, [this](const View& view) {
    match(view, matches_);
    settle_last(view);
  });
  last_.reset();
  last_is_kept_ = false;
  ++steps_;
  note_positions(mine, mine_judged, reference, reference_judged);
  const unsigned only_mine = moment.mine.reported & ~moment.reference.reported;
  const unsigned only_reference = moment.reference.reported & ~moment.mine.reported;
  // A missing contact can be excused; another side in its place cannot.
  const bool other_sides = only_mine != 0 && only_reference != 0;
  if (((only_mine | only_reference) & ~moment.excused) == 0 && !other_sides) {
    ++same_;
    return;
  }
  last_ = {mine.step, mine, reference, {}, {}, {}};
  last_->facts = fmt::format(
      "{} reports {} where exact arithmetic has {}, {} reports {} where exact arithmetic has {}: ", mine_name_,
      named(moment.mine.reported), named(moment.mine.exact), reference_name_, named(moment.reference.reported),
      named(moment.reference.exact));
  window_.last([this](const View& view) { judge_last(who(view)); });
  if (disagreements_.size() == most_) return;
  last_is_kept_ = true;
  disagreements_.push_back(*last_);
}

void Agreement::judge_last(SideDisagreement::Right right) {
  const std::array<std::string, 4> words{mine_name_ + " is right", reference_name_ + " is right",
                                         "both are right about their own motion", "neither is right"};
  last_->right = right;
  last_->who_is_right = last_->facts + words.at(static_cast<std::size_t>(right));
  ++counts_[static_cast<std::size_t>(right)];
}

void Agreement::note_positions(const TraceStep& mine, const StepJudgement& mine_judged, const TraceStep& reference,
                               const StepJudgement& reference_judged) {
  if (mine.path.empty() || reference.path.empty()) return;
  const double distance = (mine.path.back().position - reference.path.back().position).norm();
  farthest_ = std::max(farthest_, distance);
  if (apart_) return;
  if (!mine_broke_ && mine_judged.broke()) mine_broke_ = mine.step;
  if (!reference_broke_ && reference_judged.broke()) reference_broke_ = reference.step;
  if (!reference_capped_ && reference.capped) reference_capped_ = reference.step;
  if (!(distance <= beyond_box2d_skin))
    apart_ = {mine.step, distance, !mine_judged.end_overlap.empty(), !reference_judged.end_overlap.empty()};
}

std::string Agreement::words_about_positions() const {
  const auto right = [](const std::string& one, const std::string& other, int step) {
    return fmt::format("{} is right, as {} passed or entered a solid on step {}", one, other, step);
  };
  const std::string fact = fmt::format("{} and {} are {:.3g} m apart: ", mine_name_, reference_name_, apart_->by);
  if (mine_broke_ && reference_broke_) return fact + "neither is right, as both passed or entered a solid";
  if (mine_broke_) return fact + right(reference_name_, mine_name_, *mine_broke_);
  if (reference_broke_) return fact + right(mine_name_, reference_name_, *reference_broke_);
  if (apart_->mine_inside != apart_->reference_inside) {
    const auto [inside, outside] =
        apart_->mine_inside ? std::pair(mine_name_, reference_name_) : std::pair(reference_name_, mine_name_);
    return fmt::format("{}{} is right, as {} is still inside a solid", fact, outside, inside);
  }
  if (reference_capped_) return fact + reference_name_ + " moves at most 2 m per step";
  return fact + "neither passed or entered a solid, they respond differently";
}

std::optional<std::pair<int, std::string>> Agreement::first_difference() const {
  const SideDisagreement* sides = disagreements_.empty() ? nullptr : &disagreements_.front();
  if (apart_ && (sides == nullptr || apart_->step < sides->step))
    return std::pair(apart_->step, words_about_positions());
  if (sides == nullptr) return std::nullopt;
  std::string text = sides->who_is_right;
  const std::optional<SideDisagreement>& wrong = first_wrong_ ? first_wrong_ : last_;
  if (sides->right != SideDisagreement::Right::both) return std::pair(sides->step, text);
  if (wrong && wrong->right != SideDisagreement::Right::both)
    text += fmt::format("; step {} is the first on which one is not: {}", wrong->step, wrong->who_is_right);
  else if (apart_)
    text += fmt::format("; from step {} on {}", apart_->step, words_about_positions());
  return std::pair(sides->step, text);
}

void Agreement::write(Row& row) const {
  if (steps_ == 0) return;
  row.contact_agreement_box2d = static_cast<double>(same_) / steps_;
  row.max_position_difference_box2d_m = farthest_;
  if (auto first = first_difference()) {
    row.first_difference_box2d_step = first->first;
    row.first_difference_box2d = fmt::format("step {}: {}", first->first, first->second);
  }
  Matches matches = matches_;
  window_.last([&](const View& view) { match(view, matches); });
  if (matches.mine > 0) row.contact_precision_box2d = static_cast<double>(matches.mine_matched) / matches.mine;
  if (matches.reference > 0)
    row.contact_recall_box2d = static_cast<double>(matches.reference_matched) / matches.reference;
}

void write_agreement(const std::vector<Agreement>& of_characters, Row& row) {
  if (of_characters.size() == 1) return of_characters.front().write(row);
  double shares = 0;
  for (std::size_t k = 0; k < of_characters.size(); ++k) {
    Row one;
    of_characters[k].write(one);
    if (!one.max_position_difference_box2d_m) return;
    shares += *one.contact_agreement_box2d;
    row.max_position_difference_box2d_m =
        std::max(row.max_position_difference_box2d_m.value_or(0), *one.max_position_difference_box2d_m);
    const std::optional<int>& step = one.first_difference_box2d_step;
    if (!step || (row.first_difference_box2d_step && *row.first_difference_box2d_step <= *step)) continue;
    row.first_difference_box2d_step = step;
    row.first_difference_box2d = fmt::format("character {}, {}", k, one.first_difference_box2d);
  }
  row.contact_agreement_box2d = shares / static_cast<double>(of_characters.size());
}

}  // namespace paperproof::compare
