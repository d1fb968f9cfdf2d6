// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "tyndall/materials/bsdf.h"

namespace tyndall {

/// A rough material and a direction to look at it from, in the frame z = normal.
struct BsdfCase {
  std::string name;
  Material material;
  float cosine;  ///< of wo

  Vec3 wo() const { return spherical_direction(cosine, 0.4f); }
  Bsdf bsdf() const { return Bsdf(material, {0, 0, 1}, {0, 0, 1}); }
};

inline void PrintTo(const BsdfCase& c, std::ostream* out) { *out << c.name; }

/// Every rough material from straight above to grazing, from outside and from inside.
inline std::vector<BsdfCase> bsdf_cases() {
  const Rgb gold_eta(0.14f, 0.37f, 1.44f), gold_k(3.98f, 2.38f, 1.6f);
  const std::vector<std::pair<std::string, Material>> materials{
      {"diffuse", DiffuseBsdf{Rgb(0.8f, 0.5f, 0.1f)}},
      {"gold", ConductorBsdf{gold_eta, gold_k, 0.3f, 0.3f}},
      {"brushed_gold", ConductorBsdf{gold_eta, gold_k, 0.15f, 0.7f}},
      {"rough_gold", ConductorBsdf{gold_eta, gold_k, 1, 1}},
      {"glass", DielectricBsdf{1.5f, 0.3f, 0.3f}},
      {"rough_glass", DielectricBsdf{1.5f, 1, 1}},
      {"bubble", DielectricBsdf{1 / 1.33f, 0.2f, 0.4f}}};
  std::vector<BsdfCase> cases;
  for (const auto& [name, material] : materials)
    for (const auto& [angle, cosine] : {std::pair{"above", 1.0f},
                                        {"aslant", 0.6f},
                                        {"grazing", 0.03f},
                                        {"behind", -0.7f}})
      cases.push_back({name + "_" + angle, material, cosine});
  return cases;
}

}  // namespace tyndall
