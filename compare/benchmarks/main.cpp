// Measures the controller beside Box2D, and prints the figures as one JSON object: "measurement figure": number.
// table.py makes the tables of controller/README.md and box2d_adapter/README.md of them.
//   paperproof_benchmarks          all
//   paperproof_benchmarks edit     those with this word in their name
#include "figures.hpp"

#include <nlohmann/json.hpp>

#include <exception>
#include <iostream>
#include <iterator>

int main(int argc, char** argv) try {
  using paperproof::benchmarks::Measurement;
  const std::string word = argc > 1 ? argv[1] : "";
  std::vector<Measurement> all = paperproof::benchmarks::step_measurements();
  std::ranges::move(paperproof::benchmarks::level_measurements(), std::back_inserter(all));
  std::ranges::move(paperproof::benchmarks::hero_measurements(), std::back_inserter(all));
  nlohmann::json figures = nlohmann::json::object();
  for (const Measurement& measurement : all) {
    if (measurement.name.find(word) == std::string::npos) continue;
    for (const auto& [figure, value] : measurement.measure()) figures[measurement.name + " " + figure] = value;
  }
  std::cout << figures.dump(1) << '\n';
  return figures.empty() ? 2 : 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
