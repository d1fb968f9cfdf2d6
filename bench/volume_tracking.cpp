// SPDX-License-Identifier: Apache-2.0
//
// What a ray through a volume costs: transmittance estimates and delta-tracking collisions,
// in the renderer's sparse bricks and in a dense float grid with the same majorants; and
// again with ten times the voxels of the same density, at the same mean optical depth.
// Times are processor time of one thread; the three are measured in turn, and the medians
// of the rounds are printed.
//
//   build/release/bench/tyndall_volume_tracking FILE...
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tyndall/math/constants.h"
#include "tyndall/media/distance_proxy.h"
#include "tyndall/media/grid_medium.h"
#include "tyndall/media/ratio_tracking.h"
#include "tyndall/media/tracking.h"
#include "tyndall/media/volume_file.h"
#include "tyndall/sampling/warps.h"

namespace {

using namespace tyndall;

constexpr int ray_count = 16384, rounds = 7;

// All samples of a brick grid.
struct DenseField {
  Vec3i n;
  std::vector<float> values;

  explicit DenseField(const BrickGrid& grid)
      : n{8 * grid.brick_count().x, 8 * grid.brick_count().y, 8 * grid.brick_count().z} {
    for (int z = 0; z < n.z; ++z)
      for (int y = 0; y < n.y; ++y)
        for (int x = 0; x < n.x; ++x)
          values.push_back(grid.interpolate(
              {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}));
  }

  float interpolate(Vec3 p) const {
    const int x = std::min(static_cast<int>(p.x), n.x - 2),
              y = std::min(static_cast<int>(p.y), n.y - 2),
              z = std::min(static_cast<int>(p.z), n.z - 2);
    const float fx = p.x - static_cast<float>(x), fy = p.y - static_cast<float>(y),
                fz = p.z - static_cast<float>(z);
    const size_t row = static_cast<size_t>(n.x), plane = row * static_cast<size_t>(n.y);
    const float* v = values.data() + static_cast<size_t>(z) * plane +
                     static_cast<size_t>(y) * row + static_cast<size_t>(x);
    const auto mix = [](float a, float b, float f) { return a + f * (b - a); };
    const auto line = [&](const float* w) { return mix(w[0], w[1], fx); };
    const auto face = [&](const float* w) { return mix(line(w), line(w + row), fy); };
    return mix(face(v), face(v + plane), fz);
  }
};

// A GridMedium whose densities are looked up in a dense grid: the same walk, other memory.
class DenseMedium {
 public:
  DenseMedium(const GridMedium& medium, const DenseField& field, float sigma)
      : medium_(medium), field_(field), sigma_(sigma) {}

  class Segments {
   public:
    Segments(const DenseMedium& medium, const Ray& ray, float t_max)
        : medium_(medium), segments_(medium.medium_.segments(ray, t_max)) {
      const auto clip = medium.medium_.placement().clip(ray, t_max);
      if (!clip) return;
      ray_ = clip->ray;
      t_offset_ = clip->t_offset;
    }
    bool next(MediumSegment& s) { return segments_.next(s); }
    Rgb sigma_t(float t) const {
      return Rgb(medium_.sigma_ * medium_.field_.interpolate(ray_.at(t - t_offset_)));
    }
    MediumProperties at(float t) const { return {Rgb(0), sigma_t(t), Rgb(0)}; }

   private:
    const DenseMedium& medium_;
    GridMedium::Segments segments_;
    GridRay ray_;
    float t_offset_ = 0;
  };
  Segments segments(const Ray& ray, float t_max) const { return {*this, ray, t_max}; }
  bool is_grey() const { return true; }

 private:
  const GridMedium& medium_;
  const DenseField& field_;
  float sigma_;
};

GridMedium make_medium(const PlacedGrid& grid, float sigma) {
  return {grid, Transform(), {Rgb(0), Rgb(sigma), {}}, IsotropicPhase{}};
}

// The interpolant of `grid`, sampled at ten times as many points.
PlacedGrid refined(const PlacedGrid& grid) {
  const float step = std::cbrt(0.1f);
  const Vec3i bricks = grid.grid->brick_count();
  const auto more = [&](int n) { return static_cast<int>(std::ceil(float(n) / step)); };
  const auto source = [&](Vec3i brick, BrickGrid::Samples samples) {
    size_t i = 0;
    for (int z = 0; z < BrickGrid::side; ++z)
      for (int y = 0; y < BrickGrid::side; ++y)
        for (int x = 0; x < BrickGrid::side; ++x) {
          const Vec3 p =
              Vec3{static_cast<float>(8 * brick.x + x), static_cast<float>(8 * brick.y + y),
                   static_cast<float>(8 * brick.z + z)} *
              step;
          samples[i++] = grid.box.contains(p) ? grid.grid->interpolate(p) : 0;
        }
    return true;
  };
  return {{grid.medium_from_grid * Transform::scale({step, step, step}),
           {grid.box.min / step, grid.box.max / step}},
          std::make_shared<BrickGrid>(Vec3i{more(bricks.x), more(bricks.y), more(bricks.z)},
                                      source, BrickGrid::Precision::compact)};
}

// From points of positive density in random directions.
std::vector<Ray> rays_from_inside(const GridMedium& medium) {
  RandomStream rng(5);
  std::vector<Ray> rays;
  const Bounds3 box = medium.placement().box();
  while (rays.size() < ray_count) {
    const Vec3 u{rng.next_1d(), rng.next_1d(), rng.next_1d()};
    const float cos_theta = 2 * rng.next_1d() - 1;
    const Ray ray{medium.placement().world_from_grid().point(box.min + box.diagonal() * u),
                  spherical_direction(cos_theta, 2 * pi * rng.next_1d())};
    if (medium.at(ray.o).sigma_s.r > 0) rays.push_back(ray);
  }
  return rays;
}

float unit_depth(const GridMedium& medium, const std::vector<Ray>& rays) {
  double sum = 0;
  for (const Ray& ray : rays)
    sum += double{DistanceProxy(medium, ray, infinity).optical_depth(infinity).r};
  return static_cast<float>(sum / static_cast<double>(rays.size()));
}

// [ns of processor time per ray]
double time_per_ray(const std::vector<Ray>& rays,
                    const std::function<float(const Ray&)>& f) {
  volatile float sink = 0;
  const std::clock_t start = std::clock();
  for (const Ray& ray : rays) sink = f(ray);
  static_cast<void>(sink);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC * 1e9 /
         static_cast<double>(rays.size());
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + rounds / 2, values.end());
  return values[rounds / 2];
}

template <typename M>
float transmittance(const M& medium, const Ray& ray, RandomStream& rng) {
  return residual_ratio_tracking(medium, ray, infinity, rng).r;
}

template <typename M>
float delta_tracking(const M& medium, const Ray& ray, RandomStream& rng) {
  float t_hit = -1;
  sample_collisions(medium, ray, infinity, 0, rng,
                    [&](float t, const MediumProperties& p, Rgb majorant, Rgb) {
                      if (rng.next_1d() * majorant.r >= p.sigma_s.r) return true;
                      t_hit = t;
                      return false;
                    });
  return t_hit;
}

void measure(const std::string& name, const PlacedGrid& grid, const PlacedGrid& fine,
             const DenseField& dense_field, const std::vector<Ray>& rays, float sigma,
             float depth) {
  const GridMedium bricks = make_medium(grid, sigma), finer = make_medium(fine, sigma);
  const DenseMedium dense(bricks, dense_field, sigma);
  RandomStream rng(1);
  std::vector<double> t[6];
  for (int i = 0; i < rounds; ++i) {
    t[0].push_back(
        time_per_ray(rays, [&](auto& r) { return transmittance(bricks, r, rng); }));
    t[1].push_back(
        time_per_ray(rays, [&](auto& r) { return transmittance(dense, r, rng); }));
    t[2].push_back(
        time_per_ray(rays, [&](auto& r) { return transmittance(finer, r, rng); }));
    t[3].push_back(
        time_per_ray(rays, [&](auto& r) { return delta_tracking(bricks, r, rng); }));
    t[4].push_back(
        time_per_ray(rays, [&](auto& r) { return delta_tracking(dense, r, rng); }));
    t[5].push_back(
        time_per_ray(rays, [&](auto& r) { return delta_tracking(finer, r, rng); }));
  }
  for (int kind = 0; kind < 2; ++kind) {
    const double a = median(t[3 * kind]), b = median(t[3 * kind + 1]),
                 c = median(t[3 * kind + 2]);
    std::printf("%-32s %5.2f %-13s %9.0f %9.0f  x%.2f %9.0f  x%.2f\n", name.c_str(),
                double{depth}, kind == 0 ? "transmittance" : "delta", 1e6 / a, 1e6 / b,
                b / a, 1e6 / c, c / a);
  }
}

void measure_file(const std::string& path) {
  for (const VolumeGridInfo& info : list_volume_names(path)) {
    if (!info.is_scalar) continue;
    const std::string_view names[] = {info.name};
    const PlacedGrid grid = read_volume(path, names);
    if (grid.grid->is_empty()) continue;
    const PlacedGrid fine = refined(grid);
    const DenseField dense(*grid.grid);
    const GridMedium unit = make_medium(grid, 1);
    const std::vector<Ray> rays = rays_from_inside(unit);
    const float unit_mean = unit_depth(unit, rays);
    const std::string name = path.substr(path.find_last_of('/') + 1) + " " + info.name;
    for (const float depth : {0.44f, 2.2f, 8.8f})
      measure(name, grid, fine, dense, rays, depth / unit_mean, depth);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("%-32s %5s %-13s %9s %9s  %5s %9s  %5s\n", "[thousand rays/s]", "depth", "",
              "bricks", "dense", "gain", "x10", "cost");
  for (int i = 1; i < argc; ++i) measure_file(argv[i]);
}
