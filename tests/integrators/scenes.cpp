// SPDX-License-Identifier: Apache-2.0
#include "scenes.h"

#include "support/surfaces.h"
#include "tyndall/integrators/path_tracer.h"

namespace tyndall::test {

Medium grey_fog(float sigma_s, float sigma_a, float g) {
  const MediumProperties properties{Rgb(sigma_a), Rgb(sigma_s), Rgb(0)};
  return Medium(HomogeneousMedium(properties, g == 0 ? PhaseFunction(IsotropicPhase{})
                                                     : PhaseFunction(HenyeyGreenstein(g))));
}

Medium constant_grid(float sigma_s, float sigma_a, float g, float size,
                     const Transform& world_from_medium) {
  // The interpolant falls to zero at the border, so the grid is larger than what is used of
  // it.
  constexpr int n = 12;
  DensityGrid grid{{n, n, n}, std::vector<float>(n * n * n, 1.0f)};
  const float half = size * n / (n - 4);
  const MediumProperties properties{Rgb(sigma_a), Rgb(sigma_s), Rgb(0)};
  return Medium(GridMedium(
      std::move(grid), Bounds3{{-half, -half, -half}, {half, half, half}},
      world_from_medium, properties,
      g == 0 ? PhaseFunction(IsotropicPhase{}) : PhaseFunction(HenyeyGreenstein(g))));
}

Surface boundary_sphere(float radius, Vec3 center, int inside, int outside) {
  return sphere_boundary(center, radius, inside, outside);
}

Surface diffuse_disk(float z, float radius, float reflectance) {
  return {.shape = Disk{.world_from_disk = Transform(),
                        .height = z,
                        .radius = radius,
                        .inner_radius = 0,
                        .phi_max = 2 * pi,
                        .flip_normals = true},
          .material = DiffuseBsdf{Rgb(reflectance)},
          .media = {},
          .emission = std::nullopt,
          .name = "disk"};
}

Surface boundary_box(float size, int inside, int outside) {
  return box_boundary({-size, -size, -size}, {size, size, size}, inside, outside);
}

PerspectiveCamera camera(Vec3 eye, Vec3 at, float fov, Vec2i resolution) {
  PerspectiveCamera::Settings s;
  s.world_from_camera = Transform::look_at(eye, at, {0, 1, 0})->inverse();
  s.fov = fov;
  return {s, resolution};
}

RenderSettings settings(const std::string& integrator, int max_depth,
                        ScatteringOrders orders) {
  RenderSettings s;
  s.integrator = integrator;
  s.max_depth = max_depth;
  s.orders = orders;
  s.resolution = {16, 16};
  s.crop_max = {16, 16};
  s.sampler = SamplerKind::independent;
  return s;
}

RunningMoments estimate(const Scene& scene, const RenderSettings& settings, int count,
                        const std::function<Ray(Sampler&)>& make_ray) {
  return estimate(*make_integrator(scene, settings), settings, count, make_ray);
}

RunningMoments estimate(Integrator& integrator, const RenderSettings& settings, int count,
                        const std::function<Ray(Sampler&)>& make_ray) {
  RunningMoments moments;
  uint32_t allowed = 0;
  for (uint32_t i = 0; i < static_cast<uint32_t>(count); ++i) {
    if (i >= allowed) allowed = integrator.prepare(i, {});
    Sampler sampler(settings.sampler, settings.seed, {0, 0}, i);
    const Ray ray = make_ray(sampler);
    moments.add(double{integrator.Li(ray, sampler).L.r});
  }
  return moments;
}

RunningMoments estimate(const Scene& scene, const ConnectionSettings& connections,
                        uint64_t seed, int count, Vec3 from, float z) {
  RenderSettings settings = test::settings("learned", 3);
  settings.seed = seed;
  PathTracer tracer(scene, settings, connections);
  return estimate(tracer, settings, count, [&](Sampler& sampler) {
    const Vec2 u = sampler.next_2d();
    return Ray{from, normalize(Vec3{u.x - 0.5f, 0.6f * u.y - 0.4f, z})};
  });
}

ConnectionSettings with_visibility(std::shared_ptr<const LightVisibility> visibility) {
  return {.single = true,
          .dual = true,
          .min_distance_ratio = 1,
          .visibility = true,
          .known_visibility = std::move(visibility)};
}

}  // namespace tyndall::test
