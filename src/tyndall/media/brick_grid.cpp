// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/brick_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

namespace tyndall {
namespace {

constexpr int edge = BrickGrid::edge;
constexpr int side = BrickGrid::side;
constexpr size_t brick_size = BrickGrid::brick_size;

// Marks of bricks_ until the bricks have their places.
constexpr uint32_t zero_brick = 0;
constexpr uint32_t constant_brick = 1;
constexpr uint32_t full_brick = 2;

Vec3i smaller(Vec3i a, Vec3i b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3i larger(Vec3i a, Vec3i b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

size_t product(Vec3i v) {
  return static_cast<size_t>(v.x) * static_cast<size_t>(v.y) * static_cast<size_t>(v.z);
}

Vec3i brick_at(size_t index, Vec3i count) {
  const size_t nx = static_cast<size_t>(count.x), ny = static_cast<size_t>(count.y);
  return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
          static_cast<int>(index / (nx * ny))};
}

// Larger numbers would overflow in optical depths.
constexpr float largest_density = 1e30f;

// Sets what is not a density to zero.
BrickGrid::Rejected clean(BrickGrid::Samples samples) {
  BrickGrid::Rejected rejected;
  for (float& v : samples) {
    if (v >= 0 && v <= largest_density) continue;
    ++(v < 0 && std::isfinite(v) ? rejected.negative : rejected.not_finite);
    v = 0;
  }
  return rejected;
}

void merge(BrickGrid::Extent& a, const BrickGrid::Extent& b) {
  a.first = smaller(a.first, b.first);
  a.last = larger(a.last, b.last);
  a.maximum = std::max(a.maximum, b.maximum);
}

BrickGrid::Extent extent_of(Vec3i brick, std::span<const float> samples) {
  BrickGrid::Extent extent;
  size_t i = 0;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const float v = samples[i++];
        if (!(v > 0)) continue;
        const Vec3i p{brick.x * edge + x, brick.y * edge + y, brick.z * edge + z};
        merge(extent, {p, p, v});
      }
  return extent;
}

// What one thread learns of the bricks it looks at.
struct Survey {
  BrickGrid::Extent extent;
  BrickGrid::Rejected rejected;
  std::vector<std::pair<size_t, float>> constants;

  uint32_t classify(size_t index, Vec3i brick, BrickGrid::Samples samples) {
    const BrickGrid::Rejected r = clean(samples);
    rejected.negative += r.negative;
    rejected.not_finite += r.not_finite;
    const float v = samples[0];
    const bool is_constant =
        std::all_of(samples.begin(), samples.end(), [v](float w) { return w == v; });
    if (is_constant && v == 0) return zero_brick;
    merge(extent, extent_of(brick, samples));
    if (!is_constant) return full_brick;
    constants.emplace_back(index, v);
    return constant_brick;
  }

  void merge_with(const Survey& o) {
    merge(extent, o.extent);
    rejected.negative += o.rejected.negative;
    rejected.not_finite += o.rejected.not_finite;
    constants.insert(constants.end(), o.constants.begin(), o.constants.end());
  }
};

Survey survey(Vec3i brick_count, const BrickGrid::Source& source,
              std::vector<uint32_t>& marks) {
  Survey whole;
  std::mutex mutex;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, marks.size(), 256),
                    [&](const auto& range) {
                      Survey part;
                      std::array<float, brick_size> samples;
                      for (size_t i = range.begin(); i != range.end(); ++i) {
                        const Vec3i brick = brick_at(i, brick_count);
                        if (source(brick, samples))
                          marks[i] = part.classify(i, brick, samples);
                      }
                      const std::scoped_lock lock(mutex);
                      whole.merge_with(part);
                    });
  std::sort(whole.constants.begin(), whole.constants.end());
  return whole;
}

}  // namespace

BrickGrid::BrickGrid(Vec3i brick_count, const Source& source) : brick_count_(brick_count) {
  assert(brick_count.x > 0 && brick_count.y > 0 && brick_count.z > 0);
  bricks_.assign(product(brick_count), zero_brick);
  const Survey found = survey(brick_count, source, bricks_);
  extent_ = found.extent;
  rejected_ = found.rejected;

  uint32_t stored = 1;
  std::vector<size_t> full;
  for (size_t i = 0; i < bricks_.size(); ++i)
    if (bricks_[i] == full_brick) full.push_back(i), bricks_[i] = stored++;
  std::map<float, uint32_t> constants;
  for (const auto& [i, value] : found.constants) {
    const auto [place, is_new] = constants.emplace(value, stored);
    bricks_[i] = place->second;
    stored += is_new ? 1 : 0;
  }

  values_.assign(size_t{stored} * brick_size, 0);
  const auto samples_of = [&](uint32_t i) {
    return Samples(values_.data() + size_t{i} * brick_size, brick_size);
  };
  for (const auto& [value, i] : constants) std::ranges::fill(samples_of(i), value);
  tbb::parallel_for(size_t{0}, full.size(), [&](size_t i) {
    const Samples samples = samples_of(bricks_[full[i]]);
    source(brick_at(full[i], brick_count), samples);
    clean(samples);
  });
}

BrickGrid BrickGrid::from_dense(const DensityGrid& dense) {
  const Vec3i n = dense.resolution;
  assert(n.x > 0 && n.y > 0 && n.z > 0 && dense.values.size() == product(n));
  const auto source = [&](Vec3i brick, Samples samples) {
    size_t out = 0;
    for (int k = 0; k < side; ++k)
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
          const int x = brick.x * edge + i - 1, y = brick.y * edge + j - 1,
                    z = brick.z * edge + k - 1;
          const bool is_inside =
              x >= 0 && y >= 0 && z >= 0 && x < n.x && y < n.y && z < n.z;
          const size_t in =
              (static_cast<size_t>(z) * static_cast<size_t>(n.y) + static_cast<size_t>(y)) *
                  static_cast<size_t>(n.x) +
              static_cast<size_t>(x);
          samples[out++] = is_inside ? dense.values[in] : 0;
        }
    return true;
  };
  return BrickGrid({n.x / edge + 1, n.y / edge + 1, n.z / edge + 1}, source);
}

BrickGrid::Range BrickGrid::range(Vec3i first, Vec3i last) const {
  Range range;
  double sum = 0;
  for (int bz = first.z / edge; bz * edge < last.z; ++bz)
    for (int by = first.y / edge; by * edge < last.y; ++by)
      for (int bx = first.x / edge; bx * edge < last.x; ++bx) {
        if (is_zero({bx, by, bz})) continue;
        const Vec3i origin{bx * edge, by * edge, bz * edge};
        const Vec3i a =
            larger({0, 0, 0}, {first.x - origin.x, first.y - origin.y, first.z - origin.z});
        const Vec3i b = smaller({edge, edge, edge},
                                {last.x - origin.x, last.y - origin.y, last.z - origin.z});
        const std::span<const float> v = brick({bx, by, bz});
        for (int z = a.z; z <= b.z; ++z)
          for (int y = a.y; y <= b.y; ++y)
            for (int x = a.x; x <= b.x; ++x) {
              // The mean of a trilinear interpolant is the trapezoidal rule.
              const double weight = (x == a.x || x == b.x ? 0.5 : 1) *
                                    (y == a.y || y == b.y ? 0.5 : 1) *
                                    (z == a.z || z == b.z ? 0.5 : 1);
              const float value = v[static_cast<size_t>((z * side + y) * side + x)];
              range.max = std::max(range.max, value);
              sum += weight * double{value};
            }
      }
  const double volume =
      static_cast<double>(product({last.x - first.x, last.y - first.y, last.z - first.z}));
  range.mean = static_cast<float>(sum / volume);
  if (range.max > 0) range.mean = std::max(range.mean, 1e-6f * range.max);
  return range;
}

size_t BrickGrid::memory() const {
  return values_.size() * sizeof(float) + bricks_.size() * sizeof(uint32_t);
}

}  // namespace tyndall
