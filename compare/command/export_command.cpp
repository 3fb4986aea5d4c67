#include "campaign/queries.hpp"
#include "command/claimed_files.hpp"
#include "command/commands.hpp"
#include "records/collider_json.hpp"
#include "records/output_file.hpp"
#include "records/rows_file.hpp"
#include "scenes/load.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace paperproof::compare {
namespace {

using Json = nlohmann::ordered_json;

Json query_json(int id, const Query& query) {
  Json line{{"id", id},
            {"source", query.source},
            {"points", points_json(query.points)},
            {"position", point_json(query.position)},
            {"displacement", point_json(query.displacement)},
            {"solids", Json::array()}};
  for (std::size_t i = 0; i < query.solids.size(); ++i) {
    ColliderDef shape{.shape = query.solids[i].shape, .points = query.solids[i].points, .holes = query.solids[i].holes};
    line["solids"].push_back(collider_json(std::to_string(i), shape));
  }
  line["contact"] = query.contact ? Json(query.contact->text()) : Json();
  line["with"] = query.contact ? Json(std::to_string(query.with)) : Json();
  line["degenerate"] = query.degenerate;
  return line;
}

/// Numbers and words stand as they are, lists as JSON, null is an empty cell.
std::string csv_line(const Json& line) {
  std::string text;
  for (const Json& value : line) {
    if (!text.empty()) text += ',';
    if (!value.is_null()) text += csv_quoted(value.is_string() ? value.get<std::string>() : value.dump());
  }
  return text + '\n';
}

}  // namespace

int export_queries_command(const Given& given) {
  std::vector<Family> from = families();
  for (const std::string& name : given.names)
    std::ranges::transform(load_scenes(name), std::back_inserter(from), ways_through);
  ClaimedFiles files;
  files.claim_for_option("export queries", given.to);
  OutputFile file(given.to);
  const bool as_csv = given.to.ends_with(".csv");
  if (as_csv) file.write("id,source,points,position,displacement,solids,contact,with,degenerate\n");
  int id = 0;
  make_queries(given.count, from, [&](const Query& query) {
    const Json line = query_json(id++, query);
    file.write(as_csv ? csv_line(line) : line.dump() + '\n');
  });
  file.commit();
  return 0;
}

}  // namespace paperproof::compare
