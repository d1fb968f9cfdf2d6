// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/cell_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyndall {
namespace {

constexpr int max_size = 128;

}  // namespace

CellGrid::CellGrid(const Bounds3& box, int cells) : min_(box.min) {
  assert(!box.is_empty() && cells > 0);
  const Vec3 edges = box.diagonal();
  const float longest = std::max({edges.x, edges.y, edges.z});
  const float least = std::max(longest / max_size, 1e-30f);
  const Vec3 d = max(edges, {least, least, least});
  const float edge =
      std::cbrt(d.x / static_cast<float>(cells)) * std::cbrt(d.y) * std::cbrt(d.z);
  for (int i = 0; i < 3; ++i) {
    const int size = std::clamp(static_cast<int>(std::lround(d[i] / edge)), 1, max_size);
    size_[static_cast<size_t>(i)] = size;
    scale_[i] = static_cast<float>(size) / d[i];
    edges_[i] = edges[i] / static_cast<float>(size);
  }
}

size_t CellGrid::count() const { return index(0, 0, size_[2]); }

size_t CellGrid::index(int x, int y, int z) const {
  const auto row =
      static_cast<size_t>(z) * static_cast<size_t>(size_[1]) + static_cast<size_t>(y);
  return row * static_cast<size_t>(size_[0]) + static_cast<size_t>(x);
}

size_t CellGrid::find(Vec3 p) const {
  const Vec3 q = position(p);
  const auto along = [&](int axis) {
    return static_cast<int>(std::clamp(q[axis], 0.0f, static_cast<float>(size(axis) - 1)));
  };
  return index(along(0), along(1), along(2));
}

Vec3 CellGrid::middle(int x, int y, int z) const {
  const Vec3 q{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
               static_cast<float>(z) + 0.5f};
  return min_ + q * edges_;
}

}  // namespace tyndall
