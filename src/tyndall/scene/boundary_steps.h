// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <optional>
#include <utility>

#include "tyndall/geometry/ray.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// From one medium to another, by index, through a surface that states both.
struct BoundaryStep {
  float t;  ///< along the ray [scene units]
  int from, to;
  const Surface* surface;
};

/// What a surface says of light that crosses it; empty if nothing.
std::optional<BoundaryStep> step_across(const SurfaceCrossing& crossing);

/// The steps of a ray through boundaries, in the order in which they make sense where
/// boundaries touch or coincide.
class BoundarySteps {
 public:
  /// Of a ray that ends at t_end. Boundaries that coincide with the end are not crossed:
  /// what stands on a boundary is in the medium before it.
  BoundarySteps(const Ray& ray, float t_end);

  /// To be called in the order of distances.
  void add(const SurfaceCrossing& crossing);

  /// The next step, null after the last; valid until the next call. Of several in the same
  /// place, one that leaves a medium that light is in comes first, then those that only
  /// enter; is_in(index) tells which media those are.
  template <typename F>
  const BoundaryStep* next(const F& is_in) {
    if (next_ == steps_.size()) return nullptr;
    const auto rank = [&](const BoundaryStep& step) {
      return step.from == no_medium ? 1 : is_in(step.from) ? 0 : 2;
    };
    size_t best = next_;
    for (size_t i = next_ + 1; i < steps_.size() && are_together(steps_[next_], steps_[i]);
         ++i)
      if (rank(steps_[i]) < rank(steps_[best])) best = i;
    if (best != next_) std::swap(steps_[next_], steps_[best]);
    return &steps_[next_++];
  }

 private:
  float tolerance(float t) const { return 1e-6f * (t + size_); }
  bool are_together(const BoundaryStep& a, const BoundaryStep& b) const {
    return b.t - a.t <= tolerance(b.t);
  }

  float size_;  // of the numbers that distances come from
  float t_end_;
  boost::container::small_vector<BoundaryStep, 4> steps_;
  size_t next_ = 0;
};

}  // namespace tyndall
