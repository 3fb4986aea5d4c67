/// The impacts of all pairs of characters, in order of time.
#pragma once

#include "crowd/time_of_impact.hpp"

#include <paperproof/crowd.hpp>

#include <tuple>

namespace paperproof::crowd {

struct PairImpact {
  CharacterIndex first = 0;
  CharacterIndex second = 0;  ///< The higher index.
  Impact impact;
};

/// Of each character, the earliest impact with one of a higher index.
///
/// `impact_of(i, j)` gives the impact of two characters, i < j, on the paths that they follow now.
class ImpactQueue {
 public:
  /// @param rows one for each character; must outlive the queue.
  explicit ImpactQueue(std::span<PairImpact> rows) noexcept : rows_(rows) {}

  template <class ImpactOf>
  void find_all(const ImpactOf& impact_of) noexcept {
    for (CharacterIndex i = 0; i < rows_.size(); ++i) find_row(i, impact_of);
  }

  /// Call it when one character has a new path.
  template <class ImpactOf>
  void update(CharacterIndex changed, const ImpactOf& impact_of) noexcept {
    find_row(changed, impact_of);
    for (CharacterIndex i = 0; i < changed; ++i) {
      if (rows_[i].impact.happens && rows_[i].second == changed)
        find_row(i, impact_of);
      else
        consider(i, changed, impact_of);
    }
  }

  /// Of equal times the one with the lowest first index, then the lowest second index. Null where there is none.
  [[nodiscard]] const PairImpact* earliest() const noexcept {
    const PairImpact* earliest = nullptr;
    for (const PairImpact& row : rows_)
      if (row.impact.happens && (earliest == nullptr || row.impact.stop < earliest->impact.stop)) earliest = &row;
    return earliest;
  }

 private:
  template <class ImpactOf>
  void find_row(CharacterIndex i, const ImpactOf& impact_of) noexcept {
    rows_[i] = {};
    for (CharacterIndex j = i + 1; j < rows_.size(); ++j) consider(i, j, impact_of);
  }
  template <class ImpactOf>
  void consider(CharacterIndex i, CharacterIndex j, const ImpactOf& impact_of) noexcept {
    const Impact found = impact_of(i, j);
    PairImpact& row = rows_[i];
    if (found.happens && (!row.impact.happens || std::tie(found.stop, j) < std::tie(row.impact.stop, row.second)))
      row = {i, j, found};
  }

  std::span<PairImpact> rows_;
};

}  // namespace paperproof::crowd
