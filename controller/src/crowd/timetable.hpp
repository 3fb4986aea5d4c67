/// The meetings of all pairs, in order.
#pragma once

#include "crowd/meeting.hpp"

#include <paperproof/crowd.hpp>

#include <optional>
#include <span>

namespace paperproof::crowd {

/// The earliest meeting of a character with one of a higher index.
template <class Scalar>
struct RowBest {
  Meeting<Scalar> meeting;
  CharacterIndex other = 0;
};

/// Who meet next.
template <class Scalar>
struct NextMeeting {
  std::size_t first = 0;
  std::size_t second = 0;  ///< The higher index.
  Meeting<Scalar> meeting;
};

/// For each character, its earliest meeting with a character of a higher index. Does not own its rows.
///
/// `meeting(i, j)` answers when two meet, i < j, as their ways are now.
template <class Scalar>
class Timetable {
 public:
  /// @param rows one for each character.
  explicit Timetable(std::span<RowBest<Scalar>> rows) noexcept : rows_(rows) {}

  template <class MeetingOf>
  void find_all(const MeetingOf& meeting) noexcept {
    for (std::size_t i = 0; i < rows_.size(); ++i) find_row(i, meeting);
  }

  /// One character has a new way: its own row, and what other rows know about it.
  template <class MeetingOf>
  void find_again(std::size_t changed, const MeetingOf& meeting) noexcept {
    find_row(changed, meeting);
    for (std::size_t i = 0; i < changed; ++i) {
      RowBest<Scalar>& best = rows_[i];
      if (best.meeting.meets && best.other == changed) {
        find_row(i, meeting);
        continue;
      }
      const Meeting<Scalar> found = meeting(i, changed);
      if (!found.meets) continue;
      const bool earlier = !best.meeting.meets || found.time < best.meeting.time ||
                           (found.time == best.meeting.time && changed < best.other);
      if (earlier) best = {found, static_cast<CharacterIndex>(changed)};
    }
  }

  /// Of equal times the lowest first index; none where nobody meets.
  [[nodiscard]] std::optional<NextMeeting<Scalar>> earliest() const noexcept {
    std::size_t earliest = rows_.size();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!rows_[i].meeting.meets) continue;
      if (earliest == rows_.size() || rows_[i].meeting.time < rows_[earliest].meeting.time) earliest = i;
    }
    if (earliest == rows_.size()) return std::nullopt;
    return NextMeeting<Scalar>{earliest, rows_[earliest].other, rows_[earliest].meeting};
  }

 private:
  template <class MeetingOf>
  void find_row(std::size_t i, const MeetingOf& meeting) noexcept {
    RowBest<Scalar>& best = rows_[i];
    best = {};
    for (std::size_t j = i + 1; j < rows_.size(); ++j) {
      const Meeting<Scalar> found = meeting(i, j);
      if (found.meets && (!best.meeting.meets || found.time < best.meeting.time))
        best = {found, static_cast<CharacterIndex>(j)};
    }
  }

  std::span<RowBest<Scalar>> rows_;
};

}  // namespace paperproof::crowd
