// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tyndall {

class Scene;
struct Vec3;

/// What surrounds the camera, and what to tell the user of it.
struct CameraMediumFinding {
  std::vector<int> media;  ///< indices; empty in empty space, several where media overlap
  std::string remark;      ///< empty if all agrees
};

/// The media that light at `p` is in, as most directions have it: those that it has to
/// leave, on the way out, without having entered them. Only surfaces that state their media
/// tell. Directions without one speak for `otherwise`; those that end at a surface which
/// states none know only of what they met before it.
CameraMediumFinding find_media(const Scene& scene, Vec3 p, std::vector<int> otherwise);

/// The media of the camera; `stated` is what the scene file said. What the camera looks at
/// counts twice. So a file that names the camera's medium too late, or not at all, renders
/// as its geometry means it.
CameraMediumFinding find_camera_medium(const Scene& scene, int stated);

}  // namespace tyndall
