// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/rgb_grid_medium.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "tyndall/media/placed_grid.h"

namespace tyndall {
namespace {

RgbGrid scaled(RgbGrid grid, float scale) {
  for (Rgb& v : grid.values) v *= scale;
  return grid;
}

// Coefficients that are multiplied by `scale` and, where they are above `largest` together,
// reduced to that in proportion. What is too large for a BrickGrid counts as zero.
struct Coefficients {
  RgbGrid sigma_t, sigma_s;
  bool is_reduced = false;

  Coefficients(const RgbGrid& sigma_a, const RgbGrid& given_sigma_s, float scale,
               float largest)
      : sigma_t(given_sigma_s), sigma_s(given_sigma_s) {
    assert(sigma_a.resolution == sigma_s.resolution);
    for (size_t i = 0; i < sigma_s.values.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double a = usable(sigma_a.values[i][c]), s = usable(sigma_s.values[i][c]);
        const double sum = (a + s) * double{scale};
        const bool is_large = sum > double{largest};
        const double factor = is_large ? double{largest} / (a + s) : double{scale};
        is_reduced |= is_large;
        sigma_s.values[i][c] = static_cast<float>(s * factor);
        sigma_t.values[i][c] = static_cast<float>((a + s) * factor);
      }
  }

 private:
  static double usable(float x) { return x <= BrickGrid::largest ? double{x} : 0; }
};

DensityGrid channel(const RgbGrid& grid, int c) {
  DensityGrid values{grid.resolution, {}};
  values.values.reserve(grid.values.size());
  for (const Rgb& v : grid.values) values.values.push_back(v[c]);
  return values;
}

const RgbGrid& any_coefficient(const RgbGridMedium::Grids& grids) {
  assert(grids.sigma_a || grids.sigma_s);
  return grids.sigma_a ? *grids.sigma_a : *grids.sigma_s;
}

}  // namespace

std::shared_ptr<const RgbGridMedium::Field> RgbGridMedium::make_field(const RgbGrid& grid) {
  return std::make_shared<Field>(Field{BrickGrid::from_dense(channel(grid, 0)),
                                       BrickGrid::from_dense(channel(grid, 1)),
                                       BrickGrid::from_dense(channel(grid, 2))});
}

RgbGridMedium::RgbGridMedium(const Grids& grids, const Bounds3& bounds,
                             const Transform& world_from_medium, float scale,
                             float Le_scale, PhaseFunction phase)
    : placement_(place_in_box(any_coefficient(grids).resolution, bounds),
                 world_from_medium),
      phase_(std::move(phase)) {
  const RgbGrid& given = any_coefficient(grids);
  const RgbGrid one{given.resolution, std::vector<Rgb>(given.values.size(), Rgb(1))};
  const float largest =
      std::min(opaque_density(1, placement_.world_from_grid()), BrickGrid::largest);
  const Coefficients sigma(grids.sigma_a.value_or(one), grids.sigma_s.value_or(one), scale,
                           largest);
  is_reduced_ = sigma.is_reduced;
  sigma_t_ = make_field(sigma.sigma_t);
  sigma_s_ = make_field(sigma.sigma_s);
  if (grids.Le && Le_scale > 0) Le_ = make_field(scaled(*grids.Le, Le_scale));
  bounds_ = std::make_shared<DensityBounds<3>>(
      DensityBounds<3>::Densities{&sigma_t_->r, &sigma_t_->g, &sigma_t_->b}, 1.0f, largest);
}

}  // namespace tyndall
