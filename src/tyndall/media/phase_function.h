// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>

#include "tyndall/math/vec.h"

namespace tyndall {

/// A direction drawn from a phase function.
struct PhaseSample {
  Vec3 wi;      ///< unit, points away from the scattering point
  float value;  ///< p(wo, wi) [1/sr]
  float pdf;    ///< density of wi w.r.t. solid angle [1/sr]
};

/// Scatters into all directions alike.
class IsotropicPhase {
 public:
  float eval(Vec3 wo, Vec3 wi) const;
  float pdf(Vec3 wo, Vec3 wi) const;
  std::optional<PhaseSample> sample(Vec3 wo, Vec2 u) const;
  float mean_cosine() const { return 0; }
};

/// Henyey-Greenstein phase function [HG41].
///
/// `wo` and `wi` are unit vectors that point away from the scattering point, so light that is
/// not deflected has wi == -wo. `g` is the mean cosine of the deflection: g > 0 scatters forward.
class HenyeyGreenstein {
 public:
  /// Precondition: -1 < g < 1. The scene loader reports anything else.
  explicit HenyeyGreenstein(float g);

  /// p(wo, wi) [1/sr]; integrates to one over all wi.
  float eval(Vec3 wo, Vec3 wi) const;
  /// Density with which sample() draws wi [1/sr].
  float pdf(Vec3 wo, Vec3 wi) const;
  /// Draws wi in proportion to eval(). Never empty.
  std::optional<PhaseSample> sample(Vec3 wo, Vec2 u) const;
  float mean_cosine() const { return g_; }

 private:
  float g_;
};

/// The closed set of phase functions. Adding one means: the class, this line, and a row in the
/// chi-square test.
using PhaseFunctionVariant = std::variant<IsotropicPhase, HenyeyGreenstein>;

/// Any phase function, by value; cheap to copy.
class PhaseFunction {
 public:
  PhaseFunction() = default;  ///< isotropic
  template <typename T>
  PhaseFunction(T phase) : phase_(phase) {}  // NOLINT: conversion is the point

  float eval(Vec3 wo, Vec3 wi) const;
  float pdf(Vec3 wo, Vec3 wi) const;
  std::optional<PhaseSample> sample(Vec3 wo, Vec2 u) const;
  /// Mean cosine of the deflection, in (-1, 1).
  float mean_cosine() const;

 private:
  PhaseFunctionVariant phase_;
};

}  // namespace tyndall
