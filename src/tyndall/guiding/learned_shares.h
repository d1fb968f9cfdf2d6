// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "tyndall/guiding/byte_stream.h"

namespace tyndall {

/// What learned shares minimise.
enum class ShareTarget {
  divergence,     ///< Kullback-Leibler divergence from the integrand
  second_moment,  ///< of the weights, that is the variance [Douc07]
};

struct ShareSettings {
  ShareTarget target = ShareTarget::second_moment;
  float floor = 0.1f;  ///< least share of every technique; times their number below one
  double prior_count = 100;  ///< effective samples that the present shares are worth
};

/// Shares of N sampling techniques that are mixed in one estimator.
template <size_t N>
using Shares = std::array<float, N>;

/// Sums from which the shares of N techniques are learned. They add over batches and
/// threads, provided that all use the same shares.
template <size_t N>
struct ShareStatistics {
  double importance = 0, squared_importance = 0;
  std::array<double, N> sums{};

  /// /// A sample of weight f / pdf, where `pdf` is the density that it was drawn with (by
  /// these shares or otherwise), and its density under each technique, all in one measure.
  /// Samples of weight zero say nothing here.
  void add(double weight, double pdf, const std::array<float, N>& densities,
           const Shares<N>& shares, ShareTarget target) {
    double total = 0;
    for (size_t i = 0; i < N; ++i) total += static_cast<double>(shares[i] * densities[i]);
    const double v =
        target == ShareTarget::divergence ? weight : weight * (weight * pdf / total);
    if (!(weight > 0 && pdf > 0 && v > 0 && std::isfinite(v)) ||
        !(total > 0 && std::isfinite(total)))
      return;
    importance += v;
    squared_importance += v * v;
    for (size_t i = 0; i < N; ++i)
      sums[i] += v * static_cast<double>(shares[i] * densities[i]) / total;
  }

  ShareStatistics& operator+=(const ShareStatistics& o) {
    importance += o.importance;
    squared_importance += o.squared_importance;
    for (size_t i = 0; i < N; ++i) sums[i] += o.sums[i];
    return *this;
  }

  /// Better shares: a step of expectation maximization, which needs no step size and lowers
  /// the target on the samples seen, drawn towards `shares` as far as the samples are few.
  Shares<N> improve(const Shares<N>& shares, const ShareSettings& settings) const {
    if (!(importance > 0)) return shares;
    const double n = importance * (importance / squared_importance);
    Shares<N> result;
    for (size_t i = 0; i < N; ++i) {
      const double learned = (n * (sums[i] / importance) +
                              settings.prior_count * static_cast<double>(shares[i])) /
                             (n + settings.prior_count);
      result[i] = static_cast<float>(learned);
    }
    return with_floor(result, settings.floor);
  }

  /// The shares raised to the floor where they are below; the others give in proportion to
  /// what they have above it. Precondition: they sum to one, and N * floor < 1.
  static Shares<N> with_floor(const Shares<N>& shares, float floor) {
    float above = 0;
    for (const float s : shares) above += std::max(s - floor, 0.0f);
    const float rest = 1 - static_cast<float>(N) * floor;
    Shares<N> result;
    for (size_t i = 0; i < N; ++i)
      result[i] = floor + rest * std::max(shares[i] - floor, 0.0f) / above;
    return result;
  }
};

}  // namespace tyndall
