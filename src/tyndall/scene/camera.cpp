// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/camera.h"

#include <cmath>

#include "tyndall/sampling/warps.h"

namespace tyndall {

PerspectiveCamera::PerspectiveCamera(const Settings& settings, Vec2i resolution)
    : settings_(settings),
      resolution_(resolution),
      position_(settings.world_from_camera.point({0, 0, 0})),
      tan_half_fov_(std::tan(radians(settings.fov) / 2)) {}

Ray PerspectiveCamera::ray(Vec2 p_film, Vec2 u_lens) const {
  const float x = p_film.x / static_cast<float>(resolution_.x);
  const float y = p_film.y / static_cast<float>(resolution_.y);
  // Film rows run downwards, screen space upwards.
  const Vec3 on_screen{std::lerp(settings_.screen_min_x, settings_.screen_max_x, x),
                       std::lerp(settings_.screen_max_y, settings_.screen_min_y, y), 1};
  Vec3 origin{};
  Vec3 direction{on_screen.x * tan_half_fov_, on_screen.y * tan_half_fov_, 1};
  if (settings_.lens_radius > 0) {
    const Vec2 lens = sample_concentric_disk(u_lens);
    const Vec3 focus = direction * settings_.focal_distance;
    origin = {settings_.lens_radius * lens.x, settings_.lens_radius * lens.y, 0};
    direction = focus - origin;
  }
  const Transform& to_world = settings_.world_from_camera;
  return {to_world.point(origin), normalize(to_world.vector(direction))};
}

Transform PerspectiveCamera::camera_from_world() const {
  return settings_.world_from_camera.inverse();
}

Transform PerspectiveCamera::ndc_from_world() const {
  constexpr float near = 1e-2f, far = 1000;
  const float inv_tan = 1 / tan_half_fov_;
  const float width = settings_.screen_max_x - settings_.screen_min_x;
  const float height = settings_.screen_max_y - settings_.screen_min_y;
  // Screen coordinates scaled to [0, 1], y downwards, depth to [0, 1].
  const Matrix4 ndc_from_camera{{{inv_tan / width, 0, -settings_.screen_min_x / width, 0},
                                 {0, -inv_tan / height, settings_.screen_max_y / height, 0},
                                 {0, 0, far / (far - near), -far * near / (far - near)},
                                 {0, 0, 1, 0}}};
  const std::optional<Transform> projection = Transform::from_matrix(ndc_from_camera);
  assert(projection);
  return *projection * camera_from_world();
}

}  // namespace tyndall
