/// The families of random runs: what each draws, and how much of what must happen in its runs (families.json).
#pragma once

#include "campaign/happening.hpp"
#include "campaign/random_run.hpp"

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// How large a share of a family's records a happening has, at least and at most. Few records scatter: a test fails
/// below half of the least share, and where a happening never is.
struct Coverage {
  std::string happening;  ///< By its name.
  double least = 0;
  double most = 1;
};

struct Family {
  std::string kind;    ///< `movers`: runs that are drawn alike.
  std::string name{};  ///< `tiles`: the scenery, or what moves in it.
  std::function<RandomRun(std::uint64_t)> draw{};
  std::uint64_t first_seed = 1;  ///< The runs have this seed and those that follow; no other family of the kind does.
  double share = 1;              ///< Of the steps that are asked for: some are slow.
  std::vector<Coverage> covers{};

  /// As the command takes it: `movers/tiles`.
  [[nodiscard]] std::string title() const { return kind + "/" + name; }
  /// Of one run: `movers_tiles_2000003`.
  [[nodiscard]] std::string name_of_run(std::uint64_t seed) const {
    return kind + "_" + name + "_" + std::to_string(seed);
  }
  /// The command that repeats one run.
  [[nodiscard]] std::string replay_of(std::uint64_t seed) const {
    return "paperproof replay " + title() + " " + std::to_string(seed);
  }
  friend std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.title(); }
};

/// All of them, kind after kind.
[[nodiscard]] const std::vector<Family>& families();

/// Those of a title, of a kind, or all where nothing is asked for.
/// @throws InputError naming those that are near where there is none.
[[nodiscard]] std::vector<const Family*> families_named(std::string_view title);

}  // namespace paperproof::compare
