#include "report/page_reader.hpp"

#include "records/input_file.hpp"

#include <stdexcept>

namespace paperproof::compare {
namespace {

std::string opening_of(const std::string& id) { return "<script type=\"application/json\" id=\"" + id + "\">"; }

}  // namespace

PageReader::PageReader(const std::string& path) : path_(path) {
  text_ = read_input(path, most_page_bytes);
  index_ = nlohmann::ordered_json::parse(element("index"), nullptr, false);
  if (!index_.is_object()) throw std::runtime_error(path + ": expected a page that paperproof wrote");
}

std::string PageReader::replay(std::size_t scene) const { return element("replay-" + std::to_string(scene)); }

std::string PageReader::cells(std::size_t study) const {
  const std::string id = "cells-" + std::to_string(study);
  return text_.find(opening_of(id)) == std::string::npos ? "[]" : element(id);
}

std::string PageReader::element(const std::string& id) const {
  const std::string opening = opening_of(id);
  const std::size_t begin = text_.find(opening);
  if (begin == std::string::npos) throw std::runtime_error(path_ + ": expected a page that paperproof wrote");
  const std::size_t from = begin + opening.size();
  std::string json = text_.substr(from, text_.find("</script>", from) - from);
  // No page of today has this key; pages from before replays were traces do.
  if (json.find("\"quantum\":") != std::string::npos)
    throw std::runtime_error(path_ + ": expected a page whose replays are traces; an older paperproof wrote it");
  return json;
}

}  // namespace paperproof::compare
