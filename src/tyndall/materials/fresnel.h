// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/math/vec.h"

namespace tyndall {

/// The share of unpolarized light that a smooth boundary reflects, from Fresnel's
/// equations. `cos_i` is the cosine to the normal; if negative, the light comes from
/// inside. `eta` is the index inside over the index outside. One beyond the critical angle.
float dielectric_fresnel(float cos_i, float eta);

/// The same for a metal with the complex index eta + i k, seen from outside: 0 <= cos_i
/// <= 1.
float conductor_fresnel(float cos_i, float eta, float k);

/// A refracted direction.
struct Refraction {
  Vec3 wi;    ///< unit, on the other side of the normal
  float eta;  ///< index on the side of wi over the index on the side of wo
};

/// Snell's law. `wo` points away from the surface with unit normal `n`, behind which the
/// index is `eta` times that in front. Empty beyond the critical angle.
std::optional<Refraction> refract(Vec3 wo, Vec3 n, float eta);

}  // namespace tyndall
