// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tyndall/geometry/shape.h"
#include "tyndall/lights/light.h"
#include "tyndall/materials/bsdf.h"
#include "tyndall/math/transform.h"
#include "tyndall/media/medium.h"
#include "tyndall/scene/camera.h"

namespace tyndall {

inline constexpr int no_medium = -1;

/// The media on the two sides of a surface, by index; `inside` is behind the normal.
struct MediumInterface {
  int inside = no_medium, outside = no_medium;
  bool is_stated = false;  ///< the scene says so; otherwise light keeps the medium it is in

  bool is_transition() const { return inside != outside; }
};

/// What an area light needs beyond its shape.
struct AreaEmission {
  Rgb L;
  bool two_sided = false;
};

/// A shape with its material, media and emission.
struct Surface {
  Shape shape;
  Material material;
  MediumInterface media;
  std::optional<AreaEmission> emission;
  std::string name;  ///< for messages: "trianglemesh at scene.pbrt:12:1"
  /// The share of rays that meet the surface; the others go on as if it were not there. A
  /// lamp shines only as much. Boundaries between media are met by all.
  float alpha = 1;
};

/// A light in the shape of a surface that no ray ever meets.
struct HiddenEmitter {
  Shape shape;
  AreaEmission emission;
};

/// Surfaces that appear as often as instances name them.
struct ObjectInstance {
  size_t object;  ///< index into SceneDescription::objects
  Transform world_from_object;
};

/// Everything that a Scene is built from: plain values, filled by hand or by a loader.
struct SceneDescription {
  /// Where the origin of all coordinates here lies in the world of whoever asks for
  /// pictures [scene units]. Floats are finest around the origin: loaders put it at the
  /// camera, and what is said of places to the outside adds it.
  Vec3d world_origin;
  PerspectiveCamera camera;
  int camera_medium = no_medium;  ///< used where tracing from the camera cannot tell
  std::vector<Medium> media;
  std::vector<Surface> surfaces;
  std::vector<std::vector<Surface>> objects;
  std::vector<ObjectInstance> instances;
  std::vector<Light> lights;  ///< without area lights: those come from surfaces' emission
  std::vector<HiddenEmitter> hidden_emitters;
};

}  // namespace tyndall
