#include "command/commands.hpp"

#include "command/cell_replays.hpp"
#include "command/claimed_files.hpp"
#include "command/standing_sections.hpp"
#include "records/rows_reader.hpp"
#include "report/index_json.hpp"
#include "report/json_text.hpp"
#include "report/page_reader.hpp"
#include "report/report.hpp"
#include "report/row_pictures.hpp"
#include "scenes/load.hpp"

#include <nlohmann/json.hpp>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

/// Of the first input that has any.
ReportFacts facts_of_page(const ordered_json& index) {
  ReportFacts facts;
  facts.environment = index.at("environment").get<Environment>();
  for (const ordered_json& tolerance : index.at("tolerances"))
    facts.tolerances.push_back({tolerance[0], tolerance[1].is_number() ? tolerance[1].get<double>() : std::nan("")});
  facts.guarantee_notes = index.at("guarantee_notes").get<std::vector<std::string>>();
  for (const ordered_json& section : index.at("sections"))
    facts.sections.push_back({section.at("title"), section.at("lines"), section.at("table")});
  return facts;
}

class PageOfRecords {
 public:
  PageOfRecords(const std::string& path, const std::vector<std::string>& inputs) : writer_(path), inputs_(inputs) {}

  void run() {
    for (const std::string& input : inputs_)
      if (input.ends_with(".html")) take_page(input);
    take_rows();
    if (facts_.sections.empty()) facts_.sections = standing_sections();
    writer_.finish(facts_);
  }

 private:
  void take_page(const std::string& input) {
    const PageReader page(input);
    try {
      take_page(page);
    } catch (const ordered_json::exception&) {
      throw InputError(input + ": expected a page that paperproof wrote");
    }
  }

  void take_page(const PageReader& page) {
    const ordered_json& index = page.index();
    if (facts_.sections.empty()) {
      Environment known = std::move(facts_.environment);
      facts_ = facts_of_page(index);
      if (facts_.environment.empty()) facts_.environment = std::move(known);
    }
    const ordered_json& scenes = index.at("scenes");
    for (std::size_t scene = 0; scene < scenes.size(); ++scene)
      writer_.add_scene(safe(scenes[scene]), page.replay(scene));
    const ordered_json& studies = index.at("studies");
    for (std::size_t study = 0; study < studies.size(); ++study)
      writer_.add_study(safe(studies[study]), page.cells(study));
  }

  void take_rows() {
    RowPictures pictures;
    for (const std::string& input : inputs_) {
      if (input.ends_with(".html")) continue;
      const ordered_json header = for_each_row(input, [&](Row row) { pictures.add(std::move(row)); });
      if (facts_.environment.empty() && header.contains("environment"))
        for (const auto& [name, value] : header["environment"].items())
          facts_.environment.emplace_back(name, value.get<std::string>());
    }
    for (const auto& [scene, rows] : pictures.scenes()) {
      ReportScene known;
      known.name = scene;
      known.rows = rows;
      writer_.add_scene(scene_index_json(known), "null");
    }
    for (ChartPage& page : pictures.pages()) {
      add_cell_replays(page, 0);
      writer_.add_study(page);
    }
  }

  /// As it stands in a page.
  static std::string safe(const ordered_json& object) { return script_safe(object.dump()); }

  ReportWriter writer_;
  const std::vector<std::string>& inputs_;
  ReportFacts facts_;
};

}  // namespace

int report_command(const Given& given) {
  ClaimedFiles files;
  for (const std::string& input : given.names) files.claim(input, "records");
  files.claim_for_option("FILE.html", given.to);
  PageOfRecords(given.to, given.names).run();
  return 0;
}

}  // namespace paperproof::compare
