// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tyndall {

class Scene;

/// What surrounds the camera, and what to tell the user of it.
struct CameraMediumFinding {
  int medium;          ///< index, or no_medium
  std::string remark;  ///< empty if all agrees
};

/// Asks the nearest surfaces that state their media, in many directions, which medium lies
/// on the camera's side. Directions without such a surface speak for `stated`, what the
/// scene file said; the majority decides. So a file that names the camera's medium too
/// late, or not at all, renders as its geometry means it.
CameraMediumFinding find_camera_medium(const Scene& scene, int stated);

}  // namespace tyndall
