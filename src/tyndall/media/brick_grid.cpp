// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/brick_grid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "tyndall/math/parallel_for.h"
#include "tyndall/media/huge_pages.h"

namespace tyndall {
namespace {

constexpr int edge = BrickGrid::edge;
constexpr int side = BrickGrid::side;

Vec3i smaller(Vec3i a, Vec3i b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3i larger(Vec3i a, Vec3i b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

size_t product(Vec3i v) {
  return static_cast<size_t>(v.x) * static_cast<size_t>(v.y) * static_cast<size_t>(v.z);
}

// Sets what is not a density to zero.
BrickGrid::Rejected clean(BrickGrid::Samples samples) {
  BrickGrid::Rejected rejected;
  for (float& v : samples) {
    if (v >= 0 && v <= BrickGrid::largest) continue;
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

}  // namespace

// The bricks of one slab at one y and z that are not zero.
struct BrickGrid::Row {
  Extent extent;
  Rejected rejected;
  std::vector<std::pair<int, float>> constants;  // where along x, and the value
  std::vector<std::pair<int, Stored>> full;

  void add(const BrickGrid& grid, Vec3i brick, Samples samples) {
    const Rejected r = clean(samples);
    rejected.negative += r.negative;
    rejected.not_finite += r.not_finite;
    const float v = samples[0];
    const bool is_constant =
        std::all_of(samples.begin(), samples.end(), [v](float w) { return w == v; });
    if (is_constant && v == 0) return;
    merge(extent, extent_of(brick, samples));
    if (is_constant)
      constants.emplace_back(brick.x, v);
    else
      full.emplace_back(brick.x, grid.store(samples));
  }
};

BrickGrid::BrickGrid(Vec3i brick_count, const Source& source, Precision precision,
                     const Prepare& prepare)
    : brick_count_(brick_count), precision_(precision) {
  assert(brick_count.x > 0 && brick_count.y > 0 && brick_count.z > 0);
  bricks_.assign(product(brick_count), append_constant(0));
  std::map<float, Entry> constants;
  // Slabs, for `prepare`, and to hold only few bricks twice.
  constexpr int slabs = 16;
  const int thickness = (brick_count.x + slabs - 1) / slabs;
  for (int first = 0; first < brick_count.x; first += thickness) {
    const int last = std::min(first + thickness, brick_count.x);
    if (prepare) prepare(first, last);
    add_slab(first, last, source, constants);
  }
  values_.shrink_to_fit();
  codes_.shrink_to_fit();
  prefer_huge_pages(values_.data(), values_.size() * sizeof(float));
  prefer_huge_pages(codes_.data(), codes_.size() * sizeof(uint16_t));
}

void BrickGrid::add_slab(int first, int last, const Source& source,
                         std::map<float, Entry>& constants) {
  const size_t ny = static_cast<size_t>(brick_count_.y),
               nz = static_cast<size_t>(brick_count_.z);
  std::vector<Row> rows(nz * ny);
  parallel_for(rows.size(), [&](size_t i) {
    std::array<float, brick_size> samples;
    for (int x = first; x < last; ++x) {
      const Vec3i brick{x, static_cast<int>(i % ny), static_cast<int>(i / ny)};
      if (source(brick, samples)) rows[i].add(*this, brick, samples);
    }
  });
  // In order, whatever the threads did.
  for (size_t i = 0; i < rows.size(); ++i) {
    Row& row = rows[i];
    const auto brick = [&](int x) -> Entry& {
      return bricks_[brick_index({x, static_cast<int>(i % ny), static_cast<int>(i / ny)})];
    };
    merge(extent_, row.extent);
    rejected_.negative += row.rejected.negative;
    rejected_.not_finite += row.rejected.not_finite;
    for (const auto& [x, stored] : row.full) brick(x) = append(stored);
    for (const auto& [x, value] : row.constants) {
      const auto [place, is_new] = constants.emplace(value, Entry{});
      if (is_new) place->second = append_constant(value);
      brick(x) = place->second;
    }
    row = {};
  }
}

BrickGrid::Stored BrickGrid::store(std::span<const float, brick_size> samples) const {
  if (precision_ == Precision::exact)
    return {.step = 1, .values = {samples.begin(), samples.end()}};
  constexpr float largest_code = 65535;
  const float step = *std::max_element(samples.begin(), samples.end()) / largest_code;
  // Steps that have no reciprocal are as good as none.
  const float codes_per_unit = step > 1e-37f ? 1 / step : 0;
  Stored stored{.step = step};
  stored.codes.reserve(brick_size);
  for (const float v : samples)
    stored.codes.push_back(
        static_cast<uint16_t>(std::min(v * codes_per_unit + 0.5f, largest_code)));
  return stored;
}

BrickGrid::Entry BrickGrid::append(const Stored& brick) {
  const Entry entry{stored_++, brick.step};
  if (precision_ == Precision::exact)
    values_.append(brick.values);
  else
    codes_.append(brick.codes);
  return entry;
}

BrickGrid::Entry BrickGrid::append_constant(float value) {
  if (precision_ == Precision::exact)
    return append({.step = 1, .values = std::vector<float>(brick_size, value)});
  return append({.step = value, .codes = std::vector<uint16_t>(brick_size, 1)});
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

BrickGrid::Range BrickGrid::range(Vec3i first, Vec3i last, float cap) const {
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
        const Entry brick = bricks_[brick_index({bx, by, bz})];
        for (int z = a.z; z <= b.z; ++z)
          for (int y = a.y; y <= b.y; ++y)
            for (int x = a.x; x <= b.x; ++x) {
              // The mean of a trilinear interpolant is the trapezoidal rule.
              const double weight = (x == a.x || x == b.x ? 0.5 : 1) *
                                    (y == a.y || y == b.y ? 0.5 : 1) *
                                    (z == a.z || z == b.z ? 0.5 : 1);
              const float value = std::min(sample(brick, (z * side + y) * side + x), cap);
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
  return values_.size() * sizeof(float) + codes_.size() * sizeof(uint16_t) +
         bricks_.size() * sizeof(Entry);
}

}  // namespace tyndall
