// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/camera_medium.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "tyndall/scene/boundary_steps.h"
#include "tyndall/scene/scene.h"

namespace tyndall {
namespace {

constexpr int direction_count = 128;

// A spherical Fibonacci lattice: evenly spread, and nothing aligned with a scene's axes.
Vec3 lattice_direction(int i) {
  constexpr float golden_angle = 2.39996322972865f;
  const float z = 1 - (2 * static_cast<float>(i) + 1) / direction_count;
  return spherical_direction(z, golden_angle * (static_cast<float>(i) + 0.5f));
}

// The media around the start of one ray, told from those that it leaves.
class Surroundings {
 public:
  void cross(const BoundaryStep& step) {
    is_told_ = true;
    leave(step.from);
    if (step.to != no_medium) ++entered_[step.to];
  }
  // Arrives at a surface that states its media.
  void arrive(int medium) {
    is_told_ = true;
    if (medium != no_medium && entered_[medium] == 0) left_.push_back(medium);
  }
  bool is_in(int medium) const {
    const auto found = entered_.find(medium);
    return found != entered_.end() && found->second > 0;
  }
  // Empty if the ray has met nothing that could tell.
  std::optional<std::vector<int>> media() && {
    if (!is_told_) return std::nullopt;
    std::ranges::sort(left_);
    return std::move(left_);
  }

 private:
  void leave(int medium) {
    if (medium == no_medium) return;
    if (entered_[medium] > 0)
      --entered_[medium];
    else
      left_.push_back(medium);
  }

  std::map<int, int> entered_;  // how often, by medium
  std::vector<int> left_;       // without having been entered
  bool is_told_ = false;
};

std::optional<std::vector<int>> media_at_start(const Scene& scene, const Ray& ray) {
  SurfaceCrossings crossings;
  const std::optional<SurfaceHit> end = scene.intersect_through(ray, infinity, crossings);
  BoundarySteps steps(ray, end ? end->t : infinity);
  for (const SurfaceCrossing& crossing : crossings) steps.add(crossing);
  Surroundings around;
  const auto is_in = [&](int medium) { return around.is_in(medium); };
  while (const BoundaryStep* step = steps.next(is_in)) around.cross(*step);
  if (end && end->surface->media.is_stated) {
    const MediumInterface& media = end->surface->media;
    around.arrive(dot(ray.d, end->point.ng) < 0 ? media.outside : media.inside);
  }
  return std::move(around).media();
}

}  // namespace

CameraMediumFinding find_media(const Scene& scene, Vec3 p, std::vector<int> otherwise) {
  std::map<std::vector<int>, int> votes;
  for (int i = 0; i < direction_count; ++i)
    ++votes[media_at_start(scene, {p, lattice_direction(i)}).value_or(otherwise)];
  const auto winner =
      std::ranges::max_element(votes, {}, [](const auto& v) { return v.second; });
  CameraMediumFinding finding{winner->first, ""};
  // Less than three quarters agree.
  if (4 * winner->second < 3 * direction_count)
    finding.remark = "surfaces around the camera disagree about the medium it is in (" +
                     std::to_string(direction_count - winner->second) + " of " +
                     std::to_string(direction_count) +
                     " directions): a boundary between media may be open or inside out";
  return finding;
}

CameraMediumFinding find_camera_medium(const Scene& scene, int stated) {
  std::vector<int> otherwise;
  if (stated != no_medium) otherwise.push_back(stated);
  return find_media(scene, scene.camera().position(), otherwise);
}

}  // namespace tyndall
