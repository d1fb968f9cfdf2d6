// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/record_cache.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

namespace tyndall {

namespace {

// The frozen guide exists twice while an update replaces the field.
constexpr size_t guide_bytes = sizeof(GuideTraining) +
                               GuideTraining::max_pending * sizeof(WeightedPoint) +
                               2 * (sizeof(DirectionGuide) + sizeof(uint32_t));
// Of a cluster with fewer samples nothing is said of its contribution.
constexpr double least_cluster_samples = 16;
constexpr size_t max_records = size_t{1} << 29;

}  // namespace

void serial_for(size_t n, const std::function<void(size_t)>& body) {
  for (size_t i = 0; i < n; ++i) body(i);
}

RecordCache::RecordCache(std::vector<LightCluster> clusters, RecordCacheSettings settings)
    : clusters_(std::move(clusters)), settings_(std::move(settings)) {
  float power = 0;
  for (const LightCluster& c : clusters_) power += c.power;
  assert(clusters_.empty() || power > 0);
  for (LightCluster& c : clusters_) c.power /= power;
  nodes_.push_back(RecordNode::leaf(0));
  records_.emplace_back().contributions.resize(clusters_.size());
  freeze();
}

bool RecordCache::is_usable(const TrainingSample& s) const {
  const auto is_unit = [](Vec3 w) { return std::abs(length_squared(w) - 1) < 1e-3f; };
  return s.weight >= 0 && s.weight < infinity && is_finite(s.p) && is_unit(s.wi) &&
         is_unit(s.light_direction) && s.phase_pdf >= 0 && s.phase_pdf < infinity &&
         s.mixture_pdf >= 0 && s.mixture_pdf < infinity && s.joint_pdf >= 0 &&
         s.joint_pdf < infinity && s.scattered >= 0 && s.scattered < infinity &&
         s.sigma_t >= 0 && s.sigma_t < infinity && s.pdf > 0 && s.pdf < infinity &&
         s.light_distance > 0 && s.cluster < clusters_.size();
}

// The usable samples, sorted by record and key; gives each record its part of them.
RecordCache::Samples RecordCache::assign_samples(std::span<const TrainingBuffer> buffers) {
  struct Entry {
    uint32_t record;
    uint64_t key;
    const TrainingSample* sample;
  };
  std::vector<Entry> entries;
  for (const TrainingBuffer& buffer : buffers)
    for (const TrainingSample& s : buffer) {
      ++samples_;
      if (is_usable(s))
        entries.push_back({find_record(nodes_, s.p), s.key, &s});
      else
        ++rejected_;
    }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.record, a.key) < std::tie(b.record, b.key);
  });

  Samples samples(entries.size());
  for (size_t begin = 0; begin < entries.size();) {
    Record& record = records_[entries[begin].record];
    size_t end = begin;
    for (; end < entries.size() && entries[end].record == entries[begin].record; ++end) {
      samples[end] = entries[end].sample;
      record.summary.add(*samples[end]);
      record.contributions[samples[end]->cluster].add(samples[end]->weight);
    }
    record.samples = SampleSpan(samples).subspan(begin, end - begin);
    begin = end;
  }
  return samples;
}

void RecordCache::update(std::span<const TrainingBuffer> buffers, const ParallelFor& run) {
  Samples samples = assign_samples(buffers);  // the records' spans point into it
  update_radii();
  std::vector<uint32_t> leaves;
  for (uint32_t node = 0; node < nodes_.size(); ++node)
    if (nodes_[node].is_leaf() && !records_[nodes_[node].record()].samples.empty())
      leaves.push_back(node);
  while (!leaves.empty()) {
    for (const uint32_t node : leaves) open_guides(records_[nodes_[node].record()]);
    run(leaves.size(), [&](size_t i) { train(records_[nodes_[leaves[i]].record()]); });
    std::vector<uint32_t> children;
    for (const uint32_t node : leaves)
      if (divide(node))
        for (const uint32_t i : {0u, 1u})
          children.push_back(nodes_[node].first_child() + i);
    leaves = std::move(children);
  }
  update_radii();
  for (Record& record : records_) record.samples = {};
  freeze();
}

bool RecordCache::should_divide(const Record& record) const {
  if (records_.size() >= max_records) return false;
  const size_t cost = record_bytes() + record.guides.size() * guide_bytes;
  if (memory() + cost > settings_.memory) return false;
  const double width =
      2 * std::sqrt(static_cast<double>(max_component(record.summary.variance())));
  if (!(width > 0) || record.samples.empty()) return false;
  const double ratio = std::max(1.0, static_cast<double>(record.radius) / width);
  return record.summary.lit >= settings_.split_samples * ratio * ratio * ratio;
}

// Divides a leaf at the mean of its samples, along the axis where they vary most.
bool RecordCache::divide(uint32_t node) {
  const uint32_t index = nodes_[node].record();
  if (!should_divide(records_[index])) return false;
  const Vec3 variance = records_[index].summary.variance();
  const int axis = variance.x >= variance.y && variance.x >= variance.z ? 0
                   : variance.y >= variance.z                           ? 1
                                                                        : 2;
  const float position = records_[index].summary.center()[axis];
  const SampleSpan all = records_[index].samples;
  const auto middle =
      std::stable_partition(all.begin(), all.end(),
                            [&](const TrainingSample* s) { return s->p[axis] < position; });
  const auto left = static_cast<size_t>(middle - all.begin());
  if (left == 0 || left == all.size()) return false;

  records_.push_back(records_[index]);
  guides_ += records_[index].guides.size();
  const auto other = static_cast<uint32_t>(records_.size() - 1);
  records_[index].samples = all.first(left);
  records_[other].samples = all.subspan(left);
  inherit(records_[index]);
  inherit(records_[other]);
  const auto first_child = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back(RecordNode::leaf(index));
  nodes_.push_back(RecordNode::leaf(other));
  nodes_[node] = RecordNode::split(axis, position, first_child);
  return true;
}

// Makes a copy of the parent a child: its samples are its own, and what the parent knew
// counts as a prior.
void RecordCache::inherit(Record& child) const {
  const double keep = 0.25;
  child.summary = {};
  for (ClusterContribution& c : child.contributions)
    c.count *= keep, c.squared_weight *= keep;
  for (const TrainingSample* s : child.samples) {
    child.summary.add(*s);
    child.contributions[s->cluster].add(s->weight);
  }
  child.radius = own_radius(child.summary);
  // The mixture's coordinates stay as they are along the child's own direction.
  const Vec3 direction = reference_frame(child.samples).z;
  for (GuideTraining& g : child.guides) {
    g.guide.reference = turned_frame(g.guide.reference, direction);
    g.em.forget(keep);
  }
}

// Gives a guide to the clusters that lit the record in this pass, the strongest first.
void RecordCache::open_guides(Record& record) {
  std::vector<double> weight(clusters_.size(), 0);
  for (const TrainingSample* s : record.samples)
    weight[s->cluster] += static_cast<double>(s->weight);
  for (const GuideTraining& g : record.guides) weight[g.cluster] = 0;
  while (record.guides.size() < settings_.guides_per_record &&
         memory() + guide_bytes <= settings_.memory) {
    const auto best = std::max_element(weight.begin(), weight.end());
    if (best == weight.end() || !(*best > 0)) return;
    *best = 0;
    const auto cluster = static_cast<uint32_t>(best - weight.begin());
    Samples own;
    std::copy_if(record.samples.begin(), record.samples.end(), std::back_inserter(own),
                 [&](const TrainingSample* s) { return s->cluster == cluster; });
    GuideTraining& g = record.guides.emplace_back();
    g.cluster = cluster;
    g.guide.measure = clusters_[cluster].measure;
    g.guide.reference = reference_frame(own);
    g.guide.shares = ShareStatistics<direction_techniques>::with_floor(
        g.guide.shares, settings_.training.shares.floor);
    ++guides_;
  }
}

void RecordCache::train(Record& record) const {
  Samples own;
  for (GuideTraining& g : record.guides) {
    own.clear();
    std::copy_if(record.samples.begin(), record.samples.end(), std::back_inserter(own),
                 [&](const TrainingSample* s) { return s->cluster == g.cluster; });
    if (!own.empty()) g.train(own, settings_.training);
  }
}

float RecordCache::own_radius(const RecordSummary& s) const {
  if (s.count == 0) return infinity;
  const double feature = s.features > 0 ? s.inverse_feature_distance / s.features : 0;
  return validity_radius(settings_.relative_change, s.inverse_light_distance / s.count,
                         s.sigma_t / s.count, feature, settings_.angular_derivative);
}

void RecordCache::update_radii() {
  for (Record& record : records_) record.radius = own_radius(record.summary);
  std::vector<float> clamped(records_.size());
  for (int sweep = 0; sweep < 2; ++sweep) {
    for (size_t i = 0; i < records_.size(); ++i) clamped[i] = clamped_radius(records_[i]);
    for (size_t i = 0; i < records_.size(); ++i) records_[i].radius = clamped[i];
  }
}

// Neighbour clamping: what is near a record that changes fast changes fast, too. Neighbours
// are the records found one radius away along the axes, or at the rim of the samples if
// that is nearer.
float RecordCache::clamped_radius(const Record& record) const {
  if (record.summary.count == 0) return record.radius;
  const Vec3 center = record.summary.center(), variance = record.summary.variance();
  float radius = record.radius;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      Vec3 p = center;
      p[axis] += sign * std::min(record.radius, 4 * std::sqrt(variance[axis]));
      const Record& other = records_[find_record(nodes_, p)];
      if (other.summary.count > 0)
        radius = std::min(radius, other.radius + distance(center, other.summary.center()));
    }
  return radius;
}

std::vector<float> RecordCache::cluster_probabilities(const Record& record) const {
  double known = 0, known_power = 0;
  for (size_t k = 0; k < clusters_.size(); ++k)
    if (record.contributions[k].count >= least_cluster_samples) {
      known += record.contributions[k].value();
      known_power += static_cast<double>(clusters_[k].power);
    }
  // What is not known contributes as its power would let one expect.
  const double per_power = known > 0 && known_power > 0 ? known / known_power : 1;
  std::vector<double> value(clusters_.size());
  double total = 0;
  for (size_t k = 0; k < clusters_.size(); ++k) {
    const bool is_known =
        known > 0 && record.contributions[k].count >= least_cluster_samples;
    value[k] = is_known ? record.contributions[k].value()
                        : per_power * static_cast<double>(clusters_[k].power);
    total += value[k];
  }
  std::vector<float> probability(clusters_.size());
  for (size_t k = 0; k < clusters_.size(); ++k)
    probability[k] = settings_.cluster_floor * clusters_[k].power +
                     (1 - settings_.cluster_floor) * static_cast<float>(value[k] / total);
  return probability;
}

void RecordCache::freeze() {
  auto field = std::shared_ptr<GuidingField>(new GuidingField());
  field->nodes_ = nodes_;
  field->clusters_ = clusters_.size();
  field->records_.reserve(records_.size());
  for (const Record& record : records_) {
    const Vec3 variance = record.summary.variance();
    const float spread = 3 * std::sqrt(variance.x + variance.y + variance.z);
    const bool is_empty = record.summary.count == 0;
    field->records_.push_back({.center = record.summary.center(),
                               .reach = is_empty ? 0 : std::max(record.radius, spread),
                               .radius = is_empty ? 0 : record.radius,
                               .first_guide = static_cast<uint32_t>(field->guides_.size()),
                               .guides = static_cast<uint32_t>(record.guides.size())});
    for (const GuideTraining& g : record.guides) {
      field->guides_.push_back(g.guide);
      field->guide_cluster_.push_back(g.cluster);
    }
    for (const float p : cluster_probabilities(record))
      field->cluster_probability_.push_back(p);
  }
  field_ = std::move(field);
}

void RecordCache::forget(double keep) {
  for (Record& record : records_)
    for (GuideTraining& g : record.guides) g.em.forget(keep);
}

size_t RecordCache::record_bytes() const {
  return sizeof(Record) + 2 * sizeof(GuidingRecord) + 6 * sizeof(RecordNode) +
         clusters_.size() * (sizeof(ClusterContribution) + 2 * sizeof(float));
}

size_t RecordCache::memory() const {
  return records_.size() * record_bytes() + guides_ * guide_bytes;
}

GuidingStatistics RecordCache::statistics() const {
  GuidingStatistics s{.records = records_.size(),
                      .guides = guides_,
                      .samples = samples_,
                      .rejected = rejected_,
                      .memory = memory()};
  for (const Record& record : records_) {
    if (record.radius < infinity)
      s.radius += static_cast<double>(record.radius) / static_cast<double>(records_.size());
    for (const GuideTraining& g : record.guides) {
      if (g.guide.mixture.is_uniform()) continue;
      ++s.trained_guides;
      s.effective_components += static_cast<double>(g.guide.mixture.effective_components());
      s.leak += 1 - static_cast<double>(g.guide.mixture.inside_mass());
      s.mixture_share += static_cast<double>(g.guide.share(DirectionTechnique::mixture));
    }
  }
  if (s.trained_guides > 0)
    for (double* mean : {&s.effective_components, &s.leak, &s.mixture_share})
      *mean /= static_cast<double>(s.trained_guides);
  return s;
}

}  // namespace tyndall
