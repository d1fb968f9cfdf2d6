// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/camera_medium.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tyndall/scene/scene.h"

namespace tyndall {
namespace {

constexpr int direction_count = 128;
constexpr int max_surfaces = 32;

// A spherical Fibonacci lattice: evenly spread, and nothing aligned with a scene's axes.
Vec3 lattice_direction(int i) {
  constexpr float golden_angle = 2.39996322972865f;
  const float z = 1 - (2 * static_cast<float>(i) + 1) / direction_count;
  return spherical_direction(z, golden_angle * (static_cast<float>(i) + 0.5f));
}

// The medium before the first surface along the ray that states its media.
int medium_seen(const Scene& scene, Ray ray, int stated) {
  for (int i = 0; i < max_surfaces; ++i) {
    const std::optional<SurfaceHit> hit = scene.intersect(ray, infinity);
    if (!hit) break;
    const MediumInterface& media = hit->surface->media;
    if (media.is_stated)
      return dot(ray.d, hit->point.ng) < 0 ? media.outside : media.inside;
    ray.o = offset_origin(hit->point.p, hit->point.ng, ray.d);
  }
  return stated;
}

}  // namespace

CameraMediumFinding find_camera_medium(const Scene& scene, int stated) {
  std::map<int, int> votes;
  for (int i = 0; i < direction_count; ++i)
    ++votes[medium_seen(scene, {scene.camera().position(), lattice_direction(i)}, stated)];
  const auto winner =
      std::ranges::max_element(votes, {}, [](const auto& v) { return v.second; });
  CameraMediumFinding finding{winner->first, ""};
  if (2 * winner->second < direction_count * 3 / 2)
    finding.remark = "surfaces around the camera disagree about the medium it is in (" +
                     std::to_string(direction_count - winner->second) + " of " +
                     std::to_string(direction_count) +
                     " directions): a boundary between media may be open or inside out";
  return finding;
}

}  // namespace tyndall
