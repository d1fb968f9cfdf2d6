// SPDX-License-Identifier: Apache-2.0
#include "tyndall/techniques/scattering_tables.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

constexpr int arc_cells = 1024;
constexpr int fluence_cells = 1024;
constexpr int azimuth_rows = ScatteringTables::azimuth_rows;
constexpr int azimuth_cells = ScatteringTables::azimuth_cells;

/// The complete elliptic integral of the second kind of parameter m = 1 - m1, by the
/// arithmetic-geometric mean [AS64, 17.6].
double elliptic_e(double m1) {
  double a = 1, b = std::sqrt(m1), sum = 1 - m1, power = 1;
  while (a - b > 1e-9 * a) {
    const double c = 0.5 * (a - b);
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
    power *= 2;
    sum += power * c * c;
  }
  return 0.5 * M_PI / (0.5 * (a + b)) * (1 - 0.5 * sum);
}

/// Half an angle, by its sine and cosine, from y = k v / (1 + k v).
struct HalfAngle {
  double sine, cosine;

  static HalfAngle from_y(double y, double k) {
    const double s = y, c = k * (1 - y), n = std::sqrt(s * s + c * c);
    return {s / n, c / n};
  }
  /// d(angle) / dy
  double slope(double k) const { return 2 * sqr(cosine + k * sine) / k; }
};

/// Henyey-Greenstein, up to a factor, of an angle given by its half; times d(angle) / dy.
std::vector<float> arc_values(double g, double k) {
  std::vector<float> values(arc_cells + 1);
  for (int i = 0; i <= arc_cells; ++i) {
    const HalfAngle half = HalfAngle::from_y(static_cast<double>(i) / arc_cells, k);
    const double d = sqr(1 - g) + 4 * g * sqr(half.sine);
    const double d0 = sqr(1 - g);
    values[static_cast<size_t>(i)] =
        static_cast<float>(std::pow(d / d0, -1.5) * half.slope(k) / (2 / k));
  }
  return values;
}

/// Double scattering at a first vertex at angle alpha from the light, up to a factor, over
/// the polar angle theta: the phase function of the first vertex integrated over the
/// azimuth, times the light P(theta) scattered once along the direction.
class PolarIntegrand {
 public:
  PolarIntegrand(double g, double k, const LinearTable& arc)
      : g_(std::abs(g)), k_(k), k_arc_(std::sqrt((1 + g) / (1 - g))), arc_(arc) {}

  double operator()(const HalfAngle& alpha, double y_theta) const {
    const HalfAngle theta = HalfAngle::from_y(y_theta, k_);
    const double difference = alpha.sine * theta.cosine - alpha.cosine * theta.sine;
    const double sum = alpha.sine * theta.cosine + alpha.cosine * theta.sine;
    const double d_plus = sqr(1 - g_) + 4 * g_ * sqr(sum);
    const double d_minus = sqr(1 - g_) + 4 * g_ * sqr(difference);
    const double azimuth = elliptic_e(d_minus / d_plus) / (d_minus * std::sqrt(d_plus));
    return azimuth * scattered_once(theta) * theta.slope(k_);
  }
  /// The same if light arrives at the first vertex from everywhere.
  double operator()(double y_theta) const {
    const HalfAngle theta = HalfAngle::from_y(y_theta, k_);
    return scattered_once(theta) * theta.slope(k_);
  }

 private:
  double scattered_once(const HalfAngle& theta) const {
    const double y = k_arc_ * theta.sine / (k_arc_ * theta.sine + theta.cosine);
    const double rest = theta.cosine / (k_arc_ * theta.sine + theta.cosine);
    return arc_.cursor(static_cast<float>(y)).integral(static_cast<float>(rest));
  }

  double g_, k_, k_arc_;
  const LinearTable& arc_;
};

/// Sum over z in [0, 1] of f(y) |dy/dz| for the two halves, four Gauss points a cell.
double integrate_halves(const PolarIntegrand& f, double a, double k) {
  constexpr std::array<double, 2> nodes{0.3399810435848563, 0.8611363115940526};
  constexpr std::array<double, 2> weights{0.6521451548625461, 0.3478548451374538};
  constexpr int cells = 24;
  const HalfAngle alpha = HalfAngle::from_y(a, k);
  double sum = 0;
  for (int i = 0; i < cells * 4; ++i) {
    const size_t point = static_cast<size_t>(i) % 2;
    const double sign = i % 4 < 2 ? 1 : -1;
    const double z = (i / 4 + 0.5 + 0.5 * sign * nodes[point]) / cells;
    const double linear = ThetaWarp::linear_part;
    const double q = z * (linear + (1 - linear) * z), dq = linear + 2 * (1 - linear) * z;
    const double w = 0.5 * weights[point] / cells * dq;
    sum += w * (a * f(alpha, a * (1 - q)) + (1 - a) * f(alpha, a + (1 - a) * q));
  }
  return sum;
}

/// Where log(tan(alpha / 2)) is tabulated: beyond, alpha differs from 0 or pi by less than
/// a thousandth of the width of the phase function's peak.
double fluence_range(double g) { return std::log(2000 / (1 - std::abs(g))); }

LinearTable make_fluence(const PolarIntegrand& f, double g, double k) {
  const double range = fluence_range(g);
  std::vector<float> values(fluence_cells + 1);
  double first = 0;
  for (int i = 0; i <= fluence_cells; ++i) {
    const double v = std::exp(range * (2.0 * i / fluence_cells - 1));
    const double w = g < 0 ? 1 / v : v;  // PolarIntegrand takes pi - alpha for backward g
    const double value = integrate_halves(f, k * w / (1 + k * w), k);
    if (i == 0) first = value;
    values[static_cast<size_t>(i)] = static_cast<float>(value / first);
  }
  return {values, static_cast<float>(-range), static_cast<float>(range)};
}

LinearRows make_theta(const PolarIntegrand& f, double k) {
  constexpr int cells = ScatteringTables::theta_cells, rows = ScatteringTables::alpha_rows;
  std::vector<float> values;
  for (int row = 0; row < rows; ++row) {
    const double a = static_cast<double>(row) / (rows - 1);
    const HalfAngle alpha = HalfAngle::from_y(a, k);
    for (const float side : {-1.0f, 1.0f}) {
      const ThetaWarp warp(static_cast<float>(a), side);
      for (int i = 0; i <= cells; ++i) {
        const float z = static_cast<float>(i) / cells;
        const double value = warp.width > 0 ? f(alpha, warp.y(z)) * warp.slope(z) : 0;
        values.push_back(static_cast<float>(value));
      }
    }
  }
  return {values, rows, 2};
}

LinearRows make_theta_of_any_direction(const PolarIntegrand& f) {
  constexpr int cells = ScatteringTables::theta_cells;
  std::vector<float> values;
  const ThetaWarp warp(0, 1);
  for (int i = 0; i <= cells; ++i) {
    const float z = static_cast<float>(i) / cells;
    values.push_back(static_cast<float>(f(warp.y(z)) * warp.slope(z)));
  }
  return {values, 1, 1};
}

LinearRows make_azimuth() {
  std::vector<float> values;
  for (int row = 0; row < azimuth_rows; ++row) {
    const double e = sqr(static_cast<double>(row) / (azimuth_rows - 1));
    for (int i = 0; i <= azimuth_cells; ++i) {
      const double eta = static_cast<double>(i) / azimuth_cells;
      const double numerator = std::sqrt(sqr(1 - eta) + sqr(e * eta));
      values.push_back(
          static_cast<float>(numerator / std::pow(sqr(1 - eta) + sqr(eta), 1.5)));
    }
  }
  return {values, azimuth_rows, 1};
}

const LinearRows& azimuth_table() {
  static const LinearRows table = make_azimuth();
  return table;
}

}  // namespace

float ThetaWarp::z(float y) const {
  const float q = side * (y - a) / width;
  const float root = std::sqrt(sqr(linear_part) + 4 * (1 - linear_part) * q);
  return std::min(2 * q / (linear_part + root), 1.0f);
}

ScatteringTables::ScatteringTables(float g)
    : g_(g),
      k_(std::sqrt((1 + g) / (1 - g))),
      inverse_k_(1 / k_),
      k_theta_(g < 0 ? 1 : std::sqrt(k_)),
      azimuth_(&azimuth_table()) {
  assert(-1 < g && g < 1);
  if (is_isotropic()) return;
  arc_ = LinearTable(arc_values(g, std::sqrt((1 + double(g)) / (1 - double(g)))), 0, 1);
  const double k = k_theta();
  const PolarIntegrand integrand(g, k, arc_);
  fluence_ = make_fluence(integrand, g, k);
  theta_ = make_theta(integrand, k);
  theta_of_any_direction_ = make_theta_of_any_direction(integrand);
}

}  // namespace tyndall
