#include "command/option_checks.hpp"

#include "words.hpp"

#include <paperproof/number_in.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace paperproof::compare {
namespace {

/// Help shows the name of an option's type and not its check.
CLI::Validator unnamed(std::function<std::string(std::string&)> check) { return CLI::Validator(std::move(check), ""); }

bool is_multiple(const std::string& typed, std::uint64_t most, std::uint64_t step) {
  const std::optional<std::uint64_t> number = number_in<std::uint64_t>(typed);
  return number && *number >= step && *number <= most && *number % step == 0;
}

}  // namespace

CLI::Validator expect_one_of(const std::vector<std::string>& allowed) {
  return unnamed([allowed](const std::string& typed) {
    const bool found = std::find(allowed.begin(), allowed.end(), typed) != allowed.end();
    return found ? "" : fmt::format("expected {}, not {}", one_of_words(allowed), shown(typed));
  });
}

CLI::Validator expect_whole_number(std::uint64_t most, std::uint64_t step) {
  return unnamed([most, step](const std::string& typed) {
    const std::string kind = step == 1 ? "a whole number" : fmt::format("a multiple of {}", step);
    if (is_multiple(typed, most, step)) return std::string{};
    return fmt::format("expected {} from {} to {}, in digits, not {}", kind, step, most, shown(typed));
  });
}

CLI::Validator expect_file_name() {
  return unnamed([](const std::string& typed) {
    return typed.empty() ? std::string("expected a file name, not \"\"") : std::string{};
  });
}

CLI::Validator expect_ending(const std::vector<std::string>& endings) {
  return unnamed([endings](const std::string& typed) {
    const std::string extension = std::filesystem::path(typed).extension().string();
    const bool known = extension.empty() || std::find(endings.begin(), endings.end(), extension) != endings.end();
    return known ? std::string{}
                 : fmt::format("expected a name that ends in {}, not {}", one_of_words(endings), shown(typed));
  });
}

std::string reason_of(const CLI::ParseError& error, CLI::App& command) {
  const std::string library = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) == nullptr) return library;
  for (const CLI::Option* option : command.get_options({})) {
    const std::string name = option->get_name();
    if (library.starts_with(name.substr(name.find_first_not_of('-')) + " was given"))
      return fmt::format("{}: expected nothing behind it", name);
    if (!library.starts_with(name + ":")) continue;
    if (option->empty()) return fmt::format("{}: expected {} behind it", name, option->get_type_name());
    const int most = option->get_expected_max();
    const bool is_short = static_cast<int>(option->count()) < option->get_expected_min();
    if (is_short) return fmt::format("{}: expected {}, not {}", name, option->get_expected_min(), option->count());
    return most == 1 ? fmt::format("{}: expected once, not {} times", name, option->count())
                     : fmt::format("{}: expected at most {}, not {}", name, most, option->count());
  }
  return library;
}

}  // namespace paperproof::compare
