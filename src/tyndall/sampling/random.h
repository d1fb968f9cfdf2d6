// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tyndall/math/constants.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// A bijection of 64-bit numbers without visible structure (the finaliser of MurmurHash3,
/// with the constants of Stafford's variant 13).
constexpr uint64_t mix_bits(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// One hash of several numbers; order matters.
template <typename... Ts>
constexpr uint64_t hash(Ts... values) {
  uint64_t h = 0x9e3779b97f4a7c15u;
  ((h = mix_bits(h ^ (static_cast<uint64_t>(values) + 0x9e3779b97f4a7c15u + (h << 6)))),
   ...);
  return h;
}

/// The 24 high bits of `bits` as a number in [0, 1).
constexpr float uniform_float(uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// A stream of uniform numbers that is a pure function of its key and a counter: the n-th
/// number of a key is the same on every thread and machine (SplitMix64). Cheap to make and
/// copy.
class RandomStream {
 public:
  explicit constexpr RandomStream(uint64_t key) : state_(mix_bits(key)) {}

  constexpr uint32_t next_bits() {
    state_ += 0x9e3779b97f4a7c15u;
    return static_cast<uint32_t>(mix_bits(state_) >> 32);
  }
  /// Uniform in [0, 1).
  constexpr float next_1d() { return uniform_float(next_bits()); }
  constexpr Vec2 next_2d() {
    const float x = next_1d();
    return {x, next_1d()};
  }

 private:
  uint64_t state_;
};

}  // namespace tyndall
