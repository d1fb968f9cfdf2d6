// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/pixel_lattice.h"

#include <numeric>

namespace tyndall {
namespace {

constexpr int largest_stride = 32;
// Fewer leave threads without work.
constexpr size_t least_tiles = 16;

size_t count_along(int size, int of_one) {
  return static_cast<size_t>((size + of_one - 1) / of_one);
}

// Near the golden section of n, so that multiples of it modulo n are spread evenly, and
// without a factor in common with n, so that they are all numbers.
size_t scattering_step(size_t n) {
  auto step = std::max<size_t>(static_cast<size_t>(0.618 * static_cast<double>(n)), 1);
  while (std::gcd(step, n) != 1) ++step;
  return step;
}

}  // namespace

PixelLattice::PixelLattice(Vec2i min, Vec2i max, int stride, bool is_coarsest, Tiles tiles)
    : min_(min),
      max_(max),
      stride_(stride),
      is_coarsest_(is_coarsest),
      columns_(count_along(max.x - min.x, tile_size * stride)),
      tiles_(columns_ * count_along(max.y - min.y, tile_size * stride)) {
  if (tiles == Tiles::scattered) step_ = scattering_step(tiles_);
}

std::vector<PixelLattice> all_pixels(Vec2i min, Vec2i max) {
  return {PixelLattice(min, max, 1, true, PixelLattice::Tiles::in_rows)};
}

std::vector<PixelLattice> pixels_from_coarse_to_fine(Vec2i min, Vec2i max) {
  std::vector<PixelLattice> lattices;
  for (int stride = largest_stride; stride >= 1; stride /= 2) {
    const PixelLattice lattice(min, max, stride, lattices.empty(),
                               PixelLattice::Tiles::scattered);
    if (lattice.tiles() >= least_tiles || stride == 1) lattices.push_back(lattice);
  }
  return lattices;
}

}  // namespace tyndall
