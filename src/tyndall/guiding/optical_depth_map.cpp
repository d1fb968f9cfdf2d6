// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/optical_depth_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tyndall/guiding/vector_exp.h"

namespace tyndall {

OpticalDepthMap::OpticalDepthMap(const LightView& view, float range, int resolution,
                                 int steps)
    : view_(view), range_(range), resolution_(resolution), steps_(steps) {
  assert(range > 0 && resolution > 0 && steps > 0);
  depth_.resize(static_cast<size_t>(resolution) * static_cast<size_t>(resolution) *
                static_cast<size_t>(steps + 1));
}

float OpticalDepthMap::distance_of(int step) const {
  return range_ * sqr(static_cast<float>(step) / static_cast<float>(steps_));
}

void OpticalDepthMap::trace_rows(int begin, int end, const Depth& depth) {
  assert(0 <= begin && begin <= end && end <= resolution_);
  std::vector<float> t;
  for (int step = 0; step <= steps_; ++step) t.push_back(distance_of(step));
  const auto size = t.size();
  for (int y = begin; y < end; ++y)
    for (int x = 0; x < resolution_; ++x) {
      const Vec2 center{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
      const std::span<float> depths(
          &depth_[static_cast<size_t>(y * resolution_ + x) * size], size);
      depth(view_.ray(center * (1 / static_cast<float>(resolution_))), t, depths);
      float least = 0;  // never falls; NaN adds nothing
      for (float& d : depths) d = least = d > least ? d : least;
    }
}

float OpticalDepthMap::predict(float u, float v, float distance) const {
  const auto side = static_cast<float>(resolution_);
  const int x = static_cast<int>(std::max(u, 0.0f) * side);
  const int y = static_cast<int>(std::max(v, 0.0f) * side);
  const float s =
      std::sqrt(std::clamp(distance / range_, 0.0f, 1.0f)) * static_cast<float>(steps_);
  const int step = std::min(static_cast<int>(s), steps_ - 1);
  const size_t texel = static_cast<size_t>(y * resolution_ + x);
  const float* depth =
      &depth_[texel * static_cast<size_t>(steps_ + 1) + static_cast<size_t>(step)];
  // Linear in distance, not in its square root: exact where the medium is homogeneous.
  const float from = distance_of(step), to = distance_of(step + 1);
  const float f = std::clamp((distance - from) / (to - from), 0.0f, 1.0f);
  return exp_nonpositive(-(depth[0] + f * (depth[1] - depth[0])));
}

float OpticalDepthMap::transmittance(Vec3 p) const {
  const ViewPoint q = view_.project(p);
  return predict(q.uv.x, q.uv.y, q.distance);
}

void OpticalDepthMap::transmittance(const Ray& ray, std::span<const float> t,
                                    std::span<float> out) const {
  assert(out.size() == t.size());
  ViewBatch batch;
  for (size_t begin = 0; begin < t.size(); begin += ViewBatch::capacity) {
    const size_t n = std::min(ViewBatch::capacity, t.size() - begin);
    view_.project(ray, t.subspan(begin, n), batch);
    for (size_t i = 0; i < n; ++i)
      out[begin + i] = predict(batch.u[i], batch.v[i], batch.distance[i]);
  }
}

}  // namespace tyndall
