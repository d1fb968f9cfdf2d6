// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "apps/tyndall/report/insets.h"
#include "apps/tyndall/report/results.h"

namespace tyndall::app {

/// An image of the page.
struct ScenePicture {
  std::string name;
  Image image;
  std::vector<float>
      flip;  ///< HDR-FLIP against the reference; empty for the reference itself
};

/// The images of one scene: the reference, then the first run of each method.
struct ScenePictures {
  std::vector<ScenePicture> pictures;
  std::vector<Inset> insets;
  float exposure = 0;  ///< [stops] at which insets are and viewers begin
};

/// Reads the images; `folder` is where the results file lies. Throws std::runtime_error if
/// one cannot be read or does not have the size of the reference.
ScenePictures read_pictures(const SceneResults& scene, const std::string& folder);

/// One scene's pictures, packed for the page.
struct PackedPictures {
  std::string description;  ///< JSON object for pictures.js
  std::string data;         ///< script elements that hold the bytes
};

/// `steps`: levels per stop. `number` makes element names unique in the page.
PackedPictures pack_pictures(const ScenePictures& pictures, double epsilon, int steps,
                             int number);

}  // namespace tyndall::app
