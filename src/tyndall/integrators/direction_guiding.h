// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "tyndall/guiding/record_cache.h"
#include "tyndall/integrators/connection_settings.h"
#include "tyndall/integrators/render.h"
#include "tyndall/integrators/training_log.h"
#include "tyndall/scene/light_choice.h"

namespace tyndall {

/// The directions that a render has learned so far: from which single scattering arrives at
/// points of its media.
///
/// During a pass readers see what earlier passes taught, and nothing of their own;
/// prepare() changes it in between.
class DirectionGuiding {
 public:
  DirectionGuiding(const Scene& scene, const ConnectionSettings& settings);

  bool has_product() const { return settings_.product; }
  /// What is known of the light around p; null if nothing.
  const DirectionGuide* find(Vec3 p, size_t light) const;
  uint32_t cluster_of(size_t light) const { return cluster_of_[light]; }
  /// Probabilities of lights to connect to around p, given those that know nothing of what
  /// hides them: divided anew among the clusters, in half by what each has contributed
  /// there.
  LightProbabilities choose(const LightProbabilities& blind, Vec3 p) const;

  /// Whether a training sample of this key will be kept.
  bool wants(uint64_t key) const { return is_recording_ && log_.wants(key); }
  void record(const TrainingSample& sample) const { log_.add(sample); }

  /// What is recorded between these two becomes a first guess, worth few samples. No effect
  /// if directions are known beforehand.
  void start_pretraining();
  void finish_pretraining();
  /// Learns from the samples since the last call; called before sample `first` of each
  /// pixel. Returns up to which sample the render may go on.
  uint32_t prepare(uint32_t first);
  /// Adds counters.
  void report(RenderStatistics& statistics) const;
  /// Whether anything is known, if only of one place.
  bool has_learned() const;
  const RecordCache& records() const { return cache_; }

 private:
  ConnectionSettings settings_;
  std::vector<uint32_t> cluster_of_;
  RecordCache cache_;
  std::shared_ptr<const GuidingField> field_;
  TrainingLog log_;
  bool is_recording_ = false;
  uint32_t last_prepared_ = 0;
};

}  // namespace tyndall
