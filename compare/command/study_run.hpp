/// Runs the cases of a study: on many cores, on many machines, and resumed after a kill.
#pragma once

#include "records/output_file.hpp"
#include "records/rows_file.hpp"
#include "report/chart_page.hpp"
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
  std::optional<int> limit_s;        ///< Of one case; absent: see `StudyCases`. A search of lowest speeds is one.
  std::optional<std::string> shard;  ///< `K/N`; absent: all.
  bool resume = false;
  bool quiet = false;
};

/// Why contenders failed.
class Failures {
 public:
  void add(const Row& row);
  /// A line for each that did: how often, and the first reason.
  [[nodiscard]] std::string text() const;

 private:
  struct First {
    int rows = 0;
    std::string reason;
  };
  std::vector<std::pair<std::string, First>> all_;  ///< By contender.
};

/// What a study found that measures in this process.
struct Measurements {
  std::vector<Row> rows;
  ChartPage page;
  std::string text;
};
/// Opens the outputs, measures, writes, and prints the text unless it is to be quiet.
/// @param measure is given what it is to tell the share to that is done.
/// @return the exit status: 0, or 1 if a row failed.
/// @throws InputError where two outputs are one file; what RowsFile and OutputFile throw.
int measure_here(const RunArguments& arguments, const std::string& name,
                 const std::function<Measurements(const std::function<void(double)>& tell)>& measure);

/// All the cases of a study, each in a child process; rows in `.jsonl` appear as they come.
class StudyRun {
 public:
  using Visit = std::function<void(std::size_t index, const Row& row)>;
  /// @param arguments is to live as long as this.
  /// @param visit is called for every row in order, those included that `--resume` finds in the file.
  /// @throws InputError before any output is touched; std::runtime_error if one cannot be written.
  StudyRun(const RunArguments& arguments, StudyCases cases, Visit visit);

  void run();
  /// To be called once, last: ends the rows, writes the page, prints the text unless it is to be quiet.
  /// @param page is asked for only where it is written. @param fails as the study sees it.
  /// @return the exit status: 0, or 1 if it fails, or octagon_sweep in double broke its guarantee, or a case failed.
  int finish(const std::function<ChartPage()>& page, const std::string& text, bool fails = false);

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
  void note(const Row& row);

  const RunArguments& arguments_;
  StudyCases cases_;
  Visit visit_;
  Shard shard_;
  std::size_t count_;  ///< Cases of this shard.
  std::size_t done_ = 0;
  bool trouble_ = false;
  Failures failures_;
  nlohmann::ordered_json header_;
  std::optional<RowsFile> rows_;
  std::optional<OutputFile> page_;
};

}  // namespace paperproof::compare
