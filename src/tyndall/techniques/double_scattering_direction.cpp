// SPDX-License-Identifier: Apache-2.0
#include "tyndall/techniques/double_scattering_direction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tyndall/math/elementary.h"
#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

using Place = LinearRows::Blend::Place;

constexpr int theta_cells = ScatteringTables::theta_cells;
constexpr int azimuth_cells = ScatteringTables::azimuth_cells;
constexpr int azimuth_rows = ScatteringTables::azimuth_rows;

/// 1 / (2 i + 1)
constexpr auto inverse_odd = [] {
  std::array<float, azimuth_rows> values{};
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = 1 / (2 * static_cast<float>(i) + 1);
  return values;
}();

}  // namespace

/// Where the tables look a direction up.
struct DoubleScatteringDirection::TablePoint {
  ThetaWarp warp;
  float z;  ///< of warp
  Place theta;
  float e;  ///< row of the azimuth
  Place azimuth;
};

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
  if (!is_proper_) return;
  if (tables.is_isotropic()) {
    frame_ = Frame::from_z(frame_.z);
    return;
  }
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
  } else {
    frame_ = Frame::from_z(to_pivot);
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
  if (is_proper_) frame_ = Frame::from_z(frame_.z);
}

void DoubleScatteringDirection::look_at(Vec3 b, Vec3 pivot) {
  x_ = double(pivot.x) - b.x;
  y_ = double(pivot.y) - b.y;
  z_ = double(pivot.z) - b.z;
  const double distance = std::sqrt(x_ * x_ + y_ * y_ + z_ * z_);
  is_proper_ = distance > 0 && distance < double(infinity);
  if (!is_proper_) return;
  const double scale = 1 / distance;
  x_ *= scale;
  y_ *= scale;
  z_ *= scale;
  frame_.z = {static_cast<float>(x_), static_cast<float>(y_), static_cast<float>(z_)};
}

LinearRows::Blend DoubleScatteringDirection::polar_density() const {
  return is_any_direction_ ? tables_->theta_of_any_direction().row(0)
                           : tables_->theta().blend(row_, row_weight_);
}

/// tan(phi / 2) at which half of the azimuth's mass lies inside, up to the table's
/// weighting: sqrt((1 - k) / (1 + k)) of the phase function (1 - k cos phi)^(-3/2) at this
/// theta.
float DoubleScatteringDirection::azimuth_ratio(float sin_half, float cos_half) const {
  if (is_any_direction_) return 1;
  const float g = std::abs(tables_->g());
  const float difference = sin_half_ * cos_half - cos_half_ * sin_half;
  const float sum = sin_half_ * cos_half + cos_half_ * sin_half;
  const float ahead = sqr(1 - g) + 4 * g * sqr(difference);
  const float behind = sqr(1 - g) + 4 * g * sqr(sum);
  return std::sqrt(ahead / behind);
}

LinearRows::Blend DoubleScatteringDirection::azimuth(float e) const {
  constexpr int last = azimuth_rows - 1;
  const float position = e > 0 ? std::sqrt(std::min(e, 1.0f)) * last : 0;
  const int row = std::min(static_cast<int>(position), last - 1);
  const auto i = static_cast<float>(row);
  // Between e = (i / last)^2 and ((i + 1) / last)^2.
  const float weight =
      (position - i) * (position + i) * inverse_odd[static_cast<size_t>(row)];
  return tables_->azimuth().blend(row, std::clamp(weight, 0.0f, 1.0f));
}

std::optional<DoubleDirectionSample> DoubleScatteringDirection::sample(Vec2 u) const {
  if (!is_proper_) return std::nullopt;
  return tables_->is_isotropic() ? sample_isotropic(u) : sample_tables(u);
}

std::optional<DoubleDirectionSample> DoubleScatteringDirection::sample_isotropic(
    Vec2 u) const {
  // u = 1 - (1 - theta / pi)^2; the second form of theta keeps its digits near zero.
  const float root = safe_sqrt(1 - u.x);
  const SineCosine theta = sine_cosine_of_turns(0.5f * u.x / (1 + root));
  const SineCosine phi = sine_cosine_of_turns(u.y);
  const Vec3 w =
      frame_.to_world({theta.sine * phi.cosine, theta.sine * phi.sine, theta.cosine});
  const float density = density_or_zero(isotropic_pdf(w, pi * root));
  if (!(density > 0)) return std::nullopt;
  return DoubleDirectionSample{.w = w, .pdf = density};
}

std::optional<DoubleDirectionSample> DoubleScatteringDirection::sample_tables(
    Vec2 u) const {
  const auto theta = polar_density().invert(u.x);
  const int piece = is_any_direction_ ? 1 : theta.place.cell / theta_cells;
  const int cell = theta.place.cell & (theta_cells - 1);
  const ThetaWarp warp(y_alpha_, static_cast<float>(2 * piece - 1));
  const float z = (static_cast<float>(cell) + theta.place.part) * (1.0f / theta_cells);
  // Half of the polar angle: its sine and cosine are these over their length.
  const float k = tables_->k_theta(), y = warp.y(z), x = k * (1 - y);
  const float square = sqr(y) + sqr(x), scale = 1 / std::sqrt(square);
  const float sin_half = y * scale, cos_half = x * scale;

  const float v = 2 * u.y - 1;
  const float e = azimuth_ratio(sin_half, cos_half);
  const auto azimuth = this->azimuth(e).invert(std::abs(v));
  const float eta = (static_cast<float>(azimuth.place.cell) + azimuth.place.part) *
                    (1.0f / azimuth_cells);
  const float s = e * eta, c = 1 - eta;  // the same of half the azimuth
  const float square_azimuth = sqr(s) + sqr(c), n2 = 1 / square_azimuth;

  const float sin_theta = 2 * sin_half * cos_half;
  const Vec3 w = frame_.to_world({sin_theta * (c - s) * (c + s) * n2,
                                  sin_theta * std::copysign(2 * s * c * n2, v),
                                  (cos_half - sin_half) * (cos_half + sin_half)});
  // With dy / dtheta = square / (2 k) and deta / dphi = square_azimuth / (4 e).
  const float density = density_or_zero(
      theta.density * azimuth.density * square * square_azimuth *
      (theta_cells * azimuth_cells * 0.125f) / (warp.slope(z) * k * e * sin_theta));
  if (!(density > 0)) return std::nullopt;
  return DoubleDirectionSample{.w = w, .pdf = density};
}

/// From the very vector that a distance technique along w will use, in double as there: the
/// densities of the two are singular at theta = 0, and cancel only so.
float DoubleScatteringDirection::sin_theta_of(Vec3 w) const {
  const double x = y_ * w.z - z_ * w.y, y = z_ * w.x - x_ * w.z, z = x_ * w.y - y_ * w.x;
  return static_cast<float>(std::sqrt(x * x + y * y + z * z));
}

DoubleScatteringDirection::Polar DoubleScatteringDirection::polar(Vec3 w) const {
  Polar p{};
  const float sine = sin_theta_of(w);
  const auto cosine = static_cast<float>(x_ * w.x + y_ * w.y + z_ * w.z);
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

float DoubleScatteringDirection::isotropic_pdf(Vec3 w, float angle_from_behind) const {
  return angle_from_behind / (pi * pi * pi * sin_theta_of(w));
}

/// dy / dtheta
float DoubleScatteringDirection::polar_slope(const Polar& p) const {
  const float k = tables_->k_theta();
  return 0.5f * k / sqr(p.cos_half + k * p.sin_half);
}

/// deta / dphi over both signs of phi
float DoubleScatteringDirection::azimuth_slope(const Polar& p, float e) const {
  return 0.25f * e / sqr(e * p.cos_half_azimuth + p.sin_half_azimuth);
}

float DoubleScatteringDirection::pdf(Vec3 w) const {
  if (!is_proper_) return 0;
  const Polar p = polar(w);
  if (tables_->is_isotropic())
    return density_or_zero(isotropic_pdf(w, 2 * polar_angle(p.sin_half, p.cos_half).theta));
  const TablePoint at = table_point(p);
  if (!(at.warp.width > 0)) return 0;
  const float of_theta = polar_density().density(at.theta) * theta_cells;
  const float of_azimuth = azimuth(at.e).density(at.azimuth) * azimuth_cells;
  return density_or_zero(of_theta / at.warp.slope(at.z) * polar_slope(p) * of_azimuth *
                         azimuth_slope(p, at.e) / p.sin_theta());
}

DoubleScatteringDirection::TablePoint DoubleScatteringDirection::table_point(
    const Polar& p) const {
  const float k = tables_->k_theta(), y = k * p.sin_half / (p.cos_half + k * p.sin_half);
  const bool is_above = is_any_direction_ || y >= y_alpha_;
  const ThetaWarp warp(y_alpha_, is_above ? 1 : -1);
  const float e = azimuth_ratio(p.sin_half, p.cos_half);
  const float z = warp.width > 0 ? warp.z(y) : 0;
  const float eta = p.sin_half_azimuth / (e * p.cos_half_azimuth + p.sin_half_azimuth);
  const int piece = is_above && !is_any_direction_ ? 1 : 0;
  return {.warp = warp,
          .z = z,
          .theta = LinearRows::Blend::place(z, piece, theta_cells),
          .e = e,
          .azimuth = LinearRows::Blend::place(eta, 0, azimuth_cells)};
}

Vec2 DoubleScatteringDirection::invert(Vec3 w) const {
  if (!is_proper_) return {0, 0};
  const Polar p = polar(w);
  if (tables_->is_isotropic()) {
    const float theta = 2 * std::atan2(p.sin_half, p.cos_half) * inv_pi;
    const float phi = std::atan2(dot(w, frame_.y), dot(w, frame_.x)) * (0.5f * inv_pi);
    return {std::clamp(theta * (2 - theta), 0.0f, 1.0f), phi < 0 ? phi + 1 : phi};
  }
  const TablePoint at = table_point(p);
  const float v = azimuth(at.e).cdf(at.azimuth);
  return {std::clamp(polar_density().cdf(at.theta), 0.0f, 1.0f),
          std::clamp(0.5f + (p.is_negative ? -0.5f : 0.5f) * v, 0.0f, 1.0f)};
}

}  // namespace tyndall
