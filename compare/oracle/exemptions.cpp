#include "oracle/exemptions.hpp"

#include "oracle/contacts.hpp"
#include "records/row.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace paperproof::compare {
namespace {

using detail::contact_reach;

/// See `own_reach` [m].
constexpr double least_reach = 1e-6;

//                                                                 octagon_sweep  Box2D          by units  others
constexpr auto all_exemptions = std::to_array<Exemption>({
    {"clipped",
     "passes a solid with a rim of the octagon no deeper than this (and an eighth of its width)",
     "m",
     {0, its_rim, its_rim, its_rim}},
    {"late_match", "reports a contact so many steps beside the exact one", "steps", {0, 1, 0, 0}},
    {"reach",
     "reports a contact with what is no farther than this, and not met",
     "m",
     {0, box2d_skin, its_own, its_own}},
    {"hover",
     "does not fall, and no solid below or beside it is farther than this; or stands on ground that is beside its foot "
     "by up to 7e-7 m",
     "m",
     {0, box2d_skin, its_own, its_own}},
    {"company",
     "is beside another character that goes at the same time: contacts with scenery, lost speed, falls, ground and "
     "room count neither way",
     "",
     {0, 1, 1, 1}},
    {"stuck", "is stuck, crushed or begins inside something, and misses or invents contacts", "", {1, 1, 1, 1}},
    {"late_ground", "says that it is grounded by what was under it earlier in the step", "", {0, 1, 1, 1}},
    {"drawn",
     "is inside pixels no deeper than this: it is drawn on whole pixels, and the octagon is not",
     "m",
     {0, 0, its_pixel, 0}},
    {"deflected",
     "reports a contact that the requested motion has not, but what an exact contact leaves of it",
     "",
     {1, 0, 1, 1}},
    {"ahead",
     "reports a contact with what is this near along the normal, and met in the next step only",
     "m",
     {contact_reach, 0, contact_reach, contact_reach}},
    {"far", "begins or goes farther than this, and breaks a clause", "m", {1e6, 0, 0, 0}},
    {"unsure",
     "hangs, or loses speed, unless what turns comes this much farther than its point nearest to the character",
     "m",
     {its_turn, its_turn, its_turn, its_turn}},
    {"in_parts",
     "goes in parts of a step, as what turns near it does: what the motion of the first would meet later is not asked "
     "for",
     "",
     {1, 0, 1, 1}},
    {"turning_sensor",
     "overlaps a sensor that turns: whether and when it enters and leaves that is not asked for",
     "",
     {1, 1, 1, 1}},
});
static_assert(all_exemptions.size() == static_cast<std::size_t>(Exempt::turning_sensor) + 1);

std::string size_in_words(const Exemption& exemption, Party party) {
  const double size = exemption.sizes[static_cast<std::size_t>(party)];
  if (size == its_pixel) return "its pixel";
  if (size == its_rim) return party == Party::by_units ? "0.02 m, its unit or pixel" : "0.02 m";
  if (size == its_turn) return "angle × size";
  if (size == its_own) return party == Party::by_units ? "its unit" : "its touch gap";
  if (exemption.unit.empty()) return size > 0 ? "yes" : "no";
  if (size == 0) return "0";
  char text[32];
  std::snprintf(text, sizeof text, "%g ", size);
  return text + std::string(exemption.unit);
}

}  // namespace

Party party_of(const TraceHeader& header) {
  if (!header.guarantees.empty() || is_guaranteed(header.contender, header.scalar)) return Party::promising;
  if (!header.path_exact) return Party::sampled;
  return tolerance_named(header, "unit") > 0 ? Party::by_units : Party::computing;
}

std::span<const Exemption> exemptions() { return all_exemptions; }

double allowed(Exempt which, const TraceHeader& header) {
  const double size = all_exemptions[static_cast<std::size_t>(which)].sizes[static_cast<std::size_t>(party_of(header))];
  if (size == its_pixel) return tolerance_named(header, "pixel");
  if (size == its_rim) return std::max({box2d_skin, tolerance_named(header, "unit"), tolerance_named(header, "pixel")});
  return size == its_own ? own_reach(header) : size;
}

double own_reach(const TraceHeader& header) {
  if (!header.path_exact) return box2d_skin;
  if (party_of(header) == Party::promising) return least_reach;  // whatever its header says
  return std::max({least_reach, tolerance_named(header, "unit"), tolerance_named(header, "touch")});
}

double tolerance_named(const TraceHeader& header, std::string_view name) {
  for (const NamedTolerance& tolerance : header.tolerances)
    if (tolerance.name == name) return tolerance.metres;
  return 0;
}

double ulp_at(const TraceHeader& header, const Vec2d& position) {
  const double largest = position.cwiseAbs().maxCoeff();
  if (header.scalar != "float") return std::nextafter(largest, 2 * largest + 1) - largest;
  const auto narrow = static_cast<float>(largest);
  return static_cast<double>(std::nextafter(narrow, 2 * narrow + 1) - narrow);
}

std::vector<std::string> exemptions_in_words() {
  std::vector<std::string> lines;
  for (const Exemption& exemption : all_exemptions)
    lines.push_back(std::string(exemption.name) + ": " + std::string(exemption.meaning) + ". octagon_sweep in double " +
                    size_in_words(exemption, Party::promising) + ", Box2D " + size_in_words(exemption, Party::sampled) +
                    ", who searches by units " + size_in_words(exemption, Party::by_units) + ", others " +
                    size_in_words(exemption, Party::computing));
  return lines;
}

}  // namespace paperproof::compare
