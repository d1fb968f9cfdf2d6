// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/efficiency.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "tyndall/math/scalar.h"
#include "tyndall/math/statistics.h"

namespace tyndall::app {

namespace {

/// Empty if a cost has no logarithm.
std::optional<RunningMoments> log_costs(const std::vector<Run>& runs, RunCost cost) {
  RunningMoments moments;
  for (const Run& run : runs) {
    const double x = cost(run);
    if (!(x > 0) || !std::isfinite(x)) return std::nullopt;
    moments.add(std::log(x));
  }
  return moments;
}

double welch_degrees_of_freedom(const RunningMoments& a, const RunningMoments& b) {
  const double va = sqr(a.standard_error()), vb = sqr(b.standard_error());
  if (va + vb == 0) return 1e9;
  return sqr(va + vb) / (sqr(va) / static_cast<double>(a.count() - 1) +
                         sqr(vb) / static_cast<double>(b.count() - 1));
}

}  // namespace

std::string RatioEstimate::text() const {
  if (!interval) return fmt::format("{:.3g}", ratio);
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", ratio, interval->low, interval->high);
}

std::string RatioEstimate::time_words() const {
  const bool is_gain = ratio >= 1;
  const auto gain = [&](double x) { return is_gain ? x : 1 / x; };
  std::string words =
      fmt::format("{:.3g} times {}", gain(ratio), is_gain ? "less time" : "the time");
  if (interval) {
    const auto [low, high] = std::minmax({gain(interval->low), gain(interval->high)});
    words += fmt::format(" (95 % confidence: {:.3g} to {:.3g})", low, high);
  }
  return words;
}

double cost_in_time(const Run& run) { return run.errors.rel_mse * run.seconds; }

double cost_in_samples(const Run& run) {
  return run.errors.rel_mse * static_cast<double>(run.samples_per_pixel);
}

double trimmed_cost_in_time(const Run& run) {
  return run.errors.rel_mse_trimmed * run.seconds;
}

double student_quantile_975(double degrees_of_freedom) {
  constexpr std::array<std::pair<double, double>, 21> table = {{
      {1, 12.706}, {2, 4.303},  {3, 3.182},   {4, 2.776},  {5, 2.571},  {6, 2.447},
      {7, 2.365},  {8, 2.306},  {9, 2.262},   {10, 2.228}, {11, 2.201}, {12, 2.179},
      {13, 2.160}, {14, 2.145}, {15, 2.131},  {17, 2.110}, {20, 2.086}, {25, 2.060},
      {35, 2.030}, {60, 2.000}, {200, 1.972},
  }};
  double quantile = table.front().second;
  for (const auto& [degrees, value] : table) {
    if (degrees <= degrees_of_freedom) quantile = value;
  }
  return quantile;
}

std::optional<RatioEstimate> cost_ratio(const std::vector<Run>& method,
                                        const std::vector<Run>& baseline, RunCost cost) {
  const auto m = log_costs(method, cost), b = log_costs(baseline, cost);
  if (!m || !b || m->count() < 1 || b->count() < 1) return std::nullopt;
  const double difference = b->mean() - m->mean();
  if (m->count() < 2 || b->count() < 2)
    return RatioEstimate{std::exp(difference), std::nullopt};
  const double error = std::hypot(m->standard_error(), b->standard_error());
  const double half = error * student_quantile_975(welch_degrees_of_freedom(*m, *b));
  return RatioEstimate{
      std::exp(difference),
      ConfidenceInterval{std::exp(difference - half), std::exp(difference + half)}};
}

std::string ratio_text(const Method& method, const Method& baseline, RunCost cost) {
  if (&method == &baseline) return "1";
  const auto ratio = cost_ratio(method.runs, baseline.runs, cost);
  return ratio ? ratio->text() : "-";
}

std::string time_sentence(const Method& method, const Method& baseline) {
  const auto all = cost_ratio(method.runs, baseline.runs, cost_in_time);
  const auto trimmed = cost_ratio(method.runs, baseline.runs, trimmed_cost_in_time);
  if (!all || !trimmed) return "";
  return fmt::format(
      "the same error as {} in {}; without the worst 0.1 % of the pixels in {}",
      baseline.name, all->time_words(), trimmed->time_words());
}

bool is_reference_noisy(const SceneResults& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Method& method : scene.methods) {
    for (const Run& run : method.runs) smallest = std::min(smallest, run.errors.rel_mse);
  }
  return scene.reference_rel_mse.value_or(0) > 0.1 * smallest;
}

Spread spread_over_runs(const std::vector<Run>& runs, double (*value)(const Run&)) {
  RunningMoments moments;
  for (const Run& run : runs) moments.add(value(run));
  return {moments.mean(), std::sqrt(moments.variance())};
}

}  // namespace tyndall::app
