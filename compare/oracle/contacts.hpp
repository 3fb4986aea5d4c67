/// What a step should have reported as contacts, and what it lost to nothing.
#pragma once

#include "contains.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/judge.hpp"

#include <map>
#include <optional>

namespace paperproof::compare::detail {

/// A contact is this near along its normal [m]: twice what the controller stops at.
inline constexpr double contact_reach = 1e-6;
/// §6 of the guarantee lets a contact be held up to this gap [m].
inline constexpr double guaranteed_touch = 7e-7;
/// Room for the rounding of a separation [m].
inline constexpr double touch_rounding = 1e-8;
/// See `Judge`: sine of the flattest approach whose fraction is compared.
inline constexpr double least_approach = 1e-3;

/// Of the character as it stands. What rounding leaves of a component that is zero is none.
[[nodiscard]] Side side_along(const Vec2d& normal, const Vec2d& up);

/// Whether a reported contact is among `StepJudgement::ghosts`.
[[nodiscard]] inline bool is_ghost(const StepJudgement& judgement, const Contact& reported) {
  return contains(judgement.ghosts, std::pair(reported.collider, reported.side));
}

/// Whether exact arithmetic has this contact, too: with the same collider, on the same side.
[[nodiscard]] bool is_exact(const StepJudgement& judgement, const Contact& reported);

/// Judges the contacts of one step: see `Judge` for what each answer means. Lives for one step.
class ContactJudge {
 public:
  /// @param grown_scenery the same for an octagon that is larger by `least_clearance`; null for a contender that
  /// promises nothing.
  ContactJudge(const TraceHeader& header, const ExactScenery& scenery, const ExactScenery* grown_scenery,
               const TraceStep& step);
  void judge(bool starts_free, StepJudgement& judgement) const;
  /// How much of the wanted horizontal motion was lost to nothing; `judge` asks it, too.
  void measure_motion(bool starts_free, StepJudgement& judgement) const;

 private:
  [[nodiscard]] Place place(std::size_t corner) const { return {step_.path[corner], step_.movers}; }
  /// The requested displacement relative to what a collider goes along with [m].
  [[nodiscard]] Vec2d wanted(ColliderIndex collider) const;
  [[nodiscard]] double rounding_across() const;
  [[nodiscard]] double across(const Vec2d& v) const { return v.dot(right_); }
  [[nodiscard]] Side side_of(const ExactImpact& impact) const;
  [[nodiscard]] bool reports(const ExactImpact& impact) const;
  [[nodiscard]] std::size_t first_corner() const;
  [[nodiscard]] std::vector<ExactImpact> impacts_from(std::size_t corner) const;
  [[nodiscard]] std::vector<Vec2d> left_by(ColliderIndex collider, const Vec2d& n) const;
  [[nodiscard]] bool all_enter(const ExactImpact& contact, const Place& from, std::span<const Vec2d> ways,
                               const ExactScenery& scenery) const;
  [[nodiscard]] bool comes_to(const ExactImpact& contact, std::size_t corner, std::span<const ExactImpact> impacts,
                              const ExactScenery& scenery) const;
  [[nodiscard]] bool comes_to_when_grown(const ExactImpact& contact, std::size_t corner) const;
  void add_contacts_at(std::size_t corner, std::span<const ExactImpact> impacts, std::span<const ColliderIndex> met,
                       StepJudgement& judgement) const;
  void add_first_impacts(const std::vector<ExactImpact>& impacts, bool starts_free, StepJudgement& judgement) const;
  void add_gaps(StepJudgement& judgement) const;
  void add_dont_care(StepJudgement& judgement) const;
  void add_ghosts(StepJudgement& judgement) const;
  [[nodiscard]] double ghost_speed_loss(bool starts_free, const StepJudgement& judgement) const;
  [[nodiscard]] bool is_opposed(double wanted, const StepJudgement& judgement) const;
  void add_normal_error(StepJudgement& judgement) const;
  [[nodiscard]] bool pushed_by_skin(double wanted) const;
  [[nodiscard]] std::optional<Vec2d> find_face(const Contact& contact) const;
  /// The same, found once. @param contact one of the step's.
  [[nodiscard]] std::optional<Vec2d> face_of(const Contact& contact) const;
  [[nodiscard]] bool has_face(const Contact& contact) const { return face_of(contact).has_value(); }
  [[nodiscard]] bool climbs_to(std::size_t corner) const;
  [[nodiscard]] bool ran_into(const Contact& contact) const;
  [[nodiscard]] std::vector<ExactContact> contacts_besides(const Contact& contact,
                                                           const StepJudgement& judgement) const;
  [[nodiscard]] bool met_after_another(const Contact& contact, std::span<const ExactContact> others) const;
  [[nodiscard]] bool is_led_into_by_rounding(const Contact& contact, std::span<const ExactContact> others) const;
  [[nodiscard]] bool comes_near(const Contact& contact) const;
  [[nodiscard]] bool dropped_through(ColliderIndex collider) const;
  [[nodiscard]] bool gives_way() const;
  [[nodiscard]] bool is_closed_before(const ExactImpact& first) const;
  [[nodiscard]] double nearest(ColliderIndex collider) const;

  const TraceHeader& header_;
  const ExactScenery& scenery_;
  const ExactScenery* grown_scenery_;
  const TraceStep& step_;
  Vec2d up_;       ///< Of the character in this step,
  Vec2d right_;    ///< and across it.
  bool promises_;  ///< See `Party::promising`.
  double touch_;   ///< Up to this gap the contender may hold a contact that it has [m].
  double hit_;     ///< Below this gap at the end of the motion it may call it a contact already [m].
  mutable std::map<const Contact*, std::optional<Vec2d>> faces_{};  ///< See `face_of`.
};

}  // namespace paperproof::compare::detail
