// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "tyndall/guiding/training_sample.h"

namespace tyndall {

/// Training samples of a pass, one buffer per thread. What is kept depends on the samples'
/// keys alone, so that it is the same for any number of threads.
class TrainingLog {
 public:
  /// Keeps at most about `capacity` samples.
  explicit TrainingLog(size_t capacity);
  ~TrainingLog();

  /// Called from many threads.
  bool wants(uint64_t key) const { return key <= largest_key_; }
  void add(const TrainingSample& sample) const;

  /// Takes the samples since the last call out of the log, which will keep of those to come
  /// the share that fits if there are `growth` times as many. Not to be called while others
  /// add.
  std::vector<TrainingBuffer> take(double growth);

  size_t memory() const;  ///< [bytes]

 private:
  struct Buffers;
  size_t capacity_;
  uint64_t largest_key_ = ~uint64_t{0};
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace tyndall
