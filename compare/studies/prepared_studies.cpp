#include "studies/prepared_studies.hpp"

#include "runs/contender.hpp"
#include "studies/bullet.hpp"
#include "studies/field.hpp"
#include "studies/stability.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace paperproof::compare {
namespace {

/// Axes for each size of the grid.
using Axes = std::array<const char*, 3>;

const NamedContender put_by_transform{"box2d", {{"movers", "transform"}}};

StudyPart part_of(const char* title, const char* scene, const char* axes,
                  std::vector<NamedContender> contenders = all_contenders_and({})) {
  StudyPart part{title, {}, {}};
  part.sweep.scene = scene;
  part.sweep.axes = parse_axes(axes);
  part.sweep.contenders = std::move(contenders);
  return part;
}

const char* at(const Axes& axes, GridSize size) { return axes[static_cast<std::size_t>(size)]; }

std::vector<StudyPart> corner_parts(GridSize size, const std::vector<std::string>&) {
  const Axes wedges{{"angle=1:60:log12",
                     "angle=1:60:log30 dt=0.004166666666666667,0.008333333333333333,0.016666666666666666,0.033",
                     "angle=1:120:log120 dt=0.001:0.1:log12"}};
  const Axes fast{{"angle=1:60:log12 velocity_iterations=1,8,50", "angle=1:60:log30 velocity_iterations=1,2,4,8,16,50",
                   "angle=1:120:log120 velocity_iterations=1,2,4,8,16,32,50,100"}};
  const Axes tips{{"angle=1:60:log5 offset=-0.1,-0.05,0,0.05,0.1", "angle=0.1:60:log16 offset=-0.15:0.15:lin21",
                   "angle=0.1:60:log40 offset=-0.15:0.15:lin101"}};
  const Axes corners{{"overlap=1e-6,1e-3,0.01,0.1 speed=5:500:log4", "overlap=1e-6:0.3:log16 speed=1:5000:log12",
                      "overlap=1e-6:0.3:log60 speed=1:5000:log40"}};
  std::vector<StudyPart> parts{
      part_of("a fall into a wedge", "wedge", at(wedges, size)),
      part_of("a wedge hit at 100 m/s, by solver iterations", "wedge", at(fast, size),
              {{"box2d"}, {"box2d", {{"position_iterations", "20"}}}}),
      part_of("a tip between two points", "spike", at(tips, size)),
      part_of("a corner that is just met", "corner", at(corners, size)),
  };
  parts[1].sweep.set = {{"speed", "100"}};
  return parts;
}

std::vector<StudyPart> seam_parts(GridSize size, const std::vector<std::string>&) {
  const Axes tiles{{"speed=0.12:12:lin50 origin=0,0.37", "speed=0.12:12:lin100 origin=0,0.37,1000.1",
                    "speed=0.1:12:lin1000 origin=0,0.1,0.37,1000.1,100000.3"}};
  return {part_of("a walk over flush tiles", "tiles", at(tiles, size))};
}

std::vector<StudyPart> squeeze_parts(GridSize size, const std::vector<std::string>&) {
  const Axes shafts{{"clearance=0,1e-6,1e-3,0.05",
                     "clearance=0,1e-12,1e-9,2e-7,1e-6,1e-5,1e-4,1e-3,0.01,0.02,0.05 dt=0.001:0.1:log7",
                     "clearance=1e-9:0.1:log60 dt=0.0001:0.1:log16"}};
  const Axes closing{{"clearance=-0.1,1e-3,0.1 closing=1,10,100",
                      "clearance=-0.1,-1e-3,1e-6,1e-3,0.02,0.1,0.5 closing=0.5:1000:log12",
                      "clearance=-0.2:0.5:lin29 closing=0.1:1e5:log40"}};
  return {part_of("a fall down a shaft", "shaft", at(shafts, size)),
          part_of("walls that close in", "closing_walls", at(closing, size), all_contenders_and({put_by_transform})),
          part_of("a lift under a ceiling", "closing_lift", at(closing, size), all_contenders_and({put_by_transform}))};
}

}  // namespace

GridSize grid_size(std::string_view name) noexcept {
  if (name == "full") return GridSize::full;
  return name == "standard" ? GridSize::standard : GridSize::quick;
}

std::vector<NamedContender> all_contenders_and(const std::vector<NamedContender>& more) {
  std::vector<NamedContender> all;
  for (const std::string_view name : contender_names()) all.push_back({std::string(name)});
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

void keep_only(const std::vector<std::string>& wanted, std::vector<StudyPart>& parts) {
  if (wanted.empty()) return;
  for (StudyPart& part : parts)
    std::erase_if(part.sweep.contenders, [&](const NamedContender& one) {
      return std::find(wanted.begin(), wanted.end(), one.name) == wanted.end();
    });
  std::erase_if(parts, [](const StudyPart& part) { return part.sweep.contenders.empty(); });
}

const std::vector<PreparedStudy>& prepared_studies() {
  static const std::vector<PreparedStudy> all{
      {.name = "bullet",
       .help = "Who gets through paper: rates, and the lowest speeds beside theory",
       .parts = bullet_parts,
       .title = "Where do bullets pass?",
       .paragraphs =
           {"A character flies onto paper. The cases of a cell differ in angle, phase and length of a step. In "
            "numbers: how many get through, with Wilson's interval of 95 %, and the lowest speed at which "
            "each gets through head-on at 60 steps per second, found by bisection over all phases, beside "
            "what theory says."},
       .theory = bullet_theory_in_words},
      {.name = "corner",
       .help = "Wedges, tips between two points, corners that are just met: who gets through or ends inside",
       .parts = corner_parts,
       .title = "study corner"},
      {.name = "seam",
       .help = "Walks over flush tiles at many speeds and offsets: who snags at their seams",
       .parts = seam_parts,
       .title = "study seam"},
      {.name = "squeeze",
       .help = "Shafts that fit, walls and lifts that close in: who gets stuck, inside or through",
       .parts = squeeze_parts,
       .title = "study squeeze"},
      {.name = "field",
       .help = "Movers of any engine in one table: bullets, seams, slopes, lifts, rest, play; the worst that each does",
       .parts = field_parts,
       .title = "The field in one table",
       .paragraphs = field_paragraphs(),
       .in_one_table = true},
      {.name = "stability",
       .help = "Stiff and extreme cases: where each side holds, and where not",
       .parts = stability_parts,
       .title = "stability",
       .paragraphs = stability_paragraphs(),
       .grid = "standard"},
  };
  return all;
}

}  // namespace paperproof::compare
