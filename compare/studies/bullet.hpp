/// The study of bullets and paper: who passes, at which speeds, and what theory says.
#pragma once

#include "studies/prepared_studies.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// All contenders, and Box2D with continuous collision off, and with a non-bullet against dynamic paper.
[[nodiscard]] std::vector<NamedContender> bullet_contenders();

/// First, without a title, one part for each contender: speed × thickness × angle × phase × length of a step. A
/// contender that promises to let nothing through, octagon_sweep, is tried at more phases: over a million cases on the
/// standard grid. Then paper that comes to a character that stands, for Box2D also put there by SetTransform; a wall
/// far from the origin; and for each contender and thickness `lowest_speed_through`.
[[nodiscard]] std::vector<StudyPart> bullet_parts(GridSize size, const std::vector<std::string>& contenders = {});

/// The lowest speed at which it passes the paper head-on, over so many phases [m/s]: `border_low` and `border_high` of
/// the row, as of `find_border`. It looks from 0.9 times the speed that goes through the paper's thickness in one step:
/// in fine strides up to 1.6 times that, then in coarse ones up to 3,000 m/s. `border_high` alone: at any speed.
/// @param paper who runs, in the family `paper`; its one parameter is the thickness.
[[nodiscard]] Row lowest_speed_through(const Case& paper, int phases);

/// What theory says about that speed, for the article's character (feet, arms and head at 0, 0.3125, 0.9375 and 1.25
/// m), head-on, in steps of 1/60 s, over all phases. A way of s = speed · dt per step lets it through
/// - `penetration_resolution`: s > thickness. Falling, it tests the feet alone, and only where a step ends.
/// - `speculative_march`: the same where the paper is thinner than its unit; else never: it looks every unit.
/// - `wind_back`: where none of its four rows of points ends a step in the paper, at some phase: the smallest s at
///   which intervals as long as the thickness, one for each row, do not cover a circle of circumference s.
/// - `mask`: s > height + thickness as drawn - one pixel: pixels are drawn whose middle is in the paper, and places are
///   rounded to pixels, so that a way may be drawn longer than it is; at any speed where no pixel is drawn.
/// - `pixel_colour`, `pixel_tile`: at any speed where no pixel is drawn, else never: they look at each pixel.
/// - `bounding_box`, `discrete`: s > height + thickness: they look at where a step ends.
/// - `speculative`, `octagon_sweep`, Box2D with continuous collision: never.
/// - Box2D with `continuous=off`: s > height / 2 + 20 mm. Its contacts begin at 20 mm, and its static solids are
///   one-sided chains, which hold no character whose middle is behind them.
/// - Box2D with `bullet=off solids=dynamic`: s > (height + thickness) / 2 + 20 mm. Dynamic paper is a box, which pushes
///   a character that overlaps it the shorter way out.
struct BulletTheory {
  bool known = false;
  std::optional<double> lowest{};  ///< [m/s]; none: never. 0: at any speed.
};
[[nodiscard]] BulletTheory bullet_theory(const NamedContender& contender, double thickness);
/// The same in a word: the speed [m/s], `any`, `never`, or `-` where it is not known.
/// @param who one of `bullet_contenders` as it is called; of a number type of its own nothing is known.
[[nodiscard]] std::string bullet_theory_in_words(const std::string& who, double thickness);

/// Wilson's interval of 95 % for a rate (Wilson 1927, "Probable inference, the law of succession, and statistical
/// inference").
struct Interval {
  double low = 0;
  double high = 1;
};
[[nodiscard]] Interval wilson(int bad, int all);

}  // namespace paperproof::compare
