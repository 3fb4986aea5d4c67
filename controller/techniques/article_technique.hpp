/// A technique of the article behind the common interface.
#pragma once

#include "techniques/article_response.hpp"
#include "techniques/knobs.hpp"

#include <string_view>

namespace paperproof::article {

/// @tparam search as for `move`. @tparam by_units it searches by units, and refuses a movement of too many.
template <ImpactSearch search, bool by_units>
class SearchingTechnique final : public Technique {
 public:
  SearchingTechnique(const TechniqueDef& def, const Scenery& scenery, const CharacterDef& character)
      : name_(find_technique(def.name)->name), parts_(def, scenery, character) {}

  [[nodiscard]] std::string_view name() const noexcept override { return name_; }
  [[nodiscard]] Scratch make_scratch() const override { return parts_.make_scratch(); }

  void move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept override {
    if (refuse(parts_, by_units, request, result)) return;
    article::move(parts_, search, request, scratch, result);
  }

 private:
  std::string_view name_;
  Parts parts_;
};

template <class Made>
[[nodiscard]] TechniqueEntry entry_of_search(std::string_view name) {
  TechniqueEntry entry = entry_of<Made>(name, knob::of_search());
  entry.knows_movers = true;
  entry.unit = knob::unit_of_search;
  return entry;
}

}  // namespace paperproof::article
