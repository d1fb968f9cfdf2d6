// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tyndall/guiding/guiding_field.h"
#include "tyndall/guiding/record_training.h"

namespace tyndall {

/// A cluster of lights that records learn together.
struct LightCluster {
  SquareMeasure measure =
      SquareMeasure::joint_sampling;  ///< solid_angle for lights at infinity
  float power = 1;  ///< share of the choice between clusters before anything is learned
};

struct RecordCacheSettings {
  RecordTrainingSettings training;
  /// Samples of positive weight that a record must have seen to be divided, if it is wider
  /// than its validity radius; narrower records need more, by the cube of the ratio.
  double split_samples = 2000;
  double relative_change = 0.5;    ///< see validity_radius()
  double angular_derivative = 0;   ///< see validity_radius(); zero for isotropic media
  uint32_t guides_per_record = 8;  ///< at most; clusters without one are sampled untrained
  float cluster_floor = 0.2f;  ///< share of the choice between clusters left to their power
  size_t memory = size_t{256} << 20;  ///< [bytes], training and frozen state together
};

/// What a cache has learned, for people.
struct GuidingStatistics {
  uint64_t records = 0, guides = 0, trained_guides = 0;
  uint64_t samples = 0;   ///< seen, in all updates
  uint64_t rejected = 0;  ///< of them: not finite, negative, of an unknown cluster ...
  double effective_components = 0;  ///< mean over trained guides
  double leak = 0;                  ///< mean mass of trained mixtures outside the square
  double mixture_share = 0;         ///< mean over trained guides
  double radius = 0;                ///< mean of the validity radii
  size_t memory = 0;                ///< [bytes]
};

/// Calls body(i) for every i below n, on any threads and in any order.
using ParallelFor = std::function<void(size_t n, const std::function<void(size_t)>& body)>;

/// Calls them in order on this thread.
void serial_for(size_t n, const std::function<void(size_t)>& body);

/// Records in the medium, each with a guide per cluster of lights, trained pass by pass.
///
/// Readers keep the field of the last update(), which never changes; samples go to buffers
/// of the caller, and update() makes the next field of them. The result depends on the set
/// of the samples only: not on the buffers, their order, or the number of threads. Records
/// are the leaves of a tree that divides where samples are many and the validity radius is
/// exceeded; children start with what their parent knew.
class RecordCache {
 public:
  explicit RecordCache(std::vector<LightCluster> clusters,
                       RecordCacheSettings settings = {});

  /// The state for readers; never null, stays valid and unchanged while held, during the
  /// next update() too. Not to be called while update() runs.
  std::shared_ptr<const GuidingField> field() const { return field_; }

  /// Learns from the samples of a pass and replaces the field. Not to be called from two
  /// threads at once. Unusable samples are counted and left out.
  void update(std::span<const TrainingBuffer> buffers, const ParallelFor& run = serial_for);
  /// Makes later samples count as if only the share `keep` of the earlier had been seen;
  /// after pre-training.
  void forget(double keep);

  GuidingStatistics statistics() const;
  size_t memory() const;  ///< [bytes]
  const RecordCacheSettings& settings() const { return settings_; }

  /// The whole state but for the settings; a versioned, portable format.
  void write(ByteWriter& out) const;
  /// Takes over what write() wrote. False, and nothing changed, if it is something else or
  /// for another number of clusters.
  bool read(ByteReader& in);
  /// A cache from what write() wrote, with the clusters that it was written with; empty if
  /// it is something else.
  static std::optional<RecordCache> load(ByteReader& in, RecordCacheSettings settings = {});
  const std::vector<LightCluster>& clusters() const { return clusters_; }

 private:
  using Samples = std::vector<const TrainingSample*>;
  using SampleSpan = std::span<const TrainingSample*>;

  struct Record {
    RecordSummary summary;
    float radius = infinity;
    std::vector<GuideTraining> guides;
    std::vector<ClusterContribution> contributions;  // one per cluster
    SampleSpan samples;                              // of the pass in hand
  };

  bool is_usable(const TrainingSample& sample) const;
  Samples assign_samples(std::span<const TrainingBuffer> buffers);
  float own_radius(const RecordSummary& summary) const;
  bool should_divide(const Record& record) const;
  bool divide(uint32_t node);
  void inherit(Record& child) const;
  void open_guides(Record& record);
  void train(Record& record) const;
  void update_radii();
  float clamped_radius(const Record& record) const;
  std::vector<float> cluster_probabilities(const Record& record) const;
  void freeze();
  size_t record_bytes() const;

  std::vector<LightCluster> clusters_;
  RecordCacheSettings settings_;
  std::vector<RecordNode> nodes_;
  std::vector<Record> records_;
  uint64_t guides_ = 0, samples_ = 0, rejected_ = 0;

  std::shared_ptr<const GuidingField> field_;
};

}  // namespace tyndall
