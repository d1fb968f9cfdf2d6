// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tyndall/guiding/guiding_file.h"
#include "tyndall/image/image.h"
#include "tyndall/scene/scene.h"

namespace tyndall::app {

/// Densities of the direction in which a dual connection goes on from its first vertex, and
/// what they should be, over the square about the light that they are learned on: its
/// middle is the direction of the light, its edge the opposite one. Relative to joint
/// sampling in an isotropic medium, which is one everywhere.
struct DirectionMaps {
  static constexpr int side = 160;

  size_t light;
  std::vector<float> truth;    ///< light scattered once, times phase, by brute force
  std::vector<float> learned;  ///< what is sampled with the records of the file
  std::vector<float> joint;    ///< joint importance sampling, without them
  float learned_variance = 0, joint_variance = 0;  ///< relative, of one
                                                   ///< sample; -1 if no light arrives
};

/// For the first vertex at distance t of a camera ray, and the light of that index or the
/// one most likely to be drawn. Throws std::invalid_argument if nothing scatters there, or
/// the light is at infinity.
DirectionMaps direction_maps(const Scene& scene, const GuidingFile& file, const Ray& ray,
                             float t, std::optional<size_t> light);

/// The three maps beside each other.
Image draw_direction_maps(const DirectionMaps& maps, const std::string& title);

}  // namespace tyndall::app
