// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/exposure_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyndall {
namespace {

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

ExposureGrid::ExposureGrid(const CellGrid& grid, float floor)
    : grid_(grid), floor_(floor), values_(grid.count(), 1) {}

void ExposureGrid::set(size_t cell, float exposure) {
  values_[cell] = exposure > 0 && exposure < infinity ? exposure : 0;
}

void ExposureGrid::finish() {
  const float most = *std::max_element(values_.begin(), values_.end());
  for (float& value : values_) value = most > 0 ? std::max(value / most, floor_) : 1;
}

float ExposureGrid::exposure(Vec3 p) const {
  const Vec3 q = grid_.position(p);
  const Place x = place(q.x, grid_.size(0)), y = place(q.y, grid_.size(1)),
              z = place(q.z, grid_.size(2));
  const auto along_x = [&](int dy, int dz) {
    const size_t i = grid_.index(x.cell, std::min(y.cell + dy, grid_.size(1) - 1),
                                 std::min(z.cell + dz, grid_.size(2) - 1));
    return lerp(x.share, values_[i], values_[grid_.size(0) > 1 ? i + 1 : i]);
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
