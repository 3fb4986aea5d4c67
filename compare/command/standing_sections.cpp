#include "command/standing_sections.hpp"

#include "oracle/exemptions.hpp"
#include "runs/fairness.hpp"

namespace paperproof::compare {

ReportSection exemptions_section() {
  return {"What is not held against a contender, counted as `exempted`, and up to what size", exemptions_in_words()};
}

std::vector<ReportSection> standing_sections() {
  return {exemptions_section(), {"Is it fair? What differs between the sides by their nature", {}, fairness_table()}};
}

}  // namespace paperproof::compare
