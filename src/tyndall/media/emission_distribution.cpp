// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/emission_distribution.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "tyndall/math/constants.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

constexpr int resolution = 32;       // cells along an axis
constexpr int samples_per_axis = 3;  // in each cell, to measure its power
// Of the mean power that a cell has at least where the medium may emit between the samples.
constexpr float smallest_share = 0.02f;

float volume_scale(const Transform& map) {
  return std::abs(
      dot(map.vector({1, 0, 0}), cross(map.vector({0, 1, 0}), map.vector({0, 0, 1}))));
}

Vec3i cell_at(size_t index) {
  constexpr size_t n = resolution;
  return {static_cast<int>(index % n), static_cast<int>(index / n % n),
          static_cast<int>(index / (n * n))};
}

// The mean of sigma_a Le over jittered points of a box in grid space.
Rgb mean_emission(const Medium& medium, const Transform& world_from_grid,
                  const Bounds3& box, RandomStream rng) {
  Rgb sum;
  for (int z = 0; z < samples_per_axis; ++z)
    for (int y = 0; y < samples_per_axis; ++y)
      for (int x = 0; x < samples_per_axis; ++x) {
        const auto jitter = [&](int i) {
          return (static_cast<float>(i) + rng.next_1d()) / samples_per_axis;
        };
        const Vec3 u{jitter(x), jitter(y), jitter(z)};
        const MediumProperties at =
            medium.at(world_from_grid.point(box.min + box.diagonal() * u));
        sum += at.sigma_a * at.Le;
      }
  return sum / static_cast<float>(samples_per_axis * samples_per_axis * samples_per_axis);
}

}  // namespace

std::optional<EmissionDistribution> EmissionDistribution::make(const Medium& medium) {
  if (!medium.is_emissive()) return std::nullopt;
  return medium.visit([&](const auto& m) -> std::optional<EmissionDistribution> {
    if constexpr (!std::is_same_v<std::decay_t<decltype(m)>, HomogeneousMedium>) {
      if (m.grid_box().is_empty()) return std::nullopt;
      EmissionDistribution made(medium, m.world_from_grid(), m.grid_box());
      if (!is_black(made.power())) return made;
    }
    return std::nullopt;
  });
}

EmissionDistribution::EmissionDistribution(const Medium& medium,
                                           const Transform& world_from_grid,
                                           const Bounds3& box)
    : world_from_grid_(world_from_grid), space_(world_from_grid.inverse()), box_(box) {
  constexpr size_t count = size_t{resolution} * resolution * resolution;
  const Vec3 size = cell_box(0).diagonal();
  volume_ = size.x * size.y * size.z * volume_scale(world_from_grid);
  std::vector<Rgb> means(count);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    means[i] = mean_emission(medium, world_from_grid, cell_box(i), RandomStream(hash(i)));
  });
  std::vector<float> weights(count);
  double sum = 0;
  for (size_t i = 0; i < count; ++i) {
    power_ += means[i] * (4 * pi * volume_);
    weights[i] = average(means[i]);
    sum += double{weights[i]};
  }
  const float least = smallest_share * static_cast<float>(sum / static_cast<double>(count));
  for (float& w : weights) w = std::max(w, least);
  cells_ = DiscreteDistribution(weights);
}

Bounds3 EmissionDistribution::cell_box(size_t index) const {
  const Vec3i c = cell_at(index);
  const Vec3 size = box_.diagonal() / static_cast<float>(resolution);
  const Vec3 min = box_.min + size * Vec3{static_cast<float>(c.x), static_cast<float>(c.y),
                                          static_cast<float>(c.z)};
  return {min, min + size};
}

EmissionDistribution::Sample EmissionDistribution::sample(float u_cell, Vec3 u) const {
  const DiscreteSample cell = cells_.sample(u_cell);
  const Bounds3 box = cell_box(cell.index);
  return {.p = world_from_grid_.point(box.min + box.diagonal() * u),
          .pdf_volume = cell.probability / volume_};
}

float EmissionDistribution::pdf_volume(Vec3 p) const {
  const Vec3 p_grid = space_.point(p);
  if (!box_.contains(p_grid)) return 0;
  const auto cell = [&](int axis) {
    const float x = (p_grid[axis] - box_.min[axis]) / (box_.max[axis] - box_.min[axis]);
    return static_cast<size_t>(
        std::clamp(static_cast<int>(x * resolution), 0, resolution - 1));
  };
  return cells_.probability((cell(2) * resolution + cell(1)) * resolution + cell(0)) /
         volume_;
}

}  // namespace tyndall
