// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/glow.h"

#include <type_traits>
#include <vector>

#include "tyndall/math/parallel_for.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

constexpr int samples_per_axis = 3;  // in each cell, to measure its power

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

Bounds3 cell_box(const Bounds3& box, size_t index) {
  constexpr size_t n = EmissionDistribution::resolution;
  const Vec3 size = box.diagonal() / static_cast<float>(n);
  const Vec3 min = box.min + size * Vec3{static_cast<float>(index % n),
                                         static_cast<float>(index / n % n),
                                         static_cast<float>(index / (n * n))};
  return {min, min + size};
}

std::optional<EmissionDistribution> measure(const Medium& medium,
                                            const Transform& world_from_grid,
                                            const Bounds3& box) {
  const Vec3 size = box.diagonal();
  if (box.is_empty() || !(size.x > 0 && size.y > 0 && size.z > 0)) return std::nullopt;
  std::vector<Rgb> means(EmissionDistribution::cell_count);
  parallel_for(means.size(), [&](size_t i) {
    means[i] =
        mean_emission(medium, world_from_grid, cell_box(box, i), RandomStream(hash(i)));
  });
  EmissionDistribution made(world_from_grid, box, means);
  if (!is_finite(made.power()) || is_black(made.power())) return std::nullopt;
  return made;
}

void extend_by_inside(Bounds3& box, const std::vector<Surface>& surfaces, int medium,
                      const Transform& world_from_surfaces) {
  for (const Surface& surface : surfaces)
    if (surface.media.is_stated && surface.media.inside == medium)
      box.extend(world_from_surfaces.bounds(bounds(surface.shape)));
}

// Of the surfaces that have the medium inside.
Bounds3 bounds_inside(const SceneDescription& description, int medium) {
  Bounds3 box;
  extend_by_inside(box, description.surfaces, medium, Transform());
  for (const ObjectInstance& instance : description.instances)
    extend_by_inside(box, description.objects[instance.object], medium,
                     instance.world_from_object);
  return box;
}

}  // namespace

std::optional<EmissionDistribution> measure_emission(const Medium& medium,
                                                     const Bounds3& box) {
  if (!medium.is_emissive()) return std::nullopt;
  return medium.visit([&](const auto& m) -> std::optional<EmissionDistribution> {
    using M = std::decay_t<decltype(m)>;
    if constexpr (std::is_same_v<M, HomogeneousMedium>)
      return measure(medium, Transform(), box);
    else if constexpr (std::is_same_v<M, OverlappingMedia>)
      return std::nullopt;  // its parts emit
    else
      return measure(medium, m.placement().world_from_grid(), m.placement().box());
  });
}

std::optional<VolumeLight> make_volume_light(const SceneDescription& description) {
  std::vector<EmissionDistribution> parts;
  for (size_t i = 0; i < description.media.size(); ++i) {
    const Medium& medium = description.media[i];
    const Bounds3 box = medium.is_emissive() && medium.is_homogeneous()
                            ? bounds_inside(description, static_cast<int>(i))
                            : Bounds3();
    if (std::optional<EmissionDistribution> part = measure_emission(medium, box))
      parts.push_back(std::move(*part));
  }
  if (parts.empty()) return std::nullopt;
  return VolumeLight(std::move(parts));
}

}  // namespace tyndall
