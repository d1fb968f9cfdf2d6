// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tyndall/guiding/direction_guide.h"

namespace tyndall {

/// A node of the tree of records, eight bytes: an inner node splits space at a coordinate,
/// its children are neighbours; a leaf names a record.
class RecordNode {
 public:
  static RecordNode leaf(uint32_t record) { return {0, record << 2 | 3u}; }
  static RecordNode split(int axis, float position, uint32_t first_child) {
    return {position, first_child << 2 | static_cast<uint32_t>(axis)};
  }

  bool is_leaf() const { return (bits_ & 3u) == 3u; }
  int axis() const { return static_cast<int>(bits_ & 3u); }
  float position() const { return position_; }
  uint32_t record() const { return bits_ >> 2; }
  uint32_t child(Vec3 p) const { return (bits_ >> 2) + (p[axis()] < position_ ? 0u : 1u); }
  uint32_t first_child() const { return bits_ >> 2; }

  friend bool operator==(const RecordNode&, const RecordNode&) = default;

 private:
  RecordNode(float position, uint32_t bits) : position_(position), bits_(bits) {}

  float position_;
  uint32_t bits_;  // record or first child, then two bits: the axis, or 3 for a leaf
};

/// The leaf that holds p. `nodes` is not empty, its first one the root.
inline uint32_t find_record(std::span<const RecordNode> nodes, Vec3 p) {
  const RecordNode* node = nodes.data();
  while (!node->is_leaf()) node = &nodes[node->child(p)];
  return node->record();
}

/// A place in the medium for which something was learned.
struct GuidingRecord {
  Vec3 center;       ///< mean position of its samples
  float reach = 0;   ///< how far from the center it may be used [scene units]
  float radius = 0;  ///< within which what it learned changes little [scene units]
  uint32_t first_guide = 0;
  uint32_t guides = 0;  ///< how many clusters it has a guide for
};

/// The learned state that one pass reads while the next one is trained. Immutable.
class GuidingField {
 public:
  /// The record for a point, in logarithmic time; null where nothing was learned.
  const GuidingRecord* find(Vec3 p) const {
    const GuidingRecord& record = records_[find_record(nodes_, p)];
    const bool is_near =
        record.reach > 0 && distance_squared(p, record.center) <= sqr(record.reach);
    return is_near ? &record : nullptr;
  }
  /// What the record knows of a cluster; null if nothing.
  const DirectionGuide* guide(const GuidingRecord& record, uint32_t cluster) const {
    for (uint32_t i = record.first_guide; i < record.first_guide + record.guides; ++i)
      if (guide_cluster_[i] == cluster) return &guides_[i];
    return nullptr;
  }
  /// The cluster's share of the learned contributions around the record; positive.
  float cluster_probability(const GuidingRecord& record, uint32_t cluster) const;

  std::span<const GuidingRecord> records() const { return records_; }
  std::span<const DirectionGuide> guides() const { return guides_; }
  /// The cluster of each guide.
  std::span<const uint32_t> guide_clusters() const { return guide_cluster_; }
  size_t clusters() const { return clusters_; }
  size_t memory() const;  ///< [bytes]

 private:
  friend class RecordCache;
  GuidingField() = default;
  std::span<const float> probabilities(const GuidingRecord& record) const;

  std::vector<RecordNode> nodes_;
  std::vector<GuidingRecord> records_;
  std::vector<DirectionGuide> guides_;
  std::vector<uint32_t> guide_cluster_;
  std::vector<float> cluster_probability_;  // of each record in turn
  size_t clusters_ = 0;
};

}  // namespace tyndall
