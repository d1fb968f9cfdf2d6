// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/filter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace tyndall {
namespace {

double mitchell(double x, double b, double c) {
  x = std::abs(x);
  if (x >= 2) return 0;
  if (x >= 1) {
    return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x +
            (8 * b + 24 * c)) /
           6;
  }
  return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) /
         6;
}

}  // namespace

Filter::Filter(const FilterSettings& settings)
    : settings_(settings),
      x_(make_axis(settings.radius.x)),
      y_(make_axis(settings.radius.y)) {}

double Filter::eval_axis(double x, double radius) const {
  if (std::abs(x) > radius) return 0;
  switch (settings_.kind) {
    case FilterKind::box:
      return 1;
    case FilterKind::triangle:
      return radius - std::abs(x);
    case FilterKind::gaussian: {
      const double scale = -0.5 / sqr(static_cast<double>(settings_.sigma));
      return std::exp(scale * sqr(x)) - std::exp(scale * sqr(radius));
    }
    case FilterKind::mitchell:
      return mitchell(2 * x / radius, settings_.b, settings_.c);
  }
  return 0;
}

float Filter::eval(Vec2 offset) const {
  return static_cast<float>(eval_axis(offset.x, settings_.radius.x) *
                            eval_axis(offset.y, settings_.radius.y));
}

Filter::Axis Filter::make_axis(double radius) const {
  assert(radius > 0);
  const size_t bins = settings_.kind == FilterKind::box ? 1 : 1024;
  std::vector<float> magnitudes;
  std::vector<bool> is_negative;
  double sum = 0, sum_magnitudes = 0;
  for (size_t i = 0; i < bins; ++i) {
    const auto at = [&](double step) {
      return eval_axis(
          radius * (2 * (static_cast<double>(i) + step) / static_cast<double>(bins) - 1),
          radius);
    };
    const double mean = (at(0) + 4 * at(0.5) + at(1)) / 6;  // Simpson's rule
    magnitudes.push_back(static_cast<float>(std::abs(mean)));
    is_negative.push_back(mean < 0);
    sum += mean;
    sum_magnitudes += std::abs(mean);
  }
  return {PiecewiseConstant1D(magnitudes), is_negative,
          static_cast<float>(sum_magnitudes / sum)};
}

bool Filter::Axis::is_negative_at(float x) const {
  const size_t bins = is_negative.size();
  return is_negative[std::min(static_cast<size_t>(x * static_cast<float>(bins)), bins - 1)];
}

FilterSample Filter::sample(Vec2 u) const {
  const float x = x_.distribution.sample(u.x).x;
  const float y = y_.distribution.sample(u.y).x;
  const bool negative = x_.is_negative_at(x) != y_.is_negative_at(y);
  const float weight = x_.weight * y_.weight;
  return {.offset = {settings_.radius.x * (2 * x - 1), settings_.radius.y * (2 * y - 1)},
          .weight = negative ? -weight : weight};
}

float Filter::density(Vec2 offset) const {
  const auto along = [](const Axis& axis, float t, float radius) {
    const float x = 0.5f * (t / radius + 1);
    if (!(x >= 0 && x < 1)) return 0.0f;
    const float magnitude = axis.distribution.pdf(x) * axis.weight / (2 * radius);
    return axis.is_negative_at(x) ? -magnitude : magnitude;
  };
  return along(x_, offset.x, settings_.radius.x) * along(y_, offset.y, settings_.radius.y);
}

}  // namespace tyndall
