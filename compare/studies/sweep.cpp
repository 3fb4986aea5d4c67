#include "studies/sweep.hpp"

#include "near_names.hpp"
#include "runs/knobs.hpp"
#include "runs/peers.hpp"
#include "runs/run_case.hpp"
#include "scenes/input_error.hpp"
#include "scenes/load.hpp"

#include <paperproof/number_in.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

constexpr std::size_t most_values = 1'000'000;
constexpr double border_width = 1e-4;

std::string text_of(double value) { return fmt::format("{}", value); }

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

/// The `step`-th of `count` values from `first` to `last`; the ends exactly.
double between(double first, double last, std::size_t step, std::size_t count, bool logarithmic) {
  if (step == 0) return first;
  if (step + 1 == count) return last;
  const double share = static_cast<double>(step) / static_cast<double>(count - 1);
  return logarithmic ? first * std::pow(last / first, share) : first + (last - first) * share;
}

std::optional<std::vector<std::string>> range_in(std::string_view text) {
  const std::vector<std::string_view> parts = parts_of(text, ':');
  if (parts.size() != 3 || parts[2].size() < 4) return std::nullopt;
  const std::optional<double> first = number_in<double>(parts[0]);
  const std::optional<double> last = number_in<double>(parts[1]);
  const bool logarithmic = parts[2].starts_with("log");
  const std::size_t count = number_in<std::size_t>(parts[2].substr(3)).value_or(0);
  const bool counted = count >= 1 && count <= most_values;
  if (!first || !last || !counted || (!logarithmic && !parts[2].starts_with("lin"))) return std::nullopt;
  if (logarithmic && !(*first > 0 && *last > 0)) return std::nullopt;
  std::vector<std::string> values;
  for (std::size_t step = 0; step < count; ++step)
    values.push_back(text_of(between(*first, *last, step, count, logarithmic)));
  return values;
}

bool is_parameter(const std::string& scene, std::string_view key) {
  const std::vector<ParameterDef> all = parameters_of(scene);
  return find_parameter(all, key) != nullptr;
}

void check_value(const Sweep& sweep, const std::string& key, const std::string& value) {
  if (is_parameter(sweep.scene, key)) {
    const std::optional<double> number = number_in<double>(value);
    if (!number) refuse(fmt::format("{}={}", key, value), "expected a number");
    return check_setting(sweep.scene, {key, *number});
  }
  KnobSetting knob;
  try {
    knob = parse_knob(key + "=" + value);
  } catch (const std::invalid_argument&) {
    check_setting(sweep.scene, {key, 0});  // says what there is
  }
  for (const NamedContender& contender : sweep.contenders) {
    if (!has_knob(contender.name, key))
      refuse(contender.name, fmt::format("expected a contender with the knob {}", key));
    try {
      check_knob(knob, contender.name);
    } catch (const std::invalid_argument& reason) {
      refuse(fmt::format("{}={}", key, value), reason.what());
    }
  }
}

void check_keys(const Sweep& sweep) {
  std::vector<std::string> keys;
  for (const SweepAxis& axis : sweep.axes) keys.push_back(axis.key);
  for (const Case::Setting& each : sweep.set) keys.push_back(each.key);
  if (sweep.border) keys.push_back(*sweep.border);
  std::sort(keys.begin(), keys.end());
  const auto twice = std::adjacent_find(keys.begin(), keys.end());
  if (twice != keys.end()) refuse(*twice, "expected once among --vary, --set and --find-border");
}

std::string border_key(const Sweep& sweep) {
  const std::vector<ParameterDef> all = parameters_of(sweep.scene);
  const ParameterDef* def = find_parameter(all, *sweep.border);
  return def != nullptr ? row_key(*def) : *sweep.border;
}

/// A run that ended because something was no number any more was made.
bool was_made(const Row& row) {
  return row.verdict != Verdict::not_applicable && (row.verdict != Verdict::failed || !row.finite.value_or(true));
}

/// Tells two studies apart.
std::string id_of(const std::vector<StudyPart>& parts) {
  std::string text;
  for (const StudyPart& part : parts) {
    const Sweep& sweep = part.sweep;
    text += command_of(sweep.at(0));
    if (sweep.border) text += " border " + *sweep.border;
    if (sweep.border_range) text += fmt::format(" {}:{}", sweep.border_range->first, sweep.border_range->second);
    for (const SweepAxis& axis : sweep.axes) text += fmt::format(" {}={}", axis.key, fmt::join(axis.values, ","));
    for (const NamedContender& who : sweep.contenders) text += ' ' + who.called();
    text += fmt::format(" {}\n", fmt::join(sweep.scalars, ","));
  }
  return hash_of(text);
}

}  // namespace

bool is_safe(const Row& row) {
  return was_judged(row) && row.tunnels.value_or(0) == 0 && row.steps_ending_inside.value_or(0) == 0;
}

std::string NamedContender::called() const {
  std::string text = name;
  for (const Case::Setting& knob : knobs) text += fmt::format(" {}={}", knob.key, knob.value);
  return text;
}

SweepAxis parse_axis(std::string_view text) {
  const std::size_t equals = text.find('=');
  SweepAxis axis{std::string(text.substr(0, equals)), {}};
  if (equals != std::string_view::npos && equals > 0) {
    const std::string_view values = text.substr(equals + 1);
    if (std::optional<std::vector<std::string>> range = range_in(values))
      axis.values = std::move(*range);
    else if (values.find(':') == std::string_view::npos)
      for (const std::string_view value : parts_of(values, ',')) axis.values.emplace_back(value);
  }
  const auto empty = [](const std::string& value) { return value.empty(); };
  if (axis.values.empty() || std::any_of(axis.values.begin(), axis.values.end(), empty))
    refuse("--vary " + std::string(text), "expected KEY=FIRST:LAST:logN, KEY=FIRST:LAST:linN or KEY=a,b,c");
  return axis;
}

std::vector<SweepAxis> parse_axes(std::string_view text) {
  std::vector<SweepAxis> axes;
  for (const std::string_view each : parts_of(text, ' ')) axes.push_back(parse_axis(each));
  return axes;
}

void parse_border(const std::string& text, Sweep& sweep) {
  const std::size_t equals = text.find('=');
  sweep.border = text.substr(0, equals);
  if (equals == std::string::npos) return;
  const std::vector<std::string_view> ends = parts_of(std::string_view(text).substr(equals + 1), ':');
  const std::optional<double> first = number_in<double>(ends.front());
  const std::optional<double> last = number_in<double>(ends.back());
  if (ends.size() != 2 || !first || !last || *first >= *last)
    refuse("--find-border " + text, "expected KEY or KEY=FIRST:LAST");
  sweep.border_range = {*first, *last};
}

std::size_t Sweep::size() const {
  std::size_t size = contenders.size() * scalars.size();
  for (const SweepAxis& axis : axes) size *= axis.values.size();
  return size;
}

Case Sweep::at(std::size_t index) const {
  Case one;
  one.scene = scene;
  one.parameters = set;
  one.seed = seed;
  one.steps = steps;
  const auto take = [&index](const auto& values) {
    const auto& value = values[index % values.size()];
    index /= values.size();
    return value;
  };
  const NamedContender who = take(contenders);
  one.contender = who.name;
  one.peer = peer_command(who.name);
  one.knobs = who.knobs;
  one.scalar = take(scalars);
  std::vector<Case::Setting> varied;
  for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) varied.push_back({axis->key, take(axis->values)});
  for (auto each = varied.rbegin(); each != varied.rend(); ++each)
    (is_parameter(scene, each->key) ? one.parameters : one.knobs).push_back(*each);
  return one;
}

void check(const Sweep& sweep) {
  check_keys(sweep);
  for (const SweepAxis& axis : sweep.axes)
    for (const std::string& value : axis.values) check_value(sweep, axis.key, value);
  for (const Case::Setting& each : sweep.set) check_value(sweep, each.key, each.value);
  if (sweep.border) {
    const std::vector<ParameterDef> all = parameters_of(sweep.scene);
    const ParameterDef* def = find_parameter(all, *sweep.border);
    if (def == nullptr) check_setting(sweep.scene, {*sweep.border, 0});  // says what there is
    const auto [least, most] = sweep.border_range.value_or(std::pair{def->least, def->most});
    for (const double end : {least, most}) check_setting(sweep.scene, {*sweep.border, end});
  }
  static_cast<void>(load_scene(sweep.scene, {}));
}

PartCase part_case(const std::vector<StudyPart>& parts, std::size_t index) {
  PartCase place{0, index};
  for (; place.part + 1 < parts.size() && place.index >= parts[place.part].sweep.size(); ++place.part)
    place.index -= parts[place.part].sweep.size();
  return place;
}

Row run_at(const Sweep& sweep, std::size_t index) {
  if (sweep.border) return border_at(sweep, index, {run_case, is_safe});
  return run_case(sweep.at(index));
}

Row border_at(const Sweep& sweep, std::size_t index, const BorderSearch& search) {
  const Case one = sweep.at(index);
  const std::vector<ParameterDef> all = parameters_of(sweep.scene);
  const ParameterDef& def = *find_parameter(all, *sweep.border);
  const auto [least, most] = sweep.border_range.value_or(std::pair{def.least, def.most});
  const auto run_with = [&](double value) {
    Case at = one;
    at.parameters.push_back({*sweep.border, text_of(value)});
    return search.run(at);
  };
  Row row = find_border(row_key(def), least, most, run_with, search.strides, search.holds);
  std::erase_if(row.parameters, [&](const auto& each) { return each.first == row_key(def); });
  row.case_id = hash_of(fmt::format("{} border {} {}:{}", command_of(one), *sweep.border, least, most));
  return row;
}

StudyCases cases_of(const std::vector<StudyPart>& parts) {
  const auto at = [&parts](std::size_t index) {
    const PartCase place = part_case(parts, index);
    return std::pair(&parts[place.part], place.index);
  };
  const auto swept = [](const StudyPart& part, Row row) {
    row.swept = {part.title, axis_keys_of(part.sweep), part.bad};
    return row;
  };
  StudyCases cases;
  cases.id = id_of(parts);
  for (const StudyPart& part : parts) cases.count += part.sweep.size();
  cases.run = [=](std::size_t index) {
    const auto [part, of_part] = at(index);
    return swept(*part, part->run ? part->run(part->sweep, of_part) : run_at(part->sweep, of_part));
  };
  cases.lost = [=](std::size_t index, const std::string& reason) {
    const auto [part, of_part] = at(index);
    Row row = swept(*part, failed_row(part->sweep.at(of_part), reason));
    if (part->sweep.border) row.border = border_key(part->sweep);
    return row;
  };
  cases.is_of = [=](std::size_t index, const Row& row) {
    const auto [part, of_part] = at(index);
    return part->sweep.border || row.case_id == id_of(part->sweep.at(of_part));
  };
  return cases;
}

std::vector<std::string> axis_keys_of(const Sweep& sweep) {
  std::vector<std::string> keys;
  const std::vector<ParameterDef> defs = parameters_of(sweep.scene);
  for (const SweepAxis& axis : sweep.axes) {
    const ParameterDef* def = find_parameter(defs, axis.key);
    keys.push_back(def != nullptr ? row_key(*def) : axis.key);
  }
  return keys;
}

Row find_border(const std::string& key, double least, double most, const std::function<Row(double)>& run_with,
                int strides, const std::function<bool(const Row&)>& holds) {
  const bool logarithmic = least > 0;
  const auto value_at = [&](int step) {
    return between(least, most, static_cast<std::size_t>(step), static_cast<std::size_t>(strides) + 1, logarithmic);
  };
  std::optional<double> low;
  std::optional<double> high;
  Row row;
  for (int step = 0; step <= strides && !high; ++step) {
    row = run_with(value_at(step));
    if (!was_made(row)) break;
    (holds(row) ? low : high) = value_at(step);
  }
  while (low && high && *high - *low > border_width * std::abs(*high)) {
    const double middle = logarithmic ? std::sqrt(*low * *high) : (*low + *high) / 2;
    if (middle == *low || middle == *high) break;
    Row there = run_with(middle);
    const bool made = was_made(there);
    const bool safe = made && holds(there);
    if (made) (safe ? low : high) = middle;
    if (!safe) row = std::move(there);
    if (!made) break;
  }
  row.border = key;
  row.border_low = low;
  row.border_high = high;
  return row;
}

}  // namespace paperproof::compare
