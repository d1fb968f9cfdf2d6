// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/dual_direction.h"

#include <algorithm>

#include "tyndall/integrators/direction_guiding.h"

namespace tyndall {

DualDirection dual_direction(const ConnectionContext& context, const Medium& medium, Vec3 b,
                             Vec3 w_ab, size_t light, Vec3 pivot) {
  const DirectionGuiding* guiding = context.guiding();
  return {{context.tables(medium), medium.phase()},
          b,
          w_ab,
          pivot,
          guiding ? guiding->find(b, light) : nullptr,
          guiding && guiding->has_product()};
}

DualDirection glow_direction(const ConnectionContext& context, const Medium* medium, Vec3 p,
                             Vec3 n, size_t light, Vec3 pivot) {
  const DirectionGuiding* guiding = context.guiding();
  return {context.tables_around(medium), p, n, pivot,
          guiding ? guiding->find(p, light) : nullptr};
}

DualDirection::DualDirection(const Scattering& scattering, Vec3 b, Vec3 w_ab, Vec3 pivot,
                             const DirectionGuide* guide, bool with_product)
    : joint_(scattering.tables, b, w_ab, pivot), lobe_(scattering.phase, w_ab) {
  guide_by(guide, pivot - b, with_product);
}

DualDirection::DualDirection(const ScatteringTables& tables, Vec3 b, Vec3 n, Vec3 pivot,
                             const DirectionGuide* guide)
    : joint_(tables, b, pivot), lobe_(n) {
  guide_by(guide, pivot - b, true);
}

void DualDirection::guide_by(const DirectionGuide* guide, Vec3 to_pivot,
                             bool with_product) {
  const float distance = length(to_pivot);
  const bool knows_nothing = !guide || guide->mixture.is_uniform();
  if (knows_nothing || !(distance > 0 && distance < infinity)) return;
  guide_ = guide;
  square_.emplace(guide->square(to_pivot / distance));
  mixture_ = with_product ? guide->product(*square_, lobe_.axis(), lobe_.mean_cosine())
                          : guide->mixture;
}

std::optional<DoubleDirectionSample> DualDirection::sample(Vec2 u) const {
  if (!guide_) return joint_.sample(u);
  const std::optional<Vec3> w = sample_one(u);
  if (!w) return std::nullopt;
  const float density = pdf(*w);
  if (!(density > 0 && density < infinity)) return std::nullopt;
  return DoubleDirectionSample{.w = *w, .pdf = density};
}

// From the technique that u.x chooses; what is left of u.x is uniform again.
std::optional<Vec3> DualDirection::sample_one(Vec2 u) const {
  const auto rest = [&](DirectionTechnique technique) {
    return Vec2{std::min(u.x / guide_->share(technique), one_minus_epsilon), u.y};
  };
  if (u.x < guide_->share(DirectionTechnique::mixture)) {
    const auto s = mixture_->sample(rest(DirectionTechnique::mixture));
    if (!s) return std::nullopt;
    return square_->direction(s->p).w;
  }
  u.x -= guide_->share(DirectionTechnique::mixture);
  if (u.x < guide_->share(DirectionTechnique::joint_sampling)) {
    const auto s = joint_.sample(rest(DirectionTechnique::joint_sampling));
    if (!s) return std::nullopt;
    return s->w;
  }
  u.x -= guide_->share(DirectionTechnique::joint_sampling);
  return lobe_.sample(rest(DirectionTechnique::phase));
}

float DualDirection::pdf(Vec3 w) const {
  if (!guide_) return joint_.pdf(w);
  const DirectionShares of_each = densities(w);
  float sum = 0;
  for (size_t i = 0; i < direction_techniques; ++i) sum += guide_->shares[i] * of_each[i];
  return sum;
}

DirectionShares DualDirection::densities(Vec3 w) const {
  const float joint = joint_.pdf(w), lobe = lobe_.pdf(w);
  if (!guide_) return {0, joint, lobe};
  const SquarePoint q = square_->point(w);
  return {mixture_->pdf(q.p) * q.density, joint, lobe};
}

}  // namespace tyndall
