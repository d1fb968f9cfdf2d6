// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>

#include "tyndall/guiding/byte_stream.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// A symmetric 2x2 matrix.
struct Covariance2 {
  float xx = 0, xy = 0, yy = 0;

  constexpr float determinant() const { return xx * yy - xy * xy; }
  friend constexpr bool operator==(const Covariance2&, const Covariance2&) = default;
};

/// One term of a Gaussian mixture.
struct GaussianComponent {
  float weight;  ///< probability of the component
  Vec2 mean;
  Covariance2 covariance;
};

/// A point drawn from a mixture.
struct MixtureSample {
  Vec2 p;
  float pdf;  ///< w.r.t. area of the unit square
};

/// A mixture of up to eight Gaussians over the unit square; without components it is the
/// uniform density.
///
/// The tails that leave the square are not folded back: sample() is empty there, pdf() is
/// not rescaled, and inside_mass() says how much is left (as in [Vorba14]). An estimator
/// that counts an empty sample as zero stays unbiased. Structure of arrays: pdf() costs
/// about as much as four scalar exponentials.
class GaussianMixture {
 public:
  static constexpr int capacity = 8;
  using Lanes = std::array<float, capacity>;  ///< one number per component

  GaussianMixture() = default;  ///< uniform
  /// Weights are scaled to sum to one; components of weight zero are dropped.
  /// Preconditions: at most `capacity` components, weights not negative and not all zero,
  /// covariances positive definite.
  explicit GaussianMixture(std::span<const GaussianComponent> components);

  int size() const { return size_; }
  bool is_uniform() const { return size_ == 0; }
  GaussianComponent component(int k) const;

  /// Density w.r.t. area at `p`, which lies in the unit square. Positive wherever p is
  /// within about 12 standard deviations of a component.
  float pdf(Vec2 p) const;
  /// Draws a point; empty where a component leaves the square. Exactly the density pdf().
  std::optional<MixtureSample> sample(Vec2 u) const;

  /// Writes weight * density of every component, zero for those that do not exist, and
  /// returns the sum: pdf(p), if there are components.
  float eval_components(Vec2 p, Lanes& densities) const;

  /// The mixture with each weight times a positive factor, and scaled to sum to one again.
  GaussianMixture reweighted(const Lanes& factors) const;

  /// The probability that sample() is not empty, to about 1e-4. Costs some microseconds.
  float inside_mass() const;
  /// exp of the entropy of the weights: between 1 and size(); zero if uniform.
  float effective_components() const;

  void write(ByteWriter& out) const;
  /// Fails the reader if what it reads is no mixture.
  void read(ByteReader& in);
  friend bool operator==(const GaussianMixture&, const GaussianMixture&) = default;

 private:
  void set(int k, const GaussianComponent& component);

  // inverse_** is the inverse of the lower Cholesky factor of the covariance: with
  // a = inverse_xx dx and b = inverse_yx dx + inverse_yy dy the exponent is -(a^2 + b^2)
  // / 2.
  alignas(32) Lanes mean_x_{}, mean_y_{};
  alignas(32) Lanes inverse_xx_{}, inverse_yx_{}, inverse_yy_{};
  alignas(32) Lanes peak_{};    // weight / (2 pi sqrt(determinant)); zero if unused
  alignas(32) Lanes weight_{};  // sums to one
  int size_ = 0;
};

}  // namespace tyndall
