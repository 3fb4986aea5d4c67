#include "records/row.hpp"

namespace paperproof::compare {

std::string_view name_of(Verdict verdict) noexcept { return verdict_names[static_cast<std::size_t>(verdict)]; }

std::string_view name_of(Axis axis) noexcept {
  constexpr std::array<std::string_view, 4> names{"safety", "progress", "answer", "validity"};
  return names[static_cast<std::size_t>(axis)];
}

bool was_judged(const Row& row) noexcept {
  return row.verdict != Verdict::failed && row.verdict != Verdict::not_applicable;
}

std::optional<double> parameter_of(const Row& row, std::string_view key) {
  for (const auto& [name, value] : row.parameters)
    if (name == key) return value;
  return std::nullopt;
}

std::optional<double> time_per_step(const Row& row) {
  return row.ns_per_step_bare ? row.ns_per_step_bare : row.ns_per_step;
}

std::optional<double> time_per_second(const Row& row) {
  const std::optional<double> dt = parameter_of(row, "dt_s");
  const std::optional<double> ns = time_per_step(row);
  return dt && ns ? std::optional(*ns / *dt) : std::nullopt;
}

std::string called(const Row& row) {
  std::string name = row.contender;
  if (!row.knob.empty()) name += " with " + row.knob;
  if (is_float_by_choice(row)) name += " in float";
  return name;
}

}  // namespace paperproof::compare
