/// Runs the cases of a study: on many cores, on many machines, and resumed after a kill.
#pragma once

#include "command/page_output.hpp"
#include "command/progress.hpp"
#include "records/rows_file.hpp"
#include "report/row_pictures.hpp"
#include "studies/sweep.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// How the cases are run, and where what they give goes.
struct RunArguments {
  std::string rows_path;             ///< Empty: none.
  std::string report_path;           ///< Empty: none.
  std::string log_path;              ///< Of the progress; empty: none.
  int jobs = 0;                      ///< 0: one for each core.
  int limit_s = 60;                  ///< Of one case. A search of lowest speeds is one.
  std::optional<std::string> shard;  ///< `K/N`; absent: all.
  bool resume = false;
  bool quiet = false;
};

/// All the cases of a study, each in a child process; rows in `.jsonl` appear as they come.
class StudyRun {
 public:
  using Visit = std::function<void(const StudyPart& part, const nlohmann::ordered_json& row)>;
  /// @param arguments,parts are to live as long as this.
  /// @param visit is called for every row in order, those included that `--resume` finds in the file.
  /// @throws InputError before any output is touched; std::runtime_error if one cannot be written.
  StudyRun(const RunArguments& arguments, const std::vector<StudyPart>& parts, Visit visit);

  void run();
  /// To be called once, last: ends the rows, writes the page, prints the text unless it is to be quiet.
  /// @param page is asked for only where it is written.
  /// @return the exit status: 0, or 1 if octagon_sweep in double broke its guarantee or a case failed.
  int finish(const std::function<ChartPage()>& page, const std::string& text);

 private:
  /// Which part of the work: every `of`-th case, from the `part`-th on.
  struct Shard {
    std::size_t part = 1;
    std::size_t of = 1;
    [[nodiscard]] std::size_t size(std::size_t all) const { return all < part ? 0 : (all - part) / of + 1; }
    [[nodiscard]] std::size_t case_of(std::size_t job) const { return part - 1 + job * of; }
  };
  static Shard parse_shard(const std::optional<std::string>& typed);

  /// Takes over the rows of an earlier run. @return whether there was one.
  bool goes_on();
  /// Counts and shows the row of the next case.
  void note(const nlohmann::ordered_json& row);

  const RunArguments& arguments_;
  const std::vector<StudyPart>& parts_;
  Visit visit_;
  Shard shard_;
  std::size_t count_;  ///< Cases of this shard.
  std::size_t done_ = 0;
  bool trouble_ = false;
  nlohmann::ordered_json header_;
  std::optional<RowsFile> rows_;
  std::optional<PageOutput> page_;
};

/// Counts the verdicts of each part and contender, as tables and as heat maps. Keeps no row.
class StudyScores {
 public:
  explicit StudyScores(const std::vector<StudyPart>& parts);
  void add(const StudyPart& part, const nlohmann::ordered_json& row);
  /// A table for each title.
  [[nodiscard]] std::string tables() const;
  [[nodiscard]] std::vector<ChartGrid> grids() const;

 private:
  struct Score {
    int cases = 0;
    int holds = 0;
    int through = 0;
    int beyond = 0;  ///< Beyond the contender's own limits, and nothing else.
    int other = 0;   ///< Ends inside something, or is flagged or failed for another reason.
    int cannot = 0;
    std::string first_bad;  ///< Where the first case is that does not hold.
  };
  struct Title {
    std::string title;
    std::vector<std::string> keys;                      ///< Of the axes, in `parameters`.
    std::vector<std::pair<std::string, Score>> scores;  ///< By contender.
    std::optional<GridCounter> grids;                   ///< Where something is varied.
  };
  std::vector<Title> titles_;
};

/// A table for a terminal. A column is aligned to the right where a cell begins with a digit or a sign.
[[nodiscard]] std::string text_of(const ChartTable& table);

/// The values of such keys in a row: `speed_m_s=10 thickness_m=0.01`.
[[nodiscard]] std::string values_of(const nlohmann::ordered_json& row, const std::vector<std::string>& keys);

}  // namespace paperproof::compare
