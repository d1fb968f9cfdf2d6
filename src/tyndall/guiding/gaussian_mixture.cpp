// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/gaussian_mixture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tyndall/guiding/vector_exp.h"
#include "tyndall/math/constants.h"
#include "tyndall/math/elementary.h"

namespace tyndall {

namespace {

// A fixed tree, so that the sum is the same however the loops were vectorized.
float sum(const GaussianMixture::Lanes& v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

double normal_cdf(double x) { return 0.5 * std::erfc(-x * 0.70710678118654752); }

}  // namespace

GaussianMixture::GaussianMixture(std::span<const GaussianComponent> components) {
  assert(components.size() <= static_cast<size_t>(capacity));
  float total = 0;
  for (const GaussianComponent& c : components) total += c.weight;
  assert(components.empty() || total > 0);
  for (GaussianComponent c : components) {
    c.weight /= total;
    if (c.weight > 0) set(size_++, c);
  }
}

void GaussianMixture::set(int k, const GaussianComponent& c) {
  const auto i = static_cast<size_t>(k);
  assert(c.weight >= 0 && c.covariance.xx > 0 && c.covariance.determinant() > 0);
  const float factor_xx = std::sqrt(c.covariance.xx);
  const float factor_yx = c.covariance.xy / factor_xx;
  const float factor_yy = std::sqrt(c.covariance.determinant() / c.covariance.xx);
  mean_x_[i] = c.mean.x;
  mean_y_[i] = c.mean.y;
  inverse_xx_[i] = 1 / factor_xx;
  inverse_yy_[i] = 1 / factor_yy;
  inverse_yx_[i] = -factor_yx * inverse_xx_[i] * inverse_yy_[i];
  weight_[i] = c.weight;
  peak_[i] = c.weight * inverse_xx_[i] * inverse_yy_[i] * (0.5f * inv_pi);
}

GaussianComponent GaussianMixture::component(int k) const {
  assert(0 <= k && k < size_);
  const auto i = static_cast<size_t>(k);
  const float factor_xx = 1 / inverse_xx_[i];
  const float factor_yy = 1 / inverse_yy_[i];
  const float factor_yx = -inverse_yx_[i] * factor_xx * factor_yy;
  return {.weight = weight_[i],
          .mean = {mean_x_[i], mean_y_[i]},
          .covariance = {.xx = sqr(factor_xx),
                         .xy = factor_xx * factor_yx,
                         .yy = sqr(factor_yx) + sqr(factor_yy)}};
}

float GaussianMixture::eval_components(Vec2 p, Lanes& densities) const {
  for (size_t i = 0; i < capacity; ++i) {
    const float dx = p.x - mean_x_[i];
    const float dy = p.y - mean_y_[i];
    const float a = inverse_xx_[i] * dx;
    const float b = inverse_yx_[i] * dx + inverse_yy_[i] * dy;
    densities[i] = peak_[i] * exp_nonpositive(-0.5f * (a * a + b * b));
  }
  return sum(densities);
}

float GaussianMixture::pdf(Vec2 p) const {
  if (is_uniform()) return 1;
  alignas(32) Lanes densities;
  return eval_components(p, densities);
}

std::optional<MixtureSample> GaussianMixture::sample(Vec2 u) const {
  if (is_uniform()) return MixtureSample{.p = u, .pdf = 1};
  // The component, and what is left of u.x as a new uniform number.
  size_t k = 0;
  const auto last = static_cast<size_t>(size_ - 1);
  while (k < last && u.x >= weight_[k]) u.x -= weight_[k++];
  const float rest = std::clamp(u.x / weight_[k], 0.0f, one_minus_epsilon);

  const float radius = std::sqrt(-2 * std::log1p(-rest));
  const SineCosine angle = sine_cosine_of_turns(u.y);
  const float a = radius * angle.cosine;
  const float b = radius * angle.sine;
  const float dx = a / inverse_xx_[k];
  const float dy = (b - inverse_yx_[k] * dx) / inverse_yy_[k];
  const Vec2 p{mean_x_[k] + dx, mean_y_[k] + dy};
  if (!(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1)) return std::nullopt;
  return MixtureSample{.p = p, .pdf = pdf(p)};
}

GaussianMixture GaussianMixture::reweighted(const Lanes& factors) const {
  Lanes products;
  for (size_t i = 0; i < capacity; ++i) products[i] = weight_[i] * factors[i];
  const float total = sum(products);
  if (!(total > 0 && total < infinity)) return *this;
  GaussianMixture result = *this;
  const float scale = 1 / total;
  for (size_t i = 0; i < capacity; ++i) {
    result.weight_[i] = products[i] * scale;
    result.peak_[i] *= factors[i] * scale;
  }
  return result;
}

float GaussianMixture::inside_mass() const {
  if (is_uniform()) return 1;
  double mass = 0;
  for (int k = 0; k < size_; ++k) {
    const auto i = static_cast<size_t>(k);
    // Midpoint rule over a, the standardised x; the inner integral over y in closed form.
    const double lo = std::max(-5.0, static_cast<double>(-mean_x_[i] * inverse_xx_[i]));
    const double hi = std::min(5.0, static_cast<double>((1 - mean_x_[i]) * inverse_xx_[i]));
    const int steps = 64;
    double inside = 0;
    for (int s = 0; s < steps; ++s) {
      const double a = lo + (hi - lo) * (s + 0.5) / steps;
      const double shift = inverse_yx_[i] * a / inverse_xx_[i];
      const double top = (1.0 - mean_y_[i]) * inverse_yy_[i] + shift;
      const double bottom = -mean_y_[i] * inverse_yy_[i] + shift;
      inside += std::exp(-0.5 * a * a) * (normal_cdf(top) - normal_cdf(bottom));
    }
    mass += weight_[i] * inside * std::max(hi - lo, 0.0) / steps * 0.3989422804014327;
  }
  return static_cast<float>(mass);
}

float GaussianMixture::effective_components() const {
  if (is_uniform()) return 0;
  float entropy = 0;
  for (size_t i = 0; i < capacity; ++i)
    if (weight_[i] > 0) entropy -= weight_[i] * std::log(weight_[i]);
  return std::exp(entropy);
}

void GaussianMixture::write(ByteWriter& out) const {
  out.write(static_cast<uint32_t>(size_));
  for (const Lanes* lanes :
       {&mean_x_, &mean_y_, &inverse_xx_, &inverse_yx_, &inverse_yy_, &peak_, &weight_})
    for (size_t k = 0; k < static_cast<size_t>(size_); ++k) out.write((*lanes)[k]);
}

void GaussianMixture::read(ByteReader& in) {
  *this = GaussianMixture();
  const auto size = in.read_as<uint32_t>();
  if (size > static_cast<uint32_t>(capacity)) return in.fail();
  bool valid = true;
  for (Lanes* lanes :
       {&mean_x_, &mean_y_, &inverse_xx_, &inverse_yx_, &inverse_yy_, &peak_, &weight_})
    for (size_t k = 0; k < size; ++k) {
      in.read((*lanes)[k]);
      valid = valid && std::isfinite((*lanes)[k]);
    }
  for (size_t k = 0; k < size; ++k)
    valid =
        valid && inverse_xx_[k] > 0 && inverse_yy_[k] > 0 && peak_[k] > 0 && weight_[k] > 0;
  if (in.failed() || !valid) {
    *this = GaussianMixture();
    return in.fail();
  }
  size_ = static_cast<int>(size);
}

}  // namespace tyndall
