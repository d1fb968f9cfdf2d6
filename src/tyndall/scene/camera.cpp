// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/camera.h"

#include <cmath>

#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

float determinant(const Transform& t) {
  return dot(cross(t.vector({1, 0, 0}), t.vector({0, 1, 0})), t.vector({0, 0, 1}));
}

}  // namespace

PerspectiveCamera::PerspectiveCamera(const Settings& settings, Vec2i resolution)
    : settings_(settings),
      camera_from_world_(settings.world_from_camera.inverse()),
      resolution_(resolution),
      position_(settings.world_from_camera.point({0, 0, 0})),
      tan_half_fov_(std::tan(radians(settings.fov) / 2)) {
  const float screen = (settings.screen_max_x - settings.screen_min_x) *
                       (settings.screen_max_y - settings.screen_min_y);
  pixels_ =
      static_cast<float>(resolution.x) * static_cast<float>(resolution.y) /
      (screen * sqr(tan_half_fov_) * std::abs(determinant(settings.world_from_camera)));
}

Vec3 PerspectiveCamera::on_lens(Vec2 u_lens) const {
  if (!(settings_.lens_radius > 0)) return {};
  const Vec2 lens = sample_concentric_disk(u_lens);
  return {settings_.lens_radius * lens.x, settings_.lens_radius * lens.y, 0};
}

Ray PerspectiveCamera::ray(Vec2 p_film, Vec2 u_lens) const {
  const float x = p_film.x / static_cast<float>(resolution_.x);
  const float y = p_film.y / static_cast<float>(resolution_.y);
  // Film rows run downwards, screen space upwards.
  const Vec3 on_screen{std::lerp(settings_.screen_min_x, settings_.screen_max_x, x),
                       std::lerp(settings_.screen_max_y, settings_.screen_min_y, y), 1};
  const Vec3 origin = on_lens(u_lens);
  Vec3 direction{on_screen.x * tan_half_fov_, on_screen.y * tan_half_fov_, 1};
  if (settings_.lens_radius > 0) direction = direction * settings_.focal_distance - origin;
  const Transform& to_world = settings_.world_from_camera;
  return {to_world.point(origin), normalize(to_world.vector(direction))};
}

std::optional<CameraView> PerspectiveCamera::view(Vec3 p, Vec2 u_lens) const {
  const Vec3 origin = on_lens(u_lens);
  const Vec3 direction = camera_from_world_.point(p) - origin;
  if (!(direction.z > 0)) return std::nullopt;
  // Where the ray meets the plane in focus, brought to the distance one.
  const Vec3 on_plane = origin / settings_.focal_distance + direction / direction.z;
  const auto along = [](float x, float from, float to) { return (x - from) / (to - from); };
  const float x =
      along(on_plane.x / tan_half_fov_, settings_.screen_min_x, settings_.screen_max_x);
  const float y =
      along(on_plane.y / tan_half_fov_, settings_.screen_max_y, settings_.screen_min_y);
  const Vec3 o = settings_.world_from_camera.point(origin);
  const float distance = length(p - o);
  return CameraView{.ray = {o, (p - o) / distance},
                    .distance = distance,
                    .p_film = {x * static_cast<float>(resolution_.x),
                               y * static_cast<float>(resolution_.y)}};
}

// A stretch of film at distance one, under an angle of cosine c, fills a solid angle of c^3
// times its area. A transform that maps unit vectors u to M u stretches solid angles by
// |det M| / |M u|^3, and v = M^-1 w has the length 1 / |M u|: v.z is c / |M u|.
float PerspectiveCamera::pixels_per_solid_angle(Vec3 w) const {
  const float z = camera_from_world_.vector(w).z;
  return pixels_ / (z * z * z);
}

Transform PerspectiveCamera::camera_from_world() const { return camera_from_world_; }

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
