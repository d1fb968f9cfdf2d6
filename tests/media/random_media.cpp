// SPDX-License-Identifier: Apache-2.0
#include "media/random_media.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tyndall {

DensityGrid random_grid(RandomStream& rng, Vec3i resolution, GridContent content) {
  const size_t count = static_cast<size_t>(resolution.x) *
                       static_cast<size_t>(resolution.y) *
                       static_cast<size_t>(resolution.z);
  DensityGrid grid{resolution, std::vector<float>(count)};
  for (float& v : grid.values) {
    const float u = rng.next_1d();
    switch (content) {
      case GridContent::uniform_noise:
        v = u;
        break;
      case GridContent::mostly_empty:
        v = u < 0.02f ? 50 * u : 0;
        break;
      case GridContent::dynamic_range:
        v = std::pow(10.0f, -12 + 18 * u);
        break;
      case GridContent::constant:
        v = 1;
        break;
    }
  }
  return grid;
}

float largest_value(const DensityGrid& grid) {
  return *std::max_element(grid.values.begin(), grid.values.end());
}

namespace {

Transform random_rotation(RandomStream& rng) {
  const Vec3 axis = spherical_direction(uniform(rng, -1, 1), uniform(rng, 0, 2 * pi));
  return Transform::rotate(uniform(rng, 0, 360), axis);
}

Transform random_shear(RandomStream& rng) {
  Matrix4 m{};
  for (size_t i = 0; i < 4; ++i) m[i][i] = 1;
  m[0][1] = uniform(rng, -0.8f, 0.8f);
  m[1][2] = uniform(rng, -0.8f, 0.8f);
  return *Transform::from_matrix(m);
}

}  // namespace

Transform random_transform(RandomStream& rng, Placement placement) {
  switch (placement) {
    case Placement::identity:
      return {};
    case Placement::rotated:
      return Transform::translate({3, -2, 1}) * random_rotation(rng);
    case Placement::sheared:
      return random_rotation(rng) * random_shear(rng) * Transform::scale({1, 2, 0.5f});
    case Placement::mirrored:
      return random_rotation(rng) * Transform::scale({-1.5f, 0.7f, 1});
    case Placement::tiny:
      return Transform::scale({1e-6f, 1e-6f, 1e-6f});
    case Placement::huge:
      return Transform::scale({1e8f, 1e8f, 1e8f}) * random_rotation(rng);
    case Placement::far_away:
      return Transform::translate({3000, -1000, 2000});
  }
  return {};
}

Ray random_ray(RandomStream& rng, RayStart start, const Bounds3& bounds,
               const Transform& world_from_medium) {
  const auto inside = [&] {
    return bounds.min +
           bounds.diagonal() * Vec3{rng.next_1d(), rng.next_1d(), rng.next_1d()};
  };
  Vec3 o = inside(), target = inside();
  if (start == RayStart::border) o.y = bounds.max.y;
  if (start == RayStart::outside)
    o = bounds.center() +
        spherical_direction(uniform(rng, -1, 1), uniform(rng, 0, 2 * pi)) *
            (uniform(rng, 1, 4) * bounds.radius());
  if (start == RayStart::parallel_to_axis) {
    target = o;
    o.z = bounds.min.z - bounds.radius();
  }
  const Vec3 o_world = world_from_medium.point(o);
  return {o_world, normalize(world_from_medium.point(target) - o_world)};
}

double reference_density(const DensityGrid& grid, const Bounds3& bounds, Vec3 p_medium) {
  if (!bounds.contains(p_medium)) return 0;
  const Vec3i n = grid.resolution;
  const int counts[3] = {n.x, n.y, n.z};
  int first[3];
  double f[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double x = (double{p_medium[axis]} - double{bounds.min[axis]}) /
                         double{bounds.diagonal()[axis]} * counts[axis] -
                     0.5;
    first[axis] = static_cast<int>(std::floor(x));
    f[axis] = x - first[axis];
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    int at[3];
    bool is_inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      const int bit = corner >> axis & 1;
      at[axis] = first[axis] + bit;
      weight *= bit ? f[axis] : 1 - f[axis];
      is_inside = is_inside && at[axis] >= 0 && at[axis] < counts[axis];
    }
    if (!is_inside) continue;
    const int index = (at[2] * n.y + at[1]) * n.x + at[0];
    sum += weight * double{grid.values[static_cast<size_t>(index)]};
  }
  return sum;
}

}  // namespace tyndall
