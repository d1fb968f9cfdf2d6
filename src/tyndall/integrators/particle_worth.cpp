// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/particle_worth.h"

#include <algorithm>
#include <limits>

namespace tyndall {
namespace {

constexpr int block_size = 8;  // [pixels]
// Pixels that vary most are those of rare paths that particles do not find either.
constexpr double trimmed = 0.01;
// Radiance that is dark for a picture, relative to its mean.
constexpr double dark = 0.1;

double sum(const std::array<double, 3>& values) {
  return values[0] + values[1] + values[2];
}

double squared(const std::array<double, 3>& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

// The integral of the squared filter, by the midpoint rule.
double integral_of_square(const Filter& filter) {
  constexpr int n = 64;
  const Vec2 r = filter.radius();
  double total = 0;
  for (int i = 0; i < n * n; ++i) {
    const Vec2 u{(static_cast<float>(i % n) + 0.5f) / n,
                 (static_cast<float>(i / n) + 0.5f) / n};
    total += sqr(double{filter.density({r.x * (2 * u.x - 1), r.y * (2 * u.y - 1)})});
  }
  return total * 4 * double{r.x} * double{r.y} / (n * n);
}

// The sum without the largest values.
double trimmed_sum(std::vector<double> values) {
  const auto kept = static_cast<size_t>((1 - trimmed) * static_cast<double>(values.size()));
  if (kept == 0 || kept == values.size()) return 0;
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(kept));
  double total = 0;
  for (size_t i = 0; i < kept; ++i) total += values[i];
  return total;
}

}  // namespace

ParticleWorth::ParticleWorth(const Film& film, const Filter& filter)
    : film_(&film), filter_square_(integral_of_square(filter)) {
  const Vec2i size = film.crop_max() - film.crop_min();
  blocks_ = {(size.x + block_size - 1) / block_size,
             (size.y + block_size - 1) / block_size};
  const size_t blocks = static_cast<size_t>(blocks_.x) * static_cast<size_t>(blocks_.y);
  std::vector<std::array<double, 3>> radiance(blocks);
  std::vector<double> pixels(blocks);
  std::array<double, 3> mean{};
  const auto block = [&](int x, int y) {
    return static_cast<size_t>(y / block_size) * static_cast<size_t>(blocks_.x) +
           static_cast<size_t>(x / block_size);
  };
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const Film::Estimate pixel = film.estimate(film.crop_min() + Vec2i{x, y});
      for (size_t c = 0; c < 3; ++c) {
        radiance[block(x, y)][c] += pixel.mean[c];
        mean[c] += pixel.mean[c] / (static_cast<double>(size.x) * size.y);
      }
      ++pixels[block(x, y)];
    }
  for (size_t i = 0; i < blocks; ++i)
    weights_.push_back(1 /
                       (squared(radiance[i]) / sqr(pixels[i]) + sqr(dark) * squared(mean)));
  std::vector<double> variances;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      variances.push_back(sum(film.estimate(film.crop_min() + Vec2i{x, y}).variance) *
                          weights_[block(x, y)]);
  variance_ = trimmed_sum(std::move(variances));
}

ParticleWorth::Moments ParticleWorth::moments(const std::vector<Splat>& splats,
                                              double count, double imaging_ratio) const {
  Moments moments{};
  for (const Splat& splat : splats) {
    const double r = double{splat.ratio};
    const double v2 =
        squared({double{splat.value.r}, double{splat.value.g}, double{splat.value.b}}) *
        sqr(imaging_ratio / count) * weights_[block_of(splat.p_film)];
    for (size_t i = 0; i < shares.size(); ++i) {
      const double s = shares[i];
      // In a form that has the right limits for r = infinity.
      const double turned = s > 0 ? (1 / r + 1) / (1 / r + s) : 1 + r;
      moments[i] += v2 * sqr(turned) * (1 / r + filter_square_ * s);
    }
  }
  return moments;
}

size_t ParticleWorth::block_of(Vec2 p) const {
  const Vec2i min = film_->crop_min();
  const auto along = [](float x, int first, int blocks) {
    const float i = (x - static_cast<float>(first)) / block_size;
    return static_cast<size_t>(std::clamp(i, 0.0f, static_cast<float>(blocks - 1)));
  };
  return along(p.y, min.y, blocks_.y) * static_cast<size_t>(blocks_.x) +
         along(p.x, min.x, blocks_.x);
}

double ParticleWorth::best_share(const Moments& moments, double walk_cost,
                                 double particle_cost) const {
  constexpr size_t now = 3;
  static_assert(shares[now] == 1);
  // What has nothing to do with particles.
  const double rest = std::max(variance_ - moments[now], 0.05 * variance_);
  double best = 1, least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < shares.size(); ++i) {
    const double product = (rest + moments[i]) * (walk_cost + shares[i] * particle_cost);
    if (product < least) least = product, best = shares[i];
  }
  return best;
}

}  // namespace tyndall
