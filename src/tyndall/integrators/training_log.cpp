// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/training_log.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

// Samples of a buffer: small beside the least memory that is worth having.
constexpr size_t buffer_size = 256;

}  // namespace

// Only a few hundred thousand samples of a pass come as far as the lock.
void TrainingLog::add(const TrainingSample& sample) const {
  const std::lock_guard lock(mutex_);
  while (kept_ >= most_ && largest_key_ > 0 && wants(sample.key)) halve();
  if (kept_ < most_ && wants(sample.key)) keep(sample);
}

void TrainingLog::keep(const TrainingSample& sample) const {
  if (buffers_.empty() || buffers_.back().size() == buffer_size) {
    buffers_.emplace_back().reserve(std::min(buffer_size, most_ - kept_));
    const size_t room = std::min(buffers_.size() * buffer_size, most_);
    most_memory_ = std::max(most_memory_, room * sizeof(TrainingSample));
  }
  buffers_.back().push_back(sample);
  ++kept_;
}

// Forgets the samples with the larger keys. All that come later are held to that, too: what
// is left at the end is what the last bound leaves of all samples, in whatever order they
// came.
void TrainingLog::halve() const {
  largest_key_ = largest_key_ / 2;
  std::vector<TrainingBuffer> before = std::exchange(buffers_, {});
  kept_ = 0;
  for (TrainingBuffer& buffer : before) {
    for (const TrainingSample& s : buffer)
      if (wants(s.key)) keep(s);
    buffer = {};
  }
}

std::vector<TrainingBuffer> TrainingLog::take(double growth) {
  const double kept_share = (static_cast<double>(largest_key_) + 1) * 0x1p-64;
  const double expected = static_cast<double>(kept_) / kept_share * growth;
  const double share =
      expected > 0 ? std::min(static_cast<double>(usual_) / expected, 1.0) : 1;
  largest_key_ = share < 1 ? static_cast<uint64_t>(share * 0x1p64) : ~uint64_t{0};
  kept_ = 0;
  return std::exchange(buffers_, {});
}

}  // namespace tyndall
