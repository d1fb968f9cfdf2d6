// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "tyndall/math/vec.h"
#include "tyndall/media/growing_array.h"

namespace tyndall {

/// Samples at cell centres of a box, x fastest, then y, then z.
struct DensityGrid {
  Vec3i resolution;
  std::vector<float> values;  ///< resolution.x * y * z of them
};

/// A sparse grid of non-negative samples with trilinear interpolation, zero outside.
///
/// Samples sit at integer coordinates. They are stored in bricks of 8^3 cells with an
/// apron: 9^3 samples each, so that one interpolation reads one brick. Bricks without a
/// positive sample share one brick of zeros; other constant bricks are shared, too.
///
/// Compact grids keep 16 bits of each sample, on an even scale from zero to the largest
/// sample of its brick: within 1/131070 of that, zeros and constant bricks exact. Half the
/// memory is also twice the bricks in the processor's caches.
class BrickGrid {
 public:
  static constexpr int edge = 8;         ///< cells along a brick
  static constexpr int side = edge + 1;  ///< samples along a brick
  static constexpr size_t brick_size = size_t{side} * side * side;

  using Samples = std::span<float, brick_size>;
  /// Writes the samples of a brick, x fastest; called from several threads, once per brick.
  /// Returns false where all samples are zero, and then need not write.
  using Source = std::function<bool(Vec3i brick, Samples samples)>;
  /// Called between the bricks of one slab and the next, with the bricks [first, last)
  /// along x that `source` will be asked for: what it needs for others may go.
  using Prepare = std::function<void(int first, int last)>;

  enum class Precision { exact, compact };

  /// Larger numbers count as infinite: they would overflow in optical depths.
  static constexpr float largest = 1e30f;

  /// Numbers that a density cannot be; all count as zero.
  struct Rejected {
    uint64_t negative = 0, not_finite = 0;
  };

  /// The bounds of the positive samples, and the largest.
  struct Extent {
    Vec3i first{INT32_MAX, INT32_MAX, INT32_MAX}, last{-1, -1, -1};
    float maximum = 0;
  };

  /// Precondition: no component of `brick_count` is below one.
  BrickGrid(Vec3i brick_count, const Source& source, Precision precision = Precision::exact,
            const Prepare& prepare = {});

  /// Sample (i, j, k) of `dense` becomes the sample (i + 1, j + 1, k + 1), surrounded by
  /// zeros: cell centre x of [0, resolution] is found at x + 1/2.
  static BrickGrid from_dense(const DensityGrid& dense);

  /// The interpolant at `p_grid`. Precondition: 0 <= p_grid < 8 brick_count() per
  /// component.
  float interpolate(Vec3 p_grid) const {
    const int x = static_cast<int>(p_grid.x);
    const int y = static_cast<int>(p_grid.y);
    const int z = static_cast<int>(p_grid.z);
    const float fx = p_grid.x - static_cast<float>(x);
    const float fy = p_grid.y - static_cast<float>(y);
    const float fz = p_grid.z - static_cast<float>(z);
    const Entry brick = bricks_[brick_index({x >> 3, y >> 3, z >> 3})];
    const size_t at = size_t{brick.index} * brick_size +
                      static_cast<size_t>(((z & 7) * side + (y & 7)) * side + (x & 7));
    if (precision_ == Precision::exact) return trilinear(values_.data() + at, fx, fy, fz);
    return brick.step * trilinear(codes_.data() + at, fx, fy, fz);
  }

  /// Maximum and mean of the interpolant over a box.
  struct Range {
    float max = 0;
    float mean = 0;  ///< positive if max is
  };
  /// Over the box between the samples `first` and `last`, up to rounding; samples above
  /// `cap` count as that.
  /// Precondition: 0 <= first < last <= 8 brick_count() per component.
  Range range(Vec3i first, Vec3i last, float cap) const;

  Vec3i brick_count() const { return brick_count_; }
  /// The positive samples lie in [first(), last()]; first() > last() if there are none.
  Vec3i first() const { return extent_.first; }
  Vec3i last() const { return extent_.last; }
  bool is_empty() const { return extent_.maximum == 0; }
  float maximum() const { return extent_.maximum; }
  Rejected rejected() const { return rejected_; }
  size_t memory() const;  ///< [bytes]

 private:
  size_t brick_index(Vec3i b) const {
    return (static_cast<size_t>(b.z) * static_cast<size_t>(brick_count_.y) +
            static_cast<size_t>(b.y)) *
               static_cast<size_t>(brick_count_.x) +
           static_cast<size_t>(b.x);
  }
  // Where a brick's samples are, and what a code c of a compact one means: step * c.
  struct Entry {
    uint32_t index = 0;
    float step = 0;
  };
  // A brick on its way to its place.
  struct Stored {
    float step;
    std::vector<float> values{};    // of exact grids
    std::vector<uint16_t> codes{};  // of compact grids
  };
  struct Row;

  bool is_zero(Vec3i b) const { return bricks_[brick_index(b)].index == 0; }
  float sample(Entry brick, int i) const {
    const size_t at = size_t{brick.index} * brick_size + static_cast<size_t>(i);
    if (precision_ == Precision::exact) return values_.data()[at];
    return brick.step * static_cast<float>(codes_.data()[at]);
  }
  void add_slab(int first, int last, const Source& source,
                std::map<float, Entry>& constants);
  Stored store(std::span<const float, brick_size> samples) const;
  Entry append(const Stored& brick);
  Entry append_constant(float value);

  template <typename T>
  static float trilinear(const T* v, float fx, float fy, float fz) {
    const auto f = [v](int i) { return static_cast<float>(v[i]); };
    constexpr int y = side, z = side * side;
    const float v0 = mix(mix(f(0), f(1), fx), mix(f(y), f(y + 1), fx), fy);
    const float v1 = mix(mix(f(z), f(z + 1), fx), mix(f(z + y), f(z + y + 1), fx), fy);
    return mix(v0, v1, fz);
  }
  // a + f (b - a) stays within [min(a, b), max(a, b)] up to one rounding error.
  static float mix(float a, float b, float f) { return a + f * (b - a); }

  Vec3i brick_count_;
  Precision precision_;
  std::vector<Entry> bricks_;     // index zero is the brick of zeros
  GrowingArray<float> values_;    // of exact grids
  GrowingArray<uint16_t> codes_;  // of compact grids
  uint32_t stored_ = 0;           // bricks that have samples
  Extent extent_;
  Rejected rejected_;
};

}  // namespace tyndall
