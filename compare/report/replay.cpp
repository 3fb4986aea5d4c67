#include "report/replay.hpp"

#include "records/trace_writer.hpp"
#include "report/json_text.hpp"

#include <zlib.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

std::string_view name_of(ReportEvent::Kind kind) {
  constexpr auto names = std::to_array<std::string_view>(
      {"tunnel", "clipped", "inside", "one-way broken", "hanging", "crush", "drop", "sensor", "note"});
  static_assert(names.size() == static_cast<std::size_t>(ReportEvent::Kind::note) + 1);
  return names[static_cast<std::size_t>(kind)];
}

ordered_json notes_on(const ReportRun& run) {
  ordered_json notes{{"every", run.every}, {"events", ordered_json::array()}};
  for (const ReportEvent& event : run.events) {
    ordered_json one{{"step", event.step}, {"kind", name_of(event.kind)}, {"words", event.words}};
    if (event.character != 0) one["character"] = event.character;
    if (event.collider) one["collider"] = run.header.ids[*event.collider];
    notes["events"].push_back(std::move(one));
  }
  return notes;
}

ordered_json notes_on(const Disagreement& disagreement, const std::vector<ReportRun>& runs) {
  ordered_json notes{{"step", disagreement.step}, {"who_is_right", disagreement.who_is_right}};
  notes["statements"] = ordered_json::array();
  for (const auto& [run, record] : disagreement.statements)
    if (run < runs.size())
      notes["statements"].push_back(
          {{"run", run}, {"record", ordered_json::parse(TraceLines(runs[run].header).line_of(record))}});
  return notes;
}

ordered_json notes_on(const ReportScene& scene, std::size_t most_disagreements) {
  ordered_json notes{{"dt_list", scene.dt_list}, {"disagreements_in_all", scene.disagreements.size()}};
  notes["disagreements"] = notes["runs"] = ordered_json::array();
  for (std::size_t i = 0; i < std::min(scene.disagreements.size(), most_disagreements); ++i)
    notes["disagreements"].push_back(notes_on(scene.disagreements[i], scene.runs));
  for (const ReportRun& run : scene.runs) notes["runs"].push_back(notes_on(run));
  return notes;
}

std::string gzipped(std::string_view text) {
  z_stream stream{};
  constexpr int gzip = 16;  // added to the size of the window
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + gzip, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib cannot be set up");
  std::string bytes(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  const int status = deflate(&stream, Z_FINISH);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib cannot pack a replay");
  return bytes;
}

std::string in_base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U; };
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned bits = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    for (const unsigned shift : {18U, 12U, 6U, 0U}) text += digits[bits >> shift & 63U];
  }
  for (std::size_t i = 0; i < (3 - bytes.size() % 3) % 3; ++i) text[text.size() - 1 - i] = '=';
  return text;
}

}  // namespace

std::string replay_lines(const ReportScene& scene, std::size_t most_disagreements) {
  std::string text = dumped(notes_on(scene, most_disagreements)) + '\n';
  std::vector<std::string> sceneries;
  for (const ReportRun& run : scene.runs) {
    std::string colliders = colliders_in_json(run.header);
    const auto known = std::find(sceneries.begin(), sceneries.end(), colliders);
    const auto number = std::to_string(known - sceneries.begin());
    if (known == sceneries.end()) text += sceneries.emplace_back(std::move(colliders)) + '\n';
    const TraceLines lines(run.header);
    text += lines.header_line(run.header, number);
    for (std::size_t i = 0; i < run.steps.size(); ++i) {
      text += lines.line_of(run.steps[i]);
      for (const std::vector<TraceStep>& steps : run.others) text += lines.line_of(steps[i]);
    }
  }
  return text;
}

std::string packed(std::string_view text) { return '"' + in_base64(gzipped(text)) + '"'; }

std::string replay_json(const ReportScene& scene, std::size_t most_disagreements) {
  return scene.runs.empty() ? "null" : packed(replay_lines(scene, most_disagreements));
}

}  // namespace paperproof::compare
