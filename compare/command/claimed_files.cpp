#include "command/claimed_files.hpp"

#include "scenes/load.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace paperproof::compare {
namespace {

std::string place_of(const std::string& path) {
  std::error_code unknown;
  const std::filesystem::path place = std::filesystem::weakly_canonical(std::filesystem::absolute(path), unknown);
  return unknown ? path : place.string();
}

}  // namespace

bool ClaimedFiles::claim(const std::string& path, const std::string& by) {
  return claimed_.emplace(place_of(path), by).second;
}

void ClaimedFiles::claim_for_option(const std::string& option, const std::string& path) {
  if (!path.empty() && !claim(path, option))
    throw InputError(fmt::format("{} {}: expected another file than {}", option, path, claimed_[place_of(path)]));
}

}  // namespace paperproof::compare
