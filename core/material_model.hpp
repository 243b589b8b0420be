// A material with everything that its constants give, worked out once.
#pragma once

#include "core/drucker_prager.hpp"
#include "core/evolving_strength.hpp"
#include "core/scene.hpp"

#include <variant>

namespace scarp {

using AnyUpdate = std::variant<ElasticUpdate, DruckerPragerUpdate, EvolvingStrengthUpdate>;

struct MaterialModel {
  ElasticModuli moduli;
  AnyUpdate update;
  bool opens = false; ///< remembers gaps

  explicit MaterialModel(const Material& material)
      : moduli(ElasticModuli::from(material.youngs_modulus, material.poissons_ratio)) {
    if (const auto* law = std::get_if<DruckerPrager>(&material.law)) {
      if (law->evolves())
        update = EvolvingStrengthUpdate::from(*law, moduli, material.density);
      else
        update = DruckerPragerUpdate::from(*law, moduli);
      opens = law->opening == Opening::remembered;
    }
  }
};

} // namespace scarp
