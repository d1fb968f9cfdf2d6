// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/visibility_map.h"

#include <algorithm>
#include <bit>
#include <boost/container/small_vector.hpp>
#include <cassert>
#include <cmath>
#include <numbers>

#include "tyndall/math/constants.h"
#include "tyndall/math/vector_clones.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

namespace {

constexpr uint32_t max_resolution = 1 << 13;

/// Of every quarter of the sorted distances the middle one. Of two middle ones `upper`
/// chooses: always the same would predict too much or too little on average.
std::array<float, 4> quartiles(std::span<float> distances, bool upper) {
  std::sort(distances.begin(), distances.end());
  const size_t group = distances.size() / 4;
  const size_t middle = upper ? group / 2 : (group - 1) / 2;
  return {distances[middle], distances[group + middle], distances[2 * group + middle],
          distances[3 * group + middle]};
}

[[gnu::always_inline]] inline int32_t texel_index(float u, float v, int32_t side,
                                                  int32_t offset, int32_t out_of_cone) {
  const auto x = static_cast<int32_t>(u * static_cast<float>(side));
  const auto y = static_cast<int32_t>(v * static_cast<float>(side));
  const int32_t inside = offset + y * side + x;
  return u < 0 ? out_of_cone : inside;
}

// The median of the distances that are neither zero nor infinite; one if there is none.
float typical_distance(std::span<const std::array<float, 4>> texels) {
  std::vector<float> finite;
  for (const auto& texel : texels)
    for (const float d : texel)
      if (d > 0 && d < infinity) finite.push_back(d);
  if (finite.empty()) return 1;
  const auto middle = finite.begin() + static_cast<std::ptrdiff_t>(finite.size() / 2);
  std::nth_element(finite.begin(), middle, finite.end());
  return *middle;
}

}  // namespace

VisibilityMap::VisibilityMap(const LightView& view, const VisibilityMapSettings& settings)
    : view_(view),
      resolution_(settings.resolution),
      rays_per_texel_(settings.rays_per_texel),
      floor_(settings.floor),
      edge_depth_(settings.edge_depth),
      texels_per_extent_(static_cast<float>(resolution_) / view.extent()),
      seed_(settings.seed) {
  assert(std::has_single_bit(static_cast<unsigned>(resolution_)) &&
         resolution_ <= static_cast<int>(max_resolution));
  assert(rays_per_texel_ > 0 && rays_per_texel_ % 4 == 0);
  int32_t size = 0;
  for (int32_t side = resolution_; side > 0; side /= 2) {
    level_offset_.push_back(size);
    size += side * side;
  }
  texels_.resize(static_cast<size_t>(size) + 1,
                 Texel{infinity, infinity, infinity, infinity});
  const float outside = settings.lit_outside ? infinity : -1;
  texels_.back() = Texel{outside, outside, outside, outside};
  encode();
}

VisibilityMap::Texel VisibilityMap::trace_texel(int x, int y, int side,
                                                const Trace& trace) const {
  const auto rays = static_cast<uint32_t>(rays_per_texel_);
  RandomStream random(hash(seed_, static_cast<uint64_t>(x), static_cast<uint64_t>(y)));
  boost::container::small_vector<float, 16> distances(rays);
  for (uint32_t i = 0; i < rays; ++i) {
    // Stratified: columns of width 1 / rays, two rows.
    const float column =
        (static_cast<float>(i) + random.next_1d()) / static_cast<float>(rays);
    const float row = 0.5f * (static_cast<float>(i & 1) + random.next_1d());
    const Ray ray =
        view_.ray(Vec2{static_cast<float>(x) + column, static_cast<float>(y) + row} *
                  (1 / static_cast<float>(side)));
    const float distance = trace(ray, random.next_2d());
    distances[i] = distance > 0 ? distance : 0;  // NaN too
  }
  return quartiles({distances.data(), rays}, (x + y) % 2 == 1);
}

size_t VisibilityMap::offset_of(int side) const {
  const int index = std::countr_zero(static_cast<unsigned>(resolution_ / side));
  return static_cast<size_t>(level_offset_[static_cast<size_t>(index)]);
}

void VisibilityMap::trace_rows(int begin, int end, const Trace& trace) {
  assert(0 <= begin && begin <= end && end <= resolution_);
  Texel* texels = &texels_[offset_of(resolution_)];
  for (int y = begin; y < end; ++y)
    for (int x = 0; x < resolution_; ++x)
      texels[y * resolution_ + x] = trace_texel(x, y, resolution_, trace);
}

void VisibilityMap::sketch_row(int row, const Trace& trace) {
  const int side = sketch_rows();
  Texel* sketch = &texels_[offset_of(side)];
  for (int x = 0; x < side; ++x) sketch[row * side + x] = trace_texel(x, row, side, trace);
}

void VisibilityMap::refine_rows(int begin, int end, const Trace& trace) {
  assert(0 <= begin && begin <= end && end <= resolution_);
  const int side = sketch_rows(), factor = resolution_ / side;
  Texel* texels = &texels_[offset_of(resolution_)];
  const Texel* sketch = &texels_[offset_of(side)];
  for (int y = begin; y < end; ++y)
    for (int x = 0; x < resolution_; ++x) {
      const int coarse_x = x / factor, coarse_y = y / factor;
      texels[y * resolution_ + x] = is_edge(coarse_x, coarse_y)
                                        ? trace_texel(x, y, resolution_, trace)
                                        : sketch[coarse_y * side + coarse_x];
    }
}

// Whether the distances around a texel of the sketch jump. The view's own borders are no
// edges: what lies beyond them is not known.
bool VisibilityMap::is_edge(int x, int y) const {
  const int side = sketch_rows();
  const Texel* sketch = &texels_[offset_of(side)];
  float least = infinity, most = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, side - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, side - 1); ++u) {
      least = std::min(least, sketch[v * side + u].front());
      most = std::max(most, sketch[v * side + u].back());
    }
  return most > least + edge_depth_;
}

void VisibilityMap::finish() {
  for (size_t level = 1; level < level_offset_.size(); ++level) {
    const auto side = static_cast<uint32_t>(resolution_) >> level;
    const auto fine = static_cast<uint32_t>(level_offset_[level - 1]);
    const auto coarse = static_cast<uint32_t>(level_offset_[level]);
    for (uint32_t y = 0; y < side; ++y)
      for (uint32_t x = 0; x < side; ++x) {
        std::array<float, 16> distances;
        for (uint32_t i = 0; i < 4; ++i) {
          const uint32_t child = fine + (2 * y + i / 2) * 2 * side + 2 * x + i % 2;
          std::copy_n(texels_[child].begin(), 4, distances.begin() + 4 * i);
        }
        texels_[coarse + y * side + x] = quartiles(distances, (x + y) % 2 == 1);
      }
  }
  encode();
}

void VisibilityMap::encode() {
  codes_ = DistanceCodes(typical_distance(texels_));
  coded_.resize(texels_.size());
  std::transform(texels_.begin(), texels_.end(), coded_.begin(),
                 [&](const Texel& texel) { return codes_.encode(texel); });
}

float VisibilityMap::visibility(Vec3 p, int level) const {
  const ViewPoint q = view_.project(p);
  const int32_t side = resolution_ >> level;
  const int32_t i = texel_index(q.uv.x, q.uv.y, side,
                                level_offset_[static_cast<size_t>(level)], out_of_cone());
  const float share = DistanceCodes::share_beyond(coded_[static_cast<size_t>(i)],
                                                  codes_.encode_point(q.distance));
  return floor_ + (1 - floor_) * share;
}

TYNDALL_VECTOR_CLONES
void VisibilityMap::visibility(const Ray& ray, std::span<const float> t,
                               std::span<float> out, int level) const {
  assert(out.size() == t.size() && 0 <= level && level < levels());
  const int32_t side = resolution_ >> level, last = out_of_cone();
  const int32_t offset = level_offset_[static_cast<size_t>(level)];
  const float floor = floor_, rest = 1 - floor_;
  const DistanceCodes::Four* coded = coded_.data();
  const DistanceCodes codes = codes_;
  ViewBatch batch;
  alignas(32) std::array<int32_t, ViewBatch::capacity> index;
  alignas(32) std::array<DistanceCodes::Four, ViewBatch::capacity> occluders;
  for (size_t begin = 0; begin < t.size(); begin += ViewBatch::capacity) {
    const size_t n = std::min(ViewBatch::capacity, t.size() - begin);
    view_.project(ray, t.subspan(begin, n), batch);
    for (size_t i = 0; i < n; ++i)
      index[i] = texel_index(batch.u[i], batch.v[i], side, offset, last);
    for (size_t i = 0; i < n; ++i) occluders[i] = coded[index[i]];
    for (size_t i = 0; i < n; ++i)
      out[begin + i] =
          floor + rest * DistanceCodes::share_beyond(occluders[i],
                                                     codes.encode_point(batch.distance[i]));
  }
}

int VisibilityMap::level_of(float footprint) const {
  // The logarithm to the base of two, rounded.
  const float texels = std::numbers::sqrt2_v<float> * texels_per_extent_ * footprint;
  const int level = texels >= 2 ? std::ilogb(texels) : 0;  // of infinity, a large one
  return std::min(level, levels() - 1);
}

void VisibilityMap::write(ByteWriter& out) const {
  view_.write(out);
  out.write(static_cast<uint32_t>(resolution_));
  out.write(floor_);
  out.write(static_cast<uint32_t>(texels_.back()[0] > 0));
  const size_t finest = static_cast<size_t>(resolution_) * static_cast<size_t>(resolution_);
  for (size_t i = 0; i < finest; ++i)
    for (const float d : texels_[i]) out.write(d);
}

std::optional<VisibilityMap> VisibilityMap::read(ByteReader& in) {
  const LightView view = LightView::read(in);
  VisibilityMapSettings settings;
  const auto resolution = in.read_as<uint32_t>();
  in.read(settings.floor);
  settings.lit_outside = in.read_as<uint32_t>() != 0;
  const size_t texels = size_t{resolution} * resolution;
  if (in.failed() || !std::has_single_bit(resolution) || resolution > max_resolution ||
      in.remaining() < texels * sizeof(Texel))
    return std::nullopt;
  settings.resolution = static_cast<int>(resolution);
  VisibilityMap map(view, settings);
  for (size_t i = 0; i < texels; ++i)
    for (float& d : map.texels_[i]) in.read(d);
  map.finish();
  return map;
}

}  // namespace tyndall
