#include "command/campaign_command.hpp"

#include "records/output_file.hpp"
#include "records/row.hpp"
#include "runs/view.hpp"
#include "scenes/load.hpp"
#include "scenes/write_json.hpp"
#include "words.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace paperproof::compare {
namespace {

struct Ran {
  const Family* family;
  Findings findings;
};

std::string names_of(const Breaches& breaches) {
  std::string names;
  for (const auto& [clause, breach] : breaches)
    names += fmt::format("{}{} {}", names.empty() ? "" : ", ", name_of(clause), breach.steps);
  return names;
}

/// Of one kind: steps, and the shares of what happened in any of its families.
std::string table_of(const std::vector<Ran>& all) {
  std::vector<Column<Ran>> columns{{"family", [](const Ran& ran) { return ran.family->title(); }},
                                   {"steps", [](const Ran& ran) { return std::to_string(ran.findings.records); }}};
  for (std::size_t i = 0; i < happenings().size(); ++i) {
    const auto share = [i](const Ran& ran) {
      return fmt::format("{:.2f} %", 100.0 * ran.findings.happened[i] / ran.findings.records);
    };
    const auto happened = [i](const Ran& ran) { return ran.findings.happened[i] > 0; };
    if (std::any_of(all.begin(), all.end(), happened)) columns.push_back({std::string(happenings()[i].name), share});
  }
  columns.push_back({"left out", [](const Ran& ran) {
                       return fmt::format("{} of {} runs", ran.findings.left_out, ran.findings.runs);
                     }});
  columns.push_back({"breaks, in steps", [](const Ran& ran) {
                       const std::string names = names_of(ran.findings.breaches);
                       return names.empty() ? "-" : names;
                     }});
  return view(all, columns) + "\n";
}

/// Of one kind, as tests/known_and_open.json has them: what each clause is broken in of a million steps, and of each
/// family.
std::string rates_of(const std::vector<Ran>& all) {
  std::map<Clause, std::string> of_families;
  std::map<Clause, int> broken;
  int records = 0;
  const auto in_a_million = [](int steps, int of) { return 1e6 * steps / of; };
  for (const Ran& ran : all) {
    records += ran.findings.records;
    for (const auto& [clause, breach] : ran.findings.breaches) {
      broken[clause] += breach.steps;
      of_families[clause] += fmt::format("{}{} {:.0f}", of_families[clause].empty() ? "" : ", ", ran.family->name,
                                         in_a_million(breach.steps, ran.findings.records));
    }
  }
  std::string lines;
  for (const auto& [clause, steps] : broken)
    lines += fmt::format("{}: {} is broken in {:.1f} steps of a million ({})\n", all.front().family->kind,
                         name_of(clause), in_a_million(steps, records), of_families[clause]);
  return lines;
}

/// All that are named, each once and in the order of the kinds.
std::vector<const Family*> asked_for(const std::vector<std::string>& titles) {
  std::vector<const Family*> named;
  if (titles.empty()) return families_named("");
  for (const std::string& title : titles)
    for (const Family* family : families_named(title))
      if (std::find(named.begin(), named.end(), family) == named.end()) named.push_back(family);
  std::sort(named.begin(), named.end());
  return named;
}

}  // namespace

int campaign_command(const CampaignArguments& arguments) {
  std::vector<Ran> kind;
  std::string broken;
  std::string missing;
  const auto print_kind = [&] {
    if (!kind.empty()) print_out(table_of(kind) + rates_of(kind));
    kind.clear();
  };
  const std::string& contender = arguments.settings.contender;
  const std::string as = contender == "octagon_sweep" ? "" : " --contender " + contender;
  for (const Family* family : asked_for(arguments.families)) {
    if (!kind.empty() && kind.front().family->kind != family->kind) print_kind();
    Findings findings =
        run_family(*family, arguments.steps, arguments.settings, [&](std::uint64_t seed, const Findings& run) {
          broken += describe(run.breaches, family->replay_of(seed) + as + ": ");
        });
    if (!findings.failed.empty()) missing += fmt::format("{}: {}\n", family->title(), findings.failed);
    for (const std::string& uncovered_part : uncovered(*family, findings)) missing += uncovered_part + "\n";
    if (findings.records > 0) kind.push_back({family, std::move(findings)});
  }
  print_kind();
  print_out(broken + missing);
  const bool breaks = !broken.empty() && is_guaranteed(contender, "double");
  return missing.empty() && !breaks ? 0 : 1;
}

int replay_command(const ReplayArguments& arguments) {
  const std::vector<const Family*> named = families_named(arguments.family);
  if (named.size() > 1) throw InputError(arguments.family + ": expected one family, such as " + named.front()->title());
  const Family& family = *named.front();
  const RandomRun run = family.draw(arguments.seed);
  const std::string name = family.name_of_run(arguments.seed);
  if (!arguments.scene_path.empty()) {
    OutputFile file(arguments.scene_path);
    file.write(scene_json(with_names(run.scene, name)).dump() + "\n");
    file.commit();
  }
  const Findings found = run_and_judge(run, name, arguments.settings);
  if (!found.failed.empty()) throw InputError(fmt::format("{} {}: {}", family.title(), arguments.seed, found.failed));
  if (found.steps == 0)
    throw InputError(fmt::format(
        "{} {} is left out: {}", family.title(), arguments.seed,
        run.scene.steps == 0 ? "it has no free place for its characters" : "its character begins inside something"));
  std::string said = fmt::format("{} {}: {} judged of {}\n", family.title(), arguments.seed,
                                 counted(found.steps, "step"), arguments.settings.contender);
  for (std::size_t i = 0; i < found.happened.size(); ++i)
    if (found.happened[i] > 0)
      said += fmt::format("  {:<11}{} in {}\n", happenings()[i].name, happenings()[i].meaning,
                          counted(found.happened[i], "step"));
  print_out(said + describe(found.breaches, "  breaks "));
  return !found.breaches.empty() && is_guaranteed(arguments.settings.contender, "double") ? 1 : 0;
}

}  // namespace paperproof::compare
