// SPDX-License-Identifier: Apache-2.0
#include "tyndall/sampling/sampler.h"

namespace tyndall {
namespace {

constexpr uint64_t golden_ratio = 0x9e3779b97f4a7c15u;
constexpr uint64_t fork_salt = 0xd1b54a32d192ed03u;
constexpr uint64_t shuffle_multiplier =
    0xd1342543de82ef95u;  // any odd number without pattern

constexpr uint64_t reverse_bits(uint64_t x) {
  x = __builtin_bswap64(x);
  x = ((x >> 4) & 0x0f0f0f0f0f0f0f0fu) | ((x & 0x0f0f0f0f0f0f0f0fu) << 4);
  x = ((x >> 2) & 0x3333333333333333u) | ((x & 0x3333333333333333u) << 2);
  return ((x >> 1) & 0x5555555555555555u) | ((x & 0x5555555555555555u) << 1);
}

constexpr uint32_t high(uint64_t x) { return static_cast<uint32_t>(x >> 32); }
constexpr uint32_t low(uint64_t x) { return static_cast<uint32_t>(x); }

constexpr uint32_t reverse_bits(uint32_t x) { return high(reverse_bits(uint64_t{x})); }

// A random permutation of which each bit depends on the seed and on lower bits only: Owen
// scrambling of numbers whose bits are reversed. The hash of Laine and Karras in the form
// that [Vegdahl21] found to have the least bias.
constexpr uint32_t scramble_reversed(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// The second Sobol coordinate with reversed bits, from the index. The generator matrix is
// Pascal's triangle modulo 2: binomial(j, i) is odd when the bits of i are a subset of
// those of j, so the product is a sum over supersets, which needs one step per bit of the
// position.
constexpr uint32_t sobol_reversed(uint32_t index) {
  index ^= (index >> 1) & 0x55555555u;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 8) & 0x00ff00ffu;
  return index ^ (index >> 16);
}

}  // namespace

Sampler::Sampler(SamplerKind kind, uint64_t seed, Vec2i pixel, uint32_t index)
    : kind_(kind),
      pixel_(pixel),
      index_(index),
      reversed_index_(reverse_bits(index)),
      key_(hash(seed, pixel.x, pixel.y)) {
  // Sobol points of one pixel share their scrambles; independent numbers share nothing.
  if (kind == SamplerKind::independent) key_ = hash(key_, index);
}

float Sampler::next_1d() {
  const uint64_t bits = mix_bits(key_ + golden_ratio * ++dimension_);
  if (kind_ == SamplerKind::independent) return uniform_float(high(bits));
  const uint32_t shuffled = reverse_bits(scramble_reversed(reversed_index_, low(bits)));
  return uniform_float(reverse_bits(scramble_reversed(shuffled, high(bits))));
}

Vec2 Sampler::next_2d() {
  const uint64_t bits = mix_bits(key_ + golden_ratio * ++dimension_);
  if (kind_ == SamplerKind::independent)
    return {uniform_float(high(bits)), uniform_float(low(bits))};
  const uint32_t shuffle_seed = high(bits * shuffle_multiplier);
  const uint32_t shuffled = reverse_bits(scramble_reversed(reversed_index_, shuffle_seed));
  const uint32_t x = scramble_reversed(shuffled, high(bits));
  const uint32_t y = scramble_reversed(sobol_reversed(shuffled), low(bits));
  const uint64_t both = reverse_bits(uint64_t{y} << 32 | x);  // one reversal for the two
  return {uniform_float(high(both)), uniform_float(low(both))};
}

RandomStream Sampler::fork() {
  return RandomStream(hash(key_ ^ fork_salt, index_, ++dimension_));
}

}  // namespace tyndall
