// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "tyndall/guiding/training_sample.h"

namespace tyndall {

/// Training samples of a pass. What is kept depends on the samples' keys alone, so that it
/// is the same for any number of threads.
class TrainingLog {
 public:
  /// Keeps at most about `usual` samples of a pass whose size it could foresee, and never
  /// more than `most`.
  TrainingLog(size_t usual, size_t most) : usual_(usual), most_(most) {}

  /// Called from many threads.
  bool wants(uint64_t key) const {
    return key <= largest_key_.load(std::memory_order_relaxed);
  }
  /// Called from many threads, with what it wants.
  void add(const TrainingSample& sample) const;

  /// Takes the samples since the last call out of the log, which will keep of those to come
  /// the share that fits if there are `growth` times as many. Not to be called while others
  /// add.
  std::vector<TrainingBuffer> take(double growth);

  /// The most that it has held so far [bytes].
  size_t most_memory() const { return most_memory_; }

 private:
  void keep(const TrainingSample& sample) const;
  void halve() const;

  size_t usual_, most_;
  mutable std::mutex mutex_;
  mutable std::atomic<uint64_t> largest_key_ = ~uint64_t{0};
  mutable std::vector<TrainingBuffer> buffers_;  // all full but the last
  mutable size_t kept_ = 0, most_memory_ = 0;
};

}  // namespace tyndall
