/// What a contender is excused, and up to what size: one table for the judge, the rows, the command and the report.
#pragma once

#include "records/trace.hpp"

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace paperproof::compare {

/// Box2D reports touching from this gap on: two polygon radii [m].
inline constexpr double box2d_skin = 0.020;

/// Contenders that are treated alike.
enum class Party : std::uint8_t {
  promising,  ///< It guarantees something: octagon_sweep in double.
  sampled,    ///< Its path is known by samples: Box2D.
  by_units,   ///< It searches or moves by units.
  computing,  ///< All others: bounding_box, discrete, float.
};
[[nodiscard]] Party party_of(const TraceHeader& header);

enum class Exempt : std::uint8_t {
  clipped,
  late_match,
  reach,
  hover,
  company,
  stuck,
  late_ground,
  drawn,
  deflected,
  ahead,
  far,
  unsure,
  in_parts,
  turning_sensor
};

struct Exemption {
  std::string_view name;          ///< As rows have it in `exempted`.
  std::string_view meaning;       ///< What happened that is not held against it.
  std::string_view unit;          ///< "m" or "steps"; empty where there is no size, and 1 means that it applies.
  std::array<double, 4> sizes{};  ///< By party; `its_own` for what its header says.
};
/// A unit of its search, or the gap up to which it holds a contact.
inline constexpr double its_own = -1;
/// A pixel of the picture that it draws, where the scenery is made of these very pixels; elsewhere 0.
inline constexpr double its_pixel = -2;
/// How much farther than its nearest point what turns may come in a step: see `NearPart::unsure`.
inline constexpr double its_turn = -3;
/// 20 mm, as Box2D's skin; a unit of its search or a pixel of its picture, if that is more.
inline constexpr double its_rim = -4;

/// In the order of `Exempt`.
[[nodiscard]] std::span<const Exemption> exemptions();
/// For this contender, in metres or steps; 0: it does not apply. `its_turn` is another in each step, and stays what it
/// is.
[[nodiscard]] double allowed(Exempt which, const TraceHeader& header);
/// What this contender calls near [m]: no less than 1e-6, at which §6 of the guarantee lets it stop.
[[nodiscard]] double own_reach(const TraceHeader& header);
/// In metres; 0 where it is not among the header's tolerances.
[[nodiscard]] double tolerance_named(const TraceHeader& header, std::string_view name);
/// Between the largest coordinate of a place and the next number, as this contender counts [m].
[[nodiscard]] double ulp_at(const TraceHeader& header, const Vec2d& position);

/// The table in words, a line for each exemption.
[[nodiscard]] std::vector<std::string> exemptions_in_words();

}  // namespace paperproof::compare
