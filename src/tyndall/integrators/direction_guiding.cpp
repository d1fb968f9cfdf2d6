// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/direction_guiding.h"

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>

#include "tyndall/guiding/light_clusters.h"
#include "tyndall/integrators/integrator.h"
#include "tyndall/math/parallel_for.h"
#include "tyndall/scene/scene.h"

namespace tyndall {
namespace {

constexpr size_t max_clusters = 16;
// What training samples may take of the memory.
constexpr size_t log_part = 3;

size_t most_samples(size_t memory) { return memory / log_part / sizeof(TrainingSample); }

// More samples of one pass teach little: later passes bring other ones.
constexpr size_t max_samples = 100'000;
// What a sample of pre-training counts for, beside one of the scene.
constexpr double pretraining_worth = 0.05;

LightClusters clusters_of(const Scene& scene) {
  const float radius = 0.5f * length(scene.bounds().diagonal());
  std::vector<ClusterableLight> lights;
  for (const Light& light : scene.lights()) {
    const std::optional<LightExtent> extent = light.extent();
    lights.push_back({.p = extent ? extent->box.center() : Vec3{},
                      .power = luminance(light.power(radius)),
                      .is_infinite = !extent});
  }
  return cluster_lights(lights, max_clusters);
}

std::vector<LightCluster> to_learn(const LightClusters& clusters) {
  std::vector<LightCluster> result;
  for (size_t i = 0; i < clusters.size(); ++i)
    result.push_back({.measure = clusters.is_infinite[i] ? SquareMeasure::solid_angle
                                                         : SquareMeasure::joint_sampling,
                      .power = std::max(clusters.power[i], 1e-20f)});
  return result;
}

RecordCacheSettings cache_settings(size_t memory) {
  RecordCacheSettings settings;
  settings.memory = memory - memory / log_part;
  settings.split_samples = 500;
  return settings;
}

}  // namespace

DirectionGuiding::DirectionGuiding(const Scene& scene, const ConnectionSettings& settings)
    : settings_(settings),
      cluster_of_(clusters_of(scene).cluster_of),
      cache_(to_learn(clusters_of(scene)), cache_settings(settings.direction_memory)),
      field_(cache_.field()),
      log_(std::min(most_samples(settings.direction_memory), max_samples),
           most_samples(settings.direction_memory)) {
  if (settings.known_directions) field_ = settings.known_directions->field();
}

const DirectionGuide* DirectionGuiding::find(Vec3 p, size_t light) const {
  const GuidingRecord* record = field_->find(p);
  return record ? field_->guide(*record, cluster_of_[light]) : nullptr;
}

LightProbabilities DirectionGuiding::choose(const LightProbabilities& blind, Vec3 p) const {
  const GuidingRecord* record = field_->find(p);
  if (!record || field_->clusters() < 2) return blind;
  std::array<float, max_clusters> share{};
  for (size_t i = 0; i < blind.size(); ++i) share[cluster_of_[i]] += blind.probability(i);
  boost::container::small_vector<float, 32> factors(blind.size());
  for (size_t i = 0; i < blind.size(); ++i) {
    const uint32_t k = cluster_of_[i];
    const float learned = field_->cluster_probability(*record, k);
    factors[i] = share[k] > 0 ? 0.5f + 0.5f * learned / share[k] : 0;
  }
  return blind.reweighed({factors.data(), factors.size()});
}

void DirectionGuiding::start_pretraining() { is_recording_ = !settings_.known_directions; }

void DirectionGuiding::finish_pretraining() {
  if (!is_recording_) return;
  cache_.update(log_.take(1), parallel_for);
  cache_.forget(pretraining_worth);
  field_ = cache_.field();
}

uint32_t DirectionGuiding::prepare(uint32_t first) {
  if (settings_.known_directions) return Integrator::unlimited;
  const uint32_t next = first == 0 ? 1 : 2 * first;
  if (first > 0) {
    const uint32_t last_pass = first - last_prepared_;
    cache_.update(log_.take(static_cast<double>(next - first) / last_pass), parallel_for);
    field_ = cache_.field();
  }
  is_recording_ = true;
  last_prepared_ = first;
  return next;
}

bool DirectionGuiding::has_learned() const {
  return settings_.known_directions || cache_.statistics().trained_guides > 0;
}

void DirectionGuiding::report(RenderStatistics& statistics) const {
  const GuidingStatistics s = cache_.statistics();
  const auto set = [&](const char* name, double value) {
    statistics.counters[std::string("guiding.") + name] = value;
  };
  set("records", static_cast<double>(s.records));
  set("guides", static_cast<double>(s.guides));
  set("guides.trained", static_cast<double>(s.trained_guides));
  set("samples", static_cast<double>(s.samples));
  set("samples.rejected", static_cast<double>(s.rejected));
  set("samples.per_record",
      static_cast<double>(s.samples) / std::max(static_cast<double>(s.records), 1.0));
  set("components.effective", s.effective_components);
  set("leak", s.leak);
  set("mixture_share", s.mixture_share);
  set("radius", s.radius);
  set("memory_bytes", static_cast<double>(s.memory + log_.most_memory()));
}

}  // namespace tyndall
