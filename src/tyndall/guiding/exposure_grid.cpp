// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/exposure_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyndall {
namespace {

constexpr int max_size = 128;

// Position along an axis: the cell whose middle lies before, and the share of the next.
struct Place {
  int cell;
  float share;
};

Place place(float x, int size) {
  const float between = std::clamp(x - 0.5f, 0.0f, static_cast<float>(size - 1));
  const int cell = std::min(static_cast<int>(between), std::max(size - 2, 0));
  return {cell, size > 1 ? between - static_cast<float>(cell) : 0};
}

float lerp(float share, float a, float b) { return a + share * (b - a); }

}  // namespace

ExposureGrid::ExposureGrid(const Bounds3& box, int cells, float floor)
    : box_(box), floor_(floor) {
  assert(!box.is_empty() && cells > 0);
  const Vec3 d = box.diagonal();
  const float least = std::max({d.x, d.y, d.z}) / max_size;
  const Vec3 extent{std::max(d.x, least), std::max(d.y, least), std::max(d.z, least)};
  const float side = std::cbrt(extent.x * extent.y * extent.z / static_cast<float>(cells));
  const auto count = [side](float length) {
    return side > 0 ? std::clamp(static_cast<int>(std::round(length / side)), 1, max_size)
                    : 1;
  };
  size_[0] = count(extent.x);
  size_[1] = count(extent.y);
  size_[2] = count(extent.z);
  const auto scale = [](int size, float length) {
    return length > 0 ? static_cast<float>(size) / length : 0.0f;
  };
  scale_ = {scale(size_[0], d.x), scale(size_[1], d.y), scale(size_[2], d.z)};
  values_.resize(index(0, 0, size_[2]), 1);
}

void ExposureGrid::measure_slice(
    int slice, const std::function<float(Vec3 p, size_t cell)>& exposure) {
  const Vec3 d = box_.diagonal();
  const auto middle = [](int i, int size) {
    return (static_cast<float>(i) + 0.5f) / static_cast<float>(size);
  };
  for (int y = 0; y < size_[1]; ++y)
    for (int x = 0; x < size_[0]; ++x) {
      const Vec3 u{middle(x, size_[0]), middle(y, size_[1]), middle(slice, size_[2])};
      const size_t cell = index(x, y, slice);
      const float value = exposure(box_.min + u * d, cell);
      values_[cell] = value > 0 && value < infinity ? value : 0;
    }
}

void ExposureGrid::finish() {
  const float most = *std::max_element(values_.begin(), values_.end());
  for (float& value : values_) value = most > 0 ? std::max(value / most, floor_) : 1;
}

float ExposureGrid::exposure(Vec3 p) const {
  const Vec3 q = (p - box_.min) * scale_;
  const Place x = place(q.x, size_[0]), y = place(q.y, size_[1]), z = place(q.z, size_[2]);
  const auto along_x = [&](int dy, int dz) {
    const size_t i = index(x.cell, std::min(y.cell + dy, size_[1] - 1),
                           std::min(z.cell + dz, size_[2] - 1));
    return lerp(x.share, values_[i], values_[size_[0] > 1 ? i + 1 : i]);
  };
  return lerp(z.share, lerp(y.share, along_x(0, 0), along_x(1, 0)),
              lerp(y.share, along_x(0, 1), along_x(1, 1)));
}

void ExposureGrid::exposure(const Ray& ray, std::span<const float> t,
                            std::span<float> out) const {
  assert(out.size() == t.size());
  for (size_t i = 0; i < t.size(); ++i) out[i] = exposure(ray.at(t[i]));
}

}  // namespace tyndall
