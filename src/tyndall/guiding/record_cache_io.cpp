// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/record_cache.h"

namespace tyndall {

namespace {

constexpr uint32_t magic = 0x44475954;  // "TYGD"
constexpr uint32_t version = 1;

// The least number of bytes that a record, and a guide, can have: bounds of believable
// counts.
constexpr size_t least_record = 8 * 12 + 8, least_guide = 60;

template <typename Summary, typename F>
void for_each_number(Summary& s, F f) {
  f(s.count), f(s.lit), f(s.x), f(s.y), f(s.z), f(s.xx), f(s.yy), f(s.zz);
  f(s.inverse_light_distance), f(s.sigma_t), f(s.features), f(s.inverse_feature_distance);
}

void write_node(const RecordNode& node, ByteWriter& out) {
  out.write(static_cast<uint32_t>(node.is_leaf() ? 3 : node.axis()));
  out.write(node.is_leaf() ? node.record() : node.first_child());
  out.write(node.is_leaf() ? 0.0f : node.position());
}

// Children come after their parents, so a damaged file cannot make a loop.
RecordNode read_node(ByteReader& in, size_t index, size_t nodes, size_t records) {
  const auto axis = in.read_as<uint32_t>();
  const auto target = in.read_as<uint32_t>();
  const auto position = in.read_as<float>();
  const bool is_valid = axis == 3
                            ? target < records
                            : axis < 3 && target > index && target + size_t{1} < nodes;
  if (!is_valid) in.fail();
  if (in.failed() || axis == 3) return RecordNode::leaf(in.failed() ? 0 : target);
  return RecordNode::split(static_cast<int>(axis), position, target);
}

std::optional<std::vector<LightCluster>> read_clusters(ByteReader& in) {
  const auto found_magic = in.read_as<uint32_t>(), found_version = in.read_as<uint32_t>();
  const auto size = in.read_as<uint32_t>();
  if (found_magic != magic || found_version != version || size > in.remaining() / 8)
    return std::nullopt;
  std::vector<LightCluster> clusters(size);
  for (LightCluster& c : clusters) {
    const auto measure = in.read_as<uint32_t>();
    if (measure > static_cast<uint32_t>(SquareMeasure::solid_angle)) return std::nullopt;
    c.measure = static_cast<SquareMeasure>(measure);
    in.read(c.power);
    if (!(c.power >= 0 && c.power <= 1.001f)) return std::nullopt;
  }
  return clusters;
}

}  // namespace

void RecordCache::write(ByteWriter& out) const {
  for (const uint32_t v : {magic, version, static_cast<uint32_t>(clusters_.size())})
    out.write(v);
  for (const LightCluster& c : clusters_)
    out.write(static_cast<uint32_t>(c.measure)), out.write(c.power);
  out.write(static_cast<uint32_t>(nodes_.size()));
  out.write(static_cast<uint32_t>(records_.size()));
  out.write(samples_);
  out.write(rejected_);
  for (const RecordNode& node : nodes_) write_node(node, out);
  for (const Record& record : records_) {
    for_each_number(record.summary, [&](double v) { out.write(v); });
    out.write(record.radius);
    for (const ClusterContribution& c : record.contributions)
      out.write(c.count), out.write(c.squared_weight);
    out.write(static_cast<uint32_t>(record.guides.size()));
    for (const GuideTraining& g : record.guides) g.write(out);
  }
}

bool RecordCache::read(ByteReader& in) {
  const std::optional<std::vector<LightCluster>> clusters = read_clusters(in);
  const size_t nodes = in.read_as<uint32_t>(), records = in.read_as<uint32_t>();
  if (!clusters || clusters->size() != clusters_.size() || records == 0 ||
      nodes != 2 * records - 1 || records > in.remaining() / least_record)
    return false;

  RecordCache loaded(clusters_, settings_);
  in.read(loaded.samples_);
  in.read(loaded.rejected_);
  loaded.nodes_.clear();
  for (size_t i = 0; i < nodes; ++i)
    loaded.nodes_.push_back(read_node(in, i, nodes, records));
  loaded.records_.assign(records, Record{});
  for (Record& record : loaded.records_) {
    for_each_number(record.summary, [&](double& v) { in.read(v); });
    in.read(record.radius);
    record.contributions.resize(clusters_.size());
    for (ClusterContribution& c : record.contributions)
      in.read(c.count), in.read(c.squared_weight);
    const auto guides = in.read_as<uint32_t>();
    if (guides > in.remaining() / least_guide) return false;
    record.guides.resize(guides);
    for (GuideTraining& g : record.guides) {
      g.read(in);
      if (g.cluster >= clusters_.size()) in.fail();
    }
    loaded.guides_ += guides;
    if (in.failed()) return false;
  }
  loaded.freeze();
  *this = std::move(loaded);
  return true;
}

std::optional<RecordCache> RecordCache::load(ByteReader& in, RecordCacheSettings settings) {
  ByteReader ahead = in;
  std::optional<std::vector<LightCluster>> clusters = read_clusters(ahead);
  if (!clusters) return std::nullopt;
  float power = 0;
  for (const LightCluster& c : *clusters) power += c.power;
  if (!clusters->empty() && !(power > 0)) return std::nullopt;
  RecordCache cache(std::move(*clusters), settings);
  if (!cache.read(in)) return std::nullopt;
  return cache;
}

}  // namespace tyndall
