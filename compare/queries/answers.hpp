/// What answerers in C++ share: they read questions, time the answers, and write them.
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace queries {

using Json = nlohmann::ordered_json;
using Point = std::array<double, 2>;

/// A point of a question, rounded to `Real`.
/// @param from is the origin: seen from where a way begins, a float is finest.
template <class Vector, class Real>
Vector point(const Json& pair, const Point& from) {
  const auto [x, y] = pair.get<Point>();
  return Vector(static_cast<Real>(x - from[0]), static_cast<Real>(y - from[1]));
}

/// The same of each point of a list.
template <class Vector, class Real>
std::vector<Vector> points(const Json& list, const Point& from) {
  std::vector<Vector> result;
  for (const Json& pair : list) result.push_back(point<Vector, Real>(pair, from));
  return result;
}

/// Writes an answer for each question of a file. What cannot be prepared has none, and says why.
/// @param method the first line: `method`, `tolerance` [m], `float`.
/// @param prepare makes of a question a function that answers it: the fraction of the way, or nothing. The answer alone
///   is timed: the mean of eight, after one that is not.
template <class Prepare>
void answer_all(const char* path, const Json& method, const Prepare& prepare) {
  constexpr int times = 8;
  std::cout << method << '\n';
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const Json question = Json::parse(line);
    try {
      const auto ask = prepare(question);
      std::optional<double> contact = ask();
      const auto begin = std::chrono::steady_clock::now();
      for (int i = 0; i < times; ++i) contact = ask();
      const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
      const Json said = contact ? Json(*contact) : Json();
      std::cout << Json{{"id", question["id"]}, {"contact", said}, {"ns", taken.count() / times}} << '\n';
    } catch (const std::exception& error) {
      std::cerr << question["id"] << ": " << error.what() << '\n';
    }
  }
}

}  // namespace queries
