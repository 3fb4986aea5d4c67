/// The gallery: for each contender where it fails, and where it is the cheapest of those that do not.
#pragma once

#include "records/row.hpp"

#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// What went wrong in a run. The worst thing is named; a later kind is milder than an earlier one.
struct Failure {
  enum class Kind : std::uint8_t {
    failed,       ///< It broke off, or broke a guarantee.
    tunnels,      ///< It passed a solid.
    inside,       ///< It ended steps inside a solid.
    one_way,      ///< It passed a one-way chain against its normal.
    hangs,        ///< It could have fallen, and did not.
    flagged,      ///< It met a limit of its own.
    missed,       ///< It did not report contacts that exact arithmetic has: more than one in ten.
    snag,         ///< It lost more than 1 % of its speed in one step to nothing.
    false_alarm,  ///< More than one in ten of its contacts are none.
    jitter,       ///< At rest it moves by more than 1 mm.
    gap,          ///< It stops more than 20 mm away from what it hits.
  };
  Kind kind = Kind::failed;
  std::string words;
};

/// Nothing where the run did all that is asked of it, or where the contender cannot express the scene.
[[nodiscard]] std::optional<Failure> failure_of(const Row& row);

struct GalleryEntry {
  std::string contender;  ///< With its number type where that is not double.
  int scenes = 0;         ///< That it could express.
  struct Fails {
    std::string scene;
    Failure failure;
  };
  std::optional<Fails> fails;  ///< The worst, the first of equals; none: the search found none.
  struct Cheapest {
    std::string scene;
    double ns_per_step = 0;
    std::string next;  ///< The next cheapest that does not fail; empty where there is none.
    double next_ns_per_step = 0;
  };
  std::optional<Cheapest> cheapest;  ///< Where its lead is largest; none: another one is cheaper everywhere.
};

/// @param rows of several scenes. In the order in which the contenders first appear.
[[nodiscard]] std::vector<GalleryEntry> gallery_of(const std::vector<Row>& rows);

/// One paragraph for each contender, without a heading, and one more where nothing was timed.
[[nodiscard]] std::vector<std::string> gallery_lines(const std::vector<GalleryEntry>& gallery);

}  // namespace paperproof::compare
