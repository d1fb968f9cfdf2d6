// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/guiding_field.h"

namespace tyndall {

std::span<const float> GuidingField::probabilities(const GuidingRecord& record) const {
  const auto index = static_cast<size_t>(&record - records_.data());
  return std::span(cluster_probability_).subspan(index * clusters_, clusters_);
}

float GuidingField::cluster_probability(const GuidingRecord& record,
                                        uint32_t cluster) const {
  return probabilities(record)[cluster];
}

size_t GuidingField::memory() const {
  return nodes_.size() * sizeof(RecordNode) + records_.size() * sizeof(GuidingRecord) +
         guides_.size() * (sizeof(DirectionGuide) + sizeof(uint32_t)) +
         cluster_probability_.size() * sizeof(float);
}

}  // namespace tyndall
