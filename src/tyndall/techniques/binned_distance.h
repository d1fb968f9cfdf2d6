// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <optional>

#include "tyndall/techniques/distance_weights.h"
#include "tyndall/techniques/samples.h"

namespace tyndall {

/// A technique for distances along a ray, of one uniform number.
template <typename T>
concept DistanceTechnique = requires(const T& technique, float x) {
  { technique.sample(x) } -> std::same_as<std::optional<DistanceSample>>;
  { technique.pdf_t(x) } -> std::same_as<float>;
  { technique.invert(x) } -> std::same_as<float>;
};

/// A distance technique multiplied by what it leaves out: its uniform number is cut into
/// bins, and each bin is chosen in proportion to a weight, for example the transmittance,
/// the phase function and the predicted visibility there. The density is that of the base
/// technique times a piecewise constant, so that weights may be as wrong as they like: they
/// cost variance, never bias, and with a floor of f at most a factor of 1 / f of it.
///
/// A value without allocations, built once per ray and pivot; of at most `MaxBins` bins.
template <DistanceTechnique Base, int MaxBins>
class BinnedDistance {
 public:
  /// The weight of a bin is the mean of its K / Bins weights: several taps keep a bin that
  /// is lit in part from being taken for dark. With fewer taps neighbouring bins share.
  /// Weights that are negative or no numbers count as zero; if all together are less than
  /// 1e-30, the base technique remains. The share `floor` in (0, 1] of the samples is
  /// spread as the base technique would.
  template <int K>
  BinnedDistance(const Base& base, const DistanceWeights<K>& weights, float floor)
      : base_(base) {
    make<MaxBins>(weights, floor);
  }
  /// With a bin for each weight.
  template <int K>
  static BinnedDistance with_bins_of(const Base& base, const DistanceWeights<K>& weights,
                                     float floor) {
    BinnedDistance result(base);
    result.template make<K>(weights, floor);
    return result;
  }

  /// Empty where the base technique is. t grows with u if it does so in the base technique.
  std::optional<DistanceSample> sample(float u) const {
    int i = 0;
    for (int j = 1; j < MaxBins; ++j) i += u >= cdf_[j] ? 1 : 0;
    const float width = cdf_[i + 1] - cdf_[i];
    const float x = std::clamp((u - cdf_[i]) / width, 0.0f, 1.0f);
    auto sample = base_.sample(
        std::min((static_cast<float>(i) + x) * one_by_bins_, one_minus_epsilon));
    if (!sample) return std::nullopt;
    sample->pdf_t = density_or_zero(sample->pdf_t * bins_ * width);
    if (!(sample->pdf_t > 0)) return std::nullopt;
    return sample;
  }

  /// Density of sample() at t [1/scene unit]; zero where it never samples.
  float pdf_t(float t) const {
    const float base = base_.pdf_t(t);
    if (!(base > 0)) return 0;
    const int i = bin(base_.invert(t));
    return density_or_zero(base * bins_ * (cdf_[i + 1] - cdf_[i]));
  }

  /// The u that sample() maps to t, in [0, 1].
  float invert(float t) const {
    const float x = base_.invert(t);
    const int i = bin(x);
    return cdf_[i] + (x * bins_ - static_cast<float>(i)) * (cdf_[i + 1] - cdf_[i]);
  }

  const Base& base() const { return base_; }

 private:
  explicit BinnedDistance(const Base& base) : base_(base) {}

  int bin(float u) const {
    const float at = u > 0 ? std::min(u, 1.0f) * bins_ : 0;
    return static_cast<int>(std::min(at, bins_ - 1));
  }

  template <int Bins, int K>
  [[gnu::always_inline]] inline void make(const DistanceWeights<K>& weights, float floor) {
    static_assert(Bins <= MaxBins && (K % Bins == 0 || Bins % K == 0));
    constexpr int taps = std::max(K / Bins, 1), bins_per_tap = std::max(Bins / K, 1);
    alignas(32) std::array<float, K> clean;
    for (int i = 0; i < K; ++i) {
      const float w = weights.values[i];
      clean[i] = w > 0 && w < 1e30f ? w : 0;
    }
    std::array<float, Bins> bin{};
    for (int i = 0; i < Bins; ++i)
      for (int j = 0; j < taps; ++j) bin[i] += clean[i / bins_per_tap * taps + j];
    accumulate(bin, floor);
  }

  template <size_t N>
  [[gnu::always_inline]] inline void accumulate(const std::array<float, N>& bin,
                                                float floor) {
    constexpr int Bins = N;
    bins_ = Bins;
    one_by_bins_ = 1.0f / Bins;
    // Beyond any number that is looked for.
    std::fill(cdf_.begin() + Bins + 1, cdf_.end(), infinity);
    // Sums of pairs of bins first: half the chain of dependent additions.
    float total = 0;
    cdf_[0] = 0;
    for (int i = 0; i < Bins; i += 2) {
      const float pair = bin[i] + bin[i + 1];
      cdf_[i + 1] = total + bin[i];
      total += pair;
      cdf_[i + 2] = total;
    }
    const bool is_dark = !(total > 1e-30f && total < infinity);
    const float scale = is_dark ? 0 : (1 - floor) / total;
    const float share = (is_dark ? 1 : floor) / Bins;
    for (int i = 1; i < Bins; ++i)
      cdf_[i] = scale * cdf_[i] + share * static_cast<float>(i);
    cdf_[Bins] = 1;
  }

  Base base_;
  float bins_ = MaxBins, one_by_bins_ = 1.0f / MaxBins;
  alignas(32) std::array<float, MaxBins + 1> cdf_;
};

}  // namespace tyndall
