// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tyndall/math/vec.h"

namespace tyndall {

/// Sums of what was recorded in each pixel of a picture; of large pictures, in each block
/// of a few pixels. Integers, so that their order does not matter: record() may be called
/// from many threads.
class PixelSums {
 public:
  struct Sum {
    std::atomic<int64_t> value = 0, count = 0;
  };

  explicit PixelSums(Vec2i resolution);

  /// Pixels beyond the picture count to what is nearest.
  void record(Vec2i pixel, int64_t value) const;
  void clear();

  size_t size() const { return sums_.size(); }
  const Sum& operator[](size_t block) const { return sums_[block]; }
  /// A pixel of the block.
  Vec2i pixel(size_t block) const;

 private:
  Vec2i resolution_, size_;
  mutable std::vector<Sum> sums_;
};

}  // namespace tyndall
