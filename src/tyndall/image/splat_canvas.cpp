// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/splat_canvas.h"

#include <algorithm>
#include <cmath>

#include "tyndall/math/parallel_for.h"

namespace tyndall {
namespace {

// Each band of rows goes through all splats.
constexpr int max_bands = 16;

// The pixels, relative to `min`, whose centers lie within `radius` of x: [first, end).
struct Reach {
  int first, end;
};

Reach reach(float x, float radius, int min, int size) {
  const auto bound = [&](float edge) {
    const float pixel = std::ceil(edge - 0.5f) - static_cast<float>(min);
    return static_cast<int>(std::clamp(pixel, 0.0f, static_cast<float>(size)));
  };
  return {bound(x - radius), bound(x + radius)};
}

}  // namespace

SplatCanvas::SplatCanvas(const Filter& filter, Vec2i crop_min, Vec2i crop_max)
    : filter_(&filter), crop_min_(crop_min), crop_max_(crop_max) {
  sums_.resize(3 * static_cast<size_t>(width()) * static_cast<size_t>(height()));
}

bool SplatCanvas::is_seen(Vec2 p) const {
  const Reach x = reach(p.x, filter_->radius().x, crop_min_.x, width());
  const Reach y = reach(p.y, filter_->radius().y, crop_min_.y, height());
  return x.first < x.end && y.first < y.end;
}

void SplatCanvas::add(std::span<const std::vector<Splat>> batches) {
  const int bands = std::min(max_bands, height());
  parallel_for(static_cast<size_t>(bands), [&](size_t i) {
    const auto band = static_cast<int>(i);
    const int first = height() * band / bands, end = height() * (band + 1) / bands;
    for (const std::vector<Splat>& batch : batches)
      for (const Splat& splat : batch) add_to_rows(splat, first, end);
  });
}

void SplatCanvas::add_to_rows(const Splat& splat, int first_row, int end_row) {
  const Vec2 p = splat.p_film;
  const Reach rows =
      reach(p.y, filter_->radius().y, crop_min_.y + first_row, end_row - first_row);
  if (rows.first >= rows.end) return;
  const Reach columns = reach(p.x, filter_->radius().x, crop_min_.x, width());
  for (int y = first_row + rows.first; y < first_row + rows.end; ++y)
    for (int x = columns.first; x < columns.end; ++x) {
      const Vec2 center{static_cast<float>(crop_min_.x + x) + 0.5f,
                        static_cast<float>(crop_min_.y + y) + 0.5f};
      const double weight = double{filter_->density(p - center)};
      double* sum = &sums_[3 * (static_cast<size_t>(y) * static_cast<size_t>(width()) +
                                static_cast<size_t>(x))];
      for (int c = 0; c < 3; ++c) sum[c] += weight * double{splat.value[c]};
    }
}

void SplatCanvas::give(Film& film, double scale) {
  for (double& sum : sums_) sum *= scale;
  film.add_splats(sums_);
  clear();
}

void SplatCanvas::clear() { std::ranges::fill(sums_, 0.0); }

}  // namespace tyndall
