// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/scene_mark.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tyndall/scene/scene.h"

namespace tyndall {
namespace {

// Relative to the size of the scene.
constexpr float rounding = 1e-5f;

// Bounds of scenes without surfaces are infinite.
bool are_near(Vec3 a, Vec3 b, float tolerance) {
  for (int axis = 0; axis < 3; ++axis)
    if (a[axis] != b[axis] && !(std::abs(a[axis] - b[axis]) <= tolerance)) return false;
  return true;
}

float largest_coordinate(const SceneMark& mark) {
  float size = 0;
  for (const Vec3 p : {mark.bounds.min, mark.bounds.max, mark.camera})
    for (int axis = 0; axis < 3; ++axis)
      if (std::isfinite(p[axis])) size = std::max(size, std::abs(p[axis]));
  return size;
}

std::string text(Vec3 p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

}  // namespace

SceneMark SceneMark::of(const Scene& scene) {
  const Vec3d origin = scene.description().world_origin;
  const auto outside = [&](Vec3 p) { return to_float(p + origin); };
  const Bounds3 bounds = scene.bounds();
  return {.lights = static_cast<uint32_t>(scene.lights().size()),
          .bounds = {outside(bounds.min), outside(bounds.max)},
          .camera = outside(scene.camera().position()),
          .world_origin = origin};
}

SceneMark SceneMark::read(ByteReader& in) {
  SceneMark mark;
  in.read(mark.lights);
  in.read(mark.bounds.min), in.read(mark.bounds.max), in.read(mark.camera);
  Vec3d& origin = mark.world_origin;
  in.read(origin.x), in.read(origin.y), in.read(origin.z);
  return mark;
}

void SceneMark::write(ByteWriter& out) const {
  out.write(lights);
  out.write(bounds.min), out.write(bounds.max), out.write(camera);
  out.write(world_origin.x), out.write(world_origin.y), out.write(world_origin.z);
}

std::string difference(const SceneMark& mark, const SceneMark& other) {
  if (mark.lights != other.lights)
    return fmt::format("which has {} light{}, not {}", other.lights,
                       other.lights == 1 ? "" : "s", mark.lights);
  const float tolerance = rounding * largest_coordinate(mark);
  if (!are_near(mark.bounds.min, other.bounds.min, tolerance) ||
      !are_near(mark.bounds.max, other.bounds.max, tolerance))
    return fmt::format("which reaches from {} to {}, not from {} to {}",
                       text(other.bounds.min), text(other.bounds.max),
                       text(mark.bounds.min), text(mark.bounds.max));
  if (!are_near(mark.camera, other.camera, tolerance))
    return fmt::format("whose camera stands at {}, not {}", text(other.camera),
                       text(mark.camera));
  if (!are_near(to_float(mark.world_origin), to_float(other.world_origin), tolerance))
    return fmt::format("whose coordinates begin at {}, not {}",
                       text(to_float(other.world_origin)),
                       text(to_float(mark.world_origin)));
  return {};
}

}  // namespace tyndall
