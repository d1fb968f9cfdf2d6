// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tyndall/guiding/cell_grid.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// From where of a sky light gets to which place: through a window, say. For each cell of a
/// grid in world space a density on the unit square whose points the sky's own sampling
/// turns into directions, piecewise constant over equal squares. What is bright takes up
/// much of that square, so that it is known in detail.
///
/// Never less than a floor: a wrong guide costs variance, never bias. Cells may be set from
/// different threads; once finished, it may be read from all.
class SkyGuide {
 public:
  static constexpr int side = 16;
  static constexpr size_t strata = size_t{side} * side;
  /// How much arrives through each stratum, in any unit; row-major, row 0 at u.y = 0.
  using Weights = std::array<float, strata>;

  explicit SkyGuide(const CellGrid& grid);

  void set(size_t cell, const Weights& seen);
  /// To be called once all cells are set. What a cell sees its neighbours are taken to see
  /// a little as well, and so are neighbouring strata.
  void finish();

  /// Turns a uniform point of the unit square into one of the density at p.
  Vec2 sample(Vec3 p, Vec2 u) const;
  /// That density at a point of the unit square; its mean is one.
  float pdf(Vec3 p, Vec2 u) const;

  size_t memory() const { return codes_.size(); }  ///< [bytes]

 private:
  using Codes = std::span<const uint8_t, strata>;
  Codes codes(Vec3 p) const { return Codes(&codes_[grid_.find(p) * strata], strata); }
  Weights spread(int x, int y, int z) const;
  void encode(size_t cell, const Weights& weights);

  CellGrid grid_;
  std::vector<Weights> seen_;  // until finished
  std::vector<uint8_t> codes_;
};

}  // namespace tyndall
