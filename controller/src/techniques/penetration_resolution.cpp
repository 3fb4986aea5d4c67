#include "techniques/penetration_resolution.hpp"

#include "techniques/article_technique.hpp"

namespace paperproof {

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make_penetration_resolution(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                               const CharacterDef& character) {
  using Made = article::SearchingTechnique<Scalar, TechniqueKind::penetration_resolution, nullptr>;
  return std::make_unique<Made>(def, scenery, character);
}

template std::unique_ptr<Technique<float>> make_penetration_resolution(const TechniqueDef&, const Scenery<float>&,
                                                                       const CharacterDef&);
template std::unique_ptr<Technique<double>> make_penetration_resolution(const TechniqueDef&, const Scenery<double>&,
                                                                        const CharacterDef&);

}  // namespace paperproof
