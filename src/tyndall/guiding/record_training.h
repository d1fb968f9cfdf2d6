// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tyndall/guiding/direction_guide.h"
#include "tyndall/guiding/online_em.h"
#include "tyndall/guiding/training_sample.h"

namespace tyndall {

/// How records are trained.
struct RecordTrainingSettings {
  /// Later samples count for more: of what was known before a pass as long as all earlier
  /// ones together a quarter remains.
  EmSettings em{.step_exponent = 1, .step_gain = 2};
  ShareSettings shares;
  size_t least_samples = 6;         ///< of positive weight, for a first fit of a mixture
  double least_effective = 2;       ///< and so many effective ones
  uint32_t samples_per_step = 256;  ///< between two M steps
};

/// Around which a record's samples lie, and what bounds its validity. Sums: they add.
struct RecordSummary {
  double count = 0;
  double lit = 0;                                      ///< samples of positive weight
  double x = 0, y = 0, z = 0, xx = 0, yy = 0, zz = 0;  ///< of positions and their squares
  double inverse_light_distance = 0;
  double sigma_t = 0;
  double features = 0,
         inverse_feature_distance = 0;  ///< occluders hit and scattering vertices

  void add(const TrainingSample& sample);
  Vec3 center() const;
  /// Variance of the positions along each axis.
  Vec3 variance() const;
};

/// How far from a record its directions hold [scene units]: where single scattering of a
/// light at distance 1 / inverse_light_distance changes by the share `relative_change`
/// [Jarosz08], [Zhou16], extended by what Jarosz leaves out: occluders and scattering
/// vertices at a (harmonic mean) distance 1 / inverse_feature_distance move in direction
/// just as the light does. `angular_derivative` is that of the logarithm of the phase
/// function's share. Infinite if nothing bounds it.
float validity_radius(double relative_change, double inverse_light_distance, double sigma_t,
                      double inverse_feature_distance, double angular_derivative);

/// One cluster's guide with what its training needs.
struct GuideTraining {
  uint32_t cluster = 0;
  DirectionGuide guide;
  OnlineEm em;
  std::vector<WeightedPoint> pending;  ///< samples kept until they suffice for a first fit

  static constexpr size_t max_pending = 64;

  /// Learns mixture and shares from the samples of this cluster, in their order. The shares
  /// are judged with the mixture as it was before.
  void train(std::span<const TrainingSample* const> samples,
             const RecordTrainingSettings& settings);
  void write(ByteWriter& out) const;
  void read(ByteReader& in);

 private:
  void start_mixture(std::span<const WeightedPoint> points, uint64_t seed,
                     const RecordTrainingSettings& settings);
  void continue_mixture(std::span<const WeightedPoint> points,
                        const RecordTrainingSettings& settings);
};

/// What a cluster of lights contributes around a record.
struct ClusterContribution {
  double count = 0, squared_weight = 0;

  void add(float weight) {
    count += 1;
    squared_weight += static_cast<double>(weight) * static_cast<double>(weight);
  }
  /// Root of the second moment of the weights: the best share of samples is proportional to
  /// it.
  double value() const;
};

/// A frame whose z axis is the samples' mean direction to the light.
Frame reference_frame(std::span<const TrainingSample* const> samples);

}  // namespace tyndall
