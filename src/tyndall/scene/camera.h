// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/geometry/ray.h"
#include "tyndall/math/transform.h"

namespace tyndall {

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
  Vec3 position() const { return position_; }
  Vec2i resolution() const { return resolution_; }  ///< of the full picture [pixels]
  const Settings& settings() const { return settings_; }
  /// For image metadata, rows of column-vector matrices.
  Transform camera_from_world() const;
  Transform ndc_from_world() const;

 private:
  Settings settings_;
  Vec2i resolution_;
  Vec3 position_;
  float tan_half_fov_;
};

}  // namespace tyndall
