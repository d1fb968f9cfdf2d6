// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/transform.h"

namespace tyndall {

/// How a point appears through one point of the lens.
struct CameraView {
  Ray ray;         ///< the camera's, out of the lens
  float distance;  ///< to the point along it [scene units]
  Vec2 p_film;     ///< where PerspectiveCamera::ray() gets this ray from [pixels]
};

/// pbrt's perspective camera: looks along +z of its own left-handed space.
class PerspectiveCamera {
 public:
  struct Settings {
    Transform world_from_camera;
    float fov = 90;  ///< of the shorter side, or of the screen window's unit [degrees]
    float screen_min_x = -1, screen_max_x = 1, screen_min_y = -1, screen_max_y = 1;
    float lens_radius = 0;        ///< zero: a pinhole [scene units]
    float focal_distance = 1e6f;  ///< [scene units]
  };

  PerspectiveCamera() : PerspectiveCamera(Settings{}, Vec2i{1, 1}) {}
  PerspectiveCamera(const Settings& settings, Vec2i resolution);

  /// The ray through `p_film` [pixels, (0, 0) at the top left corner of the full picture].
  Ray ray(Vec2 p_film, Vec2 u_lens) const;
  /// The ray of the same `u_lens` that goes through `p`. Empty if p is not in front of the
  /// camera.
  std::optional<CameraView> view(Vec3 p, Vec2 u_lens) const;
  /// The pixels that rays out of one point of the lens fill, per solid angle around the
  /// unit direction `w` of such a ray [1/sr].
  float pixels_per_solid_angle(Vec3 w) const;
  Vec3 position() const { return position_; }
  Vec2i resolution() const { return resolution_; }  ///< of the full picture [pixels]
  const Settings& settings() const { return settings_; }
  /// For image metadata, rows of column-vector matrices.
  Transform camera_from_world() const;
  Transform ndc_from_world() const;

 private:
  Vec3 on_lens(Vec2 u_lens) const;  // in camera space

  Settings settings_;
  Transform camera_from_world_;
  Vec2i resolution_;
  Vec3 position_;
  float tan_half_fov_;
  float pixels_;  // per solid angle, straight ahead
};

}  // namespace tyndall
