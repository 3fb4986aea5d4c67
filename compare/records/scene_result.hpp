/// What the runs of one scene leave behind: rows, and steps to look at.
#pragma once

#include "records/row.hpp"
#include "records/trace.hpp"

#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// A step that a reader may want to jump to. The first contact needs none: the page finds it in the steps.
struct ReportEvent {
  enum class Kind : std::uint8_t { tunnel, clipped, inside, one_way, hanging, crush, drop, sensor, note };
  int step = 0;
  Kind kind = Kind::note;
  std::string words;  ///< One sentence: what happened, how fast, through what. May be empty.
  CharacterIndex character = 0;
  std::optional<ColliderIndex> collider{};  ///< The collider of the event.
};

/// One run, for drawing.
struct ReportRun {
  TraceHeader header;
  std::vector<TraceStep> steps;  ///< Ascending by `step`; there may be fewer than ran: see `thin_for_replay`.
  /// Characters 1, 2, ...: the same steps of theirs.
  std::vector<std::vector<TraceStep>> others{};
  std::vector<ReportEvent> events;  ///< What the judgement found.
  int every = 1;                    ///< Every how many steps one was kept, apart from those with an event.
};

/// A step on which two sides differ.
struct Disagreement {
  struct Statement {
    std::size_t run = 0;  ///< Position in `ReportScene::runs`.
    TraceStep record;     ///< It may be missing in the run's `steps`.
  };
  int step = 0;
  std::vector<Statement> statements;  ///< What each side says, usually controller and Box2D.
  std::string who_is_right;           ///< One sentence with the reason.
};

struct ReportScene {
  std::string name;
  std::string description;                  ///< What the scene measures. May be empty.
  std::string sentence;                     ///< Who is right where they differ.
  std::vector<Row> rows;                    ///< Failures included.
  std::vector<ReportRun> runs;              ///< May be fewer than rows; empty: no replay for this scene.
  std::vector<Disagreement> disagreements;  ///< In the order in which they are to be drawn.
  std::vector<double> dt_list{};  ///< Lengths of the steps [s], from the front again; empty: all of the runs' `dt`.
};

/// Drops steps until at most `max_steps` (at least 8) are left: every k-th stays, with the first, the last, those with
/// an event, the first contact and their neighbours. The beginning stays whole, so that it can be judged as a trace: a
/// quarter of what is left, or half of it, if so it comes up to the step that matters (see `cut_to_excerpt`).
void thin_for_replay(ReportRun& run, int max_steps);

/// Leaves the step that matters, and so many before and after it: the first passage of a solid, else of a one-way
/// chain, else the first that ends inside something, else the first that hangs, else the first crush, else the first
/// contact, else the first step. @param middle the step that matters, where it is known.
void cut_to_excerpt(ReportRun& run, int around, std::optional<int> middle = {});

}  // namespace paperproof::compare
