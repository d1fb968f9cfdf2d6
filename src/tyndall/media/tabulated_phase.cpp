// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/tabulated_phase.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tyndall/math/constants.h"
#include "tyndall/math/frame.h"

namespace tyndall {

TabulatedPhase::TabulatedPhase(std::span<const float> values) {
  assert(values.size() >= 2);
  const size_t intervals = values.size() - 1;
  const double width = 2.0 / static_cast<double>(intervals);
  double integral = 0, moment = 0;
  std::vector<double> cdf{0};
  for (size_t i = 0; i < intervals; ++i) {
    const double a = double{values[i]}, b = double{values[i + 1]};
    const double cosine = -1 + width * static_cast<double>(i);
    integral += 0.5 * width * (a + b);
    // The integral of x f(x) over an interval on which f is linear.
    moment += width * (0.5 * cosine * (a + b) + width * (a + 2 * b) / 6);
    cdf.push_back(integral);
  }
  assert(integral > 0 && std::isfinite(integral));
  Table table{
      .values = {}, .cdf = {}, .mean_cosine = static_cast<float>(moment / integral)};
  for (const float v : values)
    table.values.push_back(static_cast<float>(double{v} / integral));
  for (const double c : cdf) table.cdf.push_back(static_cast<float>(c / integral));
  table.cdf.back() = 1;
  table_ = std::make_shared<const Table>(std::move(table));
}

float TabulatedPhase::density(float cos_theta) const {
  const std::vector<float>& v = table_->values;
  const size_t intervals = v.size() - 1;
  const float x =
      std::clamp(0.5f * (cos_theta + 1), 0.0f, 1.0f) * static_cast<float>(intervals);
  const size_t i = std::min(static_cast<size_t>(x), intervals - 1);
  return std::lerp(v[i], v[i + 1], x - static_cast<float>(i));
}

float TabulatedPhase::eval(Vec3 wo, Vec3 wi) const {
  return density(-dot(wo, wi)) * (0.5f * inv_pi);
}

std::optional<PhaseSample> TabulatedPhase::sample(Vec3 wo, Vec2 u) const {
  const std::vector<float>& cdf = table_->cdf;
  const size_t intervals = cdf.size() - 1;
  // The last node whose cdf is not above u; what follows it has probability.
  const size_t above =
      static_cast<size_t>(std::upper_bound(cdf.begin(), cdf.end(), u.x) - cdf.begin());
  const size_t i = std::clamp(above, size_t{1}, intervals) - 1;
  const float width = 2 / static_cast<float>(intervals);
  const float a = table_->values[i], b = table_->values[i + 1];
  // a x + (b - a) x^2 / (2 width) = rest, solved without cancellation.
  const float rest = u.x - cdf[i];
  const float root = a + std::sqrt(std::max(a * a + 2 * rest * (b - a) / width, 0.0f));
  const float x = root > 0 ? std::clamp(2 * rest / root, 0.0f, width) : 0;
  const float cos_theta = std::clamp(-1 + width * static_cast<float>(i) + x, -1.0f, 1.0f);
  const Vec3 local = spherical_direction_of_turns(cos_theta, u.y);
  const Vec3 wi = Frame::from_z(-wo).to_world(local);
  const float p = eval(wo, wi);
  return PhaseSample{.wi = wi, .value = p, .pdf = p};
}

}  // namespace tyndall
