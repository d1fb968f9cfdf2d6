// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/training_log.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>

namespace tyndall {

struct TrainingLog::Buffers {
  tbb::enumerable_thread_specific<TrainingBuffer> of_thread;
};

TrainingLog::TrainingLog(size_t capacity)
    : capacity_(capacity), buffers_(std::make_unique<Buffers>()) {}

TrainingLog::~TrainingLog() = default;

void TrainingLog::add(const TrainingSample& sample) const {
  buffers_->of_thread.local().push_back(sample);
}

std::vector<TrainingBuffer> TrainingLog::take(double growth) {
  size_t kept = 0;
  std::vector<TrainingBuffer> taken;
  for (TrainingBuffer& buffer : buffers_->of_thread) {
    kept += buffer.size();
    taken.push_back(std::move(buffer));
  }
  buffers_->of_thread.clear();
  const double kept_share = (static_cast<double>(largest_key_) + 1) * 0x1p-64;
  const double expected = static_cast<double>(kept) / kept_share * growth;
  const double share =
      expected > 0 ? std::min(static_cast<double>(capacity_) / expected, 1.0) : 1;
  largest_key_ = share < 1 ? static_cast<uint64_t>(share * 0x1p64) : ~uint64_t{0};
  return taken;
}

size_t TrainingLog::memory() const {
  size_t samples = 0;
  for (const TrainingBuffer& buffer : buffers_->of_thread) samples += buffer.capacity();
  return samples * sizeof(TrainingSample);
}

}  // namespace tyndall
