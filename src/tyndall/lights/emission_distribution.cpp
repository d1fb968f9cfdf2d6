// SPDX-License-Identifier: Apache-2.0
#include "tyndall/lights/emission_distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "tyndall/math/constants.h"
#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

// Of the mean power that a cell has at least where the volume may emit between the samples.
constexpr float smallest_share = 0.02f;

constexpr float side = EmissionDistribution::resolution;
constexpr Bounds3 all_cells{{0, 0, 0}, {side, side, side}};

float volume_scale(const Transform& map) {
  return std::abs(
      dot(map.vector({1, 0, 0}), cross(map.vector({0, 1, 0}), map.vector({0, 0, 1}))));
}

Vec3 cell_corner(size_t index) {
  constexpr size_t n = EmissionDistribution::resolution;
  return {static_cast<float>(index % n), static_cast<float>(index / n % n),
          static_cast<float>(index / (n * n))};
}

}  // namespace

EmissionDistribution::EmissionDistribution(const Transform& world_from_grid,
                                           const Bounds3& box, std::span<const Rgb> means)
    : world_from_cells_(world_from_grid * Transform::translate(box.min) *
                        Transform::scale(box.diagonal() / side)),
      space_(world_from_cells_.inverse()),
      volume_(volume_scale(world_from_cells_)) {
  assert(means.size() == cell_count);
  std::vector<float> weights;
  weights.reserve(means.size());
  double sum = 0, channels[3] = {0, 0, 0};
  for (const Rgb& mean : means) {
    for (int c = 0; c < 3; ++c) channels[c] += double{mean[c]};
    weights.push_back(average(mean));
    sum += double{weights.back()};
  }
  for (int c = 0; c < 3; ++c)
    power_[c] = 4 * pi * volume_ * static_cast<float>(channels[c]);
  const auto least = static_cast<float>(double{smallest_share} * sum / double{cell_count});
  for (float& w : weights) w = std::max(w, least);
  cells_ = DiscreteDistribution(weights);
}

Bounds3 EmissionDistribution::bounds() const { return world_from_cells_.bounds(all_cells); }

EmissionDistribution::Sample EmissionDistribution::sample(float u_cell, Vec3 u) const {
  const DiscreteSample cell = cells_.sample(u_cell);
  return {.p = world_from_cells_.point(cell_corner(cell.index) + u),
          .pdf_volume = cell.probability / volume_};
}

float EmissionDistribution::pdf_volume(Vec3 p) const {
  const Vec3 p_cells = space_.point(p);
  if (!all_cells.contains(p_cells)) return 0;
  const auto cell = [&](int axis) {
    return static_cast<size_t>(std::min(static_cast<int>(p_cells[axis]), resolution - 1));
  };
  return cells_.probability((cell(2) * resolution + cell(1)) * resolution + cell(0)) /
         volume_;
}

// A solid angle has the volume t^2 dt at distance t.
float EmissionDistribution::pdf_direction(Vec3 p, Vec3 w) const {
  const auto clip = space_.clip({p, w}, infinity, all_cells);
  if (!clip) return 0;
  CellWalk walk({resolution, resolution, resolution}, 1, clip->ray, 0, clip->length);
  CellWalk::Step step;
  float sum = 0;
  while (walk.next(step)) {
    const float t0 = clip->t_offset + step.t_min, t1 = clip->t_offset + step.t_max;
    sum += cells_.probability(step.cell) * (step.t_max - step.t_min) *
           (sqr(t0) + t0 * t1 + sqr(t1));
  }
  return sum / (3 * volume_);
}

}  // namespace tyndall
