// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tyndall/math/vec.h"
#include "tyndall/media/phase_sample.h"

namespace tyndall {

/// A phase function measured or computed elsewhere: values at equidistant cosines of the
/// deflection from -1 (straight back) to 1 (straight on), linear in between. Copies share
/// the table.
class TabulatedPhase {
 public:
  /// The values need not be normalised. Precondition: at least two, finite, none negative,
  /// not all zero.
  explicit TabulatedPhase(std::span<const float> values);

  /// p(wo, wi) [1/sr]; integrates to one over all wi.
  float eval(Vec3 wo, Vec3 wi) const;
  float pdf(Vec3 wo, Vec3 wi) const { return eval(wo, wi); }
  /// Draws wi in proportion to eval(). Never empty.
  std::optional<PhaseSample> sample(Vec3 wo, Vec2 u) const;
  float mean_cosine() const { return table_->mean_cosine; }

 private:
  struct Table {
    std::vector<float> values;  // density of the cosine
    std::vector<float> cdf;     // up to each node
    float mean_cosine;
  };

  float density(float cos_theta) const;

  std::shared_ptr<const Table> table_;
};

}  // namespace tyndall
