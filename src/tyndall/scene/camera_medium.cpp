// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/camera_medium.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

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

// What one direction says of the media around the camera.
struct Answer {
  int votes;
  bool is_complete;                  // else it ended at a surface that states no media
  std::vector<int> inside, outside;  // of these media; sorted

  bool agrees_with(const std::vector<int>& media) const {
    if (is_complete) return media == inside;
    return std::ranges::includes(media, inside) &&
           std::ranges::none_of(outside, [&](int medium) {
             return std::ranges::binary_search(media, medium);
           });
  }
};

// The media around the start of one ray, told from those that it leaves.
class Surroundings {
 public:
  void cross(const BoundaryStep& step) {
    leave(step.from);
    enter(step.to);
  }
  // Arrives at a surface that states its media.
  void arrive(int medium) {
    if (medium == no_medium)
      is_in_the_open_ = true;
    else if (entered_[medium] == 0)
      left_.push_back(medium);
  }
  bool is_in(int medium) const {
    const auto found = entered_.find(medium);
    return found != entered_.end() && found->second > 0;
  }
  // Boundaries that do not mention the stated medium overlap with it, wherever it is.
  std::vector<int> inside(const std::vector<int>& stated) const {
    std::vector<int> media = left_;
    const bool is_denied = is_in_the_open_ || std::ranges::any_of(stated, [&](int m) {
                             return entered_.contains(m);
                           });
    if (media.empty() && !is_denied) media = stated;
    std::ranges::sort(media);
    return media;
  }
  // Those that it enters without having left them first.
  std::vector<int> outside() const {
    std::vector<int> media;
    for (const auto& [medium, count] : entered_)
      if (std::ranges::count(left_, medium) == 0) media.push_back(medium);
    return media;
  }

 private:
  void enter(int medium) {
    if (medium != no_medium) ++entered_[medium];
  }
  void leave(int medium) {
    if (medium == no_medium) return;
    if (is_in(medium))
      --entered_[medium];
    else
      left_.push_back(medium);
  }

  std::map<int, int> entered_;  // how often, by medium
  std::vector<int> left_;       // without having been entered
  bool is_in_the_open_ = false;
};

Answer ask(const Scene& scene, const Ray& ray, const std::vector<int>& stated) {
  SurfaceCrossings crossings;
  const std::optional<SurfaceHit> end = scene.intersect_through(ray, infinity, crossings);
  BoundarySteps steps(ray, end ? end->t : infinity);
  for (const SurfaceCrossing& crossing : crossings) steps.add(crossing);
  Surroundings around;
  const auto is_in = [&](int medium) { return around.is_in(medium); };
  while (const BoundaryStep* step = steps.next(is_in)) around.cross(*step);
  const bool is_complete = !end || end->surface->media.is_stated;
  if (end && is_complete) {
    const MediumInterface& media = end->surface->media;
    around.arrive(dot(ray.d, end->point.ng) < 0 ? media.outside : media.inside);
  }
  return {.votes = 1,
          .is_complete = is_complete,
          .inside = around.inside(is_complete ? stated : std::vector<int>()),
          .outside = around.outside()};
}

int votes_for(const std::vector<int>& media, const std::vector<Answer>& answers) {
  int votes = 0;
  for (const Answer& answer : answers)
    if (answer.agrees_with(media)) votes += answer.votes;
  return votes;
}

std::vector<Answer> ask_around(const Scene& scene, Vec3 p, const std::vector<int>& stated) {
  std::vector<Answer> answers;
  for (int i = 0; i < direction_count; ++i)
    answers.push_back(ask(scene, {p, lattice_direction(i)}, stated));
  return answers;
}

CameraMediumFinding count_votes(const std::vector<Answer>& answers,
                                const std::vector<int>& stated) {
  CameraMediumFinding finding{stated, ""};
  for (const Answer& answer : answers)
    if (votes_for(answer.inside, answers) > votes_for(finding.media, answers))
      finding.media = answer.inside;
  const auto against = std::ranges::count_if(
      answers, [&](const Answer& answer) { return !answer.agrees_with(finding.media); });
  if (4 * against > direction_count)
    finding.remark = "surfaces around the camera disagree about the medium it is in (" +
                     std::to_string(against) + " of " + std::to_string(direction_count) +
                     " directions): a boundary between media may be open or inside out";
  return finding;
}

}  // namespace

CameraMediumFinding find_media(const Scene& scene, Vec3 p, std::vector<int> otherwise) {
  return count_votes(ask_around(scene, p, otherwise), otherwise);
}

CameraMediumFinding find_camera_medium(const Scene& scene, int stated) {
  std::vector<int> otherwise;
  if (stated != no_medium) otherwise.push_back(stated);
  std::vector<Answer> answers = ask_around(scene, scene.camera().position(), otherwise);
  const Vec3 forward = scene.camera().settings().world_from_camera.vector({0, 0, 1});
  for (int i = 0; i < direction_count; ++i)
    if (dot(lattice_direction(i), forward) > 0) answers[static_cast<size_t>(i)].votes = 2;
  return count_votes(answers, otherwise);
}

}  // namespace tyndall
