// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/loader/color_space.h"
#include "tyndall/loader/parameter.h"
#include "tyndall/materials/bsdf.h"
#include "tyndall/math/rgb.h"
#include "tyndall/math/transform.h"

namespace tyndall::loader {

/// A material, or the name of one that may be defined further down.
struct MaterialReference {
  Material material = DiffuseBsdf{Rgb(0.5f)};
  std::string name;  ///< empty: `material` holds
  Span where;
};

/// Names of media; empty is empty space.
struct MediumNames {
  std::string inside, outside;
  bool is_stated = false;
  Span where;
};

/// What AreaLightSource asks for.
struct AreaLightRequest {
  Rgb L;
  bool two_sided = false;
  float power = 0;  ///< [lm] of each shape; not positive: L holds
};

/// What AttributeBegin saves and AttributeEnd restores.
struct GraphicsState {
  Transform ctm;            ///< the file's world from what is being described
  bool moves_start = true;  ///< transformations apply to the start of the shutter time
  bool reverse_orientation = false;
  ColorSpace color_space = ColorSpace::srgb;
  MaterialReference material;
  MediumNames media;
  std::optional<AreaLightRequest> area_light;
  std::map<std::string, std::vector<Parameter>, std::less<>>
      defaults;  ///< of Attribute, by target
};

}  // namespace tyndall::loader
