// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

namespace tyndall::loader {

class Parser;
class SceneBuilder;

/// Where in a scene file a directive may stand.
enum class Phase { anywhere, before_world, in_world };

struct Directive {
  std::string_view name;
  Phase phase;
  void (*read)(Parser&, SceneBuilder&);
};

/// Null if pbrt-v4 has no such directive.
const Directive* find_directive(std::string_view name);

std::vector<std::string_view> directive_names();

}  // namespace tyndall::loader
