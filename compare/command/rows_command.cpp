#include "command/commands.hpp"

#include "command/claimed_files.hpp"
#include "records/metric.hpp"
#include "records/output_file.hpp"
#include "records/rows_json.hpp"
#include "records/rows_reader.hpp"
#include "scenes/load.hpp"
#include "words.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

/// Where the files are the shards of one sweep: in their order. Empty where they are anything else.
/// @throws InputError where some are missing, or there twice.
std::vector<RowsReader*> in_order(const std::vector<std::unique_ptr<RowsReader>>& readers) {
  const ordered_json first = readers.front()->header().value("sweep", ordered_json{});
  if (!first.is_object() || first["shard"][1] == 1) return {};
  const auto shards = first["shard"][1].get<std::size_t>();
  const auto incomplete = [&] {
    return InputError(fmt::format("merge: expected the {} shards of the sweep, each once", shards));
  };
  std::vector<RowsReader*> ordered(readers.size());
  for (const std::unique_ptr<RowsReader>& reader : readers) {
    const ordered_json sweep = reader->header().value("sweep", ordered_json{});
    if (!sweep.is_object() || sweep["id"] != first["id"] || sweep["shard"][1] != first["shard"][1]) return {};
    const auto part = sweep["shard"][0].get<std::size_t>();
    if (part > ordered.size()) throw incomplete();
    ordered[part - 1] = reader.get();
  }
  if (readers.size() != shards || std::find(ordered.begin(), ordered.end(), nullptr) != ordered.end())
    throw incomplete();
  return ordered;
}

/// What tells a row from the others of its file.
std::string name_of_row(const Row& row, const ordered_json& object) {
  std::string name;
  for (const std::string& part : {row.scene, row.contender, row.scalar, row.mode, row.knob, row.curve, row.border})
    if (!part.empty() && part != "free" && part != "double") name += (name.empty() ? "" : " ") + part;
  if (!row.case_id.empty()) return fmt::format("{} (case {})", name, row.case_id);
  if (!row.parameters.empty()) return fmt::format("{} {}", name, object["parameters"].dump());
  return name;
}

using Rows = std::map<std::string, ordered_json>;

Rows rows_of(const std::string& path) {
  Rows rows;
  RowsReader reader(path);
  while (std::optional<RowLine> line = reader.next()) {
    ordered_json object = row_json(line->row);
    std::string name = name_of_row(line->row, object);
    rows.insert_or_assign(std::move(name), std::move(object));
  }
  return rows;
}

/// Costs and the commit may be others in two files that say the same.
bool is_compared(const std::string& key) { return !is_cost(key) && key != "commit"; }

/// As `tunnels 0 -> 1, max_penetration_m 0.0 -> 0.5`.
std::string changes_between(const ordered_json& before, const ordered_json& after) {
  std::string text;
  const auto note = [&](const std::string& key, const std::string& was, const std::string& is) {
    text += fmt::format("{}{} {} -> {}", text.empty() ? "" : ", ", key, was, is);
  };
  for (const auto& [key, value] : before.items()) {
    if (!is_compared(key)) continue;
    if (!after.contains(key))
      note(key, value.dump(), "nothing");
    else if (after[key] != value)
      note(key, value.dump(), after[key].dump());
  }
  for (const auto& [key, value] : after.items())
    if (!before.contains(key) && is_compared(key)) note(key, "nothing", value.dump());
  return text;
}

}  // namespace

int merge_command(const Given& given) {
  ClaimedFiles claimed;
  std::vector<std::unique_ptr<RowsReader>> readers;
  for (const std::string& file : given.names) {
    claimed.claim(file, "rows to merge");
    readers.push_back(std::make_unique<RowsReader>(file));
  }
  claimed.claim_for_option("--rows", given.to);
  ordered_json header = readers.front()->header();
  const std::vector<RowsReader*> shards = in_order(readers);
  OutputFile out(given.to);
  if (!shards.empty()) {
    const auto cases = header["sweep"]["cases"].get<std::size_t>();
    header["sweep"]["shard"] = {1, 1};
    out.write(json_line(header));
    for (std::size_t row = 0; row < cases; ++row) {
      const std::size_t part = row % shards.size();
      const std::optional<RowLine> line = shards[part]->next();
      if (!line)
        throw InputError(fmt::format("merge: shard {}/{} is not complete: row {} is missing; --resume it", part + 1,
                                     shards.size(), row / shards.size() + 1));
      out.write(line->text);
    }
    for (RowsReader* shard : shards)
      if (shard->next()) throw InputError("merge: a shard has more rows than there are cases");
  } else {
    header.erase("sweep");
    out.write(json_line(header));
    std::set<std::string> known;
    for (const std::unique_ptr<RowsReader>& reader : readers)
      while (const std::optional<RowLine> line = reader->next()) {
        const std::string& id = line->row.case_id;
        if (id.empty() || known.insert(id).second) out.write(line->text);
      }
  }
  out.commit();
  return 0;
}

int diff_command(const Given& given) {
  const std::string& before = given.names[0];
  const std::string& after = given.names[1];
  const Rows old_rows = rows_of(before);
  const Rows new_rows = rows_of(after);
  std::size_t changed = 0;
  std::size_t same = 0;
  for (const auto& [name, row] : old_rows) {
    const auto now = new_rows.find(name);
    const std::string changes =
        now == new_rows.end() ? fmt::format("only in {}", before) : changes_between(row, now->second);
    if (changes.empty()) {
      ++same;
      continue;
    }
    ++changed;
    print_out(fmt::format("{}: {}\n", name, changes));
  }
  for (const auto& [name, row] : new_rows) {
    if (old_rows.contains(name)) continue;
    ++changed;
    print_out(fmt::format("{}: only in {}\n", name, after));
  }
  print_out(fmt::format("{} {}, {} the same, costs apart\n", counted(changed, "row"),
                        changed == 1 ? "differs" : "differ", same));
  return changed > 0 ? 1 : 0;
}

}  // namespace paperproof::compare
