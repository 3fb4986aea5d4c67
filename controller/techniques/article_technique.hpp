/// A technique of the article behind the common interface.
#pragma once

#include "techniques/article_response.hpp"

#include <string_view>

namespace paperproof::article {

/// @tparam search as for `move`.
template <class Scalar, ImpactSearch<Scalar> search>
class SearchingTechnique final : public Technique<Scalar> {
 public:
  /// @param by_units it searches by units, and refuses a movement of too many.
  SearchingTechnique(bool by_units, const TechniqueDef& def, const Scenery<Scalar>& scenery,
                     const CharacterDef& character)
      : name_(find_technique(def.name)->name), by_units_(by_units), parts_(def, scenery, character) {}

  [[nodiscard]] std::string_view name() const noexcept override { return name_; }
  [[nodiscard]] Scratch<Scalar> make_scratch() const override { return parts_.make_scratch(); }

  void move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
            MoveResult<Scalar>& result) const noexcept override {
    if (refuse(parts_, by_units_, request, result)) return;
    article::move(parts_, search, request, scratch, result);
  }

 private:
  std::string_view name_;
  bool by_units_;
  Parts<Scalar> parts_;
};

}  // namespace paperproof::article
