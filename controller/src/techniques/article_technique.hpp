/// A technique of the article behind the common interface.
#pragma once

#include "techniques/article_response.hpp"

namespace paperproof::article {

/// @tparam kind names the technique. @tparam search as for `move`.
template <class Scalar, TechniqueKind kind, ImpactSearch<Scalar> search>
class SearchingTechnique final : public Technique<Scalar> {
 public:
  SearchingTechnique(const TechniqueDef& def, const Scenery<Scalar>& scenery, const CharacterDef& character)
      : parts_(def, scenery, character) {}

  [[nodiscard]] std::string_view name() const noexcept override { return name_of(kind); }
  [[nodiscard]] Scratch<Scalar> make_scratch() const override { return parts_.make_scratch(); }

  void move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
            MoveResult<Scalar>& result) const noexcept override {
    if (refuse(parts_, kind != TechniqueKind::speculative, request, result)) return;
    article::move(parts_, search, request, scratch, result);
  }

 private:
  Parts<Scalar> parts_;
};

}  // namespace paperproof::article
