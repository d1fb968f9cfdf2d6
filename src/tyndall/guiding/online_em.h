// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "tyndall/guiding/byte_stream.h"
#include "tyndall/guiding/gaussian_mixture.h"

namespace tyndall {

/// Priors and steps of weighted expectation maximization. The defaults of the priors and
/// the exponent are those of [Vorba14]'s published code.
struct EmSettings {
  int components = 8;
  /// Inverse-Wishart prior of every covariance, as if `covariance_count` samples of
  /// variance covariance_scale / covariance_count had been seen; a and b in [Vorba14].
  double covariance_count = 1e-2, covariance_scale = 5e-4;
  /// Dirichlet prior of the weights: as if every component had seen so many samples; v.
  double weight_count = 1e-2;
  /// The n-th sample replaces the share step_gain * n^-step_exponent of what was known; in
  /// (0.5, 1], the gain at least 1. With exponent and gain 1 all samples count alike, for
  /// ever.
  double step_exponent = 0.7, step_gain = 1;
  /// Bounds of what the data can make of a covariance: the least variance of a coordinate,
  /// and the largest squared correlation. They keep single precision safe.
  double min_variance = 1e-8, max_squared_correlation = 1 - 1e-5;
};

/// A point of the unit square and how much it counts.
struct WeightedPoint {
  Vec2 p;
  float weight;
};

/// Sums over weighted points that suffice to fit a mixture: they add over batches, threads
/// and machines, provided that all use the same mixture for the responsibilities.
struct MixtureStatistics {
  using Lanes = std::array<double, GaussianMixture::capacity>;

  double count = 0;           ///< of points, those of weight zero included
  double weight = 0;          ///< sum of the weights
  double squared_weight = 0;  ///< sum of the squared weights
  double log_density = 0;     ///< sum of weight * log pdf
  Lanes w{}, x{}, y{};        ///< per component: weight, weight * coordinate ...
  Lanes xx{}, xy{}, yy{};
  uint64_t rejected =
      0;  ///< points left out: weight negative or not finite, or off the square

  /// Adds the points with the responsibilities that `mixture` gives (uniform: all alike).
  void add(const GaussianMixture& mixture, std::span<const WeightedPoint> points);
  /// As if every weight were multiplied by `factor` and so were the number of points.
  void discount(double factor);
  MixtureStatistics& operator+=(const MixtureStatistics& o);

  /// The number of equal weights that would tell as much: weight^2 / squared_weight.
  double effective_count() const {
    return squared_weight > 0 ? weight * weight / squared_weight : 0;
  }

  void write(ByteWriter& out) const;
  void read(ByteReader& in);
  friend bool operator==(const MixtureStatistics&, const MixtureStatistics&) = default;
};

/// The mixture that maximises the penalised likelihood of the statistics (the M step with
/// MAP). Depends on ratios of weights only. Components without data keep the mean of
/// `previous`.
///
/// Unlike [Vorba14] the data speak with effective_count(), not with the number of samples:
/// a few heavy ones among many zeros are few.
GaussianMixture maximize(const MixtureStatistics& statistics,
                         const GaussianMixture& previous, const EmSettings& settings);

/// What batch EM climbs: effective count * mean log density + logarithms of the priors, up
/// to a constant.
double penalized_log_likelihood(const GaussianMixture& mixture,
                                std::span<const WeightedPoint> points,
                                const EmSettings& settings);

/// A first guess: components of equal weight at points chosen by k-means++ [AV07], in
/// proportion to weight and squared distance to those chosen before, then anywhere. Uniform
/// if no point has weight.
GaussianMixture initial_mixture(std::span<const WeightedPoint> points, uint64_t seed,
                                const EmSettings& settings);

/// Batch EM from `start` until a sweep gains less than `tolerance` (relative), or
/// `max_sweeps`.
GaussianMixture fit_batch(const GaussianMixture& start,
                          std::span<const WeightedPoint> points, const EmSettings& settings,
                          int max_sweeps = 30, double tolerance = 1e-3);

/// Running statistics of stepwise EM [CM09], [Vorba14]: each batch is weighed against the
/// past.
///
/// Within a batch all samples count alike, so their order does not matter; the past keeps
/// the share that the recursion of [Vorba14] would leave it, in its continuous limit.
class OnlineEm {
 public:
  /// Takes in a batch whose responsibilities come from the mixture of the last maximize().
  void absorb(const MixtureStatistics& batch, const EmSettings& settings);
  /// The mixture as it stands; `previous` is the last one.
  GaussianMixture maximize(const GaussianMixture& previous,
                           const EmSettings& settings) const {
    return tyndall::maximize(sums_, previous, settings);
  }
  /// Makes later samples count as if only the share `keep` of the earlier had been seen.
  void forget(double keep);

  double samples() const { return samples_; }  ///< seen, less those forgotten
  const MixtureStatistics& statistics() const { return sums_; }

  void write(ByteWriter& out) const;
  void read(ByteReader& in);
  friend bool operator==(const OnlineEm&, const OnlineEm&) = default;

 private:
  MixtureStatistics sums_;  // the past discounted
  double samples_ = 0;
};

}  // namespace tyndall
