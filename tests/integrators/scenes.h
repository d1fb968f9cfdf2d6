// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "tyndall/integrators/connection_settings.h"
#include "tyndall/integrators/integrator.h"
#include "tyndall/integrators/render.h"
#include "tyndall/math/statistics.h"

namespace tyndall::test {

/// A grey medium without emission.
Medium grey_fog(float sigma_s, float sigma_a, float g = 0);
/// The same medium as a grid of constant density over a box [-size, size]^3, under a
/// transform.
Medium constant_grid(float sigma_s, float sigma_a, float g, float size,
                     const Transform& world_from_medium = {});

/// A full sphere that is only the boundary between medium 0 inside and nothing outside.
Surface boundary_sphere(float radius, Vec3 center = {}, int inside = 0,
                        int outside = no_medium);
/// A diffuse disk of the given reflectance, facing -z, at height z.
Surface diffuse_disk(float z, float radius, float reflectance);
/// A box boundary of half-width `size` around the origin.
Surface boundary_box(float size, int inside = 0, int outside = no_medium);

/// A camera at `eye` that looks at `at`.
PerspectiveCamera camera(Vec3 eye, Vec3 at, float fov = 40, Vec2i resolution = {16, 16});

RenderSettings settings(const std::string& integrator, int max_depth,
                        ScatteringOrders orders = {});

/// Moments of the red channel of Li over `count` samples of rays made by `make_ray` from
/// uniform numbers.
RunningMoments estimate(const Scene& scene, const RenderSettings& settings, int count,
                        const std::function<Ray(Sampler&)>& make_ray);

/// The same of an integrator.
RunningMoments estimate(Integrator& integrator, const RenderSettings& settings, int count,
                        const std::function<Ray(Sampler&)>& make_ray);

/// The same of "learned" with these connections, orders up to three, for rays from `from`
/// through a window at distance `z` along the z axis.
RunningMoments estimate(const Scene& scene, const ConnectionSettings& connections,
                        uint64_t seed, int count, Vec3 from, float z);

/// Single and dual connections with predicted visibility; null: it is traced.
ConnectionSettings with_visibility(std::shared_ptr<const LightVisibility> visibility);

}  // namespace tyndall::test
