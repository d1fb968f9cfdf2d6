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

/// The media that light at `p` is in, as most directions have it; those in which no surface
/// tells speak for `otherwise`.
CameraMediumFinding find_media(const Scene& scene, Vec3 p, std::vector<int> otherwise);

/// Asks the surfaces that state their media, in many directions, in which media light is
/// that arrives at the camera: those that it has to leave, on the way out, without having
/// entered them. Directions without such a surface speak for `stated`, what the scene file
/// said; the majority decides. So a file that names the camera's medium too late, or not at
/// all, renders as its geometry means it.
CameraMediumFinding find_camera_medium(const Scene& scene, int stated);

}  // namespace tyndall
