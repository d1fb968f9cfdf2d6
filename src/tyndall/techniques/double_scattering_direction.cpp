// SPDX-License-Identifier: Apache-2.0
#include "tyndall/techniques/double_scattering_direction.h"

#include <algorithm>
#include <cmath>

#include "tyndall/math/scalar.h"

namespace tyndall {

/// A direction around the frame's z axis; half angles keep their digits at both poles.
struct DoubleScatteringDirection::Polar {
  float sin_half, cos_half;                  ///< of the polar angle theta
  float sin_half_azimuth, cos_half_azimuth;  ///< of |phi|
  bool is_negative;                          ///< phi < 0

  float sin_theta() const { return 2 * sin_half * cos_half; }
};

DoubleScatteringDirection::DoubleScatteringDirection(const ScatteringTables& tables, Vec3 b,
                                                     Vec3 w_ab, Vec3 pivot)
    : tables_(&tables) {
  look_at(b, pivot);
  if (!is_proper_ || tables.is_isotropic()) return;
  const Vec3 to_pivot = frame_.z;
  // Scattering backward is scattering forward into the opposite direction.
  if (tables.g() < 0) w_ab = -w_ab;
  sin_half_ = 0.5f * length(w_ab - to_pivot);
  cos_half_ = 0.5f * length(w_ab + to_pivot);
  const Vec3 across = w_ab - to_pivot * dot(w_ab, to_pivot);
  const float across_length = length(across);
  if (across_length > 0) {
    frame_.x = across / across_length;
    frame_.y = cross(frame_.z, frame_.x);
  }
  y_alpha_ = tables.k_theta() * sin_half_ / (cos_half_ + tables.k_theta() * sin_half_);
  if (!(y_alpha_ >= 0 && y_alpha_ <= 1)) is_proper_ = false;
  if (!is_proper_) return;
  constexpr int rows = ScatteringTables::alpha_rows;
  const float position = y_alpha_ * (rows - 1);
  row_ = std::min(static_cast<int>(position), rows - 2);
  row_weight_ = position - static_cast<float>(row_);
}

DoubleScatteringDirection::DoubleScatteringDirection(const ScatteringTables& tables, Vec3 b,
                                                     Vec3 pivot)
    : tables_(&tables), is_any_direction_(true) {
  look_at(b, pivot);
}

void DoubleScatteringDirection::look_at(Vec3 b, Vec3 pivot) {
  x_ = double(pivot.x) - b.x;
  y_ = double(pivot.y) - b.y;
  z_ = double(pivot.z) - b.z;
  const double distance = std::sqrt(x_ * x_ + y_ * y_ + z_ * z_);
  is_proper_ = distance > 0 && distance < double(infinity);
  if (!is_proper_) return;
  x_ /= distance;
  y_ /= distance;
  z_ /= distance;
  frame_ = Frame::from_z(
      {static_cast<float>(x_), static_cast<float>(y_), static_cast<float>(z_)});
}

LinearRows::Blend DoubleScatteringDirection::half(bool is_above) const {
  if (is_any_direction_) return tables_->theta_of_any_direction().blend(0, 0, 0);
  return tables_->theta().blend(2 * row_ + (is_above ? 1 : 0), 2, row_weight_);
}

/// tan(phi / 2) at which half of the azimuth's mass lies inside, up to the table's weighting:
/// sqrt((1 - k) / (1 + k)) of the phase function (1 - k cos phi)^(-3/2) at this theta.
float DoubleScatteringDirection::azimuth_ratio(const Polar& p) const {
  if (is_any_direction_) return 1;
  const float g = std::abs(tables_->g());
  const float difference = sin_half_ * p.cos_half - cos_half_ * p.sin_half;
  const float sum = sin_half_ * p.cos_half + cos_half_ * p.sin_half;
  const float ahead = sqr(1 - g) + 4 * g * sqr(difference);
  const float behind = sqr(1 - g) + 4 * g * sqr(sum);
  return std::sqrt(ahead / behind);
}

LinearRows::Blend DoubleScatteringDirection::azimuth(const Polar& p) const {
  const LinearRows& table = azimuth_table();
  const float e = azimuth_ratio(p);
  const int last = table.rows() - 1;
  const int row = std::clamp(
      static_cast<int>(std::sqrt(e) * static_cast<float>(last)), 0, last - 1);
  const float low = sqr(static_cast<float>(row) / static_cast<float>(last));
  const float high = sqr(static_cast<float>(row + 1) / static_cast<float>(last));
  return table.blend(row, 1, std::clamp((e - low) / (high - low), 0.0f, 1.0f));
}

std::optional<DoubleDirectionSample> DoubleScatteringDirection::sample(Vec2 u) const {
  if (!is_proper_) return std::nullopt;
  Vec3 local;
  if (tables_->is_isotropic()) {
    // From the top: u = 1 - (1 - theta / pi)^2.
    const float theta = pi * u.x / (1 + safe_sqrt(1 - u.x)), phi = 2 * pi * u.y;
    local = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
             std::cos(theta)};
  } else {
    local = sample_tables(u);
  }
  const Vec3 w = normalize(frame_.to_world(local));
  const float density = pdf(w);
  if (!(density > 0)) return std::nullopt;
  return DoubleDirectionSample{.w = w, .pdf = density};
}

Vec3 DoubleScatteringDirection::sample_tables(Vec2 u) const {
  const float below = is_any_direction_ ? 0 : half(false).mass();
  const bool is_above = u.x >= below;
  const LinearRows::Blend rows = half(is_above);
  const ThetaWarp warp{y_alpha_, is_above};
  const float y = warp.y(rows.invert(is_above ? u.x - below : u.x));
  Polar p{};
  const float sine = y, cosine = tables_->k_theta() * (1 - y);
  const float scale = 1 / std::sqrt(sqr(sine) + sqr(cosine));
  p.sin_half = sine * scale;
  p.cos_half = cosine * scale;

  const float v = 2 * u.y - 1;
  const float e = azimuth_ratio(p);
  const float eta = azimuth(p).invert(std::abs(v));
  const float s = e * eta, c = 1 - eta, n = 1 / (sqr(s) + sqr(c));
  const float cos_phi = (c - s) * (c + s) * n;
  const float sin_phi = std::copysign(2 * s * c * n, v);
  const float sin_theta = p.sin_theta();
  return {sin_theta * cos_phi, sin_theta * sin_phi,
          (p.cos_half - p.sin_half) * (p.cos_half + p.sin_half)};
}

DoubleScatteringDirection::Polar DoubleScatteringDirection::polar(Vec3 w) const {
  Polar p{};
  // From the very vector that a distance technique along w will use, or the densities of the
  // two, both singular at theta = 0, would not cancel there.
  const double wx = w.x, wy = w.y, wz = w.z;
  const double cx = y_ * wz - z_ * wy, cy = z_ * wx - x_ * wz, cz = x_ * wy - y_ * wx;
  const auto sine = static_cast<float>(std::sqrt(cx * cx + cy * cy + cz * cz));
  const auto cosine = static_cast<float>(x_ * wx + y_ * wy + z_ * wz);
  const float major = std::sqrt(0.5f * (1 + std::min(std::abs(cosine), 1.0f)));
  const float minor = 0.5f * sine / major;
  p.sin_half = cosine >= 0 ? minor : major;
  p.cos_half = cosine >= 0 ? major : minor;
  const float x = dot(w, frame_.x), y = dot(w, frame_.y);
  const float r = std::sqrt(x * x + y * y);
  const float cos_phi = r > 0 ? x / r : 1, sin_phi = r > 0 ? std::abs(y) / r : 0;
  const float major_azimuth = std::sqrt(0.5f * (1 + std::abs(cos_phi)));
  const float minor_azimuth = 0.5f * sin_phi / major_azimuth;
  p.sin_half_azimuth = x >= 0 ? minor_azimuth : major_azimuth;
  p.cos_half_azimuth = x >= 0 ? major_azimuth : minor_azimuth;
  p.is_negative = y < 0;
  return p;
}

float DoubleScatteringDirection::pdf(Vec3 w) const {
  if (!is_proper_) return 0;
  const Polar p = polar(w);
  if (tables_->is_isotropic()) {
    const float rest = 2 * std::atan2(p.cos_half, p.sin_half);  // pi - theta
    return density_or_zero(rest / (pi * pi * pi * p.sin_theta()));
  }
  return density_or_zero(polar_pdf(p) * azimuth_pdf(p) / p.sin_theta());
}

/// Density of theta [1/rad].
float DoubleScatteringDirection::polar_pdf(const Polar& p) const {
  const float k = tables_->k_theta(), sum = p.cos_half + k * p.sin_half;
  const float y = k * p.sin_half / sum;
  const bool is_above = is_any_direction_ || y >= y_alpha_;
  const ThetaWarp warp{y_alpha_, is_above};
  if (!(warp.width() > 0)) return 0;
  const float z = warp.z(y);
  return half(is_above).density(z) / warp.slope(z) * (0.5f * k / sqr(sum));
}

/// Density of phi [1/rad].
float DoubleScatteringDirection::azimuth_pdf(const Polar& p) const {
  const float e = azimuth_ratio(p);
  const float sum = e * p.cos_half_azimuth + p.sin_half_azimuth;
  const float eta = p.sin_half_azimuth / sum;
  return 0.25f * azimuth(p).density(eta) * e / sqr(sum);
}

Vec2 DoubleScatteringDirection::invert(Vec3 w) const {
  if (!is_proper_) return {0, 0};
  const Polar p = polar(w);
  if (tables_->is_isotropic()) {
    const float theta = 2 * std::atan2(p.sin_half, p.cos_half) * inv_pi;
    const float phi = std::atan2(dot(w, frame_.y), dot(w, frame_.x)) * (0.5f * inv_pi);
    return {std::clamp(theta * (2 - theta), 0.0f, 1.0f), phi < 0 ? phi + 1 : phi};
  }
  const float k = tables_->k_theta(), y = k * p.sin_half / (p.cos_half + k * p.sin_half);
  const bool is_above = is_any_direction_ || y >= y_alpha_;
  const ThetaWarp warp{y_alpha_, is_above};
  const float below = is_above && !is_any_direction_ ? half(false).mass() : 0;
  const float part = warp.width() > 0 ? half(is_above).cdf(warp.z(y)) : 0;
  const float e = azimuth_ratio(p);
  const float eta = p.sin_half_azimuth / (e * p.cos_half_azimuth + p.sin_half_azimuth);
  const float v = azimuth(p).cdf(eta);
  return {std::clamp(below + part, 0.0f, 1.0f),
          std::clamp(0.5f + (p.is_negative ? -0.5f : 0.5f) * v, 0.0f, 1.0f)};
}

}  // namespace tyndall
