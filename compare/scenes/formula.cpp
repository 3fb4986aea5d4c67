#include "scenes/formula.hpp"

#include <paperproof/character.hpp>

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace paperproof::compare {
namespace {

// Functions of formulas. Those of the law of motion, design §4, are about steps of `dt` under `gravity` of a character
// with `walk_speed`, `acceleration` and `jump_speed`.

/// What the formula that is computed may name.
const Values* known = nullptr;

double given(const char* name) {
  const auto found = known->find(name);
  if (found == known->end()) throw std::invalid_argument(fmt::format("expected a number with the name {}", name));
  return found->second;
}

/// How far a body falls in n steps from rest [m].
double fallen(double steps) { return given("gravity") * given("dt") * given("dt") * steps * (steps + 1) / 2; }

/// How high a jump is after n steps [m].
double risen(double steps) { return given("jump_speed") * given("dt") * steps - fallen(steps); }

/// In how many steps a body falls so far, with a speed downwards at the start.
double steps_to_fall(double way, double speed) {
  const double dt = given("dt");
  for (int step = 0;; ++step) {
    speed += given("gravity") * dt;
    if (speed * dt >= way) return step + way / (speed * dt);
    way -= speed * dt;
  }
}

/// How far the character walks from rest in n steps of `move` 1 [m].
double walked(double steps) {
  double way = 0;
  for (int step = 1; step <= steps; ++step)
    way += std::min(given("walk_speed"), step * given("acceleration") * given("dt")) * given("dt");
  return way;
}

/// In how many steps it walks so far [m].
double steps_to_walk(double way) {
  int steps = 0;
  while (walked(steps + 1) < way) ++steps;
  return steps + (way - walked(steps)) / (walked(steps + 1) - walked(steps));
}

/// How far the article's character reaches from its middle along a direction [m].
double support(double x, double y) {
  double reach = 0;
  for (const Vec2d& point : CharacterDef().shape.points()) reach = std::max(reach, point.dot(Vec2d(x, y)));
  return reach;
}

/// How far a mass on a spring is from where the spring is slack, after n steps from rest there [m]: the implicit Euler
/// method, which is what Box2D's soft constraint is for one spring.
double sprung(double steps, double mass, double stiffness, double damping) {
  const double h = given("dt");
  double speed = 0;
  double way = 0;
  for (int step = 0; step < steps; ++step) {
    speed = (speed - h * given("gravity") - h * stiffness / mass * way) /
            (1 + h * damping / mass + h * h * stiffness / mass);
    way += h * speed;
  }
  return way;
}

/// The distance from |x| to the next double.
double ulp(double x) { return std::nextafter(std::abs(x), HUGE_VAL) - std::abs(x); }

mu::Parser parser_with_functions() {
  mu::Parser parser;
  parser.EnableOptimizer(false);  // it would change the order in which a formula is computed
  parser.DefineFun("fallen", fallen);
  parser.DefineFun("risen", risen);
  parser.DefineFun("steps_to_fall", steps_to_fall);
  parser.DefineFun("walked", walked);
  parser.DefineFun("steps_to_walk", steps_to_walk);
  parser.DefineFun("support", support);
  parser.DefineFun("sprung", sprung);
  parser.DefineFun("ulp", ulp);
  using OfOne = double (*)(double);
  using OfTwo = double (*)(double, double);
  parser.DefineFun("floor", OfOne(std::floor));
  parser.DefineFun("ceil", OfOne(std::ceil));
  parser.DefineFun("round", OfOne(std::round));
  parser.DefineFun("hypot", OfTwo(std::hypot));
  parser.DefineFun("next", OfTwo(std::nextafter));
  parser.DefineOprt("%", OfTwo(std::fmod), mu::prMUL_DIV);
  return parser;
}

/// Of a list of numbers, or all from one to another by steps of one size.
std::vector<double> numbers_of(const Json& list, const Values& values) {
  const Json range = computed(list, values);
  if (range.is_array()) return range.get<std::vector<double>>();
  const double from = range.at("from");
  const double by = range.value("by", 1.0);
  std::vector<double> numbers(static_cast<std::size_t>(std::lround((range.at("to").get<double>() - from) / by)) + 1);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = from + static_cast<double>(i) * by;
  return numbers;
}

/// A part of a list: once, not at all, or often.
void add_computed(const Json& part, const Values& values, Json& list) {
  if (part.is_object() && part.contains("if") && value_of(part["if"], values) == 0) return;
  if (!part.is_object() || !part.contains("each")) return list.push_back(computed(part, values));
  for (Values& each : cases_of(part.at("for"), values)) {
    name_numbers(part.value("let", Json::object()), each);
    add_computed(part["each"], each, list);
  }
}

std::string filled(std::string text, const Values& values) {
  for (std::size_t at = text.find('{'); at != text.npos; at = text.find('{', at)) {
    const std::size_t end = text.find('}', at);
    if (end == text.npos) throw std::invalid_argument(text + ": expected }");
    text.replace(at, end + 1 - at, fmt::format("{}", value_of(text.substr(at + 1, end - at - 1), values)));
  }
  return text;
}

}  // namespace

const Values& constants() {
  static const Values all{
      {"px", 1.0 / 32},  // of the article's pictures [m]
      {"half_width", 10.0 / 32}, {"half_height", 20.0 / 32},
      {"half_foot", 5.0 / 32},   {"gap", 1e-6},  // the largest that may be kept at a contact [m]
      {"pi", std::numbers::pi},  {"degree", std::numbers::pi / 180},
  };
  return all;
}

double value_of(const std::string& formula, const Values& values) {
  if (const auto found = values.find(formula); found != values.end()) return found->second;
  try {
    static mu::Parser parser = parser_with_functions();  // it takes longer to make one than to use it
    known = &values;
    parser.ClearConst();
    for (const auto& [name, value] : values)
      if (formula.find(name) != std::string::npos) parser.DefineConst(name, value);
    parser.SetExpr(formula);
    return parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw std::invalid_argument(formula + ": " + error.GetMsg());
  }
}

void name_numbers(const Json& let, Values& values) {
  for (const auto& [name, formula] : let.items()) {
    if (constants().contains(name)) throw std::invalid_argument(name + ": formulas have this name for something else");
    values[name] = formula.is_number() ? formula.get<double>() : value_of(formula, values);
  }
}

std::vector<Values> cases_of(const Json& list, const Values& others) {
  std::vector<Values> all{others};
  if (list.is_array()) {
    all.assign(list.size(), others);
    for (std::size_t i = 0; i < list.size(); ++i) name_numbers(computed(list[i], others), all[i]);
    return all;
  }
  for (const auto& [name, numbers] : list.items()) {
    std::vector<Values> longer;
    for (const Values& values : all) {
      for (const double number : numbers_of(numbers, values)) {
        longer.push_back(values);
        name_numbers({{name, number}}, longer.back());
      }
    }
    all = std::move(longer);
  }
  return all;
}

Json computed(const Json& document, const Values& values) {
  if (document.is_string()) {
    const auto& text = document.get_ref<const std::string&>();
    return text.starts_with('=') ? Json(value_of(text.substr(1), values)) : Json(filled(text, values));
  }
  if (!document.is_structured()) return document;
  Json result = document.is_array() ? Json::array() : Json::object();
  if (document.is_array()) {
    for (const Json& part : document) add_computed(part, values, result);
    return result;
  }
  for (const auto& [key, part] : document.items())
    if (key != "if") result[key] = computed(part, values);
  if (!result.contains("box")) return result;
  const std::vector<double> box = result["box"];
  result.erase("box");
  result["polygon"] = {{box.at(0), box.at(1)}, {box.at(2), box[1]}, {box[2], box.at(3)}, {box[0], box[3]}};
  return result;
}

}  // namespace paperproof::compare
