// SPDX-License-Identifier: Apache-2.0
#include "media/random_media.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

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

// Draws are statements of their own here: in which order arguments and operands are
// evaluated is the compiler's choice, and all compilers are to run the same tests.

Vec3 random_direction(RandomStream& rng) {
  const float cos_theta = uniform(rng, -1, 1);
  return spherical_direction(cos_theta, uniform(rng, 0, 2 * pi));
}

Transform random_rotation(RandomStream& rng) {
  const Vec3 axis = random_direction(rng);
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
    case Placement::sheared: {
      const Transform rotation = random_rotation(rng);
      return rotation * random_shear(rng) * Transform::scale({1, 2, 0.5f});
    }
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
  if (start == RayStart::outside) {
    const Vec3 direction = random_direction(rng);
    o = bounds.center() + direction * (uniform(rng, 1, 4) * bounds.radius());
  }
  if (start == RayStart::parallel_to_axis) {
    target = o;
    o.z = bounds.min.z - bounds.radius();
  }
  const Vec3 o_world = world_from_medium.point(o);
  return {o_world, normalize(world_from_medium.point(target) - o_world)};
}

namespace {

struct DoublePoint {
  double x[3];
};

// The interpolant at a point of medium space.
double interpolate(const DensityGrid& grid, const Bounds3& bounds, DoublePoint p) {
  const Vec3i n = grid.resolution;
  const int counts[3] = {n.x, n.y, n.z};
  int first[3];
  double f[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double min = double{bounds.min[axis]}, max = double{bounds.max[axis]};
    if (p.x[axis] < min || p.x[axis] > max) return 0;
    const double x = (p.x[axis] - min) / (max - min) * counts[axis] - 0.5;
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

}  // namespace

double reference_density(const DensityGrid& grid, const Bounds3& bounds,
                         const Transform& world_from_medium, Vec3 p_world) {
  DoublePoint p{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto& row = world_from_medium.inverse_matrix()[static_cast<size_t>(axis)];
    p.x[axis] = double{row[3]};
    for (int k = 0; k < 3; ++k)
      p.x[axis] += double{row[static_cast<size_t>(k)]} * double{p_world[k]};
  }
  return interpolate(grid, bounds, p);
}

double reference_optical_depth(const DensityGrid& grid, const Bounds3& bounds,
                               const Transform& world_from_medium, const Ray& ray,
                               double t_max) {
  const Matrix4& m = world_from_medium.inverse_matrix();
  const int counts[3] = {grid.resolution.x, grid.resolution.y, grid.resolution.z};
  DoublePoint o{}, d{};
  std::vector<double> t{0, t_max};
  // The interpolant is cubic along the ray between the planes of the samples and of the
  // box.
  for (int axis = 0; axis < 3; ++axis) {
    const auto& row = m[static_cast<size_t>(axis)];
    for (int k = 0; k < 3; ++k) {
      o.x[axis] += double{row[static_cast<size_t>(k)]} * double{ray.o[k]};
      d.x[axis] += double{row[static_cast<size_t>(k)]} * double{ray.d[k]};
    }
    o.x[axis] += double{row[3]};
    const double min = double{bounds.min[axis]}, size = double{bounds.diagonal()[axis]};
    const auto add_plane = [&](double x) {
      const double hit = (min + size * x / counts[axis] - o.x[axis]) / d.x[axis];
      if (hit > 0 && hit < t_max) t.push_back(hit);
    };
    for (int i = -1; i <= counts[axis]; ++i) add_plane(i + 0.5);
    add_plane(0);
    add_plane(counts[axis]);
  }
  std::sort(t.begin(), t.end());
  double sum = 0;
  for (size_t i = 1; i < t.size(); ++i) {
    const double half = 0.5 * (t[i] - t[i - 1]), middle = 0.5 * (t[i] + t[i - 1]);
    for (const double x : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
      const double at = middle + half * x;
      sum +=
          half *
          interpolate(grid, bounds,
                      {{o.x[0] + at * d.x[0], o.x[1] + at * d.x[1], o.x[2] + at * d.x[2]}});
    }
  }
  return sum;
}

}  // namespace tyndall
