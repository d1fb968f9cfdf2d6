// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <variant>

#include "tyndall/math/constants.h"
#include "tyndall/math/frame.h"
#include "tyndall/math/vec.h"
#include "tyndall/media/phase_sample.h"
#include "tyndall/media/tabulated_phase.h"

namespace tyndall {

/// Scatters into all directions alike.
class IsotropicPhase {
 public:
  float eval(Vec3 /*wo*/, Vec3 /*wi*/) const { return inv_4pi; }
  float pdf(Vec3 /*wo*/, Vec3 /*wi*/) const { return inv_4pi; }
  std::optional<PhaseSample> sample(Vec3 /*wo*/, Vec2 u) const {
    const Vec3 wi = spherical_direction_of_turns(1 - 2 * u.x, u.y);
    return PhaseSample{.wi = wi, .value = inv_4pi, .pdf = inv_4pi};
  }
  float mean_cosine() const { return 0; }
};

/// Henyey-Greenstein phase function [HG41].
///
/// `wo` and `wi` are unit vectors that point away from the scattering point, so light that
/// is not deflected has wi == -wo. `g` is the mean cosine of the deflection: g > 0 scatters
/// forward.
class HenyeyGreenstein {
 public:
  /// Precondition: -1 < g < 1. The scene loader reports anything else.
  explicit HenyeyGreenstein(float g) : g_(g) { assert(-1 < g && g < 1); }

  /// p(wo, wi) [1/sr]; integrates to one over all wi.
  float eval(Vec3 wo, Vec3 wi) const {
    // 1 + g^2 - 2 g cos = (1 - |g|)^2 + |g| |wi +- wo|^2 for unit vectors: nothing cancels
    // where the lobe is sharp.
    const float d = sqr(1 - magnitude(g_)) +
                    magnitude(g_) * length_squared(wi + wo * std::copysign(1.0f, g_));
    return inv_4pi * (1 - g_) * (1 + g_) / (d * std::sqrt(d));
  }
  /// Density with which sample() draws wi [1/sr].
  float pdf(Vec3 wo, Vec3 wi) const { return eval(wo, wi); }
  /// Draws wi in proportion to eval(). Never empty.
  std::optional<PhaseSample> sample(Vec3 wo, Vec2 u) const {
    const Vec3 local = spherical_direction_of_turns(sample_cosine(u.x), u.y);
    const Vec3 wi = Frame::from_z(-wo).to_world(local);
    const float p = eval(wo, wi);
    return PhaseSample{.wi = wi, .value = p, .pdf = p};
  }
  float mean_cosine() const { return g_; }

  /// The cosine of a deflection drawn from the phase function.
  float sample_cosine(float u) const {
    // Inverting the CDF in s = 2 u - 1 gives the textbook
    //   cos = (1 + g^2 - ((1 - g^2) / (1 + g s))^2) / (2 g),
    // 0/0 at g = 0. With m = (s + g) / (1 + g s) the bracket is 1 - g m and g cancels, so
    // g = 0 needs no special case.
    const float s = 2 * u - 1;
    const float m = (s + g_) / (1 + g_ * s);
    return m + 0.5f * g_ * (1 - m * m);
  }

 private:
  float g_;
};

/// A mixture of two Henyey-Greenstein lobes, usually one forward and one backward.
class TwoLobePhase {
 public:
  /// Precondition: 0 <= share <= 1, the share of `first` in the scattered light.
  TwoLobePhase(HenyeyGreenstein first, HenyeyGreenstein second, float share)
      : first_(first), second_(second), share_(share) {
    assert(0 <= share && share <= 1);
  }

  float eval(Vec3 wo, Vec3 wi) const {
    return share_ * first_.eval(wo, wi) + (1 - share_) * second_.eval(wo, wi);
  }
  float pdf(Vec3 wo, Vec3 wi) const { return eval(wo, wi); }
  std::optional<PhaseSample> sample(Vec3 wo, Vec2 u) const {
    const bool is_first = u.x < share_;
    const float x = is_first ? u.x / share_ : (u.x - share_) / (1 - share_);
    const Vec2 rest{std::min(x, one_minus_epsilon), u.y};
    const Vec3 wi = is_first ? first_.sample(wo, rest)->wi : second_.sample(wo, rest)->wi;
    const float p = eval(wo, wi);
    return PhaseSample{.wi = wi, .value = p, .pdf = p};
  }
  float mean_cosine() const {
    return share_ * first_.mean_cosine() + (1 - share_) * second_.mean_cosine();
  }

 private:
  HenyeyGreenstein first_, second_;
  float share_;
};

/// Scattering by particles much smaller than the wavelength: proportional to 1 + cos^2.
class RayleighPhase {
 public:
  float eval(Vec3 wo, Vec3 wi) const { return 0.75f * inv_4pi * (1 + sqr(dot(wo, wi))); }
  float pdf(Vec3 wo, Vec3 wi) const { return eval(wo, wi); }
  std::optional<PhaseSample> sample(Vec3 wo, Vec2 u) const {
    // The CDF (cos^3 + 3 cos + 4) / 8 = u is a cubic with one real root [Frisvad11].
    const float q = 4 * u.x - 2;
    const float a = std::cbrt(q + std::sqrt(sqr(q) + 1));
    const Vec3 local = spherical_direction_of_turns(a - 1 / a, u.y);
    const Vec3 wi = Frame::from_z(-wo).to_world(local);
    const float p = eval(wo, wi);
    return PhaseSample{.wi = wi, .value = p, .pdf = p};
  }
  float mean_cosine() const { return 0; }
};

/// The closed set of phase functions. Adding one means: the class, this line, and a row in
/// the chi-square test.
using PhaseFunctionVariant = std::variant<IsotropicPhase, HenyeyGreenstein, TwoLobePhase,
                                          RayleighPhase, TabulatedPhase>;

/// Any phase function, by value; cheap to copy.
class PhaseFunction {
 public:
  PhaseFunction() = default;  ///< isotropic
  template <typename T>
  PhaseFunction(T phase) : phase_(phase) {}  // NOLINT: conversion is the point

  float eval(Vec3 wo, Vec3 wi) const {
    return std::visit([&](const auto& p) { return p.eval(wo, wi); }, phase_);
  }
  float pdf(Vec3 wo, Vec3 wi) const {
    return std::visit([&](const auto& p) { return p.pdf(wo, wi); }, phase_);
  }
  std::optional<PhaseSample> sample(Vec3 wo, Vec2 u) const {
    return std::visit([&](const auto& p) { return p.sample(wo, u); }, phase_);
  }
  /// Mean cosine of the deflection, in (-1, 1).
  float mean_cosine() const {
    return std::visit([](const auto& p) { return p.mean_cosine(); }, phase_);
  }

 private:
  PhaseFunctionVariant phase_;
};

}  // namespace tyndall
