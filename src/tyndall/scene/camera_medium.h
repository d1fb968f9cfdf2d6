// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tyndall {

class Scene;

/// What surrounds the camera, and what to tell the user of it.
struct CameraMediumFinding {
  std::vector<int> media;  ///< indices; empty in empty space, several where media overlap
  std::string remark;      ///< empty if all agrees
};

/// Asks the surfaces that state their media, in many directions, in which media light is
/// that arrives at the camera: those that it has to leave, on the way out, without having
/// entered them. Directions without such a surface speak for `stated`, what the scene file
/// said; the majority decides. So a file that names the camera's medium too late, or not at
/// all, renders as its geometry means it.
CameraMediumFinding find_camera_medium(const Scene& scene, int stated);

}  // namespace tyndall
