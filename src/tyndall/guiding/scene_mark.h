// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "tyndall/guiding/byte_stream.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/vec3d.h"

namespace tyndall {

class Scene;

/// What tells a scene from others, so that what was learned in one is not used in another.
struct SceneMark {
  uint32_t lights = 0;
  Bounds3 bounds{};      ///< in the world outside
  Vec3 camera{};         ///< where it stands there
  Vec3d world_origin{};  ///< of the coordinates in which was learned

  static SceneMark of(const Scene& scene);
  static SceneMark read(ByteReader& in);
  void write(ByteWriter& out) const;
};

/// How the other scene differs, beyond rounding, as in "which has 3 lights, not 1"; empty
/// if it does not.
std::string difference(const SceneMark& mark, const SceneMark& other);

}  // namespace tyndall
